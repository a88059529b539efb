// Closes the gap between an outline edge's quad and its neighbour's with a wedge around their common vertex.
// One invocation = one end of a quad.
// Reads quads, casters, caster_lights, positions, outline_sides, vertex_edges; writes corners, counters.corners.
//
// Each outside sector around a vertex lies between two ends; the one that has it on its counter-clockwise side makes
// the wedge. An end whose neighbour can't be told apart closes its own side with a quarter disk: never a gap, and what
// overlaps is settled by minimum blending.

@group(0) @binding(0) var<uniform> view: LightView;
@group(0) @binding(1) var<storage, read> quads: array<Quad>;
@group(0) @binding(2) var<storage, read> casters: array<Caster>;
@group(0) @binding(3) var<storage, read> caster_lights: array<CasterLight>;
@group(0) @binding(4) var<storage, read> positions: array<u32>;
@group(0) @binding(5) var<storage, read> outline_sides: array<u32>;
@group(0) @binding(6) var<storage, read> vertex_edges: array<u32>;
@group(0) @binding(7) var<storage, read_write> corners: array<Corner>;
@group(0) @binding(8) var<storage, read_write> counters: AtomicCounters;

// Two directions whose cosine is nearer to 1 than this can't be told apart.
const COINCIDENT = 1e-4;
const HALF_TURN = 2.0;
const MORE_THAN_A_TURN = 5.0;

// One end of an outline edge, on the image plane.
struct EdgeEnd {
    vertex: u32,
    // Unit direction from the vertex along the edge.
    direction: vec2f,
    // +1 where the outside lies counter-clockwise of the direction, -1 where clockwise.
    turn: f32,
}

// An outline edge that one meets when turning through the outside.
struct Neighbour {
    direction: vec2f,
    // 0 where there is none.
    turn: f32,
    // Monotone in the angle: 0 at none, 2 at a half turn, 4 at a full one.
    pseudo_angle: f32,
}

const NO_NEIGHBOUR = Neighbour(vec2f(0.0), 0.0, MORE_THAN_A_TURN);

// Directions where a wedge begins and ends, counter-clockwise. Nothing to draw where kind is NOTHING.
struct Wedge {
    begin: vec2f,
    end: vec2f,
    kind: u32,
}

const NOTHING = 2u;

@compute @workgroup_size(64)
fn build_corners(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let id = folded_invocation(group, groups, lane);
    let is_high = (id & 1u) == 1u;
    var wedge = Wedge(vec2f(0.0), vec2f(0.0), NOTHING);
    var edge_end: EdgeEnd;
    var quad: Quad;
    if id / 2u < min(atomicLoad(&counters.quads), view.quad_capacity) {
        quad = quads[id / 2u];
        if (quad.own_ends & select(OWN_END_LOW, OWN_END_HIGH, is_high)) != 0u {
            edge_end = end_of_quad(quad, is_high);
            wedge = wedge_at(edge_end, quad);
        }
    }

    let has_corner = wedge.kind != NOTHING;
    let rank = rank_in_group(has_corner);
    if lane == 0u {
        append_base = atomicAdd(&counters.corners, atomicLoad(&append_count));
    }
    workgroupBarrier();
    let slot = append_base + rank;
    if has_corner && slot < view.corner_capacity {
        corners[slot] = Corner(
            select(quad.low_ndc, quad.high_ndc, is_high),
            wedge.begin,
            halfway(wedge.begin, wedge.end),
            wedge.end,
            select(quad.width_ndc.x, quad.width_ndc.y, is_high),
            select(quad.q.x, quad.q.y, is_high),
            quad.caster,
            edge_end.vertex,
            quad.edge_id,
            wedge.kind,
        );
    }
}

fn end_of_quad(quad: Quad, is_high: bool) -> EdgeEnd {
    let vertex = select(quad.low_vertex, quad.high_vertex, is_high);
    let turn = outside_turn(quad.side, !is_high);
    return EdgeEnd(vertex, turn * clockwise(quad.outward), turn);
}

