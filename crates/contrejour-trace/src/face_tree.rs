//! The bounding volume hierarchy over the casting faces.

use core::time::Duration;

use glam::{DVec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::bvh2::{Bvh2, DEFAULT_MAX_STACK_DEPTH};
use obvhs::ray::Ray;

use crate::shadow_ray::ShadowRay;
use crate::shaft::Shaft;
use crate::trace_space::{BOX_MARGIN, HALF_SIDE};

/// A binary tree of boxes (obvhs' `Bvh2`).
pub(crate) struct FaceTree {
    tree: Bvh2,
    /// The face of each slot that a leaf names.
    face_of_slot: Vec<u32>,
}

impl FaceTree {
    /// Over some of the faces, whose corners are in trace space.
    pub fn new(corners: &[[DVec3; 3]], casting_faces: &[u32]) -> Self {
        let boxes: Vec<Aabb> = casting_faces.iter().map(|&face| box_around(face, &corners[face as usize])).collect();
        let mut tree = build_bvh2(&boxes, BvhBuildParams::medium_build(), &mut Duration::default());
        // Later steps of the build change the depth that obvhs notes, and its stack forgets what does not fit.
        tree.max_depth = (depth(&tree) + 1).max(DEFAULT_MAX_STACK_DEPTH);
        let face_of_slot = tree.primitive_indices.iter().map(|&index| casting_faces[index as usize]).collect();
        Self { tree, face_of_slot }
    }

    /// Whether a face for which `is_hit` says so lies along the ray. It is asked about the faces whose boxes the ray
    /// meets, in no order.
    pub fn any_along(&self, ray: &ShadowRay, mut is_hit: impl FnMut(u32) -> bool) -> bool {
        let Some([enter, leave]) = stay_in_cube(ray) else {
            return false;
        };
        let origin = (ray.origin + ray.direction * enter).as_vec3a();
        let reach = (leave - enter + 3.0 * BOX_MARGIN) as f32;
        let ray = Ray::new(origin, ray.direction.as_vec3a(), 0.0, reach);
        !self.tree.ray_traverse_miss(ray, |_, slot| if is_hit(self.face_of_slot[slot]) { 0.0 } else { f32::INFINITY })
    }

    /// Whether a face for which `is_met` says so lies in the shaft. It is asked about the faces of the leaves that the
    /// shaft may meet, in no order.
    pub fn any_in(&self, shaft: &Shaft, mut is_met: impl FnMut(u32) -> bool) -> bool {
        let mut to_visit = if self.tree.nodes.is_empty() { vec![] } else { vec![0] };
        while let Some(index) = to_visit.pop() {
            let node = &self.tree.nodes[index as usize];
            let (low, high) = (node.aabb().min.as_dvec3(), node.aabb().max.as_dvec3());
            if !shaft.may_meet_box((low + high) / 2.0, (high - low) / 2.0) {
                continue;
            }
            if !node.is_leaf() {
                to_visit.extend([node.first_index, node.first_index + 1]);
            } else if (node.first_index..node.first_index + node.prim_count)
                .any(|slot| is_met(self.face_of_slot[slot as usize]))
            {
                return true;
            }
        }
        false
    }
}

/// A face's box with its margin. The builder pairs boxes by the area of their union; where many are equal, as in a row
/// of equal faces or in copies, it makes a chain of them instead of a tree. So margins differ, by up to a factor of 2.
fn box_around(face: u32, corners: &[DVec3; 3]) -> Aabb {
    let [a, b, c] = corners.map(|corner| corner.as_vec3a());
    let some_bits = face.wrapping_mul(0x9e37_79b9) >> 24;
    let margin = Vec3A::splat(BOX_MARGIN as f32 * (1.0 + some_bits as f32 / 256.0));
    Aabb::new(a.min(b).min(c) - margin, a.max(b).max(c) + margin)
}

/// Most nodes between the root and a leaf, both counted.
fn depth(tree: &Bvh2) -> usize {
    let mut deepest = 0;
    let mut to_visit = if tree.nodes.is_empty() { vec![] } else { vec![(0, 1)] };
    while let Some((index, depth)) = to_visit.pop() {
        deepest = deepest.max(depth);
        let node = &tree.nodes[index as usize];
        if !node.is_leaf() {
            to_visit.extend([(node.first_index, depth + 1), (node.first_index + 1, depth + 1)]);
        }
    }
    deepest
}

/// The distances at which a ray enters and leaves the cube of all faces, 0 and its reach at most.
fn stay_in_cube(ray: &ShadowRay) -> Option<[f64; 2]> {
    let half = HALF_SIDE + 3.0 * BOX_MARGIN;
    let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
    let (mut enter, mut leave) = (0.0_f64, ray.reach);
    for (origin, direction) in origin.into_iter().zip(direction) {
        // NaN, where a ray runs in a side of the cube, is ignored by min and max.
        let [low, high] = [-half, half].map(|side| (side - origin) / direction);
        enter = enter.max(low.min(high));
        leave = leave.min(low.max(high));
    }
    (enter <= leave).then_some([enter, leave])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_faces_make_no_chain() {
        let face = |x: f64| [DVec3::new(x, 0.0, 0.0), DVec3::new(x + 0.01, 0.0, 0.0), DVec3::new(x, 0.01, 0.0)];
        let count = 5000;
        let copies: Vec<[DVec3; 3]> = (0..count).map(|_| face(0.0)).collect();
        let row: Vec<[DVec3; 3]> = (0..count).map(|i| face(f64::from(i) * 0.125)).collect();
        for faces in [copies, row] {
            let tree = FaceTree::new(&faces, &(0..count).collect::<Vec<_>>());
            assert!(depth(&tree.tree) < 300, "{}", depth(&tree.tree));
        }
    }
}
