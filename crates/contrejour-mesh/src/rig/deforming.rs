//! A mesh whose vertices move against each other: what moves each of them.

use std::cmp::Ordering;

use contrejour_layout::{Influence, MorphDelta, RestVertex};
use glam::{DMat4, DVec3};
use rayon::prelude::*;

use super::PartPose;
use super::bounds::PoseBounds;
use crate::{BuildOptions, Motion, TopologyAwareMesh, TopologyError};

/// The vertices of a mesh before anything moves them, and the joints and morph targets that do.
///
/// Lists are sparse: a vertex lists the joints and the targets that move it, as many as there are. They are in one order,
/// so vertices that are moved alike have equal lists, and every machine moves them to the same place.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DeformingMesh {
    vertices: Vec<RestVertex>,
    influences: Vec<Influence>,
    morph_deltas: Vec<MorphDelta>,
    joint_count: u32,
    morph_count: u32,
    bounds: PoseBounds,
}

/// Why a vertex is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DeformingMeshError {
    /// A number is NaN, infinite or too large for 32 bits.
    #[error("a position, a weight or a morph delta is not a finite 32-bit number; correct it")]
    NotFinite,
    /// A vertex names a joint that does not exist.
    #[error("names joint {joint}, and there are {count}; correct the index")]
    NoSuchJoint {
        /// The joint.
        joint: u32,
        /// How many there are.
        count: u32,
    },
    /// A vertex names a morph target that does not exist.
    #[error("names morph target {morph_id}, and there are {count}; correct the index")]
    NoSuchMorphTarget {
        /// The morph target.
        morph_id: u32,
        /// How many there are.
        count: u32,
    },
    /// More influences or deltas than 32 bits can index.
    #[error("has more influences or morph deltas than 4294967295; split the mesh")]
    TooMany,
}

impl DeformingMesh {
    /// A mesh without vertices that so many joints and morph targets move.
    pub fn new(joint_count: u32, morph_count: u32) -> Self {
        Self { joint_count, morph_count, ..Self::default() }
    }

    /// Adds a vertex at a position in the space in which the mesh is bound, with pairs of a joint and its weight, and
    /// pairs of a morph target and what it adds at weight 1, in any order.
    ///
    /// Weights are divided by their sum; a vertex without any weight is moved by no joint.
    ///
    /// # Errors
    ///
    /// [`DeformingMeshError`]; the mesh is as before.
    pub fn push_vertex(
        &mut self,
        position: [f32; 3],
        influences: &[(u32, f64)],
        morph_deltas: &[(u32, [f32; 3])],
    ) -> Result<(), DeformingMeshError> {
        let influences = self.influences_in_order(influences)?;
        let morph_deltas = self.morph_deltas_in_order(morph_deltas)?;
        if !position.iter().all(|coordinate| coordinate.is_finite()) {
            return Err(DeformingMeshError::NotFinite);
        }
        let index = |count: usize| u32::try_from(count).map_err(|_| DeformingMeshError::TooMany);
        let vertex = RestVertex {
            // Of both zeros one, so that vertices that weld have equal bits.
            position: position.map(|coordinate| coordinate + 0.0),
            first_influence: index(self.influences.len())?,
            influence_count: index(influences.len())?,
            first_morph_delta: index(self.morph_deltas.len())?,
            morph_delta_count: index(morph_deltas.len())?,
            unused_0: 0,
        };
        self.bounds.add(vertex.position, &influences, &morph_deltas);
        self.vertices.push(vertex);
        self.influences.extend(influences);
        self.morph_deltas.extend(morph_deltas);
        Ok(())
    }

    /// Adds a vertex that moves as an earlier one does.
    ///
    /// # Panics
    ///
    /// When there is no such vertex.
    pub fn repeat_vertex(&mut self, vertex: u32) {
        self.vertices.push(self.vertices[vertex as usize]);
    }

    /// The vertices.
    pub fn vertices(&self) -> &[RestVertex] {
        &self.vertices
    }

    /// The influences of all vertices.
    pub fn influences(&self) -> &[Influence] {
        &self.influences
    }

    /// The morph deltas of all vertices.
    pub fn morph_deltas(&self) -> &[MorphDelta] {
        &self.morph_deltas
    }

    /// Number of joints that a pose must have.
    pub fn joint_count(&self) -> u32 {
        self.joint_count
    }

    /// Number of morph targets whose weights a pose must have.
    pub fn morph_count(&self) -> u32 {
        self.morph_count
    }

    /// The positions of all vertices in a pose, in object space, by 64-bit floats.
    ///
    /// # Panics
    ///
    /// When the pose is of another mesh: it has too few joints or weights.
    pub fn posed(&self, pose: &PartPose) -> Vec<DVec3> {
        self.vertices.par_iter().map(|vertex| self.posed_vertex(vertex, pose)).collect()
    }

