//! A model in motion, set up like a lone mesh.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use contrejour_mesh::{
    AnimatedModel, Animation, DeformingMesh, LoadError, PartPose, Pose, PoseError, TriangleMesh, UnknownAnimation,
    load_animated,
};
use contrejour_plan::Light;
use glam::DVec3;

use crate::file_scene::{FileView, UnknownCamera};
use crate::scene::placed_meshes;
use crate::{Bounds, Camera, MeshSource, Scene};

/// Times that a scene is fitted to, at most.
const MOST_FITTED: u32 = 256;

/// A model that an animation moves, on a floor and in a light that fit all of its frames.
#[derive(Clone, Debug)]
pub struct AnimatedScene {
    /// The scene in the first frame. Its first meshes are those of the model.
    pub scene: Scene,
    path: PathBuf,
    model: AnimatedModel,
    animation: usize,
    times: FrameTimes,
    /// The file's camera and lights at rest.
    view: FileView,
    /// Around all meshes in all frames.
    bounds: Bounds,
}

/// Where everything of a scene is at a time.
#[derive(Clone, Debug)]
pub struct SceneFrame {
    /// Poses of the scene's first meshes.
    pub poses: Vec<PartPose>,
    /// Its camera.
    pub camera: Camera,
    /// Its lights, in their order.
    pub lights: Vec<Light>,
}

/// The times of the frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FrameTimes {
    /// One frame at a time. Unit: seconds.
    At(f64),
    /// So many frames, evenly over the animation's length; the first is at 0, and the last one before the end, which is
    /// the first again where an animation goes round.
    Even(u32),
}

impl FrameTimes {
    /// Time of a frame of an animation of this length, in seconds.
    pub fn time(self, frame: u32, duration: f64) -> f64 {
        match self {
            Self::At(time) => time,
            Self::Even(frames) => duration * f64::from(frame) / f64::from(frames.max(1)),
        }
    }

    fn fitted(self, duration: f64) -> Vec<f64> {
        match self {
            Self::At(time) => vec![time],
            Self::Even(frames) => {
                let count = frames.min(MOST_FITTED);
                (0..count).map(|step| Self::Even(count).time(step, duration)).collect()
            }
        }
    }
}

