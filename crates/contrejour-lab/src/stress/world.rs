//! The casters and lights of a run on a device.

use std::sync::Arc;

use contrejour_gpu::{
    CasterHandle, CasterInput, DeformHandle, DeformInput, Deformer, LightHandle, Positions, ShadowOptions, Shadows,
};
use contrejour_mesh::{BuildOptions, PartPose, TopologyAwareMesh};
use contrejour_plan::{Eye, Light, LightKind, ShadowSettings};
use contrejour_render::Gpu;
use contrejour_scene::Camera;
use glam::{DMat4, DVec3};

use super::error::StressError;
use super::flexible::Flexible;
use super::options::{Motion, StressOptions};
use super::own::{Own, of_lights};
use super::paths::Path;
use super::summary::{LightSummary, Summary};
use crate::torus::{Triangles, torus};

/// Everything of a run that moves.
#[derive(Debug)]
pub(super) struct World {
    pub mesh: Arc<TopologyAwareMesh>,
    pub triangles: Triangles,
    pub flexible: Flexible,
    casters: Vec<Path>,
    lights: Vec<Path>,
    own: Vec<Own>,
    eye: Path,
    eye_target: Path,
    options: StressOptions,
    room: f64,
}

/// Where everything is in a frame, as a program's own simulation would say it.
#[derive(Debug)]
pub(super) struct Moment {
    casters: Vec<DMat4>,
    poses: Vec<PartPose>,
    lights: Vec<Light>,
    eye: Eye,
}

/// A world on a device.
#[derive(Debug)]
pub(super) struct Placed {
    pub shadows: Shadows,
    pub deformer: Deformer,
    pub casters: Vec<CasterHandle>,
    pub lights: Vec<LightHandle>,
    flexible: Vec<FlexibleCaster>,
}

/// A caster that deforms.
#[derive(Clone, Copy, Debug)]
struct FlexibleCaster {
    caster: CasterHandle,
    deformed: DeformHandle,
}

/// One caster in so many deforms, where things move.
const FLEXIBLE_OF: usize = 4;

/// Where the eye is around, over the room's radius, from the middle of the room.
const EYE: DVec3 = DVec3::new(0.95, 1.2, 2.7);

/// What it looks at, over the same.
const EYE_TARGET: DVec3 = DVec3::new(0.0, -0.2, 0.0);

/// The farthest that it sees, over the same: the floor of pictures ends before.
const EYE_FAR: f64 = 7.0;

/// Width over height of what it sees, where no picture is drawn.
const EYE_ASPECT: f64 = 16.0 / 9.0;

impl World {
    pub fn new(options: &StressOptions) -> Result<Self, StressError> {
        options.check()?;
        let across = ((options.triangles_per_caster as f64 / 4.0).sqrt().round() as u32).max(3);
        let around = (options.triangles_per_caster as u32 / (2 * across)).max(3);
        let mesh = torus(around, across);
        let flexible = Flexible::new(&mesh)?;
        let topology = TopologyAwareMesh::build(&mesh.positions, &mesh.triangles, &BuildOptions::default())?;
        // As crowded for any number of casters.
        let room = 2.0 * (options.casters as f64).cbrt().max(1.0);
        let mut random = fastrand::Rng::with_seed(options.seed);
        let mut random_of_eye = fastrand::Rng::with_seed(options.seed ^ 0xe7e);
        Ok(Self {
            mesh: Arc::new(topology),
            triangles: mesh,
            flexible,
            casters: (0..options.casters).map(|index| Path::of_caster(&mut random, index, room)).collect(),
            lights: (0..options.lights).map(|_| Path::of_light(&mut random)).collect(),
            own: of_lights(options),
            eye: Path::of_eye(&mut random_of_eye, EYE, 0.4),
            eye_target: Path::of_eye(&mut random_of_eye, EYE_TARGET, 0.3),
            options: options.clone(),
            room,
        })
    }

    /// Among the casters that deform, the index of a caster; `None` where it does not.
    pub fn flexible_index(&self, caster: usize) -> Option<usize> {
        let deforms = self.options.motion == Motion::Walking && caster % FLEXIBLE_OF == FLEXIBLE_OF - 1;
        deforms.then_some(caster / FLEXIBLE_OF)
    }

    /// The frame in whose places things are.
    fn path_frame(&self, frame: u64) -> u64 {
        match self.options.motion {
            Motion::Walking => frame,
            Motion::Still => 0,
        }
    }

    /// World space from each caster's object space in a frame.
    pub fn casters(&self, frame: u64) -> impl Iterator<Item = DMat4> {
        let moment = self.path_frame(frame);
        self.casters.iter().map(move |path| path.matrix(moment))
    }

    /// The poses of all casters, in their order.
    pub fn part_poses(&self, frame: u64) -> Vec<PartPose> {
        let moment = self.path_frame(frame);
        let pose = |(index, path): (usize, &Path)| {
            let world_from_object = path.matrix(moment);
            match self.flexible_index(index) {
                Some(_) => self.flexible.pose(world_from_object, path.swing(moment)),
                None => PartPose { world_from_object, joint_matrices: Vec::new(), morph_weights: Vec::new() },
            }
        };
        self.casters.iter().enumerate().map(pose).collect()
    }

    /// The poses of the casters that deform, in their order.
    pub fn flexible_poses(&self, frame: u64) -> Vec<PartPose> {
        let poses = self.part_poses(frame).into_iter().enumerate();
        poses.filter(|(index, _)| self.flexible_index(*index).is_some()).map(|(_, pose)| pose).collect()
    }

