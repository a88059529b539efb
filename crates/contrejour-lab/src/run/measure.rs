//! A run from its arguments to its report.

use std::time::{Duration, Instant};

use contrejour_plan::ShadowSettings;
use contrejour_render::Gpu;

use super::arena::Arena;
use super::check::check;
use super::contestants::{Entrant, entrants};
use super::error::RunError;
use super::event::{Event, Tell};
use super::figures;
use super::folder::RunFolder;
use super::group;
use super::lab::Lab;
use super::manifest::{Manifest, Work};
use super::options::RunOptions;
use super::pilot::estimate;
use crate::report::{Extent, Group, Report};

/// A quick report begins no group after this long, so that it and its figures are ready in three minutes.
const QUICK_BUDGET: Duration = Duration::from_secs(110);

/// Measures what is asked for and writes the report into its folder. What an earlier run with the same arguments left
/// there is not measured again.
///
/// # Errors
///
/// [`RunError`]: arguments that make no sense, a folder of another run, or something that fails on the way. Finished
/// groups are kept, and the same call goes on after them.
pub fn run(gpu: &Gpu, options: &RunOptions, tell: Tell) -> Result<Report, RunError> {
    let started = Instant::now();
    let entrants = entrants(options.effort.extent, &options.techniques)?;
    let manifest = Manifest::new(options)?;
    check(gpu, options)?;
    let entrants = on_device(gpu, entrants, tell);
    let folder = RunFolder::open(&options.folder, &manifest, options.restart)?;
    let pending = pending(&manifest, &folder, tell)?;
    let is_quick = options.effort.extent == Extent::Quick;
    let lab = Lab { gpu, options, folder: &folder, tell };
    if !is_quick {
        let (groups, figures) = (pending.len(), figures::pending(&lab)?);
        let duration = estimate(gpu, options, &entrants, &pending, &folder)?;
        tell(&Event::Estimated { duration, groups, figures });
    }

    let mut arena: Option<(usize, Arena)> = None;
    for (number, work) in (1..).zip(&pending) {
        let &Work { scene, ref name, map_size } = work;
        if is_quick && started.elapsed() > QUICK_BUDGET {
            tell(&Event::OutOfTime { scene: name, map_size });
            continue;
        }
        let clock = Instant::now();
        let here = match arena.take() {
            Some((kept, here)) if kept == scene => here,
            _ => Arena::new(gpu, &options.scenes[scene], options, &folder, tell)?,
        };
        let group = group::measure(&here, &entrants, map_size, options, &folder, tell)?;
        folder.keep_group(work, &group)?;
        arena = Some((scene, here));
        let duration = clock.elapsed();
        tell(&Event::GroupDone { scene: name, map_size, number, of: pending.len(), duration });
    }
    drop(arena);

    let figures = figures::all(&lab)?;
    let mut report = Report { header: manifest.header.clone(), groups: kept(&manifest.work(), &folder)?, figures };
    report.settle();
    report.write(folder.root())?;
    Ok(report)
}

/// The entrants that the device can do as they are called; the others are told.
fn on_device(gpu: &Gpu, entrants: Vec<Entrant>, tell: Tell) -> Vec<Entrant> {
    let facts = gpu.facts();
    let can = |entrant: &Entrant| {
        let settings = entrant.settings(&ShadowSettings::default(), 1);
        settings.on_device(&facts) == settings
    };
    let (able, unable): (Vec<_>, Vec<_>) = entrants.into_iter().partition(can);
    unable.iter().for_each(|entrant| tell(&Event::NotOnDevice { label: &entrant.label }));
    able
}

/// What is still to be measured.
fn pending(manifest: &Manifest, folder: &RunFolder, tell: Tell) -> Result<Vec<Work>, RunError> {
    let all = manifest.work();
    if all.is_empty() {
        tell(&Event::NothingToDo { shard: manifest.shard(), groups: manifest.all_work().len() });
    }
    let mut pending = Vec::new();
    for work in all {
        match folder.group(&work)? {
            Some(_) => tell(&Event::Resumed { scene: &work.name, map_size: work.map_size }),
            None => pending.push(work),
        }
    }
    Ok(pending)
}

/// What was measured of some work.
pub(super) fn kept(work: &[Work], folder: &RunFolder) -> Result<Vec<Group>, RunError> {
    work.iter().filter_map(|work| folder.group(work).transpose()).collect()
}
