// The visibility of a light that throws no shadow.

fn contrejour_visibility(position_world: vec3f, normal_world: vec3f) -> f32 {
    return 1.0;
}
