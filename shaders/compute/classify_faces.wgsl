// Decides by their stored planes which faces are lit, as far as a proven bound allows, and lists the others for
// recheck_faces. A plane is read once for all views of a bundle.
// One invocation = half a block, 32 faces: as many words of lit bits as there are seats.
// Reads face_tests, counters.face_tests, casters, caster_lights, planes; writes lit, recheck_words, counters.recheck_words,
// of the bundle by words and of each seat by half blocks.

@group(0) @binding(0) var<uniform> bundle: ViewBundle;
@group(0) @binding(1) var<storage, read> face_tests: array<TestItem>;
@group(0) @binding(2) var<storage, read> casters: array<Caster>;
@group(0) @binding(3) var<storage, read> caster_lights: array<CasterLight>;
@group(0) @binding(4) var<storage, read> planes: array<vec4f>;
@group(0) @binding(5) var<storage, read_write> lit: array<u32>;
@group(0) @binding(6) var<storage, read_write> recheck_words: array<RecheckWord>;
@group(0) @binding(7) var<storage, read_write> counters: array<AtomicSeatCounters>;

// 1 in bundles of one seat, where nothing is to be done for others; 0 serves any number.
override one_seat = 0u;

// A bit for each test.
struct Verdicts {
    lit: u32,
    undecided: u32,
}

@compute @workgroup_size(64)
fn classify_faces(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    // Find the faces.
    let index = folded_invocation(group, groups, lane);
    let item_id = index / LIT_WORDS_PER_BLOCK;
    if item_id >= atomicLoad(&counters[0].face_tests) {
        return;
    }
    let item = face_tests[item_id];
    let caster = casters[item.caster];
    let half = item.block * LIT_WORDS_PER_BLOCK + index % LIT_WORDS_PER_BLOCK;
    let first_face_id = half * FACES_PER_WORD;
    let face_count = min(max(caster.face_count, first_face_id) - first_face_id, FACES_PER_WORD);

    // Test them, word by word.
    let by_planes = seats_by_planes(item);
    let by_positions = item.seats & ~by_planes;
    let seat_count = seat_count();
    let faces_per_word = FACES_PER_WORD / seat_count;
    let light = light_of(item, by_planes, 0u);
    var first_lights: mat4x4f;
    var last_lights: mat4x4f;
    if one_seat == 0u {
        first_lights = lights_of(item, by_planes, 0u);
        last_lights = lights_of(item, by_planes, 4u);
    }
    var undecided_seats = 0u;
    for (var word = 0u; word < seat_count; word++) {
        let first = word * faces_per_word;
        let count = min(max(face_count, first) - first, faces_per_word);
        let first_face = caster.first_face + first_face_id + first;
        var verdicts = Verdicts(0u, 0u);
        if one_seat == 1u {
            verdicts = classify_for_one(first_face, count, light);
        } else {
            verdicts = classify_for_all(first_face, count, first_lights, last_lights);
        }
        verdicts.undecided |= for_each_face(by_positions, count);

        // Write the word. The list has room for every one.
        lit[first_lit_word(caster) + half * seat_count + word] = verdicts.lit;
        if verdicts.undecided != 0u {
            let slot = atomicAdd(&counters[0].recheck_words, 1u);
            recheck_words[slot] = RecheckWord(item.caster, half * seat_count + word, verdicts.undecided);
            undecided_seats |= seats_among(verdicts.undecided);
        }
    }
    for (var seat = 0u; seat < seat_count; seat++) {
        if has_seat(undecided_seats, seat) {
            atomicAdd(&counters[seat].counts.recheck_words, 1u);
        }
    }
}

fn seat_count() -> u32 {
    return select(bundle.shape.seat_count, 1u, one_seat == 1u);
}

// The bits of seats, once for each of so many faces.
fn for_each_face(seats: u32, face_count: u32) -> u32 {
    let tests = face_count * seat_count();
    let each = seats * (0xffffffffu / ((1u << seat_count()) - 1u));
    return select(each & (0xffffffffu >> (32u - tests)), 0u, tests == 0u);
}

// The seats of which some test is in a word.
fn seats_among(tests: u32) -> u32 {
    if one_seat == 1u {
        return 1u;
    }
    var seats = tests;
    for (var width = 16u; width >= seat_count(); width /= 2u) {
        seats |= seats >> width;
    }
    return seats & ((1u << seat_count()) - 1u);
}

fn seats_by_planes(item: TestItem) -> u32 {
    var seats = 0u;
    for (var seat = 0u; seat < seat_count(); seat++) {
        let light = caster_lights[place_of_caster(seat, item.caster)].light_object;
        seats |= select(0u, 1u << seat, item.kind == BLOCK_BY_PLANES && is_in_range(light));
    }
    return seats & item.seats;
}

// The scaled lights of four seats, component by component.
fn lights_of(item: TestItem, by_planes: u32, seat: u32) -> mat4x4f {
    return transpose(mat4x4f(
        light_of(item, by_planes, seat),
        light_of(item, by_planes, seat + 1u),
        light_of(item, by_planes, seat + 2u),
        light_of(item, by_planes, seat + 3u),
    ));
}

