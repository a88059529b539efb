// Fills the shadow map of a light view: hardware depth of every caster, and linear depth where it is read; nearest wins,
// both face sides.
// One vertex invocation = one corner of one face of one work item, so that one draw serves all casters.
// Reads face_items, casters, caster_lights, faces, positions.

@group(0) @binding(0) var<uniform> view: LightView;
@group(0) @binding(1) var<storage, read> face_items: array<WorkItem>;
@group(0) @binding(2) var<storage, read> casters: array<Caster>;
@group(0) @binding(3) var<storage, read> caster_lights: array<CasterLight>;
@group(0) @binding(4) var<storage, read> faces: array<Face>;
@group(0) @binding(5) var<storage, read> positions: array<u32>;

@vertex
fn vertex_shadow_map(@builtin(vertex_index) index: u32) -> ShadowVertex {
    let item = face_items[index / (3u * BLOCK_SIZE)];
    let caster = casters[item.caster];
    let face_id = item.block * BLOCK_SIZE + index / 3u % BLOCK_SIZE;
    if face_id >= caster.face_count {
        return ShadowVertex(NOWHERE, 0.0);
    }
    let face = faces[caster.first_face + face_id];
    let vertices = vec3u(face.a, face.b, face.c);
    let position = scaled_position(caster, vertices[index % 3u]);
    return shadow_vertex(caster_lights[item.caster].light_clip_from_object, position);
}

@fragment
fn fragment_shadow_map(vertex: ShadowVertex) -> @location(0) f32 {
    return shadow_depth(vertex.depth_share);
}

@fragment
fn fragment_pancaked_hardware_depth(vertex: ShadowVertex) -> @builtin(frag_depth) f32 {
    return pancaked_hardware_depth(vertex.depth_share);
}

@fragment
fn fragment_pancaked_shadow_map(vertex: ShadowVertex) -> PancakedTexel {
    return pancaked_texel(vertex.depth_share);
}
