//! One generated mesh under a light, alone.

use std::sync::Arc;

use contrejour_mesh::{BuildOptions, MeshFile, TopologyAwareMesh};
use contrejour_plan::{Light, ShadowSettings};
use contrejour_scene::shapes::Shape;
use contrejour_scene::{MeshSource, Scene, SceneLight};
use glam::DMat4;

use super::super::super::error::RunError;
use super::super::methods::THIN;
use crate::mirror_frame::MirrorFrame;

/// Texels of the map that the geometry is made for: the width of smoothies has a floor in texels.
pub(super) const MAP_SIZE: u32 = 1024;

/// A mesh, its topology and the scene around it.
pub(in super::super) struct LoneMesh {
    /// A scene with this mesh and no floor.
    pub scene: Scene,
    pub light: Light,
    pub shadow: ShadowSettings,
    pub topology: Arc<TopologyAwareMesh>,
}

impl LoneMesh {
    pub fn new(shape: &Shape) -> Result<Self, RunError> {
        let mesh = shape.generate()?;
        let topology = TopologyAwareMesh::build(&mesh.positions, &mesh.triangles, &BuildOptions::default())?;
        let mut scene = Scene::around(MeshFile::single(mesh, Vec::new()));
        scene.meshes.retain(|placed| placed.source == MeshSource::Given);
        let SceneLight { light, shadow, .. } = *scene.first_light()?;
        Ok(Self { scene, light, shadow, topology: Arc::new(topology) })
    }

    /// A torus of about that many faces, whose triangles are about as long as they are wide.
    pub fn torus(faces: u32) -> Result<Self, RunError> {
        let sides = (f64::from(faces) / 4.0).sqrt().round() as u32;
        Self::new(&Shape::Torus { radius: 1.0, tube_radius: 0.4, segments: 2 * sides, sides })
    }

    /// The mesh under a light, for the twins of the stages.
    pub fn mirror_frame(&self, light: &Light) -> Result<MirrorFrame<'_>, RunError> {
        let settings = THIN.settings(&self.shadow, MAP_SIZE);
        Ok(MirrorFrame::new(&[(&self.topology, DMat4::IDENTITY)], light, &settings)?)
    }

    pub fn faces(&self) -> f64 {
        self.topology.faces.len() as f64
    }

    /// Edges that can be in a silhouette.
    pub fn edges(&self) -> f64 {
        f64::from(self.topology.candidate_edge_count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_torus_is_closed_and_has_about_the_faces_asked_for() {
        for faces in [1000, 100_000] {
            let torus = LoneMesh::torus(faces).expect("a torus");
            assert!((torus.faces() / f64::from(faces) - 1.0).abs() < 0.05, "{}", torus.faces());
            assert!(torus.topology.report.closed);
            assert_eq!(torus.scene.meshes.len(), 1);
        }
    }
}
