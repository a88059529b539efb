// Visibility by shadow map and silhouette map: where a silhouette is near, the signed distance to it says where its shadow
// ends, and how far the depths of the two are apart how softly; elsewhere depths decide.
// Valient & Bujnak 2005, equation 4, its gradient worked out and not looked up. Joined with `const CONTREJOUR_SAMPLES` and
// `const CONTREJOUR_PROFILE_IS_DISK`.

@group(CONTREJOUR_GROUP) @binding(2) var contrejour_silhouette_map: texture_2d_array<f32>;

// Two disks, one after the other, blur as much as one whose radius squared is the sum of theirs: each place sees a share of
// the light's radius, less where there are many, and they are spread over the rest.
const CONTREJOUR_SHARE = 1.0 / sqrt(sqrt(f32(CONTREJOUR_SAMPLES)));
const CONTREJOUR_SPREAD = sqrt(1.0 - CONTREJOUR_SHARE * CONTREJOUR_SHARE);

// Depth is compared this far outside of a silhouette, where the nearest texel shows nothing of its blocker: so many texels,
// and this share of half the penumbra's width, since the nearest edge may lie a little inside of a silhouette that folds.
const CONTREJOUR_OUTSIDE_TEXELS = 1.0;
const CONTREJOUR_OUTSIDE_SHARE = 0.25;

// A blocker's surface is taken to fall back from its silhouette by less than this slope. What is deeper is another one's.
const CONTREJOUR_STEEPEST_BLOCKER = 8.0;

// What a receiver sees through one place of the map.
struct ContrejourGlimpse {
    visibility: f32,
    // Half the penumbra of the silhouettes around it, in NDC of a disk of light; 0 where there are none.
    radius: f32,
}

// One of the four texels around a place.
struct ContrejourSilhouetteTexel {
    is_lit: bool,
    // Whether a silhouette is near that may shadow the receiver.
    is_known: bool,
    signed_distance: f32,
    q: f32,
}

fn contrejour_map_visibility(lookup: ContrejourLookup) -> f32 {
    let gradient = contrejour_q_gradient(lookup);
    let middle = contrejour_glimpse(lookup, gradient, vec2f(0.0), 1.0);
    // An edge as hard as edges get looks alike from all places.
    let hardest = contrejour_receiver_view.edge_texels / f32(contrejour_receiver_view.map_size);
    if CONTREJOUR_SAMPLES == 1u || middle.radius <= hardest {
        return middle.visibility;
    }
    let place = contrejour_leaning(lookup.place_ndc);
    var sum = 0.0;
    for (var sample = 0u; sample < CONTREJOUR_SAMPLES; sample++) {
        let offset = CONTREJOUR_SPREAD * middle.radius * contrejour_disk(sample, CONTREJOUR_SAMPLES, 0.0);
        sum += contrejour_glimpse(lookup, gradient, contrejour_outline_from_disk(place, offset), CONTREJOUR_SHARE).visibility;
    }
    return sum / f32(CONTREJOUR_SAMPLES);
}

