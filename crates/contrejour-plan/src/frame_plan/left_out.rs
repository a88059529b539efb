//! What a frame does not do, and why.

use core::fmt;

use super::Pass;

/// Something that the plan left out.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LeftOut {
    /// What.
    pub what: Omitted,
    /// Why.
    pub reason: Reason,
}

/// What can be left out.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Omitted {
    /// The stages that place casters and list their blocks.
    PlacementStages,
    /// The stages that find silhouettes, with their buffers.
    DetectionStages,
    /// The stages that make quads and corners, with their buffers.
    ExtrusionStages,
    /// The stage that makes corners, with its buffers.
    CornerStage,
    /// All smoothie passes, with their textures.
    SmoothiePasses,
    /// The passes that draw silhouettes, with their textures.
    SilhouettePasses,
    /// Both passes that draw masked faces, with the masks.
    MaskedPasses,
    /// One pass, with its textures.
    Pass(Pass),
    /// The work items of the caster of this name.
    CasterWork(String),
    /// Silhouette of the caster of this name, and all that is drawn from it.
    Silhouette(String),
    /// Topology and caster record of the mesh of this name.
    Topology(String),
    /// A buffer of instance transforms.
    InstanceTransforms,
    /// Stages that deform positions.
    Deformation,
    /// The planes of faces.
    FacePlanes,
    /// Tests of all views of the scene together, up to eight at once.
    TestsTogether,
    /// The search for blockers.
    BlockerSearch,
    /// 32-bit moments and stronger warps.
    FullMoments,
    /// All stages and passes, in this frame.
    Redrawing,
}

/// Why something was left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Reason {
    /// The technique makes no smoothies.
    TechniqueHasNoSmoothies,
    /// The technique makes no silhouette map.
    TechniqueHasNoSilhouetteMap,
    /// The technique looks at no silhouettes.
    TechniqueHasNoSilhouettes,
    /// Compute stages find silhouettes.
    StagesFindThem,
    /// The vertex stage of the pass finds silhouettes.
    VertexStageFindsThem,
    /// A stream of normals tells the vertex stage which they are.
    StreamTellsThem,
    /// Depth that fragments write tells the nearest silhouette.
    DepthTellsTheNearest,
    /// The settings ask for the least distance by blending.
    BlendingAskedFor,
    /// Quads that reach around the ends of their edges leave no gap.
    QuadsReachAroundEnds,
    /// The shadow is as soft as the light's size asks, and it has none.
    LightHasNoSize,
    /// The technique reads no moments of depth.
    TechniqueHasNoMoments,
    /// Linear depth is what is read.
    LinearDepthIsRead,
    /// Receivers look up hardware depth alone.
    HardwareDepthIsEnough,
    /// The device's samplers do not weigh 32-bit floats.
    DeviceFiltersNoFloats,
    /// The settings ask for 16 bits.
    HalvesAskedFor,
    /// The shadow map is 16-bit, and every device blends 16-bit floats.
    HalvesBlend,
    /// The caller wants the list of silhouette edges and nothing else.
    OnlySilhouettesWanted,
    /// The caller looks the maps up in a shader of its own.
    NoVisibilityTextureWanted,
    /// No mesh with a face casts.
    NothingCasts,
    /// The device blends 32-bit floats, so one pass does the work of two.
    DeviceBlendsFloats,
    /// The device does not blend 32-bit floats.
    DeviceBlendsNoFloats,
    /// The settings ask for two passes.
    TwoPassesAskedFor,
    /// The caster is outside the light's frustum, smoothies included.
    OutsideFrustum,
    /// The caster's matrix is singular for this light.
    SingularMatrix,
    /// The mesh has no face.
    NoFaces,
    /// The mesh only receives.
    ReceivesOnly,
    /// A mask cuts the caster's faces, so nobody knows its silhouette: it is in the shadow map alone.
    MaskCutsIt,
    /// The caster brings its own positions, and a stream holds those of its mesh: it is in the shadow map alone.
    StreamIsAtRest,
    /// Masks cut the faces of everything that casts.
    MasksCutAll,
    /// No mask cuts a caster.
    NothingIsMasked,
    /// Each caster has one matrix.
    NothingIsInstanced,
    /// Positions come as they are drawn.
    NothingIsSkinned,
    /// All casters bring their own positions.
    PositionsAreTheCallers,
    /// The lists of so many views would take more than 192 MiB, or one of them more than the device allows.
    ListsAreTooLarge,
    /// Neither the light nor anything within its reach changed: its maps stand.
    NothingChanged,
}

