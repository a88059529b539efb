// Moments of depth, looked up blurred. Depth is a share of the view's depth range.

@group(CONTREJOUR_GROUP) @binding(1) var contrejour_moments: texture_2d_array<f32>;
@group(CONTREJOUR_GROUP) @binding(2) var contrejour_moments_sampler: sampler;

// Radius in texels of the disk that spreads as much as level 0 does. A level's texel averages with a variance of
// (4^level - 1) / 4 texels squared (see `blurred_moments`), looking it up between texels adds 4^level / 6; a disk's
// variance along an axis is a quarter of its radius squared.
const CONTREJOUR_LEVEL_RADIUS = 1.29;

fn contrejour_depth_share(depth: f32) -> f32 {
    let view = contrejour_receiver_view;
    return (depth - view.near_depth) / (view.far_depth - view.near_depth);
}

fn contrejour_blurred_moments(ndc: vec2f, radius_texels: f32) -> vec4f {
    let level = log2(max(radius_texels / CONTREJOUR_LEVEL_RADIUS, 1.0));
    let uv = contrejour_uv_of_ndc(ndc);
    return textureSampleLevel(contrejour_moments, contrejour_moments_sampler, uv, contrejour_layer, level);
}

// The largest share of depths with this mean and mean square that can be at or behind a depth (Chebyshev's inequality
// for one side; Donnelly & Lauritzen 2006, equation 5).
fn contrejour_chebyshev(moments: vec2f, depth: f32, min_variance: f32) -> f32 {
    let behind = depth - moments.x;
    if behind > 0.0 {
        let variance = max(moments.y - moments.x * moments.x, min_variance);
        return variance / (variance + behind * behind);
    }
    return 1.0;
}

// Removes the light that bleeds through overlapping shadows (Lauritzen 2007, GPU Gems 3, chapter 8).
fn contrejour_without_bleeding(visibility: f32) -> f32 {
    let cut = contrejour_receiver_view.bleed_cut;
    return saturate((visibility - cut) / (1.0 - cut));
}
