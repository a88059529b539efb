// What the compute stages write. Meanings and units: the structs of the same names in the layout crate.

const OUTLINE_NONE = 0u;
const OUTLINE_BLOCKER_LEFT = 1u;
const OUTLINE_BLOCKER_RIGHT = 2u;
const OWN_END_LOW = 1u;
const OWN_END_HIGH = 2u;
const CORNER_WEDGE = 0u;
const CORNER_CAP = 1u;
const MAX_SEARCHED_VALENCE = 256u;

struct RecheckWord {
    caster: u32,
    word: u32,
    tests: u32,
}

struct FaceTest {
    caster: u32,
    test: u32,
}

struct SilhouetteEdge {
    caster: u32,
    edge_id: u32,
    left: u32,
    right: u32,
}

struct Quad {
    low_ndc: vec2f,
    high_ndc: vec2f,
    outward: vec2f,
    width_ndc: vec2f,
    q: vec2f,
    caster: u32,
    edge_id: u32,
    low_vertex: u32,
    high_vertex: u32,
    own_ends: u32,
    side: u32,
}

struct Corner {
    apex_ndc: vec2f,
    begin: vec2f,
    middle: vec2f,
    end: vec2f,
    width_ndc: f32,
    q: f32,
    caster: u32,
    vertex_id: u32,
    edge_id: u32,
    kind: u32,
}
