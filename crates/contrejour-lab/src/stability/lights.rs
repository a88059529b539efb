//! Lights around a ball that holds what is to be shadowed.

use contrejour_plan::{Light, LightKind};
#[cfg(test)]
use contrejour_plan::{ShadowSettings, View, frame_views};
use glam::DVec3;

/// Where lights stand, as seen from the middle: off every axis and plane that meshes are built along.
pub(super) const ASIDE: DVec3 = DVec3::new(0.36, 0.8, 0.48);

/// Half the opening of the smallest cone around the ball as seen from 2.5 radii, with a margin.
const SPOT_DISTANCE: f64 = 2.5;

/// A spot 2.5 radii from the middle of a ball that it holds. Its disk makes smoothies a few texels wide.
pub(super) fn spot(middle: DVec3, radius: f64) -> Light {
    spot_from(middle + SPOT_DISTANCE * radius * ASIDE.normalize(), middle, radius)
}

/// A spot at a point outside of a ball, which it holds.
pub(super) fn spot_from(position: DVec3, middle: DVec3, radius: f64) -> Light {
    let distance = position.distance(middle);
    let kind = LightKind::Spot {
        position,
        target: middle,
        cone_angle: 2.0 * (1.3 * radius).atan2(distance),
        radius: 0.03 * radius,
        near: distance - 1.1 * radius,
        far: distance + 1.1 * radius,
    };
    Light { kind, color: [1.0; 3] }
}

/// Parallel light on a ball. The direction points towards the light.
pub(super) fn sun(towards_light: DVec3, middle: DVec3, radius: f64) -> Light {
    let kind = LightKind::Directional {
        towards_light,
        center: middle,
        half_extent: 1.2 * radius,
        half_depth: 1.2 * radius,
        angular_radius: 0.03,
    };
    Light { kind, color: [1.0; 3] }
}

/// A spot and parallel light from the same side, with what the table calls them.
pub(super) fn both(middle: DVec3, radius: f64) -> [(&'static str, Light); 2] {
    [("spot", spot(middle, radius)), ("parallel", sun(ASIDE, middle, radius))]
}

/// The views of both, and that of a lamp in the spot's place which shows the ball across two borders.
#[cfg(test)]
pub(super) fn views_of_all_kinds(middle: DVec3, radius: f64) -> Vec<(&'static str, View)> {
    let view = |light: Light, view: usize| {
        frame_views(&light, None, &ShadowSettings::default()).expect("a good light").views[view]
    };
    let kind = LightKind::Point {
        position: middle + 2.0 * radius * ASIDE.normalize(),
        radius: 0.03 * radius,
        near: 0.3 * radius,
        far: 4.0 * radius,
    };
    let lamp = Light { kind, color: [1.0; 3] };
    let below = view(lamp, contrejour_plan::CubeFace::NegativeY.index());
    both(middle, radius).map(|(name, light)| (name, view(light, 0))).into_iter().chain([("point", below)]).collect()
}

/// The same light whose farthest depth is another one: a frame that must be drawn and finds the same faces lit.
pub(super) fn with_another_depth(light: &Light) -> Light {
    let mut other = *light;
    match &mut other.kind {
        LightKind::Spot { far, .. } | LightKind::Point { far, .. } => *far *= 1.0625,
        LightKind::Directional { half_depth, .. } => *half_depth *= 1.0625,
        LightKind::Cascaded { cascades, .. } => cascades.caster_margin *= 1.0625,
    }
    other
}
