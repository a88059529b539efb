//! The library's compute stages one after the other on a frame's buffers, with a fault planted where a test wants one.

use bytemuck::cast_slice;
use contrejour_gpu::stages::{self, ComputeStage, Dispatch};
use contrejour_layout::{BLOCK_SIZE, LightView};

use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::harness::Outcome;
use crate::planted::planted;
use crate::stage_run::StageRun;

/// Stages on a device, in the order in which a frame runs them.
#[derive(Debug)]
pub struct Chain<'a> {
    gpu: &'a Gpu,
    stages: Vec<(ComputeStage, StageRun)>,
}

/// A fault in one stage.
#[derive(Clone, Copy, Debug)]
pub enum Fault {
    /// The stage is left out.
    Skipped {
        /// Its name.
        stage: &'static str,
    },
    /// A piece of its text, which it has once, is another.
    Replaced {
        /// Its name.
        stage: &'static str,
        /// What it says.
        piece: &'static str,
        /// What it says with the fault.
        fault: &'static str,
    },
}

impl Fault {
    /// The stage that it is in.
    pub fn stage(&self) -> &'static str {
        match self {
            Self::Skipped { stage } | Self::Replaced { stage, .. } => stage,
        }
    }

    /// The stage with the fault; none where it is left out.
    ///
    /// # Panics
    ///
    /// When no stage has the name, or its text does not have the piece exactly once: then the fault would be none.
    pub fn build(&self, gpu: &Gpu) -> Option<StageRun> {
        match *self {
            Self::Skipped { .. } => None,
            Self::Replaced { stage, piece, fault } => {
                Some(StageRun::new(gpu, &planted(wgsl_of(stage), (piece, fault)), stage))
            }
        }
    }
}

/// Checks that a check of single stages fails with each of these faults.
///
/// # Errors
///
/// The first fault with which it passes, or that leaves the whole stage out.
///
/// # Panics
///
/// As [`Fault::build`].
pub fn check_each_is_found(gpu: &Gpu, faults: &[Fault], check: impl Fn(&Gpu, &StageRun) -> Outcome) -> Outcome {
    for fault in faults {
        if check(gpu, &fault.build(gpu).ok_or("the stage is there")?).is_ok() {
            return Err(format!("not found: {fault:?}"));
        }
    }
    Ok(())
}

/// The text of a stage of a light or of a scene.
///
/// # Panics
///
/// When no stage has the name.
pub fn wgsl_of(stage: &str) -> &'static str {
    let of_scenes = stages::SCENE.iter().map(|known| (known.stage.name(), known.wgsl));
    let of_lights = stages::ALL.iter().map(|known| (known.stage.name(), known.wgsl));
    let found = of_scenes.chain(of_lights).find(|&(name, _)| name == stage);
    found.unwrap_or_else(|| panic!("no stage is named {stage}")).1
}

fn place(stage: &str) -> usize {
    let place = stages::ALL.iter().position(|known| known.stage.name() == stage);
    place.unwrap_or_else(|| panic!("no stage is named {stage}"))
}

impl<'a> Chain<'a> {
    /// The stages from the first to the named one.
    ///
    /// # Panics
    ///
    /// When no stage has the name.
    pub fn new(gpu: &'a Gpu, last: &str) -> Self {
        let build = |stage: &ComputeStage| (*stage, StageRun::new(gpu, stage.wgsl, stage.stage.name()));
        Self { gpu, stages: stages::ALL[..=place(last)].iter().map(build).collect() }
    }

    /// Plants a fault, calls `test`, and takes the fault out again.
    ///
    /// # Panics
    ///
    /// When the chain ends before the fault's stage, and as [`Fault::build`].
    pub fn with<T>(&mut self, fault: &Fault, test: impl FnOnce(&Self) -> T) -> T {
        let place = place(fault.stage());
        let (stage, sound) = self.stages.remove(place);
        let faulty = fault.build(self.gpu);
        let is_there = usize::from(faulty.is_some());
        self.stages.splice(place..place, faulty.map(|faulty| (stage, faulty)));
        let result = test(self);
        self.stages.splice(place..place + is_there, [(stage, sound)]);
        result
    }

    /// Runs the stages on a frame.
    pub fn run(&self, frame: &mut Frame) {
        for (stage, run) in &self.stages {
            let groups = groups(stage.dispatch, frame);
            if groups.contains(&0) {
                continue;
            }
            let inputs: Vec<_> = run.bindings().map(|name| (name, frame.bytes(name))).collect();
            for (name, bytes) in run.run(self.gpu, groups, &inputs) {
                frame.set_bytes(&name, &bytes);
            }
        }
    }
}

fn groups(dispatch: Dispatch, frame: &Frame) -> [u32; 3] {
    match dispatch {
        Dispatch::Casters => [frame.view().caster_count.div_ceil(BLOCK_SIZE), 1, frame.bundle.shape.seat_count],
        Dispatch::Blocks => {
            let LightView { face_block_count, edge_block_count, .. } = *frame.view();
            [face_block_count.div_ceil(BLOCK_SIZE) + edge_block_count.div_ceil(BLOCK_SIZE), 1, 1]
        }
        Dispatch::Once => [1, 1, 1],
        Dispatch::Indirect(kind, index) => {
            let args: &[[u32; 3]] = cast_slice(frame.bytes(kind.name()));
            args[index as usize]
        }
    }
}
