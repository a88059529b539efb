// Finds the edges whose signed multiplicity is not zero and the side on which their faces lie.
// One invocation = one edge; one workgroup = one work item.
// Reads edge_items, casters, edges, incidences, lit; writes silhouettes, outline_sides, counters.silhouette_edges.

@group(0) @binding(0) var<uniform> view: LightView;
@group(0) @binding(1) var<storage, read> edge_items: array<WorkItem>;
@group(0) @binding(2) var<storage, read> casters: array<Caster>;
@group(0) @binding(3) var<storage, read> edges: array<Edge>;
@group(0) @binding(4) var<storage, read> incidences: array<u32>;
@group(0) @binding(5) var<storage, read> lit: array<u32>;
@group(0) @binding(6) var<storage, read_write> silhouettes: array<SilhouetteEdge>;
@group(0) @binding(7) var<storage, read_write> outline_sides: array<u32>;
@group(0) @binding(8) var<storage, read_write> counters: AtomicCounters;

var<workgroup> group_sides: array<atomic<u32>, OUTLINE_WORDS_PER_BLOCK>;

// Faces on the left and on the right of an edge as seen from the light.
alias Sides = vec2u;

@compute @workgroup_size(64)
fn detect_silhouette(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    // Count the faces on both sides.
    let item_id = folded_group(group, groups);
    let in_range = item_id < atomicLoad(&counters.edge_items);
    let item = edge_items[select(0u, item_id, in_range)];
    let caster = casters[item.caster];
    let edge_id = item.block * BLOCK_SIZE + lane;
    var sides = Sides(0u);
    if in_range && edge_id < caster.edge_count {
        sides = count_sides(caster, edges[caster.first_edge + edge_id]);
    }

    // Append the silhouette.
    let is_silhouette = sides.x != sides.y;
    let rank = rank_in_group(is_silhouette);
    if lane == 0u {
        append_base = atomicAdd(&counters.silhouette_edges, atomicLoad(&append_count));
    }
    atomicOr(&group_sides[lane / 16u], outline_side(sides) << (lane % 16u * 2u));
    workgroupBarrier();
    let slot = append_base + rank;
    if is_silhouette && slot < view.silhouette_capacity {
        silhouettes[slot] = SilhouetteEdge(item.caster, edge_id, sides.x, sides.y);
    }

    // Keep the outline sides for whoever asks about a neighbour.
    if in_range && lane < OUTLINE_WORDS_PER_BLOCK {
        outline_sides[caster.first_outline_word + item.block * OUTLINE_WORDS_PER_BLOCK + lane] =
            atomicLoad(&group_sides[lane]);
    }
}

fn count_sides(caster: Caster, edge: Edge) -> Sides {
    if edge.first != INCIDENCE_LIST {
        return side_of(caster, edge.first) + side_of(caster, edge.second);
    }
    let list = caster.first_incidence + edge.second;
    let count = incidences[list];
    var sides = Sides(0u);
    for (var i = 1u; i <= count; i++) {
        sides += side_of(caster, incidences[list + i]);
    }
    return sides;
}

// A face is on the left when its sign and its orientation along the edge agree.
fn side_of(caster: Caster, incidence: u32) -> Sides {
    if incidence == INCIDENCE_NONE {
        return Sides(0u);
    }
    let along = (incidence & 1u) == 1u;
    return select(Sides(0u, 1u), Sides(1u, 0u), is_lit(caster, incidence >> 1u) == along);
}

fn is_lit(caster: Caster, face: u32) -> bool {
    if face == UNLIT_FACE {
        return false;
    }
    return (lit[caster.first_lit_word + face / 32u] >> (face % 32u) & 1u) == 1u;
}

fn outline_side(sides: Sides) -> u32 {
    if sides.x > 0u && sides.y == 0u {
        return OUTLINE_BLOCKER_LEFT;
    }
    if sides.y > 0u && sides.x == 0u {
        return OUTLINE_BLOCKER_RIGHT;
    }
    return OUTLINE_NONE;
}
