//! What `contrejour render` draws: a scene that stands still, or a model in motion.

use std::path::Path;

use contrejour_gpu::ShadowOptions;
use contrejour_plan::Light;
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
    /// The light goes around in so many.
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

    /// The scene's light in a frame.
    pub fn light(self, scene: &Scene, frame: u32) -> Result<Light, Failure> {
        let light = &scene.first_light()?.light;
        Ok(match self {
            Self::Orbit(frames) => orbit(light, frame, frames),
            Self::Picture | Self::Animation(_) => *light,
        })
    }
}

impl Drawn {
    /// Opens what the arguments name.
    pub fn open(arguments: &RenderArguments) -> Result<Self, Failure> {
        let (Some(animation), Some(path)) = (&arguments.animation, &arguments.scene) else {
            return Ok(Self::Still(Box::new(scenes::open(arguments.scene.as_deref())?)));
        };
        let times = arguments.animate.map_or(FrameTimes::At(arguments.time.unwrap_or_default()), FrameTimes::Even);
        Ok(Self::Moving(Box::new(AnimatedScene::open(Path::new(path), animation, times)?)))
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

    pub fn renderer(&self, gpu: Gpu, options: &ShadowOptions) -> Result<Renderer, NewRendererError> {
        match self {
            Self::Still(scene) => Renderer::new(gpu, scene, options),
            Self::Moving(animated) => Renderer::new_animated(gpu, animated, options),
        }
    }

    /// Moves the model for a frame, where it moves.
    pub fn pose(&self, renderer: &mut Renderer, sequence: Sequence, frame: u32) -> Result<(), Failure> {
        if let (Self::Moving(animated), Sequence::Animation(_)) = (self, sequence) {
            renderer.pose(animated, animated.time(frame))?;
        }
        Ok(())
    }
}
