//! A mesh that two joints bend and a morph target swells.

use std::sync::Arc;

use contrejour_mesh::{BuildOptions, DeformingMesh, Motion, PartPose, TopologyAwareMesh};
use glam::{DMat4, DVec3};

use super::error::StressError;
use crate::torus::Triangles;

/// The mesh of the casters that deform.
#[derive(Debug)]
pub(super) struct Flexible {
    pub deforming: Arc<DeformingMesh>,
    pub topology: Arc<TopologyAwareMesh>,
}

impl Flexible {
    /// A torus whose vertices follow two joints by where they are along x, and swell along y.
    pub fn new(torus: &Triangles) -> Result<Self, StressError> {
        let mut deforming = DeformingMesh::new(2, 1);
        for position in &torus.positions {
            let [x, y, _] = position.map(f64::from);
            let share = (0.5 + 0.4 * x).clamp(0.0, 1.0);
            let swollen = [0.0, 0.5 * y as f32, 0.0];
            deforming.push_vertex(*position, &[(0, 1.0 - share), (1, share)], &[(0, swollen)])?;
        }
        let options = BuildOptions { motion: Motion::Deforming, ..BuildOptions::default() };
        let topology = TopologyAwareMesh::build(&torus.positions, &torus.triangles, &options)?;
        Ok(Self { deforming: Arc::new(deforming), topology: Arc::new(topology) })
    }

    /// The pose at a place and an angle of its swing.
    pub fn pose(&self, world_from_object: DMat4, angle: f64) -> PartPose {
        let bend = |turn: f64| DMat4::from_rotation_z(turn) * DMat4::from_translation(DVec3::Y * (0.1 * turn));
        PartPose {
            world_from_object,
            joint_matrices: vec![bend(-0.5 * angle.sin()), bend(0.7 * (1.3 * angle).sin())],
            morph_weights: vec![0.5 + 0.5 * angle.cos()],
        }
    }
}
