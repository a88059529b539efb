// Decides by floats on their positions which of the faces are lit that planes leave undecided, as far as a proven bound
// allows, and lists those that it does not decide.
// One invocation = one face for one view; one workgroup = two words of lit bits.
// Reads recheck_words, casters, caster_lights, faces, positions, counters.recheck_words; writes lit, undecided,
// counters.undecided_near and _far, of the bundle and of each seat.

@group(0) @binding(0) var<uniform> bundle: ViewBundle;
@group(0) @binding(1) var<storage, read> recheck_words: array<RecheckWord>;
@group(0) @binding(2) var<storage, read> casters: array<Caster>;
@group(0) @binding(3) var<storage, read> caster_lights: array<CasterLight>;
@group(0) @binding(4) var<storage, read> faces: array<Face>;
@group(0) @binding(5) var<storage, read> positions: array<u32>;
@group(0) @binding(6) var<storage, read_write> lit: array<atomic<u32>>;
@group(0) @binding(7) var<storage, read_write> undecided: array<FaceTest>;
@group(0) @binding(8) var<storage, read_write> counters: array<AtomicSeatCounters>;

alias Verdict = u32;
const UNLIT: Verdict = 0u;
const LIT: Verdict = 1u;
const UNDECIDED: Verdict = 2u;
const UNDECIDED_NEAR: Verdict = 3u;
const UNDECIDED_FAR: Verdict = 4u;

var<workgroup> group_near_count: atomic<u32>;
var<workgroup> group_far_count: atomic<u32>;
var<workgroup> group_near_base: u32;
var<workgroup> group_far_base: u32;
var<workgroup> seat_near_counts: array<atomic<u32>, MAX_SEATS>;
var<workgroup> seat_far_counts: array<atomic<u32>, MAX_SEATS>;

@compute @workgroup_size(64)
fn recheck_faces(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    // Test the face.
    let index = folded_invocation(group, groups, lane);
    let slot = index / FACES_PER_WORD;
    let bit = index % FACES_PER_WORD;
    let in_range = slot < atomicLoad(&counters[0].recheck_words);
    let word = recheck_words[select(0u, slot, in_range)];
    let caster = casters[word.caster];
    let test = word.word * FACES_PER_WORD + bit;
    let seat = seat_of(test);
    var verdict = UNLIT;
    if in_range && (word.tests >> bit & 1u) == 1u {
        let caster_light = caster_lights[place_of_caster(seat, word.caster)];
        verdict = classify(caster, caster_light, faces[caster.first_face + face_of(test)]);
    }
    if verdict == LIT {
        atomicOr(&lit[first_lit_word(caster) + word.word], 1u << bit);
    }

    // Find places in the lists.
    var rank = 0u;
    if verdict == UNDECIDED_NEAR {
        rank = atomicAdd(&group_near_count, 1u);
        atomicAdd(&seat_near_counts[seat], 1u);
    } else if verdict == UNDECIDED_FAR {
        rank = atomicAdd(&group_far_count, 1u);
        atomicAdd(&seat_far_counts[seat], 1u);
    }
    workgroupBarrier();
    let near_count = atomicLoad(&group_near_count);
    let far_count = atomicLoad(&group_far_count);
    if lane == 0u && near_count > 0u {
        group_near_base = atomicAdd(&counters[0].undecided_near, near_count);
    }
    if lane == 0u && far_count > 0u {
        group_far_base = atomicAdd(&counters[0].undecided_far, far_count);
    }
    if lane < bundle.shape.seat_count && near_count + far_count > 0u {
        atomicAdd(&counters[lane].counts.undecided_near, atomicLoad(&seat_near_counts[lane]));
        atomicAdd(&counters[lane].counts.undecided_far, atomicLoad(&seat_far_counts[lane]));
    }
    workgroupBarrier();

    // Write: near faces from the list's front, far ones from its back. The list has room for every face.
    let is_near = verdict == UNDECIDED_NEAR;
    let place = rank + select(group_far_base, group_near_base, is_near);
    let capacity = undecided_capacity();
    if verdict >= UNDECIDED && place < capacity {
        undecided[select(capacity - 1u - place, place, is_near)] = FaceTest(word.caster, test);
    }
}

