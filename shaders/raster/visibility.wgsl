// Fills a full-screen texture with visibility, from the depth buffer of the caller's eye view.
// One fragment invocation = one pixel; one triangle covers all.
// Reads eye_view, eye_depth and the light's maps.

@group(0) @binding(0) var<uniform> eye_view: EyeView;
@group(0) @binding(1) var eye_depth: texture_depth_2d;

@vertex
fn vertex_visibility(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return full_screen_clip(index);
}

@fragment
fn fragment_visibility(@builtin(position) pixel: vec4f) -> @location(0) f32 {
    let depth = textureLoad(eye_depth, vec2u(pixel.xy), 0);
    let position_world = world_position(pixel.xy, depth);

    // The face's own normal, from the nearer neighbours on both axes, so that depth edges do not bend it.
    let size = vec2i(textureDimensions(eye_depth));
    let right = shorter_step(position_world, pixel.xy, vec2f(1.0, 0.0), size);
    let down = shorter_step(position_world, pixel.xy, vec2f(0.0, 1.0), size);
    let across = cross(down, right);
    let area = length(across);
    // A pixel whose neighbours give no plane has no normal, and so no normal offset.
    var normal_world = vec3f(0.0);
    if area > 0.0 {
        normal_world = across / area;
    }
    let visibility = contrejour_visibility(position_world, normal_world);
    return select(visibility, 1.0, depth == eye_view.background_depth);
}

fn world_position(pixel: vec2f, depth: f32) -> vec3f {
    let ndc = (pixel / vec2f(textureDimensions(eye_depth)) - 0.5) * vec2f(2.0, -2.0);
    let position = eye_view.world_from_eye_clip * vec4f(ndc, depth, 1.0);
    return position.xyz / position.w;
}

fn shorter_step(origin: vec3f, pixel: vec2f, axis: vec2f, size: vec2i) -> vec3f {
    let ahead = world_at(pixel + axis, size) - origin;
    let behind = origin - world_at(pixel - axis, size);
    let ahead_is_shorter = dot(ahead, ahead) <= dot(behind, behind);
    // At the border of the texture one neighbour is the pixel itself.
    let is_border = all(ahead == vec3f(0.0)) || all(behind == vec3f(0.0));
    return select(behind, ahead, (ahead_is_shorter && !is_border) || all(behind == vec3f(0.0)));
}

fn world_at(pixel: vec2f, size: vec2i) -> vec3f {
    let inside = clamp(vec2i(pixel), vec2i(0), size - 1);
    return world_position(vec2f(inside) + 0.5, textureLoad(eye_depth, inside, 0));
}
