//! Bytes that contrejour's Rust and WGSL share: every buffer record, once, with its field names, order and meaning.
//!
//! No logic and no wgpu. Each `#[repr(C)]` struct here has a WGSL struct of the same name and field names in
//! `shaders/shared/`; a test compares offsets and sizes with what naga computes.
//!
//! # Conventions
//!
//! | What | Convention |
//! | --- | --- |
//! | World and eye space | right-handed, y up, metres |
//! | Clip space | x and y in -1..1, y up, z in 0..1, as WebGPU wants |
//! | Front faces | counter-clockwise |
//! | Light | homogeneous `(L, w)`: `w = 1` a point, `w = 0` a direction **from the scene towards the light** |
//! | Lit | `det(b - a, c - a, L - w a) > 0`; exactly edge-on is unlit |
//! | Edge direction | from the lower to the higher vertex id |
//! | Left, right | as seen from the light, looking along the edge direction |
//! | Depth | linear: distance along the view's axis, world units |
//! | `q` of a depth `z` | `-1 / z` in a perspective view, `z` in an orthographic one: linear on the image plane |
//! | Angles | radians |
//! | `_id` | indexes the mesh for ever |
//! | `_slot` | where an atomic happened to put a record |
//! | Matrices | column-major, named `<to>_from_<from>` |

mod args;
mod bundle;
mod deform;
mod light;
mod outline;
mod place;
mod shared_struct;
mod topology;

pub use args::*;
pub use bundle::*;
pub use deform::*;
pub use light::*;
pub use outline::*;
pub use place::*;
pub use shared_struct::{SharedField, SharedStruct};
pub use topology::*;

/// Faces or edges in one work item, and invocations in one workgroup.
pub const BLOCK_SIZE: u32 = 64;

/// Faces in one word of lit bits.
pub const FACES_PER_WORD: u32 = 32;

/// Words of lit bits that one block of faces fills: one bit a face.
pub const LIT_WORDS_PER_BLOCK: u32 = BLOCK_SIZE / FACES_PER_WORD;

/// Words of outline sides that one block of edges fills: two bits an edge.
pub const OUTLINE_WORDS_PER_BLOCK: u32 = BLOCK_SIZE / 16;

/// Workgroups along x of a dispatch; the rest goes along y (WebGPU's default limit is 65 535 along each).
pub const MAX_GROUPS_X: u32 = 65_535;

/// Vertices that one quad draws: two triangles.
pub const VERTICES_PER_QUAD: u32 = 6;

/// Vertices that one corner draws: two kites of two triangles.
pub const VERTICES_PER_CORNER: u32 = 12;

/// Every struct that Rust and WGSL share, for the test that compares them with naga.
pub const SHARED_STRUCTS: &[SharedStruct] = &[
    Face::SHARED,
    FaceNeighbours::SHARED,
    Edge::SHARED,
    VertexEdge::SHARED,
    Caster::SHARED,
    Mask::SHARED,
    WorkItem::SHARED,
    TestItem::SHARED,
    CasterPlace::SHARED,
    CasterLight::SHARED,
    LightView::SHARED,
    BundleShape::SHARED,
    ViewBundle::SHARED,
    RecheckWord::SHARED,
    FaceTest::SHARED,
    SilhouetteEdge::SHARED,
    Quad::SHARED,
    Corner::SHARED,
    Counters::SHARED,
    SeatCounters::SHARED,
    DispatchArgs::SHARED,
    DrawArgs::SHARED,
    ReceiverView::SHARED,
    EyeView::SHARED,
    RestVertex::SHARED,
    Influence::SHARED,
    MorphDelta::SHARED,
    JointMatrix::SHARED,
    DeformBlock::SHARED,
];
