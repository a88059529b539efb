// Adds one light to the picture from the eye, by the visibility function of the light's maps.
// One vertex invocation = one vertex of one mesh; one fragment invocation = one pixel of one triangle.
// Reads frame, surface, and through contrejour_visibility the light's maps.

@fragment
fn fragment_shade(vertex: ShadeVertex) -> @location(0) vec4f {
    let position_local = seen_local(vertex);
    let face_normal = face_normal_local(position_local, vertex.centre_local);
    let visibility = contrejour_visibility(position_local, face_normal);
    // Blending makes of alpha 1 what says that this light was added.
    return vec4f(lit(vertex, face_normal, visibility), 1.0);
}

// Visibility alone: black where the light is hidden, white where it is seen.
@fragment
fn fragment_show_visibility(vertex: ShadeVertex) -> @location(0) vec4f {
    let position_local = seen_local(vertex);
    let face_normal = face_normal_local(position_local, vertex.centre_local);
    let visibility = contrejour_visibility(position_local, face_normal);
    if is_cut(base_color(vertex).a) {
        discard;
    }
    return vec4f(vec3f(received_visibility(visibility)), 1.0);
}
