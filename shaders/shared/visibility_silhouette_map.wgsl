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

// The edge of a shadow around a place.
struct ContrejourEdge {
    // In texels, positive on the blocker's side.
    signed_distance: f32,
    // Unit direction in which it grows, on the texture; zero where it doesn't.
    inward: vec2f,
    // Whether a silhouette is near that may shadow the receiver, and its q.
    is_known: bool,
    q: f32,
    // Whether the texel that the place is in is lit.
    is_lit: bool,
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
    let view = contrejour_receiver_view;
    let size = f32(view.map_size);
    let ndc = lookup.place_ndc + offset;
    let q = contrejour_q_of_depth(lookup.depth) + dot(gradient, offset);
    // In texels, and how much q changes from one to the next.
    let place = contrejour_uv_of_ndc(ndc) * size - 0.5;
    let q_step = gradient * vec2f(2.0, -2.0) / size;
    let edge = contrejour_edge_around(place, q, q_step);

    // How wide the penumbra is there.
    var radius = 0.0;
    if edge.is_known {
        radius = min(contrejour_penumbra_radius(q, edge.q), view.search_max_ndc);
    }
    let along = dot(contrejour_leaning(ndc), edge.inward * vec2f(1.0, -1.0));
    let half_width = max(share * radius * sqrt(1.0 + along * along) * 0.5 * size, 0.5 * view.edge_texels);
    let past_edge = contrejour_edge_profile(clamp(edge.signed_distance / half_width, -1.0, 1.0));
    if edge.is_lit || past_edge == 0.0 {
        return ContrejourGlimpse(past_edge, radius);
    }

    // What else is in the way is seen outside of the silhouette.
    let outside_by = CONTREJOUR_OUTSIDE_TEXELS + CONTREJOUR_OUTSIDE_SHARE * half_width;
    let outside = floor(place + 0.5 - max(edge.signed_distance + outside_by, 0.0) * edge.inward);
    let q_outside = q + dot(q_step, outside - place);
    let is_lit = q_outside <= contrejour_q_of_depth(contrejour_shadow_depth_at(vec2i(outside)));
    return ContrejourGlimpse(select(0.0, past_edge, is_lit), radius);
}

// What the four texels around a place say of a receiver there.
fn contrejour_edge_around(place: vec2f, q: f32, q_step: vec2f) -> ContrejourEdge {
    // Row by row.
    let corner = floor(place);
    let weight = place - corner;
    let right = vec4f(0.0, 1.0, 0.0, 1.0) - weight.x;
    let down = vec4f(0.0, 0.0, 1.0, 1.0) - weight.y;
    let a = vec2i(corner);
    let b = a + vec2i(1, 0);
    let c = a + vec2i(0, 1);
    let d = a + vec2i(1, 1);
    let nearest = vec4f(
        contrejour_shadow_depth_at(a),
        contrejour_shadow_depth_at(b),
        contrejour_shadow_depth_at(c),
        contrejour_shadow_depth_at(d),
    );
    let kept = mat4x2f(
        contrejour_silhouette_at(a),
        contrejour_silhouette_at(b),
        contrejour_silhouette_at(c),
        contrejour_silhouette_at(d),
    );
    let depth = contrejour_receiver_view.depth_unit * vec4f(kept[0].x, kept[1].x, kept[2].x, kept[3].x);
    let distance = abs(vec4f(kept[0].y, kept[1].y, kept[2].y, kept[3].y));

    // On which side a texel's middle lies is what the shadow map is drawn by. The sign that a single edge gives is wrong
    // inside of a silhouette that folds back on itself, as those of smooth meshes do everywhere.
    let q_there = q + q_step.x * right + q_step.y * down;
    let q_silhouette = contrejour_qs_of_depths(depth);
    let is_lit = q_there <= contrejour_qs_of_depths(nearest);
    let is_known = q_silhouette < q_there;
    let footprint = contrejour_receiver_view.texel_world * contrejour_depth_scales(depth);
    let deepest = depth + CONTREJOUR_STEEPEST_BLOCKER * footprint * (distance + 1.0);
    let is_behind = !is_lit & (nearest <= deepest);

    // Where no silhouette is near, its distance is more than that of the others, on the side that depths say.
    let known_distance = select(vec4f(0.0), distance, is_known);
    let beyond = max(max(known_distance.x, known_distance.y), max(known_distance.z, known_distance.w)) + 1.0;
    let on_known_side = select(-distance, distance, is_behind);
    let signed = select(select(vec4f(beyond), vec4f(-beyond), is_lit), on_known_side, is_known);
    let upper = mix(signed.x, signed.y, weight.x);
    let lower = mix(signed.z, signed.w, weight.x);
    let slope = vec2f(mix(signed.y - signed.x, signed.w - signed.z, weight.y), lower - upper);
    let steepness = length(slope);

    let share_known = select(vec4f(0.0), (1.0 - abs(right)) * (1.0 - abs(down)), is_known);
    let known = dot(share_known, vec4f(1.0));
    let is_here = max(abs(right), abs(down)) <= vec4f(0.5);
    return ContrejourEdge(
        mix(upper, lower, weight.y),
        select(vec2f(0.0), slope / steepness, steepness > 0.0),
        known > 0.0,
        dot(share_known, q_silhouette) / known,
        any(is_here & is_lit),
    );
}

// The part of the light past an edge: 1 at -1, outside, and 0 at 1, on the blocker's side.
fn contrejour_edge_profile(x: f32) -> f32 {
    if CONTREJOUR_PROFILE_IS_DISK {
        // The part of a disk beyond a chord.
        return 0.5 - (x * sqrt(1.0 - x * x) + asin(x)) / 3.1415927;
    }
    return 0.5 - 0.5 * x;
}

// Depth of the silhouette that is nearest to a texel, and signed distance to it.
fn contrejour_silhouette_at(texel: vec2i) -> vec2f {
    return textureLoad(contrejour_silhouette_map, contrejour_inside(texel), contrejour_layer, 0).xy;
}

fn contrejour_qs_of_depths(depths: vec4f) -> vec4f {
    return select(depths, -1.0 / depths, contrejour_receiver_view.perspective == 1u);
}

fn contrejour_depth_scales(depths: vec4f) -> vec4f {
    return select(vec4f(1.0), depths, contrejour_receiver_view.perspective == 1u);
}
