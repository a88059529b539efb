//! Vertex normals for meshes that bring none, or not all.

use std::f64::consts::PI;

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use crate::TriangleMesh;

/// Faces that meet at a larger angle than this share no normal: boxes look flat, smooth bodies smooth.
const CREASE_RADIANS: f64 = 40.0 * PI / 180.0;

/// Normal of a vertex that no face with area uses.
const NO_NORMAL: [f32; 3] = [0.0, 1.0, 0.0];

impl TriangleMesh {
    /// Makes `normals` as long as `positions`, all of unit length.
    ///
    /// A normal that is there is only scaled. A missing one (beyond the end, zero or not finite) is the sum of the
    /// face normals around the vertex, weighted by their angles there (Thürmer & Wüthrich 1998), over the faces
    /// that are connected through edges of exactly two consistently wound faces with at most 40 degrees between
    /// their normals. Vertices with the same position count as one here. Where faces around a vertex fall into
    /// several such groups, the vertex is repeated at the end of the lists, with its colour and its number.
    /// Faces without area count for nothing; a vertex with no other faces gets `+y`.
    pub fn complete_normals(&mut self) {
        self.normals.resize(self.positions.len(), [0.0; 3]);
        for normal in &mut self.normals {
            *normal = unit_or_zero(*normal);
        }
        let is_missing = |&vertex: &u32| self.normals[vertex as usize] == [0.0; 3];
        if self.triangles.as_flattened().iter().any(is_missing) {
            self.compute_missing_normals();
        }
        for normal in &mut self.normals {
            if *normal == [0.0; 3] {
                *normal = NO_NORMAL;
            }
        }
    }

    fn compute_missing_normals(&mut self) {
        let face_normals: Vec<DVec3> = self
            .triangles
            .par_iter()
            .map(|triangle| face_normal(triangle.map(|vertex| self.position(vertex))))
            .collect();
        let mut groups = self.smooth_groups(&face_normals);

        // Corners in need of a normal, brought together by vertex and group.
        let mut corners: Vec<(u32, u32, u32)> = Vec::new();
        let mut group_normals = vec![DVec3::ZERO; 3 * self.triangles.len()];
        for (face, triangle) in self.triangles.iter().enumerate() {
            if face_normals[face] == DVec3::ZERO {
                continue;
            }
            for turn in 0..3 {
                let corner = 3 * face + turn;
                let group = groups.root(corner as u32);
                let angle = corner_angle(
                    self.position(triangle[turn]),
                    self.position(triangle[(turn + 1) % 3]),
                    self.position(triangle[(turn + 2) % 3]),
                );
                group_normals[group as usize] += angle * face_normals[face];
                if self.normals[triangle[turn] as usize] == [0.0; 3] {
                    corners.push((triangle[turn], group, corner as u32));
                }
            }
        }
        corners.par_sort_unstable();

        for of_vertex in corners.chunk_by(|a, b| a.0 == b.0) {
            let mut vertex = of_vertex[0].0;
            for (nth, of_group) in of_vertex.chunk_by(|a, b| a.1 == b.1).enumerate() {
                if nth > 0 {
                    vertex = self.repeat_vertex(vertex);
                }
                let (_, group, first_corner) = of_group[0];
                let fallback = face_normals[first_corner as usize / 3];
                let normal = group_normals[group as usize].normalize_or(fallback);
                self.normals[vertex as usize] = normal.as_vec3().to_array();
                for &(_, _, corner) in of_group {
                    self.triangles[corner as usize / 3][corner as usize % 3] = vertex;
                }
            }
        }
    }

