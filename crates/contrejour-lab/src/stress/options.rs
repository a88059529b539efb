//! What a run is made of.

use std::time::Duration;

use contrejour_plan::ShadowSettings;

use super::LightMix;
use super::error::StressError;

/// What changes from frame to frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Motion {
    /// Lights and casters walk, and every fourth caster deforms.
    #[default]
    Walking,
    /// Nothing moves, and no caster deforms.
    Still,
}

/// Whether lights share a setting.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Variety {
    /// All have the same.
    #[default]
    Same,
    /// Each has its own, by the seed.
    Own,
}

/// What a run is made of.
#[derive(Clone, Debug)]
pub struct StressOptions {
    /// Lights. Range: 0 to [`MAX_LIGHTS`](Self::MAX_LIGHTS). Default: 8.
    pub lights: usize,
    /// Their kinds. Cascades follow an eye, which walks too. Default: mixed.
    pub kind: LightMix,
    /// Casters. Range: 0 to [`MAX_CASTERS`](Self::MAX_CASTERS). Default: 16.
    pub casters: usize,
    /// Triangles of each caster, nearly. Range: 8 to [`MAX_TRIANGLES`](Self::MAX_TRIANGLES). Default: 1000.
    pub triangles_per_caster: usize,
    /// What changes from frame to frame. Default: lights and casters walk.
    pub motion: Motion,
    /// How long frames are drawn. Default: 5 s.
    pub duration: Duration,
    /// As many are drawn in any case. Range: at least 1. Default: 1.
    pub least_frames: u64,
    /// How shadows are made, but for what each light has of its own.
    pub settings: ShadowSettings,
    /// Techniques: where each light has its own, three of five have smoothies, and the others take turns in the other
    /// techniques. Default: the same.
    pub techniques: Variety,
    /// Map sizes: own ones are 256 to 1024 texels. Default: the same.
    pub map_sizes: Variety,
    /// How large the lights are: own ones are points, or up to four times as large as common. Default: the same.
    pub softness: Variety,
    /// Whether frames that are taken at random are compared with exact arithmetic and with frames drawn from scratch.
    /// Default: no.
    pub verify: bool,
    /// Seed of all paths. Default: 1.
    pub seed: u64,
}

impl Default for StressOptions {
    fn default() -> Self {
        Self {
            lights: 8,
            kind: LightMix::Mixed,
            casters: 16,
            triangles_per_caster: 1000,
            motion: Motion::default(),
            duration: Duration::from_secs(5),
            least_frames: 1,
            settings: ShadowSettings::default(),
            techniques: Variety::default(),
            map_sizes: Variety::default(),
            softness: Variety::default(),
            verify: false,
            seed: 1,
        }
    }
}

impl StressOptions {
    /// Fewest triangles of a caster.
    pub const MIN_TRIANGLES: usize = 8;

    /// Most triangles of a caster.
    pub const MAX_TRIANGLES: usize = 4 << 20;

    /// Most lights.
    pub const MAX_LIGHTS: usize = 1024;

    /// Most casters.
    pub const MAX_CASTERS: usize = 1 << 16;

    /// # Errors
    ///
    /// A number is out of its range.
    pub(super) fn check(&self) -> Result<(), StressError> {
        let range = Self::MIN_TRIANGLES..=Self::MAX_TRIANGLES;
        if !range.contains(&self.triangles_per_caster) {
            return Err(StressError::Triangles { triangles: self.triangles_per_caster });
        }
        let counts = [("lights", self.lights, Self::MAX_LIGHTS), ("casters", self.casters, Self::MAX_CASTERS)];
        for (what, count, most) in counts {
            if count > most {
                return Err(StressError::TooMany { what, count, most });
            }
        }
        Ok(())
    }
}
