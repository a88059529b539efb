// The facing test's input, as bits: a face is lit when det(b - a, c - a, light - light_origin) > 0.
//
// Every finite f32 is a multiple of 2^-149, the smallest one. A grid bit n stands for 2^(n - 149); a coordinate lies
// somewhere on grid bits 0 to 276.

struct FacingBits {
    a: vec3u,
    b: vec3u,
    c: vec3u,
    light: vec3u,
    // `a` for a point, zero for a direction.
    light_origin: vec3u,
}

// A mirrored caster exchanges b and c, which changes the sign of the determinant and nothing else.
fn facing_bits(caster: Caster, caster_light: CasterLight, face: Face) -> FacingBits {
    let a = position_bits(caster, face.a);
    let b = position_bits(caster, face.b);
    let c = position_bits(caster, face.c);
    let is_mirrored = caster_light.mirrored != 0u;
    let is_point = caster_light.light_object.w << 1u != 0u;
    return FacingBits(
        a,
        select(b, c, is_mirrored),
        select(c, b, is_mirrored),
        caster_light.light_object.xyz,
        select(vec3u(0u), a, is_point),
    );
}

fn position_bits(caster: Caster, vertex: u32) -> vec3u {
    let word = caster.first_position_word + vertex * caster.position_stride_words;
    return vec3u(positions[word], positions[word + 1u], positions[word + 2u]);
}

// The grid bits that some coordinates use: from the lowest set one to before `end`. Empty when all are zero.
struct GridSpan {
    begin: u32,
    end: u32,
}

const EMPTY_SPAN = GridSpan(512u, 0u);

// The edges b - a and c - a share one grid.
fn edge_span(bits: FacingBits) -> GridSpan {
    return join_spans(join_spans(grid_span(bits.a), grid_span(bits.b)), grid_span(bits.c));
}

// The vector to the light has a grid of its own: its scale does not change the determinant's sign.
fn light_span(bits: FacingBits) -> GridSpan {
    return join_spans(grid_span(bits.light), grid_span(bits.light_origin));
}

fn join_spans(x: GridSpan, y: GridSpan) -> GridSpan {
    return GridSpan(min(x.begin, y.begin), max(x.end, y.end));
}

fn span_length(span: GridSpan) -> u32 {
    return max(span.begin, span.end) - span.begin;
}

fn grid_span(coordinates: vec3u) -> GridSpan {
    let mantissas = mantissa(coordinates);
    let shifts = grid_shift(coordinates);
    let is_zero = mantissas == vec3u(0u);
    let begins = select(shifts + firstTrailingBit(mantissas), vec3u(EMPTY_SPAN.begin), is_zero);
    let ends = select(shifts + firstLeadingBit(mantissas) + 1u, vec3u(EMPTY_SPAN.end), is_zero);
    return GridSpan(min(min(begins.x, begins.y), begins.z), max(max(ends.x, ends.y), ends.z));
}

// The 24 bits of the mantissa, the hidden one included.
fn mantissa(coordinates: vec3u) -> vec3u {
    let is_normal = (coordinates & vec3u(0x7f800000u)) != vec3u(0u);
    return (coordinates & vec3u(0x7fffffu)) | select(vec3u(0u), vec3u(0x800000u), is_normal);
}

// The grid bit on which the mantissa's lowest bit lies.
fn grid_shift(coordinates: vec3u) -> vec3u {
    return max((coordinates >> vec3u(23u)) & vec3u(0xffu), vec3u(1u)) - 1u;
}

// Spans up to this length are for refine_faces: differences of such coordinates are below 2^62.
const NEAR_SPAN = 61u;
