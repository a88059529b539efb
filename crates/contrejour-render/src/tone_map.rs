//! How bright light becomes the picture's tones.

/// Up to here colours stay as they are.
const COMPRESSED_FROM: f64 = 0.8;
/// How fast bright colours turn white.
const DESATURATION: f64 = 0.15;
/// The largest number of 16 bits.
const BRIGHTEST: f64 = 65504.0;

/// The linear colour that a picture shows for a linear radiance, each channel from 0 to 1.
///
/// Colours up to 0.8 stay as they are, so that shadows are shown untouched; what is brighter approaches 1 and turns white.
/// Range: 0 and up; what is beyond 65504 counts as that.
///
/// Khronos PBR Neutral (Khronos 2024, "PBR Neutral Tone Mapper"), but for its offset: that takes off what a glossy coat
/// reflects, and our surfaces are matte. `shaders/shared/tone_map.wgsl` is the same.
pub fn tone_mapped(radiance: [f64; 3]) -> [f64; 3] {
    let kept = radiance.map(|channel| channel.min(BRIGHTEST));
    let peak = kept.into_iter().fold(0.0, f64::max);
    if peak < COMPRESSED_FROM {
        return kept;
    }
    let rest = 1.0 - COMPRESSED_FROM;
    let new_peak = 1.0 - rest * rest / (peak + rest - COMPRESSED_FROM);
    let white = 1.0 - 1.0 / (DESATURATION * (peak - new_peak) + 1.0);
    kept.map(|channel| channel * (new_peak / peak) * (1.0 - white) + new_peak * white)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dark_colours_stay_and_bright_ones_approach_white() {
        assert_eq!(tone_mapped([0.0, 0.3, 0.79]), [0.0, 0.3, 0.79]);
        let [red, green, blue] = tone_mapped([1e4, 10.0, 1.0]);
        assert!(red > 0.99 && green > 0.99 && blue > 0.99, "{red} {green} {blue}");
        assert!(tone_mapped([f64::MAX; 3]).iter().all(|channel| (0.99..=1.0).contains(channel)));
    }

    #[test]
    fn tones_rise_without_a_step() {
        let tones: Vec<f64> = (0..4000).map(|step| tone_mapped([0.001 * f64::from(step), 0.0, 0.0])[0]).collect();
        assert!(tones.is_sorted_by(|a, b| a < b));
        assert!(tones.windows(2).all(|pair| pair[1] - pair[0] < 0.00101));
    }
}
