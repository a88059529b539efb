// Visibility as the weighted mean over the four nearest texels, for techniques that decide texel by texel.

@group(CONTREJOUR_GROUP) @binding(1) var contrejour_shadow_depth: texture_2d_array<f32>;

fn contrejour_map_visibility(lookup: ContrejourLookup) -> f32 {
    let texel = contrejour_uv_of_ndc(lookup.ndc) * f32(contrejour_receiver_view.map_size) - 0.5;
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

fn contrejour_shadow_depth_at(texel: vec2i) -> f32 {
    return contrejour_receiver_view.depth_unit * textureLoad(contrejour_shadow_depth, texel, contrejour_layer, 0).x;
}
