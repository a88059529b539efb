//! From a count to the workgroups of an indirect dispatch: the twin of `shared/group_args.wgsl`.

use contrejour_layout::{BLOCK_SIZE, DispatchArgs, MAX_GROUPS_X};

/// Workgroups for so many invocations, folded where x alone would pass WebGPU's limit.
pub(crate) fn groups_for(invocations: u32) -> DispatchArgs {
    let groups = invocations.div_ceil(BLOCK_SIZE);
    DispatchArgs { x: groups.min(MAX_GROUPS_X), y: groups.div_ceil(MAX_GROUPS_X), z: 1 }
}
