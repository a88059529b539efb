// A corner of a face as the shadow map sees it, and the depths that are drawn between three of them.

struct ShadowVertex {
    @builtin(position) clip: vec4f,
    // As a share of the farthest: rasterisers extrapolate what they interpolate, which may be too much for a float.
    @location(0) depth_share: f32,
}

struct PancakedTexel {
    // Nobody reads it: the nearest wins by it, in front of the view too.
    @builtin(frag_depth) order: f32,
    @location(0) depth: f32,
}

fn shadow_vertex(light_clip_from_object: mat4x4f, position: vec3f) -> ShadowVertex {
    let clip = light_clip_from_object * vec4f(position, 1.0);
    // All of clip space may be scaled. Rasterisers divide by its w, which is the depth: near the ends of the type they fail.
    let clip_scale = select(1.0, reciprocal_power(view.far_depth), view.perspective == 1u);
    let depth_share = depth_of_clip(clip) / view.far_depth;
    if pancakes() {
        // Fragments write depth: nothing is cut off by it.
        return ShadowVertex(vec4f(clip.xy, 0.5, 1.0), depth_share);
    }
    return ShadowVertex(clip * clip_scale, depth_share);
}

fn shadow_depth(depth_share: f32) -> f32 {
    return in_depth_units(share_in_view(depth_share));
}

// Clip z of a view that casters in front cast into: they are as near as can be. Beyond the farthest depth it is 1, which
// is no nearer than nothing.
fn pancaked_hardware_depth(depth_share: f32) -> f32 {
    return saturate(share_in_view(depth_share) * view.far_depth * view.ndc_scale + view.ndc_offset);
}

fn pancaked_texel(depth_share: f32) -> PancakedTexel {
    let share = share_in_view(depth_share);
    // From 0 to 1 / 2 in front of depth 0, up to 1 behind it; and nothing is drawn from 1 on.
    let order = select(0.5 / (1.0 - share), 0.5 + 0.5 * share, share > 0.0);
    return PancakedTexel(order, in_depth_units(share));
}

// What is drawn lies in the frustum or before it; what is interpolated between corners 2^250 apart may be infinite.
fn share_in_view(depth_share: f32) -> f32 {
    return clamp(depth_share, least_depth() / view.far_depth, 1.0);
}

fn in_depth_units(depth_share: f32) -> f32 {
    return depth_share * (view.far_depth / view.depth_unit);
}
