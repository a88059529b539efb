// Visibility by the cascades of a light, which a receiver's depth in the eye's view tells apart: the nearest first. Twin:
// `Cascades::at` of the plan crate.

fn contrejour_visibility(position_world: vec3f, normal_world: vec3f) -> f32 {
    let eye_depth = dot(contrejour_receiver_views[0].eye_depth_from_world, vec4f(position_world, 1.0));
    let last = CONTREJOUR_VIEWS - 1u;
    var view = 0u;
    while view < last && eye_depth > contrejour_receiver_views[view].end_depth {
        view++;
    }
    let next_share = contrejour_next_share(view, eye_depth);
    if next_share == 0.0 {
        return contrejour_visibility_in_view(view, position_world, normal_world);
    }
    var next = contrejour_unshadowed(normal_world);
    if view < last {
        next = contrejour_visibility_in_view(view + 1u, position_world, normal_world);
    }
    if next_share == 1.0 {
        return next;
    }
    return mix(contrejour_visibility_in_view(view, position_world, normal_world), next, next_share);
}

// Share of the next cascade, or of light behind the last one.
fn contrejour_next_share(view: u32, eye_depth: f32) -> f32 {
    let begin = contrejour_receiver_views[view].blend_depth;
    let end = contrejour_receiver_views[view].end_depth;
    if eye_depth <= begin {
        return 0.0;
    }
    // Cascades may have no border to blend over.
    return select((eye_depth - begin) / (end - begin), 1.0, eye_depth >= end);
}

// Beyond all maps only sides that are averted from the light are dark.
fn contrejour_unshadowed(normal_world: vec3f) -> f32 {
    return select(1.0, 0.0, dot(normal_world, contrejour_receiver_views[0].light_world.xyz) < 0.0);
}
