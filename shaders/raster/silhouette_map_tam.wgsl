// Fills the silhouette map of a light view as topology-aware meshes do it: the vertex stage asks each face and its
// neighbours for outline edges, and draws a face that has some larger.
// One vertex invocation = one corner of one face of one work item.
// Reads face_items, casters, caster_lights, faces, face_neighbours, edge_fans, positions, and the linear depth of the shadow map.
// Valient & Bujnak 2005, equations 1 and 2.

@group(0) @binding(0) var<uniform> view: LightView;
@group(0) @binding(1) var<storage, read> face_items: array<WorkItem>;
@group(0) @binding(2) var<storage, read> casters: array<Caster>;
@group(0) @binding(3) var<storage, read> caster_lights: array<CasterLight>;
@group(0) @binding(4) var<storage, read> faces: array<Face>;
@group(0) @binding(5) var<storage, read> face_neighbours: array<FaceNeighbours>;
@group(0) @binding(6) var<storage, read> edge_fans: array<u32>;
@group(0) @binding(7) var<storage, read> positions: array<u32>;
@group(1) @binding(0) var shadow_depth: texture_2d<f32>;

struct SilhouetteVertex {
    @builtin(position) clip: vec4f,
    // Bits of the edges of the face that are outline edges in view.
    @location(0) @interpolate(flat) outlines: u32,
    // Ends of each edge, its outward normal and the q of its ends.
    @location(1) @interpolate(flat) ends_ab: vec4f,
    @location(2) @interpolate(flat) ends_bc: vec4f,
    @location(3) @interpolate(flat) ends_ca: vec4f,
    @location(4) @interpolate(flat) outward_and_q_ab: vec4f,
    @location(5) @interpolate(flat) outward_and_q_bc: vec4f,
    @location(6) @interpolate(flat) outward_and_q_ca: vec4f,
}

// A face with less room inside, in texels, is widened before it is scaled: half the diagonal of a texel.
const LEAST_INRADIUS = 0.70710677;
// A triangle as wide and as high as this many times an inradius has at least that inradius.
const WIDENING = 4.0;
// Rasterisers and incircles round: so much more is drawn, in texels.
const SLACK_TEXELS = 0.05;
// A triangle that reaches farther, in NDC, is drawn as the box around its outline edges.
const FARTHEST_NDC = 16.0;

@vertex
fn vertex_silhouette_face(@builtin(vertex_index) index: u32) -> SilhouetteVertex {
    var vertex: SilhouetteVertex;
    vertex.clip = NOWHERE;
    let item = face_items[index / (3u * BLOCK_SIZE)];
    let caster = casters[item.caster];
    let face_id = item.block * BLOCK_SIZE + index / 3u % BLOCK_SIZE;
    if face_id >= caster.face_count {
        return vertex;
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
    let clips = array<vec4f, 3>(
        clip_from_object * vec4f(corners[0], 1.0),
        clip_from_object * vec4f(corners[1], 1.0),
        clip_from_object * vec4f(corners[2], 1.0),
    );

    // Ask each edge; of the two faces at an outline edge the lit one draws it.
    let is_lit = faces_light(caster, clip_from_object, ids);
    var images: array<OutlineImage, 3>;
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
        if !is_outline {
            continue;
        }
        // From the lower to the higher id, as edges run, so that both sides of it round alike.
        let low = select(corners[j], corners[i], runs_up);
        let high = select(corners[i], corners[j], runs_up);
        let direction = image_direction(clip_from_object, low, high);
        if all(direction == vec2f(0.0)) {
            continue;
        }
        let image = edge_image(clip_from_object, low, high);
        if !is_in_view(image) {
            continue;
        }
        let outward = select(counter_clockwise(direction), clockwise(direction), blocker_left);
        images[i] = OutlineImage(image.low.ndc, image.high.ndc, outward, vec2f(image.low.q, image.high.q));
        vertex.outlines |= 1u << i;
    }
    if vertex.outlines == 0u {
        return vertex;
    }
    vertex.ends_ab = vec4f(images[0].low_ndc, images[0].high_ndc);
    vertex.ends_bc = vec4f(images[1].low_ndc, images[1].high_ndc);
    vertex.ends_ca = vec4f(images[2].low_ndc, images[2].high_ndc);
    vertex.outward_and_q_ab = vec4f(images[0].outward, images[0].q);
    vertex.outward_and_q_bc = vec4f(images[1].outward, images[1].q);
    vertex.outward_and_q_ca = vec4f(images[2].outward, images[2].q);

    // Draw a triangle that holds all that is as near to one of its outline edges as distances are drawn.
    let reach = reach_of(images, vertex.outlines) * texels_per_ndc() + SLACK_TEXELS;
    let corner = index % 3u;
    var ndc = around_edges(images, vertex.outlines, reach / texels_per_ndc(), corner);
    if is_in_front(clips[0]) && is_in_front(clips[1]) && is_in_front(clips[2]) {
        let texels = array<vec2f, 3>(ndc_of_clip(clips[0]), ndc_of_clip(clips[1]), ndc_of_clip(clips[2]));
        let scaled = scaled_face(texels, reach);
        let farthest = max(max(abs(scaled[0]), abs(scaled[1])), abs(scaled[2])) / texels_per_ndc();
        if max(farthest.x, farthest.y) <= FARTHEST_NDC {
            ndc = scaled[corner] / texels_per_ndc();
        }
    }
    vertex.clip = drawn_at(ndc);
    return vertex;
}

