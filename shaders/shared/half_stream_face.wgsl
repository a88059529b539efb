// A face of a topology-aware stream, of 16-bit floats.

// Both faces at an outline edge draw it: rounded corners may turn a small face to any side, and its neighbours know another
// normal of it.
const LEAST_FACING_DRAWN = -1e30;
// A smaller sine is rounding, of normals and corners.
const EDGE_ON = 0.001;

fn stream_face(index: u32) -> array<vec3f, 6> {
    var vectors: array<vec3f, 6>;
    for (var pair = 0u; pair < 3u; pair++) {
        let word = HALF_STREAM_FACE_WORDS * index + 3u * pair;
        let first = unpack2x16float(stream_faces[word]);
        let middle = unpack2x16float(stream_faces[word + 1u]);
        let last = unpack2x16float(stream_faces[word + 2u]);
        vectors[2u * pair] = vec3f(first, middle.x);
        vectors[2u * pair + 1u] = vec3f(middle.y, last);
    }
    return vectors;
}
