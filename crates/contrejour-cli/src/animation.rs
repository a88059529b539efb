//! What `contrejour render` draws: a scene that stands still, or a model in motion.

use std::path::Path;

use contrejour_render::{Gpu, NewRendererError, Renderer};
use contrejour_scene::{AnimatedScene, FrameTimes, Scene, orbit};

use crate::args::RenderArguments;
use crate::failure::Failure;
use crate::scenes;

/// What is drawn.
pub enum Drawn {
    Still(Box<Scene>),
    Moving(Box<AnimatedScene>),
}

/// How many frames there are, and what moves in them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sequence {
    /// One frame, in which nothing does.
    Picture,
    /// The lights go around in so many.
    Orbit(u32),
    /// The model plays its animation in so many.
    Animation(u32),
}

impl Sequence {
    pub fn of(arguments: &RenderArguments) -> Self {
        match (arguments.orbit, arguments.animate) {
            (Some(frames), _) => Self::Orbit(frames),
            (None, Some(frames)) => Self::Animation(frames),
            (None, None) => Self::Picture,
        }
    }

    /// Number of frames whose pictures have names of their own; none for a picture alone.
    pub fn frames(self) -> Option<u32> {
        match self {
            Self::Picture => None,
            Self::Orbit(frames) | Self::Animation(frames) => Some(frames),
        }
    }

    /// Moves the scene's lights to where they are in a frame: all of them orbit, each about what it aims at.
    pub fn move_lights(self, renderer: &mut Renderer, scene: &Scene, frame: u32) -> Result<(), Failure> {
        if let Self::Orbit(frames) = self {
            for (index, light) in scene.lights.iter().enumerate() {
                renderer.set_light(index, &orbit(&light.light, frame, frames))?;
            }
        }
        Ok(())
    }
}

impl Drawn {
    /// Opens what the arguments name.
    pub fn open(arguments: &RenderArguments) -> Result<Self, Failure> {
        let (Some(animation), Some(path)) = (&arguments.animation, &arguments.scene) else {
            return Ok(Self::Still(Box::new(scenes::open_seen_by(
                arguments.scene.as_deref(),
                arguments.camera.as_deref(),
            )?)));
        };
        let times = arguments.animate.map_or(FrameTimes::At(arguments.time.unwrap_or_default()), FrameTimes::Even);
        Ok(Self::Moving(Box::new(AnimatedScene::open(Path::new(path), arguments.camera.as_deref(), animation, times)?)))
    }

    pub fn scene(&self) -> &Scene {
        match self {
            Self::Still(scene) => scene,
            Self::Moving(animated) => &animated.scene,
        }
    }

    pub fn scene_mut(&mut self) -> &mut Scene {
        match self {
            Self::Still(scene) => scene,
            Self::Moving(animated) => &mut animated.scene,
        }
    }

    pub fn renderer(&self, gpu: Gpu) -> Result<Renderer, NewRendererError> {
        match self {
            Self::Still(scene) => Renderer::new(gpu, scene),
            Self::Moving(animated) => Renderer::new_animated(gpu, animated),
        }
    }

    /// Moves the model for a frame, where it moves.
    pub fn pose(&self, renderer: &mut Renderer, sequence: Sequence, frame: u32) -> Result<(), Failure> {
        if let (Self::Moving(animated), Sequence::Animation(_)) = (self, sequence) {
            let posed = renderer.pose(animated, animated.time(frame));
            posed.map_err(|error| format!("{}: {error}", animated.path().display()))?;
        }
        Ok(())
    }
}
