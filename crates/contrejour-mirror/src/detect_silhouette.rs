//! Finds the edges whose signed multiplicity is not zero and the side on which their faces lie.

use contrejour_layout::{
    BLOCK_SIZE, Caster, Edge, INCIDENCE_ALONG, INCIDENCE_LIST, INCIDENCE_NONE, OUTLINE_BLOCKER_LEFT,
    OUTLINE_BLOCKER_RIGHT, OUTLINE_NONE, OUTLINE_WORDS_PER_BLOCK, SeatCounters, SilhouetteEdge, TestItem, UNLIT_FACE,
    ViewBundle,
};

use crate::bundle::{is_lit, seats_in};

/// The stage `detect_silhouette`: lit bits to silhouette edges and outline sides.
pub struct DetectSilhouette<'a> {
    /// The room in the list of silhouette edges of each seat.
    pub bundle: &'a ViewBundle,
    /// Blocks of edges.
    pub edge_tests: &'a [TestItem],
    /// Where the parts of each caster lie.
    pub casters: &'a [Caster],
    /// Edges of all casters.
    pub edges: &'a [Edge],
    /// Incidence lists of all casters.
    pub incidences: &'a [u32],
    /// Lit bits of all casters, one a face and seat.
    pub lit: &'a [u32],
    /// The silhouette of each seat: `counters.silhouette_edges` records.
    pub silhouettes: &'a mut [SilhouetteEdge],
    /// Outline sides of each seat and all casters, two bits an edge.
    pub outline_sides: &'a mut [u32],
    /// How many blocks there are; counts silhouette edges of each seat.
    pub counters: &'a mut [SeatCounters],
}

/// Faces on the left and on the right of an edge as seen from the light.
#[derive(Clone, Copy, Default)]
struct Sides {
    left: u32,
    right: u32,
}

impl DetectSilhouette<'_> {
    /// Does what the whole dispatch does.
    ///
    /// # Panics
    ///
    /// When a record names a part of a buffer that does not exist.
    pub fn run(mut self) {
        for item in &self.edge_tests[..self.counters[0].edge_tests as usize] {
            for seat in seats_in(self.bundle, item.seats) {
                self.detect(item, seat);
            }
        }
    }

    fn detect(&mut self, item: &TestItem, seat: usize) {
        let caster = &self.casters[item.caster as usize];
        let shape = &self.bundle.shape;
        let silhouettes = &mut self.silhouettes[seat * shape.silhouette_stride as usize..];
        let outline_sides = &mut self.outline_sides[seat * shape.outline_stride as usize..];
        let counts = &mut self.counters[seat].counts;
        let mut block_sides = [0; OUTLINE_WORDS_PER_BLOCK as usize];
        let first_edge_id = item.block * BLOCK_SIZE;
        let end_edge_id = caster.edge_count.min(first_edge_id + BLOCK_SIZE);
        for edge_id in first_edge_id..end_edge_id {
            let edge = &self.edges[caster.first_edge.wrapping_add(edge_id) as usize];
            let sides = count_sides(caster, edge, self.incidences, |face| {
                is_lit(self.bundle, self.lit, caster, face * shape.seat_count + seat as u32)
            });

            // Append the silhouette.
            if sides.left != sides.right {
                let slot = counts.silhouette_edges;
                counts.silhouette_edges += 1;
                if slot < self.bundle.views[seat].silhouette_capacity {
                    silhouettes[slot as usize] =
                        SilhouetteEdge { caster: item.caster, edge_id, left: sides.left, right: sides.right };
                }
            }
            let lane = edge_id - first_edge_id;
            block_sides[lane as usize / 16] |= outline_side(sides) << (lane % 16 * 2);
        }

        // Keep the outline sides for whoever asks about a neighbour.
        let first_word = (caster.first_outline_word + item.block * OUTLINE_WORDS_PER_BLOCK) as usize;
        outline_sides[first_word..][..block_sides.len()].copy_from_slice(&block_sides);
    }
}

fn count_sides(caster: &Caster, edge: &Edge, incidences: &[u32], is_lit: impl Fn(u32) -> bool) -> Sides {
    let pair = [edge.first, edge.second];
    let words = if edge.first == INCIDENCE_LIST {
        let list = caster.first_incidence.wrapping_add(edge.second) as usize;
        &incidences[list + 1..][..incidences[list] as usize]
    } else {
        &pair
    };
    let mut sides = Sides::default();
    for &word in words {
        if word == INCIDENCE_NONE {
            continue;
        }
        let face = word >> 1;
        // A face is on the left when its sign and its orientation along the edge agree.
        if (face != UNLIT_FACE && is_lit(face)) == (word & INCIDENCE_ALONG != 0) {
            sides.left += 1;
        } else {
            sides.right += 1;
        }
    }
    sides
}

