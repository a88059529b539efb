// What the visibility texture needs of the eye's view. Meanings and units: the struct of the same name in the layout crate.

struct EyeView {
    world_from_eye_clip: mat4x4f,
    background_depth: f32,
    unused_0: u32,
    unused_1: u32,
    unused_2: u32,
}
