// Fills the silhouette map of a light view: signed distance to the nearest outline edge that the light reaches, and its
// depth.
// One vertex invocation = one corner of a triangle of the strip along a quad's edge, as wide as distances are drawn, and
// longer by as much as no neighbour at its ends is nearer.
// Reads quads, casters, caster_lights, positions, outline_sides, vertex_edges, and the linear depth of the shadow map.
// Valient & Bujnak 2005, with edges that compute stages found.

@group(0) @binding(0) var<uniform> view: LightView;
@group(0) @binding(1) var<storage, read> quads: array<Quad>;
@group(0) @binding(2) var<storage, read> casters: array<Caster>;
@group(0) @binding(3) var<storage, read> caster_lights: array<CasterLight>;
@group(0) @binding(4) var<storage, read> positions: array<u32>;
@group(0) @binding(5) var<storage, read> outline_sides: array<u32>;
@group(0) @binding(6) var<storage, read> vertex_edges: array<u32>;
@group(1) @binding(0) var shadow_depth: texture_2d<f32>;

// Strips reach so much farther, in texels, for what rounding leaves between them.
const OVERLAP_TEXELS = 1.0;

// Edges that run through more texels along an axis are drawn without asking whether they are hidden.
const MOST_TEXELS_ASKED = 8u;

// What is asked of an edge and of its points may round so differently, in texels and of a depth.
const ROUNDING_TEXELS = 0.01;
const ROUNDING = 1e-5;

struct SilhouetteVertex {
    @builtin(position) clip: vec4f,
    @location(0) @interpolate(flat) ends_ndc: vec4f,
    @location(1) @interpolate(flat) outward: vec2f,
    @location(2) @interpolate(flat) q: vec2f,
}

@vertex
fn vertex_silhouette_quad(@builtin(vertex_index) index: u32) -> SilhouetteVertex {
    let quad = quads[index / VERTICES_PER_QUAD];
    if is_hidden(quad) {
        return SilhouetteVertex(NOWHERE, vec4f(0.0), vec2f(0.0), vec2f(0.0));
    }
    let corner = quad_corner(index);
    let width = max(widest_band(quad.q.x, quad.low_ndc), widest_band(quad.q.y, quad.high_ndc));
    // The outward side is right of the way from low to high, or left where the blocker is on the right.
    let along = select(clockwise(quad.outward), counter_clockwise(quad.outward), quad.side == OUTLINE_BLOCKER_LEFT);
    let onwards = select(-along, along, corner.is_high);
    let across = select(-quad.outward, quad.outward, corner.is_outer);
    let beyond = width * share_beyond(quad, corner.is_high, onwards, across) + OVERLAP_TEXELS / texels_per_ndc();
    let ndc = select(quad.low_ndc, quad.high_ndc, corner.is_high) + beyond * onwards + width * across;
    return SilhouetteVertex(drawn_at(ndc), vec4f(quad.low_ndc, quad.high_ndc), quad.outward, quad.q);
}

// Whether all texels just outside of a short edge show something nearer to the light, so that no point of it is drawn.
fn is_hidden(quad: Quad) -> bool {
    let low = just_outside(quad.low_ndc, quad.outward);
    let high = just_outside(quad.high_ndc, quad.outward);
    let first = texel_inside(min(low, high) - ROUNDING_TEXELS);
    let last = texel_inside(max(low, high) + ROUNDING_TEXELS);
    if any(last - first >= vec2u(MOST_TEXELS_ASKED)) {
        return false;
    }
    var deepest = 0.0;
    for (var y = first.y; y <= last.y; y++) {
        for (var x = first.x; x <= last.x; x++) {
            deepest = max(deepest, textureLoad(shadow_depth, vec2u(x, y), 0).x * view.depth_unit);
        }
    }
    let low_depth = depth_of_q(quad.q.x);
    let high_depth = depth_of_q(quad.q.y);
    let bias = view.bias_smoothie_texels * texel_footprint(max(low_depth, high_depth));
    return min(low_depth, high_depth) > (deepest + bias) * (1.0 + ROUNDING);
}

// How far beyond an end its vertex can be the nearest point of the outline on one side, as a share of the width: up to the
// normal of each other outline edge there, beyond which that one is nearer. All around the end where the outline turns by more
// than half a right angle, since a strip ends in a straight line.
fn share_beyond(quad: Quad, is_high: bool, onwards: vec2f, across: vec2f) -> f32 {
    let caster = casters[quad.caster];
    let vertex = select(quad.low_vertex, quad.high_vertex, is_high);
    let offset_word = caster.first_vertex_offset_word + vertex;
    let first = vertex_edges[offset_word];
    let last = vertex_edges[offset_word + 1u];
    if (quad.own_ends & select(OWN_END_LOW, OWN_END_HIGH, is_high)) == 0u || last - first > MAX_SEARCHED_VALENCE {
        return 1.0;
    }
    var share = 1.0;
    for (var i = first; i < last; i++) {
        let word = caster.first_vertex_edge_word + 2u * i;
        let edge_id = vertex_edges[word];
        if edge_id == quad.edge_id || side_of_edge(caster, edge_id) == OUTLINE_NONE {
            continue;
        }
        let direction = direction_from(vertex, vertex_edges[word + 1u], quad.caster);
        let cosine = dot(direction, onwards);
        let sine = dot(direction, across);
        if cosine > abs(sine) {
            share = min(share, max(-sine, 0.0) / cosine);
        }
    }
    return share;
}

@fragment
fn fragment_silhouette_quad(vertex: SilhouetteVertex) -> SilhouetteTexel {
    let point = nearest_of_quad(vertex);
    if !is_drawn(point) {
        discard;
    }
    return SilhouetteTexel(order_as_depth(point), vec2f(depth_to_keep(point), point.signed_distance));
}

@fragment
fn fragment_blended_silhouette_quad(vertex: SilhouetteVertex) -> @location(0) vec2f {
    let point = nearest_of_quad(vertex);
    if !is_drawn(point) {
        discard;
    }
    return vec2f(depth_to_keep(point), abs(point.signed_distance));
}

fn nearest_of_quad(vertex: SilhouetteVertex) -> SilhouettePoint {
    let edge = OutlineImage(vertex.ends_ndc.xy, vertex.ends_ndc.zw, vertex.outward, vertex.q);
    return nearest_point(ndc_of(vertex.clip.xy), edge);
}
