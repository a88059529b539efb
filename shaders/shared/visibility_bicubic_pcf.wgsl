// Visibility by a percentage-closer filter with the uniform cubic B-spline: 16 comparisons, gathered four at a time.
// The rival of Chan & Durand 2003, section 5.

fn contrejour_map_visibility(lookup: ContrejourLookup) -> f32 {
    let size = f32(contrejour_receiver_view.map_size);
    let texel = contrejour_uv_of_ndc(lookup.ndc) * size - 0.5;
    let corner = floor(texel);
    let columns = contrejour_b_spline(fract(texel.x));
    let rows = contrejour_b_spline(fract(texel.y));
    let q = contrejour_q_of_depth(lookup.depth);
    let gradient = contrejour_q_gradient(lookup);
    var sum = 0.0;
    for (var row = 0; row < 2; row++) {
        for (var column = 0; column < 2; column++) {
            // The common corner of four texels, in texels.
            let place = corner + 2.0 * vec2f(f32(column), f32(row));
            let offset_ndc = (place - 0.5 - texel) * vec2f(2.0, -2.0) / size;
            let z = contrejour_clip_z_of_q(q + dot(gradient, offset_ndc));
            let seen = textureGatherCompare(
                contrejour_shadow_map,
                contrejour_shadow_sampler,
                place / size,
                contrejour_layer,
                z,
            );
            // Gathered counter-clockwise from the lower left texel; rows of a texture go down.
            let above = seen.w * columns[2 * column] + seen.z * columns[2 * column + 1];
            let below = seen.x * columns[2 * column] + seen.y * columns[2 * column + 1];
            sum += above * rows[2 * row] + below * rows[2 * row + 1];
        }
    }
    return sum;
}

// Weights of the four nearest texels along one axis; they add up to 1.
fn contrejour_b_spline(share: f32) -> array<f32, 4> {
    let rest = 1.0 - share;
    let first = rest * rest * rest / 6.0;
    let last = share * share * share / 6.0;
    let second = 2.0 / 3.0 - 0.5 * share * share * (2.0 - share);
    return array(first, second, 1.0 - first - second - last, last);
}
