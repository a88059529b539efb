//! From the unit square to the unit disk.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use glam::DVec2;

/// The concentric map of the square 0..1 to the unit disk, which keeps areas and neighbours (Shirley & Chiu 1997).
pub(crate) fn disk_from_square(square: DVec2) -> DVec2 {
    let centred = 2.0 * square - 1.0;
    if centred == DVec2::ZERO {
        return DVec2::ZERO;
    }
    let (radius, angle) = if centred.x.abs() > centred.y.abs() {
        (centred.x, FRAC_PI_4 * centred.y / centred.x)
    } else {
        (centred.y, FRAC_PI_2 - FRAC_PI_4 * centred.x / centred.y)
    };
    radius * DVec2::from_angle(angle)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn areas_are_kept() {
        // The concentric square of side s falls on the disk of radius s, which has the same part of the area.
        let steps = 200;
        for s in [0.25_f64, 0.5, 0.9] {
            let cells = (0..steps * steps).map(|i| {
                let cell = DVec2::new(f64::from(i % steps), f64::from(i / steps));
                disk_from_square((cell + 0.5) / f64::from(steps))
            });
            let inside = cells.filter(|point| point.length() < s).count();
            let part = inside as f64 / f64::from(steps * steps);
            assert!((part - s * s).abs() < 0.01, "{s}: {part}");
        }
    }

    #[test]
    fn neighbours_are_kept_and_the_rim_is_reached() {
        let at = |x, y| disk_from_square(DVec2::new(x, y));
        assert!((at(0.0, 0.0).length() - 1.0).abs() < 1e-15);
        assert!((at(1.0, 0.3).length() - 1.0).abs() < 1e-15);
        assert_eq!(at(0.5, 0.5), DVec2::ZERO);
        for x in [0.1, 0.3, 0.7] {
            assert!(at(x, x - 1e-9).distance(at(x, x + 1e-9)) < 1e-8, "across the diagonal");
            assert!(at(x, 1.0 - x - 1e-9).distance(at(x, 1.0 - x + 1e-9)) < 1e-8, "across the other");
        }
    }
}
