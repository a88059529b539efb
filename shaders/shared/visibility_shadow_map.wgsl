// Visibility by the shadow map alone: hard shadows.

fn contrejour_texel_visibility(texel: vec2i, depth: f32) -> f32 {
    return select(1.0, 0.0, depth > textureLoad(contrejour_shadow_depth, texel, 0).x);
}
