// Turns the number of words with faces to recheck into the dispatch of recheck_faces.
// One invocation = the whole stage.
// Reads counters; writes recheck_args.

@group(0) @binding(0) var<uniform> bundle: ViewBundle;
@group(0) @binding(1) var<storage, read> counters: array<SeatCounters>;
@group(0) @binding(2) var<storage, read_write> recheck_args: array<DispatchArgs>;

@compute @workgroup_size(1)
fn write_recheck_args() {
    // The first seat is never empty.
    let room = bundle.views[0].face_block_count * LIT_WORDS_PER_BLOCK << bundle.shape.seat_shift;
    let words = min(counters[0].recheck_words, room);
    recheck_args[0] = groups_for(words * FACES_PER_WORD);
}