fn classify(caster: Caster, caster_light: CasterLight, face: Face) -> Verdict {
    if face.a == face.b || face.b == face.c || face.c == face.a {
        return UNLIT;
    }
    let bits = facing_bits(caster, caster_light, face);
    let verdict = classify_by_floats(bits);
    if verdict != UNDECIDED {
        return verdict;
    }
    if !may_have_volume(bits) {
        return UNLIT;
    }
    let is_near = max(span_length(edge_span(bits)), span_length(light_span(bits))) <= NEAR_SPAN;
    return select(UNDECIDED_FAR, UNDECIDED_NEAR, is_near);
}

// The bound of the float test. u = 2^-23 is the largest relative error of an operation that rounds correctly in some
// direction. P and Q are powers of two above all coordinates of the corners and of the light (and its origin).
//
// Rounding: each of the six products p q r of the determinant goes through three differences, two multiplications and
// at most five additions, in whatever order and fused or not. So the rounding error is below 10.0001 u S, where S is
// the sum of the products' magnitudes. `size` goes through as many operations, so it is above (1 - u)^10 S, and
// 16 u = 2^-19 covers the error, and the roundings of `size` and of the bound itself.
const ROUNDING = 0x1p-19;

// Underflow: inputs and results below 2^-126 may become zero. A difference is then off by at most 4 * 2^-126, a
// product or a sum by 2^-126. Differences are at most 2 P and 2 Q, so the determinant is off by at most
//     2^-126 (6 * 4 (8 P Q + 4 P^2) + 18 P + 11) < 2^-117 max(P Q, P^2, P, 1) < 2^-117 * 2^54 P^2 Q
// because P and Q are at least 2^-18. Twice that covers the underflow of `size`, and twice again all roundings.
const UNDERFLOW = 0x1p-61;

// No overflow: sums stay below 64 P^2 Q <= 2^126, because P and Q are at most 2^40. No underflow of the bound either:
// 2^-61 P^2 Q >= 2^-115. Both ranges are tested on the exponent bits of the largest coordinates, P / 2 and Q / 2.
const MIN_EXPONENT = 108u;
const MAX_EXPONENT = 166u;

fn classify_by_floats(bits: FacingBits) -> Verdict {
    let edge_exponent = max_exponent(bits.a, bits.b, bits.c);
    let light_exponent = max_exponent(bits.light, bits.light_origin, vec3u(0u));
    if min(edge_exponent, light_exponent) < MIN_EXPONENT || max(edge_exponent, light_exponent) > MAX_EXPONENT {
        return UNDECIDED;
    }
    let a = bitcast<vec3f>(bits.a);
    let p = bitcast<vec3f>(bits.b) - a;
    let q = bitcast<vec3f>(bits.c) - a;
    let r = bitcast<vec3f>(bits.light) - bitcast<vec3f>(bits.light_origin);
    let first = q.yzx * r.zxy;
    let second = q.zxy * r.yzx;
    let terms = p * (first - second);
    let sizes = abs(p) * (abs(first) + abs(second));
    let determinant = terms.x + terms.y + terms.z;
    let size = sizes.x + sizes.y + sizes.z;
    let edge_limit = power_above(edge_exponent);
    let bound = ROUNDING * size + UNDERFLOW * edge_limit * edge_limit * power_above(light_exponent);
    if determinant > bound {
        return LIT;
    }
    return select(UNDECIDED, UNLIT, -determinant > bound);
}

// The exponent bits of the largest coordinate.
fn max_exponent(x: vec3u, y: vec3u, z: vec3u) -> u32 {
    let largest = max(max(x & vec3u(0x7fffffffu), y & vec3u(0x7fffffffu)), z & vec3u(0x7fffffffu));
    return max(max(largest.x, largest.y), largest.z) >> 23u;
}

// The power of two above all numbers with these exponent bits.
fn power_above(exponent: u32) -> f32 {
    return bitcast<f32>((exponent + 1u) << 23u);
}

// False when each of the determinant's six products has a factor that is exactly zero: so it is for most faces of
// mechanical parts that an axis-aligned light meets edge-on.
fn may_have_volume(bits: FacingBits) -> bool {
    let p = differs(bits.b, bits.a);
    let q = differs(bits.c, bits.a);
    let r = differs(bits.light, bits.light_origin);
    return any((p & q.yzx & r.zxy) | (p & q.zxy & r.yzx));
}

fn differs(x: vec3u, y: vec3u) -> vec3<bool> {
    let are_zeros = ((x | y) << vec3u(1u)) == vec3u(0u);
    return (x != y) & !are_zeros;
}
