// Fills the silhouette map of a light view as topology-aware meshes do it: the vertex stage asks each face and its
// neighbours for outline edges, and draws a face that has some larger.
// One vertex invocation = one corner of one face of one work item.
// Reads face_items, casters, caster_lights, faces, face_neighbours, edge_fans, positions, and the linear depth of the shadow map.
// Valient & Bujnak 2005, equation 1.

@group(0) @binding(0) var<uniform> view: LightView;
@group(0) @binding(1) var<storage, read> face_items: array<WorkItem>;
@group(0) @binding(2) var<storage, read> casters: array<Caster>;
@group(0) @binding(3) var<storage, read> caster_lights: array<CasterLight>;
@group(0) @binding(4) var<storage, read> faces: array<Face>;
@group(0) @binding(5) var<storage, read> face_neighbours: array<FaceNeighbours>;
@group(0) @binding(6) var<storage, read> edge_fans: array<u32>;
@group(0) @binding(7) var<storage, read> positions: array<u32>;
@group(1) @binding(0) var shadow_depth: texture_2d<f32>;

// A smaller sine is rounding.
const EDGE_ON = 1e-6;

@vertex
fn vertex_silhouette_face(@builtin(vertex_index) index: u32) -> SilhouetteVertex {
    let item = face_items[index / (3u * BLOCK_SIZE)];
    let caster = casters[item.caster];
    let face_id = item.block * BLOCK_SIZE + index / 3u % BLOCK_SIZE;
    if face_id >= caster.face_count {
        return nowhere_drawn();
    }
    let face = faces[caster.first_face + face_id];
    let neighbours = face_neighbours[caster.first_face + face_id];
    let ids = array<u32, 3>(face.a, face.b, face.c);
    let across = array<u32, 3>(neighbours.across_ab, neighbours.across_bc, neighbours.across_ca);
    let clip_from_object = caster_lights[item.caster].light_clip_from_object;
    let corners = array<vec3f, 3>(
        scaled_position(caster, face.a),
        scaled_position(caster, face.b),
        scaled_position(caster, face.c),
    );

    // Ask each edge; of the two faces at an outline edge the lit one draws it.
    let is_lit = faces_light(caster, clip_from_object, ids);
    var outline: FaceOutline;
    for (var i = 0u; i < 3u; i++) {
        let j = (i + 1u) % 3u;
        let runs_up = ids[i] < ids[j];
        var is_outline = across[i] == ACROSS_NOTHING;
        var blocker_left = is_lit == runs_up;
        if (across[i] & (ACROSS_ALONG | ACROSS_ALONE)) == ACROSS_FAN {
            let ends = vec2u(min(ids[i], ids[j]), max(ids[i], ids[j]));
            let sides = sides_of_fan(caster, clip_from_object, ends, across[i] & ~ACROSS_FAN);
            is_outline = sides.x == 0u || sides.y == 0u;
            blocker_left = sides.y == 0u;
        } else if across[i] < ACROSS_NEVER && (is_lit || (across[i] & ACROSS_ALONE) != 0u) {
            let is_along = (across[i] & ACROSS_ALONG) != 0u;
            let first = select(ids[j], ids[i], is_along);
            let second = select(ids[i], ids[j], is_along);
            let face_across = array<u32, 3>(first, second, across[i] & ~(ACROSS_ALONG | ACROSS_ALONE));
            is_outline = (is_lit == faces_light(caster, clip_from_object, face_across)) == is_along;
        }
        if is_outline {
            // From the lower to the higher id, as edges run.
            let low = select(corners[j], corners[i], runs_up);
            let high = select(corners[i], corners[j], runs_up);
            add_edge(&outline, i, clip_from_object, low, high, blocker_left);
        }
    }
    return silhouette_vertex(outline, clip_from_object, corners, index % 3u);
}

// Faces on the left and on the right of an edge of several, as the stages count them: one is on the left where its sign and
// its way along the edge agree.
fn sides_of_fan(caster: Caster, clip_from_object: mat4x4f, ends: vec2u, offset: u32) -> vec2u {
    let fan = caster.first_incidence + offset;
    let count = edge_fans[fan];
    var left = 0u;
    for (var i = 1u; i <= count; i++) {
        let is_along = (edge_fans[fan + i] & ACROSS_ALONG) != 0u;
        let third = edge_fans[fan + i] & ~ACROSS_ALONG;
        let face = array<u32, 3>(select(ends.y, ends.x, is_along), select(ends.x, ends.y, is_along), third);
        let is_lit = third != FAN_UNLIT && faces_light(caster, clip_from_object, face);
        left += select(0u, 1u, is_lit == is_along);
    }
    return vec2u(left, count - left);
}

// Whether a face shows the light its front: whether its image runs counter-clockwise, also where it crosses the light's
// plane (equation 1, with normals that are made from the corners, so that they follow what deforms).
// By way of the sides, from positions as they are stored: they lose no digits where the face is small. In the order of the
// ids, so that a face and its neighbours get the same answer, whatever rounding makes of it.
fn faces_light(caster: Caster, clip_from_object: mat4x4f, ids: array<u32, 3>) -> bool {
    let least = min(min(ids[0], ids[1]), ids[2]);
    let most = max(max(ids[0], ids[1]), ids[2]);
    let middle = ids[0] ^ ids[1] ^ ids[2] ^ least ^ most;
    let keeps_winding = (ids[0] == least && ids[1] == middle) || (ids[1] == least && ids[2] == middle)
        || (ids[2] == least && ids[0] == middle);
    let a = scaled(position_bits(caster, least), caster.position_scale);
    let b = scaled(position_bits(caster, middle), caster.position_scale);
    let c = scaled(position_bits(caster, most), caster.position_scale);
    let widest = widest_corner(a, b, c);
    let id = select(select(most, middle, widest.index == 1u), least, widest.index == 0u);
    let corner = near_one(clip_from_object * vec4f(scaled_position(caster, id), 1.0));
    let to_next = near_one(clip_from_object * vec4f(widest.to_next, 0.0));
    let to_last = near_one(clip_from_object * vec4f(widest.to_last, 0.0));
    let area = determinant(mat3x3f(corner, to_next, to_last));
    return is_lit_at(select(-area, area, keeps_winding));
}

fn near_one(clip: vec4f) -> vec3f {
    return clip.xyw * reciprocal_power(max(max(abs(clip.x), abs(clip.y)), abs(clip.w)));
}
