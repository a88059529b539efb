// The picture's light on a surface: Lambert for a given visibility of one light, and a hemisphere of ambient light.

// Ambient light from above and from below, relative to the mean.
const SKY = 1.2;
const GROUND = 0.8;
// The brightest light that is added, the largest number of 16 bits.
const BRIGHTEST_LIGHT = 65504.0;

// Cosine at which light fades out. Interpolated normals are still lit where the flat faces below them no longer are;
// without this margin those faces would show as teeth along the border between light and dark.
const TERMINATOR = 0.12;

struct ShadeVertex {
    // All passes of a picture must find the same depth.
    @builtin(position) @invariant clip: vec4f,
    // At the pixel's centre, even where that is outside the triangle: for derivatives.
    @location(0) centre_local: vec3f,
    // Inside the triangle: for everything else. Drivers may interpolate there and divide by the eye's w at the centre, as
    // lavapipe does; that scales these alike, so the ratios to this w, which would be 1, are right.
    @location(1) @interpolate(perspective, centroid) inside_local: vec4f,
    @location(2) @interpolate(perspective, centroid) normal_local: vec3f,
    @location(3) @interpolate(perspective, centroid) color: vec4f,
    @location(4) @interpolate(perspective, centroid) texture_coordinates: vec2f,
    // At the pixel's centre, for derivatives.
    @location(5) centre_coordinates: vec2f,
}

@vertex
fn vertex_shade(
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) color: vec4f,
    @location(3) texture_coordinates: vec2f,
) -> ShadeVertex {
    let inside_local = surface.local_from_vertex * vec4f(position, 1.0);
    let position_local = local_position(position);
    return ShadeVertex(
        frame.eye_clip_from_local * vec4f(position_local, 1.0),
        position_local,
        inside_local,
        surface.local_normal_from_object * normal,
        color,
        texture_coordinates,
        texture_coordinates,
    );
}

// Where light and shadow are asked for.
fn seen_local(vertex: ShadeVertex) -> vec3f {
    return vertex.inside_local.xyz / vertex.inside_local.w;
}

// Vertex colour times texture, or what the scene gives in place of both, and their alpha.
fn base_color(vertex: ShadeVertex) -> vec4f {
    let across = dpdx(vertex.centre_coordinates);
    let down = dpdy(vertex.centre_coordinates);
    let coordinates = vertex.texture_coordinates / vertex.inside_local.w;
    let texel = textureSampleGrad(base_color_texture, base_color_sampler, coordinates, across, down);
    let color = vertex.color / vertex.inside_local.w * texel;
    return vec4f(select(color.rgb, surface.base_color.rgb, surface.base_color.w == 1.0), color.a);
}

// What the surface sends to the eye of the light where it is visible by this much.
fn lit(vertex: ShadeVertex, face_normal: vec3f, visibility: f32) -> vec3f {
    let normal = shading_normal(vertex.normal_local, face_normal);
    let received = light_at(seen_local(vertex), normal) * received_visibility(visibility);
    return min(base_color(vertex).rgb * received, vec3f(BRIGHTEST_LIGHT));
}

// Ambient light on a white surface.
fn ambient_at(normal: vec3f) -> vec3f {
    return frame.ambient.rgb * mix(GROUND, SKY, 0.5 + 0.5 * normal.y);
}

// Surfaces that receive no shadow always see the light.
fn received_visibility(visibility: f32) -> f32 {
    return select(1.0, visibility, surface.receives_shadow == 1u);
}

// The interpolated normal, turned to the side of the face that is seen.
fn shading_normal(normal_local: vec3f, face_normal: vec3f) -> vec3f {
    let length_squared = dot(normal_local, normal_local);
    if length_squared > 0.0 {
        return facing(normal_local * inverseSqrt(length_squared), face_normal);
    }
    return face_normal;
}

// Unshadowed light on a white surface: Lambert's cosine, the cone, and the falloff by distance.
fn light_at(position_local: vec3f, normal: vec3f) -> vec3f {
    let to_light = frame.light.place_local.xyz - frame.light.place_local.w * position_local;
    let distance_squared = clamp(dot(to_light, to_light), 1e-12, 1e37);
    let towards_light = to_light * inverseSqrt(distance_squared);
    let cone = cone_falloff(dot(-towards_light, frame.light.axis_local.xyz), frame.light.falloff.z, frame.light.falloff.w);
    let by_distance = distance_falloff(distance_squared, frame.light.falloff.x, frame.light.falloff.y);
    let falloff = min(frame.light.color.w * select(1.0, by_distance, frame.light.place_local.w == 1.0), BRIGHTEST_LIGHT);
    let cosine = max(dot(normal, towards_light) - TERMINATOR, 0.0) / (1.0 - TERMINATOR);
    return min(frame.light.color.rgb * (cosine * cone * falloff), vec3f(BRIGHTEST_LIGHT));
}
