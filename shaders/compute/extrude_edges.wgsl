// Turns each outline edge into a quad on the light's image plane, clipped to the frustum widened by the quad's width.
// One invocation = one silhouette edge.
// Reads silhouettes, casters, caster_lights, edges, positions; writes quads, counters.quads, counters.point_edges.
// Chan & Durand 2003, section 4.2, with the outward side taken from the faces instead of averaged normals.

@group(0) @binding(0) var<uniform> view: LightView;
@group(0) @binding(1) var<storage, read> silhouettes: array<SilhouetteEdge>;
@group(0) @binding(2) var<storage, read> casters: array<Caster>;
@group(0) @binding(3) var<storage, read> caster_lights: array<CasterLight>;
@group(0) @binding(4) var<storage, read> edges: array<Edge>;
@group(0) @binding(5) var<storage, read> positions: array<u32>;
@group(0) @binding(6) var<storage, read_write> quads: array<Quad>;
@group(0) @binding(7) var<storage, read_write> counters: AtomicCounters;

// The part of an edge that is inside: from `begin` to `end` of its parameter 0..1. Empty where begin >= end.
struct Span {
    begin: f32,
    end: f32,
}

struct ImagePoint {
    ndc: vec2f,
    q: f32,
}

@compute @workgroup_size(64)
fn extrude_edges(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let id = folded_invocation(group, groups, lane);
    var quad: Quad;
    var has_quad = false;
    if id < min(atomicLoad(&counters.silhouette_edges), view.silhouette_capacity) {
        let silhouette = silhouettes[id];
        if silhouette.left == 0u || silhouette.right == 0u {
            has_quad = extrude(silhouette, &quad);
        }
    }

    let rank = rank_in_group(has_quad);
    if lane == 0u {
        append_base = atomicAdd(&counters.quads, atomicLoad(&append_count));
    }
    workgroupBarrier();
    let slot = append_base + rank;
    if has_quad && slot < view.quad_capacity {
        quads[slot] = quad;
    }
}

// Writes the quad of an outline edge; false where none of it is in view.
fn extrude(silhouette: SilhouetteEdge, quad: ptr<function, Quad>) -> bool {
    // Project.
    let caster = casters[silhouette.caster];
    let clip_from_object = caster_lights[silhouette.caster].light_clip_from_object;
    let edge = edges[caster.first_edge + silhouette.edge_id];
    let low = scaled_position(caster, edge.low_vertex);
    let high = scaled_position(caster, edge.high_vertex);
    let direction = image_direction(clip_from_object, low, high);
    if all(direction == vec2f(0.0)) {
        atomicAdd(&counters.point_edges, 1u);
        return false;
    }
    let low_clip = clip_from_object * vec4f(low, 1.0);
    let high_clip = clip_from_object * vec4f(high, 1.0);
    let delta_clip = clip_from_object * vec4f(high - low, 0.0);

    // Clip by depth first, since the width that widens the frustum depends on it.
    let depth_span = clip_by_depth(Span(0.0, 1.0), low_clip, high_clip);
    if !(depth_span.begin < depth_span.end) {
        return false;
    }
    let width = max(
        smoothie_width(image_of(point_at(depth_span.begin, low_clip, high_clip, delta_clip)).q),
        smoothie_width(image_of(point_at(depth_span.end, low_clip, high_clip, delta_clip)).q),
    );
    let span = clip_by_sides(depth_span, low_clip, high_clip, 1.0 + widest_ndc(width));
    if !(span.begin < span.end) {
        return false;
    }

    // Extrude away from the blocker.
    let low_end = image_of(point_at(span.begin, low_clip, high_clip, delta_clip));
    let high_end = image_of(point_at(span.end, low_clip, high_clip, delta_clip));
    let q = vec2f(low_end.q, high_end.q);
    let blocker_left = silhouette.right == 0u;
    *quad = Quad(
        low_end.ndc,
        high_end.ndc,
        select(counter_clockwise(direction), clockwise(direction), blocker_left),
        vec2f(smoothie_width(q.x), smoothie_width(q.y)),
        q,
        silhouette.caster,
        silhouette.edge_id,
        edge.low_vertex,
        edge.high_vertex,
        select(0u, OWN_END_LOW, span.begin == 0.0) | select(0u, OWN_END_HIGH, span.end == 1.0),
        select(OUTLINE_BLOCKER_RIGHT, OUTLINE_BLOCKER_LEFT, blocker_left),
    );
    return true;
}

// The ends themselves where nothing was cut off, so that neighbours share them to the bit.
fn point_at(t: f32, low: vec4f, high: vec4f, delta: vec4f) -> vec4f {
    return select(select(low + t * delta, high, t == 1.0), low, t == 0.0);
}

// A point in view but for rounding: the cut end of an edge that is far larger than the view can be anywhere, even in the
// plane of the light.
fn image_of(clip: vec4f) -> ImagePoint {
    let depth = clamp(depth_of_clip(clip), least_depth(), view.far_depth);
    let w = select(clip.w, depth, view.perspective == 1u);
    let most = 1.0 + widest_ndc(view.width_max_ndc);
    return ImagePoint(clamp(clip.xy / w, vec2f(-most), vec2f(most)), q_of_depth(depth));
}

fn clip_by_depth(span: Span, low: vec4f, high: vec4f) -> Span {
    let far = clip_by_plane(span, low.w - low.z, high.w - high.z);
    if pancakes() {
        return far;
    }
    return clip_by_plane(far, low.z, high.z);
}

fn clip_by_sides(span: Span, low: vec4f, high: vec4f, half_side: f32) -> Span {
    let left = clip_by_plane(span, half_side * low.w + low.x, half_side * high.w + high.x);
    let right = clip_by_plane(left, half_side * low.w - low.x, half_side * high.w - high.x);
    let bottom = clip_by_plane(right, half_side * low.w + low.y, half_side * high.w + high.y);
    return clip_by_plane(bottom, half_side * low.w - low.y, half_side * high.w - high.y);
}

// Keeps the part where the distance to a plane, linear from one end to the other, is not negative.
// Liang & Barsky 1984.
fn clip_by_plane(span: Span, low_distance: f32, high_distance: f32) -> Span {
    if low_distance >= 0.0 && high_distance >= 0.0 {
        return span;
    }
    if low_distance < 0.0 && high_distance < 0.0 {
        return Span(1.0, 0.0);
    }
    let crossing = low_distance / (low_distance - high_distance);
    if low_distance < 0.0 {
        return Span(max(span.begin, crossing), span.end);
    }
    return Span(span.begin, min(span.end, crossing));
}
