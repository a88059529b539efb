// What the visibility function needs of a light view. Meanings and units: the structs of the same names in the layout crate.

struct ReceiverView {
    light_clip_from_world: mat4x4f,
    light_world: vec4f,
    axis_world: vec4f,
    perspective: u32,
    map_size: u32,
    near_depth: f32,
    far_depth: f32,
    texel_world: f32,
    bias_constant_texels: f32,
    bias_slope_texels: f32,
    bias_normal_texels: f32,
}
