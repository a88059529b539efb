// Looking up the picture of a mask: as a texture would be, but from words, so that one draw serves all pictures.

const MASK_REPEAT = 0u;
const MASK_MIRROR = 1u;

struct MaskLevel {
    first_word: u32,
    size: vec2u,
}

// Alpha of the picture, from 0 to 1, of the level whose texels are about as large as the steps to the neighbours.
fn mask_alpha(mask: Mask, coordinates: vec2f, across: vec2f, down: vec2f) -> f32 {
    let size = vec2f(f32(mask.width), f32(mask.height));
    let step = max(length(across * size), length(down * size));
    let level = mask_level(mask, u32(round(log2(clamp(step, 1.0, 16384.0)))));
    let place = vec2f(wrapped(coordinates.x, mask.wrap_u), wrapped(coordinates.y, mask.wrap_v)) * vec2f(level.size);
    if mask.is_nearest == 1u && all(level.size == vec2u(mask.width, mask.height)) {
        return mask_texel(mask, level, vec2i(place));
    }
    let corner = floor(place - 0.5);
    let share = place - 0.5 - corner;
    let texel = vec2i(corner);
    let upper = mix(mask_texel(mask, level, texel), mask_texel(mask, level, texel + vec2i(1, 0)), share.x);
    let lower = mix(mask_texel(mask, level, texel + vec2i(0, 1)), mask_texel(mask, level, texel + 1), share.x);
    return mix(upper, lower, share.y);
}

fn mask_level(mask: Mask, wanted: u32) -> MaskLevel {
    var level = MaskLevel(mask.first_texel_word, vec2u(mask.width, mask.height));
    for (var index = 0u; index < min(wanted, mask.levels - 1u); index++) {
        level.first_word += (level.size.x * level.size.y + 3u) / 4u;
        level.size = max(level.size / 2u, vec2u(1u));
    }
    return level;
}

// A coordinate brought into the picture, from 0 to 1.
fn wrapped(coordinate: f32, wrap: u32) -> f32 {
    if wrap == MASK_REPEAT {
        return coordinate - floor(coordinate);
    }
    if wrap == MASK_MIRROR {
        let pair = coordinate - 2.0 * floor(0.5 * coordinate);
        return min(pair, 2.0 - pair);
    }
    return saturate(coordinate);
}

// A texel at most one beyond the edges.
fn mask_texel(mask: Mask, level: MaskLevel, place: vec2i) -> f32 {
    let size = vec2i(level.size);
    var inside = clamp(place, vec2i(0), size - 1);
    if mask.wrap_u == MASK_REPEAT {
        inside.x = (place.x + size.x) % size.x;
    }
    if mask.wrap_v == MASK_REPEAT {
        inside.y = (place.y + size.y) % size.y;
    }
    let texel = u32(inside.y * size.x + inside.x);
    let code = mask_words[level.first_word + texel / 4u] >> (8u * (texel % 4u));
    return f32(code & 0xffu) / 255.0;
}
