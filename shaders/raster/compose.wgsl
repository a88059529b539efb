// Shades the scene from the eye, by a visibility that was found before, one value a pixel.
// One vertex invocation = one vertex of one mesh; one fragment invocation = one pixel of one triangle.
// Reads frame, surface and visibility.

@group(2) @binding(0) var visibility: texture_2d<f32>;

@fragment
fn fragment_compose(vertex: ShadeVertex) -> @location(0) vec4f {
    let face_normal = face_normal_local(seen_local(vertex), vertex.centre_local);
    let received = lit(vertex, face_normal, textureLoad(visibility, vec2u(vertex.clip.xy), 0).x);
    let ambient = ambient_at(shading_normal(vertex.normal_local, face_normal));
    let color = base_color(vertex);
    if is_cut(color.a) {
        discard;
    }
    return vec4f(tone_mapped(received + color.rgb * ambient), 1.0);
}
