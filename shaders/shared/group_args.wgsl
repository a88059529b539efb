// From a count to the workgroups of an indirect dispatch, folded where x alone would pass WebGPU's limit.

fn groups_for(invocations: u32) -> DispatchArgs {
    let groups = (invocations + GROUP_SIZE - 1u) / GROUP_SIZE;
    return DispatchArgs(min(groups, MAX_GROUPS_X), (groups + MAX_GROUPS_X - 1u) / MAX_GROUPS_X, 1u);
}
