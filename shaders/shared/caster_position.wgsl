// Positions of a caster, brought near 1 by its origin and its power of two. Never used for facing.

fn scaled_position(caster: Caster, vertex: u32) -> vec3f {
    let origin = bitcast<vec3u>(caster.position_origin);
    return scaled(position_bits(caster, vertex), caster.position_scale) - scaled(origin, caster.position_scale);
}

fn position_bits(caster: Caster, vertex: u32) -> vec3u {
    let word = caster.first_position_word + vertex * caster.position_stride_words;
    return vec3u(positions[word], positions[word + 1u], positions[word + 2u]);
}

fn scaled(bits: vec3u, power: f32) -> vec3f {
    return vec3f(scaled_number(bits.x, power), scaled_number(bits.y, power), scaled_number(bits.z, power));
}

// A number times a power of two. Subnormal ones are scaled as whole numbers: a device may take them for zero, and a tiny
// mesh has no others.
fn scaled_number(bits: u32, power: f32) -> f32 {
    if (bits & 0x7f800000u) != 0u {
        return bitcast<f32>(bits) * power;
    }
    let size = (f32(bits & 0x7fffffu) * 0x1p-23f) * (0x1p-126f * power);
    return select(size, -size, (bits >> 31u) == 1u);
}
