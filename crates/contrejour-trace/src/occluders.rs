//! The faces that block light and that receivers lie on.

use std::fmt;
use std::sync::Arc;

use glam::{DMat4, DVec3};

use crate::error::OccluderError;
use crate::face_tree::FaceTree;
use crate::shadow_ray::ShadowRay;
use crate::shaft::Shaft;
use crate::surface_point::SurfacePoint;
use crate::trace_space::TraceSpace;
use crate::{Receiver, TraceError};

/// A mesh in its place.
#[derive(Clone, Debug)]
pub struct OccluderMesh<'a> {
    /// Position of each vertex, object space.
    pub positions: &'a [[f32; 3]],
    /// Vertex indices of each triangle. Both sides of a face are opaque, so the winding does not matter.
    pub triangles: &'a [[u32; 3]],
    /// World space from object space.
    pub world_from_object: DMat4,
    /// Whether it blocks light. Without, receivers can lie on it and nothing more.
    pub casts: bool,
    /// Where its triangles are cut; none where they are whole.
    pub holes: Option<Holes>,
}

/// Where triangles are cut: what a ray meets there does not block it.
#[derive(Clone)]
pub struct Holes(Arc<IsHole>);

/// Whether a triangle has a hole at a point, by the weights of its corners.
type IsHole = dyn Fn(usize, [f64; 3]) -> bool + Send + Sync;

impl Holes {
    /// Holes where a function says so, of a triangle of the mesh and the weights of its corners, which add up to 1.
    pub fn new(is_hole: impl Fn(usize, [f64; 3]) -> bool + Send + Sync + 'static) -> Self {
        Self(Arc::new(is_hole))
    }
}

impl fmt::Debug for Holes {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("Holes")
    }
}

impl<'a> OccluderMesh<'a> {
    /// A mesh that casts.
    pub fn new(positions: &'a [[f32; 3]], triangles: &'a [[u32; 3]], world_from_object: DMat4) -> Self {
        Self { positions, triangles, world_from_object, casts: true, holes: None }
    }

    /// The corners of a triangle in the world.
    fn corners_world(&self, mesh: usize, triangle: usize) -> Result<[DVec3; 3], OccluderError> {
        let mut corners = [DVec3::ZERO; 3];
        for (corner, vertex) in corners.iter_mut().zip(self.triangles[triangle]) {
            let position = self.positions.get(vertex as usize).ok_or(OccluderError::NoSuchVertex {
                mesh,
                triangle,
                vertex,
                vertices: self.positions.len(),
            })?;
            *corner = self.world_from_object.transform_point3(DVec3::from(position.map(f64::from)));
            if !corner.is_finite() {
                return Err(OccluderError::NotFinite { mesh, vertex, position_world: *corner });
            }
        }
        Ok(corners)
    }
}

/// Faces, ready to be traced against.
///
/// They lie in a binary tree of boxes. Any-hit rays from a floor to a small light took 0.88 of the time that they took
/// through the compressed 8-wide tree of the same crate where thin slats stand on the floor, and 1.12 of it around a
/// torus of 200 000 faces (`cargo bench -p contrejour-trace`). On a par, the binary one is simpler to walk by cones.
pub struct Occluders {
    space: TraceSpace,
    /// In trace space.
    corners: Vec<[DVec3; 3]>,
    first_faces: Vec<u32>,
    /// By their first face, ascending.
    holes: Vec<(u32, Option<Holes>)>,
    faces_without_area: usize,
    tree: FaceTree,
}

impl Occluders {
    /// Part of the scene's largest coordinate by which rays start above their face: what rounding in `f64` does
    /// to faces and to intersections with them is some hundred times less.
    const LIFT: f64 = 1.0 / (1_u64 << 44) as f64;

    /// Part of the scene's largest coordinate by which a receiver may be off its face's plane: `f32` and interpolation
    /// do less, a wrong face number or transform usually does more.
    const MOST_OFF_FACE: f64 = 1.0 / 1024.0;

    /// Part of the scene's largest coordinate by which a receiver may lie past its face's edge: raster passes move
    /// corners by a share of a pixel, which on a face seen from its edge is a long way.
    const MOST_PAST_EDGE: f64 = 1.0 / 16.0;

