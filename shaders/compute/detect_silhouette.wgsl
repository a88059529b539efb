// Finds the edges whose signed multiplicity is not zero and the side on which their faces lie. An edge is read once for all
// views of a bundle.
// One invocation = one edge; one workgroup = one block.
// Reads edge_tests, counters.edge_tests, casters, edges, incidences, lit; writes silhouettes, outline_sides,
// counters.silhouette_edges, of each seat.

@group(0) @binding(0) var<uniform> bundle: ViewBundle;
@group(0) @binding(1) var<storage, read> edge_tests: array<TestItem>;
@group(0) @binding(2) var<storage, read> casters: array<Caster>;
@group(0) @binding(3) var<storage, read> edges: array<Edge>;
@group(0) @binding(4) var<storage, read> incidences: array<u32>;
@group(0) @binding(5) var<storage, read> lit: array<u32>;
@group(0) @binding(6) var<storage, read_write> silhouettes: array<SilhouetteEdge>;
@group(0) @binding(7) var<storage, read_write> outline_sides: array<u32>;
@group(0) @binding(8) var<storage, read_write> counters: array<AtomicSeatCounters>;

// Of each seat one after the other.
var<workgroup> group_sides: array<atomic<u32>, OUTLINE_WORDS_PER_BLOCK * MAX_SEATS>;

// Faces on the left and on the right of an edge as seen from the light.
alias Sides = vec2u;

// Bits of the seats where something is so.
struct Findings {
    silhouette: u32,
    left: u32,
    right: u32,
}

@compute @workgroup_size(64)
fn detect_silhouette(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    // Find the faces on both sides.
    let item_id = folded_group(group, groups);
    let in_range = item_id < atomicLoad(&counters[0].edge_tests);
    let item = edge_tests[select(0u, item_id, in_range)];
    let caster = casters[item.caster];
    let edge_id = item.block * BLOCK_SIZE + lane;
    var edge: Edge;
    var findings = Findings(0u, 0u, 0u);
    if in_range && edge_id < caster.edge_count {
        edge = edges[caster.first_edge + edge_id];
        findings = find(caster, edge, item.seats);
    }

    // Append to the silhouettes.
    count_for_seats(findings.silhouette);
    keep_sides(findings, lane);
    workgroupBarrier();
    if lane < bundle.shape.seat_count {
        let count = atomicLoad(&seat_counts[lane]);
        if count > 0u {
            atomicStore(&seat_places[lane], atomicAdd(&counters[lane].counts.silhouette_edges, count));
        }
    }
    workgroupBarrier();
    for (var seat = 0u; seat < bundle.shape.seat_count; seat++) {
        if has_seat(findings.silhouette, seat) {
            let place = atomicAdd(&seat_places[seat], 1u);
            if place < bundle.views[seat].silhouette_capacity {
                let sides = count_sides(caster, edge, seat);
                silhouettes[seat * bundle.shape.silhouette_stride + place] =
                    SilhouetteEdge(item.caster, edge_id, sides.x, sides.y);
            }
        }
    }

    // Keep the outline sides for whoever asks about a neighbour.
    let seat = lane / OUTLINE_WORDS_PER_BLOCK;
    if in_range && has_seat(item.seats, seat % MAX_SEATS) && seat < bundle.shape.seat_count {
        let word = caster.first_outline_word + item.block * OUTLINE_WORDS_PER_BLOCK + lane % OUTLINE_WORDS_PER_BLOCK;
        outline_sides[seat * bundle.shape.outline_stride + word] = atomicLoad(&group_sides[lane]);
    }
}

fn keep_sides(findings: Findings, lane: u32) {
    let blocker_left = findings.left & ~findings.right;
    let blocker_right = findings.right & ~findings.left;
    let shift = lane % 16u * 2u;
    for (var seat = 0u; seat < bundle.shape.seat_count; seat++) {
        let word = seat * OUTLINE_WORDS_PER_BLOCK + lane / 16u;
        if has_seat(blocker_left, seat) {
            atomicOr(&group_sides[word], OUTLINE_BLOCKER_LEFT << shift);
        } else if has_seat(blocker_right, seat) {
            atomicOr(&group_sides[word], OUTLINE_BLOCKER_RIGHT << shift);
        }
    }
}

fn find(caster: Caster, edge: Edge, seats: u32) -> Findings {
    if edge.first != INCIDENCE_LIST {
        // Of two faces there are as many on both sides where there is one on each.
        let both = sides_of(caster, edge.first, seats) | sides_of(caster, edge.second, seats);
        return Findings(both.x ^ both.y, both.x, both.y);
    }
    var findings = Findings(0u, 0u, 0u);
    for (var seat = 0u; seat < bundle.shape.seat_count; seat++) {
        let sides = count_sides(caster, edge, seat);
        findings.silhouette |= select(0u, 1u << seat, sides.x != sides.y);
        findings.left |= select(0u, 1u << seat, sides.x > 0u);
        findings.right |= select(0u, 1u << seat, sides.y > 0u);
    }
    return Findings(findings.silhouette & seats, findings.left & seats, findings.right & seats);
}

fn count_sides(caster: Caster, edge: Edge, seat: u32) -> Sides {
    if edge.first != INCIDENCE_LIST {
        return side_of(caster, edge.first, seat) + side_of(caster, edge.second, seat);
    }
    let list = caster.first_incidence + edge.second;
    let count = incidences[list];
    var sides = Sides(0u);
    for (var i = 1u; i <= count; i++) {
        sides += side_of(caster, incidences[list + i], seat);
    }
    return sides;
}

fn side_of(caster: Caster, incidence: u32, seat: u32) -> Sides {
    return sides_of(caster, incidence, 1u << seat) >> vec2u(seat);
}

// Bits of the seats that see a face on the left, and of those that see it on the right: it is on the left when its sign and
// its orientation along the edge agree.
fn sides_of(caster: Caster, incidence: u32, seats: u32) -> Sides {
    if incidence == INCIDENCE_NONE {
        return Sides(0u);
    }
    let lit_seats = seats_that_light(caster, incidence >> 1u);
    let left = seats & select(~lit_seats, lit_seats, (incidence & 1u) == 1u);
    return Sides(left, seats & ~left);
}

// Bits beyond the seats mean nothing.
fn seats_that_light(caster: Caster, face: u32) -> u32 {
    if face == UNLIT_FACE {
        return 0u;
    }
    let test = face << bundle.shape.seat_shift;
    return lit[first_lit_word(caster) + test / 32u] >> (test % 32u);
}
