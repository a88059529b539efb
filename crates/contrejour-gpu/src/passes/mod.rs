//! The raster passes that fill a light view's maps: what each runs, binds and writes.

mod shadow_map;
mod smoothie_alpha;
mod smoothie_buffer;
mod smoothie_depth;

use contrejour_plan::{Pass, TextureKind};

use crate::wgsl::{ShaderModule, wgsl};

/// A pass over a light view's maps. It binds [`Pass::buffers`] in their order, but for the draw arguments; then the
/// shadow map's linear depth where it reads that. Entry points and override constants are the plan's.
#[derive(Clone, Copy, Debug)]
pub struct MapPass {
    /// Which pass this is.
    pub pass: Pass,
    /// The text of its shader module.
    pub wgsl: &'static str,
    /// Whether its fragments read the linear depth of the shadow map.
    pub reads_shadow_depth: bool,
    /// Where the number of vertices of each of its draws comes from.
    pub draws: &'static [DrawCount],
    /// Colour target.
    pub color: Option<ColorTarget>,
    /// Depth buffer: nearest wins.
    pub depth: Option<DepthTarget>,
}

/// Where a number of vertices comes from.
#[derive(Clone, Copy, Debug)]
pub enum DrawCount {
    /// Three for each of 64 faces for each work item.
    FaceItems,
    /// An entry of the indirect draw arguments.
    Indirect(u32),
}

/// A colour target of a pass.
#[derive(Clone, Copy, Debug)]
pub struct ColorTarget {
    /// The texture.
    pub texture: TextureKind,
    /// What it is cleared to.
    pub clear: ClearColor,
    /// Whether the least value of each channel wins; else the last one that passes the depth test.
    pub minimum: bool,
}

/// What a colour target is cleared to.
#[derive(Clone, Copy, Debug)]
pub enum ClearColor {
    /// The farthest depth of the view.
    FarDepth,
    /// Alpha of no smoothie.
    Lit,
    /// Both, in two channels.
    FarDepthAndLit,
}

/// A depth buffer of a pass.
#[derive(Clone, Copy, Debug)]
pub struct DepthTarget {
    /// The texture.
    pub texture: TextureKind,
    /// Whether somebody reads it afterwards.
    pub is_kept: bool,
}

/// All passes over a light view's maps, in the order in which a frame runs them.
pub const ALL: [MapPass; 4] = [
    shadow_map::SHADOW_MAP,
    smoothie_depth::SMOOTHIE_DEPTH,
    smoothie_alpha::SMOOTHIE_ALPHA,
    smoothie_buffer::SMOOTHIE_BUFFER,
];

const SMOOTHIE_WGSL: &str = wgsl!("raster/smoothie_buffer", "light", "args", "outline", "view_depth");

const SMOOTHIE_DRAWS: &[DrawCount] = &[DrawCount::Indirect(0), DrawCount::Indirect(1)];

/// The visibility function by the shadow map alone.
pub(crate) const VISIBILITY_SHADOW_MAP: &str = wgsl!("shared/receiver_lookup", "receiver", "visibility_shadow_map");

/// The visibility function by shadow map and smoothie buffer in two textures.
pub(crate) const VISIBILITY_SMOOTHIES_SPLIT: &str =
    wgsl!("shared/receiver_lookup", "receiver", "visibility_smoothies", "smoothie_split");

/// The visibility function by shadow map and smoothie buffer in one texture.
pub(crate) const VISIBILITY_SMOOTHIES_PACKED: &str =
    wgsl!("shared/receiver_lookup", "receiver", "visibility_smoothies", "smoothie_packed");

/// The full-screen pass, to be joined with one of the visibility functions.
macro_rules! visibility_pass {
    ($($shared:literal),*) => { wgsl!("raster/visibility", "eye", "receiver", "receiver_lookup", $($shared),*) };
}

pub(crate) const VISIBILITY_PASS_SHADOW_MAP: &str = visibility_pass!("visibility_shadow_map");
pub(crate) const VISIBILITY_PASS_SPLIT: &str = visibility_pass!("visibility_smoothies", "smoothie_split");
pub(crate) const VISIBILITY_PASS_PACKED: &str = visibility_pass!("visibility_smoothies", "smoothie_packed");

/// The shader modules of all raster passes.
pub(crate) const MODULES: &[ShaderModule] = &[
    ShaderModule { name: "shadow_map", wgsl: shadow_map::SHADOW_MAP.wgsl },
    ShaderModule { name: "smoothie_buffer", wgsl: SMOOTHIE_WGSL },
    ShaderModule { name: "visibility+shadow_map", wgsl: VISIBILITY_PASS_SHADOW_MAP },
    ShaderModule { name: "visibility+smoothie_split", wgsl: VISIBILITY_PASS_SPLIT },
    ShaderModule { name: "visibility+smoothie_packed", wgsl: VISIBILITY_PASS_PACKED },
];
