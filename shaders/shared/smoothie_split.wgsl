// The smoothie buffer in two textures: a hardware depth buffer, and alpha in 16-bit float.

@group(CONTREJOUR_GROUP) @binding(2) var contrejour_smoothie_depth: texture_depth_2d_array;
@group(CONTREJOUR_GROUP) @binding(3) var contrejour_smoothie_alpha: texture_2d_array<f32>;

fn contrejour_smoothie_at(texel: vec2i) -> ContrejourSmoothie {
    return ContrejourSmoothie(
        contrejour_linear_depth(textureLoad(contrejour_smoothie_depth, texel, contrejour_layer, 0)),
        textureLoad(contrejour_smoothie_alpha, texel, contrejour_layer, 0).x,
    );
}

fn contrejour_linear_depth(ndc_z: f32) -> f32 {
    let near = contrejour_receiver_view.near_depth;
    let far = contrejour_receiver_view.far_depth;
    return select(mix(near, far, ndc_z), near * far / mix(far, near, ndc_z), contrejour_receiver_view.perspective == 1u);
}
