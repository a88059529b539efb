// The corners of a quad's two triangles: low inner, high inner, high outer; low inner, high outer, low outer.

struct QuadCorner {
    is_high: bool,
    is_outer: bool,
}

fn quad_corner(vertex_index: u32) -> QuadCorner {
    let corner = vertex_index % VERTICES_PER_QUAD;
    return QuadCorner(corner == 1u || corner == 2u || corner == 4u, corner == 2u || corner >= 4u);
}
