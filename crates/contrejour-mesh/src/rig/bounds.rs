//! Boxes around what is deformed, without a look at each vertex.

use std::collections::BTreeMap;

use contrejour_layout::{Influence, MorphDelta};
use glam::{DMat4, DVec3};

/// What bounds the vertices of a deforming mesh in any pose: as much as there are joints and morph targets, however many
/// vertices they move.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct PoseBounds {
    /// Rest positions that no joint moves.
    still: Option<Box3>,
    /// Rest positions that a joint moves, by joint.
    of_joints: BTreeMap<u32, Box3>,
    /// Zero and all deltas, by morph target.
    of_morphs: BTreeMap<u32, Box3>,
    /// The largest sum of the magnitudes of a vertex's weights: more than 1 where some are negative.
    largest_weights: f64,
    most_influences: usize,
    most_deltas: usize,
}

/// A box that is not empty.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Box3 {
    min: DVec3,
    max: DVec3,
}

impl PoseBounds {
    /// Takes a vertex in.
    pub fn add(&mut self, position: [f32; 3], influences: &[Influence], morph_deltas: &[MorphDelta]) {
        let point = Box3::of_point(DVec3::from(position.map(f64::from)));
        if influences.is_empty() {
            self.still = point.with(self.still);
        }
        for influence in influences {
            let of_joint = self.of_joints.entry(influence.joint).or_insert(point);
            *of_joint = of_joint.union(&point);
        }
        for morph in morph_deltas {
            let delta = Box3::of_point(DVec3::from(morph.delta.map(f64::from)));
            let of_morph = self.of_morphs.entry(morph.morph_id).or_insert(Box3::of_point(DVec3::ZERO));
            *of_morph = of_morph.union(&delta);
        }
        let weights = influences.iter().map(|influence| f64::from(influence.weight.abs())).sum();
        self.largest_weights = self.largest_weights.max(weights);
        self.most_influences = self.most_influences.max(influences.len());
        self.most_deltas = self.most_deltas.max(morph_deltas.len());
    }

    /// A box of all vertices in a pose, as 32-bit floats leave them, in whatever order they add.
    ///
    /// The weights of a vertex add up to 1. Where none is negative, it is amid the places where each of its joints alone would
    /// put it; else it may be as much farther from the middle of those as the magnitudes of its weights are more than 1.
    pub fn posed(&self, joint_matrices: &[DMat4], morph_weights: &[f64]) -> [[f32; 3]; 2] {
        let mut shift = Box3::of_point(DVec3::ZERO);
        let mut shift_size = DVec3::ZERO;
        for (&morph, deltas) in &self.of_morphs {
            let weight = morph_weights[morph as usize];
            shift = shift.sum(&deltas.scaled(weight));
            shift_size += weight.abs() * deltas.size();
        }
        let weights = self.largest_weights.max(1.0);
        let mut skinned: Option<Box3> = None;
        // The largest magnitudes of what is added, and of the points that matrices move.
        let (mut size, mut point_size) = (DVec3::ZERO, DVec3::ZERO);
        let mut matrix_size = DVec3::ZERO;
        for (&joint, rest) in &self.of_joints {
            let matrix = &joint_matrices[joint as usize];
            let rest_size = rest.size() + shift_size;
            skinned = rest.sum(&shift).moved(matrix).with(skinned);
            size = size.max(weights * abs(matrix).transform_point3(rest_size));
            point_size = point_size.max(rest_size);
            matrix_size = matrix_size.max(abs(matrix).transform_vector3(DVec3::ONE));
        }
        let still = self.still.map(|still| {
            size = size.max(still.size() + shift_size);
            still.sum(&shift)
        });
        let skinned = skinned.map(|skinned| skinned.grown(weights));
        let Some(all) = skinned.or(still).and_then(|all| all.with(still)) else { return [[0.0; 3]; 2] };
        let margin = self.margin(size, DVec3::splat(point_size.max_element()) + matrix_size);
        let is_held = (size + margin).max(point_size).max_element() < f64::from(f32::MAX);
        // Where sums overflow, nobody knows to which side.
        let all = if is_held { all } else { Box3 { min: DVec3::MIN, max: DVec3::MAX } };
        let corner = |corner: DVec3| corner.clamp(DVec3::splat(f32::MIN.into()), DVec3::splat(f32::MAX.into()));
        [corner(all.min - margin), corner(all.max + margin)].map(|corner| corner.as_vec3().to_array())
    }

    /// What rounding may be off by: 2^-23 of a sum for each of its terms and for some more operations, twice over; and what
    /// is below 2^-126 may be taken for zero, before or after it is multiplied by one of the factors.
    fn margin(&self, size: DVec3, factors: DVec3) -> DVec3 {
        let terms = (4 * self.most_influences + 2 * self.most_deltas + 8) as f64;
        let flushed = f64::from(f32::MIN_POSITIVE) * (DVec3::ONE + size + factors);
        terms * (2.0 * f64::from(f32::EPSILON) * size + (1.0 + self.largest_weights) * flushed)
    }
}

impl Box3 {
    fn of_point(point: DVec3) -> Self {
        Self { min: point, max: point }
    }

