// Fills a level of the moments: the level before it, blurred and halved.
// One fragment invocation = one texel; one triangle covers all.
// Reads the level before.
//
// Binomial weights 1 3 3 1 along each axis, so that levels look round when they are enlarged. Each halving adds three
// quarters of a texel squared of the level before to the variance along an axis: (4^level - 1) / 4 in all.

@group(1) @binding(0) var finer: texture_2d<f32>;

@vertex
fn vertex_full_screen(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return full_screen_clip(index);
}

@fragment
fn fragment_blurred_moments(@builtin(position) texel: vec4f) -> @location(0) vec4f {
    let weights = array(0.125, 0.375, 0.375, 0.125);
    let last = vec2i(textureDimensions(finer)) - 1;
    let corner = 2 * vec2i(texel.xy) - 1;
    var sum = vec4f(0.0);
    for (var row = 0; row < 4; row++) {
        for (var column = 0; column < 4; column++) {
            let place = clamp(corner + vec2i(column, row), vec2i(0), last);
            sum += weights[row] * weights[column] * textureLoad(finer, place, 0);
        }
    }
    return sum;
}