impl fmt::Display for Omitted {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match self {
            Self::PlacementStages => "placement stages",
            Self::DetectionStages => "detection stages",
            Self::ExtrusionStages => "extrusion stages",
            Self::CornerStage => "corner stage",
            Self::SmoothiePasses => "smoothie passes",
            Self::SilhouettePasses => "silhouette map",
            Self::MaskedPasses => "masked passes",
            Self::Pass(pass) => return formatter.pad(&format!("pass {}", pass.name())),
            Self::CasterWork(name) => return formatter.pad(&format!("work of caster {name}")),
            Self::Silhouette(name) => return formatter.pad(&format!("silhouette of {name}")),
            Self::Topology(name) => return formatter.pad(&format!("topology of {name}")),
            Self::InstanceTransforms => "instance transforms",
            Self::Deformation => "deformation",
            Self::FacePlanes => "planes of faces",
            Self::TestsTogether => "tests of more views at once",
            Self::BlockerSearch => "search for blockers",
            Self::FullMoments => "32-bit moments",
            Self::Redrawing => "all stages and passes",
        };
        formatter.pad(text)
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.pad(match self {
            Self::TechniqueHasNoSmoothies => "the technique makes no smoothies",
            Self::TechniqueHasNoSilhouetteMap => "the technique makes no silhouette map",
            Self::TechniqueHasNoSilhouettes => "the technique looks at no silhouettes",
            Self::StagesFindThem => "compute stages find silhouettes",
            Self::VertexStageFindsThem => "the vertex stage finds silhouettes",
            Self::StreamTellsThem => "a stream of normals tells the vertex stage where silhouettes are",
            Self::DepthTellsTheNearest => "depth that fragments write tells the nearest silhouette",
            Self::BlendingAskedFor => "the settings ask for the least distance by blending",
            Self::QuadsReachAroundEnds => "quads reach around the ends of their edges",
            Self::LightHasNoSize => "the shadow is as soft as the light's size asks, and it has none",
            Self::TechniqueHasNoMoments => "the technique reads no moments of depth",
            Self::LinearDepthIsRead => "linear depth is what is read",
            Self::HardwareDepthIsEnough => "receivers look up hardware depth alone",
            Self::DeviceFiltersNoFloats => {
                "the device's samplers do not weigh 32-bit floats: 16 bits, and an exponent of at most 5.54"
            }
            Self::HalvesAskedFor => "the settings ask for 16 bits, with an exponent of at most 5.54",
            Self::HalvesBlend => "16-bit floats blend on every device: one pass fills depth and alpha",
            Self::OnlySilhouettesWanted => "only the list of silhouette edges is wanted",
            Self::NoVisibilityTextureWanted => "the maps are looked up in the caller's own shader",
            Self::NothingCasts => "no mesh with a face casts",
            Self::DeviceBlendsFloats => "the device blends 32-bit floats: one pass fills depth and alpha",
            Self::DeviceBlendsNoFloats => "the device does not blend 32-bit floats",
            Self::TwoPassesAskedFor => "the settings ask for two passes",
            Self::OutsideFrustum => "outside the light's frustum, smoothies included",
            Self::SingularMatrix => "its matrix is singular for this light",
            Self::NoFaces => "it has no face",
            Self::ReceivesOnly => "it only receives",
            Self::MaskCutsIt => "a mask cuts its faces: it is in the shadow map alone",
            Self::StreamIsAtRest => {
                "its positions are the caller's and the stream's are the mesh's own: it is in the shadow map alone"
            }
            Self::MasksCutAll => "masks cut the faces of everything that casts",
            Self::NothingIsMasked => "no mask cuts a caster",
            Self::NothingIsInstanced => "each caster has one matrix",
            Self::NothingIsSkinned => "positions come as they are drawn",
            Self::NothingChanged => "neither the light nor anything within its reach changed: its maps stand",
            Self::ListsAreTooLarge => {
                "their lists would take more than 192 MiB together, or one of them more than the device allows"
            }
            Self::PositionsAreTheCallers => "all positions are the caller's: faces are tested by them",
        })
    }
}
