//! What the compute stages write.

use crate::shared_struct::shared_struct;

shared_struct! {
    /// A word of lit bits with faces that their planes leave undecided.
    RecheckWord {
        /// Index of the caster.
        caster: u32,
        /// Which word of its lit bits: 32 tests.
        word: u32,
        /// The bits of the undecided ones.
        tests: u32,
    }
}

shared_struct! {
    /// One face of one caster, tested for one view.
    FaceTest {
        /// Index of the caster.
        caster: u32,
        /// The face times the [seats](crate::BundleShape::seat_count) of the bundle, plus the seat of the view: which of the
        /// caster's lit bits.
        test: u32,
    }
}

shared_struct! {
    /// An edge whose signed multiplicity `left - right` is not zero.
    SilhouetteEdge {
        /// Index of the caster.
        caster: u32,
        /// The edge.
        edge_id: u32,
        /// Faces on its left as seen from the light.
        left: u32,
        /// Faces on its right.
        right: u32,
    }
}

/// Outline side of an edge that is no outline.
pub const OUTLINE_NONE: u32 = 0;

/// Outline side of an edge with faces on its left only: the smoothie goes to the right.
pub const OUTLINE_BLOCKER_LEFT: u32 = 1;

/// Outline side of an edge with faces on its right only: the smoothie goes to the left.
pub const OUTLINE_BLOCKER_RIGHT: u32 = 2;

shared_struct! {
    /// An outline edge on the light's image plane, clipped, with the direction in which its smoothie extends.
    Quad {
        /// NDC of the end at the lower vertex.
        low_ndc: [f32; 2],
        /// NDC of the end at the higher vertex.
        high_ndc: [f32; 2],
        /// Unit vector on the image plane, across the edge and away from the blocker.
        outward: [f32; 2],
        /// Smoothie width at the low and the high end, in NDC, before a sphere of light stretches it.
        width_ndc: [f32; 2],
        /// Blocker `q` at the low and the high end.
        q: [f32; 2],
        /// Index of the caster.
        caster: u32,
        /// The edge.
        edge_id: u32,
        /// The lower vertex id.
        low_vertex: u32,
        /// The higher vertex id.
        high_vertex: u32,
        /// Which ends are the edge's own and not cut off by clipping: bit 0 low, bit 1 high.
        own_ends: u32,
        /// [`OUTLINE_BLOCKER_LEFT`] or [`OUTLINE_BLOCKER_RIGHT`].
        side: u32,
    }
}

/// Bit of `own_ends`: the low end is the edge's own.
pub const OWN_END_LOW: u32 = 1;

/// Bit of `own_ends`: the high end is the edge's own.
pub const OWN_END_HIGH: u32 = 2;

shared_struct! {
    /// A wedge around an outline vertex, from one quad's outward direction to its neighbour's.
    Corner {
        /// NDC of the vertex.
        apex_ndc: [f32; 2],
        /// Unit outward direction where the wedge begins.
        begin: [f32; 2],
        /// Unit direction halfway.
        middle: [f32; 2],
        /// Unit outward direction where the wedge ends, at most half a turn counter-clockwise from `begin`.
        end: [f32; 2],
        /// Smoothie width at the vertex, in NDC, before a sphere of light stretches it.
        width_ndc: f32,
        /// Blocker `q` at the vertex.
        q: f32,
        /// Index of the caster.
        caster: u32,
        /// The vertex.
        vertex_id: u32,
        /// The edge whose end made this corner.
        edge_id: u32,
        /// [`CORNER_WEDGE`] or [`CORNER_CAP`].
        kind: u32,
    }
}

/// A corner that fills the gap between two neighbouring quads exactly.
pub const CORNER_WEDGE: u32 = 0;

/// A corner that closes one end alone with a quarter disk, where no neighbour can be told apart.
pub const CORNER_CAP: u32 = 1;

/// Vertices with more edges than this close each outline end with a [cap](CORNER_CAP) instead of searching for its
/// neighbour, so that a fan of any size costs bounded work.
pub const MAX_SEARCHED_VALENCE: u32 = 256;
