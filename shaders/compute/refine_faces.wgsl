// Decides by short integers the undecided faces whose coordinates have exponents close together.
// One invocation = one undecided face for one view.
// Reads undecided, counters, casters, caster_lights, faces, positions; writes lit.

@group(0) @binding(0) var<uniform> bundle: ViewBundle;
@group(0) @binding(1) var<storage, read> undecided: array<FaceTest>;
@group(0) @binding(2) var<storage, read> counters: array<SeatCounters>;
@group(0) @binding(3) var<storage, read> casters: array<Caster>;
@group(0) @binding(4) var<storage, read> caster_lights: array<CasterLight>;
@group(0) @binding(5) var<storage, read> faces: array<Face>;
@group(0) @binding(6) var<storage, read> positions: array<u32>;
@group(0) @binding(7) var<storage, read_write> lit: array<atomic<u32>>;

@compute @workgroup_size(64)
fn refine_faces(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let slot = folded_invocation(group, groups, lane);
    if slot < min(counters[0].undecided_near, undecided_capacity()) {
        let undecided_test = undecided[slot];
        let test = undecided_test.test;
        let caster = casters[undecided_test.caster];
        let face = faces[caster.first_face + face_of(test)];
        let caster_light = caster_lights[place_of_caster(seat_of(test), undecided_test.caster)];
        if is_determinant_positive(facing_bits(caster, caster_light, face)) {
            atomicOr(&lit[first_lit_word(caster) + test / 32u], 1u << (test % 32u));
        }
    }
}

// Coordinates have 61 bits and differences 62, so the minors of q and r are below 2^125 (4 limbs with their sign) and
// the determinant is below 6 * 2^186 < 2^189 (6 limbs with its sign).
fn is_determinant_positive(bits: FacingBits) -> bool {
    let edge_begin = edge_span(bits).begin;
    let light_begin = light_span(bits).begin;
    let a = aligned(bits.a, edge_begin);
    let p = difference(aligned(bits.b, edge_begin), a);
    let q = difference(aligned(bits.c, edge_begin), a);
    let r = difference(aligned(bits.light, light_begin), aligned(bits.light_origin, light_begin));
    var sum = Wide6(vec4u(0u), vec2u(0u));
    sum = add_product(sum, p.x, minor(q.y, r.z, q.z, r.y));
    sum = add_product(sum, p.y, minor(q.z, r.x, q.x, r.z));
    sum = add_product(sum, p.z, minor(q.x, r.y, q.y, r.x));
    let is_negative = sum.high.y >> 31u != 0u;
    return !is_negative && (any(sum.low != vec4u(0u)) || any(sum.high != vec2u(0u)));
}

// A magnitude of two limbs; the mask has all bits set where it is negated, else none.
struct Signed2 {
    magnitude: vec2u,
    mask: u32,
}

struct Wide6 {
    low: vec4u,
    high: vec2u,
}

struct Vector2 {
    x: vec2u,
    y: vec2u,
    z: vec2u,
}

struct SignedVector2 {
    x: Signed2,
    y: Signed2,
    z: Signed2,
}

// Coordinates as integers on the grid that begins at this grid bit.
fn aligned(coordinates: vec3u, begin: u32) -> Vector2 {
    let mantissas = mantissa(coordinates);
    let shifts = grid_shift(coordinates);
    // Bits of the mantissa below the grid's begin are zeros.
    let right = begin - min(shifts, vec3u(begin));
    let left = max(shifts, vec3u(begin)) - begin;
    let integers = mantissas >> min(right, vec3u(31u));
    let bit = left & vec3u(31u);
    let low = integers << bit;
    let spill = integers >> vec3u(1u) >> (vec3u(31u) - bit);
    let is_high = left >= vec3u(32u);
    let low_limbs = select(low, vec3u(0u), is_high);
    let high_limbs = select(spill, low, is_high);
    return Vector2(
        apply_sign(vec2u(low_limbs.x, high_limbs.x), sign_mask(coordinates.x)),
        apply_sign(vec2u(low_limbs.y, high_limbs.y), sign_mask(coordinates.y)),
        apply_sign(vec2u(low_limbs.z, high_limbs.z), sign_mask(coordinates.z)),
    );
}

