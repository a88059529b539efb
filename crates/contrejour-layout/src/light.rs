//! What is written when a light moves, and what a view's stages make of it for each caster.

use crate::shared_struct::shared_struct;

shared_struct! {
    /// One light view as one caster sees it.
    CasterLight {
        /// Bits of the light in the caster's object space: x, y, z, w. These values are the input of the exact
        /// facing test.
        light_object: [u32; 4],
        /// Light clip space from the caster's scaled object space.
        light_clip_from_object: [f32; 16],
        /// 1 when the caster's matrix mirrors (its determinant is negative), else 0.
        mirrored: u32,
        /// 1 when the caster casts for this view; 0 leaves it out (its matrix is singular, or the view can't see it).
        casts: u32,
        /// Zero.
        unused_0: u32,
        /// Zero.
        unused_1: u32,
    }
}

impl CasterLight {
    /// False where 32-bit floats can't hold the caster's clip space: then the matrix is zero, and the caster throws no
    /// shadow.
    pub fn has_image(&self) -> bool {
        self.light_clip_from_object != [0.0; 16]
    }
}

shared_struct! {
    /// One light view: what the compute stages and the raster passes of its maps need. A uniform.
    LightView {
        /// 1 for a perspective view (`q = -1 / z`), 0 for an orthographic one (`q = z`).
        perspective: u32,
        /// Texels along a side of the square maps.
        map_size: u32,
        /// Blocks of faces of all casters.
        face_block_count: u32,
        /// Blocks of edges of all casters.
        edge_block_count: u32,
        /// Room in the list of undecided faces; a bundle has as much for each of its seats.
        undecided_capacity: u32,
        /// Room in the list of silhouette edges.
        silhouette_capacity: u32,
        /// Room in the list of quads.
        quad_capacity: u32,
        /// Room in the list of corners.
        corner_capacity: u32,
        /// Nearest depth of the view.
        near_depth: f32,
        /// Farthest depth of the view.
        far_depth: f32,
        /// Clip z is `q * ndc_scale + ndc_offset` after the division by w.
        ndc_scale: f32,
        /// See `ndc_scale`.
        ndc_offset: f32,
        /// The largest `q` that a receiver can have: 0 in a perspective view, `far_depth` in an orthographic one.
        q_max: f32,
        /// Half the side of the image plane at depth 1 where the light is a sphere, 0 where it is a disk: times NDC, the
        /// place from which a sphere is seen at a slant.
        sphere_half_side: f32,
        /// Smoothie width per `q_max - q`: the light's size on the image plane. 0 where the width is given.
        width_per_q_ndc: f32,
        /// Smallest smoothie width, in NDC: one and a half texels, or the width that is given.
        width_min_ndc: f32,
        /// Largest smoothie width, in NDC. As all widths that of a disk; a sphere's are stretched after it.
        width_max_ndc: f32,
        /// Depth by which a smoothie may lie behind its receiver, in texel footprints.
        bias_smoothie_texels: f32,
        /// World size of a texel at depth 1 (perspective) or at any depth (orthographic).
        texel_world: f32,
        /// Depth that 1 stands for in the shadow map and in the smoothie buffer.
        depth_unit: f32,
        /// Exponent of the moments' warp; 0 where depth is not warped.
        warp_exponent: f32,
        /// Casters.
        caster_count: u32,
        /// Bits [`VIEW_CULLS`], [`VIEW_PANCAKES`] and [`VIEW_TESTS`].
        flags: u32,
        /// How far outside the frustum's sides a caster still matters, in NDC: smoothie width and filter texels.
        reach_ndc: f32,
        /// The homogeneous light in the world: x, y, z, w as 64-bit floats, two to a row, each its low word first.
        light_world: [[u32; 4]; 2],
        /// Light clip space from the world, column by column, as 64-bit floats.
        light_clip_from_world: [[u32; 4]; 8],
    }
}

/// Bit of [`LightView::flags`]: casters outside the frustum are left out.
pub const VIEW_CULLS: u32 = 1;

/// Bit of [`LightView::flags`]: casters nearer to the light than the nearest depth cast too. They are drawn at the nearest
/// depth in clip space and keep their own linear depth. Orthographic views alone have it.
pub const VIEW_PANCAKES: u32 = 2;

/// Bit of [`LightView::flags`]: faces and edges are tested for it; else its casters are drawn and no more.
pub const VIEW_TESTS: u32 = 4;

shared_struct! {
    /// What the visibility function needs to look up a receiver in the maps of a light view. A uniform.
    ReceiverView {
        /// Light clip space from world space.
        light_clip_from_world: [f32; 16],
        /// The light in world space: position and 1, or direction towards the light and 0.
        light_world: [f32; 4],
        /// A point's depth in the eye's view is the dot product with the point and 1. Zeros where the light is not
        /// cascaded.
        eye_depth_from_world: [f32; 4],
        /// 1 for a perspective view, 0 for an orthographic one.
        perspective: u32,
        /// Texels along a side of the square maps.
        map_size: u32,
        /// Nearest depth of the view.
        near_depth: f32,
        /// Farthest depth of the view.
        far_depth: f32,
        /// World size of a texel at depth 1 (perspective) or at any depth (orthographic).
        texel_world: f32,
        /// Constant bias, in texel footprints.
        bias_constant_texels: f32,
        /// Slope-scaled bias, in texel footprints per unit of slope.
        bias_slope_texels: f32,
        /// Normal offset, in texel footprints.
        bias_normal_texels: f32,
        /// Depth that 1 stands for in the shadow map and in the smoothie buffer.
        depth_unit: f32,
        /// Clip z is `q * ndc_scale + ndc_offset` after the division by w.
        ndc_scale: f32,
        /// See `ndc_scale`.
        ndc_offset: f32,
        /// Half the light's size on the image plane: NDC per unit of q between blocker and receiver.
        light_size: f32,
        /// Largest radius in which blockers are searched, or largest half width of a penumbra, in NDC.
        search_max_ndc: f32,
        /// Radius of the disk over which moments are averaged, in texels.
        blur_texels: f32,
        /// Visibility up to which light is taken for bleeding, 0 to 1.
        bleed_cut: f32,
        /// Smallest variance of depth, as a share of the view's depth range squared.
        min_variance: f32,
        /// Exponent of the moments' warp; 0 where depth is not warped.
        warp_exponent: f32,
        /// Depth in the eye's view where a cascade begins to fade into the next one; 0 where the light is not cascaded.
        blend_depth: f32,
        /// Depth in the eye's view where a cascade ends; 0 where the light is not cascaded.
        end_depth: f32,
        /// Width of the hardest edge of a silhouette map, in texels.
        edge_texels: f32,
    }
}

shared_struct! {
    /// What the visibility texture needs of the eye's view. A uniform.
    EyeView {
        /// World space from the eye's clip space.
        world_from_eye_clip: [f32; 16],
        /// Depth-buffer value where nothing was drawn: 1, or 0 with reversed z.
        background_depth: f32,
        /// Zero.
        unused_0: u32,
        /// Zero.
        unused_1: u32,
        /// Zero.
        unused_2: u32,
    }
}
