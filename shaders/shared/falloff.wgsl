// How light grows weaker with distance and towards the rim of a cone; `distance_falloff` and `ConeFalloff` of the
// library's plan are the same on the CPU, and say where the formulas are from.

// The inverse square of the distance, brought smoothly to nothing at the range. `range_inverse` is one over the range, 0
// where the light never ends.
fn distance_falloff(distance_squared: f32, range_inverse: f32, least_distance_squared: f32) -> f32 {
    let share_squared = distance_squared * range_inverse * range_inverse;
    let window = saturate(1.0 - share_squared * share_squared);
    return window * window / (distance_squared + least_distance_squared);
}

// Full within the inner angle, nothing from the outer angle on.
fn cone_falloff(cosine: f32, scale: f32, offset: f32) -> f32 {
    let share = saturate(cosine * scale + offset);
    return share * share;
}
