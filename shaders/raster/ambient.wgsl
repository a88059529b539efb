// Fills the depth buffer from the eye, and the picture with the light that is everywhere.
// One vertex invocation = one vertex of one mesh; one fragment invocation = one pixel of one triangle.
// Reads frame and surface.

@fragment
fn fragment_ambient(vertex: ShadeVertex) -> @location(0) vec4f {
    let face_normal = face_normal_local(seen_local(vertex), vertex.centre_local);
    let normal = shading_normal(vertex.normal_local, face_normal);
    let color = base_color(vertex);
    if is_cut(color.a) {
        discard;
    }
    // Alpha 0: no light was added yet.
    return vec4f(color.rgb * ambient_at(normal), 0.0);
}
