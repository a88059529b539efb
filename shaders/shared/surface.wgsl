// A mesh of the scene as the eye sees it.
//
// Local space is the world, moved and scaled so that what the eye looks at lies near 1.

struct SurfaceLight {
    // Position and 1, or direction towards the light and 0.
    place_local: vec4f,
    // Unit axis away from the light.
    axis_local: vec4f,
    // Linear colour; w: its radiance on a white surface where the falloff is 1.
    color: vec4f,
    // x: one over the range, 0 where the light never ends; y: square of the least distance; z, w: scale and offset of the
    // cone's falloff. Distances are local.
    falloff: vec4f,
}

// The camera, with one of the lights.
struct Frame {
    eye_clip_from_local: mat4x4f,
    eye_local: vec4f,
    ambient: vec4f,
    light: SurfaceLight,
}

struct Surface {
    local_from_vertex: mat4x4f,
    // Columns of the normal matrix; the length of its results does not matter.
    local_normal_from_object: mat3x3f,
    // w: 1 replaces the vertex colours, 0 keeps them.
    base_color: vec4f,
    receives_shadow: u32,
    // Faces of the meshes before this one.
    first_face: u32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var<uniform> surface: Surface;
@group(1) @binding(1) var base_color_texture: texture_2d<f32>;
@group(1) @binding(2) var base_color_sampler: sampler;

// Whether alpha cuts what a pipeline draws. The others keep the depth test in front of their fragments.
override cuts = false;

// Whether there is nothing: alpha of vertices is relative to the cutoff. Derivatives come before this.
fn is_cut(alpha: f32) -> bool {
    return cuts && alpha < 1.0;
}

fn local_position(position: vec3f) -> vec3f {
    return (surface.local_from_vertex * vec4f(position, 1.0)).xyz;
}

// The triangle's own unit normal, turned to the eye. It needs no winding, so meshes may be wound as they like.
// `centre_local` is the position at the pixel's centre, also where that is outside the triangle: for derivatives.
fn face_normal_local(position_local: vec3f, centre_local: vec3f) -> vec3f {
    let towards_eye = normalize(frame.eye_local.xyz - position_local);
    let normal = cross(dpdx(centre_local), dpdy(centre_local));
    let length_squared = dot(normal, normal);
    if length_squared > 0.0 {
        return facing(normal * inverseSqrt(length_squared), towards_eye);
    }
    return towards_eye;
}

fn facing(normal: vec3f, direction: vec3f) -> vec3f {
    return select(-normal, normal, dot(normal, direction) >= 0.0);
}
