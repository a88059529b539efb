// Shades the scene from the eye: Lambert with a hemisphere of ambient light, times the visibility of one light.
// One vertex invocation = one vertex of one mesh; one fragment invocation = one pixel of one triangle.
// Reads frame, surface, and through contrejour_visibility the light's maps.
//
// Local space is the world, moved and scaled so that what the eye looks at lies near 1.

struct Frame {
    eye_clip_from_local: mat4x4f,
    eye_local: vec4f,
    // Position and 1, or direction towards the light and 0.
    light_local: vec4f,
    // Unit axis away from the light; w: cosine of half the cone, or -2 where the light has no cone.
    light_axis_local: vec4f,
    // Radiance of a white surface that faces the light at its target; w: squared distance of the target, or 0 where the
    // light does not fall off.
    light_color: vec4f,
    ambient: vec4f,
}

struct Surface {
    local_from_vertex: mat4x4f,
    // Columns of the normal matrix; the length of its results does not matter.
    local_normal_from_object: mat3x3f,
    // w: 1 replaces the vertex colours, 0 keeps them.
    base_color: vec4f,
    receives_shadow: u32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var<uniform> surface: Surface;

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
    let position_local = (surface.local_from_vertex * vec4f(position, 1.0)).xyz;
    return ShadeVertex(
        frame.eye_clip_from_local * vec4f(position_local, 1.0),
        position_local,
        position_local,
        surface.local_normal_from_object * normal,
        select(color, surface.base_color.rgb, surface.base_color.w == 1.0),
    );
}

@fragment
fn fragment_shade(vertex: ShadeVertex) -> @location(0) vec4f {
    let face_normal = face_normal_local(vertex);
    let normal = shading_normal(vertex.normal_local, face_normal);
    let received = light_at(vertex.position_local, normal) * visibility_at(vertex.position_local, face_normal);
    let ambient = frame.ambient.rgb * mix(GROUND, SKY, 0.5 + 0.5 * normal.y);
    return vec4f(tone_mapped(vertex.color * (received + ambient)), 1.0);
}

// Visibility alone: black where the light is hidden, white where it is seen.
@fragment
fn fragment_show_visibility(vertex: ShadeVertex) -> @location(0) vec4f {
    return vec4f(vec3f(visibility_at(vertex.position_local, face_normal_local(vertex))), 1.0);
}

fn visibility_at(position_local: vec3f, normal_local: vec3f) -> f32 {
    let visibility = contrejour_visibility(position_local, normal_local);
    return select(1.0, visibility, surface.receives_shadow == 1u);
}

// The triangle's own unit normal, turned to the eye. It needs no winding, so meshes may be wound as they like.
fn face_normal_local(vertex: ShadeVertex) -> vec3f {
    let towards_eye = normalize(frame.eye_local.xyz - vertex.position_local);
    let normal = cross(dpdx(vertex.centre_local), dpdy(vertex.centre_local));
    let length_squared = dot(normal, normal);
    if length_squared > 0.0 {
        return facing(normal * inverseSqrt(length_squared), towards_eye);
    }
    return towards_eye;
}

// The interpolated normal, turned to the side of the face that is seen.
fn shading_normal(normal_local: vec3f, face_normal: vec3f) -> vec3f {
    let length_squared = dot(normal_local, normal_local);
    if length_squared > 0.0 {
        return facing(normal_local * inverseSqrt(length_squared), face_normal);
    }
    return face_normal;
}

fn facing(normal: vec3f, direction: vec3f) -> vec3f {
    return select(-normal, normal, dot(normal, direction) >= 0.0);
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
