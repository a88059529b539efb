//! Which face of a cube a direction goes through.

use glam::DVec3;

/// A side of the cube around a point light: the view that looks along one axis of world space.
///
/// The faces tile the sphere: each direction goes through the one that [`CubeFace::of`] says, inside of its square.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CubeFace {
    /// Looks along +x.
    PositiveX,
    /// Looks along -x.
    NegativeX,
    /// Looks along +y.
    PositiveY,
    /// Looks along -y.
    NegativeY,
    /// Looks along +z.
    PositiveZ,
    /// Looks along -z.
    NegativeZ,
}

impl CubeFace {
    /// All faces, in the order of a point light's views.
    pub const ALL: [Self; 6] =
        [Self::PositiveX, Self::NegativeX, Self::PositiveY, Self::NegativeY, Self::PositiveZ, Self::NegativeZ];

    /// The face that a direction goes through: that of its largest component. Where components are equally large, x
    /// goes before y before z; where all are zero, the direction goes through the first face.
    pub fn of(direction: DVec3) -> Self {
        let size = direction.abs();
        let (axis, component) = if size.x >= size.y && size.x >= size.z {
            (0, direction.x)
        } else if size.y >= size.z {
            (1, direction.y)
        } else {
            (2, direction.z)
        };
        Self::ALL[2 * axis + usize::from(component < 0.0)]
    }

    /// Its place among a point light's views, 0 to 5.
    pub fn index(self) -> usize {
        self as usize
    }

    /// Unit direction through its middle, world space.
    pub fn axis(self) -> DVec3 {
        match self {
            Self::PositiveX => DVec3::X,
            Self::NegativeX => DVec3::NEG_X,
            Self::PositiveY => DVec3::Y,
            Self::NegativeY => DVec3::NEG_Y,
            Self::PositiveZ => DVec3::Z,
            Self::NegativeZ => DVec3::NEG_Z,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_go_through_their_faces() {
        for (index, face) in CubeFace::ALL.into_iter().enumerate() {
            assert_eq!(face.index(), index);
            assert_eq!(CubeFace::of(face.axis()), face);
            assert_eq!(CubeFace::of(1e-200 * face.axis()), face, "of any length");
        }
    }

    #[test]
    fn ties_have_an_order() {
        assert_eq!(CubeFace::of(DVec3::new(1.0, -1.0, 1.0)), CubeFace::PositiveX);
        assert_eq!(CubeFace::of(DVec3::new(-1.0, 1.0, 1.0)), CubeFace::NegativeX);
        assert_eq!(CubeFace::of(DVec3::new(0.5, -1.0, 1.0)), CubeFace::NegativeY);
        assert_eq!(CubeFace::of(DVec3::new(0.5, 1.0, -1.0)), CubeFace::PositiveY);
        assert_eq!(CubeFace::of(DVec3::ZERO), CubeFace::PositiveX);
        assert_eq!(CubeFace::of(DVec3::new(-0.0, 0.0, -0.0)), CubeFace::PositiveX);
    }
}
