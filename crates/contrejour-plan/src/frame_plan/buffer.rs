//! The buffers of a frame.

use contrejour_layout as layout;

/// A buffer of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum BufferKind {
    /// Positions of all meshes, in words; then those that callers bring.
    Positions,
    /// Faces of all meshes.
    Faces,
    /// What is across the edges of the faces of all meshes.
    FaceNeighbours,
    /// The faces around those edges of all meshes that have more than two, in words; as long as [`Incidences`](Self::Incidences).
    EdgeFans,
    /// Topology-aware streams of all meshes, as long as [`Faces`](Self::Faces).
    StreamFaces,
    /// The same as 16-bit floats.
    HalfStreamFaces,
    /// Planes of the faces of all meshes.
    Planes,
    /// Edges of all meshes that can be in a silhouette.
    Edges,
    /// Lists of incidence words of all meshes.
    Incidences,
    /// Vertex offsets and vertex edges of all meshes, in words.
    VertexEdges,
    /// Masks of all meshes.
    Masks,
    /// Vertices and pictures of all masks, in words.
    MaskWords,
    /// Caster records.
    Casters,
    /// Where each caster stands.
    CasterPlaces,
    /// Blocks of faces of all casters.
    FaceBlocks,
    /// Blocks of edges of all casters.
    EdgeBlocks,
    /// Those blocks of faces whose casters cast for the view: to be drawn.
    FaceItems,
    /// Blocks of faces that are tested for some view of a bundle.
    FaceTests,
    /// Blocks of edges that are tested for some view of a bundle.
    EdgeTests,
    /// Dispatch arguments of `classify_faces` and `detect_silhouette`.
    ItemArgs,
    /// The light as each caster sees it.
    CasterLights,
    /// The views of the light.
    LightView,
    /// How a bundle of 1, of 2, of 4 and of 8 views shares its lists.
    BundleShapes,
    /// The views that are tested together, and how they share the lists; a uniform. Each view is one, too.
    ViewBundle,
    /// The views of the light as receivers see them; a uniform.
    ReceiverView,
    /// Lit bits, in words: those of a face for all views of a bundle lie side by side.
    Lit,
    /// Words of lit bits with faces that planes leave undecided.
    RecheckWords,
    /// Dispatch arguments of `recheck_faces`.
    RecheckArgs,
    /// Undecided faces: from the front those for short integers, from the back those for full ones.
    Undecided,
    /// Dispatch arguments of `refine_faces` and `resolve_faces`.
    RefineArgs,
    /// What the stages counted, 256 bytes for each view: [`SeatCounters`](layout::SeatCounters).
    Counters,
    /// The list of silhouette edges.
    Silhouettes,
    /// Outline side of each edge, in words.
    OutlineSides,
    /// Dispatch arguments of `extrude_edges` and `build_corners`.
    ExtrudeArgs,
    /// Quads.
    Quads,
    /// Corners.
    Corners,
    /// Draw arguments of faces, of quads, of corners and of masked faces.
    DrawArgs,
}

/// A buffer that the frame needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct BufferPlan {
    /// Which one.
    pub kind: BufferKind,
    /// Index of the page that it belongs to; 0 where it serves all pages.
    pub page: usize,
    /// Records, or words, that it has room for, for each view that has a seat in it; more than are needed where [it was
    /// made](super::PlanInput::made) for more, or grew.
    pub items: u64,
    /// Views that it has room for at once; 1 where it [serves all alike](Seating::None).
    pub seats: u32,
    /// Its size in bytes. At least one record, since an empty buffer can't be bound.
    pub bytes: u64,
}

/// How the views that are tested together share a buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seating {
    /// It serves all alike.
    None,
    /// Each seat has a part of its own, which begins at a multiple of 256 bytes, as bindings must.
    Apart,
    /// What all seats have of a face lies side by side.
    SideBySide,
}

/// What bindings of storage and of uniforms begin at, in bytes, where a device asks for as much as WebGPU allows.
const BINDING_ALIGNMENT: u64 = 256;

