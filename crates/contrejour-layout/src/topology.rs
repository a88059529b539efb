//! What is written once per mesh.

use crate::shared_struct::shared_struct;

shared_struct! {
    /// Three welded vertex ids. A vertex id is the lowest index among the source vertices with the same position.
    Face {
        /// First corner.
        a: u32,
        /// Second corner.
        b: u32,
        /// Third corner.
        c: u32,
    }
}

shared_struct! {
    /// What is across the three edges of a face: the third corner of the face there, with the bits [`ACROSS_ALONG`] and
    /// [`ACROSS_ALONE`]; or [`ACROSS_NOTHING`], [`ACROSS_NEVER`] or [`ACROSS_FAN`].
    FaceNeighbours {
        /// Across the edge from the first to the second corner.
        across_ab: u32,
        /// Across the edge from the second to the third corner.
        across_bc: u32,
        /// Across the edge from the third to the first corner.
        across_ca: u32,
    }
}

/// No face is across an edge: it is always in the silhouette.
pub const ACROSS_NOTHING: u32 = u32::MAX;

/// The edge is never in the silhouette.
pub const ACROSS_NEVER: u32 = u32::MAX - 1;

/// The two highest bits of a word of [`FaceNeighbours`] where more than two faces are at the edge and this one draws it: the
/// others are the offset of the edge's fan, a count and then a word for each face. That is its third corner, or
/// [`FAN_UNLIT`], and [`ACROSS_ALONG`] where its sign counts as it is (see [`INCIDENCE_ALONG`]).
pub const ACROSS_FAN: u32 = 1 << 31;

/// Third corner of a face that is unlit whatever the light.
pub const FAN_UNLIT: u32 = (1 << 30) - 1;

/// Bit of a word of [`FaceNeighbours`]: the face across runs along the edge as this one does, so one of the two is wound the
/// wrong way. Never without [`ACROSS_ALONE`].
pub const ACROSS_ALONG: u32 = 1 << 31;

/// Bit of a word of [`FaceNeighbours`]: the face across may not draw the edge, so this one does also where it is unlit.
pub const ACROSS_ALONE: u32 = 1 << 30;

/// Words of one face of a topology-aware stream: three corners and the normals across the edges from each to the next, as
/// 32-bit floats.
pub const STREAM_FACE_WORDS: u32 = 18;

/// The same as 16-bit floats, two to a word, the first one low.
pub const HALF_STREAM_FACE_WORDS: u32 = 9;

shared_struct! {
    /// One edge and the faces at it.
    ///
    /// With at most two faces, `first` and `second` are [incidence words](incidence). With more, `first` is
    /// [`INCIDENCE_LIST`] and `second` is the offset of a list in the mesh's incidence words: a count, then so many
    /// incidence words.
    Edge {
        /// The lower vertex id: the edge's direction starts here.
        low_vertex: u32,
        /// The higher vertex id.
        high_vertex: u32,
        /// Incidence word or [`INCIDENCE_LIST`].
        first: u32,
        /// Incidence word, [`INCIDENCE_NONE`] or the offset of a list.
        second: u32,
    }
}

/// No face here.
pub const INCIDENCE_NONE: u32 = u32::MAX;

/// The edge has more than two faces: its incidence words stand in a list.
pub const INCIDENCE_LIST: u32 = u32::MAX - 1;

/// The face id that stands for "unlit, whatever the light": a face without area that has no partner.
pub const UNLIT_FACE: u32 = 0x7fff_fffd;

/// Bit 0 of an incidence word: the face's sign counts as it is (set) or negated (clear).
pub const INCIDENCE_ALONG: u32 = 1;

/// The incidence word of a face at an edge: `face << 1`, and bit 0 set where its sign counts as it is.
///
/// Bit 0 is the orientation `o`: set when the face runs along the edge from its lower to its higher vertex. For a
/// face without area the word names its partner, and bit 0 is the orientation that gives the sign it takes from it.
pub const fn incidence(face: u32, along: bool) -> u32 {
    face << 1 | along as u32
}

shared_struct! {
    /// One edge as seen from one of its ends.
    VertexEdge {
        /// The edge.
        edge_id: u32,
        /// The vertex at its other end.
        other_vertex: u32,
    }
}

