//! Views whose faces and edges are tested together: each face and each edge is read once for all of them.

use crate::args::Counters;
use crate::light::LightView;
use crate::shared_struct::shared_struct;

/// Most views that are tested together. Each has a seat of its own, from 0 on.
pub const MAX_SEATS: u32 = 8;

shared_struct! {
    /// How the views of a bundle share its lists.
    BundleShape {
        /// Seats: 1, 2, 4 or 8. A face has as many lit bits, one for each seat. The record of a seat that nobody has is
        /// zero: it sees no caster and no block.
        seat_count: u32,
        /// Its logarithm to base 2.
        seat_shift: u32,
        /// From one seat's caster lights to the next one's, in records.
        caster_stride: u32,
        /// From one seat's list of blocks to draw to the next one's, in records.
        item_stride: u32,
        /// From one seat's silhouette list to the next one's, in records.
        silhouette_stride: u32,
        /// From one seat's outline sides to the next one's, in words.
        outline_stride: u32,
        /// Zero.
        unused_0: u32,
        /// Zero.
        unused_1: u32,
    }
}

shared_struct! {
    /// Views that are tested together. A uniform.
    ViewBundle {
        /// The view of each seat. Uniforms of one view are parts of it.
        views: [LightView; MAX_SEATS as usize],
        /// How they share the lists.
        shape: BundleShape,
    }
}

shared_struct! {
    /// What is done once for several views: one block of [`BLOCK_SIZE`](crate::BLOCK_SIZE) faces or edges of one caster.
    TestItem {
        /// Index of the caster.
        caster: u32,
        /// Which block of its faces or edges.
        block: u32,
        /// As in [`WorkItem`](crate::WorkItem).
        kind: u32,
        /// A bit for each seat whose view the caster casts for.
        seats: u32,
    }
}

shared_struct! {
    /// What was counted for the view of a seat; for seat 0 also what its bundle counts together.
    SeatCounters {
        /// What its view needs.
        counts: Counters,
        /// Blocks of faces that are tested for some view of the bundle.
        face_tests: u32,
        /// Blocks of edges that are tested for some view of the bundle.
        edge_tests: u32,
        /// Words of lit bits with faces that their planes leave undecided for some view of the bundle.
        recheck_words: u32,
        /// Undecided faces that short integers can decide, once for each view that they are undecided for; they fill the
        /// list from its front.
        undecided_near: u32,
        /// The same of those that need full integers; they fill the list from its back.
        undecided_far: u32,
        /// Zeros.
        unused_0: [u32; 32],
        /// Zeros: uniforms and storage of one view begin at multiples of 256 bytes.
        unused_1: [u32; 15],
    }
}

impl ViewBundle {
    /// One view alone, in the only seat.
    pub fn of_one(view: &LightView) -> Self {
        let mut bundle = Self { shape: BundleShape { seat_count: 1, ..BundleShape::default() }, ..Self::default() };
        bundle.views[0] = *view;
        bundle
    }
}

/// The lit bits that one seat has among those of a bundle with so many seats: one a face, 32 to a word.
pub fn lit_of_seat(lit: &[u32], seat_count: u32, seat: u32) -> Vec<u32> {
    let bit = |test: u32| lit[test as usize / 32] >> (test % 32) & 1;
    let word = |word: u32| (0..32).map(|face| bit((word * 32 + face) * seat_count + seat) << face).sum();
    (0..lit.len() as u32 / seat_count).map(word).collect()
}