    /// A box of the positions in a pose, as a device's 32-bit floats leave them: its smallest and its largest corner, in object
    /// space. It costs as much as the mesh has joints and morph targets, whatever its number of vertices, and is larger
    /// than the smallest one: it holds what each joint alone would make of all that it moves.
    ///
    /// # Panics
    ///
    /// When the pose is of another mesh: there are too few matrices or weights.
    pub fn posed_bounds(&self, joint_matrices: &[DMat4], morph_weights: &[f64]) -> [[f32; 3]; 2] {
        self.bounds.posed(joint_matrices, morph_weights)
    }

    fn posed_vertex(&self, vertex: &RestVertex, pose: &PartPose) -> DVec3 {
        let mut position = DVec3::from(vertex.position.map(f64::from));
        for morph in self.morph_deltas_of(vertex) {
            position += pose.morph_weights[morph.morph_id as usize] * DVec3::from(morph.delta.map(f64::from));
        }
        let influences = self.influences_of(vertex);
        if influences.is_empty() {
            return position;
        }
        let weighted = influences.iter().map(|influence| {
            let joint_matrix: DMat4 = pose.joint_matrices[influence.joint as usize];
            joint_matrix * f64::from(influence.weight)
        });
        weighted.fold(DMat4::ZERO, |sum, matrix| sum + matrix).transform_point3(position)
    }

    /// What is to be welded together: equal bytes for vertices that move alike, 4 bytes a vertex, for
    /// [`BuildOptions::weld_data`].
    pub fn weld_data(&self) -> Vec<u8> {
        let mut order: Vec<u32> = (0..self.vertices.len() as u32).collect();
        order.par_sort_unstable_by(|&a, &b| self.compare(a, b).then(a.cmp(&b)));
        let mut classes = vec![0_u32; self.vertices.len()];
        for alike in order.chunk_by(|&a, &b| self.compare(a, b) == Ordering::Equal) {
            alike.iter().for_each(|&vertex| classes[vertex as usize] = alike[0]);
        }
        bytemuck::cast_slice(&classes).to_vec()
    }

