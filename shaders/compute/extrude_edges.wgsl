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
    let image = edge_image(clip_from_object, low, high);
    if !is_in_view(image) {
        return false;
    }

    // Extrude away from the blocker.
    let q = vec2f(image.low.q, image.high.q);
    let blocker_left = silhouette.right == 0u;
    *quad = Quad(
        image.low.ndc,
        image.high.ndc,
        select(counter_clockwise(direction), clockwise(direction), blocker_left),
        vec2f(smoothie_width(q.x), smoothie_width(q.y)),
        q,
        silhouette.caster,
        silhouette.edge_id,
        edge.low_vertex,
        edge.high_vertex,
        select(0u, OWN_END_LOW, image.span.begin == 0.0) | select(0u, OWN_END_HIGH, image.span.end == 1.0),
        select(OUTLINE_BLOCKER_RIGHT, OUTLINE_BLOCKER_LEFT, blocker_left),
    );
    return true;
}
