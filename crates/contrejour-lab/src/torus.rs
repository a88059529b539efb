//! A mesh of any size for benches.

use std::f64::consts::TAU;

/// Positions and vertex indices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangles {
    /// Position of each vertex.
    pub positions: Vec<[f32; 3]>,
    /// Three vertices a triangle, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// A torus around the y axis, radii 1 and 0.4, of `2 * around * across` triangles on `around * across` vertices.
pub fn torus(around: u32, across: u32) -> Triangles {
    let angle = |step: u32, steps: u32| TAU * f64::from(step) / f64::from(steps);
    let positions = (0..around)
        .flat_map(|i| (0..across).map(move |j| (angle(i, around), angle(j, across))))
        .map(|(ring, tube)| {
            let radius = 1.0 + 0.4 * tube.cos();
            [radius * ring.cos(), 0.4 * tube.sin(), -radius * ring.sin()].map(|x| x as f32)
        })
        .collect();
    let triangles = (0..around)
        .flat_map(|i| (0..across).map(move |j| (i, j)))
        .flat_map(|(i, j)| {
            let vertex = |i: u32, j: u32| (i % around) * across + j % across;
            let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    Triangles { positions, triangles }
}

impl Triangles {
    /// Puts the triangles in random order, the same in every run (Fisher-Yates).
    pub fn shuffle(&mut self) {
        let mut state = 0x5eed;
        for last in (1..self.triangles.len()).rev() {
            let other = (u128::from(split_mix(&mut state)) * (last as u128 + 1)) >> 64;
            self.triangles.swap(last, other as usize);
        }
    }
}

/// The next number of the generator SplitMix64 (Steele, Lea and Flood 2014).
fn split_mix(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use contrejour_mesh::{BuildOptions, TopologyAwareMesh};

    use super::*;

    #[test]
    fn the_torus_is_closed_and_faces_outwards() {
        let Triangles { positions, triangles } = torus(40, 30);
        let mesh = TopologyAwareMesh::build(&positions, &triangles, &BuildOptions::default())
            .expect("the torus has a topology");
        assert!(mesh.report.closed && mesh.report.manifold && mesh.report.oriented);
        assert_eq!((mesh.report.faces, mesh.report.edges, mesh.report.used_vertices), (2400, 3600, 1200));
        // Wound inside out, most edges would be concave.
        assert!(mesh.report.convex_edges > mesh.report.concave_edges, "{}", mesh.report);
    }

    #[test]
    fn shuffling_keeps_the_triangles() {
        let sorted = torus(20, 20);
        let mut shuffled = sorted.clone();
        shuffled.shuffle();
        assert_ne!(shuffled, sorted);
        let in_order = |mut mesh: Triangles| {
            mesh.triangles.sort_unstable();
            mesh
        };
        assert_eq!(in_order(shuffled), in_order(sorted));
    }
}
