//! Finds the edges whose signed multiplicity is not zero and the side on which their faces lie.

use contrejour_layout::{
    BLOCK_SIZE, Caster, Counters, Edge, INCIDENCE_ALONG, INCIDENCE_LIST, INCIDENCE_NONE, LightView,
    OUTLINE_BLOCKER_LEFT, OUTLINE_BLOCKER_RIGHT, OUTLINE_NONE, OUTLINE_WORDS_PER_BLOCK, SilhouetteEdge, UNLIT_FACE,
    WorkItem,
};

/// The stage `detect_silhouette`: lit bits to silhouette edges and outline sides.
pub struct DetectSilhouette<'a> {
    /// How many work items there are, and the room in the list of silhouette edges.
    pub view: &'a LightView,
    /// Blocks of edges.
    pub edge_items: &'a [WorkItem],
    /// Where the parts of each caster lie.
    pub casters: &'a [Caster],
    /// Edges of all casters.
    pub edges: &'a [Edge],
    /// Incidence lists of all casters.
    pub incidences: &'a [u32],
    /// Lit bits of all casters.
    pub lit: &'a [u32],
    /// The silhouette: `counters.silhouette_edges` records.
    pub silhouettes: &'a mut [SilhouetteEdge],
    /// Outline sides of all casters, two bits an edge.
    pub outline_sides: &'a mut [u32],
    /// Counts silhouette edges.
    pub counters: &'a mut Counters,
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
    pub fn run(self) {
        for item in &self.edge_items[..self.view.edge_item_count as usize] {
            let caster = &self.casters[item.caster as usize];
            let mut block_sides = [0; OUTLINE_WORDS_PER_BLOCK as usize];
            let first_edge_id = item.block * BLOCK_SIZE;
            let end_edge_id = caster.edge_count.min(first_edge_id + BLOCK_SIZE);
            for edge_id in first_edge_id..end_edge_id {
                let edge = &self.edges[(caster.first_edge + edge_id) as usize];
                let sides = count_sides(caster, edge, self.incidences, self.lit);

                // Append the silhouette.
                if sides.left != sides.right {
                    let slot = self.counters.silhouette_edges;
                    self.counters.silhouette_edges += 1;
                    if slot < self.view.silhouette_capacity {
                        self.silhouettes[slot as usize] =
                            SilhouetteEdge { caster: item.caster, edge_id, left: sides.left, right: sides.right };
                    }
                }
                let lane = edge_id - first_edge_id;
                block_sides[lane as usize / 16] |= outline_side(sides) << (lane % 16 * 2);
            }

            // Keep the outline sides for whoever asks about a neighbour.
            let first_word = (caster.first_outline_word + item.block * OUTLINE_WORDS_PER_BLOCK) as usize;
            self.outline_sides[first_word..][..block_sides.len()].copy_from_slice(&block_sides);
        }
    }
}

fn count_sides(caster: &Caster, edge: &Edge, incidences: &[u32], lit: &[u32]) -> Sides {
    let pair = [edge.first, edge.second];
    let words = if edge.first == INCIDENCE_LIST {
        let list = (caster.first_incidence + edge.second) as usize;
        &incidences[list + 1..][..incidences[list] as usize]
    } else {
        &pair
    };
    let mut sides = Sides::default();
    for &word in words {
        if word == INCIDENCE_NONE {
            continue;
        }
        // A face is on the left when its sign and its orientation along the edge agree.
        if is_lit(caster, lit, word >> 1) == (word & INCIDENCE_ALONG != 0) {
            sides.left += 1;
        } else {
            sides.right += 1;
        }
    }
    sides
}

fn is_lit(caster: &Caster, lit: &[u32], face: u32) -> bool {
    face != UNLIT_FACE && lit[(caster.first_lit_word + face / 32) as usize] >> (face % 32) & 1 == 1
}

fn outline_side(sides: Sides) -> u32 {
    match (sides.left, sides.right) {
        (1.., 0) => OUTLINE_BLOCKER_LEFT,
        (0, 1..) => OUTLINE_BLOCKER_RIGHT,
        _ => OUTLINE_NONE,
    }
}
