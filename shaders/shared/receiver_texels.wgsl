// Visibility as the weighted mean over the four nearest texels, for techniques that decide texel by texel.

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
    return contrejour_texel_visibility(contrejour_inside(texel), depth);
}
