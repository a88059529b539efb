// What is written once per mesh. Meanings and units: the structs of the same names in the layout crate.

const INCIDENCE_NONE = 0xffffffffu;
const INCIDENCE_LIST = 0xfffffffeu;
const UNLIT_FACE = 0x7ffffffdu;
const NO_CASTER = 0xffffffffu;
const ACROSS_NOTHING = 0xffffffffu;
const ACROSS_NEVER = 0xfffffffeu;
const ACROSS_FAN = 0x80000000u;
const FAN_UNLIT = 0x3fffffffu;
const ACROSS_ALONG = 0x80000000u;
const ACROSS_ALONE = 0x40000000u;
const STREAM_FACE_WORDS = 18u;
const HALF_STREAM_FACE_WORDS = 9u;
const BLOCK_SIZE = 64u;
const FACES_PER_WORD = 32u;
const LIT_WORDS_PER_BLOCK = 2u;
const OUTLINE_WORDS_PER_BLOCK = 4u;
const BLOCK_BY_PLANES = 0u;
const BLOCK_MASKED = 2u;
const BLOCK_OF_CALLER = 3u;

struct Face {
    a: u32,
    b: u32,
    c: u32,
}

struct FaceNeighbours {
    across_ab: u32,
    across_bc: u32,
    across_ca: u32,
}

struct Edge {
    low_vertex: u32,
    high_vertex: u32,
    first: u32,
    second: u32,
}

struct VertexEdge {
    edge_id: u32,
    other_vertex: u32,
}

struct Caster {
    first_position_word: u32,
    position_stride_words: u32,
    first_face: u32,
    face_count: u32,
    first_edge: u32,
    edge_count: u32,
    first_incidence: u32,
    first_vertex_offset_word: u32,
    first_vertex_edge_word: u32,
    first_lit_word: u32,
    first_outline_word: u32,
    position_scale: f32,
    position_origin: vec3f,
    mask: u32,
}

struct Mask {
    first_vertex_word: u32,
    first_texel_word: u32,
    width: u32,
    height: u32,
    levels: u32,
    wrap_u: u32,
    wrap_v: u32,
    is_nearest: u32,
    cutoff: f32,
}

struct WorkItem {
    caster: u32,
    block: u32,
    kind: u32,
}
