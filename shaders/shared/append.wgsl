// Appending to a list with one global atomic for each workgroup.
//
// Use, in uniform control flow: `rank = rank_in_group(wants)`; lane 0 adds `atomicLoad(&append_count)` to the global
// counter and puts what it got into `append_base`; after a barrier the slot is `append_base + rank`.

var<workgroup> append_count: atomic<u32>;
var<workgroup> append_base: u32;

fn rank_in_group(wants: bool) -> u32 {
    var rank = 0u;
    if wants {
        rank = atomicAdd(&append_count, 1u);
    }
    workgroupBarrier();
    return rank;
}