    fn union(&self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    fn with(self, other: Option<Self>) -> Option<Self> {
        Some(other.map_or(self, |other| self.union(&other)))
    }

    /// All sums of a point here and one there.
    fn sum(&self, other: &Self) -> Self {
        Self { min: self.min + other.min, max: self.max + other.max }
    }

    fn scaled(&self, factor: f64) -> Self {
        let (min, max) = (factor * self.min, factor * self.max);
        Self { min: min.min(max), max: max.max(min) }
    }

    /// As much larger around its middle.
    fn grown(&self, factor: f64) -> Self {
        let (middle, half) = self.middle_and_half();
        Self { min: middle - factor * half, max: middle + factor * half }
    }

    /// A box around what an affine matrix makes of it.
    fn moved(&self, matrix: &DMat4) -> Self {
        let (middle, half) = self.middle_and_half();
        let (middle, half) = (matrix.transform_point3(middle), abs(matrix).transform_vector3(half));
        Self { min: middle - half, max: middle + half }
    }

    fn middle_and_half(&self) -> (DVec3, DVec3) {
        ((self.min + self.max) / 2.0, (self.max - self.min) / 2.0)
    }

    /// The largest magnitude of each coordinate.
    fn size(&self) -> DVec3 {
        self.min.abs().max(self.max.abs())
    }
}

fn abs(matrix: &DMat4) -> DMat4 {
    DMat4::from_cols_array(&matrix.to_cols_array().map(f64::abs))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{DeformingMesh, PartPose};

    fn pose(joint_matrices: Vec<DMat4>, morph_weights: Vec<f64>) -> PartPose {
        PartPose { world_from_object: DMat4::IDENTITY, joint_matrices, morph_weights }
    }

    /// Whether the box of a pose holds all vertices.
    fn holds(mesh: &DeformingMesh, pose: &PartPose) -> bool {
        let [min, max] = mesh
            .posed_bounds(&pose.joint_matrices, &pose.morph_weights)
            .map(|corner| DVec3::from(corner.map(f64::from)));
        mesh.posed(pose).into_iter().all(|point| point.cmpge(min).all() && point.cmple(max).all())
    }

    #[test]
    fn a_box_holds_what_joints_and_morphs_make() {
        let mut random = fastrand::Rng::with_seed(3);
        for round in 0..300 {
            let (joints, morphs) = (random.u32(1..6), random.u32(0..4));
            let mut mesh = DeformingMesh::new(joints, morphs);
            let mut number = |scale: f64| scale * (2.0 * random.f64() - 1.0);
            for vertex in 0..40_u32 {
                let position = [(); 3].map(|()| number(3.0) as f32);
                // In every third mesh some weights are negative; some vertices have none.
                let lowest = if round % 3 == 0 { -0.4 } else { 0.0 };
                let weights = [0, 1, 2].map(|step| ((vertex + step) % joints, number(1.0).max(lowest)));
                let sum: f64 = weights.iter().map(|(_, weight)| weight).sum();
                let influences = if sum.abs() > 0.2 { &weights[..] } else { &[] };
                let deltas: Vec<_> = (0..morphs).map(|morph| (morph, [(); 3].map(|()| number(1.0) as f32))).collect();
                mesh.push_vertex(position, influences, &deltas).expect("a good vertex");
            }
            let matrix = |number: &mut dyn FnMut(f64) -> f64| {
                let columns = [(); 4].map(|()| DVec3::new(number(2.0), number(2.0), number(2.0)));
                DMat4::from_cols(
                    columns[0].extend(0.0),
                    columns[1].extend(0.0),
                    columns[2].extend(0.0),
                    columns[3].extend(1.0),
                )
            };
            let joint_matrices = (0..joints).map(|_| matrix(&mut number)).collect();
            let pose = pose(joint_matrices, (0..morphs).map(|_| number(2.0)).collect());
            assert!(holds(&mesh, &pose), "round {round}: {pose:?}");
        }
    }

    #[test]
    fn it_is_no_larger_than_what_each_joint_makes() {
        let mut mesh = DeformingMesh::new(2, 1);
        mesh.push_vertex([1.0, 2.0, 3.0], &[(0, 1.0)], &[(0, [4.0, 0.0, 0.0])]).expect("a good vertex");
        mesh.push_vertex([-1.0, 0.0, 0.0], &[(1, 1.0)], &[]).expect("a good vertex");
        mesh.push_vertex([0.0, 8.0, 0.0], &[], &[]).expect("a good vertex");
        let up = DMat4::from_translation(DVec3::new(0.0, 0.0, 10.0));
        let [min, max] = mesh.posed_bounds(&[DMat4::IDENTITY, up], &[-0.5]);
        for (found, expected) in [(min, [-3.0, 0.0, -0.0]), (max, [1.0, 8.0, 10.0])] {
            for axis in 0..3 {
                assert!((found[axis] - expected[axis]).abs() < 1e-4, "{min:?} {max:?}");
            }
        }
        assert_eq!(DeformingMesh::new(1, 0).posed_bounds(&[up], &[]), [[0.0; 3]; 2]);
    }

    #[test]
    fn what_overflows_may_be_anywhere() {
        let mut mesh = DeformingMesh::new(1, 1);
        mesh.push_vertex([1e30, 0.0, 0.0], &[(0, 1.0)], &[(0, [1e30, 0.0, 0.0])]).expect("a good vertex");
        let everywhere = [[f32::MIN; 3], [f32::MAX; 3]];
        let [small, large] = [1e-20, 1e20].map(|scale| DMat4::from_scale(DVec3::splat(scale)));
        assert_eq!(mesh.posed_bounds(&[large], &[0.0]), everywhere);
        // Before a matrix makes it small.
        assert_eq!(mesh.posed_bounds(&[small], &[1e10]), everywhere);
        assert!(mesh.posed_bounds(&[small], &[1.0])[1][0] < 3e10);
    }
}
