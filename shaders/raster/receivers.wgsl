// Fills the receiver target: for each pixel the point on which shadow falls, its face and the face's normal.
// One vertex invocation = one corner of one face; one fragment invocation = one pixel of one triangle, one sample each.
// Reads frame and surface. Corners are not shared by faces, so that a vertex's index tells its face.

struct ReceiverVertex {
    @builtin(position) clip: vec4f,
    // Both as the picture's passes interpolate them, so that these ask for shadow at the same numbers.
    @location(0) centre_local: vec3f,
    @location(1) @interpolate(perspective, centroid) inside_local: vec4f,
    @location(2) @interpolate(flat) face_id: u32,
    @location(3) @interpolate(perspective, centroid) alpha: f32,
    @location(4) texture_coordinates: vec2f,
}

struct Receiver {
    // Bits of the position; w: one more than the face's id, so that 0 is no receiver.
    @location(0) point: vec4u,
    @location(1) normal_local: vec4f,
}

@vertex
fn vertex_receivers(
    @builtin(vertex_index) corner: u32,
    @location(0) position: vec3f,
    @location(2) color: vec4f,
    @location(3) texture_coordinates: vec2f,
) -> ReceiverVertex {
    let inside_local = surface.local_from_vertex * vec4f(position, 1.0);
    let centre_local = local_position(position);
    let clip = frame.eye_clip_from_local * vec4f(centre_local, 1.0);
    let face_id = surface.first_face + corner / 3u;
    return ReceiverVertex(clip, centre_local, inside_local, face_id, color.a, texture_coordinates);
}

@fragment
fn fragment_receivers(vertex: ReceiverVertex) -> Receiver {
    let position_local = vertex.inside_local.xyz / vertex.inside_local.w;
    let normal = face_normal_local(position_local, vertex.centre_local);
    let alpha = textureSample(base_color_texture, base_color_sampler, vertex.texture_coordinates).a;
    if is_cut(vertex.alpha / vertex.inside_local.w * alpha) {
        discard;
    }
    // What receives no shadow hides what is behind it, and is no receiver.
    let id = select(0u, vertex.face_id + 1u, surface.receives_shadow == 1u);
    return Receiver(vec4u(bitcast<vec3u>(position_local), id), vec4f(normal, 0.0));
}
