// One triangle that covers a target.

fn full_screen_clip(index: u32) -> vec4f {
    return vec4f(select(-1.0, 3.0, index == 1u), select(-1.0, 3.0, index == 2u), 0.0, 1.0);
}
