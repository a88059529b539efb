// The linear depth that a shadow map has at a texel; at the nearest one of its border for those outside.

@group(CONTREJOUR_GROUP) @binding(1) var contrejour_shadow_depth: texture_2d_array<f32>;

fn contrejour_inside(texel: vec2i) -> vec2i {
    return clamp(texel, vec2i(0), vec2i(i32(contrejour_receiver_view.map_size) - 1));
}

fn contrejour_shadow_depth_at(texel: vec2i) -> f32 {
    let inside = contrejour_inside(texel);
    return contrejour_receiver_view.depth_unit * textureLoad(contrejour_shadow_depth, inside, contrejour_layer, 0).x;
}
