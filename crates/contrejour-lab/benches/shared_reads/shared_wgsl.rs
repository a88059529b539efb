//! Both stages for several lights in one read: a byte for each face, a bit of it for each light.
//!
//! `caster_lights`, `recheck_words`, `silhouettes` and `outline_sides` hold one light's behind the other's, `counters` one
//! for each. What is done light by light is written out, since no driver is sure to unroll loops.

use std::fmt::Write;

/// The text for each light, with its number for `#`.
fn for_lights(lights: usize, text: &str) -> String {
    (0..lights).fold(String::new(), |mut all, light| {
        writeln!(all, "{}", text.replace('#', &light.to_string())).expect("strings take text");
        all
    })
}

/// A stage's text with all but its first and last part replaced; its parts begin with `from` and with `to`.
fn replaced(stage: &str, from: &str, to: &str, part: &str) -> String {
    let (head, rest) = stage.split_once(from).expect("the stage has an entry point");
    let (_, tail) = rest.split_once(to).expect("the stage has functions");
    format!("{head}{part}{to}{tail}")
}

const COUNTERS: [&str; 2] = ["counters: AtomicCounters;", "counters: array<AtomicCounters, LIGHTS>;"];

pub fn classify_faces(stage: &str, lights: usize) -> String {
    let head = format!(
        "
const LIGHTS = {lights}u;

@compute @workgroup_size(64)
fn classify_faces(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {{
    let index = folded_invocation(group, groups, lane);
    let item_id = index / LIT_WORDS_PER_BLOCK;
    if item_id >= atomicLoad(&counters[0].face_items) {{
        return;
    }}
    let item = face_items[item_id];
    let caster = casters[item.caster];
    let word = item.block * LIT_WORDS_PER_BLOCK + index % LIT_WORDS_PER_BLOCK;
    let first_face_id = word * FACES_PER_WORD;
    let face_count = min(max(caster.face_count, first_face_id) - first_face_id, FACES_PER_WORD);
    let caster_count = arrayLength(&caster_lights) / LIGHTS;
    let list_size = arrayLength(&recheck_words) / LIGHTS;
    let all_faces = select(0u, 0xffffffffu >> (FACES_PER_WORD - face_count), face_count > 0u);
    let may_use_planes = item.kind == BLOCK_BY_PLANES;
"
    );
    let before = "
    let caster_light_# = caster_lights[#u * caster_count + item.caster];
    let by_planes_# = may_use_planes && is_in_range(caster_light_#.light_object);
    let light_# = scaled_light(caster_light_#);
    let decided_# = select(0u, all_faces, by_planes_# && caster_light_#.casts != 0u);
    var undecided_# = select(0u, all_faces, !by_planes_# && caster_light_#.casts != 0u);";
    let inside = "
        verdict = classify_by_plane(plane, light_#);
        byte |= select(0u, 1u << #u, (verdict.x & (decided_# >> i & 1u)) == 1u);
        undecided_# |= (verdict.y & (decided_# >> i & 1u)) << i;";
    let after = "
    if undecided_# != 0u {
        let slot = atomicAdd(&counters[#].recheck_words, 1u);
        recheck_words[#u * list_size + slot] = RecheckWord(item.caster, word, undecided_#);
    }";
    let body = format!(
        "{head}{}
    var bytes = 0u;
    for (var i = 0u; i < face_count; i++) {{
        let plane = planes[caster.first_face + first_face_id + i];
        var byte = 0u;
        var verdict: vec2u;{}
        bytes |= byte << (i % 4u * 8u);
        if i % 4u == 3u || i + 1u == face_count {{
            lit[(caster.first_lit_word + word) * 8u + i / 4u] = bytes;
            bytes = 0u;
        }}
    }}
{}}}

fn classify_by_plane(plane: vec4f, light: vec4f) -> vec2u {{
    let terms = plane * light;
    let sizes = abs(terms);
    let determinant = terms.x + terms.y + terms.z + terms.w;
    let bound = ROUNDING * (sizes.x + sizes.y + sizes.z + sizes.w);
    return vec2u(u32(determinant > bound), u32(determinant > -bound && !(determinant > bound)));
}}

const ROUNDING = 0x1p-20;

",
        for_lights(lights, before),
        for_lights(lights, inside),
        for_lights(lights, after),
    );
    let end = "// The light's largest component";
    replaced(&stage.replace(COUNTERS[0], COUNTERS[1]), "// A bit for each face.", end, &body)
}

pub fn detect_silhouette(stage: &str, lights: usize) -> String {
    let body = format!(
        "
const LIGHTS = {lights}u;
const ALL_LIGHTS = (1u << LIGHTS) - 1u;

alias Sides = vec2u;

var<workgroup> group_sides: array<atomic<u32>, OUTLINE_WORDS_PER_BLOCK * LIGHTS>;
var<workgroup> append_counts: array<atomic<u32>, LIGHTS>;
var<workgroup> append_bases: array<u32, LIGHTS>;

@compute @workgroup_size(64)
fn detect_silhouette(
    @builtin(workgroup_id) group: vec3u,
    @builtin(num_workgroups) groups: vec3u,
    @builtin(local_invocation_index) lane: u32,
) {{
    let item_id = folded_group(group, groups);
    let in_range = item_id < atomicLoad(&counters[0].edge_items);
    let item = edge_items[select(0u, item_id, in_range)];
    let caster = casters[item.caster];
    let edge_id = item.block * BLOCK_SIZE + lane;
    // Bits of lights: the edge is in the silhouette, its faces are on the left alone, on the right alone.
    var found = vec3u(0u);
    var edge: Edge;
    if in_range && edge_id < caster.edge_count {{
        edge = edges[caster.first_edge + edge_id];
        found = find(caster, edge);
    }}
    var ranks: array<u32, LIGHTS>;
    if found.x != 0u {{{}
    }}
    if (found.y | found.z) != 0u {{{}
    }}
    workgroupBarrier();
    if lane < LIGHTS {{
        append_bases[lane] = atomicAdd(&counters[lane].silhouette_edges, atomicLoad(&append_counts[lane]));
    }}
    workgroupBarrier();
    if found.x != 0u {{{}
    }}
    let words = arrayLength(&outline_sides) / LIGHTS;
    if in_range && lane < OUTLINE_WORDS_PER_BLOCK * LIGHTS {{
        let word = caster.first_outline_word + item.block * OUTLINE_WORDS_PER_BLOCK + lane % OUTLINE_WORDS_PER_BLOCK;
        outline_sides[lane / OUTLINE_WORDS_PER_BLOCK * words + word] = atomicLoad(&group_sides[lane]);
    }}
}}

fn append(light: u32, rank: u32, caster: u32, edge_id: u32, sides: Sides) {{
    let slot = append_bases[light] + rank;
    if slot < view.silhouette_capacity {{
        silhouettes[light * view.silhouette_capacity + slot] = SilhouetteEdge(caster, edge_id, sides.x, sides.y);
    }}
}}

fn find(caster: Caster, edge: Edge) -> vec3u {{
    var left = 0u;
    var right = 0u;
    var unequal = 0u;
    if edge.first != INCIDENCE_LIST {{
        // Of two faces there are as many on both sides where there is one on each.
        let first = sides_of(caster, edge.first);
        let second = sides_of(caster, edge.second);
        left = first.x | second.x;
        right = first.y | second.y;
        unequal = left ^ right;
    }} else {{
        for (var light = 0u; light < LIGHTS; light++) {{
            let sides = count_sides(caster, edge, light);
            left |= select(0u, 1u << light, sides.x > 0u);
            right |= select(0u, 1u << light, sides.y > 0u);
            unequal |= select(0u, 1u << light, sides.x != sides.y);
        }}
    }}
    return vec3u(unequal, left & ~right, right & ~left);
}}

fn count_sides(caster: Caster, edge: Edge, light: u32) -> Sides {{
    if edge.first != INCIDENCE_LIST {{
        return side_of(caster, edge.first, light) + side_of(caster, edge.second, light);
    }}
    let list = caster.first_incidence + edge.second;
    let count = incidences[list];
    var sides = Sides(0u);
    for (var i = 1u; i <= count; i++) {{
        sides += side_of(caster, incidences[list + i], light);
    }}
    return sides;
}}

fn side_of(caster: Caster, incidence: u32, light: u32) -> Sides {{
    return sides_of(caster, incidence) >> vec2u(light) & vec2u(1u);
}}

// Bits of the lights that see a face on the left, and on the right.
fn sides_of(caster: Caster, incidence: u32) -> Sides {{
    if incidence == INCIDENCE_NONE {{
        return Sides(0u);
    }}
    let along = select(0u, ALL_LIGHTS, (incidence & 1u) == 1u);
    let left = ~(lit_byte(caster, incidence >> 1u) ^ along) & ALL_LIGHTS;
    return Sides(left, left ^ ALL_LIGHTS);
}}

fn lit_byte(caster: Caster, face: u32) -> u32 {{
    if face == UNLIT_FACE {{
        return 0u;
    }}
    return lit[caster.first_lit_word * 8u + face / 4u] >> (face % 4u * 8u) & 0xffu;
}}

",
        for_lights(
            lights,
            "
        if (found.x & (1u << #u)) != 0u {
            ranks[#] = atomicAdd(&append_counts[#], 1u);
        }"
        ),
        for_lights(
            lights,
            "
        atomicOr(&group_sides[OUTLINE_WORDS_PER_BLOCK * #u + lane / 16u],
            (found.y >> #u & 1u | (found.z >> #u & 1u) << 1u) << (lane % 16u * 2u));"
        ),
        for_lights(
            lights,
            "
        if (found.x & (1u << #u)) != 0u {
            append(#u, ranks[#], item.caster, edge_id, count_sides(caster, edge, #u));
        }"
        ),
    );
    let end = "fn outline_side(";
    replaced(&stage.replace(COUNTERS[0], COUNTERS[1]), "var<workgroup> group_sides", end, &body)
}
