// How far blockers can be, and the penumbra that they make.

// NDC radius of the disk of blockers at the light's near plane that a receiver's view of the light goes through, or
// less where the settings say so.
fn contrejour_search_radius(q: f32) -> f32 {
    let view = contrejour_receiver_view;
    return clamp(view.light_size * (q - contrejour_q_of_depth(view.near_depth)), 0.0, view.search_max_ndc);
}

// NDC radius of the same disk at a blocker's q: half the penumbra's width (Fernando 2005, for a light parallel to the
// image plane; in q the formula is one for spots and directional lights).
fn contrejour_penumbra_radius(q: f32, q_blocker: f32) -> f32 {
    return max(contrejour_receiver_view.light_size * (q - q_blocker), 0.0);
}
