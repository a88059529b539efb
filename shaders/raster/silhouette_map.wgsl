// Fills the silhouette map of a light view: signed distance to the nearest outline edge that the light reaches, and its
// depth.
// One vertex invocation = one corner of a triangle of the rectangle around a quad's edge, as wide as distances are drawn.
// Reads quads and the linear depth of the shadow map.
// Valient & Bujnak 2005, with edges that compute stages found.

@group(0) @binding(0) var<uniform> view: LightView;
@group(0) @binding(1) var<storage, read> quads: array<Quad>;
@group(1) @binding(0) var shadow_depth: texture_2d<f32>;

struct SilhouetteVertex {
    @builtin(position) clip: vec4f,
    @location(0) @interpolate(flat) ends_ndc: vec4f,
    @location(1) @interpolate(flat) outward: vec2f,
    @location(2) @interpolate(flat) q: vec2f,
}

@vertex
fn vertex_silhouette_quad(@builtin(vertex_index) index: u32) -> SilhouetteVertex {
    let quad = quads[index / VERTICES_PER_QUAD];
    let corner = quad_corner(index);
    let width = max(
        quad.width_ndc.x * widening(leaning(quad.low_ndc), quad.outward),
        quad.width_ndc.y * widening(leaning(quad.high_ndc), quad.outward),
    );
    // The outward side is right of the way, or left where the blocker is on the right.
    let along = select(clockwise(quad.outward), counter_clockwise(quad.outward), quad.side == OUTLINE_BLOCKER_LEFT);
    let ndc = select(quad.low_ndc - width * along, quad.high_ndc + width * along, corner.is_high)
        + select(-width, width, corner.is_outer) * quad.outward;
    return SilhouetteVertex(drawn_at(ndc), vec4f(quad.low_ndc, quad.high_ndc), quad.outward, quad.q);
}

@fragment
fn fragment_silhouette_quad(vertex: SilhouetteVertex) -> SilhouetteTexel {
    let edge = OutlineImage(vertex.ends_ndc.xy, vertex.ends_ndc.zw, vertex.outward, vertex.q);
    let point = nearest_point(ndc_of(vertex.clip.xy), edge);
    if !is_in_band(point) || !is_unhidden(point) {
        discard;
    }
    return silhouette_texel(point);
}