shared_struct! {
    /// One mesh that casts a shadow: where its parts lie in the pooled buffers.
    ///
    /// Where a mesh fills several pages, each page has a record of it, with the faces and edges that lie there: ids are
    /// those of the whole mesh on each page. So where face or edge 0 lies elsewhere, its place may be below zero; sums
    /// of a place and an id wrap.
    Caster {
        /// Where its positions start, in words.
        first_position_word: u32,
        /// From one position to the next, in words; at least 3.
        position_stride_words: u32,
        /// Where its face 0 lies, or would lie, in the pool of faces.
        first_face: u32,
        /// Number of its faces.
        face_count: u32,
        /// Where its edge 0 lies, or would lie, in the pool of edges.
        first_edge: u32,
        /// Number of its edges that can be in a silhouette.
        edge_count: u32,
        /// Where its incidence lists start, or would start, in the pool of incidence words.
        first_incidence: u32,
        /// Where its vertex offsets start in the pool of vertex edges, in words. `offset[v] .. offset[v + 1]` are
        /// the vertex edges of vertex `v`.
        first_vertex_offset_word: u32,
        /// Where its vertex edges start in the same pool, in words.
        first_vertex_edge_word: u32,
        /// Where its lit bits start in the buffer of lit bits, in words for each seat of the bundle.
        first_lit_word: u32,
        /// Where its outline sides start in the buffer of outline sides, in words.
        first_outline_word: u32,
        /// A power of two that brings its positions, less `position_origin`, near 1. Matrices expect the scaled positions;
        /// facing never does.
        position_scale: f32,
        /// A point amid its positions where those are far from zero, so that the image keeps all their digits; else
        /// zeros.
        position_origin: [f32; 3],
        /// One more than the index of its [`Mask`]; 0 where nothing cuts its faces.
        mask: u32,
    }
}

shared_struct! {
    /// What cuts the faces of a mesh: alpha, as a picture has it times that of the vertices.
    Mask {
        /// Where its vertices start in the buffer of mask words: for each source vertex the two coordinates in the picture
        /// and its alpha, three 32-bit floats.
        first_vertex_word: u32,
        /// Where its picture starts there: level after level from the largest, rows from the top, one byte a texel, each
        /// level from a word on.
        first_texel_word: u32,
        /// Texels from left to right of the first level; each level has half as many as the one before, at least 1.
        width: u32,
        /// Texels from top to bottom of the first level.
        height: u32,
        /// Levels, at least 1.
        levels: u32,
        /// What is left and right of the picture: [`MASK_REPEAT`], [`MASK_MIRROR`] or [`MASK_CLAMP`].
        wrap_u: u32,
        /// What is above and below it.
        wrap_v: u32,
        /// 1 where the nearest texel counts, 0 where the nearest four are weighed.
        is_nearest: u32,
        /// Alpha below which there is nothing.
        cutoff: f32,
    }
}

/// Beyond its edges the picture comes again.
pub const MASK_REPEAT: u32 = 0;

/// Beyond its edges the picture comes again, each second one mirrored.
pub const MASK_MIRROR: u32 = 1;

/// Beyond its edges are the texels at the edge.
pub const MASK_CLAMP: u32 = 2;

shared_struct! {
    /// One block of [`BLOCK_SIZE`](crate::BLOCK_SIZE) faces or edges of one caster.
    WorkItem {
        /// Index of the caster, or [`NO_CASTER`] in a list of blocks.
        caster: u32,
        /// Which block of its faces or edges.
        block: u32,
        /// What is done with a block of faces: [`BLOCK_BY_PLANES`], [`BLOCK_BY_POSITIONS`], [`BLOCK_MASKED`] or
        /// [`BLOCK_OF_CALLER`]. 0 for edges.
        kind: u32,
    }
}

/// Its faces are tested by their stored planes.
pub const BLOCK_BY_PLANES: u32 = 0;

/// Its faces are tested by their positions, since a plane does not fit into floats.
pub const BLOCK_BY_POSITIONS: u32 = 1;

/// Its faces have a mask: they are drawn into the shadow map and no stage tests them.
pub const BLOCK_MASKED: u32 = 2;

/// Its faces are tested by their positions, which are the caller's: nothing that is stored of the mesh's own tells of them.
pub const BLOCK_OF_CALLER: u32 = 3;

/// The caster of a block that is nobody's: a caster left it, and none has come to its place. No stage lists it.
pub const NO_CASTER: u32 = u32::MAX;
