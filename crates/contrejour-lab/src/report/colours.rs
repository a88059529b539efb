//! Visibilities and their differences as pictures.

use image::{Rgba, RgbaImage};

use crate::metrics::MetricError;

/// Colours of differences from -1 (too dark) by 0 (equal) to 1 (too light), evenly spaced. Blue and orange are told
/// apart with every common kind of colour blindness, and both darken alike towards their ends, so that a grey print
/// still shows how much.
const DIFFERENCE_COLOURS: [[u8; 3]; 7] =
    [[3, 44, 104], [33, 102, 172], [125, 181, 222], [232, 232, 230], [244, 170, 90], [198, 96, 9], [108, 46, 4]];

/// Colour of a difference of visibility, technique less truth, from -1 to 1. Strength follows the root of the
/// difference: 0.04 is a fifth of the way to the end, so that small errors can be seen.
pub fn difference_colour(difference: f32) -> [u8; 3] {
    let strength = difference.abs().min(1.0).sqrt().copysign(difference);
    let middle = (DIFFERENCE_COLOURS.len() / 2) as f32;
    let place = middle + middle * strength;
    let below = (place as usize).min(DIFFERENCE_COLOURS.len() - 2);
    let share = place - below as f32;
    let [from, to] = [DIFFERENCE_COLOURS[below], DIFFERENCE_COLOURS[below + 1]];
    [0, 1, 2].map(|i| (f32::from(from[i]) + share * (f32::from(to[i]) - f32::from(from[i]))).round() as u8)
}

/// Where a technique is too dark (blue), too light (orange) or right (light grey), by [`difference_colour`]. Pixels
/// that are no receivers are transparent.
///
/// # Errors
///
/// Slices whose lengths are not width times height.
pub fn difference_picture(
    size: [u32; 2],
    truth: &[f32],
    technique: &[f32],
    receivers: &[bool],
) -> Result<RgbaImage, MetricError> {
    check_pixels("the technique", technique.len(), truth.len())?;
    picture(size, receivers, truth.len(), |pixel| difference_colour(technique[pixel] - truth[pixel]))
}

/// Visibility as grey: 0 is black, 1 is white, evenly between. Pixels that are no receivers are transparent.
///
/// # Errors
///
/// Slices whose lengths are not width times height.
pub fn visibility_picture(size: [u32; 2], visibility: &[f32], receivers: &[bool]) -> Result<RgbaImage, MetricError> {
    let grey = |pixel: usize| [(visibility[pixel] * 255.0).round() as u8; 3];
    picture(size, receivers, visibility.len(), grey)
}

fn picture(
    [width, height]: [u32; 2],
    receivers: &[bool],
    values: usize,
    colour: impl Fn(usize) -> [u8; 3],
) -> Result<RgbaImage, MetricError> {
    let pixels = width as usize * height as usize;
    check_pixels("the picture", pixels, values)?;
    check_pixels("the mask of receivers", receivers.len(), values)?;
    Ok(RgbaImage::from_fn(width, height, |x, y| {
        let pixel = y as usize * width as usize + x as usize;
        let [r, g, b] = colour(pixel);
        if receivers[pixel] { Rgba([r, g, b, 255]) } else { Rgba([0; 4]) }
    }))
}

fn check_pixels(what: &'static str, found: usize, expected: usize) -> Result<(), MetricError> {
    if found == expected { Ok(()) } else { Err(MetricError::Length { what, found, expected }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_and_middle_are_the_stated_colours() {
        assert_eq!(difference_colour(-1.0), DIFFERENCE_COLOURS[0]);
        assert_eq!(difference_colour(0.0), DIFFERENCE_COLOURS[3]);
        assert_eq!(difference_colour(1.0), DIFFERENCE_COLOURS[6]);
        // A ninth has a third of the strength.
        assert_eq!(difference_colour(1.0 / 9.0), DIFFERENCE_COLOURS[4]);
        // Beyond the range nothing else comes.
        assert_eq!(difference_colour(-2.0), DIFFERENCE_COLOURS[0]);
    }

    #[test]
    fn strength_grows_alike_both_ways() {
        let luminance = |[r, g, b]: [u8; 3]| 0.2126 * f32::from(r) + 0.7152 * f32::from(g) + 0.0722 * f32::from(b);
        for step in 1..=100_u8 {
            let [less, more] = [step - 1, step].map(|step| f32::from(step) / 100.0);
            for sign in [-1.0, 1.0] {
                assert!(luminance(difference_colour(sign * more)) < luminance(difference_colour(sign * less)));
            }
            let apart = luminance(difference_colour(more)) - luminance(difference_colour(-more));
            assert!(apart.abs() < 20.0, "{more}: {apart}");
        }
    }

    #[test]
    fn too_dark_is_blue_and_too_light_is_orange() {
        let picture = difference_picture([3, 1], &[1.0, 0.5, 0.0], &[0.0, 0.5, 1.0], &[true; 3]);
        let picture = picture.expect("the sizes agree");
        let [dark, equal, light] = [0, 1, 2].map(|x| picture[(x, 0)].0);
        assert!(dark[2] > dark[0] && light[0] > light[2] && equal[0].abs_diff(equal[2]) < 5);
        let exchanged = difference_picture([3, 1], &[0.0, 0.5, 1.0], &[1.0, 0.5, 0.0], &[true; 3]);
        assert_ne!(picture, exchanged.expect("the sizes agree"));
    }

    #[test]
    fn what_receives_nothing_is_transparent() {
        let picture = visibility_picture([2, 2], &[0.0, 1.0, 0.5, f32::NAN], &[true, true, true, false]);
        let picture = picture.expect("the sizes agree");
        assert_eq!(picture.as_raw(), &[0, 0, 0, 255, 255, 255, 255, 255, 128, 128, 128, 255, 0, 0, 0, 0]);
    }

    #[test]
    fn other_sizes_are_refused() {
        let error = |what, found, expected| Err(MetricError::Length { what, found, expected });
        assert_eq!(visibility_picture([2, 2], &[0.0; 3], &[true; 3]), error("the picture", 4, 3));
        assert_eq!(visibility_picture([2, 2], &[0.0; 4], &[true; 3]), error("the mask of receivers", 3, 4));
        assert_eq!(difference_picture([2, 2], &[0.0; 4], &[0.0; 3], &[true; 4]), error("the technique", 3, 4));
    }
}
