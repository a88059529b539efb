// The smoothie buffer in one texture: linear depth and alpha.

@group(CONTREJOUR_GROUP) @binding(2) var contrejour_smoothie_buffer: texture_2d_array<f32>;

fn contrejour_smoothie_at(texel: vec2i) -> ContrejourSmoothie {
    let smoothie = textureLoad(contrejour_smoothie_buffer, texel, contrejour_layer, 0).xy;
    return ContrejourSmoothie(contrejour_receiver_view.depth_unit * smoothie.x, smoothie.y);
}
