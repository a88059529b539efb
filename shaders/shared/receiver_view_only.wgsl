// The view that shows a receiver, where a light has one.

fn contrejour_view_of(position_world: vec3f) -> u32 {
    return 0u;
}
