// Brings linear colours of any brightness into 0 to 1: Khronos PBR Neutral (Khronos 2024), without its offset, which takes
// off what a glossy coat reflects; our surfaces are matte. `tone_mapped` of the renderer's crate is the same on the CPU.

// Up to here colours stay as they are, so that shadows are shown untouched.
const COMPRESSED_FROM = 0.8;
// How fast bright colours turn white.
const DESATURATION = 0.15;
// The largest number of 16 bits: nothing brighter is kept.
const BRIGHTEST = 65504.0;

fn tone_mapped(color: vec3f) -> vec3f {
    let kept = min(color, vec3f(BRIGHTEST));
    let peak = max(kept.r, max(kept.g, kept.b));
    if peak < COMPRESSED_FROM {
        return kept;
    }
    let rest = 1.0 - COMPRESSED_FROM;
    let new_peak = 1.0 - rest * rest / (peak + rest - COMPRESSED_FROM);
    let white = 1.0 - 1.0 / (DESATURATION * (peak - new_peak) + 1.0);
    return mix(kept * (new_peak / peak), vec3f(new_peak), white);
}
