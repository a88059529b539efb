//! `contrejour render`: pictures, and what they cost.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};

use contrejour_render::{Gpu, Renderer, save_png};
use indicatif::{ProgressBar, ProgressStyle};

use crate::animation::{Drawn, Sequence};
use crate::args::RenderArguments;
use crate::failure::Failure;
use crate::frame_names::FrameNames;
use crate::output::{print, warn};
use crate::render_json::{json, summary};

/// The picture's name where none is given.
const DEFAULT_OUTPUT: &str = "contrejour.png";

/// A picture that cannot be what its name says.
#[derive(Debug, thiserror::Error)]
#[error("{} is no PNG; pictures are written as PNG, so give a name that ends in .png", path.display())]
struct NotPng {
    path: PathBuf,
}

/// Files that were written.
#[derive(Debug, Default)]
pub struct Written {
    pub pictures: Vec<PathBuf>,
    /// Path and what its colours mean.
    pub views: Vec<(PathBuf, String)>,
}

pub fn run(arguments: &RenderArguments) -> Result<(), Failure> {
    if let Some(path) = arguments.output.as_deref().filter(|path| !is_png(path)) {
        return Err(Box::new(NotPng { path: path.into() }));
    }
    let sequence = Sequence::of(arguments);
    let frame_names = match (&arguments.output, sequence.frames()) {
        (Some(output), Some(_)) => Some(FrameNames::parse(output)?),
        _ => None,
    };
    let mut drawn = Drawn::open(arguments)?;
    drawn.scene().warnings.iter().for_each(|warning| warn(warning));
    if let Some(size) = arguments.size {
        drawn.scene_mut().resize(size);
    }
    arguments.shadow.apply_to_lights(drawn.scene_mut())?;
    let scene = drawn.scene();
    let mut renderer = drawn.renderer(Gpu::open()?)?;

    let mut written = Written::default();
    match sequence.frames() {
        None => {
            let output = arguments.output.clone().unwrap_or_else(|| DEFAULT_OUTPUT.into());
            renderer.draw_complete()?;
            save_png(&renderer.picture()?, &output)?;
            written.pictures.push(output);
        }
        Some(frames) => {
            let move_all = |renderer: &mut Renderer, frame| {
                drawn.pose(renderer, sequence, frame)?;
                sequence.move_lights(renderer, scene, frame)
            };
            draw_frames(&mut renderer, frames, move_all, frame_names.as_ref(), &mut written)?;
        }
    }
    if let Some(folder) = &arguments.views {
        write_views(&mut renderer, folder, &mut written)?;
    }
    let at_rest = renderer.casters_left_out_of_streams();
    if at_rest > 0 {
        warn(&format!(
            "{at_rest} of the casters move vertex by vertex and silhouette-map-stream holds meshes at rest: their shadows have \
             the shadow map's steps; silhouette-map and silhouette-map-tam follow them"
        ));
    }
    let measurements = renderer.measurements()?;
    print(&if arguments.json { json(&measurements, &written)? } else { summary(&measurements, &written) })
}

fn is_png(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png"))
}

/// Every frame of a sequence; `move_all` poses the model and moves the lights. Without names nothing is read back, and no
/// frame is repeated.
fn draw_frames(
    renderer: &mut Renderer,
    frames: u32,
    move_all: impl Fn(&mut Renderer, u32) -> Result<(), Failure>,
    names: Option<&FrameNames>,
    written: &mut Written,
) -> Result<(), Failure> {
    let bar = if std::io::stderr().is_terminal() { progress_bar(frames) } else { ProgressBar::hidden() };
    for frame in 0..frames {
        move_all(renderer, frame)?;
        match names {
            Some(names) => {
                renderer.draw_complete()?;
                let path = names.of(frame);
                save_png(&renderer.picture()?, &path)?;
                written.pictures.push(path);
            }
            None => renderer.draw()?,
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(())
}

fn progress_bar(frames: u32) -> ProgressBar {
    let bar = ProgressBar::new(frames.into());
    match ProgressStyle::with_template("{bar:40} frame {pos}/{len}, {eta} left") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

fn write_views(renderer: &mut Renderer, folder: &Path, written: &mut Written) -> Result<(), Failure> {
    // A frame of a sequence that was not read back may miss something.
    if written.pictures.is_empty() {
        renderer.draw_complete()?;
    }
    for view in renderer.views()? {
        let path = folder.join(view.name).with_extension("png");
        save_png(&view.picture, &path)?;
        written.views.push((path, view.legend));
    }
    Ok(())
}
