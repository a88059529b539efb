//! The casters and lights of a run on a device.

use std::sync::Arc;

use contrejour_gpu::{
    CasterHandle, CasterInput, DeformHandle, DeformInput, Deformer, LightHandle, Positions, ShadowOptions, Shadows,
};
use contrejour_mesh::{BuildOptions, PartPose, TopologyAwareMesh};
use contrejour_plan::{Light, ShadowSettings};
use contrejour_render::Gpu;
use glam::DMat4;

use super::error::StressError;
use super::flexible::Flexible;
use super::options::StressOptions;
use super::paths::Path;
use crate::torus::torus;

/// Everything of a run that moves.
#[derive(Debug)]
pub(super) struct World {
    pub mesh: Arc<TopologyAwareMesh>,
    pub triangles: Vec<[u32; 3]>,
    pub flexible: Flexible,
    casters: Vec<Path>,
    lights: Vec<Path>,
    options: StressOptions,
    room: f64,
}

/// A world on a device.
#[derive(Debug)]
pub(super) struct Placed {
    pub shadows: Shadows,
    pub deformer: Deformer,
    pub casters: Vec<CasterHandle>,
    pub lights: Vec<LightHandle>,
    flexible: Vec<DeformHandle>,
}

/// One caster in so many deforms.
pub(super) const FLEXIBLE_OF: usize = 4;

/// Whether the caster of an index deforms.
pub(super) fn is_flexible(index: usize) -> bool {
    index % FLEXIBLE_OF == FLEXIBLE_OF - 1
}

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
        Ok(Self {
            mesh: Arc::new(topology),
            triangles: mesh.triangles,
            flexible,
            casters: (0..options.casters).map(|index| Path::of_caster(&mut random, index, room)).collect(),
            lights: (0..options.lights).map(|_| Path::of_light(&mut random)).collect(),
            options: options.clone(),
            room,
        })
    }

    /// World space from each caster's object space in a frame.
    pub fn casters(&self, frame: u64) -> impl Iterator<Item = DMat4> {
        self.casters.iter().map(move |path| path.matrix(frame))
    }

    /// The poses of the casters that deform, in their order.
    pub fn poses(&self, frame: u64) -> Vec<PartPose> {
        let flexible = self.casters.iter().enumerate().filter(|(index, _)| is_flexible(*index));
        flexible.map(|(_, path)| self.flexible.pose(path.swing(frame))).collect()
    }

    /// The lights in a frame.
    pub fn lights(&self, frame: u64) -> impl Iterator<Item = Light> {
        let light = move |(index, path): (usize, &Path)| self.options.kind.light(index, path.place(frame), self.room);
        self.lights.iter().enumerate().map(light)
    }

    pub fn settings(&self) -> &ShadowSettings {
        &self.options.settings
    }

    /// The world as it is in a frame.
    pub fn place(&self, gpu: &Gpu, frame: u64) -> Result<Placed, StressError> {
        let mut deformer = Deformer::new(&gpu.device)?;
        let poses = self.poses(frame);
        let flexible = poses.iter().map(|_| deformer.add(Arc::clone(&self.flexible.deforming)));
        let flexible = flexible.collect::<Result<Vec<_>, _>>()?;
        deformer.prepare(&gpu.device, &gpu.queue, &inputs(&flexible, &poses))?;

        let mut shadows = Shadows::new(&gpu.device)?;
        let rigid_mesh = shadows.add_mesh(Arc::clone(&self.mesh))?;
        let flexible_mesh = shadows.add_mesh(Arc::clone(&self.flexible.topology))?;
        let mut casters = Vec::new();
        for (index, world_from_object) in self.casters(frame).enumerate() {
            let positions = is_flexible(index).then(|| deformer.positions(flexible[index / FLEXIBLE_OF])).flatten();
            let mesh = if positions.is_some() { flexible_mesh } else { rigid_mesh };
            let positions = positions.unwrap_or_default();
            casters.push(shadows.add_caster(&CasterInput { mesh, world_from_object, positions })?);
        }
        let options = ShadowOptions { settings: *self.settings(), ..ShadowOptions::default() };
        let lights = self.lights(frame).map(|light| shadows.add_light(&gpu.device, &light, &options));
        let lights = lights.collect::<Result<_, _>>()?;
        Ok(Placed { shadows, deformer, casters, lights, flexible })
    }
}

impl Placed {
    /// Moves everything to where it is in a frame.
    pub fn walk(&mut self, gpu: &Gpu, world: &World, frame: u64) -> Result<(), StressError> {
        let poses = world.poses(frame);
        self.deformer.prepare(&gpu.device, &gpu.queue, &inputs(&self.flexible, &poses))?;
        for (caster, place) in self.casters.iter().zip(world.casters(frame)) {
            self.shadows.place_caster(*caster, &place)?;
        }
        for (handle, light) in self.lights.iter().zip(world.lights(frame)) {
            self.shadows.set_light(*handle, &light)?;
        }
        Ok(())
    }

    /// Where the positions of the casters that deform are, in their order.
    pub fn flexible_positions(&self) -> impl Iterator<Item = Positions> {
        self.flexible.iter().filter_map(|handle| self.deformer.positions(*handle))
    }
}

fn inputs<'a>(flexible: &[DeformHandle], poses: &'a [PartPose]) -> Vec<DeformInput<'a>> {
    let input = |(caster, pose): (&DeformHandle, &'a PartPose)| DeformInput {
        caster: *caster,
        joint_matrices: &pose.joint_matrices,
        morph_weights: &pose.morph_weights,
    };
    flexible.iter().zip(poses).map(input).collect()
}