@fragment
fn fragment_silhouette_face(vertex: SilhouetteVertex) -> SilhouetteTexel {
    var point: SilhouettePoint;
    if !nearest_of_face(vertex, &point) {
        discard;
    }
    return SilhouetteTexel(order_as_depth(point), vec2f(depth_to_keep(point), point.signed_distance));
}

@fragment
fn fragment_blended_silhouette_face(vertex: SilhouetteVertex) -> @location(0) vec2f {
    var point: SilhouettePoint;
    if !nearest_of_face(vertex, &point) {
        discard;
    }
    return vec2f(depth_to_keep(point), abs(point.signed_distance));
}

// Finds the nearest point of the outline edges; false where none is drawn.
fn nearest_of_face(vertex: SilhouetteVertex, nearest: ptr<function, SilhouettePoint>) -> bool {
    let ends = array<vec4f, 3>(vertex.ends_ab, vertex.ends_bc, vertex.ends_ca);
    let outwards = array<vec4f, 3>(vertex.outward_and_q_ab, vertex.outward_and_q_bc, vertex.outward_and_q_ca);
    let place = ndc_of(vertex.clip.xy);
    var is_any_drawn = false;
    for (var i = 0u; i < 3u; i++) {
        if (vertex.outlines >> i & 1u) == 0u {
            continue;
        }
        let edge = OutlineImage(ends[i].xy, ends[i].zw, outwards[i].xy, outwards[i].zw);
        let point = nearest_point(place, edge);
        if (!is_any_drawn || point.order < (*nearest).order) && is_drawn(point) {
            *nearest = point;
            is_any_drawn = true;
        }
    }
    return is_any_drawn;
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
    let corner = near_one(clip_from_object * vec4f(scaled_position(caster, least), 1.0));
    let to_b = near_one(clip_from_object * vec4f(b - a, 0.0));
    let to_c = near_one(clip_from_object * vec4f(c - a, 0.0));
    let area = determinant(mat3x3f(corner, to_b, to_c));
    return select(-area, area, keeps_winding) > 0.0;
}

fn near_one(clip: vec4f) -> vec3f {
    return clip.xyw * reciprocal_power(max(max(abs(clip.x), abs(clip.y)), abs(clip.w)));
}

fn is_in_front(clip: vec4f) -> bool {
    return depth_of_clip(clip) >= least_depth();
}

