//! The smaller versions of a texture.

use contrejour_mesh::halved;
use image::{Rgba, RgbaImage};

/// A texture half as large each way, down to 1: each texel is the mean of those below it, as light and not as its code,
/// and what is transparent counts as little as it shows.
pub(crate) fn next_level(texture: &RgbaImage) -> Option<RgbaImage> {
    let (width, height) = texture.dimensions();
    if width.max(height) == 1 {
        return None;
    }
    let columns = halved(width);
    let rows = halved(height);
    let light_of_code: Vec<f32> = (0..=255).map(|code| light(code as f32 / 255.0)).collect();
    // Where one code becomes the next.
    let borders: Vec<f32> = (0..255).map(|code| light((code as f32 + 0.5) / 255.0)).collect();
    let code = |light: f32| borders.partition_point(|&border| border < light) as u8;
    Some(RgbaImage::from_fn(columns.len() as u32, rows.len() as u32, |column, row| {
        let (mut opaque, mut plain, mut alpha) = ([0.0; 3], [0.0; 3], 0.0);
        for &(y, share_y) in &rows[row as usize] {
            for &(x, share_x) in &columns[column as usize] {
                let Rgba([red, green, blue, opacity]) = *texture.get_pixel(x, y);
                let share = share_x * share_y;
                let opacity = share * f32::from(opacity) / 255.0;
                for (channel, code) in [red, green, blue].into_iter().enumerate() {
                    opaque[channel] += opacity * light_of_code[usize::from(code)];
                    plain[channel] += share * light_of_code[usize::from(code)];
                }
                alpha += opacity;
            }
        }
        let [red, green, blue] = if alpha > 0.0 { opaque.map(|light| code(light / alpha)) } else { plain.map(code) };
        Rgba([red, green, blue, (255.0 * alpha).round() as u8])
    }))
}

/// Light from an sRGB code of 0 to 1 (IEC 61966-2-1:1999).
fn light(code: f32) -> f32 {
    if code > 0.040_45 { ((code + 0.055) / 1.055).powf(2.4) } else { code / 12.92 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_is_averaged_and_not_its_code() {
        let checks = RgbaImage::from_fn(4, 2, |x, y| Rgba(if (x + y) % 2 == 0 { [255; 4] } else { [0, 0, 0, 255] }));
        let half = next_level(&checks).expect("there is a smaller one");
        assert_eq!(half.dimensions(), (2, 1));
        // Half the light of white has this code.
        assert!(half.pixels().all(|&texel| texel == Rgba([188, 188, 188, 255])), "{half:?}");
        let last = next_level(&half).expect("there is one more");
        assert_eq!((last.dimensions(), last.get_pixel(0, 0)), ((1, 1), &Rgba([188, 188, 188, 255])));
        assert_eq!(next_level(&last), None);
    }

    #[test]
    fn one_colour_stays_at_any_size() {
        for (width, height) in [(7, 5), (1, 9), (3, 3), (64, 1)] {
            let mut level = RgbaImage::from_pixel(width, height, Rgba([13, 77, 201, 255]));
            while let Some(smaller) = next_level(&level) {
                level = smaller;
                assert!(level.pixels().all(|&texel| texel == Rgba([13, 77, 201, 255])), "{level:?}");
            }
        }
    }

    #[test]
    fn texels_have_equal_shares() {
        for texels in 2..40_u32 {
            let mut of_texels = vec![0.0; texels as usize];
            for shares in halved(texels) {
                assert!((shares.iter().map(|(_, share)| share).sum::<f32>() - 1.0).abs() < 1e-5);
                shares.iter().for_each(|&(texel, share)| of_texels[texel as usize] += share);
            }
            let equal = (texels / 2) as f32 / texels as f32;
            assert!(of_texels.iter().all(|share| (share - equal).abs() < 1e-5), "{texels}: {of_texels:?}");
        }
    }

    #[test]
    fn what_is_transparent_has_no_colour() {
        let cut = RgbaImage::from_fn(2, 2, |x, _| Rgba(if x == 0 { [200, 10, 10, 255] } else { [0, 255, 0, 0] }));
        let half = next_level(&cut).expect("there is a smaller one");
        assert_eq!(*half.get_pixel(0, 0), Rgba([200, 10, 10, 128]));
    }
}
