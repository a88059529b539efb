// The image of an edge: what of it is in view, widened by how far from it is drawn.

// The part of an edge that is inside: from `begin` to `end` of its parameter 0..1. Empty where begin >= end.
struct Span {
    begin: f32,
    end: f32,
}

struct ImagePoint {
    ndc: vec2f,
    q: f32,
}

struct EdgeImage {
    low: ImagePoint,
    high: ImagePoint,
    span: Span,
}

fn is_in_view(image: EdgeImage) -> bool {
    return image.span.begin < image.span.end;
}

fn edge_image(clip_from_object: mat4x4f, low: vec3f, high: vec3f) -> EdgeImage {
    let low_clip = clip_from_object * vec4f(low, 1.0);
    let high_clip = clip_from_object * vec4f(high, 1.0);
    let delta_clip = clip_from_object * vec4f(high - low, 0.0);

    // Clip by depth first, since the width that widens the frustum depends on it.
    let depth_span = clip_by_depth(Span(0.0, 1.0), low_clip, high_clip);
    if !(depth_span.begin < depth_span.end) {
        return EdgeImage(ImagePoint(vec2f(0.0), 0.0), ImagePoint(vec2f(0.0), 0.0), depth_span);
    }
    let width = max(
        smoothie_width(image_of(point_at(depth_span.begin, low_clip, high_clip, delta_clip)).q),
        smoothie_width(image_of(point_at(depth_span.end, low_clip, high_clip, delta_clip)).q),
    );
    let span = clip_by_sides(depth_span, low_clip, high_clip, 1.0 + widest_ndc(width));
    return EdgeImage(
        image_of(point_at(span.begin, low_clip, high_clip, delta_clip)),
        image_of(point_at(span.end, low_clip, high_clip, delta_clip)),
        span,
    );
}

// The ends themselves where nothing was cut off, so that neighbours share them to the bit.
fn point_at(t: f32, low: vec4f, high: vec4f, delta: vec4f) -> vec4f {
    return select(select(low + t * delta, high, t == 1.0), low, t == 0.0);
}

// A point in view but for rounding: the cut end of an edge that is far larger than the view can be anywhere, even in the
// plane of the light.
fn image_of(clip: vec4f) -> ImagePoint {
    let depth = clamp(depth_of_clip(clip), least_depth(), view.far_depth);
    let w = select(clip.w, depth, view.perspective == 1u);
    let most = 1.0 + widest_ndc(view.width_max_ndc);
    return ImagePoint(clamp(clip.xy / w, vec2f(-most), vec2f(most)), q_of_depth(depth));
}

fn clip_by_depth(span: Span, low: vec4f, high: vec4f) -> Span {
    let far = clip_by_plane(span, low.w - low.z, high.w - high.z);
    if pancakes() {
        return far;
    }
    return clip_by_plane(far, low.z, high.z);
}

fn clip_by_sides(span: Span, low: vec4f, high: vec4f, half_side: f32) -> Span {
    let left = clip_by_plane(span, half_side * low.w + low.x, half_side * high.w + high.x);
    let right = clip_by_plane(left, half_side * low.w - low.x, half_side * high.w - high.x);
    let bottom = clip_by_plane(right, half_side * low.w + low.y, half_side * high.w + high.y);
    return clip_by_plane(bottom, half_side * low.w - low.y, half_side * high.w - high.y);
}

// Keeps the part where the distance to a plane, linear from one end to the other, is not negative.
// Liang & Barsky 1984.
fn clip_by_plane(span: Span, low_distance: f32, high_distance: f32) -> Span {
    if low_distance >= 0.0 && high_distance >= 0.0 {
        return span;
    }
    if low_distance < 0.0 && high_distance < 0.0 {
        return Span(1.0, 0.0);
    }
    let crossing = low_distance / (low_distance - high_distance);
    if low_distance < 0.0 {
        return Span(max(span.begin, crossing), span.end);
    }
    return Span(span.begin, min(span.end, crossing));
}
