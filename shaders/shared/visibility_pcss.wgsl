// Visibility by percentage-closer soft shadows: the mean blocker's q sets the radius of a percentage-closer filter.
// Fernando 2005. Joined with `const CONTREJOUR_BLOCKER_SAMPLES` and `const CONTREJOUR_FILTER_SAMPLES`.

fn contrejour_map_visibility(lookup: ContrejourLookup) -> f32 {
    let q = contrejour_q_of_depth(lookup.depth);
    let gradient = contrejour_q_gradient(lookup);
    let turn = contrejour_turn(lookup.position_world);
    let place = contrejour_leaning(lookup.ndc);

    // Search for blockers.
    let search = contrejour_search_radius(q);
    var blocker_sum = 0.0;
    var blockers = 0.0;
    for (var sample = 0u; sample < CONTREJOUR_BLOCKER_SAMPLES; sample++) {
        let on_disk = search * contrejour_disk(sample, CONTREJOUR_BLOCKER_SAMPLES, turn);
        let offset = contrejour_outline_from_disk(place, on_disk);
        let q_map = contrejour_map_q(lookup.ndc + offset);
        let blocks = select(0.0, 1.0, q_map < q + dot(gradient, offset));
        blocker_sum += blocks * q_map;
        blockers += blocks;
    }
    if blockers == 0.0 {
        return 1.0;
    }

    // Filter as wide as their penumbra.
    let radius = contrejour_penumbra_radius(q, blocker_sum / blockers);
    var sum = 0.0;
    for (var sample = 0u; sample < CONTREJOUR_FILTER_SAMPLES; sample++) {
        let on_disk = radius * contrejour_disk(sample, CONTREJOUR_FILTER_SAMPLES, turn);
        let offset = contrejour_outline_from_disk(place, on_disk);
        sum += contrejour_compared(contrejour_uv_of_ndc(lookup.ndc + offset), q + dot(gradient, offset));
    }
    return sum / f32(CONTREJOUR_FILTER_SAMPLES);
}

fn contrejour_map_q(ndc: vec2f) -> f32 {
    let view = contrejour_receiver_view;
    let texel = vec2i(floor(contrejour_uv_of_ndc(ndc) * f32(view.map_size)));
    let inside = clamp(texel, vec2i(0), vec2i(i32(view.map_size) - 1));
    return (textureLoad(contrejour_shadow_map, inside, contrejour_layer, 0) - view.ndc_offset) / view.ndc_scale;
}

// An angle that looks random from point to point, so that too few samples show as noise and not as bands; a point keeps
// its own while the light moves. Hash: PCG (Jarzynski & Olano 2020).
fn contrejour_turn(position_world: vec3f) -> f32 {
    let bits = bitcast<vec3u>(position_world);
    let hash = contrejour_hash(bits.x ^ contrejour_hash(bits.y ^ contrejour_hash(bits.z)));
    return f32(hash) * (6.2831853 / 4294967296.0);
}

fn contrejour_hash(value: u32) -> u32 {
    let state = value * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}