// In texels from the middle.
fn ndc_of_clip(clip: vec4f) -> vec2f {
    return clip.xy / clip.w * texels_per_ndc();
}

// The widest band of the outline edges, in NDC.
fn reach_of(images: array<OutlineImage, 3>, outlines: u32) -> f32 {
    var reach = 0.0;
    for (var i = 0u; i < 3u; i++) {
        if (outlines >> i & 1u) != 0u {
            let edge = images[i];
            reach = max(reach, widest_band(edge.q.x, edge.low_ndc));
            reach = max(reach, widest_band(edge.q.y, edge.high_ndc));
        }
    }
    return reach;
}

// The corner of a triangle around the box around the outline edges.
fn around_edges(images: array<OutlineImage, 3>, outlines: u32, reach: f32, corner: u32) -> vec2f {
    var low = vec2f(FARTHEST_NDC);
    var high = vec2f(-FARTHEST_NDC);
    for (var i = 0u; i < 3u; i++) {
        if (outlines >> i & 1u) != 0u {
            low = min(low, min(images[i].low_ndc, images[i].high_ndc));
            high = max(high, max(images[i].low_ndc, images[i].high_ndc));
        }
    }
    let size = high - low + 2.0 * reach;
    return low - reach + 2.0 * size * vec2f(select(0.0, 1.0, corner == 1u), select(0.0, 1.0, corner == 2u));
}

// A face, scaled about its incentre so that each edge moves outwards by `reach`: by f = (w_o + w_sc) / w_o, where w_o is the
// inradius and w_sc the reach (equation 2). It holds all that is as near to the face.
fn scaled_face(face: array<vec2f, 3>, reach: f32) -> array<vec2f, 3> {
    var corners = face;
    var sides = sides_of(corners);
    var inradius = inradius_of(corners, sides);
    if !(inradius >= LEAST_INRADIUS) {
        corners = widened(corners, sides);
        sides = sides_of(corners);
        inradius = inradius_of(corners, sides);
    }
    let incentre = (sides.x * corners[0] + sides.y * corners[1] + sides.z * corners[2]) / (sides.x + sides.y + sides.z);
    let scale = (inradius + reach) / inradius;
    return array<vec2f, 3>(
        incentre + scale * (corners[0] - incentre),
        incentre + scale * (corners[1] - incentre),
        incentre + scale * (corners[2] - incentre),
    );
}

// The lengths of the sides opposite to each corner.
fn sides_of(corners: array<vec2f, 3>) -> vec3f {
    return vec3f(
        distance(corners[1], corners[2]),
        distance(corners[2], corners[0]),
        distance(corners[0], corners[1]),
    );
}

fn inradius_of(corners: array<vec2f, 3>, sides: vec3f) -> f32 {
    return abs(cross_2d(corners[1] - corners[0], corners[2] - corners[0])) / (sides.x + sides.y + sides.z);
}

// A face around a flat one: its longest side grows where it is short, and the corner opposite moves away from it.
fn widened(corners: array<vec2f, 3>, sides: vec3f) -> array<vec2f, 3> {
    var top = 2u;
    if sides.x >= sides.y && sides.x >= sides.z {
        top = 0u;
    } else if sides.y >= sides.z {
        top = 1u;
    }
    let begin = corners[(top + 1u) % 3u];
    let end = corners[(top + 2u) % 3u];
    let longest = sides[top];
    var along = vec2f(1.0, 0.0);
    if longest > 0.0 {
        along = (end - begin) / longest;
    }
    let middle = 0.5 * (begin + end);
    let height = cross_2d(along, corners[top] - middle);
    let up = select(counter_clockwise(along), clockwise(along), height < 0.0);
    let least = WIDENING * LEAST_INRADIUS;
    let half = 0.5 * max(longest, least);
    let foot = middle + dot(corners[top] - middle, along) * along;
    return array<vec2f, 3>(foot + max(abs(height), least) * up, middle - half * along, middle + half * along);
}
