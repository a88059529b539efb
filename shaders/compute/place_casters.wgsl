// Brings the lights of a bundle and their clip spaces into the space of each caster, and leaves out casters that a view
// can't see.
// One invocation = one caster for one seat; the seat is the workgroup's z.
// Reads caster_places; writes caster_lights, counters.casters, counters.imageless_casters.

@group(0) @binding(0) var<uniform> bundle: ViewBundle;
@group(0) @binding(1) var<storage, read> caster_places: array<CasterPlace>;
@group(0) @binding(2) var<storage, read_write> caster_lights: array<CasterLight>;
@group(0) @binding(3) var<storage, read_write> counters: array<AtomicSeatCounters>;

var<private> seat: u32;

const NO_IMAGE = mat4x4f();

@compute @workgroup_size(64)
fn place_casters(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {
    seat = group.z;
    let id = folded_invocation(group, groups, lane);
    if id >= bundle.views[seat].caster_count {
        return;
    }
    var caster_light = CasterLight(vec4u(0u), NO_IMAGE, 0u, 0u, 0u, 0u);
    if caster_places[id].casts != CASTER_NEVER {
        let light = light_in_object_space(id);
        let matrix = clip_from_scaled(id);
        if is_finite(light) && may_be_seen(id, matrix) {
            caster_light = CasterLight(light, matrix, caster_places[id].mirrored, 1u, 0u, 0u);
            atomicAdd(&counters[seat].counts.casters, 1u);
            if !has_image(matrix) {
                caster_light.light_clip_from_object = NO_IMAGE;
                atomicAdd(&counters[seat].counts.imageless_casters, 1u);
            }
        }
    }
    caster_lights[place_of_caster(seat, id)] = caster_light;
}

// Bits of the homogeneous light, rounded once. A point goes from the object's origin, so a mere translation is exact. A
// direction keeps its length unless f32 can't hold it; then its largest component is brought into 1..2.
fn light_in_object_space(id: u32) -> vec4u {
    let is_point = !is_zero(light_world(3u));
    var object: array<Float64, 3>;
    for (var column = 0u; column < 3u; column++) {
        var along = light_world(column);
        if is_point {
            along = sum(along, negative(float64(caster_places[id].origin_world[column])));
        }
        for (var row = 0u; row < 3u; row++) {
            let entry = float64(caster_places[id].object_from_world[3u * column + row]);
            object[row] = sum(object[row], product(entry, along));
        }
    }
    var is_held = is_point;
    if !is_point {
        is_held = is_held_by_float32(object[0]) && is_held_by_float32(object[1]) && is_held_by_float32(object[2]);
    }
    if !is_held {
        let down = -63 - largest_exponent(object);
        for (var row = 0u; row < 3u; row++) {
            object[row].exponent += down;
        }
    }
    return vec4u(
        float32_bits(object[0]),
        float32_bits(object[1]),
        float32_bits(object[2]),
        select(0u, bitcast<u32>(1.0f), is_point),
    );
}

fn light_world(row: u32) -> Float64 {
    let pair = bundle.views[seat].light_world[row / 2u];
    return float64(select(pair.xy, pair.zw, (row & 1u) == 1u));
}

fn largest_exponent(vector: array<Float64, 3>) -> i32 {
    var numbers = vector;
    var largest = -0x7fffffff;
    for (var row = 0u; row < 3u; row++) {
        if !is_zero(numbers[row]) {
            largest = max(largest, numbers[row].exponent);
        }
    }
    return largest;
}

// Light clip space from the caster's scaled object space; each entry is rounded to f32 once.
fn clip_from_scaled(id: u32) -> mat4x4f {
    var matrix: mat4x4f;
    for (var column = 0u; column < 4u; column++) {
        for (var row = 0u; row < 4u; row++) {
            var entry = FLOAT64_ZERO;
            for (var k = 0u; k < 4u; k++) {
                var factor = FLOAT64_ONE;
                if k < 3u {
                    factor = float64(caster_places[id].world_from_scaled[3u * column + k]);
                } else if column < 3u {
                    factor = FLOAT64_ZERO;
                }
                entry = sum(entry, product(clip_from_world(k, row), factor));
            }
            matrix[column][row] = bitcast<f32>(float32_bits(entry));
        }
    }
    return matrix;
}

fn clip_from_world(column: u32, row: u32) -> Float64 {
    let pair = bundle.views[seat].light_clip_from_world[2u * column + row / 2u];
    return float64(select(pair.xy, pair.zw, (row & 1u) == 1u));
}

fn is_finite(numbers: vec4u) -> bool {
    return all((numbers & vec4u(FLOAT32_INFINITY)) != vec4u(FLOAT32_INFINITY));
}

// Devices may flush numbers below 2^-126; 16 bits of an image above that are enough.
const LEAST_IMAGE = 0x1p-110f;

// Whether f32 holds the clip space: it is finite, and its image is not all but zero.
fn has_image(matrix: mat4x4f) -> bool {
    let columns = array(matrix[0], matrix[1], matrix[2], matrix[3]);
    var is_held = true;
    var largest = 0.0;
    for (var column = 0u; column < 4u; column++) {
        is_held &= is_finite(bitcast<vec4u>(columns[column]));
        if column < 3u {
            largest = max(largest, max(abs(columns[column].x), abs(columns[column].y)));
        }
    }
    return is_held && largest >= LEAST_IMAGE;
}

// Room for rounding of the depth, in NDC.
const DEPTH_GUARD_NDC = 1e-5;

// Conservative: a box near the frustum's edge counts as seen, and so does one that nothing is known of. What is beyond a
// plane is linear in clip space, so that the box's corners decide for all of it, also behind the light.
fn may_be_seen(id: u32, matrix: mat4x4f) -> bool {
    if (bundle.views[seat].flags & VIEW_CULLS) == 0u || caster_places[id].casts != CASTER_IN_VIEW {
        return true;
    }
    let side = 1.0 + bundle.views[seat].reach_ndc;
    let has_front = (bundle.views[seat].flags & VIEW_PANCAKES) == 0u;
    return !(is_beyond(id, matrix, vec4f(1.0, 0.0, 0.0, side))
        || is_beyond(id, matrix, vec4f(-1.0, 0.0, 0.0, side))
        || is_beyond(id, matrix, vec4f(0.0, 1.0, 0.0, side))
        || is_beyond(id, matrix, vec4f(0.0, -1.0, 0.0, side))
        || (has_front && is_beyond(id, matrix, vec4f(0.0, 0.0, 1.0, DEPTH_GUARD_NDC)))
        || is_beyond(id, matrix, vec4f(0.0, 0.0, -1.0, 1.0 + DEPTH_GUARD_NDC)));
}

// What rounding can do, relative to the sum of the terms' magnitudes: some ten operations of 2^-23 each.
const ROUNDING = 2e-6;

// Whether all of the box has a negative distance to a plane of clip space, rounding aside. NaN is not beyond.
fn is_beyond(id: u32, matrix: mat4x4f, plane: vec4f) -> bool {
    let middle = vec4f(caster_places[id].box_middle, 1.0);
    let half_size = vec4f(caster_places[id].box_half, 0.0);
    let normal = plane * matrix;
    let farthest = dot(normal, middle) + dot(abs(normal), half_size);
    let sizes = mat4x4f(abs(matrix[0]), abs(matrix[1]), abs(matrix[2]), abs(matrix[3]));
    return farthest < -ROUNDING * dot(abs(plane) * sizes, abs(middle) + half_size);
}
