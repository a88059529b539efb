// Counts the triangles of another pass that cover a texel: its target adds them up.

@fragment
fn fragment_counted() -> @location(0) vec4f {
    return vec4f(1.0);
}
