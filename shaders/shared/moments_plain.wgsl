// Plain variance shadow maps. Donnelly & Lauritzen 2006.

fn contrejour_moments_visibility(moments: vec4f, share: f32) -> f32 {
    return contrejour_chebyshev(moments.xy, share, contrejour_receiver_view.min_variance);
}

// Mean depth share of the blockers among the texels: what is left of the mean when as much of it as is lit lies at the
// receiver (Yang et al. 2010, equation 5).
fn contrejour_blocker_share(moments: vec4f, share: f32, lit: f32) -> f32 {
    return (moments.x - lit * share) / (1.0 - lit);
}
