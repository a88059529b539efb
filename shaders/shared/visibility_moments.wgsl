// Visibility by moments that are blurred everywhere alike.

fn contrejour_map_visibility(lookup: ContrejourLookup) -> f32 {
    let moments = contrejour_blurred_moments(lookup.ndc, contrejour_receiver_view.blur_texels);
    return contrejour_without_bleeding(contrejour_moments_visibility(moments, contrejour_depth_share(lookup.depth)));
}
