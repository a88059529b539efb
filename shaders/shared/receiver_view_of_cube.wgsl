// Visibility by the view that shows a receiver, where a point light looks through the faces of a cube: +x, -x, +y, -y, +z, -z.

fn contrejour_visibility(position_world: vec3f, normal_world: vec3f) -> f32 {
    return contrejour_visibility_in_view(contrejour_face_of(position_world), position_world, normal_world);
}

// By the largest component of the way from the light; where two are as large, x goes before y before z.
fn contrejour_face_of(position_world: vec3f) -> u32 {
    let from_light = position_world - contrejour_receiver_views[0].light_world.xyz;
    let size = abs(from_light);
    var axis = 2u;
    if size.x >= size.y && size.x >= size.z {
        axis = 0u;
    } else if size.y >= size.z {
        axis = 1u;
    }
    return 2u * axis + u32(from_light[axis] < 0.0);
}
