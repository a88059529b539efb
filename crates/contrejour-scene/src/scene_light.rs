//! A light of a scene.

use contrejour_plan::{Light, LightError, LightKind, SettingsError, ShadowSettings};

/// A light in a scene: what shines, how bright it is, and how its shadow is made.
///
/// # How bright
///
/// Without an [`intensity`](Self::intensity) the colour is what the light sheds: a white surface that faces it has the
/// radiance [`Light::color`] in the picture, where 1 is white, at a spot's target, at half the farthest depth of a point
/// light, and anywhere under a directional light. So a scene is equally bright at any size, whatever its exposure.
///
/// With an intensity the light is physical, and the colour is its tint. It sheds illuminance (lux) as far as the falloff
/// takes it, and the scene's [exposure](crate::Scene::exposure_ev100) says how bright that is in the picture.
///
/// Either way a spot or a point light falls off by [`distance_falloff`](contrejour_plan::distance_falloff), and a spot
/// ends at its cone by [`ConeFalloff`](contrejour_plan::ConeFalloff).
#[derive(Clone, Debug, PartialEq)]
pub struct SceneLight {
    /// Its name in the scene, for messages.
    pub name: String,
    /// Where it is, where it shines, and its colour.
    pub light: Light,
    /// How strong it is; `None` where its colour says so. Unit: candela (lux for a directional light), with world units
    /// of metres. Range: 0 and up.
    pub intensity: Option<f64>,
    /// Distance at which its light ends; `None` where it never does. A directional light has none. Unit: world units.
    /// Range: more than 0.
    pub range: Option<f64>,
    /// Full angle within which a spot is equally bright; `None` for a rim that is soft over a tenth of one minus the
    /// cosine of half the cone. Other lights have none. Unit: radians. Range: 0 to the cone's angle.
    pub inner_cone_angle: Option<f64>,
    /// Whether it throws shadows. Default: true.
    pub casts: bool,
    /// How its shadow is made, where it throws any.
    pub shadow: ShadowSettings,
}

/// Angular radius of a directional light of which nobody says how large it is: the sun's.
pub(crate) const SUN_ANGULAR_RADIUS_DEGREES: f64 = 0.27;

/// What is wrong with a light of a scene.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SceneLightError {
    /// Its place or its colour.
    #[error(transparent)]
    Light(#[from] LightError),
    /// How its shadow is made.
    #[error(transparent)]
    Shadow(#[from] SettingsError),
    /// The intensity is negative, infinite or no number.
    #[error("the light's intensity is {intensity}: give 0 or more, in candela or, for a directional light, in lux")]
    Intensity {
        /// What it holds.
        intensity: f64,
    },
    /// The range is not above 0, infinite or no number, or the light has none.
    #[error("the light's range is {range}: give more than 0, to a spot or a point light alone")]
    Range {
        /// What it holds.
        range: f64,
    },
    /// The inner cone is wider than the cone, or the light has none.
    #[error("the inner cone angle is {radians} radians: give 0 up to the cone's angle, to a spot light alone")]
    InnerCone {
        /// What it holds.
        radians: f64,
    },
}

/// A scene has no light, and something is about one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the scene has no light; add one")]
pub struct NoLight;

impl SceneLight {
    /// A light whose colour says how bright it is, and that casts.
    pub fn new(light: Light, shadow: ShadowSettings) -> Self {
        let name = kind_name(&light.kind).to_owned();
        Self { name, light, intensity: None, range: None, inner_cone_angle: None, casts: true, shadow }
    }

    /// Checks every field against its range.
    ///
    /// # Errors
    ///
    /// The first field that is out of its range.
    pub fn validate(&self) -> Result<(), SceneLightError> {
        self.light.validate()?;
        self.shadow.validate()?;
        if let Some(intensity) = self.intensity.filter(|intensity| !(0.0..f64::INFINITY).contains(intensity)) {
            return Err(SceneLightError::Intensity { intensity });
        }
        let has_range = matches!(self.light.kind, LightKind::Spot { .. } | LightKind::Point { .. });
        let is_range = |range: f64| has_range && range > 0.0 && range.is_finite();
        if let Some(range) = self.range.filter(|range| !is_range(*range)) {
            return Err(SceneLightError::Range { range });
        }
        let widest = match self.light.kind {
            LightKind::Spot { cone_angle, .. } => cone_angle,
            _ => -1.0,
        };
        match self.inner_cone_angle.filter(|angle| !(0.0..=widest).contains(angle)) {
            Some(radians) => Err(SceneLightError::InnerCone { radians }),
            None => Ok(()),
        }
    }
}

/// What scene files call a kind of light.
pub(crate) fn kind_name(kind: &LightKind) -> &'static str {
    match kind {
        LightKind::Spot { .. } => "spot",
        LightKind::Point { .. } => "point",
        LightKind::Directional { .. } | LightKind::Cascaded { .. } => "directional",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn spot() -> SceneLight {
        let kind = LightKind::Spot {
            position: DVec3::Y,
            target: DVec3::ZERO,
            cone_angle: 1.0,
            radius: 0.1,
            near: 0.1,
            far: 10.0,
        };
        SceneLight::new(Light { kind, color: [1.0; 3] }, ShadowSettings::default())
    }

    #[test]
    fn fields_out_of_range_are_found() {
        let good = SceneLight { intensity: Some(0.0), range: Some(3.0), inner_cone_angle: Some(1.0), ..spot() };
        assert_eq!(good.validate(), Ok(()));
        for intensity in [-1.0, f64::INFINITY, f64::NAN] {
            let bad = SceneLight { intensity: Some(intensity), ..spot() };
            assert!(matches!(bad.validate(), Err(SceneLightError::Intensity { .. })), "{intensity}");
        }
        for range in [0.0, -1.0, f64::INFINITY, f64::NAN] {
            let bad = SceneLight { range: Some(range), ..spot() };
            assert!(matches!(bad.validate(), Err(SceneLightError::Range { .. })), "{range}");
        }
        for radians in [-0.1, 1.1, f64::NAN] {
            let bad = SceneLight { inner_cone_angle: Some(radians), ..spot() };
            assert!(matches!(bad.validate(), Err(SceneLightError::InnerCone { .. })), "{radians}");
        }
    }

    #[test]
    fn what_a_kind_does_not_have_is_refused() {
        let mut lamp = spot();
        lamp.light.kind = LightKind::Point { position: DVec3::Y, radius: 0.1, near: 0.1, far: 10.0 };
        assert_eq!(SceneLight { range: Some(3.0), ..lamp.clone() }.validate(), Ok(()));
        let inner = SceneLight { inner_cone_angle: Some(0.0), ..lamp.clone() };
        assert_eq!(inner.validate(), Err(SceneLightError::InnerCone { radians: 0.0 }));
        lamp.light.kind = LightKind::Directional {
            towards_light: DVec3::Y,
            center: DVec3::ZERO,
            half_extent: 1.0,
            half_depth: 1.0,
            angular_radius: 0.0,
        };
        assert_eq!(SceneLight { range: Some(3.0), ..lamp }.validate(), Err(SceneLightError::Range { range: 3.0 }));
    }
}
