// Draws silhouette edges over a picture as lines of an even width.
// One vertex invocation = one corner of one line's two triangles.
// Reads overlay and the lines' ends.

struct Overlay {
    eye_clip_from_local: mat4x4f,
    // Half the size of the picture, in pixels.
    half_size: vec2f,
    half_width_pixels: f32,
}

@group(0) @binding(0) var<uniform> overlay: Overlay;

// Lines are pulled to the eye by this part of their reversed depth, so that their own faces do not hide them.
const PULL = 2e-3;
// Nothing nearer than this to the eye's plane is drawn, in units of local space.
const NEAREST = 1e-6;

struct LineVertex {
    @builtin(position) clip: vec4f,
    @location(0) color: vec4f,
}

@vertex
fn vertex_line(
    @builtin(vertex_index) index: u32,
    @location(0) begin_local: vec3f,
    @location(1) end_local: vec3f,
    @location(2) color: vec4f,
) -> LineVertex {
    // Cut off what is behind the eye.
    let begin = overlay.eye_clip_from_local * vec4f(begin_local, 1.0);
    let end = overlay.eye_clip_from_local * vec4f(end_local, 1.0);
    if max(begin.w, end.w) <= NEAREST {
        return LineVertex(vec4f(0.0, 0.0, 2.0, 1.0), color);
    }
    let first = in_front(begin, end);
    let last = in_front(end, begin);

    // Widen in pixels, and by half the width beyond both ends, so that neighbours join.
    let along = last.xy / last.w * overlay.half_size - first.xy / first.w * overlay.half_size;
    let length_squared = dot(along, along);
    let direction = select(vec2f(1.0, 0.0), along * inverseSqrt(length_squared), length_squared > 0.0);
    let is_last = index == 1u || index >= 4u;
    let is_left = index == 2u || index == 3u || index == 5u;
    let offset = direction * select(-1.0, 1.0, is_last) + vec2f(-direction.y, direction.x) * select(-1.0, 1.0, is_left);
    var clip = select(first, last, is_last);
    clip = vec4f(clip.xy + offset * overlay.half_width_pixels / overlay.half_size * clip.w, clip.z * (1.0 + PULL), clip.w);
    return LineVertex(clip, color);
}

// The point itself, or where the line from it to another point comes before the eye.
fn in_front(point: vec4f, other: vec4f) -> vec4f {
    if point.w > NEAREST {
        return point;
    }
    return mix(point, other, (NEAREST - point.w) / (other.w - point.w));
}

@fragment
fn fragment_visible_line(line: LineVertex) -> @location(0) vec4f {
    return line.color;
}

// Lines behind a surface shine through a little.
@fragment
fn fragment_hidden_line(line: LineVertex) -> @location(0) vec4f {
    return vec4f(line.color.rgb, 0.25 * line.color.a);
}
