//! Welding: one id for all the source vertices at the same place.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use rayon::prelude::*;

/// What tells source vertices apart.
#[derive(Clone, Copy)]
pub(super) struct WeldKeys<'a> {
    positions: &'a [[f32; 3]],
    data: &'a [u8],
    data_stride: usize,
}

impl<'a> WeldKeys<'a> {
    /// Position bits alone.
    pub(super) fn positions(positions: &'a [[f32; 3]]) -> Self {
        Self { positions, data: &[], data_stride: 0 }
    }

    /// Position bits and an equal share of `data` for each vertex.
    pub(super) fn with_data(positions: &'a [[f32; 3]], data: &'a [u8]) -> Self {
        Self { positions, data, data_stride: data.len().checked_div(positions.len()).unwrap_or(0) }
    }

    /// Number of source vertices.
    pub(super) fn len(&self) -> usize {
        self.positions.len()
    }

    /// Position of a source vertex.
    pub(super) fn position(&self, vertex: u32) -> [f32; 3] {
        self.positions[vertex as usize]
    }

    /// The weld data of a source vertex.
    pub(super) fn data(&self, vertex: u32) -> &'a [u8] {
        &self.data[vertex as usize * self.data_stride..][..self.data_stride]
    }

    fn same(&self, a: u32, b: u32) -> bool {
        position_bits(self.position(a)) == position_bits(self.position(b)) && self.data(a) == self.data(b)
    }

    fn hash(&self, vertex: u32) -> u64 {
        let [x, y, z] = position_bits(self.position(vertex)).map(u64::from);
        let of_position = fold(fold(x | y << 32, 0x9e37_79b9_7f4a_7c15) ^ z, 0xd6e8_feb8_6659_fd93);
        self.data(vertex).iter().fold(of_position, |hash, &byte| fold(hash ^ u64::from(byte), 0xa076_1d64_78bd_642f))
    }
}

/// The bits of a position, with `-0.0` taken for `0.0`.
fn position_bits(position: [f32; 3]) -> [u32; 3] {
    position.map(|x| (x + 0.0).to_bits())
}

/// Multiplies to twice the width and folds the halves together, which spreads every bit over the whole word.
fn fold(a: u64, b: u64) -> u64 {
    let product = u128::from(a ^ 0x2d35_8dcc_aa6c_78a5) * u128::from(b);
    product as u64 ^ (product >> 64) as u64
}

/// No vertex in this slot.
const EMPTY: u32 = u32::MAX;

/// For each source vertex, the lowest source vertex with the same key.
///
/// An open hash table of vertex ids is filled by all threads at once. Which slot a key gets depends on their timing;
/// the lowest id in it does not.
pub(super) fn weld(keys: WeldKeys) -> Vec<u32> {
    // At most half full, so that a search is short.
    let capacity = (keys.len() * 2).next_power_of_two();
    let table = empty_table(capacity);
    let mut ids: Vec<u32> =
        (0..keys.len() as u32).into_par_iter().map(|vertex| claim_slot(&table, keys, vertex)).collect();
    ids.par_iter_mut().for_each(|slot| *slot = table[*slot as usize].load(Relaxed));
    ids
}

fn empty_table(capacity: usize) -> Vec<AtomicU32> {
    (0..capacity).into_par_iter().map(|_| AtomicU32::new(EMPTY)).collect()
}

/// Finds the slot of the vertex's key, or takes one for it, and leaves the lowest vertex there.
fn claim_slot(table: &[AtomicU32], keys: WeldKeys, vertex: u32) -> u32 {
    let mask = table.len() - 1;
    let mut slot = keys.hash(vertex) as usize & mask;
    loop {
        let seen = match table[slot].load(Relaxed) {
            EMPTY => match table[slot].compare_exchange(EMPTY, vertex, Relaxed, Relaxed) {
                Ok(_) => return slot as u32,
                Err(other) => other,
            },
            other => other,
        };
        if keys.same(seen, vertex) {
            // Another vertex may have lowered it since, but only to one with the same key.
            if vertex < seen {
                table[slot].fetch_min(vertex, Relaxed);
            }
            return slot as u32;
        }
        slot = (slot + 1) & mask;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lowest_index_stands_for_all() {
        let positions = [[1.0, 2.0, 3.0], [0.0; 3], [1.0, 2.0, 3.0], [0.0; 3], [3.0, 2.0, 1.0], [1.0, 2.0, 3.0]];
        assert_eq!(weld(WeldKeys::positions(&positions)), [0, 1, 0, 1, 4, 0]);
    }

    #[test]
    fn both_zeros_are_one_and_neighbouring_floats_are_two() {
        let positions = [[0.0, -0.0, 1.0], [-0.0, 0.0, 1.0], [f32::from_bits(1), 0.0, 1.0]];
        assert_eq!(weld(WeldKeys::positions(&positions)), [0, 0, 2]);
    }

    #[test]
    fn weld_data_keeps_apart_what_moves_apart() {
        let positions = [[1.0; 3]; 4];
        assert_eq!(weld(WeldKeys::with_data(&positions, b"aAbBaAbB")), [0, 1, 0, 1]);
    }

    #[test]
    fn no_vertices_are_no_ids() {
        assert!(weld(WeldKeys::with_data(&[], &[])).is_empty());
    }

    #[test]
    fn many_threads_agree_with_a_plain_search() {
        // 40 000 vertices at 1 000 places, far apart in memory.
        let positions: Vec<[f32; 3]> = (0..40_000u32)
            .map(|i| {
                let place = i.wrapping_mul(2_654_435_761) >> 8;
                [(place % 10) as f32, (place / 10 % 10) as f32, (place / 100 % 10) as f32]
            })
            .collect();
        let mut first = std::collections::HashMap::new();
        let expected: Vec<u32> = positions
            .iter()
            .zip(0..)
            .map(|(position, vertex)| *first.entry(position.map(f32::to_bits)).or_insert(vertex))
            .collect();
        for _ in 0..10 {
            assert_eq!(weld(WeldKeys::positions(&positions)), expected);
        }
    }
}