/// Why a model does not move.
#[derive(Debug, thiserror::Error)]
pub enum AnimatedSceneError {
    /// The file is not loaded.
    #[error(transparent)]
    Mesh(#[from] LoadError),
    /// The file has no such camera.
    #[error("{}: {source}", path.display())]
    UnknownCamera {
        /// The file.
        path: PathBuf,
        /// The name, and those that there are.
        source: UnknownCamera,
    },
    /// The file has no such animation.
    #[error("{}: {source}", path.display())]
    Unknown {
        /// The file.
        path: PathBuf,
        /// The name, and those that there are.
        source: UnknownAnimation,
    },
    /// A frame has no pose.
    #[error("{}: {source}", path.display())]
    Pose {
        /// The file.
        path: PathBuf,
        /// Where it has none.
        source: PoseError,
    },
}

impl AnimatedScene {
    /// Loads a mesh file and sets up the frames of one of its animations, seen by one of its cameras: the first, or the one
    /// of a name. Cameras and lights go with their nodes; the exposure is that of the first frame.
    ///
    /// # Errors
    ///
    /// The file is not loaded, has no camera or animation of the name, or one of its frames has no pose.
    pub fn open(
        path: &Path,
        camera: Option<&str>,
        animation: &str,
        times: FrameTimes,
    ) -> Result<Self, AnimatedSceneError> {
        let model = load_animated(path)?;
        let view = FileView::of(&model.file, camera)
            .map_err(|source| AnimatedSceneError::UnknownCamera { path: path.into(), source })?;
        let unknown = |source| AnimatedSceneError::Unknown { path: path.into(), source };
        let duration = model.rig.animation(animation).map_err(unknown)?.duration;
        let is_named = |known: &Animation| known.name == animation;
        let animation = model.rig.animations.iter().position(is_named).unwrap_or_default();
        let posed = |source| AnimatedSceneError::Pose { path: path.into(), source };
        let pose_at = |time| model.rig.pose(Some(&model.rig.animations[animation]), time).map_err(posed);

        let mut bounds = Bounds::EMPTY;
        for time in times.fitted(duration) {
            bounds = bounds.union(bounds_of(&model, &part_poses(&model, &pose_at(time)?)));
        }
        let mut meshes = placed_meshes(model.file.clone(), &MeshSource::File(path.to_owned()));
        let first_time = times.time(0, duration);
        let first = pose_at(first_time)?;
        for ((mesh, pose), part) in meshes.iter_mut().zip(&part_poses(&model, &first)).zip(&model.rig.parts) {
            mesh.world_from_object = pose.world_from_object;
            if let Some(deforming) = &part.deforming {
                let positions = deforming.posed(pose).iter().map(|position| position.as_vec3().to_array()).collect();
                mesh.mesh = Arc::new(TriangleMesh { positions, ..(*mesh.mesh).clone() });
            }
        }
        let mut scene = view.posed(&first, first_time).map_err(posed)?.scene(meshes, bounds);
        scene.warnings.splice(0..0, model.file.warnings.iter().cloned());
        Ok(Self { scene, path: path.to_owned(), model, animation, times, view, bounds })
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Time of a frame, in seconds.
    pub fn time(&self, frame: u32) -> f64 {
        self.times.time(frame, self.animation().duration)
    }

    /// The animation that moves the model.
    pub fn animation(&self) -> &Animation {
        &self.model.rig.animations[self.animation]
    }

    /// Where everything is at a time, in seconds.
    ///
    /// # Errors
    ///
    /// A number overflows, or a camera or a light is left without a direction.
    pub fn frame(&self, time: f64) -> Result<SceneFrame, PoseError> {
        let pose = self.model.rig.pose(Some(self.animation()), time)?;
        let (camera, mut lights) = self.view.posed(&pose, time)?.seen_and_lit(self.bounds);
        if lights.is_empty() {
            lights = self.scene.lights.iter().map(|light| light.light).collect();
        }
        let camera = camera.unwrap_or(self.scene.camera);
        Ok(SceneFrame { poses: part_poses(&self.model, &pose), camera, lights })
    }

    /// What moves the vertices of a mesh of the scene against each other; none where nothing does.
    pub fn deforming(&self, mesh: usize) -> Option<&Arc<DeformingMesh>> {
        self.model.rig.parts.get(mesh)?.deforming.as_ref()
    }

    /// The mesh of the model that a mesh of the scene is a pose of, at rest.
    pub fn rest_mesh(&self, mesh: usize) -> Option<&TriangleMesh> {
        self.model.file.meshes.get(self.model.file.nodes.get(mesh)?.mesh)
    }
}

fn part_poses(model: &AnimatedModel, pose: &Pose) -> Vec<PartPose> {
    model.rig.parts.iter().map(|part| model.rig.part_pose(part, pose)).collect()
}

/// The box around all meshes of a pose, in world space.
fn bounds_of(model: &AnimatedModel, poses: &[PartPose]) -> Bounds {
    let parts = model.rig.parts.iter().zip(&model.file.nodes).zip(poses);
    let of_part = parts.map(|((part, node), pose)| {
        let place = |position: DVec3| pose.world_from_object.transform_point3(position);
        match &part.deforming {
            Some(deforming) => Bounds::of(deforming.posed(pose).into_iter().map(place)),
            None => {
                let positions = &model.file.meshes[node.mesh].positions;
                Bounds::of(positions.iter().map(|position| place(DVec3::from(position.map(f64::from)))))
            }
        }
    });
    of_part.fold(Bounds::EMPTY, Bounds::union)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_frames_do_not_repeat_the_first() {
        let times: Vec<_> = (0..4).map(|frame| FrameTimes::Even(4).time(frame, 2.0)).collect();
        assert_eq!(times, [0.0, 0.5, 1.0, 1.5]);
        assert_eq!(FrameTimes::At(7.0).time(3, 2.0), 7.0);
        assert_eq!(FrameTimes::Even(100_000).fitted(2.0).len(), 256);
    }

    #[test]
    fn a_file_without_animations_says_so() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/meshes/knot.obj");
        let error = AnimatedScene::open(&folder, None, "Walk", FrameTimes::At(0.0)).expect_err("it is an OBJ");
        assert!(error.to_string().ends_with(r#"knot.obj: there is no animation "Walk"; the file has none"#), "{error}");
    }
}
