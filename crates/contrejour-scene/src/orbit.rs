//! A light that moves around the scene.

use std::f64::consts::TAU;

use contrejour_plan::{Light, LightKind};
use glam::DQuat;

/// The light at one of `frames` even steps of a full turn about the vertical axis through what it aims at.
///
/// A spot's position turns about its target, a point light's, which aims at nothing, about the origin; the direction
/// towards a directional light turns and its centre stays. The turn is counter-clockwise as seen from above. Frame 0,
/// and every frame of an orbit of no frames, is the light itself; frames past the last go on turning.
pub fn orbit(light: &Light, frame: u32, frames: u32) -> Light {
    let step = frame.checked_rem(frames).unwrap_or(0);
    if step == 0 {
        return *light;
    }
    let turn = DQuat::from_rotation_y(TAU * f64::from(step) / f64::from(frames));
    let mut turned = *light;
    match &mut turned.kind {
        LightKind::Spot { position, target, .. } => *position = *target + turn * (*position - *target),
        LightKind::Point { position, .. } => *position = turn * *position,
        LightKind::Directional { towards_light, .. } | LightKind::Cascaded { towards_light, .. } => {
            *towards_light = turn * *towards_light;
        }
    }
    turned
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn spot() -> Light {
        let kind = LightKind::Spot {
            position: DVec3::new(5.0, 4.0, 1.0),
            target: DVec3::new(1.0, 0.5, 1.0),
            cone_angle: 1.0,
            radius: 0.1,
            near: 1.0,
            far: 10.0,
        };
        Light { kind, color: [1.0; 3] }
    }

    fn position(light: &Light) -> DVec3 {
        match light.kind {
            LightKind::Spot { position, .. } | LightKind::Point { position, .. } => position,
            LightKind::Directional { towards_light, .. } | LightKind::Cascaded { towards_light, .. } => towards_light,
        }
    }

    #[test]
    fn an_orbit_begins_with_the_light_itself_and_closes() {
        assert_eq!(orbit(&spot(), 0, 8), spot());
        assert_eq!(orbit(&spot(), 8, 8), spot());
        assert_eq!(orbit(&spot(), 3, 0), spot());
    }

    #[test]
    fn a_quarter_turn_of_a_spot_goes_round_its_target() {
        let quarter = position(&orbit(&spot(), 2, 8));
        assert!((quarter - DVec3::new(1.0, 4.0, -3.0)).length() < 1e-12, "{quarter}");
    }

    #[test]
    fn a_lamp_goes_round_the_origin() {
        let kind = LightKind::Point { position: DVec3::new(2.0, 3.0, 0.0), radius: 0.1, near: 0.1, far: 10.0 };
        let quarter = position(&orbit(&Light { kind, color: [1.0; 3] }, 1, 4));
        assert!((quarter - DVec3::new(0.0, 3.0, -2.0)).length() < 1e-12, "{quarter}");
    }

    #[test]
    fn a_sun_turns_about_the_vertical_and_keeps_its_height() {
        let kind = LightKind::Directional {
            towards_light: DVec3::new(1.0, 2.0, 0.0),
            center: DVec3::new(9.0, 9.0, 9.0),
            half_extent: 1.0,
            half_depth: 1.0,
            angular_radius: 0.0,
        };
        let half = orbit(&Light { kind, color: [1.0; 3] }, 1, 2);
        assert!((position(&half) - DVec3::new(-1.0, 2.0, 0.0)).length() < 1e-12);
    }
}
