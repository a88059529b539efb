//! Values on the command line.

use contrejour_plan::{DepthPrecision, SmoothieWidth};
use contrejour_scene::Scene;

/// `x,y,z`: three finite numbers, straight to `f32`.
pub fn parse_vector(text: &str) -> Result<[f32; 3], String> {
    let numbers = text.split(',').map(parse_finite).collect::<Result<Vec<_>, _>>()?;
    numbers
        .try_into()
        .map_err(|numbers: Vec<f32>| format!("three numbers are needed, as in 1,2.5,-3, not {}", numbers.len()))
}

fn parse_finite(text: &str) -> Result<f32, String> {
    let number: f32 = text.trim().parse().map_err(|_| format!("{text:?} is no number"))?;
    if number.is_finite() { Ok(number) } else { Err(format!("{text:?} is no finite 32-bit number")) }
}

/// A time from 0 on, in seconds.
pub fn parse_seconds(text: &str) -> Result<f64, String> {
    let seconds: f64 = text.trim().parse().map_err(|_| format!("{text:?} is no number"))?;
    if seconds.is_finite() && seconds >= 0.0 {
        Ok(seconds)
    } else {
        Err("give seconds from 0 on, as in 1.5".to_owned())
    }
}

/// `WxH` in pixels.
pub fn parse_size(text: &str) -> Result<[u32; 2], String> {
    let side = |text: &str| text.parse::<u32>().ok().filter(|side| (1..=Scene::MAX_SIDE).contains(side));
    (text.split_once(['x', 'X']))
        .and_then(|(width, height)| Some([side(width)?, side(height)?]))
        .ok_or_else(|| format!("give width and height as in 1280x720, each from 1 to {}", Scene::MAX_SIDE))
}

/// A part of the light's image plane, or `light`.
pub fn parse_width(text: &str) -> Result<SmoothieWidth, String> {
    match text {
        "light" => Ok(SmoothieWidth::FromLightSize),
        number => parse_finite(number).map(SmoothieWidth::Ndc),
    }
}

/// How many seconds something lasts: more than 0, up to a day.
pub fn parse_duration(text: &str) -> Result<f64, String> {
    let seconds: f64 = text.parse().map_err(|_| format!("{text:?} is no number"))?;
    if seconds > 0.0 && seconds <= 86_400.0 {
        Ok(seconds)
    } else {
        Err("give more than 0 and up to 86400 seconds".into())
    }
}

/// `NAME=NUMBER`.
pub fn parse_assignment(text: &str) -> Result<(String, f64), String> {
    let (name, number) = text.split_once('=').ok_or("give a name and a number, as in filter_samples=64")?;
    let value: f64 = number.trim().parse().map_err(|_| format!("{number:?} is no number"))?;
    Ok((name.trim().to_owned(), value))
}

/// 16 or 32.
pub fn parse_depth_bits(text: &str) -> Result<DepthPrecision, String> {
    match text {
        "16" => Ok(DepthPrecision::Bits16),
        "32" => Ok(DepthPrecision::Bits32),
        _ => Err("give 16 or 32".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors() {
        assert_eq!(parse_vector("1,-2.5, 3e-4"), Ok([1.0, -2.5, 3e-4]));
        // One rounding: by way of f64 this would be 1.0.
        assert_eq!(parse_vector("1.000000059604644775390625001,0,0"), Ok([1.000_000_1, 0.0, 0.0]));
        for text in ["1,2", "1,2,3,4", "", "1,2,x", "1,,3", "nan,0,0", "inf,0,0", "0,-inf,0", "1e40,0,0"] {
            assert!(parse_vector(text).is_err(), "{text}");
        }
    }

    #[test]
    fn sizes() {
        assert_eq!(parse_size("1280x720"), Ok([1280, 720]));
        for text in ["1280", "x720", "0x1", "1x0", "-1x2", "99999x1", "1x2x3"] {
            assert!(parse_size(text).is_err(), "{text}");
        }
    }

    #[test]
    fn seconds() {
        assert_eq!(parse_seconds("1.5"), Ok(1.5));
        for text in ["-1", "nan", "inf", "", "1s"] {
            assert!(parse_seconds(text).is_err(), "{text}");
        }
    }

    #[test]
    fn widths() {
        assert_eq!(parse_width("light"), Ok(SmoothieWidth::FromLightSize));
        assert_eq!(parse_width("0.02"), Ok(SmoothieWidth::Ndc(0.02)));
        assert!(parse_width("nan").is_err());
    }

    #[test]
    fn assignments() {
        assert_eq!(parse_assignment("kernel = 5"), Ok(("kernel".to_owned(), 5.0)));
        for text in ["kernel", "kernel=", "kernel=x"] {
            assert!(parse_assignment(text).is_err(), "{text}");
        }
    }
}
