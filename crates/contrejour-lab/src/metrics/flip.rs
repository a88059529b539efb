//! How different two pictures look.

use image::RgbaImage;

use super::MetricError;

/// How large pixels appear to who compares: 67 to a degree, as on a 4K screen 0.7 m wide from 0.7 m away, where FLIP's
/// authors measure.
pub const FLIP_PIXELS_PER_DEGREE: f32 = 67.020_64;

/// Mean FLIP of two shaded sRGB pictures (Andersson et al. 2020), 0 = they look equal, 1 = as different as can be. None
/// without the feature `flip`. Alpha is not looked at.
///
/// # Errors
///
/// Pictures of different size.
pub fn mean_flip(truth: &RgbaImage, technique: &RgbaImage) -> Result<Option<f64>, MetricError> {
    if truth.dimensions() != technique.dimensions() {
        let pixels = |picture: &RgbaImage| picture.pixels().len();
        return Err(MetricError::Length {
            what: "the technique's picture",
            found: pixels(technique),
            expected: pixels(truth),
        });
    }
    Ok(mean(truth, technique))
}

#[cfg(feature = "flip")]
fn mean(truth: &RgbaImage, technique: &RgbaImage) -> Option<f64> {
    let [truth, technique] = [truth, technique].map(|picture| {
        let colours: Vec<u8> = picture.pixels().flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        nv_flip::FlipImageRgb8::with_data(picture.width(), picture.height(), &colours)
    });
    let differences = nv_flip::flip(truth, technique, FLIP_PIXELS_PER_DEGREE).to_vec();
    // Not nv-flip's own pool: it puts values into buckets, and its mean is a little off.
    let sum: f64 = differences.iter().copied().map(f64::from).sum();
    (!differences.is_empty()).then(|| sum / differences.len() as f64)
}

#[cfg(not(feature = "flip"))]
fn mean(_truth: &RgbaImage, _technique: &RgbaImage) -> Option<f64> {
    None
}

#[cfg(test)]
mod tests {
    use image::Rgba;

    use super::*;

    fn plain(level: u8) -> RgbaImage {
        RgbaImage::from_pixel(32, 32, Rgba([level, level, level, 255]))
    }

    #[test]
    fn other_sizes_are_refused() {
        assert_eq!(
            mean_flip(&plain(0), &RgbaImage::new(16, 32)),
            Err(MetricError::Length { what: "the technique's picture", found: 512, expected: 1024 })
        );
    }

    #[cfg(feature = "flip")]
    #[test]
    fn equal_looks_equal_and_black_is_not_white() {
        let flip = |a, b| mean_flip(&a, &b).expect("the sizes agree").expect("the feature is on");
        assert_eq!(flip(plain(90), plain(90)), 0.0);
        let [little, much] = [flip(plain(90), plain(100)), flip(plain(0), plain(255))];
        assert!(0.0 < little && little < 0.5 * much && much > 0.9, "{little} {much}");
        // The same planted square is seen in the middle of the picture, and its mean grows with its area.
        let square =
            |side| RgbaImage::from_fn(32, 32, |x, y| plain(if x < side && y < side { 255 } else { 0 })[(x, y)]);
        assert!(flip(plain(0), square(4)) < flip(plain(0), square(16)));
    }

    #[cfg(not(feature = "flip"))]
    #[test]
    fn without_the_feature_there_is_no_figure() {
        assert_eq!(mean_flip(&plain(0), &plain(255)), Ok(None));
    }
}
