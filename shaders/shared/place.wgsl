// What is written when a caster moves. Meanings and units: the struct of the same name in the layout crate.

const CASTER_NEVER = 0u;
const CASTER_ALWAYS = 1u;
const CASTER_IN_VIEW = 2u;

struct CasterPlace {
    object_from_world: array<vec2u, 9>,
    origin_world: array<vec2u, 3>,
    world_from_scaled: array<vec2u, 12>,
    box_middle: vec3f,
    mirrored: u32,
    box_half: vec3f,
    casts: u32,
}
