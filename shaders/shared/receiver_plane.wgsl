// The receiver's own plane, so that wide filters compare each texel with the depth that the receiver has there.

// Change of q along x and y of the image plane. On a plane q is linear there, so this is exact for flat receivers
// (Isidoro 2006, "Shadow mapping: GPU-based tips and techniques": receiver plane depth bias).
fn contrejour_q_gradient(lookup: ContrejourLookup) -> vec2f {
    let normal = lookup.normal_world;
    let axis = select(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), abs(normal.x) > 0.7);
    let along = contrejour_image_change(lookup, cross(normal, axis));
    let across = contrejour_image_change(lookup, cross(normal, cross(normal, axis)));
    let area = along.x * across.y - along.y * across.x;
    if abs(area) > 0.0 {
        let gradient = vec2f(along.z * across.y - across.z * along.y, across.z * along.x - along.z * across.x) / area;
        let steepest = CONTREJOUR_MAX_SLOPE * contrejour_receiver_view.texel_world
            * 0.5 * f32(contrejour_receiver_view.map_size) / contrejour_depth_scale(lookup.clip_w);
        let steepness = length(gradient);
        return gradient * select(1.0, steepest / steepness, steepness > steepest);
    }
    return vec2f(0.0);
}

// Change of NDC x and y and of q along a direction of the world.
fn contrejour_image_change(lookup: ContrejourLookup, direction_world: vec3f) -> vec3f {
    let view = contrejour_receiver_view;
    let change = view.light_clip_from_world * vec4f(direction_world, 0.0);
    let w = lookup.clip_w;
    let ndc_change = (change.xy - lookup.ndc * change.w) / w;
    let q_change = select((view.far_depth - view.near_depth) * change.z, change.w / (w * w), view.perspective == 1u);
    return vec3f(ndc_change, q_change);
}
