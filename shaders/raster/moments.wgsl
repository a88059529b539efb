// Fills the first level of the moments: mean and mean square of depth, or of both its warps.
// One fragment invocation = one texel; one triangle covers all.
// Reads the linear depth of the shadow map. Depth is a share of the view's depth range.
// Donnelly & Lauritzen 2006; Lauritzen & McCool 2008.

@group(0) @binding(0) var<uniform> view: LightView;
@group(1) @binding(0) var shadow_depth: texture_2d<f32>;

@vertex
fn vertex_full_screen(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return full_screen_clip(index);
}

@fragment
fn fragment_moments(@builtin(position) texel: vec4f) -> @location(0) vec2f {
    let share = depth_share(texel.xy);
    return vec2f(share, share * share);
}

@fragment
fn fragment_warped_moments(@builtin(position) texel: vec4f) -> @location(0) vec4f {
    let warped = contrejour_warped(depth_share(texel.xy), view.warp_exponent);
    return vec4f(warped.x, warped.x * warped.x, warped.y, warped.y * warped.y);
}

fn depth_share(texel: vec2f) -> f32 {
    let depth = view.depth_unit * textureLoad(shadow_depth, vec2u(texel), 0).x;
    // Casters in front of a cascade are at its nearest depth: moments of what is far away have no digits left.
    return max((depth - view.near_depth) / (view.far_depth - view.near_depth), 0.0);
}
