// Visibility by one look-up: hard shadows, with steps or with smooth edges as the sampler compares one texel or four.
// Williams 1978; Reeves, Salesin & Cook 1987.

fn contrejour_map_visibility(lookup: ContrejourLookup) -> f32 {
    return contrejour_compared(contrejour_uv_of_ndc(lookup.ndc), contrejour_q_of_depth(lookup.depth));
}
