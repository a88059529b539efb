// Fills the picture: tones of the light that was added up, from each sample of a pixel by itself, so that edges between
// dark and very bright stay smooth.
// One fragment invocation = one pixel.
// Reads samples, or radiance where a pixel has one sample.

@group(0) @binding(0) var samples: texture_multisampled_2d<f32>;
@group(0) @binding(0) var radiance: texture_2d<f32>;

// 1 where the target takes numbers as they are shown, which a target of an sRGB format makes itself.
override encodes_srgb = 0.0;
// Samples of a pixel.
override sample_count = 1u;

// Alpha where no mesh is; all passes leave 0 or 1 on meshes.
const BACKGROUND = 0.5;

@vertex
fn vertex_picture(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return full_screen_clip(index);
}

@fragment
fn fragment_picture_of_samples(@builtin(position) clip: vec4f) -> @location(0) vec4f {
    var sum = vec3f(0.0);
    for (var sample = 0u; sample < sample_count; sample++) {
        sum += tone(textureLoad(samples, vec2u(clip.xy), sample));
    }
    return shown(sum / f32(sample_count));
}

@fragment
fn fragment_picture(@builtin(position) clip: vec4f) -> @location(0) vec4f {
    return shown(tone(textureLoad(radiance, vec2u(clip.xy), 0)));
}

// The background is a colour of the picture and no light.
fn tone(texel: vec4f) -> vec3f {
    return select(tone_mapped(texel.rgb), texel.rgb, texel.a == BACKGROUND);
}

fn shown(color: vec3f) -> vec4f {
    if encodes_srgb == 0.0 {
        return vec4f(color, 1.0);
    }
    // IEC 61966-2-1 (1999).
    let curve = 1.055 * pow(color, vec3f(1.0 / 2.4)) - 0.055;
    return vec4f(select(curve, 12.92 * color, color <= vec3f(0.0031308)), 1.0);
}