// Through a place beside the receiver's own, by a part of the light's radius.
fn contrejour_glimpse(lookup: ContrejourLookup, gradient: vec2f, offset: vec2f, share: f32) -> ContrejourGlimpse {
    // Look at the four texels around it.
    let view = contrejour_receiver_view;
    let size = f32(view.map_size);
    let ndc = lookup.place_ndc + offset;
    let q = contrejour_q_of_depth(lookup.depth) + dot(gradient, offset);
    let place = contrejour_uv_of_ndc(ndc) * size - 0.5;
    let corner = floor(place);
    let weight = place - corner;
    var texels: array<ContrejourSilhouetteTexel, 4>;
    var known = 0.0;
    var known_q = 0.0;
    var farthest = 0.0;
    for (var i = 0u; i < 4u; i++) {
        let cell = vec2f(f32(i & 1u), f32(i >> 1u));
        let to_texel = (cell - weight) * vec2f(2.0, -2.0) / size;
        let texel = contrejour_silhouette_texel(vec2i(corner + cell), q + dot(gradient, to_texel));
        if texel.is_known {
            let near = 1.0 - abs(cell - weight);
            known += near.x * near.y;
            known_q += near.x * near.y * texel.q;
            farthest = max(farthest, abs(texel.signed_distance));
        }
        texels[i] = texel;
    }

    // Where no silhouette is near, its distance is more than that of the others, on the side that depths say.
    var distances: array<f32, 4>;
    for (var i = 0u; i < 4u; i++) {
        let beyond = select(farthest + 1.0, -farthest - 1.0, texels[i].is_lit);
        distances[i] = select(beyond, texels[i].signed_distance, texels[i].is_known);
    }
    let upper = mix(distances[0], distances[1], weight.x);
    let lower = mix(distances[2], distances[3], weight.x);
    let signed_distance = mix(upper, lower, weight.y);
    let slope = vec2f(mix(distances[1] - distances[0], distances[3] - distances[2], weight.y), lower - upper);
    let steepness = length(slope);
    let inward = select(vec2f(0.0), slope / steepness, steepness > 0.0);

    // How wide the penumbra is there.
    var radius = 0.0;
    if known > 0.0 {
        radius = min(contrejour_penumbra_radius(q, known_q / known), view.search_max_ndc);
    }
    let along = dot(contrejour_leaning(ndc), inward * vec2f(1.0, -1.0));
    let half_width = max(share * radius * sqrt(1.0 + along * along) * 0.5 * size, 0.5 * view.edge_texels);
    let past_edge = contrejour_edge_profile(clamp(signed_distance / half_width, -1.0, 1.0));
    if past_edge == 0.0 {
        return ContrejourGlimpse(0.0, radius);
    }

    // What else is in the way is seen outside of the silhouette.
    let nearest = u32(round(weight.x)) + 2u * u32(round(weight.y));
    if texels[nearest].is_lit {
        return ContrejourGlimpse(past_edge, radius);
    }
    let outside_by = CONTREJOUR_OUTSIDE_TEXELS + CONTREJOUR_OUTSIDE_SHARE * half_width;
    let away = -max(signed_distance + outside_by, 0.0) * inward;
    let outside = floor(place + 0.5 + away);
    let to_outside = (outside - place) * vec2f(2.0, -2.0) / size;
    let is_lit = q + dot(gradient, to_outside) <= contrejour_q_of_depth(contrejour_shadow_depth_at(vec2i(outside)));
    return ContrejourGlimpse(select(0.0, past_edge, is_lit), radius);
}

// The part of the light past an edge: 1 at -1, outside, and 0 at 1, on the blocker's side.
fn contrejour_edge_profile(x: f32) -> f32 {
    if CONTREJOUR_PROFILE_IS_DISK {
        // The part of a disk beyond a chord.
        return 0.5 - (x * sqrt(1.0 - x * x) + asin(x)) / 3.1415927;
    }
    return 0.5 - 0.5 * x;
}

fn contrejour_silhouette_texel(texel: vec2i, q: f32) -> ContrejourSilhouetteTexel {
    let nearest = contrejour_shadow_depth_at(texel);
    let is_lit = q <= contrejour_q_of_depth(nearest);
    let kept = textureLoad(contrejour_silhouette_map, contrejour_inside(texel), contrejour_layer, 0).xy;
    let depth = contrejour_receiver_view.depth_unit * kept.x;
    let q_silhouette = contrejour_q_of_depth(depth);
    if q_silhouette >= q {
        return ContrejourSilhouetteTexel(is_lit, false, 0.0, 0.0);
    }
    // On which side a texel's middle lies is what the shadow map is drawn by. The sign that a single edge gives is wrong
    // inside of a silhouette that folds back on itself, as those of smooth meshes do everywhere.
    let distance = abs(kept.y);
    let footprint = contrejour_receiver_view.texel_world * contrejour_depth_scale(depth);
    let deepest = depth + CONTREJOUR_STEEPEST_BLOCKER * footprint * (distance + 1.0);
    let is_behind = !is_lit && nearest <= deepest;
    return ContrejourSilhouetteTexel(is_lit, true, select(-distance, distance, is_behind), q_silhouette);
}