    /// The lights in a frame.
    pub fn lights(&self, frame: u64) -> impl Iterator<Item = Light> {
        let moment = self.path_frame(frame);
        let light = move |(index, (path, own)): (usize, (&Path, &Own))| Light {
            kind: self.options.kind.light(index, path.place(moment), self.room, own.softness),
            color: own.color,
        };
        self.lights.iter().zip(&self.own).enumerate().map(light)
    }

    /// How the shadow of a light is made.
    pub fn settings(&self, light: usize) -> &ShadowSettings {
        &self.own[light].settings
    }

    /// The camera of pictures in a frame.
    pub fn camera(&self, frame: u64) -> Camera {
        let moment = self.path_frame(frame);
        Camera {
            eye: self.room * self.eye.place(moment),
            target: self.room * self.eye_target.place(moment),
            up: DVec3::Y,
            fov_y: 0.8,
            near: 0.05 * self.room,
            far: EYE_FAR * self.room,
        }
    }

    /// The eye that cascades follow in a frame.
    pub fn eye(&self, frame: u64) -> Eye {
        self.camera(frame).as_eye(EYE_ASPECT)
    }

    /// Where everything is in a frame.
    pub fn moment(&self, frame: u64) -> Moment {
        Moment {
            casters: self.casters(frame).collect(),
            poses: self.flexible_poses(frame),
            lights: self.lights(frame).collect(),
            eye: self.eye(frame),
        }
    }

    pub fn caster_count(&self) -> usize {
        self.casters.len()
    }

    /// Radius of the room in which casters walk.
    pub fn room(&self) -> f64 {
        self.room
    }

    /// What is known before the first frame.
    pub fn summary(&self) -> Summary {
        Summary {
            lights: self.options.lights,
            casters: self.options.casters,
            triangles_per_caster: self.triangles.triangles.len(),
            seed: self.options.seed,
            light_settings: self.lights(0).zip(&self.own).map(|(light, own)| LightSummary::new(&light, own)).collect(),
            ..Summary::default()
        }
    }

    /// The world as it is in a frame.
    pub fn place(&self, gpu: &Gpu, frame: u64) -> Result<Placed, StressError> {
        let mut deformer = Deformer::new(&gpu.device)?;
        let poses = self.flexible_poses(frame);
        let deformed = poses.iter().map(|_| deformer.add(Arc::clone(&self.flexible.deforming)));
        let deformed = deformed.collect::<Result<Vec<_>, _>>()?;
        for (handle, pose) in deformed.iter().zip(&poses) {
            set_pose(&mut deformer, *handle, pose)?;
        }
        deformer.prepare(&gpu.device, &gpu.queue)?;

        let mut shadows = Shadows::new(&gpu.device)?;
        let rigid_mesh = shadows.add_mesh(Arc::clone(&self.mesh))?;
        let flexible_mesh = shadows.add_mesh(Arc::clone(&self.flexible.topology))?;
        let (mut casters, mut flexible) = (Vec::new(), Vec::new());
        for (index, world_from_object) in self.casters(frame).enumerate() {
            let deformed = self.flexible_index(index).map(|index| deformed[index]);
            let mesh = if deformed.is_some() { flexible_mesh } else { rigid_mesh };
            let positions = deformed.and_then(|deformed| deformer.positions(deformed)).unwrap_or_default();
            let caster = shadows.add_caster(&CasterInput { mesh, world_from_object, positions })?;
            casters.push(caster);
            flexible.extend(deformed.map(|deformed| FlexibleCaster { caster, deformed }));
        }
        let mut lights = Vec::new();
        for (index, light) in self.lights(frame).enumerate() {
            let options = ShadowOptions { settings: *self.settings(index), ..ShadowOptions::default() };
            let handle = shadows.add_light(&light, &options)?;
            show_eye(&mut shadows, handle, &light, &self.eye(frame))?;
            lights.push(handle);
        }
        Ok(Placed { shadows, deformer, casters, lights, flexible })
    }
}

impl Placed {
    /// Moves everything to where it is in a frame.
    pub fn walk(&mut self, gpu: &Gpu, moment: &Moment) -> Result<(), StressError> {
        for (flexible, pose) in self.flexible.iter().zip(&moment.poses) {
            set_pose(&mut self.deformer, flexible.deformed, pose)?;
        }
        self.deformer.prepare(&gpu.device, &gpu.queue)?;
        for (caster, place) in self.casters.iter().zip(&moment.casters) {
            self.shadows.place_caster(*caster, place)?;
        }
        for flexible in &self.flexible {
            if let Some(known) = self.deformer.known(flexible.deformed) {
                self.shadows.note_positions(flexible.caster, &known)?;
            }
        }
        for (handle, light) in self.lights.iter().zip(&moment.lights) {
            self.shadows.set_light(*handle, light)?;
            show_eye(&mut self.shadows, *handle, light, &moment.eye)?;
        }
        Ok(())
    }

    /// Where the positions of the casters that deform are, in their order.
    pub fn flexible_positions(&self) -> impl Iterator<Item = Positions> {
        self.flexible.iter().filter_map(|flexible| self.deformer.positions(flexible.deformed))
    }
}

/// Says which eye a light follows, where it follows any.
fn show_eye(shadows: &mut Shadows, handle: LightHandle, light: &Light, eye: &Eye) -> Result<(), StressError> {
    match light.kind {
        LightKind::Cascaded { .. } => Ok(shadows.set_eye(handle, eye)?),
        _ => Ok(()),
    }
}

fn set_pose(deformer: &mut Deformer, caster: DeformHandle, pose: &PartPose) -> Result<(), StressError> {
    let PartPose { joint_matrices, morph_weights, .. } = pose;
    Ok(deformer.set_pose(&DeformInput { caster, joint_matrices, morph_weights })?)
}
