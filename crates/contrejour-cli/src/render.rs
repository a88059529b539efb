//! `contrejour render`: pictures, and what they cost.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};

use contrejour_gpu::ShadowOptions;
use contrejour_plan::{Light, Outputs};
use contrejour_render::{Gpu, Renderer, save_png};
use contrejour_scene::{Scene, orbit};
use indicatif::{ProgressBar, ProgressStyle};

use crate::args::RenderArguments;
use crate::failure::Failure;
use crate::frame_names::FrameNames;
use crate::output::{print, warn};
use crate::render_json::{json, summary};
use crate::scenes;

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
    let frame_names = match (&arguments.output, arguments.orbit) {
        (Some(output), Some(_)) => Some(FrameNames::parse(output)?),
        _ => None,
    };
    let mut scene = scenes::open(arguments.scene.as_deref())?;
    scene.warnings.iter().for_each(|warning| warn(warning));
    if let Some(size) = arguments.size {
        scene.resize(size);
    }
    let options = ShadowOptions {
        settings: arguments.shadow.applied_to(scene.shadow)?,
        outputs: Outputs::Maps,
        ..ShadowOptions::default()
    };
    let mut renderer = Renderer::new(Gpu::open()?, &scene, &options)?;

    let mut written = Written::default();
    match arguments.orbit {
        None => {
            let output = arguments.output.clone().unwrap_or_else(|| DEFAULT_OUTPUT.into());
            renderer.draw_complete(&scene.light)?;
            save_png(&renderer.picture()?, &output)?;
            written.pictures.push(output);
        }
        Some(frames) => draw_orbit(&mut renderer, &scene, frames, frame_names.as_ref(), &mut written)?,
    }
    if let Some(folder) = &arguments.views {
        write_views(&mut renderer, &last_light(&scene, arguments.orbit), folder, &mut written)?;
    }
    let measurements = renderer.measurements()?;
    print(&if arguments.json { json(&measurements, &written)? } else { summary(&measurements, &written) })
}

fn is_png(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png"))
}

/// Every frame of an orbit. Without names nothing is read back, and no frame is repeated.
fn draw_orbit(
    renderer: &mut Renderer,
    scene: &Scene,
    frames: u32,
    names: Option<&FrameNames>,
    written: &mut Written,
) -> Result<(), Failure> {
    let bar = if std::io::stderr().is_terminal() { progress_bar(frames) } else { ProgressBar::hidden() };
    for frame in 0..frames {
        let light = orbit(&scene.light, frame, frames);
        match names {
            Some(names) => {
                renderer.draw_complete(&light)?;
                let path = names.of(frame);
                save_png(&renderer.picture()?, &path)?;
                written.pictures.push(path);
            }
            None => renderer.draw(&light)?,
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

fn last_light(scene: &Scene, frames: Option<u32>) -> Light {
    frames.map_or(scene.light, |frames| orbit(&scene.light, frames - 1, frames))
}

fn write_views(renderer: &mut Renderer, light: &Light, folder: &Path, written: &mut Written) -> Result<(), Failure> {
    // A frame of an orbit that was not read back may miss something.
    if written.pictures.is_empty() {
        renderer.draw_complete(light)?;
    }
    for view in renderer.views()? {
        let path = folder.join(view.name).with_extension("png");
        save_png(&view.picture, &path)?;
        written.views.push((path, view.legend));
    }
    Ok(())
}
