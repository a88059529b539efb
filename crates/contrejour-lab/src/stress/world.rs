//! The casters and lights of a run on a device.

use std::sync::Arc;

use contrejour_gpu::{CasterHandle, CasterInput, LightHandle, MeshHandle, Positions, ShadowOptions, Shadows};
use contrejour_mesh::{BuildOptions, TopologyAwareMesh};
use contrejour_plan::{Light, ShadowSettings};
use contrejour_render::Gpu;
use glam::DMat4;

use super::error::StressError;
use super::options::StressOptions;
use super::paths::Path;
use crate::torus::torus;

/// Everything of a run that moves.
#[derive(Debug)]
pub(super) struct World {
    pub mesh: Arc<TopologyAwareMesh>,
    pub triangles: Vec<[u32; 3]>,
    casters: Vec<Path>,
    lights: Vec<Path>,
    options: StressOptions,
    room: f64,
}

/// A world on a device.
#[derive(Debug)]
pub(super) struct Placed {
    pub shadows: Shadows,
    pub casters: Vec<CasterHandle>,
    pub lights: Vec<LightHandle>,
}

impl World {
    pub fn new(options: &StressOptions) -> Result<Self, StressError> {
        options.check()?;
        let across = ((options.triangles_per_caster as f64 / 4.0).sqrt().round() as u32).max(3);
        let around = (options.triangles_per_caster as u32 / (2 * across)).max(3);
        let mesh = torus(around, across);
        let topology = TopologyAwareMesh::build(&mesh.positions, &mesh.triangles, &BuildOptions::default())?;
        // As crowded for any number of casters.
        let room = 2.0 * (options.casters as f64).cbrt().max(1.0);
        let mut random = fastrand::Rng::with_seed(options.seed);
        Ok(Self {
            mesh: Arc::new(topology),
            triangles: mesh.triangles,
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
        let mut shadows = Shadows::new(&gpu.device)?;
        let mesh: MeshHandle = shadows.add_mesh(Arc::clone(&self.mesh))?;
        let add = |shadows: &mut Shadows, world_from_object| {
            shadows.add_caster(&CasterInput { mesh, world_from_object, positions: Positions::OfMesh })
        };
        let casters = self.casters(frame).map(|place| add(&mut shadows, place)).collect::<Result<_, _>>()?;
        let options = ShadowOptions { settings: *self.settings(), ..ShadowOptions::default() };
        let lights = self.lights(frame).map(|light| shadows.add_light(&gpu.device, &light, &options));
        let lights = lights.collect::<Result<_, _>>()?;
        Ok(Placed { shadows, casters, lights })
    }
}

impl Placed {
    /// Moves everything to where it is in a frame.
    pub fn walk(&mut self, world: &World, frame: u64) -> Result<(), StressError> {
        for (caster, place) in self.casters.iter().zip(world.casters(frame)) {
            self.shadows.place_caster(*caster, &place)?;
        }
        for (handle, light) in self.lights.iter().zip(world.lights(frame)) {
            self.shadows.set_light(*handle, &light)?;
        }
        Ok(())
    }
}
