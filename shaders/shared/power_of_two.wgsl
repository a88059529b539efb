// Scaling that costs no digits.

// A power of two that brings a size near 1; it is a normal float for any size.
fn reciprocal_power(size: f32) -> f32 {
    return bitcast<f32>(0x7f000000u - clamp(bitcast<u32>(size) & 0x7f800000u, 0x00800000u, 0x7e800000u));
}
