// Places on a disk of light.

const CONTREJOUR_GOLDEN_ANGLE = 2.3999632;

// Points spread evenly over the unit disk (Vogel 1979).
fn contrejour_disk(sample: u32, count: u32, turn: f32) -> vec2f {
    let radius = sqrt((f32(sample) + 0.5) / f32(count));
    let angle = f32(sample) * CONTREJOUR_GOLDEN_ANGLE + turn;
    return radius * vec2f(cos(angle), sin(angle));
}