// Negates under a set mask.
fn apply_sign(x: vec2u, mask: u32) -> vec2u {
    let low = add_carry(x.x ^ mask, 0u, mask & 1u);
    return vec2u(low.x, (x.y ^ mask) + low.y);
}

fn difference(x: Vector2, y: Vector2) -> SignedVector2 {
    return SignedVector2(subtract(x.x, y.x), subtract(x.y, y.y), subtract(x.z, y.z));
}

fn subtract(x: vec2u, y: vec2u) -> Signed2 {
    let low = x.x - y.x;
    let high = x.y - y.y - u32(x.x < y.x);
    let mask = sign_mask(high);
    return Signed2(apply_sign(vec2u(low, high), mask), mask);
}

// x0 x1 - y0 y1
fn minor(x0: Signed2, x1: Signed2, y0: Signed2, y1: Signed2) -> vec4u {
    let positive = add_signed(vec4u(0u), multiply(x0, x1), x0.mask ^ x1.mask);
    return add_signed(positive, multiply(y0, y1), ~(y0.mask ^ y1.mask));
}

// The magnitude of x * y.
fn multiply(x: Signed2, y: Signed2) -> vec4u {
    let a = x.magnitude;
    let b = y.magnitude;
    let p00 = multiply_add(a.x, b.x, 0u, 0u);
    let p01 = multiply_add(a.x, b.y, 0u, p00.y);
    let p10 = multiply_add(a.y, b.x, p01.x, 0u);
    let p11 = multiply_add(a.y, b.y, p01.y, p10.y);
    return vec4u(p00.x, p10.x, p11.x, p11.y);
}

// sum + magnitude, or sum - magnitude under a set mask.
fn add_signed(sum: vec4u, magnitude: vec4u, mask: u32) -> vec4u {
    let x = add_carry(sum.x, magnitude.x ^ mask, mask & 1u);
    let y = add_carry(sum.y, magnitude.y ^ mask, x.y);
    let z = add_carry(sum.z, magnitude.z ^ mask, y.y);
    return vec4u(x.x, y.x, z.x, sum.w + (magnitude.w ^ mask) + z.y);
}

// sum + x * y
fn add_product(sum: Wide6, x: Signed2, y: vec4u) -> Wide6 {
    let y_mask = sign_mask(y.w);
    let y_magnitude = add_signed(vec4u(0u), y, y_mask);
    let mask = x.mask ^ y_mask;

    // The magnitude: a row for each limb of x.
    let a = x.magnitude;
    let b = y_magnitude;
    let p00 = multiply_add(a.x, b.x, 0u, 0u);
    let p01 = multiply_add(a.x, b.y, 0u, p00.y);
    let p02 = multiply_add(a.x, b.z, 0u, p01.y);
    let p03 = multiply_add(a.x, b.w, 0u, p02.y);
    let p10 = multiply_add(a.y, b.x, p01.x, 0u);
    let p11 = multiply_add(a.y, b.y, p02.x, p10.y);
    let p12 = multiply_add(a.y, b.z, p03.x, p11.y);
    let p13 = multiply_add(a.y, b.w, p03.y, p12.y);

    // The sum.
    let s0 = add_carry(sum.low.x, p00.x ^ mask, mask & 1u);
    let s1 = add_carry(sum.low.y, p10.x ^ mask, s0.y);
    let s2 = add_carry(sum.low.z, p11.x ^ mask, s1.y);
    let s3 = add_carry(sum.low.w, p12.x ^ mask, s2.y);
    let s4 = add_carry(sum.high.x, p13.x ^ mask, s3.y);
    let s5 = sum.high.y + (p13.y ^ mask) + s4.y;
    return Wide6(vec4u(s0.x, s1.x, s2.x, s3.x), vec2u(s4.x, s5));
}