// The outside lies on the right of an edge whose blocker is on its left. Seen from its high end it runs the other way.
fn outside_turn(side: u32, from_low: bool) -> f32 {
    return select(-1.0, 1.0, (side == OUTLINE_BLOCKER_RIGHT) == from_low);
}

fn wedge_at(edge_end: EdgeEnd, quad: Quad) -> Wedge {
    let neighbour = find_neighbour(edge_end, quad);
    if neighbour.turn == 0.0 {
        return cap(edge_end);
    }
    if edge_end.turn < 0.0 || neighbour.pseudo_angle <= HALF_TURN {
        return Wedge(vec2f(0.0), vec2f(0.0), NOTHING);
    }
    return Wedge(counter_clockwise(edge_end.direction), clockwise(neighbour.direction), CORNER_WEDGE);
}

// A quarter disk from the quad's outward direction to beyond the edge's end.
fn cap(edge_end: EdgeEnd) -> Wedge {
    let outward = edge_end.turn * counter_clockwise(edge_end.direction);
    if edge_end.turn > 0.0 {
        return Wedge(outward, -edge_end.direction, CORNER_CAP);
    }
    return Wedge(-edge_end.direction, outward, CORNER_CAP);
}

// The outline edge that one meets first; none where it can't be told apart or does not end this outside.
fn find_neighbour(edge_end: EdgeEnd, quad: Quad) -> Neighbour {
    let caster = casters[quad.caster];
    let offset_word = caster.first_vertex_offset_word + edge_end.vertex;
    let first = vertex_edges[offset_word];
    let last = vertex_edges[offset_word + 1u];
    if last - first > MAX_SEARCHED_VALENCE {
        return NO_NEIGHBOUR;
    }

    var nearest = NO_NEIGHBOUR;
    var second = NO_NEIGHBOUR;
    for (var i = first; i < last; i++) {
        let word = caster.first_vertex_edge_word + 2u * i;
        let edge_id = vertex_edges[word];
        let other_vertex = vertex_edges[word + 1u];
        let side = side_of_edge(caster, edge_id);
        if edge_id == quad.edge_id || side == OUTLINE_NONE {
            continue;
        }
        let direction = direction_from(edge_end.vertex, other_vertex, quad.caster);
        if all(direction == vec2f(0.0)) || coincide(edge_end.direction, direction) {
            return NO_NEIGHBOUR;
        }
        let turn = outside_turn(side, edge_end.vertex < other_vertex);
        let neighbour = Neighbour(direction, turn, turned(edge_end, direction));
        if neighbour.pseudo_angle < nearest.pseudo_angle {
            second = nearest;
            nearest = neighbour;
        } else if neighbour.pseudo_angle < second.pseudo_angle {
            second = neighbour;
        }
    }
    // The neighbour closes its side alone when it coincides with another; then this end must do so too.
    if nearest.turn == edge_end.turn || coincide(nearest.direction, second.direction) {
        return NO_NEIGHBOUR;
    }
    return nearest;
}

fn coincide(direction: vec2f, other: vec2f) -> bool {
    return dot(direction, other) > 1.0 - COINCIDENT;
}

// How far one turns through the outside from the edge to a direction.
fn turned(edge_end: EdgeEnd, direction: vec2f) -> f32 {
    let cosine = dot(edge_end.direction, direction);
    let sine = edge_end.turn * cross_2d(edge_end.direction, direction);
    return select(3.0 + cosine, 1.0 - cosine, sine >= 0.0);
}

// Unit bisector of a wedge of at most half a turn. The sum vanishes at half a turn and the difference at none, so each
// is used where it is long.
fn halfway(begin: vec2f, end: vec2f) -> vec2f {
    return normalize(select(counter_clockwise(begin - end), begin + end, dot(begin, end) >= 0.0));
}
