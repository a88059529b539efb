// Edges on the light's image plane.

// An edge whose image is shorter than this share of what it could be at any other angle to the light projects to a
// point. Rounding turns edges by some 1e-7, while facing is exact: below that, direction and facing disagree. Enough
// above it for directions right to a hundredth of a radian, and still far below a texel.
const POINT_TOLERANCE = 4e-6;

// Unit direction in which the image moves from a low to a high end; zero where the edge projects to a point.
// Derivative of xy / w, times w squared: right for any sign of w, also that of an end behind the light. Of its factors
// both are brought near 1, since clip space is as large or as small as the scene.
fn image_direction(clip_from_object: mat4x4f, low: vec3f, high: vec3f) -> vec2f {
    let edge = high - low;
    let columns = mat3x4f(clip_from_object[0], clip_from_object[1], clip_from_object[2]);
    let reach = abs(columns[0]) + abs(columns[1]) + abs(columns[2]);
    let reach_scale = reciprocal_power(max(max(reach.x, reach.y), reach.w));
    let delta = (columns * reach_scale) * edge;
    let clip = clip_from_object * vec4f(low, 1.0);
    let near_one = clip * reciprocal_power(max(max(abs(clip.x), abs(clip.y)), abs(clip.w)));
    let direction = delta.xy * near_one.w - near_one.xy * delta.w;
    let size = max(abs(direction.x), abs(direction.y));
    if size > POINT_TOLERANCE * longest_image(reach * reach_scale, near_one, edge) {
        // Divided by its size first, so that squares neither overflow nor vanish.
        return normalize(direction / size);
    }
    return vec2f(0.0);
}

// A bound of the terms that a direction is the difference of, for any edge as long as `edge`; `reach` is how far a step
// along all axes goes in clip space.
fn longest_image(reach: vec4f, clip: vec4f, edge: vec3f) -> f32 {
    let offset = max(abs(clip.x), abs(clip.y));
    let length = max(max(abs(edge.x), abs(edge.y)), abs(edge.z));
    return length * (max(reach.x, reach.y) * abs(clip.w) + offset * reach.w);
}

fn counter_clockwise(v: vec2f) -> vec2f {
    return vec2f(-v.y, v.x);
}

fn clockwise(v: vec2f) -> vec2f {
    return vec2f(v.y, -v.x);
}

fn cross_2d(a: vec2f, b: vec2f) -> f32 {
    return a.x * b.y - a.y * b.x;
}

// Smoothie width at a blocker's q, in NDC, for a disk of light.
fn smoothie_width(q: f32) -> f32 {
    return clamp(view.width_per_q_ndc * (view.q_max - q), view.width_min_ndc, view.width_max_ndc);
}
