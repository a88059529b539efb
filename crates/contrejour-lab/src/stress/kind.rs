//! Which lights there are.

use std::fmt;
use std::str::FromStr;

use contrejour_plan::{CascadeSettings, LightKind};
use glam::DVec3;

/// The kinds of lights of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightMix {
    /// Spot, point and directional lights, taking turns; every second directional one has cascades.
    Mixed,
    /// Point lights.
    Point,
    /// Spot lights.
    Spot,
    /// Directional lights; every second one has cascades.
    Directional,
}

/// A kind of light.
#[derive(Clone, Copy)]
enum One {
    Spot,
    Point,
    Sun,
    CascadedSun,
}

/// Maps of a light with cascades.
const CASCADES: CascadeSettings = CascadeSettings { count: 3, ..CascadeSettings::DEFAULT };

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

    /// What takes turns.
    const fn turns(self) -> &'static [One] {
        match self {
            Self::Mixed => &[One::Spot, One::Point, One::Sun, One::Spot, One::Point, One::CascadedSun],
            Self::Point => &[One::Point],
            Self::Spot => &[One::Spot],
            Self::Directional => &[One::Sun, One::CascadedSun],
        }
    }

    /// The light of an index at a place beside a room of so large a radius around the origin; `softness` is how large it is
    /// over its common size.
    pub(super) fn light(self, index: usize, place: DVec3, room: f64, softness: f64) -> LightKind {
        let turns = self.turns();
        match turns[index % turns.len()] {
            One::Point => LightKind::Point {
                position: place * (0.5 * room),
                radius: 0.01 * room * softness,
                near: 0.02 * room,
                far: 3.0 * room,
            },
            One::Sun => LightKind::Directional {
                towards_light: place,
                center: DVec3::ZERO,
                half_extent: 2.2 * room,
                half_depth: 2.5 * room,
                angular_radius: 0.01 * softness,
            },
            One::CascadedSun => {
                LightKind::Cascaded { towards_light: place, angular_radius: 0.01 * softness, cascades: CASCADES }
            }
            One::Spot => LightKind::Spot {
                position: place.normalize_or(DVec3::Y) * (2.0 * room),
                target: DVec3::ZERO,
                cone_angle: 1.2,
                radius: 0.02 * room * softness,
                near: 0.5 * room,
                far: 4.0 * room,
            },
        }
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
    use contrejour_plan::Light;

    #[test]
    fn all_lights_of_all_kinds_are_good() {
        for mix in LightMix::ALL {
            assert_eq!(mix.name().parse(), Ok(mix));
            for (index, place) in [DVec3::X, DVec3::new(-0.3, 0.2, 0.9), DVec3::NEG_Y].into_iter().enumerate() {
                for (room, softness) in [(1.0, 1.0), (30.0, 4.0), (2.0, 0.0)] {
                    let light = Light { kind: mix.light(index, place, room, softness), color: [1.0; 3] };
                    assert_eq!(light.validate(), Ok(()), "{light:?}");
                }
            }
        }
        assert!("sun".parse::<LightMix>().is_err());
    }

    #[test]
    fn every_second_sun_has_cascades() {
        let is_cascaded =
            |mix: LightMix, index| matches!(mix.light(index, DVec3::Y, 1.0, 1.0), LightKind::Cascaded { .. });
        let of_mix = |mix, count| (0..count).filter(|index| is_cascaded(mix, *index)).count();
        assert_eq!(
            [of_mix(LightMix::Directional, 8), of_mix(LightMix::Mixed, 12), of_mix(LightMix::Point, 9)],
            [4, 2, 0]
        );
    }
}
