// Draws the faces that masks cut over the shadow map of a light view: hardware depth, and linear depth where it is read;
// nearest wins, both face sides.
// One vertex invocation = one corner of one face of one masked work item; they lie at the back of the list.
// Reads face_items, casters, caster_lights, faces, positions, masks, mask_words.

@group(0) @binding(0) var<uniform> view: LightView;
@group(0) @binding(1) var<storage, read> face_items: array<WorkItem>;
@group(0) @binding(2) var<storage, read> casters: array<Caster>;
@group(0) @binding(3) var<storage, read> caster_lights: array<CasterLight>;
@group(0) @binding(4) var<storage, read> faces: array<Face>;
@group(0) @binding(5) var<storage, read> positions: array<u32>;
@group(0) @binding(6) var<storage, read> masks: array<Mask>;
@group(0) @binding(7) var<storage, read> mask_words: array<u32>;

struct MaskedVertex {
    @builtin(position) clip: vec4f,
    @location(0) depth_share: f32,
    @location(1) coordinates: vec2f,
    @location(2) alpha: f32,
    @location(3) @interpolate(flat) mask: u32,
}

@vertex
fn vertex_masked(@builtin(vertex_index) index: u32) -> MaskedVertex {
    let item = face_items[view.face_block_count - 1u - index / (3u * BLOCK_SIZE)];
    let caster = casters[item.caster];
    let face_id = item.block * BLOCK_SIZE + index / 3u % BLOCK_SIZE;
    if face_id >= caster.face_count {
        return MaskedVertex(NOWHERE, 0.0, vec2f(0.0), 0.0, 0u);
    }
    let face = faces[caster.first_face + face_id];
    let vertex_id = vec3u(face.a, face.b, face.c)[index % 3u];
    let vertex = shadow_vertex(caster_lights[item.caster].light_clip_from_object, scaled_position(caster, vertex_id));
    let mask = caster.mask - 1u;
    let word = masks[mask].first_vertex_word + 3u * vertex_id;
    let coordinates = bitcast<vec2f>(vec2u(mask_words[word], mask_words[word + 1u]));
    return MaskedVertex(vertex.clip, vertex.depth_share, coordinates, bitcast<f32>(mask_words[word + 2u]), mask);
}

// Whether there is something at a fragment. To be asked first: derivatives need all of its neighbours.
fn is_there(vertex: MaskedVertex) -> bool {
    let across = dpdx(vertex.coordinates);
    let down = dpdy(vertex.coordinates);
    let mask = masks[vertex.mask];
    return vertex.alpha * mask_alpha(mask, vertex.coordinates, across, down) >= mask.cutoff;
}

@fragment
fn fragment_masked_hardware_depth(vertex: MaskedVertex) {
    if !is_there(vertex) {
        discard;
    }
}

@fragment
fn fragment_masked_shadow_map(vertex: MaskedVertex) -> @location(0) f32 {
    if !is_there(vertex) {
        discard;
    }
    return shadow_depth(vertex.depth_share);
}

@fragment
fn fragment_masked_pancaked_hardware_depth(vertex: MaskedVertex) -> @builtin(frag_depth) f32 {
    if !is_there(vertex) {
        discard;
    }
    return pancaked_hardware_depth(vertex.depth_share);
}

@fragment
fn fragment_masked_pancaked_shadow_map(vertex: MaskedVertex) -> PancakedTexel {
    if !is_there(vertex) {
        discard;
    }
    return pancaked_texel(vertex.depth_share);
}
