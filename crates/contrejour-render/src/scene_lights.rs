//! The lights of a scene that is drawn.

use contrejour_gpu::LightHandle;
use contrejour_plan::{Light, LightError};
use contrejour_scene::{Scene, SceneLight};

use crate::LocalSpace;
use crate::casters::CastShadows;
use crate::error::NewRendererError;
use crate::surface_light::SurfaceLight;

/// The lights, as the scene, the device's maps and the picture's shader have them.
#[derive(Debug)]
pub(crate) struct SceneLights {
    lights: Vec<SceneLight>,
    /// In local space.
    local: Vec<Light>,
    /// Of those that cast.
    pub handles: Vec<Option<LightHandle>>,
    pub records: Vec<SurfaceLight>,
    exposure: f64,
}

/// What is asked for is not in the scene, or can't be there.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MoveError {
    /// There is no such light.
    #[error("there is no light {index}, the scene has {count}; they are counted from 0")]
    NoSuchLight {
        /// What was asked for.
        index: usize,
        /// How many lights there are.
        count: usize,
    },
    /// There is no such mesh.
    #[error("there is no mesh {index}, the scene has {count}; they are counted from 0")]
    NoSuchMesh {
        /// What was asked for.
        index: usize,
        /// How many meshes there are.
        count: usize,
    },
    /// The light is no light.
    #[error(transparent)]
    Light(#[from] LightError),
    /// A matrix holds an infinite number or none.
    #[error("the matrix of mesh {index} is not finite; give finite numbers")]
    NotFinite {
        /// The mesh.
        index: usize,
    },
}

impl SceneLights {
    /// Checks the scene's lights, and gives those that cast their shadows.
    pub fn new(scene: &Scene, local: &LocalSpace, cast: &mut CastShadows) -> Result<Self, NewRendererError> {
        let mut lights = Self {
            lights: scene.lights.clone(),
            local: scene.lights.iter().map(|light| local.light(&light.light)).collect(),
            handles: Vec::new(),
            records: Vec::new(),
            exposure: scene.exposure(),
        };
        for (light, light_local) in lights.lights.iter().zip(&lights.local) {
            light.validate()?;
            let handle = light.casts.then(|| cast.add_light(light_local, &light.shadow)).transpose()?;
            lights.handles.push(handle);
            lights.records.push(SurfaceLight::new(light, local, lights.exposure));
        }
        Ok(lights)
    }

    /// Moves or changes a light.
    pub fn set(&mut self, index: usize, light: &Light, local: &LocalSpace) -> Result<(), MoveError> {
        let count = self.lights.len();
        let changed = self.lights.get_mut(index).ok_or(MoveError::NoSuchLight { index, count })?;
        light.validate()?;
        changed.light = *light;
        self.local[index] = local.light(light);
        self.records[index] = SurfaceLight::new(changed, local, self.exposure);
        Ok(())
    }

    /// Those that cast, in local space.
    pub fn casting(&self) -> impl Iterator<Item = (LightHandle, &Light)> {
        self.handles.iter().zip(&self.local).filter_map(|(handle, light)| Some(((*handle)?, light)))
    }

    /// Those that cast, by their index.
    pub fn casting_indices(&self) -> impl Iterator<Item = (usize, LightHandle)> {
        self.handles.iter().enumerate().filter_map(|(index, handle)| Some((index, (*handle)?)))
    }

    /// A light in local space.
    pub fn local(&self, index: usize) -> &Light {
        &self.local[index]
    }

    pub fn count(&self) -> usize {
        self.lights.len()
    }
}