// For zeros each face is unlit.
fn light_of(item: TestItem, by_planes: u32, seat: u32) -> vec4f {
    if !has_seat(by_planes, seat) {
        return vec4f(0.0);
    }
    return scaled_light(caster_lights[place_of_caster(seat, item.caster)]);
}

// The bound of the test. u = 2^-23 is the largest relative error of an operation that rounds correctly in some
// direction, and of a component of a stored plane. A term is a component times the light's. S is the sum of the exact
// terms' magnitudes; their sum is the determinant.
//
// Range: components are zero or 2^-60 to 2^60 large, the light's are zero or 2^-40 to 2^60, so terms are zero or 2^-100
// to 2^120. Nothing overflows, and no term underflows. Where a sum of terms cancels so far that it may be flushed to
// zero, that is off by 2^-126 < u S / 7.
//
// Rounding: each term goes through the storing, a multiplication and at most three additions, in whatever order and
// fused or not. So the sum is off by less than 5.0001 u S, and by u S / 2 where three sums are flushed. `size` adds up
// magnitudes, so it is above (1 - u)^5 S, and the bound is above 7.99 u S where S is not zero.
//
// Zero: where each term is exactly zero so are the sum, `size` and the bound, and the face is unlit, as one is that is
// exactly edge-on. So it is for most faces of mechanical parts that an axis-aligned light meets edge-on.
const ROUNDING = 0x1p-20;

fn classify_for_one(first_face: u32, face_count: u32, light: vec4f) -> Verdicts {
    var lit_bits = 0u;
    var not_unlit_bits = 0u;
    for (var i = 0u; i < face_count; i++) {
        let terms = planes[first_face + i] * light;
        let sizes = abs(terms);
        let determinant = terms.x + terms.y + terms.z + terms.w;
        let bound = ROUNDING * (sizes.x + sizes.y + sizes.z + sizes.w);
        lit_bits |= select(0u, 1u << i, determinant > bound);
        not_unlit_bits |= select(0u, 1u << i, determinant > -bound);
    }
    return Verdicts(lit_bits, not_unlit_bits & ~lit_bits);
}

// Four views in each step, with the same sums.
fn classify_for_all(first_face: u32, face_count: u32, first_lights: mat4x4f, last_lights: mat4x4f) -> Verdicts {
    var lit_bits = 0u;
    var not_unlit_bits = 0u;
    for (var i = 0u; i < face_count; i++) {
        let plane = planes[first_face + i];
        let shift = i << bundle.shape.seat_shift;
        let first = classify(plane, first_lights);
        lit_bits |= first.x << shift;
        not_unlit_bits |= first.y << shift;
        if bundle.shape.seat_count == MAX_SEATS {
            let last = classify(plane, last_lights);
            lit_bits |= last.x << (shift + 4u);
            not_unlit_bits |= last.y << (shift + 4u);
        }
    }
    return Verdicts(lit_bits, not_unlit_bits & ~lit_bits);
}

// Bits of the views for which a face is lit, and of those for which it is not decided to be unlit.
fn classify(plane: vec4f, lights: mat4x4f) -> vec2u {
    let x = plane.x * lights[0];
    let y = plane.y * lights[1];
    let z = plane.z * lights[2];
    let w = plane.w * lights[3];
    let determinants = x + y + z + w;
    let bounds = ROUNDING * (abs(x) + abs(y) + abs(z) + abs(w));
    return vec2u(bits_of(determinants > bounds), bits_of(determinants > -bounds));
}

fn bits_of(flags: vec4<bool>) -> u32 {
    let bits = select(vec4u(0u), vec4u(1u, 2u, 4u, 8u), flags);
    return bits.x | bits.y | bits.z | bits.w;
}

// The light's largest component is brought to 2^59 or more and below 2^60; those that are not zero may be 2^-99 of it.
const LARGEST_EXPONENT = 186u;
const EXPONENT_RANGE = 99u;

fn is_in_range(light: vec4u) -> bool {
    let exponents = exponents_of(light);
    let is_zero = light << vec4u(1u) == vec4u(0u);
    let is_near = (exponents != vec4u(0u)) & (largest_of(exponents) - exponents <= vec4u(EXPONENT_RANGE));
    return all(is_zero | is_near);
}

// By the bits, since a device may flush subnormal numbers. A mirrored caster changes the determinant's sign.
fn scaled_light(caster_light: CasterLight) -> vec4f {
    let light = caster_light.light_object;
    let scale = (LARGEST_EXPONENT - largest_of(exponents_of(light))) << 23u;
    let is_zero = light << vec4u(1u) == vec4u(0u);
    let scaled = bitcast<vec4f>(select(light + vec4u(scale), vec4u(0u), is_zero));
    return select(scaled, -scaled, caster_light.mirrored != 0u);
}

fn exponents_of(light: vec4u) -> vec4u {
    return (light >> vec4u(23u)) & vec4u(0xffu);
}

fn largest_of(exponents: vec4u) -> u32 {
    return max(max(exponents.x, exponents.y), max(exponents.z, exponents.w));
}