impl BufferKind {
    /// All buffers.
    pub const ALL: [Self; 37] = [
        Self::Positions,
        Self::Faces,
        Self::FaceNeighbours,
        Self::EdgeFans,
        Self::StreamFaces,
        Self::HalfStreamFaces,
        Self::Planes,
        Self::Edges,
        Self::Incidences,
        Self::VertexEdges,
        Self::Masks,
        Self::MaskWords,
        Self::Casters,
        Self::CasterPlaces,
        Self::FaceBlocks,
        Self::EdgeBlocks,
        Self::FaceItems,
        Self::FaceTests,
        Self::EdgeTests,
        Self::ItemArgs,
        Self::CasterLights,
        Self::LightView,
        Self::BundleShapes,
        Self::ViewBundle,
        Self::ReceiverView,
        Self::Lit,
        Self::RecheckWords,
        Self::RecheckArgs,
        Self::Undecided,
        Self::RefineArgs,
        Self::Counters,
        Self::Silhouettes,
        Self::OutlineSides,
        Self::ExtrudeArgs,
        Self::Quads,
        Self::Corners,
        Self::DrawArgs,
    ];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Positions => "positions",
            Self::Faces => "faces",
            Self::FaceNeighbours => "face_neighbours",
            Self::EdgeFans => "edge_fans",
            Self::StreamFaces => "stream_faces",
            Self::HalfStreamFaces => "half_stream_faces",
            Self::Planes => "planes",
            Self::Edges => "edges",
            Self::Incidences => "incidences",
            Self::VertexEdges => "vertex_edges",
            Self::Masks => "masks",
            Self::MaskWords => "mask_words",
            Self::Casters => "casters",
            Self::CasterPlaces => "caster_places",
            Self::FaceBlocks => "face_blocks",
            Self::EdgeBlocks => "edge_blocks",
            Self::FaceItems => "face_items",
            Self::FaceTests => "face_tests",
            Self::EdgeTests => "edge_tests",
            Self::ItemArgs => "item_args",
            Self::CasterLights => "caster_lights",
            Self::LightView => "light_view",
            Self::BundleShapes => "bundle_shapes",
            Self::ViewBundle => "view_bundle",
            Self::ReceiverView => "receiver_view",
            Self::Lit => "lit",
            Self::RecheckWords => "recheck_words",
            Self::RecheckArgs => "recheck_args",
            Self::Undecided => "undecided",
            Self::RefineArgs => "refine_args",
            Self::Counters => "counters",
            Self::Silhouettes => "silhouettes",
            Self::OutlineSides => "outline_sides",
            Self::ExtrudeArgs => "extrude_args",
            Self::Quads => "quads",
            Self::Corners => "corners",
            Self::DrawArgs => "draw_args",
        }
    }

    /// Whether each light has one of its own. The others serve all lights: pools hold what casts, lists are filled for one
    /// bundle of views after the other.
    pub const fn is_of_light(self) -> bool {
        matches!(self, Self::LightView | Self::ReceiverView)
    }

    /// How the views that are tested together share it.
    pub const fn seating(self) -> Seating {
        match self {
            Self::CasterLights
            | Self::FaceItems
            | Self::Counters
            | Self::Silhouettes
            | Self::OutlineSides
            | Self::DrawArgs => Seating::Apart,
            Self::Lit | Self::RecheckWords | Self::Undecided => Seating::SideBySide,
            _ => Seating::None,
        }
    }

    /// Whether each page has one of its own. The others serve all pages: they are small, or vertex ids index them.
    pub const fn is_paged(self) -> bool {
        !matches!(
            self,
            Self::Positions
                | Self::Masks
                | Self::MaskWords
                | Self::CasterPlaces
                | Self::CasterLights
                | Self::ReceiverView
                | Self::Lit
                | Self::OutlineSides
        )
    }

    /// Size of one record or word, in bytes.
    pub const fn item_bytes(self) -> u64 {
        let bytes = match self {
            Self::Positions
            | Self::EdgeFans
            | Self::Incidences
            | Self::VertexEdges
            | Self::MaskWords
            | Self::Lit
            | Self::OutlineSides => 4,
            Self::Masks => size_of::<layout::Mask>(),
            Self::Faces => size_of::<layout::Face>(),
            Self::FaceNeighbours => size_of::<layout::FaceNeighbours>(),
            Self::StreamFaces => 4 * layout::STREAM_FACE_WORDS as usize,
            Self::HalfStreamFaces => 4 * layout::HALF_STREAM_FACE_WORDS as usize,
            Self::Planes => size_of::<[f32; 4]>(),
            Self::Edges => size_of::<layout::Edge>(),
            Self::Casters => size_of::<layout::Caster>(),
            Self::CasterPlaces => size_of::<layout::CasterPlace>(),
            Self::FaceBlocks | Self::EdgeBlocks | Self::FaceItems => size_of::<layout::WorkItem>(),
            Self::FaceTests | Self::EdgeTests => size_of::<layout::TestItem>(),
            Self::CasterLights => size_of::<layout::CasterLight>(),
            Self::LightView => size_of::<layout::LightView>(),
            Self::BundleShapes => size_of::<layout::BundleShape>(),
            Self::ViewBundle => size_of::<layout::ViewBundle>(),
            Self::ReceiverView => size_of::<layout::ReceiverView>(),
            Self::RecheckWords => size_of::<layout::RecheckWord>(),
            Self::Undecided => size_of::<layout::FaceTest>(),
            Self::ItemArgs | Self::RecheckArgs | Self::RefineArgs | Self::ExtrudeArgs => {
                size_of::<layout::DispatchArgs>()
            }
            Self::Counters => size_of::<layout::SeatCounters>(),
            Self::Silhouettes => size_of::<layout::SilhouetteEdge>(),
            Self::Quads => size_of::<layout::Quad>(),
            Self::Corners => size_of::<layout::Corner>(),
            Self::DrawArgs => size_of::<layout::DrawArgs>(),
        };
        bytes as u64
    }
}

impl BufferPlan {
    pub(super) fn new(kind: BufferKind, page: usize, items: u64) -> Self {
        Self { kind, page, items, seats: 1, bytes: items.max(1).saturating_mul(kind.item_bytes()) }
    }

    /// The same with room for so many views, as far as they have seats in it.
    pub(super) fn with_seats(self, seats: u32) -> Self {
        let one = Self::new(self.kind, self.page, self.items);
        // Whole records, from which the next ones can be bound.
        let whole =
            BINDING_ALIGNMENT >> self.kind.item_bytes().trailing_zeros().min(BINDING_ALIGNMENT.trailing_zeros());
        let apart = self.items.max(1).next_multiple_of(whole).saturating_mul(self.kind.item_bytes());
        match self.kind.seating() {
            Seating::None => one,
            _ if seats == 1 => one,
            Seating::Apart => Self { seats, bytes: apart.saturating_mul(seats.into()), ..one },
            Seating::SideBySide => Self { seats, bytes: one.bytes.saturating_mul(seats.into()), ..one },
        }
    }

    /// From the part of one seat to the next one's, in bytes; the whole size where [no seat has one](Seating::Apart).
    pub fn stride(&self) -> u64 {
        if self.kind.seating() == Seating::Apart { self.bytes / u64::from(self.seats) } else { self.bytes }
    }
}
