// Visibility by moments that are blurred as the light's size and the blockers' depth ask: percentage-closer soft shadows
// without samples. Yang, Dong, Feng, Seidel & Kautz 2010, "Variance soft shadow mapping".

// So little shadow in the search area is none, and tells nothing of the blockers' depth.
const CONTREJOUR_LEAST_SHADOW = 1e-3;

fn contrejour_map_visibility(lookup: ContrejourLookup) -> f32 {
    let view = contrejour_receiver_view;
    let share = contrejour_depth_share(lookup.depth);
    let q = contrejour_q_of_depth(lookup.depth);

    // Find how far away the blockers are.
    let area = contrejour_moments_of_outline(lookup.ndc, contrejour_search_radius(q));
    let lit = contrejour_moments_visibility(area, share);
    if lit > 1.0 - CONTREJOUR_LEAST_SHADOW {
        return 1.0;
    }
    let blocker_share = clamp(contrejour_blocker_share(area, share, lit), 0.0, share);
    let blocker_depth = mix(view.near_depth, view.far_depth, blocker_share);

    // Blur as wide as their penumbra.
    let radius = contrejour_penumbra_radius(q, contrejour_q_of_depth(blocker_depth));
    let moments = contrejour_moments_of_outline(lookup.ndc, radius);
    return contrejour_without_bleeding(contrejour_moments_visibility(moments, share));
}

// Moments over what the light looks like, where a disk's radius is given. The ellipse of a sphere spreads as two disks
// do that are half their radius times the place apart from its middle: along every axis, variance is the same.
fn contrejour_moments_of_outline(ndc: vec2f, radius_ndc: f32) -> vec4f {
    let radius_texels = radius_ndc * 0.5 * f32(contrejour_receiver_view.map_size);
    if !CONTREJOUR_LIGHT_IS_SPHERE {
        return contrejour_blurred_moments(ndc, radius_texels);
    }
    let aside = 0.5 * radius_ndc * contrejour_leaning(ndc);
    return 0.5 * (contrejour_blurred_moments(ndc - aside, radius_texels)
        + contrejour_blurred_moments(ndc + aside, radius_texels));
}
