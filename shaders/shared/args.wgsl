// Counters and indirect arguments. Meanings and units: the structs of the same names in the layout crate.

const MAX_GROUPS_X = 65535u;
const VERTICES_PER_QUAD = 6u;
const VERTICES_PER_CORNER = 12u;

struct Counters {
    undecided_near: u32,
    undecided_far: u32,
    silhouette_edges: u32,
    quads: u32,
    corners: u32,
    point_edges: u32,
    recheck_words: u32,
    face_items: u32,
    edge_items: u32,
    casters: u32,
    imageless_casters: u32,
    masked_items: u32,
}

struct DispatchArgs {
    x: u32,
    y: u32,
    z: u32,
}

struct DrawArgs {
    vertex_count: u32,
    instance_count: u32,
    first_vertex: u32,
    first_instance: u32,
}
