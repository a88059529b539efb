// Fills the smoothie buffer of a light view: nearest depth and least alpha of the quads and corners on each texel.
// One vertex invocation = one corner of a triangle of a quad or of a corner.
// Reads quads or corners, and the linear depth of the shadow map.
// Chan & Durand 2003, sections 4.2 and 4.3. Distance, width and q are linear on the image plane; alpha is not, where
// the ends have different widths, so it is made in the fragment. All that is so where the light is a sphere: there a
// quad is wider and leans, and a corner is a part of an ellipse, which is a disk's image.

@group(0) @binding(0) var<uniform> view: LightView;
@group(0) @binding(1) var<storage, read> quads: array<Quad>;
@group(0) @binding(2) var<storage, read> corners: array<Corner>;
@group(1) @binding(0) var shadow_depth: texture_2d<f32>;

// 0 leaves alpha as it is, and shows the contact problem that the remap cures.
override remap_alpha = 1u;

struct SmoothieVertex {
    @builtin(position) clip: vec4f,
    // Distance across the edge, negative on the blocker's side.
    @location(0) across: f32,
    // Offset from a corner's apex, on the disk whose image the corner is; zero on a quad.
    @location(1) around: vec2f,
    @location(2) width: f32,
    // As a share of the largest: rasterisers extrapolate what they interpolate, which may be too much for a float.
    @location(3) q_share: f32,
}

// The inner rim reaches half a texel under the blocker, since quads and shadow map round differently.
const INNER_RIM_TEXELS = 0.5;

@vertex
fn vertex_quad(@builtin(vertex_index) index: u32) -> SmoothieVertex {
    let quad = quads[index / VERTICES_PER_QUAD];
    let corner = quad_corner(index);
    let end = select(quad.low_ndc, quad.high_ndc, corner.is_high);
    let place = leaning(end);
    let width = widening(place, quad.outward) * select(quad.width_ndc.x, quad.width_ndc.y, corner.is_high);
    let q = select(quad.q.x, quad.q.y, corner.is_high);
    let across = select(-rim_overlap(), width, corner.is_outer);
    return SmoothieVertex(clip_at(end + across * slant(place, quad.outward), q), across, vec2f(0.0), width, q / q_unit());
}

// A corner reaches as far over its quads and under the blocker: its own rim and theirs fall between texels in ways of
// their own. Minimum blending settles what is covered twice. It is built on a disk, of which an ellipse is the image: no
// way gets shorter by that.
@vertex
fn vertex_corner(@builtin(vertex_index) index: u32) -> SmoothieVertex {
    let corner = corners[index / VERTICES_PER_CORNER];
    // Two kites, from begin to middle and from middle to end; each of two triangles that meet at its tip.
    let triangle = index % VERTICES_PER_CORNER / 3u;
    let overlap = rim_overlap();
    let width = corner.width_ndc;
    let place = leaning(corner.apex_ndc);
    let begin = disk_direction(place, corner.begin);
    let middle = disk_direction(place, corner.middle);
    let end = disk_direction(place, corner.end);
    let first = width * begin + overlap * vec2f(begin.y, -begin.x);
    let last = width * end + overlap * vec2f(-end.y, end.x);
    let begins = select(width * middle, first, triangle < 2u);
    let ends = select(last, width * middle, triangle < 2u);
    let tip = width * kite_tip(select(middle, begin, triangle < 2u), select(end, middle, triangle < 2u));
    let point = index % 3u;
    var around = tip;
    if point == 0u {
        around = -overlap * middle;
    } else if (point == 1u) == (triangle % 2u == 0u) {
        around = select(ends, begins, triangle % 2u == 0u);
    }
    let ndc = corner.apex_ndc + ellipse_from_disk(place, around);
    return SmoothieVertex(clip_at(ndc, corner.q), 0.0, around, width, corner.q / q_unit());
}

// In NDC, whose side is 2.
fn rim_overlap() -> f32 {
    return INNER_RIM_TEXELS * 2.0 / f32(view.map_size);
}

// Where the tangents of the unit circle at two unit vectors meet. A kite spans at most a quarter turn, so the tip is at
// most sqrt(2) away; on the disk of an ellipse it spans less than half a turn, and the tip is at most sqrt(2 + p^2) away.
fn kite_tip(first: vec2f, last: vec2f) -> vec2f {
    return (first + last) / (1.0 + dot(first, last));
}

fn clip_at(ndc: vec2f, q: f32) -> vec4f {
    return vec4f(ndc, clip_z(q), 1.0);
}

fn clip_z(q: f32) -> f32 {
    return saturate(q * view.ndc_scale + view.ndc_offset);
}

@fragment
fn fragment_smoothie_depth(vertex: SmoothieVertex) {
    if !is_kept(vertex) {
        discard;
    }
}

// Of a view that casters in front cast into: clip z that is interpolated between ends at its limits would be too far away.
@fragment
fn fragment_pancaked_smoothie_depth(vertex: SmoothieVertex) -> @builtin(frag_depth) f32 {
    if !is_kept(vertex) {
        discard;
    }
    return clip_z(blocker_q(vertex));
}

@fragment
fn fragment_smoothie_alpha(vertex: SmoothieVertex) -> @location(0) f32 {
    if !is_kept(vertex) {
        discard;
    }
    return remapped_alpha(vertex);
}

// Both at once, where the device blends floats of the buffer's size.
@fragment
fn fragment_smoothie_buffer(vertex: SmoothieVertex) -> @location(0) vec2f {
    if !is_kept(vertex) {
        discard;
    }
    return vec2f(depth_of_q(blocker_q(vertex)) / view.depth_unit, remapped_alpha(vertex));
}

fn blocker_q(vertex: SmoothieVertex) -> f32 {
    return vertex.q_share * q_unit();
}

fn distance_to_edge(vertex: SmoothieVertex) -> f32 {
    return max(vertex.across, length(vertex.around));
}

fn receiver_depth(vertex: SmoothieVertex) -> f32 {
    return view.depth_unit * textureLoad(shadow_depth, vec2u(vertex.clip.xy), 0).x;
}

// Within the width, and in front of the receiver: a smoothie behind it must not darken a nearer one's texel.
fn is_kept(vertex: SmoothieVertex) -> bool {
    let blocker = depth_of_q(blocker_q(vertex));
    let bias = view.bias_smoothie_texels * texel_footprint(blocker);
    return distance_to_edge(vertex) <= vertex.width && blocker + bias < receiver_depth(vertex);
}

fn remapped_alpha(vertex: SmoothieVertex) -> f32 {
    let alpha = saturate(distance_to_edge(vertex) / vertex.width);
    if remap_alpha == 0u {
        return alpha;
    }
    // The paper's alpha / (1 - b / r), for a perspective and for an orthographic view alike. A device may take the gap
    // for nothing where it is subnormal; then the two touch.
    let q = blocker_q(vertex);
    let gap = q_of_depth(receiver_depth(vertex)) - q;
    if gap > 0.0 {
        return saturate(alpha * (view.q_max - q) / gap);
    }
    return 1.0;
}
