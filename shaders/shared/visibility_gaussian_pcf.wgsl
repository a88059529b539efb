// Visibility by a bell-shaped percentage-closer filter whose look-ups weigh two by two texels each.
// Castano 2013, "Shadow Mapping Summary - Part 1". Joined with `const CONTREJOUR_KERNEL` and its texels along a side.

// Weights of a kernel's texels along one axis, when its middle lies a share of a texel further.
struct ContrejourWeights {
    // Of two texels each, and where between the two the look-up goes, in texels from the first texel of all.
    weight: array<f32, CONTREJOUR_LOOKUPS>,
    place: array<f32, CONTREJOUR_LOOKUPS>,
}

fn contrejour_map_visibility(lookup: ContrejourLookup) -> f32 {
    let size = f32(contrejour_receiver_view.map_size);
    let texel = contrejour_uv_of_ndc(lookup.ndc) * size - 0.5;
    let corner = floor(texel) - f32(CONTREJOUR_LOOKUPS - 1);
    let columns = contrejour_weights(fract(texel.x));
    let rows = contrejour_weights(fract(texel.y));
    let q = contrejour_q_of_depth(lookup.depth);
    let gradient = contrejour_q_gradient(lookup);
    var sum = 0.0;
    var weight_sum = 0.0;
    for (var row = 0; row < CONTREJOUR_LOOKUPS; row++) {
        for (var column = 0; column < CONTREJOUR_LOOKUPS; column++) {
            let place = corner + vec2f(columns.place[column], rows.place[row]);
            let offset_ndc = (place - texel) * vec2f(2.0, -2.0) / size;
            let weight = columns.weight[column] * rows.weight[row];
            sum += weight * contrejour_compared((place + 0.5) / size, q + dot(gradient, offset_ndc));
            weight_sum += weight;
        }
    }
    return sum / weight_sum;
}

// The kernel and the kernel a texel further, mixed: as many weights as texels and one more, taken two by two.
fn contrejour_weights(share: f32) -> ContrejourWeights {
    var weights: ContrejourWeights;
    for (var lookup = 0; lookup < CONTREJOUR_LOOKUPS; lookup++) {
        let first = contrejour_weight(2 * lookup, share);
        let second = contrejour_weight(2 * lookup + 1, share);
        weights.weight[lookup] = first + second;
        weights.place[lookup] = f32(2 * lookup) + second / (first + second);
    }
    return weights;
}

fn contrejour_weight(texel: i32, share: f32) -> f32 {
    return (1.0 - share) * contrejour_kernel(texel) + share * contrejour_kernel(texel - 1);
}

fn contrejour_kernel(texel: i32) -> f32 {
    var kernel = CONTREJOUR_KERNEL;
    let last = 2 * CONTREJOUR_LOOKUPS - 2;
    return select(0.0, kernel[clamp(texel, 0, last)], texel >= 0 && texel <= last);
}
