//! Which lights there are.

use std::fmt;
use std::str::FromStr;

use contrejour_plan::{Light, LightKind};
use glam::DVec3;

/// The kinds of lights of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightMix {
    /// Spot, point and directional lights, taking turns.
    Mixed,
    /// Point lights.
    Point,
    /// Spot lights.
    Spot,
    /// Directional lights.
    Directional,
}

impl LightMix {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Mixed, Self::Point, Self::Spot, Self::Directional];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mixed => "mixed",
            Self::Point => "point",
            Self::Spot => "spot",
            Self::Directional => "directional",
        }
    }

    /// The light of an index at a place beside a room of so large a radius around the origin.
    pub(super) fn light(self, index: usize, place: DVec3, room: f64) -> Light {
        let one = match self {
            Self::Mixed => [Self::Spot, Self::Point, Self::Directional][index % 3],
            one => one,
        };
        let kind = match one {
            Self::Point => LightKind::Point {
                position: place * (0.5 * room),
                radius: 0.01 * room,
                near: 0.02 * room,
                far: 3.0 * room,
            },
            Self::Directional => LightKind::Directional {
                towards_light: place,
                center: DVec3::ZERO,
                half_extent: 2.2 * room,
                half_depth: 2.5 * room,
                angular_radius: 0.01,
            },
            Self::Spot | Self::Mixed => LightKind::Spot {
                position: place.normalize_or(DVec3::Y) * (2.0 * room),
                target: DVec3::ZERO,
                cone_angle: 1.2,
                radius: 0.02 * room,
                near: 0.5 * room,
                far: 4.0 * room,
            },
        };
        Light { kind, color: [1.0; 3] }
    }
}

impl fmt::Display for LightMix {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.pad(self.name())
    }
}

impl FromStr for LightMix {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let known = Self::ALL.into_iter().find(|mix| mix.name() == name);
        known.ok_or_else(|| format!("there is no kind {name:?}: give mixed, point, spot or directional"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_lights_of_all_kinds_are_good() {
        for mix in LightMix::ALL {
            assert_eq!(mix.name().parse(), Ok(mix));
            for (index, place) in [DVec3::X, DVec3::new(-0.3, 0.2, 0.9), DVec3::NEG_Y].into_iter().enumerate() {
                for room in [1.0, 30.0] {
                    let light = mix.light(index, place, room);
                    assert_eq!(light.validate(), Ok(()), "{light:?}");
                }
            }
        }
        assert!("sun".parse::<LightMix>().is_err());
    }
}
