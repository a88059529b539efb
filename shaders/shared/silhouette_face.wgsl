// What is drawn of a face that has outline edges: a triangle that holds all that is as near to one of them as distances are
// drawn, and the nearest of them in each texel.
// Valient & Bujnak 2005, equation 2.

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

// Whether a face that the light sees at this sine is lit: not where it sees it edge-on, up to the roundings of what holds the
// face. Faces that are in one plane with the light must be alike, since the edges between them are asked by nobody.
fn is_lit_at(sine: f32) -> bool {
    return sine > EDGE_ON;
}

// The corner of a face that is opposite to its longest side, and the ways from there to the next corner and to the last.
struct WidestCorner {
    index: u32,
    to_next: vec3f,
    to_last: vec3f,
}

// Of slivers the normal follows from the sides there: none of the two is much longer than what is between them.
fn widest_corner(a: vec3f, b: vec3f, c: vec3f) -> WidestCorner {
    let ab = b - a;
    let bc = c - b;
    let ca = a - c;
    let squares = vec3f(dot(bc, bc), dot(ca, ca), dot(ab, ab));
    if squares.x >= max(squares.y, squares.z) {
        return WidestCorner(0u, ab, -ca);
    }
    if squares.y >= squares.z {
        return WidestCorner(1u, bc, -ab);
    }
    return WidestCorner(2u, ca, -bc);
}

// The outline edges among the three of a face.
struct FaceOutline {
    images: array<OutlineImage, 3>,
    // Bits of those that there are.
    outlines: u32,
}

// Adds an edge, from the lower to the higher of its ends, so that both faces at it round alike; not where it is out of view
// or the light sees it end-on.
fn add_edge(
    face: ptr<function, FaceOutline>,
    edge: u32,
    clip_from_object: mat4x4f,
    low: vec3f,
    high: vec3f,
    blocker_left: bool,
) {
    let direction = image_direction(clip_from_object, low, high);
    if all(direction == vec2f(0.0)) {
        return;
    }
    let image = edge_image(clip_from_object, low, high);
    if !is_in_view(image) {
        return;
    }
    let outward = select(counter_clockwise(direction), clockwise(direction), blocker_left);
    let q = vec2f(image.low.q, image.high.q);
    (*face).images[edge] = OutlineImage(image.low.ndc, image.high.ndc, outward, q);
    (*face).outlines |= 1u << edge;
}

// A corner of the triangle around a face of these corners; nowhere where it has no outline edge.
fn silhouette_vertex(
    face: FaceOutline,
    clip_from_object: mat4x4f,
    corners: array<vec3f, 3>,
    corner: u32,
) -> SilhouetteVertex {
    if face.outlines == 0u {
        return nowhere_drawn();
    }
    let images = face.images;
    let reach = reach_of(face) * texels_per_ndc() + SLACK_TEXELS;
    var ndc = around_edges(face, reach / texels_per_ndc(), corner);
    let a = clip_from_object * vec4f(corners[0], 1.0);
    let b = clip_from_object * vec4f(corners[1], 1.0);
    let c = clip_from_object * vec4f(corners[2], 1.0);
    if is_in_front(a) && is_in_front(b) && is_in_front(c) {
        let scaled = scaled_face(array<vec2f, 3>(texels_of_clip(a), texels_of_clip(b), texels_of_clip(c)), reach);
        let farthest = max(max(abs(scaled[0]), abs(scaled[1])), abs(scaled[2])) / texels_per_ndc();
        if max(farthest.x, farthest.y) <= FARTHEST_NDC {
            ndc = scaled[corner] / texels_per_ndc();
        }
    }
    return SilhouetteVertex(
        drawn_at(ndc),
        face.outlines,
        vec4f(images[0].low_ndc, images[0].high_ndc),
        vec4f(images[1].low_ndc, images[1].high_ndc),
        vec4f(images[2].low_ndc, images[2].high_ndc),
        vec4f(images[0].outward, images[0].q),
        vec4f(images[1].outward, images[1].q),
        vec4f(images[2].outward, images[2].q),
    );
}

fn nowhere_drawn() -> SilhouetteVertex {
    var vertex: SilhouetteVertex;
    vertex.clip = NOWHERE;
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

fn is_in_front(clip: vec4f) -> bool {
    return depth_of_clip(clip) >= least_depth();
}

// From the middle of the map.
fn texels_of_clip(clip: vec4f) -> vec2f {
    return clip.xy / clip.w * texels_per_ndc();
}

// The widest band of the outline edges, in NDC.
fn reach_of(face: FaceOutline) -> f32 {
    var reach = 0.0;
    for (var i = 0u; i < 3u; i++) {
        if (face.outlines >> i & 1u) != 0u {
            let edge = face.images[i];
            reach = max(reach, widest_band(edge.q.x, edge.low_ndc));
            reach = max(reach, widest_band(edge.q.y, edge.high_ndc));
        }
    }
    return reach;
}

// The corner of a triangle around the box around the outline edges.
fn around_edges(face: FaceOutline, reach: f32, corner: u32) -> vec2f {
    var low = vec2f(FARTHEST_NDC);
    var high = vec2f(-FARTHEST_NDC);
    for (var i = 0u; i < 3u; i++) {
        if (face.outlines >> i & 1u) != 0u {
            low = min(low, min(face.images[i].low_ndc, face.images[i].high_ndc));
            high = max(high, max(face.images[i].low_ndc, face.images[i].high_ndc));
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
