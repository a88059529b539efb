// How far blockers can be, and the penumbra that they make. Joined with `const CONTREJOUR_LIGHT_IS_SPHERE`.

// NDC radius of the disk of blockers at the light's near plane that a receiver's view of the light goes through, or
// less where the settings say so.
fn contrejour_search_radius(q: f32) -> f32 {
    let view = contrejour_receiver_view;
    return clamp(view.light_size * (q - contrejour_q_of_depth(view.near_depth)), 0.0, view.search_max_ndc);
}

// NDC radius of the same disk at a blocker's q: half the penumbra's width (Fernando 2005, for a light parallel to the
// image plane; in q the formula is one for all kinds of lights).
fn contrejour_penumbra_radius(q: f32, q_blocker: f32) -> f32 {
    return max(contrejour_receiver_view.light_size * (q - q_blocker), 0.0);
}

// From which place at depth 1 a point of the image sees the light: the middle where that is a disk, which looks alike
// from everywhere.
fn contrejour_leaning(ndc: vec2f) -> vec2f {
    let half_side = 0.5 * contrejour_receiver_view.texel_world * f32(contrejour_receiver_view.map_size);
    return select(vec2f(0.0), half_side * ndc, CONTREJOUR_LIGHT_IS_SPHERE);
}

// From a disk to what the light looks like: of a sphere, the ellipse with the matrix I + p p^T, whose square root this is
// (`LightOutline` of the plan crate).
fn contrejour_outline_from_disk(place: vec2f, offset: vec2f) -> vec2f {
    return offset + dot(place, offset) / (1.0 + sqrt(1.0 + dot(place, place))) * place;
}
