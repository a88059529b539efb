//! The camera that cascades follow.

use core::f64::consts::PI;

use glam::DVec3;

/// The camera whose view is shadowed by cascades. Which way is up in it does not matter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eye {
    /// Position, world space.
    pub position: DVec3,
    /// What it looks along, world space; any length but zero.
    pub forward: DVec3,
    /// Full vertical opening angle. Range: more than 0 and less than pi.
    pub fov_y: f64,
    /// Width of the picture over its height. Range: more than 0.
    pub aspect: f64,
    /// Nearest depth that is seen, world units. Range: more than 0.
    pub near: f64,
    /// Farthest depth that is shadowed, world units: the camera's far plane, or less. Range: more than `near`. Texels
    /// are spread over all of it: half of it has them half as large.
    pub far: f64,
}

/// What is wrong with an eye.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the eye's {field} is {value}: give {range}")]
pub struct EyeError {
    /// Name of the field.
    pub field: &'static str,
    /// What it holds.
    pub value: f64,
    /// What it may hold.
    pub range: &'static str,
}

/// Numbers that are squared, or get a size in 32-bit floats together with others.
const LARGEST: f64 = 1e30;
const SMALLEST: f64 = 1e-30;

impl Eye {
    /// Depth of a point: distance along the axis. Unit: world; negative behind the eye.
    pub fn depth_of(&self, point_world: DVec3) -> f64 {
        self.axis_world().dot(point_world - self.position)
    }

    /// Unit direction of the axis in world space.
    pub fn axis_world(&self) -> DVec3 {
        super::view::unit(self.forward)
    }

    /// Half the diagonal of the picture at depth 1: no point in view is farther from the axis.
    pub(super) fn half_diagonal(&self) -> f64 {
        (self.fov_y / 2.0).tan() * self.aspect.hypot(1.0)
    }

    /// Checks every field against its range.
    ///
    /// # Errors
    ///
    /// The first field that is out of its range.
    pub fn validate(&self) -> Result<(), EyeError> {
        const FINITE: &str = "finite numbers up to 1e30";
        const SIZE: &str = "a number from 1e-30 to 1e30";
        let require = |holds: bool, field, value, range| match holds {
            true => Ok(()),
            false => Err(EyeError { field, value, range }),
        };
        let is_size = |value: f64| (SMALLEST..=LARGEST).contains(&value);
        for value in self.position.to_array() {
            require(value.abs() <= LARGEST, "position", value, FINITE)?;
        }
        for value in self.forward.to_array() {
            require(value.is_finite(), "forward", value, "a finite vector other than zero")?;
        }
        require(self.forward != DVec3::ZERO, "forward", 0.0, "a finite vector other than zero")?;
        require(self.fov_y > 0.0 && self.fov_y < PI, "fov_y", self.fov_y, "radians, more than 0 and less than pi")?;
        require(is_size(self.aspect), "aspect", self.aspect, SIZE)?;
        require(is_size(self.near), "near", self.near, SIZE)?;
        require(is_size(self.far) && self.near < self.far, "far", self.far, "more than near, up to 1e30")?;
        let [near, far] = [self.near, self.far].map(|depth| depth * self.half_diagonal());
        require(is_size(near), "near corner's distance from the axis", near, "a larger near, fov_y or aspect")?;
        require(is_size(far), "far corner's distance from the axis", far, "a smaller far, fov_y or aspect")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EYE: Eye = Eye { position: DVec3::ONE, forward: DVec3::NEG_Z, fov_y: 1.0, aspect: 1.6, near: 0.1, far: 50.0 };

    #[test]
    fn each_bad_field_has_its_error() {
        assert_eq!(EYE.validate(), Ok(()));
        for (field, eye) in [
            ("position", Eye { position: DVec3::new(0.0, f64::NAN, 0.0), ..EYE }),
            ("position", Eye { position: DVec3::new(0.0, -1e31, 0.0), ..EYE }),
            ("forward", Eye { forward: DVec3::ZERO, ..EYE }),
            ("forward", Eye { forward: DVec3::new(f64::INFINITY, 0.0, 0.0), ..EYE }),
            ("fov_y", Eye { fov_y: 0.0, ..EYE }),
            ("fov_y", Eye { fov_y: PI, ..EYE }),
            ("aspect", Eye { aspect: -1.0, ..EYE }),
            ("near", Eye { near: 0.0, ..EYE }),
            ("far", Eye { far: 0.1, ..EYE }),
            ("far", Eye { far: f64::NAN, ..EYE }),
            ("near corner's distance from the axis", Eye { near: 1e-30, fov_y: 1e-3, ..EYE }),
            ("far corner's distance from the axis", Eye { far: 1e30, fov_y: 3.0, ..EYE }),
        ] {
            let error = eye.validate().expect_err("out of range");
            assert_eq!(error.field, field, "{error}");
        }
    }

    #[test]
    fn depth_is_measured_along_the_axis() {
        assert!((EYE.depth_of(DVec3::new(7.0, -3.0, -4.0)) - 5.0).abs() < 1e-12);
        let far_away = Eye { forward: DVec3::splat(1e200), ..EYE };
        assert!((far_away.depth_of(DVec3::splat(2.0)) - 3.0_f64.sqrt()).abs() < 1e-12);
    }
}
