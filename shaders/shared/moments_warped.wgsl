// Exponential variance shadow maps. Lauritzen & McCool 2008.

fn contrejour_moments_visibility(moments: vec4f, share: f32) -> f32 {
    let view = contrejour_receiver_view;
    let warped = contrejour_warped(share, view.warp_exponent);
    // The smallest variance of depth, warped: the warp's slope is its value times the exponent, over a range of 2.
    let slope = 2.0 * view.warp_exponent * warped;
    let least = view.min_variance * slope * slope;
    return min(
        contrejour_chebyshev(moments.xy, warped.x, least.x),
        contrejour_chebyshev(moments.zw, warped.y, least.y),
    );
}

// As for plain moments, on the warp that stresses what is near, where blockers are.
fn contrejour_blocker_share(moments: vec4f, share: f32, lit: f32) -> f32 {
    let exponent = contrejour_receiver_view.warp_exponent;
    let blocker = (moments.z - lit * contrejour_warped(share, exponent).y) / (1.0 - lit);
    return select(share, 0.5 - 0.5 * log(-blocker) / exponent, blocker < 0.0);
}
