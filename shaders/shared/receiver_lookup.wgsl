// The one function for a receiver's shader: `contrejour_visibility(position_world, normal_world)`, 0 dark to 1 lit.
// Joined with one of the visibility files and with `const CONTREJOUR_GROUP`, the bind group that the caller names.
// Every name here carries the library's, so that it meets none of the caller's.

@group(CONTREJOUR_GROUP) @binding(0) var<uniform> contrejour_receiver_view: ReceiverView;
@group(CONTREJOUR_GROUP) @binding(1) var contrejour_shadow_depth: texture_2d<f32>;

// Where a receiver looks into the maps, and the depth that it compares.
struct ContrejourLookup {
    ndc: vec2f,
    depth: f32,
    in_map: bool,
    // The surface's other side faces the light.
    is_averted: bool,
}

// The steepest slope that the slope-scaled bias follows; beyond, a surface is lit too flatly to matter.
const CONTREJOUR_MAX_SLOPE = 64.0;

fn contrejour_lookup(position_world: vec3f, normal_world: vec3f) -> ContrejourLookup {
    // Move along the normal, then take the constant and the slope-scaled bias off the depth.
    let light = contrejour_receiver_view.light_world;
    let towards_light = normalize(light.xyz - light.w * position_world);
    let facing = dot(normal_world, towards_light);
    let has_normal = any(normal_world != vec3f(0.0));
    let cosine = select(1.0, clamp(abs(facing), 1.0 / CONTREJOUR_MAX_SLOPE, 1.0), has_normal);
    let sine = sqrt(1.0 - cosine * cosine);
    let unbiased = contrejour_receiver_view.light_clip_from_world * vec4f(position_world, 1.0);
    let footprint = contrejour_receiver_view.texel_world
        * select(1.0, max(unbiased.w, contrejour_receiver_view.near_depth), contrejour_receiver_view.perspective == 1u);
    let offset = contrejour_receiver_view.bias_normal_texels * footprint * sine;
    let clip = contrejour_receiver_view.light_clip_from_world * vec4f(position_world + offset * normal_world, 1.0);
    let depth = select(
        mix(contrejour_receiver_view.near_depth, contrejour_receiver_view.far_depth, clip.z),
        clip.w,
        contrejour_receiver_view.perspective == 1u,
    );
    let bias_texels = contrejour_receiver_view.bias_constant_texels
        + contrejour_receiver_view.bias_slope_texels * sine / cosine;

    let ndc = clip.xy / clip.w;
    let in_map = clip.w > 0.0 && all(abs(ndc) <= vec2f(1.0)) && depth <= contrejour_receiver_view.far_depth;
    return ContrejourLookup(ndc, depth - footprint * bias_texels, in_map, facing < 0.0);
}

// Map coordinates in texels from NDC: y points down in a texture.
fn contrejour_texel_from_ndc(ndc: vec2f) -> vec2f {
    return (ndc * vec2f(0.5, -0.5) + 0.5) * f32(contrejour_receiver_view.map_size);
}

// Visibility of the light from a point with a unit normal: the weighted mean over the four nearest texels. Points
// outside the light's maps are lit; a side that is averted from the light is dark. Without a normal (zero) no side is.
fn contrejour_visibility(position_world: vec3f, normal_world: vec3f) -> f32 {
    let lookup = contrejour_lookup(position_world, normal_world);
    if lookup.is_averted {
        return 0.0;
    }
    if !lookup.in_map {
        return 1.0;
    }
    let texel = contrejour_texel_from_ndc(lookup.ndc) - 0.5;
    let corner = vec2i(floor(texel));
    let weight = fract(texel);
    let low = mix(
        contrejour_clamped_visibility(corner, lookup.depth),
        contrejour_clamped_visibility(corner + vec2i(1, 0), lookup.depth),
        weight.x,
    );
    let high = mix(
        contrejour_clamped_visibility(corner + vec2i(0, 1), lookup.depth),
        contrejour_clamped_visibility(corner + vec2i(1, 1), lookup.depth),
        weight.x,
    );
    return mix(low, high, weight.y);
}

fn contrejour_clamped_visibility(texel: vec2i, depth: f32) -> f32 {
    let last = i32(contrejour_receiver_view.map_size) - 1;
    return contrejour_texel_visibility(clamp(texel, vec2i(0), vec2i(last)), depth);
}
