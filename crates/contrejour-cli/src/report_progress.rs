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
            Event::Estimated { duration, groups, figures } => {
                if let Some(line) = estimate(duration, groups, figures) {
                    self.tell(&line);
                }
            }
            Event::NothingToDo { shard, groups } => {
                self.tell(&format!("shard {shard} has nothing to measure: {}", counted(groups, "group")));
            }
            Event::WithoutArea { scene, receivers } => {
                let points = counted(receivers, "point");
                self.tell(&format!("{scene}: {points} on faces without area left out of the comparison"));
            }
            Event::Resumed { scene, map_size } => self.tell(&format!("{scene} at {map_size} is there already")),
            Event::OutOfTime { scene, map_size } => {
                self.tell(&format!("no time for {scene} at {map_size}; the same command again goes on with it"));
            }
            Event::NotOnDevice { label } => self.tell(&format!("this device can't do {label}")),
            Event::TruthBegins { scene, receivers } => self.begin(format!("{scene}: truth"), receivers),
            Event::TruthGrows { receivers } => self.bar.inc(receivers),
            Event::FrameDone => self.step(),
            Event::GroupBegins { scene, map_size, frames } => self.begin(format!("{scene} at {map_size}"), frames),
            Event::GroupDone { scene, map_size, number, of, duration } => {
                self.tell(&format!("{number}/{of} {scene} at {map_size}, {}", seconds(duration)));
            }
            Event::FigureBegins { name } => self.begin(name.to_owned(), 1),
            Event::TruthDone => {}
        }
    }

    /// Replaces what is said beside the bar.
    pub fn say(&self, message: String) {
        self.bar.set_message(message);
        self.bar.tick();
    }

    /// One step of what was begun is done.
    pub fn step(&self) {
        self.bar.inc(1);
    }

    /// So many steps of what was begun are done.
    pub fn reach(&self, steps: u64) {
        self.bar.set_position(steps);
    }

    pub fn done(&self) {
        self.bar.finish_and_clear();
    }

    /// Work of so many steps is begun.
    pub fn begin(&self, message: String, length: u64) {
        self.bar.reset();
        self.bar.set_length(length);
        self.bar.set_message(message);
    }

    /// A line that stays.
    pub fn tell(&self, line: &str) {
        if self.is_terminal {
            self.bar.println(line);
        } else {
            warn(line);
        }
    }
}

/// What is still to do and how long the groups of it take; none where nothing is.
fn estimate(duration: Duration, groups: usize, figures: usize) -> Option<String> {
    let measured = (groups > 0).then(|| format!("{}, about {}", counted(groups, "group"), HumanDuration(duration)));
    let made = (figures > 0).then(|| format!("{} of the papers", counted(figures, "figure")));
    match (measured, made) {
        (Some(measured), Some(made)) => Some(format!("{measured}; then {made}, which take time of their own")),
        (None, Some(made)) => Some(format!("only {made} to make")),
        (measured, None) => measured,
    }
}

pub fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

pub fn seconds(duration: Duration) -> String {
    format!("{:.1} s", duration.as_secs_f64())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_estimate_names_what_is_left() {
        let line = |groups, figures| estimate(Duration::from_secs(24), groups, figures);
        assert_eq!(line(1, 0).as_deref(), Some("1 group, about 24 seconds"));
        let both = "2 groups, about 24 seconds; then 10 figures of the papers, which take time of their own";
        assert_eq!(line(2, 10).as_deref(), Some(both));
        assert_eq!(line(0, 1).as_deref(), Some("only 1 figure of the papers to make"));
        assert_eq!(line(0, 0), None);
    }
}