fn outline_side(sides: Sides) -> u32 {
    match (sides.left, sides.right) {
        (1.., 0) => OUTLINE_BLOCKER_LEFT,
        (0, 1..) => OUTLINE_BLOCKER_RIGHT,
        _ => OUTLINE_NONE,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_scene::{TestLight, TestScene};

    // 2
    // |\
    // | \
    // 0--1
    const CORNERS: [[f32; 2]; 3] = [[0.0, 0.0], [0.5, 0.0], [0.0, 0.5]];

    #[test]
    fn every_edge_of_one_face_is_silhouette() {
        let front = TestScene::flat(&CORNERS, &[[0, 1, 2]]);
        assert_eq!(front.silhouette(), [(0, 1, 1, 0), (0, 2, 0, 1), (1, 2, 1, 0)]);
        assert_eq!(front.frame().outline_sides, [0b01_10_01, 0, 0, 0]);

        // From behind the face is unlit, but it lies on the same side.
        let back = TestScene::flat(&CORNERS, &[[0, 2, 1]]);
        assert_eq!(back.silhouette(), front.silhouette());
    }

    #[test]
    fn exactly_edge_on_is_unlit() {
        let edge_on =
            TestScene::new(&[[0.0; 3], [0.5, 0.0, 0.0], [0.0, 0.0, 1.0]], &[[0, 1, 2]], TestLight::Directional);
        assert_eq!(edge_on.silhouette(), [(0, 1, 0, 1), (0, 2, 1, 0), (1, 2, 0, 1)]);
    }

    #[test]
    fn diagonal_of_a_square_is_no_silhouette() {
        // 3--2
        // | /|
        // |/ |
        // 0--1
        let square = [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]];
        let wound_alike = TestScene::flat(&square, &[[0, 1, 2], [0, 2, 3]]);
        let border = [(0, 1, 1, 0), (0, 3, 0, 1), (1, 2, 1, 0), (2, 3, 1, 0)];
        assert_eq!(wound_alike.silhouette(), border);
        let wound_against_each_other = TestScene::flat(&square, &[[0, 1, 2], [0, 3, 2]]);
        assert_eq!(wound_against_each_other.silhouette(), border);
    }

    #[test]
    fn outline_of_a_tetrahedron_counts_both_faces() {
        let positions = [[-0.5, -0.5, 0.0], [0.5, -0.5, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 0.5]];
        let tetrahedron =
            TestScene::new(&positions, &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]], TestLight::Directional);
        assert_eq!(tetrahedron.silhouette(), [(0, 1, 2, 0), (0, 2, 0, 2), (1, 2, 2, 0)]);
    }

    #[test]
    fn three_faces_at_an_edge_all_count() {
        // Two faces on the left of 0-1 and one on its right: in the silhouette, but no outline.
        let positions = [[0.0, 0.0], [0.5, 0.0], [0.0, 0.5], [0.2, 0.5], [0.0, -0.5]];
        let fan = TestScene::flat(&positions, &[[0, 1, 2], [0, 1, 3], [0, 4, 1]]);
        assert_eq!(fan.silhouette()[0], (0, 1, 2, 1));
        let fan = fan.frame();
        assert_eq!(fan.outline_sides[0] & 3, OUTLINE_NONE);
        assert_eq!(fan.counters.silhouette_edges, 7);
        assert_eq!(fan.counters.quads, 6);
    }

    #[test]
    fn edges_beyond_the_first_block_have_their_words() {
        // 100 faces apart: 300 edges.
        let positions: Vec<_> = (0..100).flat_map(|i| CORNERS.map(|[x, y]| [x + i as f32, y])).collect();
        let faces: Vec<_> = (0..100).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let frame = TestScene::flat(&positions, &faces).frame();
        assert_eq!(frame.counters.silhouette_edges, 300);
        assert_eq!(frame.outline_sides.len(), 20);
        let side = |edge_id: usize| frame.outline_sides[edge_id / 16] >> (edge_id % 16 * 2) & 3;
        for edge_id in 0..320 {
            assert_eq!(side(edge_id), if edge_id < 300 { [1, 2, 1][edge_id % 3] } else { 0 });
        }
    }

    #[test]
    fn what_does_not_fit_is_still_counted() {
        let mut scene = TestScene::flat(&CORNERS, &[[0, 1, 2]]);
        scene.capacity = 2;
        let frame = scene.frame();
        assert_eq!(frame.counters.silhouette_edges, 3);
        assert_eq!(frame.silhouettes.len(), 2);
        assert_eq!(frame.counters.quads, 2);
        assert_eq!(frame.counters.corners, 2);
    }

    #[test]
    fn face_that_stands_for_unlit_reads_no_bit() {
        let caster = Caster::default();
        let edge = Edge { first: UNLIT_FACE << 1 | INCIDENCE_ALONG, second: INCIDENCE_NONE, ..Default::default() };
        let sides = count_sides(&caster, &edge, &[], |_| panic!("there is no bit"));
        assert_eq!((sides.left, sides.right), (0, 1));
    }
}
