// Visibility where a light has one view.

fn contrejour_visibility(position_world: vec3f, normal_world: vec3f) -> f32 {
    return contrejour_visibility_in_view(0u, position_world, normal_world);
}
