//! How light grows weaker with distance and towards the rim of a cone.
//!
//! Plain functions for renderers; `shaders/shared/falloff.wgsl` has them for shaders.

/// The least distance of [`distance_falloff`] where the world is in metres. Where Karis (2013) adds 1, a centimetre takes
/// no more than a hundredth of the light from a hand's breadth on.
pub const MIN_FALLOFF_DISTANCE: f64 = 0.01;

/// What a unit of intensity at a distance sheds on a surface that faces it: the inverse square of the distance, brought
/// smoothly to nothing at the range.
///
/// Unit: 1 over world units squared. Times the light's intensity (candela, which are lumens per steradian) it is an
/// illuminance (lux, where the world is in metres). `distance` is in world units, 0 and up. `range` is in world units,
/// more than 0; infinite leaves the inverse square as it is. The square of `least_distance` is added to that of the
/// distance, so that the light at the light's centre is finite; it is in world units, more than 0,
/// [`MIN_FALLOFF_DISTANCE`] where the world is in metres. At half the range 0.88 of the inverse square is left, at
/// 0.8 of it 0.35.
///
/// saturate(1 - (d / r)^4)^2 / (d^2 + epsilon) (Karis 2013, "Real Shading in Unreal Engine 4", on lighting; epsilon is
/// 1 there).
pub fn distance_falloff(distance: f64, range: f64, least_distance: f64) -> f64 {
    let share = distance / range;
    let window = (1.0 - share * share * share * share).clamp(0.0, 1.0);
    window * window / (distance * distance + least_distance * least_distance)
}

/// How the light of a cone ends: full up to the inner angle, nothing from the outer angle on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConeFalloff {
    /// Multiplies the cosine of the angle to the axis.
    pub scale: f64,
    /// Is added then.
    pub offset: f64,
}

impl ConeFalloff {
    /// From half opening angles in radians. Range: 0 to pi, `inner` less than `outer`. An `inner` that is not gives a
    /// rim over a thousandth of one minus the cosine of `outer`; `KHR_lights_punctual` makes no rim sharper than a
    /// thousandth of a cosine, which would leave narrow cones dark.
    pub fn from_angles(inner: f64, outer: f64) -> Self {
        // Less than none would turn the cone inside out.
        const SHARPEST: f64 = 0.001;
        let scale = (inner.cos() - outer.cos()).max(SHARPEST * (1.0 - outer.cos())).recip();
        Self { scale, offset: -outer.cos() * scale }
    }

    /// What is left of the light in a direction whose angle to the cone's axis has this cosine. Range: 0 to 1.
    ///
    /// saturate(cosine * scale + offset)^2 (Khronos 2018, glTF extension `KHR_lights_punctual`, "Inner and outer cone
    /// angles").
    pub fn at(&self, cosine: f64) -> f64 {
        let share = (cosine * self.scale + self.offset).clamp(0.0, 1.0);
        share * share
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;

    fn falloff(distance: f64, range: f64) -> f64 {
        distance_falloff(distance, range, MIN_FALLOFF_DISTANCE)
    }

    #[test]
    fn near_the_light_it_is_the_inverse_square() {
        for distance in [0.2, 1.0, 3.0] {
            let ratio = falloff(distance, 1e3) * distance * distance;
            assert!((ratio - 1.0).abs() < 0.003, "{distance}: {ratio}");
        }
        assert!((falloff(5.0, f64::INFINITY) * 25.0 - 1.0).abs() < 1e-5);
    }

    #[test]
    fn the_window_has_the_shares_that_are_told() {
        let left = |share: f64| falloff(10.0 * share, 10.0) / falloff(10.0 * share, f64::INFINITY);
        assert!((left(0.5) - 0.88).abs() < 0.005, "{}", left(0.5));
        assert!((left(0.8) - 0.35).abs() < 0.005, "{}", left(0.8));
    }

    #[test]
    fn light_ends_smoothly_at_the_range() {
        assert_eq!(falloff(10.0, 10.0), 0.0);
        assert_eq!(falloff(11.0, 10.0), 0.0);
        assert_eq!(falloff(1e300, 10.0), 0.0, "far beyond all squares");
        // The window's slope is 0 at its end too: half as near, a quarter as much.
        let [near, nearer] = [0.001, 0.0005].map(|from_end| falloff(10.0 * (1.0 - from_end), 10.0));
        assert!((near / nearer - 4.0).abs() < 0.02, "{near} {nearer}");
    }

    #[test]
    fn light_is_finite_and_grows_towards_the_centre() {
        assert_eq!(falloff(0.0, 10.0), 1.0 / (MIN_FALLOFF_DISTANCE * MIN_FALLOFF_DISTANCE));
        let steps: Vec<f64> = (0..1000).map(|i| falloff(f64::from(i) * 0.01, 10.0)).collect();
        assert!(steps.is_sorted_by(|a, b| a > b));
    }

    #[test]
    fn cones_are_full_inside_and_end_at_the_outer_angle() {
        let cone = ConeFalloff::from_angles(0.3, 0.7);
        for angle in [0.0, 0.1, 0.3 - 1e-9] {
            assert_eq!(cone.at(f64::cos(angle)), 1.0, "{angle}");
        }
        for angle in [0.7 + 1e-9, 1.0, PI] {
            assert_eq!(cone.at(f64::cos(angle)), 0.0, "{angle}");
        }
        let middle = 0.5 * (0.3_f64.cos() + 0.7_f64.cos());
        assert!((cone.at(middle) - 0.25).abs() < 1e-12, "the square of a half");
        let rim: Vec<f64> = (0..100).map(|i| cone.at((0.3 + 0.004 * f64::from(i)).cos())).collect();
        assert!(rim.is_sorted_by(|a, b| a >= b));
    }

    #[test]
    fn a_narrow_cone_is_bright() {
        let cone = ConeFalloff::from_angles(0.004, 0.005);
        assert_eq!((cone.at(1.0), cone.at(0.0051_f64.cos())), (1.0, 0.0));
    }

    #[test]
    fn a_rim_without_width_is_sharp_and_finite() {
        for inner in [0.5, 0.9] {
            let cone = ConeFalloff::from_angles(inner, 0.5);
            assert!(cone.scale.is_finite() && cone.scale > 0.0);
            assert_eq!((cone.at(0.49_f64.cos()), cone.at(0.51_f64.cos())), (1.0, 0.0));
        }
    }
}