    /// The faces of the meshes. A face without area blocks nothing; [`faces_without_area`](Self::faces_without_area)
    /// counts them.
    ///
    /// # Errors
    ///
    /// An index without a vertex, a corner that is not finite, or more than `u32::MAX` faces.
    pub fn new(meshes: &[OccluderMesh]) -> Result<Self, OccluderError> {
        let faces: usize = meshes.iter().map(|mesh| mesh.triangles.len()).sum();
        if u32::try_from(faces).is_err() {
            return Err(OccluderError::TooManyFaces { faces });
        }
        let mut corners_world = Vec::with_capacity(faces);
        let mut first_faces = Vec::with_capacity(meshes.len());
        for (index, mesh) in meshes.iter().enumerate() {
            first_faces.push(corners_world.len() as u32);
            for triangle in 0..mesh.triangles.len() {
                corners_world.push(mesh.corners_world(index, triangle)?);
            }
        }
        let space = TraceSpace::around(corners_world.iter().flatten().copied());
        let mut corners = corners_world;
        for corner in corners.iter_mut().flatten() {
            *corner = space.point_from_world(*corner);
        }

        let casts = meshes.iter().flat_map(|mesh| core::iter::repeat_n(mesh.casts, mesh.triangles.len()));
        let casting_faces: Vec<u32> = (0..)
            .zip(casts)
            .zip(&corners)
            .filter(|((_, casts), face)| *casts && area(face) > 0.0)
            .map(|((face, _), _)| face)
            .collect();
        let tree = FaceTree::new(&corners, &casting_faces);
        let faces_without_area = corners.iter().filter(|face| area(face) == 0.0).count();
        let holes = if meshes.iter().any(|mesh| mesh.holes.is_some()) {
            first_faces.iter().copied().zip(meshes.iter().map(|mesh| mesh.holes.clone())).collect()
        } else {
            Vec::new()
        };
        Ok(Self { space, corners, first_faces, holes, faces_without_area, tree })
    }

    /// Number of a mesh's first triangle among all faces: they are numbered in order, mesh after mesh, whether they
    /// cast or not, so that triangle `t` of mesh `m` is face `first_face(m) + t`. None for a mesh that is not there.
    pub fn first_face(&self, mesh: usize) -> Option<u32> {
        self.first_faces.get(mesh).copied()
    }

    /// How many faces there are.
    pub fn face_count(&self) -> usize {
        self.corners.len()
    }

    /// How many faces have no area: they block nothing, and no receiver can lie on them.
    pub fn faces_without_area(&self) -> usize {
        self.faces_without_area
    }

    /// Whether a receiver can lie on a face. False for a face that is not there.
    pub fn has_area(&self, face: u32) -> bool {
        self.corners.get(face as usize).is_some_and(|corners| area(corners) > 0.0)
    }

    /// Whether a face other than `own_face` lies along the ray.
    pub(crate) fn block(&self, ray: &ShadowRay, own_face: u32) -> bool {
        self.tree.any_along(ray, |face| {
            let met = if face == own_face { None } else { ray.meets(&self.corners[face as usize]) };
            met.is_some_and(|weights| !self.is_hole(face, weights))
        })
    }

    /// Whether a face has a hole at a point.
    fn is_hole(&self, face: u32, weights: [f64; 3]) -> bool {
        let mesh = self.holes.partition_point(|(first_face, _)| *first_face <= face);
        match mesh.checked_sub(1).map(|mesh| &self.holes[mesh]) {
            Some((first_face, Some(Holes(is_hole)))) => is_hole((face - first_face) as usize, weights),
            _ => false,
        }
    }

    /// Whether a face other than `own_face` may block a ray of the shaft.
    pub(crate) fn may_meet(&self, shaft: &Shaft, own_face: u32) -> bool {
        self.tree.any_in(shaft, |face| face != own_face && shaft.may_meet_face(&self.corners[face as usize]))
    }

    pub(crate) fn space(&self) -> &TraceSpace {
        &self.space
    }

    /// Where the rays of a receiver start from, in trace space.
    pub(crate) fn surface_point(&self, index: usize, receiver: &Receiver) -> Result<SurfacePoint, TraceError> {
        let &Receiver { position, face, seen_from } = receiver;
        if !(position.is_finite() && seen_from.is_finite()) {
            return Err(TraceError::ReceiverNotFinite { receiver: index, position, seen_from });
        }
        let Some(corners) = self.corners.get(face as usize) else {
            return Err(TraceError::NoSuchFace { receiver: index, face, faces: self.corners.len() });
        };
        if area(corners) == 0.0 {
            return Err(TraceError::FaceWithoutArea { receiver: index, face });
        }
        let [position, seen_from] = [position, seen_from].map(|point| self.space.point_from_world(point));
        let lift = Self::LIFT * self.space.largest_coordinate;
        let point = SurfacePoint::above_face(corners, position, seen_from, lift);
        let offset = position - point.position;
        let off_plane = offset.dot(point.normal).abs();
        let allowed = Self::MOST_OFF_FACE * self.space.largest_coordinate;
        let past_edge = offset.reject_from_normalized(point.normal).length();
        if off_plane > allowed || past_edge > Self::MOST_PAST_EDGE * self.space.largest_coordinate {
            let distance = offset.length();
            let [distance, allowed] = [distance, allowed].map(|length| self.space.world_from_length(length));
            return Err(TraceError::OffFace { receiver: index, face, distance, allowed });
        }
        Ok(point)
    }
}

/// Twice the area.
fn area(&[a, b, c]: &[DVec3; 3]) -> f64 {
    (b - a).cross(c - a).length()
}
