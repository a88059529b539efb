// Turns the numbers of undecided faces into the dispatches of refine_faces and resolve_faces.
// One invocation = the whole stage.
// Reads counters; writes refine_args: for the near faces, for the far faces.

@group(0) @binding(0) var<uniform> bundle: ViewBundle;
@group(0) @binding(1) var<storage, read> counters: array<SeatCounters>;
@group(0) @binding(2) var<storage, read_write> refine_args: array<DispatchArgs>;

@compute @workgroup_size(1)
fn write_refine_args() {
    refine_args[0] = groups_for(min(counters[0].undecided_near, undecided_capacity()));
    refine_args[1] = groups_for(min(counters[0].undecided_far, undecided_capacity()));
}
