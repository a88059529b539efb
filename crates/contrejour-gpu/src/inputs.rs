//! What goes into a frame and what is known of it.

use contrejour_layout::Counters;
use contrejour_plan::{DeviceFacts, Outputs, ShadowSettings, TextureKind};

/// How the shadow of a light is made, and what is wanted of it.
#[derive(Clone, Copy, Debug)]
pub struct ShadowOptions {
    /// Technique, map size, bias. Default: the preset `medium`.
    pub settings: ShadowSettings,
    /// What the caller wants of a frame. Default: maps for the visibility function.
    pub outputs: Outputs,
    /// Format of the target of [`Shadows::encode_visibility`](crate::Shadows::encode_visibility). Default: `R8Unorm`.
    pub visibility_format: wgpu::TextureFormat,
}

impl Default for ShadowOptions {
    fn default() -> Self {
        Self {
            settings: ShadowSettings::default(),
            outputs: Outputs::default(),
            visibility_format: wgpu::TextureFormat::R8Unorm,
        }
    }
}

/// The maps of a light: layers, one for each view.
#[derive(Clone, Copy, Debug)]
pub struct Maps<'a> {
    /// Linear depth of the nearest caster, `R32Float`; the view's farthest depth where there is none. With 16 bits
    /// `R16Float`, as a share of the farthest depth.
    pub shadow_depth: Option<&'a wgpu::Texture>,
    /// Clip z of the nearest caster, `Depth32Float`; 1 where there is none. Holds nothing where linear depth is read.
    pub shadow_hardware_depth: Option<&'a wgpu::Texture>,
    /// Moments of depth with all levels, in two or four channels of 16 or 32 bits; for variance shadow maps.
    pub moments: Option<&'a wgpu::Texture>,
    /// Nearest smoothie depth in clip z, `Depth32Float`; where the buffer is in two textures.
    pub smoothie_depth: Option<&'a wgpu::Texture>,
    /// Least smoothie alpha, `R16Float`; where the buffer is in two textures.
    pub smoothie_alpha: Option<&'a wgpu::Texture>,
    /// Nearest linear smoothie depth and least alpha, `Rg32Float`; where the buffer is in one texture. With 16 bits
    /// `Rg16Float`, depth as a share of the farthest.
    pub smoothie_buffer: Option<&'a wgpu::Texture>,
    /// Linear depth of the nearest silhouette, the view's farthest where none is near, and the signed distance to it in
    /// texels, positive on the blocker's side: `Rg32Float`; for silhouette maps. With 16 bits `Rg16Float`, depth as a share
    /// of the farthest.
    pub silhouette_map: Option<&'a wgpu::Texture>,
}

impl<'a> Maps<'a> {
    /// The map of one kind.
    pub fn of(self, kind: TextureKind) -> Option<&'a wgpu::Texture> {
        match kind {
            TextureKind::ShadowDepth => self.shadow_depth,
            TextureKind::ShadowHardwareDepth => self.shadow_hardware_depth,
            TextureKind::Moments => self.moments,
            TextureKind::SmoothieDepth => self.smoothie_depth,
            TextureKind::SmoothieAlpha => self.smoothie_alpha,
            TextureKind::SmoothieBuffer => self.smoothie_buffer,
            TextureKind::SilhouetteMap => self.silhouette_map,
            TextureKind::SilhouetteOrder => None,
        }
    }
}

/// What is known about the frames so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrameStats {
    /// Bytes that the last [`prepare`](crate::Shadows::prepare) uploaded for the frame: records of lights and casters that
    /// changed.
    pub upload_bytes: u64,
    /// Bytes that it uploaded once because meshes or casters came or went: those that came, and blocks of those that went.
    /// Copies on the device are not among them.
    pub set_up_bytes: u64,
    /// Frames whose quads or corners did not fit, as far as their counters have arrived.
    pub overflow_frames: u64,
    /// Times that the library waited for the device: only [`wait_for_counters`](crate::Shadows::wait_for_counters) does.
    pub readback_waits: u64,
    /// Casters whose matrix is singular: they cast nothing.
    pub singular_casters: u32,
    /// Lights whose maps the last frame makes, or makes anew.
    pub lights_redone: u32,
    /// Lights whose maps stand, since neither they nor anything within their reach changed.
    pub lights_kept: u32,
    /// Dispatches that the last [`encode`](crate::Shadows::encode) recorded.
    pub dispatches_recorded: u32,
    /// Draws that it recorded.
    pub draws_recorded: u32,
    /// Counters of the latest frames that have arrived, of all lights together.
    pub counters: Option<Counters>,
}

/// What the frame plan needs to know of a device.
pub fn device_facts(device: &wgpu::Device) -> DeviceFacts {
    let limits = device.limits();
    DeviceFacts {
        float32_blendable: device.features().contains(wgpu::Features::FLOAT32_BLENDABLE),
        float32_filterable: device.features().contains(wgpu::Features::FLOAT32_FILTERABLE),
        max_storage_buffer_binding_size: limits.max_storage_buffer_binding_size,
        max_buffer_size: limits.max_buffer_size,
        max_texture_dimension_2d: limits.max_texture_dimension_2d,
    }
}
