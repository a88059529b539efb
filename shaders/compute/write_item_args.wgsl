// Turns the numbers of listed blocks into the dispatches of classify_faces and detect_silhouette and into the draws of the
// shadow maps.
// One invocation = one seat.
// Reads counters; writes item_args: for half blocks of faces, for blocks of edges; draw_args of each seat: of the faces, and
// of those with a mask.

@group(0) @binding(0) var<uniform> bundle: ViewBundle;
@group(0) @binding(1) var<storage, read> counters: array<SeatCounters>;
@group(0) @binding(2) var<storage, read_write> item_args: array<DispatchArgs>;
@group(0) @binding(3) var<storage, read_write> draw_args: array<DrawArgs>;

// From one seat's draws to the next one's: what one view binds begins at a multiple of 256 bytes.
const DRAW_STRIDE = 16u;

@compute @workgroup_size(8)
fn write_item_args(@builtin(local_invocation_index) seat: u32) {
    if seat >= bundle.shape.seat_count {
        return;
    }
    let face_block_count = bundle.views[seat].face_block_count;
    let face_items = min(counters[seat].counts.face_items, face_block_count);
    draw_args[seat * DRAW_STRIDE] = DrawArgs(face_items * BLOCK_SIZE * 3u, 1u, 0u, 0u);
    let masked_items = min(counters[seat].counts.masked_items, face_block_count);
    draw_args[seat * DRAW_STRIDE + 3u] = DrawArgs(masked_items * BLOCK_SIZE * 3u, 1u, 0u, 0u);
    if seat == 0u {
        item_args[0] = groups_for(min(counters[0].face_tests, face_block_count) * LIT_WORDS_PER_BLOCK);
        item_args[1] = groups_for(min(counters[0].edge_tests, most_edge_blocks()) * BLOCK_SIZE);
    }
}

// Views that are not tested have none.
fn most_edge_blocks() -> u32 {
    var most = 0u;
    for (var seat = 0u; seat < bundle.shape.seat_count; seat++) {
        most = max(most, bundle.views[seat].edge_block_count);
    }
    return most;
}
