//! Welding by a distance, for meshes whose seams do not meet exactly.

use std::collections::HashMap;

use super::weld::WeldKeys;

/// For each source vertex, the lowest vertex that stands for itself, has the same weld data and is no farther away
/// than `distance`; the vertex itself where there is none.
///
/// So no vertex moves by more than the distance, and vertices that stand for themselves are farther apart than it.
pub(super) fn weld_near(keys: WeldKeys, distance: f32) -> Vec<u32> {
    let mut grid = Grid::new(distance);
    (0..keys.len() as u32)
        .map(|vertex| {
            let position = keys.position(vertex).map(f64::from);
            let nearby = grid
                .around(position)
                .filter(|&other| {
                    is_near(position, keys.position(other).map(f64::from), distance)
                        && keys.data(other) == keys.data(vertex)
                })
                .min();
            nearby.unwrap_or_else(|| {
                grid.insert(position, vertex);
                vertex
            })
        })
        .collect()
}

fn is_near(a: [f64; 3], b: [f64; 3], distance: f32) -> bool {
    let distance = f64::from(distance);
    let squared: f64 = (0..3).map(|axis| (a[axis] - b[axis]) * (a[axis] - b[axis])).sum();
    squared <= distance * distance
}

/// Vertices by the cell of space that they are in. Few share a cell, because they are farther apart than its side.
struct Grid {
    cell_size: f64,
    last_of_cell: HashMap<[u64; 3], usize>,
    /// Each vertex with the entry that came before it in its cell.
    entries: Vec<(u32, Option<usize>)>,
}

impl Grid {
    fn new(distance: f32) -> Self {
        // A little larger than the distance, so that a rounded quotient is never off by more than one cell.
        let cell_size = f64::from(distance) * (1.0 + 1e-6);
        Self { cell_size, last_of_cell: HashMap::new(), entries: Vec::new() }
    }

    fn cell(&self, position: [f64; 3]) -> [f64; 3] {
        position.map(|x| (x / self.cell_size).floor())
    }

    fn insert(&mut self, position: [f64; 3], vertex: u32) {
        let entry = self.entries.len();
        let before = self.last_of_cell.insert(cell_key(self.cell(position)), entry);
        self.entries.push((vertex, before));
    }

    /// Vertices in the cell of the position and in the 26 cells around it.
    fn around(&self, position: [f64; 3]) -> impl Iterator<Item = u32> {
        let [x, y, z] = self.cell(position);
        (0..27).flat_map(move |step| {
            let offset = |divisor: u32| f64::from(step / divisor % 3) - 1.0;
            let key = cell_key([x + offset(1), y + offset(3), z + offset(9)]);
            let last = self.last_of_cell.get(&key).copied();
            std::iter::successors(last, |&entry| self.entries[entry].1).map(|entry| self.entries[entry].0)
        })
    }
}

/// Whole numbers as bits; far out, where neighbouring cells have the same number, they are the same cell.
fn cell_key(cell: [f64; 3]) -> [u64; 3] {
    cell.map(|x| (x + 0.0).to_bits())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn welded(positions: &[[f32; 3]], distance: f32) -> Vec<u32> {
        weld_near(WeldKeys::positions(positions), distance)
    }

    #[test]
    fn a_chain_does_not_pull_its_ends_together() {
        // 0.0 -- 0.9 -- 1.8: the middle joins the first, the last is too far from it.
        assert_eq!(welded(&[[0.0; 3], [0.9, 0.0, 0.0], [1.8, 0.0, 0.0]], 1.0), [0, 0, 2]);
    }

    #[test]
    fn neighbours_are_found_across_cell_borders() {
        let distance = 0.25;
        for axis in 0..3 {
            for center in [-1.0, 0.0, 0.25, 1.0e4] {
                let at = |t: f32| std::array::from_fn(|i| if i == axis { center + t } else { center });
                assert_eq!(welded(&[at(-0.125), at(0.125)], distance), [0, 0], "axis {axis}, around {center}");
                assert_eq!(welded(&[at(-0.125), at(0.25)], distance), [0, 1], "axis {axis}, around {center}");
            }
        }
    }

    #[test]
    fn extreme_scales_are_welded_exactly() {
        let huge = [[f32::MAX, 0.0, 0.0], [f32::MAX, 0.0, 0.0], [f32::MAX.next_down(), 0.0, 0.0]];
        assert_eq!(welded(&huge, f32::from_bits(1)), [0, 0, 2]);
        assert_eq!(welded(&huge, f32::MAX), [0, 0, 0]);
    }

    #[test]
    fn weld_data_must_agree() {
        let positions = [[0.0; 3], [0.1, 0.0, 0.0], [0.1, 0.0, 0.0]];
        assert_eq!(weld_near(WeldKeys::with_data(&positions, b"aba"), 1.0), [0, 1, 0]);
    }
}
