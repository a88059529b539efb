// Decides by full integers the undecided faces that are left: coordinates as far apart as f32 allows.
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
fn resolve_faces(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    let place = folded_invocation(group, groups, lane);
    if place < min(counters[0].undecided_far, undecided_capacity()) {
        let undecided_test = undecided[undecided_capacity() - 1u - place];
        let test = undecided_test.test;
        let caster = casters[undecided_test.caster];
        let face = faces[caster.first_face + face_of(test)];
        let caster_light = caster_lights[place_of_caster(seat_of(test), undecided_test.caster)];
        if is_determinant_positive(facing_bits(caster, caster_light, face)) {
            atomicOr(&lit[first_lit_word(caster) + test / 32u], 1u << (test % 32u));
        }
    }
}

// A difference of coordinates has at most 278 bits and a sign: 9 limbs. The determinant has 27. All numbers are held
// in arrays of the largest size, so that one multiplication serves for all; how many limbs count is passed along.
const MAX_LIMBS = 27u;
alias Limbs = array<u32, MAX_LIMBS>;

// Coordinates that span n bits have differences below 2^(n + 1), minors below 2^(2 n + 3) and a determinant below
// 2^(3 n + 6); with its sign that fits into 3 * `limbs` limbs when n + 3 fits into `limbs`.
fn is_determinant_positive(bits: FacingBits) -> bool {
    let edges = edge_span(bits);
    let light = light_span(bits);
    let limbs = (max(span_length(edges), span_length(light)) + 3u + 31u) / 32u;
    var sum: Limbs;
    for (var x = 0u; x < 3u; x++) {
        let y = (x + 1u) % 3u;
        let z = (x + 2u) % 3u;
        var p = difference(bits.b[x], bits.a[x], edges.begin, limbs);
        var q_y = difference(bits.c[y], bits.a[y], edges.begin, limbs);
        var minus_q_z = difference(bits.a[z], bits.c[z], edges.begin, limbs);
        var r_y = difference(bits.light[y], bits.light_origin[y], light.begin, limbs);
        var r_z = difference(bits.light[z], bits.light_origin[z], light.begin, limbs);
        var minor: Limbs;
        add_product(&minor, &q_y, limbs, &r_z, limbs);
        add_product(&minor, &minus_q_z, limbs, &r_y, limbs);
        add_product(&sum, &p, limbs, &minor, 2u * limbs);
    }
    var any_bit = 0u;
    for (var i = 0u; i < 3u * limbs; i++) {
        any_bit |= sum[i];
    }
    return any_bit != 0u && sign_mask(sum[3u * limbs - 1u]) == 0u;
}

// x - y as integers on the grid that begins at this grid bit.
fn difference(x: u32, y: u32, begin: u32, limbs: u32) -> Limbs {
    var result: Limbs;
    add_coordinate(&result, x, begin, limbs);
    add_coordinate(&result, y ^ 0x80000000u, begin, limbs);
    return result;
}

fn add_coordinate(sum: ptr<function, Limbs>, coordinate: u32, begin: u32, limbs: u32) {
    let shift = grid_shift(vec3u(coordinate)).x;
    // Bits of the mantissa below the grid's begin are zeros.
    let integer = mantissa(vec3u(coordinate)).x >> min(begin - min(shift, begin), 31u);
    let left = max(shift, begin) - begin;
    let bit = left % 32u;
    let low = integer << bit;
    let high = integer >> 1u >> (31u - bit);
    let mask = sign_mask(coordinate);
    var carry = mask & 1u;
    for (var i = 0u; i < limbs; i++) {
        let limb = select(0u, low, i == left / 32u) | select(0u, high, i == left / 32u + 1u);
        let limb_sum = add_carry((*sum)[i], limb ^ mask, carry);
        (*sum)[i] = limb_sum.x;
        carry = limb_sum.y;
    }
}

// sum += x * y, in two's complement of x_limbs + y_limbs limbs.
fn add_product(
    sum: ptr<function, Limbs>,
    x: ptr<function, Limbs>,
    x_limbs: u32,
    y: ptr<function, Limbs>,
    y_limbs: u32,
) {
    // As if both were unsigned.
    let limbs = x_limbs + y_limbs;
    var product: Limbs;
    for (var i = 0u; i < x_limbs; i++) {
        let x_limb = (*x)[i];
        var carry = 0u;
        for (var j = 0u; j < y_limbs; j++) {
            let limb = multiply_add(x_limb, (*y)[j], product[i + j], carry);
            product[i + j] = limb.x;
            carry = limb.y;
        }
        product[i + y_limbs] = carry;
    }

    // A negative x was read as x + 2^(32 x_limbs), so the product has a y too much up there; and the other way round.
    subtract(&product, x_limbs, limbs, y, sign_mask((*x)[x_limbs - 1u]));
    subtract(&product, y_limbs, limbs, x, sign_mask((*y)[y_limbs - 1u]));

    var carry = 0u;
    for (var i = 0u; i < limbs; i++) {
        let limb = add_carry((*sum)[i], product[i], carry);
        (*sum)[i] = limb.x;
        carry = limb.y;
    }
}

// Subtracts x from the limbs begin to end, under a set mask.
fn subtract(number: ptr<function, Limbs>, begin: u32, end: u32, x: ptr<function, Limbs>, mask: u32) {
    var carry = 1u;
    for (var i = begin; i < end; i++) {
        let limb = add_carry((*number)[i], ~((*x)[i - begin] & mask), carry);
        (*number)[i] = limb.x;
        carry = limb.y;
    }
}
