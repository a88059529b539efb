// How a receiver looks into the maps of a view, for the one function of its shader: `contrejour_visibility(position_world,
// normal_world)`, 0 dark to 1 lit, in one of the views' files.
// Joined with one of the visibility files and one of the views' files, with `const CONTREJOUR_GROUP`, the bind group that
// the caller names, and `const CONTREJOUR_VIEWS`, how many views the light has.
// Every name here carries the library's, so that it meets none of the caller's.

@group(CONTREJOUR_GROUP) @binding(0) var<uniform> contrejour_receiver_views: array<ReceiverView, CONTREJOUR_VIEWS>;

// The view that is looked up, and its index: the layer of its maps.
var<private> contrejour_receiver_view: ReceiverView;
var<private> contrejour_layer: u32;

// Where a receiver looks into the maps, and the depth that it compares.
struct ContrejourLookup {
    position_world: vec3f,
    normal_world: vec3f,
    ndc: vec2f,
    // Where the receiver itself is: no bias moves it.
    place_ndc: vec2f,
    clip_w: f32,
    // What the bias left of the receiver's depth.
    depth: f32,
    in_map: bool,
    // The surface's other side faces the light.
    is_averted: bool,
}

// The steepest slope that the slope-scaled bias follows; beyond, a surface is lit too flatly to matter.
const CONTREJOUR_MAX_SLOPE = 64.0;

// Visibility of the light from a point with a unit normal, by one view. Points outside its maps are lit; a side that is
// averted from the light is dark. Without a normal (zero) no side is.
fn contrejour_visibility_in_view(view: u32, position_world: vec3f, normal_world: vec3f) -> f32 {
    contrejour_layer = view;
    contrejour_receiver_view = contrejour_receiver_views[view];
    let lookup = contrejour_lookup(position_world, normal_world);
    if lookup.is_averted {
        return 0.0;
    }
    if !lookup.in_map {
        return 1.0;
    }
    return contrejour_map_visibility(lookup);
}

fn contrejour_lookup(position_world: vec3f, normal_world: vec3f) -> ContrejourLookup {
    // Move along the normal, then take the constant and the slope-scaled bias off the depth.
    let view = contrejour_receiver_view;
    let light = view.light_world;
    let towards_light = normalize(light.xyz - light.w * position_world);
    let facing = dot(normal_world, towards_light);
    let has_normal = any(normal_world != vec3f(0.0));
    let cosine = select(1.0, clamp(abs(facing), 1.0 / CONTREJOUR_MAX_SLOPE, 1.0), has_normal);
    let sine = sqrt(1.0 - cosine * cosine);
    let unbiased = view.light_clip_from_world * vec4f(position_world, 1.0);
    let footprint = view.texel_world * contrejour_depth_scale(max(unbiased.w, view.near_depth));
    let position = position_world + view.bias_normal_texels * footprint * sine * normal_world;
    let clip = view.light_clip_from_world * vec4f(position, 1.0);
    let depth = select(mix(view.near_depth, view.far_depth, clip.z), clip.w, view.perspective == 1u);
    let bias_texels = view.bias_constant_texels + view.bias_slope_texels * sine / cosine;

    let ndc = clip.xy / clip.w;
    let in_map = clip.w > 0.0 && all(abs(ndc) <= vec2f(1.0)) && depth <= view.far_depth;
    let is_averted = facing < 0.0;
    let place_ndc = unbiased.xy / unbiased.w;
    return ContrejourLookup(position, normal_world, ndc, place_ndc, clip.w, depth - footprint * bias_texels, in_map, is_averted);
}

// How lengths on the image plane grow with depth.
fn contrejour_depth_scale(depth: f32) -> f32 {
    return select(1.0, depth, contrejour_receiver_view.perspective == 1u);
}

// Map coordinates, 0 to 1: y points down in a texture.
fn contrejour_uv_of_ndc(ndc: vec2f) -> vec2f {
    return ndc * vec2f(0.5, -0.5) + 0.5;
}

// What is linear on the image plane: -1 / z in a perspective view, z in an orthographic one.
fn contrejour_q_of_depth(depth: f32) -> f32 {
    return select(depth, -1.0 / depth, contrejour_receiver_view.perspective == 1u);
}
