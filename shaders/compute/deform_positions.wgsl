// Moves the vertices of all deforming casters: by morph targets, then by the joints of a skin (glTF 2.0, 3.7.2.2, 3.7.3).
// One invocation = one vertex; one workgroup = one block of a caster's vertices.
// Reads blocks, rest_vertices, influences, morph_deltas, joint_matrices, morph_weights; writes positions.

@group(0) @binding(0) var<storage, read> blocks: array<DeformBlock>;
@group(0) @binding(1) var<storage, read> rest_vertices: array<RestVertex>;
@group(0) @binding(2) var<storage, read> influences: array<Influence>;
@group(0) @binding(3) var<storage, read> morph_deltas: array<MorphDelta>;
@group(0) @binding(4) var<storage, read> joint_matrices: array<JointMatrix>;
@group(0) @binding(5) var<storage, read> morph_weights: array<f32>;
@group(0) @binding(6) var<storage, read_write> positions: array<u32>;

@compute @workgroup_size(64)
fn deform_positions(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let block_id = folded_group(group, groups);
    if block_id >= arrayLength(&blocks) {
        return;
    }
    let block = blocks[block_id];
    if lane >= block.vertex_count {
        return;
    }
    let vertex = rest_vertices[block.first_vertex + lane];
    let position = skinned(block, vertex, morphed(block, vertex));
    let word = block.first_position_word + 3u * lane;
    positions[word] = finite_bits(position.x);
    positions[word + 1u] = finite_bits(position.y);
    positions[word + 2u] = finite_bits(position.z);
}

fn morphed(block: DeformBlock, vertex: RestVertex) -> vec3f {
    var position = vertex.position;
    let first = block.first_morph_delta + vertex.first_morph_delta;
    for (var i = 0u; i < vertex.morph_delta_count; i++) {
        let morph = morph_deltas[first + i];
        position += morph_weights[block.first_morph_weight + morph.morph_id] * morph.delta;
    }
    return position;
}

// What no joint moves stays where it is.
fn skinned(block: DeformBlock, vertex: RestVertex, position: vec3f) -> vec3f {
    if vertex.influence_count == 0u {
        return position;
    }
    let point = vec4f(position, 1.0);
    var sum = vec3f(0.0);
    let first = block.first_influence + vertex.first_influence;
    for (var i = 0u; i < vertex.influence_count; i++) {
        let influence = influences[first + i];
        let rows = joint_matrices[block.first_joint + influence.joint].rows;
        sum += influence.weight * vec3f(dot(rows[0], point), dot(rows[1], point), dot(rows[2], point));
    }
    return sum;
}

// What overflows stays at the largest number: facing is exact for finite positions alone. By the bits, since a device may
// take it that there are no infinite numbers.
fn finite_bits(number: f32) -> u32 {
    let bits = bitcast<u32>(number);
    let is_finite = (bits & 0x7f800000u) != 0x7f800000u;
    return select((bits & 0x80000000u) | 0x7f7fffffu, bits, is_finite);
}
