// The point of a silhouette that is nearest to a texel, and what a silhouette map keeps of it.
// Valient & Bujnak 2005: signed distance, positive on the blocker's side, and depth.

// An outline edge on the image plane.
struct OutlineImage {
    low_ndc: vec2f,
    high_ndc: vec2f,
    // Unit normal away from the blocker.
    outward: vec2f,
    q: vec2f,
}

struct SilhouettePoint {
    // In texels, positive on the blocker's side.
    signed_distance: f32,
    // The least one wins.
    order: f32,
    ndc: vec2f,
    outward: vec2f,
    q: f32,
    // Whether distances are drawn so far from it.
    is_in_band: bool,
}

struct SilhouetteTexel {
    // Nobody reads it: the nearest wins by it.
    @builtin(frag_depth) order: f32,
    // Depth of the nearest point and signed distance to it.
    @location(0) depth_and_distance: vec2f,
}

// Edges that meet in the nearest point are as far as each other, but for rounding. The side is told by the one that is
// seen more squarely: beyond the end of the other one its line says nothing. So an edge that is seen at a slant is taken
// to be this much farther, in texels.
const SLANT_PENALTY = 1e-3;

// A silhouette point is hidden where what is drawn just outside of it is nearer to the light. So far outside, in texels,
// the nearest texel's middle is outside too.
const JUST_OUTSIDE_TEXELS = 1.0;

fn nearest_point(place_ndc: vec2f, edge: OutlineImage) -> SilhouettePoint {
    let along = edge.high_ndc - edge.low_ndc;
    let length_squared = dot(along, along);
    var share = 0.0;
    if length_squared > 0.0 {
        share = saturate(dot(place_ndc - edge.low_ndc, along) / length_squared);
    }
    let ndc = edge.low_ndc + share * along;
    let offset = (place_ndc - ndc) * texels_per_ndc();
    let distance = length(offset);
    let across = dot(offset, edge.outward);
    let slant = select(0.0, 1.0 - abs(across) / distance, distance > 0.0);
    let q = mix(edge.q.x, edge.q.y, share);
    // As far as the soft edge reaches of a line across the way there, of which the edge is one but for its ends.
    let across_way = select(edge.outward, offset / distance, distance > 0.0);
    let width = smoothie_width(q) * widening(leaning(ndc), across_way);
    return SilhouettePoint(
        select(distance, -distance, across > 0.0),
        distance + SLANT_PENALTY * slant,
        ndc,
        edge.outward,
        q,
        distance <= width * texels_per_ndc(),
    );
}

fn texels_per_ndc() -> f32 {
    return 0.5 * f32(view.map_size);
}

// How far from there distances are drawn at most, in NDC.
fn widest_band(q: f32, ndc: vec2f) -> f32 {
    return smoothie_width(q) * widest_widening(leaning(ndc));
}

// Whether distances are drawn so far from it, and the light reaches it.
fn is_drawn(point: SilhouettePoint) -> bool {
    return point.is_in_band && is_unhidden(point);
}

fn is_unhidden(point: SilhouettePoint) -> bool {
    let outside = texel_inside(just_outside(point.ndc, point.outward));
    let nearest = textureLoad(shadow_depth, outside, 0).x * view.depth_unit;
    let depth = depth_of_q(point.q);
    return depth <= nearest + view.bias_smoothie_texels * texel_footprint(depth);
}

fn just_outside(ndc: vec2f, outward: vec2f) -> vec2f {
    return texel_of(ndc) + vec2f(outward.x, -outward.y) * JUST_OUTSIDE_TEXELS;
}

// The texel of the map at a place, or nearest to it.
fn texel_inside(place: vec2f) -> vec2u {
    return vec2u(clamp(floor(place), vec2f(0.0), vec2f(f32(view.map_size) - 1.0)));
}

// From 0 at the silhouette up to 1 far away.
fn order_as_depth(point: SilhouettePoint) -> f32 {
    return point.order / (1.0 + point.order);
}

fn depth_to_keep(point: SilhouettePoint) -> f32 {
    return depth_of_q(point.q) / view.depth_unit;
}

// NDC of a fragment, and the other way round: y points down in a texture.
fn ndc_of(texel: vec2f) -> vec2f {
    return (texel / f32(view.map_size) - 0.5) * vec2f(2.0, -2.0);
}

fn texel_of(ndc: vec2f) -> vec2f {
    return (ndc * vec2f(0.5, -0.5) + 0.5) * f32(view.map_size);
}

fn drawn_at(ndc: vec2f) -> vec4f {
    return vec4f(ndc, 0.5, 1.0);
}
