// Outline edges around a vertex. Reads casters, caster_lights, positions, outline_sides.

fn side_of_edge(caster: Caster, edge_id: u32) -> u32 {
    return outline_sides[caster.first_outline_word + edge_id / 16u] >> (edge_id % 16u * 2u) & 3u;
}

// Direction of an edge from one of its vertices, found from its lower vertex as its own quad finds it, so that all ends
// agree on it to the bit. Zero where the edge projects to a point.
fn direction_from(vertex: u32, other_vertex: u32, caster_id: u32) -> vec2f {
    let caster = casters[caster_id];
    let low = scaled_position(caster, min(vertex, other_vertex));
    let high = scaled_position(caster, max(vertex, other_vertex));
    let direction = image_direction(caster_lights[caster_id].light_clip_from_object, low, high);
    return select(-direction, direction, vertex < other_vertex);
}
