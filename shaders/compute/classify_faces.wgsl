// Decides by their stored planes which faces are lit, as far as a proven bound allows, and lists the others for
// recheck_faces.
// One invocation = one word of lit bits, 32 faces.
// Reads face_items, counters.face_items, casters, caster_lights, planes; writes lit, recheck_words, counters.recheck_words.

@group(0) @binding(0) var<uniform> view: LightView;
@group(0) @binding(1) var<storage, read> face_items: array<WorkItem>;
@group(0) @binding(2) var<storage, read> casters: array<Caster>;
@group(0) @binding(3) var<storage, read> caster_lights: array<CasterLight>;
@group(0) @binding(4) var<storage, read> planes: array<vec4f>;
@group(0) @binding(5) var<storage, read_write> lit: array<u32>;
@group(0) @binding(6) var<storage, read_write> recheck_words: array<RecheckWord>;
@group(0) @binding(7) var<storage, read_write> counters: AtomicCounters;

// A bit for each face.
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
    // Find the faces of the word.
    let index = folded_invocation(group, groups, lane);
    let item_id = index / LIT_WORDS_PER_BLOCK;
    if item_id >= atomicLoad(&counters.face_items) {
        return;
    }
    let item = face_items[item_id];
    let caster = casters[item.caster];
    let word = item.block * LIT_WORDS_PER_BLOCK + index % LIT_WORDS_PER_BLOCK;
    let first_face_id = word * FACES_PER_WORD;
    let face_count = min(max(caster.face_count, first_face_id) - first_face_id, FACES_PER_WORD);

    // Test them.
    let caster_light = caster_lights[item.caster];
    var verdicts = Verdicts(0u, 0u);
    if caster_light.casts != 0u && face_count > 0u {
        if item.kind == BLOCK_BY_PLANES && is_in_range(caster_light.light_object) {
            verdicts = classify_by_planes(caster.first_face + first_face_id, face_count, scaled_light(caster_light));
        } else {
            verdicts.undecided = 0xffffffffu >> (FACES_PER_WORD - face_count);
        }
    }

    // Write the word. The list has room for every one.
    lit[caster.first_lit_word + word] = verdicts.lit;
    if verdicts.undecided != 0u {
        let slot = atomicAdd(&counters.recheck_words, 1u);
        recheck_words[slot] = RecheckWord(item.caster, word, verdicts.undecided);
    }
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

fn classify_by_planes(first_face: u32, face_count: u32, light: vec4f) -> Verdicts {
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
