// Edges on the light's image plane.

// An edge whose image is shorter than this share of the terms that it is the difference of is rounding noise.
const POINT_TOLERANCE = 1e-7;

// Unit direction in which the image of `clip + t * delta` moves as t grows; zero where the edge projects to a point.
// Derivative of xy / w, times w squared: right for any sign of w, also that of an end behind the light.
fn image_direction(clip: vec4f, delta: vec4f) -> vec2f {
    let ahead = delta.xy * clip.w;
    let drift = clip.xy * delta.w;
    let direction = ahead - drift;
    let size = max(abs(direction.x), abs(direction.y));
    let noise = POINT_TOLERANCE * (length(ahead) + length(drift));
    if size > noise {
        // Divided by its size first, so that squares neither overflow nor vanish.
        return normalize(direction / size);
    }
    return vec2f(0.0);
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

// Smoothie width at a blocker's q, in NDC.
fn smoothie_width(q: f32) -> f32 {
    let width = view.width_fixed_ndc + view.width_per_q_ndc * (view.q_max - q);
    return clamp(width, view.width_min_ndc, view.width_max_ndc);
}

fn q_of_clip(clip: vec4f) -> f32 {
    return q_of_depth(depth_of_clip(clip));
}
