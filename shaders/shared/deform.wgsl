// What moves the vertices of deforming meshes. Meanings and units: the structs of the same names in the layout crate.

struct RestVertex {
    position: vec3f,
    first_influence: u32,
    influence_count: u32,
    first_morph_delta: u32,
    morph_delta_count: u32,
    unused_0: u32,
}

struct Influence {
    joint: u32,
    weight: f32,
}

struct MorphDelta {
    delta: vec3f,
    morph_id: u32,
}

struct JointMatrix {
    rows: array<vec4f, 3>,
}

struct DeformBlock {
    first_vertex: u32,
    vertex_count: u32,
    first_influence: u32,
    first_morph_delta: u32,
    first_joint: u32,
    first_morph_weight: u32,
    first_position_word: u32,
}
