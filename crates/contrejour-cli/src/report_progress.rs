//! How a report comes along: a bar on a terminal, else a line a group.

use std::io::IsTerminal;
use std::time::Duration;

use contrejour_lab::run::Event;
use indicatif::{HumanDuration, ProgressBar, ProgressStyle};

use crate::output::warn;

/// Shows a run's events on standard error.
pub struct Progress {
    bar: ProgressBar,
    is_terminal: bool,
}

impl Progress {
    pub fn new() -> Self {
        let is_terminal = std::io::stderr().is_terminal();
        let bar = if is_terminal { ProgressBar::new(0) } else { ProgressBar::hidden() };
        let style = ProgressStyle::with_template("{bar:30} {msg}, {eta} left");
        Self { bar: if let Ok(style) = style { bar.with_style(style) } else { bar }, is_terminal }
    }

    pub fn show(&self, event: &Event<'_>) {
        match *event {
            Event::Estimated { duration, groups } => {
                self.tell(&format!("{groups} groups, about {}", HumanDuration(duration)));
            }
            Event::Resumed { scene, map_size } => self.tell(&format!("{scene} at {map_size} is there already")),
            Event::OutOfTime { scene, map_size } => {
                self.tell(&format!("no time for {scene} at {map_size}; the same command again goes on with it"));
            }
            Event::NotOnDevice { label } => self.tell(&format!("this device can't do {label}")),
            Event::TruthBegins { scene, receivers } => self.begin(format!("{scene}: truth"), receivers),
            Event::TruthGrows { receivers } => self.bar.inc(receivers),
            Event::FrameDone => self.bar.inc(1),
            Event::GroupBegins { scene, map_size, frames } => self.begin(format!("{scene} at {map_size}"), frames),
            Event::GroupDone { scene, map_size, number, of, duration } => {
                self.tell(&format!("{number}/{of} {scene} at {map_size}, {}", seconds(duration)));
            }
            Event::FigureBegins { name } => self.begin(name.to_owned(), 1),
            Event::TruthDone => {}
        }
    }

    pub fn done(&self) {
        self.bar.finish_and_clear();
    }

    fn begin(&self, message: String, length: u64) {
        self.bar.reset();
        self.bar.set_length(length);
        self.bar.set_message(message);
    }

    /// A line that stays.
    fn tell(&self, line: &str) {
        if self.is_terminal {
            self.bar.println(line);
        } else {
            warn(line);
        }
    }
}

fn seconds(duration: Duration) -> String {
    format!("{:.1} s", duration.as_secs_f64())
}
