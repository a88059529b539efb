// Turns the number of words with faces to recheck into the dispatch of recheck_faces.
// One invocation = the whole stage.
// Reads counters; writes recheck_args.

@group(0) @binding(0) var<uniform> view: LightView;
@group(0) @binding(1) var<storage, read> counters: Counters;
@group(0) @binding(2) var<storage, read_write> recheck_args: array<DispatchArgs>;

@compute @workgroup_size(1)
fn write_recheck_args() {
    let words = min(counters.recheck_words, view.face_block_count * LIT_WORDS_PER_BLOCK);
    recheck_args[0] = groups_for(words * FACES_PER_WORD);
}