    /// The topology of a mesh whose vertices move like these: every edge stays a candidate, and only what moves alike is
    /// welded.
    ///
    /// # Errors
    ///
    /// [`TopologyError`], also where the mesh has another number of vertices.
    pub fn topology(&self, positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<TopologyAwareMesh, TopologyError> {
        let weld_data = self.weld_data();
        if positions.len() != self.vertices.len() {
            return Err(TopologyError::UnevenWeldData { bytes: weld_data.len(), vertices: positions.len() });
        }
        let options =
            BuildOptions { motion: Motion::Deforming, weld_data: Some(&weld_data), ..BuildOptions::default() };
        TopologyAwareMesh::build(positions, triangles, &options)
    }

    /// An order in which only vertices that move alike are equal.
    fn compare(&self, a: u32, b: u32) -> Ordering {
        let key = |vertex: u32| {
            let vertex = &self.vertices[vertex as usize];
            let influences: &[u32] = bytemuck::cast_slice(self.influences_of(vertex));
            let morph_deltas: &[u32] = bytemuck::cast_slice(self.morph_deltas_of(vertex));
            (vertex.position.map(f32::to_bits), influences, morph_deltas)
        };
        key(a).cmp(&key(b))
    }

    fn influences_of(&self, vertex: &RestVertex) -> &[Influence] {
        &self.influences[vertex.first_influence as usize..][..vertex.influence_count as usize]
    }

    fn morph_deltas_of(&self, vertex: &RestVertex) -> &[MorphDelta] {
        &self.morph_deltas[vertex.first_morph_delta as usize..][..vertex.morph_delta_count as usize]
    }

    /// By joint, each once, with weights that add up to 1.
    fn influences_in_order(&self, influences: &[(u32, f64)]) -> Result<Vec<Influence>, DeformingMeshError> {
        let mut in_order: Vec<(u32, f64)> = influences.iter().copied().filter(|&(_, weight)| weight != 0.0).collect();
        if let Some(&(joint, _)) = in_order.iter().find(|&&(joint, _)| joint >= self.joint_count) {
            return Err(DeformingMeshError::NoSuchJoint { joint, count: self.joint_count });
        }
        in_order.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let sum: f64 = in_order.iter().map(|&(_, weight)| weight).sum();
        if sum == 0.0 {
            return Ok(Vec::new());
        }
        let of_joint = |of_joint: &[(u32, f64)]| {
            let weight = of_joint.iter().map(|&(_, weight)| weight).sum::<f64>() / sum;
            Influence { joint: of_joint[0].0, weight: weight as f32 }
        };
        let influences: Vec<_> = in_order.chunk_by(|a, b| a.0 == b.0).map(of_joint).collect();
        let is_finite = influences.iter().all(|influence| influence.weight.is_finite());
        is_finite.then_some(influences).ok_or(DeformingMeshError::NotFinite)
    }

    /// By morph target, without those that add nothing.
    fn morph_deltas_in_order(&self, deltas: &[(u32, [f32; 3])]) -> Result<Vec<MorphDelta>, DeformingMeshError> {
        let mut in_order: Vec<_> = deltas.iter().filter(|(_, delta)| *delta != [0.0; 3]).collect();
        in_order.sort_by_key(|&&(morph_id, _)| morph_id);
        let checked = |&(morph_id, delta): &(u32, [f32; 3])| {
            if morph_id >= self.morph_count {
                return Err(DeformingMeshError::NoSuchMorphTarget { morph_id, count: self.morph_count });
            }
            let is_finite = delta.iter().all(|coordinate| coordinate.is_finite());
            let delta = delta.map(|coordinate| coordinate + 0.0);
            is_finite.then_some(MorphDelta { delta, morph_id }).ok_or(DeformingMeshError::NotFinite)
        };
        in_order.into_iter().map(checked).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn classes(mesh: &DeformingMesh) -> Vec<u32> {
        bytemuck::pod_collect_to_vec(&mesh.weld_data())
    }

    #[test]
    fn what_moves_alike_is_alike_in_any_order() {
        let mut mesh = DeformingMesh::new(3, 2);
        let up = [0.0, 1.0, 0.0];
        let mut push = |position, influences: &[(u32, f64)], deltas: &[(u32, [f32; 3])]| {
            mesh.push_vertex(position, influences, deltas).expect("a good vertex");
        };
        push([0.0; 3], &[(0, 1.0), (2, 3.0)], &[(0, up), (1, [0.0; 3])]);
        push([-0.0, 0.0, 0.0], &[(2, 0.75), (1, 0.0), (0, 0.25)], &[(0, [-0.0, 1.0, 0.0])]);
        push([0.0; 3], &[(0, 1.0), (1, 3.0)], &[(0, up)]);
        push([0.0; 3], &[(2, 1.5), (0, 1.0), (2, 1.5)], &[(1, [0.0; 3]), (0, up)]);
        push([0.0; 3], &[(0, 1.0), (2, 3.0)], &[(1, up)]);
        push([1.0, 0.0, 0.0], &[(0, 1.0), (2, 3.0)], &[(0, up)]);
        push([1.0, 0.0, 0.0], &[(0, 0.0)], &[]);
        mesh.repeat_vertex(4);
        assert_eq!(classes(&mesh), [0, 0, 2, 0, 4, 5, 6, 4]);
        assert_eq!(mesh.influences()[..2].iter().map(|influence| influence.weight).sum::<f32>(), 1.0);
    }

    #[test]
    fn morphs_come_before_joints() {
        let mut mesh = DeformingMesh::new(2, 1);
        mesh.push_vertex([1.0, 0.0, 0.0], &[(0, 1.0), (1, 1.0)], &[(0, [1.0, 0.0, 0.0])]).expect("a good vertex");
        mesh.push_vertex([1.0, 0.0, 0.0], &[], &[(0, [0.0, 2.0, 0.0])]).expect("a good vertex");
        let pose = PartPose {
            world_from_object: DMat4::IDENTITY,
            joint_matrices: vec![DMat4::IDENTITY, DMat4::from_scale(DVec3::splat(3.0))],
            morph_weights: vec![0.5],
        };
        assert_eq!(mesh.posed(&pose), [DVec3::new(3.0, 0.0, 0.0), DVec3::new(1.0, 1.0, 0.0)]);
    }

    #[test]
    fn what_is_wrong_is_refused_and_leaves_nothing() {
        let mut mesh = DeformingMesh::new(1, 1);
        let far = f32::MAX;
        for (vertex, error) in [
            (([far, f32::INFINITY, 0.0], (0, 1.0), (0, [1.0; 3])), DeformingMeshError::NotFinite),
            (([far; 3], (0, f64::NAN), (0, [1.0; 3])), DeformingMeshError::NotFinite),
            (([far; 3], (0, 1.0), (0, [f32::NAN; 3])), DeformingMeshError::NotFinite),
            (([far; 3], (1, 1.0), (0, [1.0; 3])), DeformingMeshError::NoSuchJoint { joint: 1, count: 1 }),
            (([far; 3], (0, 1.0), (1, [1.0; 3])), DeformingMeshError::NoSuchMorphTarget { morph_id: 1, count: 1 }),
        ] {
            let (position, influence, delta) = vertex;
            assert_eq!(mesh.push_vertex(position, &[influence], &[delta]), Err(error));
        }
        assert_eq!(mesh, DeformingMesh::new(1, 1));
    }
}
