// A light view, and what its stages make of it for each caster. Meanings and units: the structs of the same names in the layout crate.

// Bits of a view's flags.
const VIEW_CULLS = 1u;
const VIEW_PANCAKES = 2u;
const VIEW_TESTS = 4u;

struct CasterLight {
    light_object: vec4u,
    light_clip_from_object: mat4x4f,
    mirrored: u32,
    casts: u32,
    unused_0: u32,
    unused_1: u32,
}

struct LightView {
    perspective: u32,
    map_size: u32,
    face_block_count: u32,
    edge_block_count: u32,
    undecided_capacity: u32,
    silhouette_capacity: u32,
    quad_capacity: u32,
    corner_capacity: u32,
    near_depth: f32,
    far_depth: f32,
    ndc_scale: f32,
    ndc_offset: f32,
    q_max: f32,
    sphere_half_side: f32,
    width_per_q_ndc: f32,
    width_min_ndc: f32,
    width_max_ndc: f32,
    bias_smoothie_texels: f32,
    texel_world: f32,
    depth_unit: f32,
    warp_exponent: f32,
    caster_count: u32,
    flags: u32,
    reach_ndc: f32,
    light_world: array<vec4u, 2>,
    light_clip_from_world: array<vec4u, 8>,
}
