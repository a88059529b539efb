//! One scene at one map size.

use std::thread::available_parallelism;

use contrejour_render::{Contestant as Drawing, Gpu};

use super::arena::Arena;
use super::contestants::Entrant;
use super::error::RunError;
use super::event::{Event, Tell};
use super::folder::{RunFolder, plain};
use super::options::RunOptions;
use super::timing::{Samples, take_turns};
use crate::report::{Contestant, Errors, Group, Machine};

/// Measures all entrants at one map size: first what they cost, taking turns, then how wrong they are.
pub(super) fn measure(
    arena: &Arena,
    entrants: &[Entrant],
    map_size: u32,
    options: &RunOptions,
    folder: &RunFolder,
    tell: Tell,
) -> Result<Group, RunError> {
    let Arena { name, subject, .. } = arena;
    let gpu = subject.judge.gpu();
    let frames = (entrants.len() * options.effort.frames()) as u64;
    tell(&Event::GroupBegins { scene: name, map_size, frames });

    let enter = |entrant: &Entrant| {
        let settings = entrant.settings(&subject.shadow, map_size);
        Ok((entrant.label.clone(), subject.judge.contestant(&settings)?))
    };
    let mut drawings = entrants.iter().map(enter).collect::<Result<Vec<_>, RunError>>()?;
    let samples = take_turns(&mut drawings, &subject.light, &options.effort, options.seed, tell)?;

    let mut contestants = Vec::new();
    let mut visibilities = Vec::new();
    for ((entrant, (_, mut drawing)), samples) in entrants.iter().zip(drawings).zip(&samples) {
        let (errors, visibility) = arena.judge(&mut drawing, tell)?;
        contestants.push(contestant(entrant, errors, samples, &drawing, gpu)?);
        visibilities.push(visibility);
    }
    let [faces, edges] = subject.faces_and_edges()?;
    let mut group = Group {
        scene: name.clone(),
        map_size,
        faces,
        edges,
        light_size: subject.light_size(),
        machine: machine(gpu),
        truth: arena.exactness,
        truth_picture: Some(arena.truth_picture.clone()),
        contestants,
    };
    group.settle();
    for (contestant, visibility) in group.contestants.iter_mut().zip(&visibilities).filter(|(who, _)| who.stands) {
        let name = format!("{map_size}-{}", plain(&contestant.label));
        let [picture, difference] = arena.save_pictures(&name, visibility, folder)?;
        (contestant.picture, contestant.difference) = (Some(picture), Some(difference));
    }
    Ok(group)
}

fn contestant(
    entrant: &Entrant,
    errors: Errors,
    samples: &Samples,
    drawing: &Drawing,
    gpu: &Gpu,
) -> Result<Contestant, RunError> {
    Ok(Contestant {
        label: entrant.label.clone(),
        family: entrant.family.to_owned(),
        technique: entrant.technique.name().to_owned(),
        parameters: entrant.parameters(),
        errors,
        cost: samples.cost(drawing, gpu.is_software())?,
        picture: None,
        difference: None,
        stands: false,
        on_front: false,
        ratio: None,
    })
}

fn machine(gpu: &Gpu) -> Machine {
    let cores = available_parallelism().map_or(1, |cores| cores.get() as u32);
    Machine { device: gpu.description(), is_software: gpu.is_software(), cores }
}
