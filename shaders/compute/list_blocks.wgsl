// Lists the blocks of faces and of edges whose casters cast for the views of a bundle: for each view those to draw, and for
// all views together those to test. Leaves out those that are nobody's.
// One invocation = one block; the blocks of a workgroup are all of faces or all of edges.
// Masked faces go to the back of the lists of those to draw, where no stage looks.
// Reads caster_lights, face_blocks, edge_blocks; writes face_items, face_tests, edge_tests, and counters of these; of each
// seat counters.face_items, counters.masked_items, counters.edge_items.

@group(0) @binding(0) var<uniform> bundle: ViewBundle;
@group(0) @binding(1) var<storage, read> caster_lights: array<CasterLight>;
@group(0) @binding(2) var<storage, read> face_blocks: array<WorkItem>;
@group(0) @binding(3) var<storage, read> edge_blocks: array<WorkItem>;
@group(0) @binding(4) var<storage, read_write> face_items: array<WorkItem>;
@group(0) @binding(5) var<storage, read_write> face_tests: array<TestItem>;
@group(0) @binding(6) var<storage, read_write> edge_tests: array<TestItem>;
@group(0) @binding(7) var<storage, read_write> counters: array<AtomicSeatCounters>;

@compute @workgroup_size(64)
fn list_blocks(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    // Find the block, and the views that it is listed for. The first seat is never empty.
    let group_id = folded_group(group, groups);
    let face_groups = (bundle.views[0].face_block_count + GROUP_SIZE - 1u) / GROUP_SIZE;
    let is_of_faces = group_id < face_groups;
    let index = select(group_id - face_groups, group_id, is_of_faces) * GROUP_SIZE + lane;
    var item = WorkItem(NO_CASTER, 0u, 0u);
    if is_of_faces && index < bundle.views[0].face_block_count {
        item = face_blocks[index];
    } else if !is_of_faces && index < arrayLength(&edge_blocks) {
        item = edge_blocks[index];
    }
    let caster = item.caster;
    let is_masked = item.kind == BLOCK_MASKED;
    var seats = 0u;
    var tested = 0u;
    for (var seat = 0u; seat < bundle.shape.seat_count && caster != NO_CASTER; seat++) {
        // Views that nobody tests edges for have no blocks of them.
        let count = select(bundle.views[seat].edge_block_count, bundle.views[seat].face_block_count, is_of_faces);
        if index < count && caster_lights[place_of_caster(seat, caster)].casts != 0u {
            seats |= 1u << seat;
            tested |= select(0u, 1u << seat, (bundle.views[seat].flags & VIEW_TESTS) != 0u && !is_masked);
        }
    }

    // Find places for it. The lists have room for every block.
    let rank = rank_in_group(tested != 0u);
    count_for_seats(select(seats, 0u, is_masked));
    workgroupBarrier();
    let seat_count = select(0u, atomicLoad(&seat_counts[lane % MAX_SEATS]), lane < MAX_SEATS);
    if is_of_faces && lane == 0u {
        append_base = atomicAdd(&counters[0].face_tests, atomicLoad(&append_count));
    } else if lane == 0u {
        append_base = atomicAdd(&counters[0].edge_tests, atomicLoad(&append_count));
    }
    if is_of_faces && seat_count > 0u {
        atomicStore(&seat_places[lane], atomicAdd(&counters[lane].counts.face_items, seat_count));
    } else if seat_count > 0u {
        atomicAdd(&counters[lane].counts.edge_items, seat_count);
    }
    workgroupBarrier();

    // List it.
    let test = TestItem(item.caster, item.block, item.kind, tested);
    if tested != 0u && is_of_faces {
        face_tests[append_base + rank] = test;
    } else if tested != 0u {
        edge_tests[append_base + rank] = test;
    }
    for (var seat = 0u; seat < bundle.shape.seat_count && is_of_faces; seat++) {
        if has_seat(seats, seat) {
            face_items[seat * bundle.shape.item_stride + place_for(seat, is_masked)] = item;
        }
    }
}

// In the list of those to draw.
fn place_for(seat: u32, is_masked: bool) -> u32 {
    if is_masked {
        return bundle.views[seat].face_block_count - 1u - atomicAdd(&counters[seat].counts.masked_items, 1u);
    }
    return atomicAdd(&seat_places[seat], 1u);
}
