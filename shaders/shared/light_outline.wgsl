// What a light looks like from where its shadows fall: a disk alike from everywhere, a sphere as the ellipse with the
// matrix M = I + p p^T from p, the place at depth 1. Derivations: `LightOutline` of the plan crate. With a disk p is zero,
// and everything stays as it is.

const SQRT_2 = 1.4142135;

// Below that share a sphere is nearly as large as the blocker is far, and soft edges could come from anywhere.
const LEAST_GROWTH = 0.0625;

// A bound of how wide smoothies are that reach into the map, where a disk's are as wide as given.
fn widest_ndc(width_ndc: f32) -> f32 {
    let side = view.sphere_half_side;
    return width_ndc * (1.0 + SQRT_2 * side) / max(1.0 - width_ndc * side, LEAST_GROWTH);
}

// From which place a point of the image sees the light.
fn leaning(place_ndc: vec2f) -> vec2f {
    return place_ndc * view.sphere_half_side;
}

// How many times as wide as a disk's the soft edge is of a line with a unit normal: sqrt(1 + d^2), where d is how far
// from the middle the line passes at depth 1.
fn widening(place: vec2f, outward: vec2f) -> f32 {
    let along = dot(place, outward);
    return sqrt(1.0 + along * along);
}

// Of a line with any normal.
fn widest_widening(place: vec2f) -> f32 {
    return sqrt(1.0 + dot(place, place));
}

// From such a line to the parallel one at the distance 1, the way on which alpha grows: M g, by its share along g.
fn slant(place: vec2f, outward: vec2f) -> vec2f {
    let along = dot(place, outward);
    return (outward + along * place) / (1.0 + along * along);
}

// The square root of M: from a disk to the ellipse.
fn ellipse_from_disk(place: vec2f, offset: vec2f) -> vec2f {
    return offset + dot(place, offset) / (1.0 + sqrt(1.0 + dot(place, place))) * place;
}

// Unit direction on the disk of the ellipse's point that has a unit normal.
fn disk_direction(place: vec2f, outward: vec2f) -> vec2f {
    return ellipse_from_disk(place, outward) / widening(place, outward);
}
