//! From a signed distance to a closed surface: marching tetrahedra on a body-centred lattice.
//!
//! The tetrahedra of that lattice are all alike and nearly regular, so the triangles are too (Labelle & Shewchuk
//! 2007, "Isosurface Stuffing"). Unlike cubes, tetrahedra leave no choice: the surface is always closed and every
//! edge has two faces.

use std::collections::HashMap;

use glam::{DVec3, USizeVec3};

use super::implicit::gradient;
use super::surface::Surface;

/// How often vertices are moved to the middle of their neighbours and back onto the surface.
const RELAXATIONS: usize = 6;

/// How near a vertex may come to a lattice node, over the length of the lattice edge. Keeps triangles from collapsing.
const NODE_CLEARANCE: f64 = 0.15;

/// The surface where `distance` is zero, within the box from `low` to `low + cell * cells`.
///
/// `distance` must be positive near the sides of the box, and return the same value for the same point.
pub(super) fn polygonise(low: DVec3, cell: f64, cells: USizeVec3, distance: impl Fn(DVec3) -> f64) -> Surface {
    let lattice = Lattice::sample(low, cell, cells, &distance);
    let mut surface = Surface::default();
    let mut vertex_of_edge = HashMap::new();
    lattice.for_each_tetrahedron(|nodes| march(&lattice, nodes, &mut surface, &mut vertex_of_edge));
    for _ in 0..RELAXATIONS {
        relax(&mut surface, cell, &distance);
    }
    surface.normals = surface
        .positions
        .iter()
        .map(|&position| gradient(&distance, position, 0.2 * cell).normalize_or(DVec3::Y))
        .collect();
    surface
}

/// Nodes at the corners of the cells, then nodes in the middles of the cells.
struct Lattice {
    low: DVec3,
    cell: f64,
    cells: USizeVec3,
    distances: Vec<f64>,
}

impl Lattice {
    fn sample(low: DVec3, cell: f64, cells: USizeVec3, distance: &impl Fn(DVec3) -> f64) -> Self {
        let mut lattice = Self { low, cell, cells, distances: Vec::new() };
        let corners = cells + USizeVec3::ONE;
        let node_count = corners.element_product() + cells.element_product();
        lattice.distances = (0..node_count).map(|node| distance(lattice.position(node))).collect();
        lattice
    }

    fn corner(&self, at: USizeVec3) -> usize {
        (at.z * (self.cells.y + 1) + at.y) * (self.cells.x + 1) + at.x
    }

    fn middle(&self, at: USizeVec3) -> usize {
        (self.cells + USizeVec3::ONE).element_product() + (at.z * self.cells.y + at.y) * self.cells.x + at.x
    }

    fn position(&self, node: usize) -> DVec3 {
        let corners = self.cells + USizeVec3::ONE;
        let corner_count = corners.element_product();
        let (index, counts, offset) =
            if node < corner_count { (node, corners, 0.0) } else { (node - corner_count, self.cells, 0.5) };
        let at = USizeVec3::new(index % counts.x, index / counts.x % counts.y, index / counts.x / counts.y);
        self.low + self.cell * (at.as_dvec3() + offset)
    }

    /// Every tetrahedron: the middles of two neighbouring cells and an edge of the square between them.
    fn for_each_tetrahedron(&self, mut visit: impl FnMut([usize; 4])) {
        for z in 0..self.cells.z {
            for y in 0..self.cells.y {
                for x in 0..self.cells.x {
                    let at = USizeVec3::new(x, y, z);
                    for axis in 0..3 {
                        if at[axis] == 0 {
                            continue;
                        }
                        let mut before = at;
                        before[axis] -= 1;
                        let (mut u, mut v) = (USizeVec3::ZERO, USizeVec3::ZERO);
                        u[(axis + 1) % 3] = 1;
                        v[(axis + 2) % 3] = 1;
                        let square = [at, at + u, at + u + v, at + v].map(|corner| self.corner(corner));
                        for side in 0..4 {
                            visit([self.middle(before), self.middle(at), square[side], square[(side + 1) % 4]]);
                        }
                    }
                }
            }
        }
    }
}

/// Adds the part of the surface that lies in one tetrahedron: nothing, a triangle or a quad.
fn march(
    lattice: &Lattice,
    nodes: [usize; 4],
    surface: &mut Surface,
    vertex_of_edge: &mut HashMap<(usize, usize), u32>,
) {
    let (inside, outside): (Vec<usize>, Vec<usize>) =
        nodes.into_iter().partition(|&node| lattice.distances[node] < 0.0);
    // Crossed lattice edges, in order around the surface.
    let crossed: &[(usize, usize)] = match *inside {
        [a] => &[(a, outside[0]), (a, outside[1]), (a, outside[2])],
        [a, b] => &[(a, outside[0]), (a, outside[1]), (b, outside[1]), (b, outside[0])],
        [a, b, c] => &[(a, outside[0]), (b, outside[0]), (c, outside[0])],
        _ => return,
    };
    // Midpoints of the edges decide the winding: unlike the vertices, they are never in one line.
    let midpoint = |(a, b): (usize, usize)| 0.5 * (lattice.position(a) + lattice.position(b));
    let normal = (midpoint(crossed[1]) - midpoint(crossed[0])).cross(midpoint(crossed[2]) - midpoint(crossed[0]));
    let outward = normal.dot(lattice.position(outside[0]) - lattice.position(inside[0])) > 0.0;

    let mut ring: Vec<u32> = crossed
        .iter()
        .map(|&(a, b)| {
            *vertex_of_edge.entry((a, b)).or_insert_with(|| {
                let (from, to) = (lattice.distances[a], lattice.distances[b]);
                let share = (from / (from - to)).clamp(NODE_CLEARANCE, 1.0 - NODE_CLEARANCE);
                surface.vertex(lattice.position(a).lerp(lattice.position(b), share), DVec3::ZERO)
            })
        })
        .collect();
    if !outward {
        ring.reverse();
    }
    match *ring {
        [a, b, c] => surface.triangles.push([a, b, c]),
        [a, b, c, d] => surface.quad([a, b, c, d]),
        _ => {}
    }
}

/// Moves every vertex towards the middle of its neighbours, then along the gradient back onto the surface.
fn relax(surface: &mut Surface, cell: f64, distance: &impl Fn(DVec3) -> f64) {
    let mut sums = vec![(DVec3::ZERO, 0.0); surface.positions.len()];
    for &[a, b, c] in &surface.triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let (sum, count) = &mut sums[from as usize];
            *sum += surface.positions[to as usize];
            *count += 1.0;
        }
    }
    for (position, (sum, count)) in surface.positions.iter_mut().zip(sums) {
        let mut moved = position.lerp(sum / count, 0.5);
        for _ in 0..2 {
            let steepest = gradient(distance, moved, 0.1 * cell);
            let step = -distance(moved) / steepest.length_squared().max(0.25);
            moved += (step * steepest).clamp_length_max(0.5 * cell);
        }
        *position = moved;
    }
}
