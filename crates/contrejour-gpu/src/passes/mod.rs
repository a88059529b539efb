//! The raster passes that fill a light view's maps: what each runs, binds and writes.

mod blurred_moments;
mod hardware_shadow_map;
mod masked_hardware_shadow_map;
mod masked_shadow_map;
mod moments;
mod shadow_map;
mod silhouette_map;
mod silhouette_map_stream;
mod silhouette_map_tam;
mod smoothie_alpha;
mod smoothie_buffer;
mod smoothie_depth;

use contrejour_plan::{Pass, TextureKind};

use crate::wgsl::{ShaderModule, wgsl};

/// A pass over a light view's maps. It binds [`Pass::buffers`] in their order, but for the draw arguments; then the
/// texture that it reads. Entry points and override constants are the plan's.
#[derive(Clone, Copy, Debug)]
pub struct MapPass {
    /// Which pass this is.
    pub pass: Pass,
    /// The text of its shader module.
    pub wgsl: &'static str,
    /// The texture that its fragments read.
    pub reads: Option<TextureKind>,
    /// Where the number of vertices of each of its draws comes from.
    pub draws: &'static [DrawCount],
    /// The levels of its target that it fills.
    pub levels: Levels,
    /// Colour target.
    pub color: Option<ColorTarget>,
    /// Depth buffer: nearest wins.
    pub depth: Option<DepthTarget>,
}

/// Where a number of vertices comes from.
#[derive(Clone, Copy, Debug)]
pub enum DrawCount {
    /// An entry of the indirect draw arguments.
    Indirect(u32),
    /// One triangle.
    FullScreen,
}

/// The levels of a target that a pass fills.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Levels {
    /// The first, which is the only one of most textures.
    First,
    /// One after the other all but the first, each from the one before it.
    AllButFirst,
}

/// A colour target of a pass.
#[derive(Clone, Copy, Debug)]
pub struct ColorTarget {
    /// The texture.
    pub texture: TextureKind,
    /// What it holds before.
    pub clear: ClearColor,
    /// Whether the least value of each channel wins; else the last one that passes the depth test.
    pub minimum: bool,
}

/// What a colour target holds before.
#[derive(Clone, Copy, Debug)]
pub enum ClearColor {
    /// Nothing that matters: every texel is drawn.
    Nothing,
    /// What the pass before drew.
    Drawn,
    /// The farthest depth of the view.
    FarDepth,
    /// Alpha of no smoothie.
    Lit,
    /// Both, in two channels.
    FarDepthAndLit,
    /// The farthest depth of the view, and a distance that no silhouette has.
    FarDepthAndDistance,
}

/// A depth buffer of a pass.
#[derive(Clone, Copy, Debug)]
pub struct DepthTarget {
    /// The texture.
    pub texture: TextureKind,
    /// Whether it holds what the pass before drew; else it is cleared to the farthest depth.
    pub is_drawn: bool,
    /// When somebody reads it afterwards.
    pub kept: DepthKept,
}

/// When a depth buffer is read after a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DepthKept {
    /// Never.
    Never,
    /// Where a pass of this kind follows.
    Before(Pass),
    /// Always: it is a map.
    Always,
}

/// All passes over a light view's maps, in the order in which a frame runs them.
pub const ALL: [MapPass; 17] = [
    hardware_shadow_map::HARDWARE_SHADOW_MAP,
    shadow_map::SHADOW_MAP,
    masked_hardware_shadow_map::MASKED_HARDWARE_SHADOW_MAP,
    masked_shadow_map::MASKED_SHADOW_MAP,
    moments::MOMENTS,
    blurred_moments::BLURRED_MOMENTS,
    smoothie_depth::SMOOTHIE_DEPTH,
    smoothie_alpha::SMOOTHIE_ALPHA,
    smoothie_buffer::SMOOTHIE_BUFFER,
    silhouette_map::SILHOUETTE_MAP,
    silhouette_map_tam::SILHOUETTE_MAP_TAM,
    silhouette_map_stream::SILHOUETTE_MAP_STREAM,
    silhouette_map_stream::SILHOUETTE_MAP_HALF_STREAM,
    silhouette_map::BLENDED_SILHOUETTE_MAP,
    silhouette_map_tam::BLENDED_SILHOUETTE_MAP_TAM,
    silhouette_map_stream::BLENDED_SILHOUETTE_MAP_STREAM,
    silhouette_map_stream::BLENDED_SILHOUETTE_MAP_HALF_STREAM,
];

/// What a pass of a silhouette map is without depth that its fragments write.
const fn blended(pass: Pass, by_depth: MapPass) -> MapPass {
    let color =
        ColorTarget { texture: TextureKind::SilhouetteMap, clear: ClearColor::FarDepthAndDistance, minimum: true };
    MapPass { pass, color: Some(color), depth: None, ..by_depth }
}

const SHADOW_MAP_WGSL: &str = wgsl!(
    "raster/shadow_map",
    "topology",
    "light",
    "caster_position",
    "view_depth",
    "power_of_two",
    "shadow_vertex",
    "nowhere"
);

const MASKED_SHADOW_MAP_WGSL: &str = wgsl!(
    "raster/masked_shadow_map",
    "topology",
    "light",
    "caster_position",
    "view_depth",
    "power_of_two",
    "shadow_vertex",
    "nowhere",
    "mask"
);

const SMOOTHIE_WGSL: &str =
    wgsl!("raster/smoothie_buffer", "light", "light_outline", "args", "outline", "quad_corner", "view_depth");

const SMOOTHIE_DRAWS: &[DrawCount] = &[DrawCount::Indirect(1), DrawCount::Indirect(2)];

/// The shader modules of the raster passes, those of one text once.
pub(crate) const MODULES: &[ShaderModule] = &[
    ShaderModule::of("shadow_map", SHADOW_MAP_WGSL),
    ShaderModule::of("masked_shadow_map", MASKED_SHADOW_MAP_WGSL),
    ShaderModule::of("moments", moments::MOMENTS.wgsl),
    ShaderModule::of("blurred_moments", blurred_moments::BLURRED_MOMENTS.wgsl),
    ShaderModule::of("smoothie_buffer", SMOOTHIE_WGSL),
    ShaderModule::of("silhouette_map", silhouette_map::SILHOUETTE_MAP.wgsl),
    ShaderModule::of("silhouette_map_tam", silhouette_map_tam::SILHOUETTE_MAP_TAM.wgsl),
    ShaderModule::of("silhouette_map_stream", silhouette_map_stream::SILHOUETTE_MAP_STREAM.wgsl),
    ShaderModule::of("silhouette_map_stream+half", silhouette_map_stream::SILHOUETTE_MAP_HALF_STREAM.wgsl),
];
