//! What can be set about cascades.

/// What can be set about the cascades of a directional light: maps that follow the eye, each of a slice of what it
/// sees.
///
/// Nothing here has a unit, so the same numbers fit scenes of any size. How far shadows reach is the eye's farthest
/// depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CascadeSettings {
    /// Number of maps. Range: 1 to [`CascadeSettings::MAX_COUNT`]. Default: 4. Each costs the memory and the fill of a
    /// whole map.
    pub count: u32,
    /// How the slices grow: 0 makes them equally deep, 1 makes each deeper than the one before by the same factor; see
    /// [`split_depths`](crate::split_depths). Range: 0 to 1. Default: 0.75. More spends more texels near the eye.
    pub logarithmic_share: f64,
    /// The last part of each slice, in which its cascade fades into the next, and the last one out. Range: 0 to 0.5.
    /// Default: 0.1. 0 shows a line where texels change size.
    pub border_share: f64,
    /// How far in front of a slice, towards the light, casters keep their place in the depth range, as a multiple of
    /// the eye's farthest depth. Range: 0 to 1000. Default: 1. What is still nearer to the light casts too, see
    /// [`CastersInFront::Pancaked`](crate::CastersInFront::Pancaked); more makes the depth range less exact.
    pub caster_margin: f64,
}

impl CascadeSettings {
    /// The most cascades.
    pub const MAX_COUNT: u32 = 8;

    /// The largest [`CascadeSettings::border_share`].
    pub const MAX_BORDER_SHARE: f64 = 0.5;

    /// The largest [`CascadeSettings::caster_margin`].
    pub const MAX_CASTER_MARGIN: f64 = 1000.0;

    /// The defaults.
    pub const DEFAULT: Self = Self { count: 4, logarithmic_share: 0.75, border_share: 0.1, caster_margin: 1.0 };
}

impl Default for CascadeSettings {
    fn default() -> Self {
        Self::DEFAULT
    }
}
