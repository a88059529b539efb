// Exponential warp of depth (Lauritzen & McCool 2008): both grow with depth, the first stresses what is far, the second
// what is near.

// `share` is 0 at the near plane and 1 at the far one.
fn contrejour_warped(share: f32, exponent: f32) -> vec2f {
    let centred = 2.0 * share - 1.0;
    return vec2f(exp(exponent * centred), -exp(-exponent * centred));
}
