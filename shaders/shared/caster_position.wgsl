// Positions of a caster, brought near 1 by its origin and its power of two. Never used for facing.

fn scaled_position(caster: Caster, vertex: u32) -> vec3f {
    let word = caster.first_position_word + vertex * caster.position_stride_words;
    let position = vec3f(
        bitcast<f32>(positions[word]),
        bitcast<f32>(positions[word + 1u]),
        bitcast<f32>(positions[word + 2u]),
    );
    return (position - caster.position_origin) * caster.position_scale;
}