    /// Groups of corners (3 * face + 0, 1, 2) that share a normal.
    fn smooth_groups(&self, face_normals: &[DVec3]) -> CornerGroups {
        let welded = self.lowest_vertex_at_position();
        let mut half_edges: Vec<(u32, u32, u32)> = Vec::with_capacity(3 * self.triangles.len());
        for (face, triangle) in self.triangles.iter().enumerate() {
            if face_normals[face] == DVec3::ZERO {
                continue;
            }
            let ids = triangle.map(|vertex| welded[vertex as usize]);
            for turn in 0..3 {
                let (from, to) = (ids[turn], ids[(turn + 1) % 3]);
                half_edges.push((from.min(to), from.max(to), (3 * face + turn) as u32));
            }
        }
        half_edges.par_sort_unstable();

        let cos_crease = CREASE_RADIANS.cos();
        let corner_id = |corner: u32| welded[self.triangles[corner as usize / 3][corner as usize % 3] as usize];
        let mut groups = CornerGroups::new(3 * self.triangles.len());
        for at_edge in half_edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            let &[(_, _, a), (_, _, b)] = at_edge else {
                continue;
            };
            let is_smooth = face_normals[a as usize / 3].dot(face_normals[b as usize / 3]) >= cos_crease;
            let is_consistent = corner_id(a) == corner_id(next_corner(b));
            if is_smooth && is_consistent {
                groups.join(a, next_corner(b));
                groups.join(next_corner(a), b);
            }
        }
        groups
    }

    /// For each vertex the lowest one with the same position; `-0.0` = `0.0`.
    fn lowest_vertex_at_position(&self) -> Vec<u32> {
        let mut by_position: Vec<([u32; 3], u32)> = self
            .positions
            .par_iter()
            .enumerate()
            .map(|(vertex, &position)| (position_bits(position), vertex as u32))
            .collect();
        by_position.par_sort_unstable();
        let mut lowest = vec![0; self.positions.len()];
        for at_position in by_position.chunk_by(|a, b| a.0 == b.0) {
            for &(_, vertex) in at_position {
                lowest[vertex as usize] = at_position[0].1;
            }
        }
        lowest
    }

    fn repeat_vertex(&mut self, vertex: u32) -> u32 {
        let vertex = vertex as usize;
        self.positions.push(self.positions[vertex]);
        self.normals.push(self.normals[vertex]);
        self.colors.push(self.colors[vertex]);
        self.vertex_numbers.push(self.vertex_numbers[vertex]);
        if let Some(&alpha) = self.alphas.get(vertex) {
            self.alphas.push(alpha);
        }
        if let Some(&coordinates) = self.texture_coordinates.get(vertex) {
            self.texture_coordinates.push(coordinates);
        }
        (self.positions.len() - 1) as u32
    }

    fn position(&self, vertex: u32) -> DVec3 {
        Vec3::from(self.positions[vertex as usize]).as_dvec3()
    }
}

/// The bits that decide whether two positions are one: those of the position, with `-0.0` as `0.0`.
pub(crate) fn position_bits(position: [f32; 3]) -> [u32; 3] {
    position.map(|coordinate| (coordinate + 0.0).to_bits())
}

/// The vector at unit length; zero when it has none.
fn unit_or_zero(vector: [f32; 3]) -> [f32; 3] {
    let vector = Vec3::from(vector).as_dvec3();
    vector.normalize_or_zero().as_vec3().to_array()
}

/// Unit normal of a counter-clockwise triangle; zero without area.
fn face_normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    // Unit edges first, so that neither tiny nor huge triangles leave the range of f64 in the products.
    let ab = (b - a).normalize_or_zero();
    let ac = (c - a).normalize_or_zero();
    ab.cross(ac).normalize_or_zero()
}

/// Angle of a triangle at `at`, radians.
fn corner_angle(at: DVec3, next: DVec3, previous: DVec3) -> f64 {
    let (a, b) = (next - at, previous - at);
    a.cross(b).length().atan2(a.dot(b))
}

/// The corner of the same face that follows counter-clockwise.
fn next_corner(corner: u32) -> u32 {
    if corner % 3 == 2 { corner - 2 } else { corner + 1 }
}

/// Disjoint sets of corners (union by lower root, path halving).
struct CornerGroups {
    parents: Vec<u32>,
}

impl CornerGroups {
    fn new(count: usize) -> Self {
        Self { parents: (0..count as u32).collect() }
    }

    fn root(&mut self, mut corner: u32) -> u32 {
        while self.parents[corner as usize] != corner {
            let grandparent = self.parents[self.parents[corner as usize] as usize];
            self.parents[corner as usize] = grandparent;
            corner = grandparent;
        }
        corner
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a.max(b) as usize] = a.min(b);
    }
}
