// Lists the blocks of faces and of edges whose casters cast for the view, and leaves out those that are nobody's.
// One invocation = one block; the blocks of a workgroup are all of faces or all of edges.
// Masked faces go to the back of the list, where no stage looks.
// Reads caster_lights, face_blocks, edge_blocks; writes face_items, edge_items, counters.face_items, counters.masked_items,
// counters.edge_items.

@group(0) @binding(0) var<uniform> view: LightView;
@group(0) @binding(1) var<storage, read> caster_lights: array<CasterLight>;
@group(0) @binding(2) var<storage, read> face_blocks: array<WorkItem>;
@group(0) @binding(3) var<storage, read> edge_blocks: array<WorkItem>;
@group(0) @binding(4) var<storage, read_write> face_items: array<WorkItem>;
@group(0) @binding(5) var<storage, read_write> edge_items: array<WorkItem>;
@group(0) @binding(6) var<storage, read_write> counters: AtomicCounters;

@compute @workgroup_size(64)
fn list_blocks(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    // Find the block.
    let group_id = folded_group(group, groups);
    let face_groups = (view.face_block_count + GROUP_SIZE - 1u) / GROUP_SIZE;
    let is_of_faces = group_id < face_groups;
    let index = select(group_id - face_groups, group_id, is_of_faces) * GROUP_SIZE + lane;
    var item = WorkItem(0u, 0u, 0u);
    var casts = false;
    if is_of_faces && index < view.face_block_count {
        item = face_blocks[index];
        casts = item.caster != NO_CASTER && caster_lights[item.caster].casts != 0u;
        if casts && item.kind == BLOCK_MASKED {
            face_items[view.face_block_count - 1u - atomicAdd(&counters.masked_items, 1u)] = item;
            casts = false;
        }
    } else if !is_of_faces && index < view.edge_block_count {
        item = edge_blocks[index];
        casts = item.caster != NO_CASTER && caster_lights[item.caster].casts != 0u;
    }

    // List it. The lists have room for every block.
    let rank = rank_in_group(casts);
    if lane == 0u {
        if is_of_faces {
            append_base = atomicAdd(&counters.face_items, atomicLoad(&append_count));
        } else {
            append_base = atomicAdd(&counters.edge_items, atomicLoad(&append_count));
        }
    }
    workgroupBarrier();
    let slot = append_base + rank;
    if casts && is_of_faces {
        face_items[slot] = item;
    } else if casts {
        edge_items[slot] = item;
    }
}
