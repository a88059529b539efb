//! Comparison of pictures with goldens.

use std::path::{Path, PathBuf};
use std::{env, fs};

use image::RgbaImage;

/// Set to 1, goldens are written instead of compared.
pub const BLESS: &str = "CONTREJOUR_BLESS";

/// How far two pictures may be apart, in steps of 255.
#[derive(Clone, Copy, Debug)]
pub struct ImageTolerance {
    /// Mean absolute difference over all channels.
    pub mean: f64,
    /// Largest absolute difference of a channel.
    pub max: u8,
}

/// Folder of the goldens.
pub fn goldens() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/goldens")
}

/// Compares a picture with the golden `<name>.png`, or writes the golden with [`BLESS`]`=1`.
///
/// # Errors
///
/// A missing golden, or the difference; then the picture lies beside the build's other files, and its path is in the text.
pub fn check_golden(name: &str, actual: &RgbaImage, tolerance: ImageTolerance) -> Result<(), String> {
    let bless = env::var(BLESS).is_ok_and(|value| value == "1");
    check_golden_in(&goldens(), bless, name, actual, tolerance)
}

fn check_golden_in(
    folder: &Path,
    bless: bool,
    name: &str,
    actual: &RgbaImage,
    tolerance: ImageTolerance,
) -> Result<(), String> {
    let path = folder.join(format!("{name}.png"));
    if bless {
        fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        return actual.save(&path).map_err(|error| format!("{}: {error}", path.display()));
    }
    let expected = image::open(&path)
        .map_err(|error| format!("golden {}: {error}; {BLESS}=1 writes it", path.display()))?
        .into_rgba8();
    compare_images(name, &expected, actual, tolerance).map_err(|difference| {
        let found = env::temp_dir().join(format!("contrejour-{name}.png"));
        let saved = match actual.save(&found) {
            Ok(()) => format!("what was found is in {}", found.display()),
            Err(error) => format!("what was found cannot be saved: {error}"),
        };
        format!("{difference}; {saved}")
    })
}

/// Compares two pictures.
///
/// # Errors
///
/// Different sizes, or a difference beyond the tolerance with the pixel that differs most.
pub fn compare_images(
    name: &str,
    expected: &RgbaImage,
    actual: &RgbaImage,
    tolerance: ImageTolerance,
) -> Result<(), String> {
    if expected.dimensions() != actual.dimensions() {
        return Err(format!("{name}: {:?} expected, {:?} found", expected.dimensions(), actual.dimensions()));
    }
    let mut sum = 0u64;
    let mut worst = (0, 0, 0);
    for ((x, y, expected), actual) in expected.enumerate_pixels().zip(actual.pixels()) {
        for (expected, actual) in expected.0.into_iter().zip(actual.0) {
            let difference = expected.abs_diff(actual);
            sum += u64::from(difference);
            worst = worst.max((difference, x, y));
        }
    }
    let (max, x, y) = worst;
    let mean = sum as f64 / expected.as_raw().len().max(1) as f64;
    if mean > tolerance.mean || max > tolerance.max {
        return Err(format!(
            "{name}: mean difference {mean:.4} (allowed {}), largest {max} at ({x}, {y}) (allowed {})",
            tolerance.mean, tolerance.max
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOLERANCE: ImageTolerance = ImageTolerance { mean: 0.5, max: 8 };

    fn picture() -> RgbaImage {
        RgbaImage::from_fn(16, 8, |x, y| image::Rgba([x as u8, y as u8, 7, 255]))
    }

    #[test]
    fn images_find_one_wrong_pixel_and_a_general_shift() {
        assert_eq!(compare_images("same", &picture(), &picture(), TOLERANCE), Ok(()));
        let mut spot = picture();
        spot.get_pixel_mut(3, 5).0[1] += 9;
        assert!(compare_images("spot", &picture(), &spot, TOLERANCE).is_err_and(|text| text.contains("(3, 5)")));
        let mut shifted = picture();
        shifted.pixels_mut().for_each(|pixel| pixel.0[0] += 4);
        assert!(compare_images("shifted", &picture(), &shifted, TOLERANCE).is_err());
        assert!(compare_images("small", &picture(), &RgbaImage::new(8, 8), TOLERANCE).is_err());
    }

    #[test]
    fn a_missing_golden_fails_and_a_blessed_one_passes() {
        let folder = env::temp_dir().join(format!("contrejour-goldens-{}", std::process::id()));
        let check = |bless| check_golden_in(&folder, bless, "picture", &picture(), TOLERANCE);
        assert!(check(false).is_err_and(|text| text.contains(BLESS)));
        assert_eq!(check(true), Ok(()));
        assert_eq!(check(false), Ok(()));
        fs::remove_dir_all(&folder).expect("the folder was just made");
    }
}
