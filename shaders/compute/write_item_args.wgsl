// Turns the numbers of listed blocks into the dispatches of classify_faces and detect_silhouette and into the draws of the
// shadow map.
// One invocation = the whole stage.
// Reads counters; writes item_args: for the words of lit bits, for the blocks of edges; draw_args: of the faces,
// and of those with a mask.

@group(0) @binding(0) var<uniform> view: LightView;
@group(0) @binding(1) var<storage, read> counters: Counters;
@group(0) @binding(2) var<storage, read_write> item_args: array<DispatchArgs>;
@group(0) @binding(3) var<storage, read_write> draw_args: array<DrawArgs>;

@compute @workgroup_size(1)
fn write_item_args() {
    let face_items = min(counters.face_items, view.face_block_count);
    let edge_items = min(counters.edge_items, view.edge_block_count);
    item_args[0] = groups_for(face_items * LIT_WORDS_PER_BLOCK);
    item_args[1] = groups_for(edge_items * BLOCK_SIZE);
    draw_args[0] = DrawArgs(face_items * BLOCK_SIZE * 3u, 1u, 0u, 0u);
    let masked_items = min(counters.masked_items, view.face_block_count);
    draw_args[3] = DrawArgs(masked_items * BLOCK_SIZE * 3u, 1u, 0u, 0u);
}
