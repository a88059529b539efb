// Visibility by shadow map and smoothie buffer. Chan & Durand 2003, section 4.4.

// The smoothie nearest to the light on a texel.
struct ContrejourSmoothie {
    depth: f32,
    alpha: f32,
}

fn contrejour_texel_visibility(texel: vec2i, depth: f32) -> f32 {
    if depth > contrejour_shadow_depth_at(texel) {
        return 0.0;
    }
    let smoothie = contrejour_smoothie_at(texel);
    return select(1.0, smoothie.alpha, depth > smoothie.depth);
}
