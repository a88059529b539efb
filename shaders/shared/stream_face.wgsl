// A face of a topology-aware stream, of 32-bit floats.

// Of two faces at an outline edge the lit one draws it, and also one that may be lit, but for rounding: its neighbours know a
// normal of it that is rounded otherwise.
const LEAST_FACING_DRAWN = -1e-5;
// A smaller sine is rounding.
const EDGE_ON = 1e-6;

fn stream_face(index: u32) -> array<vec3f, 6> {
    var vectors: array<vec3f, 6>;
    for (var i = 0u; i < 6u; i++) {
        let word = STREAM_FACE_WORDS * index + 3u * i;
        let bits = vec3u(stream_faces[word], stream_faces[word + 1u], stream_faces[word + 2u]);
        vectors[i] = bitcast<vec3f>(bits);
    }
    return vectors;
}
