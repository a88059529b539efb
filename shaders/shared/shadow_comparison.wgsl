// Hardware comparison of receivers with the shadow map's depth.

@group(CONTREJOUR_GROUP) @binding(1) var contrejour_shadow_map: texture_depth_2d_array;
@group(CONTREJOUR_GROUP) @binding(2) var contrejour_shadow_sampler: sampler_comparison;

// Share of the looked-up texels that a receiver at a map coordinate sees the light past.
fn contrejour_compared(uv: vec2f, q: f32) -> f32 {
    let z = contrejour_clip_z_of_q(q);
    return textureSampleCompareLevel(contrejour_shadow_map, contrejour_shadow_sampler, uv, contrejour_layer, z);
}

// Receivers in front of the near plane are as near as any blocker can be.
fn contrejour_clip_z_of_q(q: f32) -> f32 {
    return saturate(q * contrejour_receiver_view.ndc_scale + contrejour_receiver_view.ndc_offset);
}
