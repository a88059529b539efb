// The picture's light on a surface: Lambert with a hemisphere of ambient light, for a given visibility of the one light.

// The cone's edge is soft over this part of one minus the cosine of half the cone.
const CONE_EDGE = 0.1;
// Ambient light from above and from below, relative to the mean.
const SKY = 1.2;
const GROUND = 0.8;
// Up to here tones stay as they are, so that shadows are shown untouched; beyond, they approach 1.
const SHOULDER = 0.7;

// Cosine at which light fades out. Interpolated normals are still lit where the flat faces below them no longer are;
// without this margin those faces would show as teeth along the border between light and dark.
const TERMINATOR = 0.12;

struct ShadeVertex {
    @builtin(position) clip: vec4f,
    // At the pixel's centre, even where that is outside the triangle: for derivatives.
    @location(0) centre_local: vec3f,
    // Inside the triangle: for everything else.
    @location(1) @interpolate(perspective, centroid) position_local: vec3f,
    @location(2) @interpolate(perspective, centroid) normal_local: vec3f,
    @location(3) @interpolate(perspective, centroid) color: vec3f,
}

@vertex
fn vertex_shade(@location(0) position: vec3f, @location(1) normal: vec3f, @location(2) color: vec3f) -> ShadeVertex {
    let position_local = local_position(position);
    return ShadeVertex(
        frame.eye_clip_from_local * vec4f(position_local, 1.0),
        position_local,
        position_local,
        surface.local_normal_from_object * normal,
        select(color, surface.base_color.rgb, surface.base_color.w == 1.0),
    );
}

// The picture's tone where the light is visible by this much; surfaces that receive no shadow always see it.
fn shaded(vertex: ShadeVertex, face_normal: vec3f, visibility: f32) -> vec4f {
    let normal = shading_normal(vertex.normal_local, face_normal);
    let received = light_at(vertex.position_local, normal) * received_visibility(visibility);
    let ambient = frame.ambient.rgb * mix(GROUND, SKY, 0.5 + 0.5 * normal.y);
    return vec4f(tone_mapped(vertex.color * (received + ambient)), 1.0);
}

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

// Unshadowed light on a white surface: Lambert's cosine, the cone, and the inverse square of the distance.
fn light_at(position_local: vec3f, normal: vec3f) -> vec3f {
    let to_light = frame.light_local.xyz - frame.light_local.w * position_local;
    let distance_squared = max(dot(to_light, to_light), 1e-12);
    let towards_light = to_light * inverseSqrt(distance_squared);
    let cone_cosine = frame.light_axis_local.w;
    let inner_cosine = cone_cosine + CONE_EDGE * (1.0 - cone_cosine);
    let cone = smoothstep(cone_cosine, inner_cosine, dot(-towards_light, frame.light_axis_local.xyz));
    let falloff = select(1.0, frame.light_color.w / distance_squared, frame.light_local.w == 1.0);
    let cosine = max(dot(normal, towards_light) - TERMINATOR, 0.0) / (1.0 - TERMINATOR);
    return frame.light_color.rgb * cosine * cone * falloff;
}

fn tone_mapped(color: vec3f) -> vec3f {
    let above = max(color - SHOULDER, vec3f(0.0));
    return min(color, vec3f(SHOULDER)) + (1.0 - SHOULDER) * (1.0 - exp(-above / (1.0 - SHOULDER)));
}
