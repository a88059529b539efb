// Which of many an invocation is, in dispatches that are folded into two dimensions.

const GROUP_SIZE = 64u;

fn folded_group(group: vec3u, groups: vec3u) -> u32 {
    return group.y * groups.x + group.x;
}

fn folded_invocation(group: vec3u, groups: vec3u, lane: u32) -> u32 {
    return folded_group(group, groups) * GROUP_SIZE + lane;
}
