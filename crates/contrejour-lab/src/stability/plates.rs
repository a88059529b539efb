//! A plate over a floor, both across the light's axis, looked at from aside: every depth is even, so that truth and
//! definitions are easy to say.

use contrejour_plan::{Light, LightKind, views};
use contrejour_scene::Camera;
use glam::DVec3;

use super::case::{Case, CaseMesh};

/// Height of the lamp over the floor.
pub(super) const LAMP: f64 = 6.0;

/// Full opening angle of the lamp's cone. Unit: radians.
pub(super) const CONE: f64 = 0.9;

/// Half the side of the square that parallel light shadows.
pub(super) const HALF_EXTENT: f64 = 2.9;

/// Radius of the lamp's disk, where a family does not vary it.
pub(super) const LAMP_RADIUS: f64 = 0.1;

/// Angular radius of parallel light, where a family does not vary it. Unit: radians.
pub(super) const SKY_RADIUS: f64 = 0.017;

/// Half the side of the plate.
pub(super) const PLATE: f64 = 0.6;

/// Half the side of the floor.
const FLOOR: f64 = 2.5;

/// Height of the plate where a family does not vary it.
pub(super) const HEIGHT: f64 = 1.5;

/// The plate at a height over the floor.
pub(super) fn plate_over_floor(parameter: String, at: f64, height: f64, light: Light) -> Case {
    let mut case = Case::new(parameter, at, sheet(PLATE, height), light);
    case.meshes.push(sheet(FLOOR, 0.0));
    case.seen_from = Some(aside());
    let share = penumbra_share(height, &light);
    if share > 0.05 {
        case.explain_error(
            (case.visibility_error_max + share).min(0.55),
            "the light reaches behind the plate by more than a twentieth of the shadow: the true umbra is so much smaller, \
             while smoothies make the outer penumbra alone",
        );
    }
    case
}

/// Half of the true penumbra's width, over half the side of what the map holds of the plate's shadow.
fn penumbra_share(height: f64, light: &Light) -> f64 {
    let Ok(views) = views(light) else { return 0.0 };
    let (view, blocker) = (&views[0], LAMP - height);
    let half_penumbra = view.light_size * (view.q_of_depth(LAMP) - view.q_of_depth(blocker));
    let plate = match light.kind {
        LightKind::Spot { cone_angle, .. } => PLATE / (blocker * (0.5 * cone_angle).tan()),
        LightKind::Point { .. } => PLATE / blocker,
        LightKind::Directional { half_extent, .. } => PLATE / half_extent,
        // Without an eye it has no views above.
        LightKind::Cascaded { .. } => return 0.0,
    };
    half_penumbra / plate.min(1.0)
}

/// A camera that sees plate, floor and shadow.
pub(super) fn aside() -> Camera {
    Camera {
        eye: DVec3::new(2.5, 3.2, 3.6),
        target: DVec3::new(0.1, 0.2, 0.0),
        up: DVec3::Y,
        fov_y: 0.73,
        near: 0.1,
        far: 30.0,
    }
}

/// A lamp over the middle with a disk of a radius.
pub(super) fn lamp(radius: f64) -> Light {
    let kind = LightKind::Spot {
        position: DVec3::new(0.0, LAMP, 0.0),
        target: DVec3::ZERO,
        cone_angle: CONE,
        radius,
        near: 1.0,
        far: 8.0,
    };
    Light { kind, color: [1.0; 3] }
}

/// A point light where the lamp is.
pub(super) fn bulb(radius: f64) -> Light {
    let kind = LightKind::Point { position: DVec3::new(0.0, LAMP, 0.0), radius, near: 1.0, far: 8.0 };
    Light { kind, color: [1.0; 3] }
}

/// Parallel light from above with an angular radius.
pub(super) fn sky(angular_radius: f64) -> Light {
    let kind = LightKind::Directional {
        towards_light: DVec3::Y,
        center: DVec3::ZERO,
        half_extent: HALF_EXTENT,
        half_depth: LAMP,
        angular_radius,
    };
    Light { kind, color: [1.0; 3] }
}

/// Both, with what the table calls them; penumbrae are about as wide.
pub(super) fn lamp_and_sky() -> [(&'static str, Light); 2] {
    [("spot", lamp(LAMP_RADIUS)), ("parallel", sky(SKY_RADIUS))]
}

/// Two triangles that face upwards.
pub(super) fn sheet(half: f64, height: f64) -> CaseMesh {
    let corner = |x: f64, z: f64| DVec3::new(half * x, height, half * z).as_vec3().to_array();
    let positions = vec![corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)];
    CaseMesh::new(positions, vec![[0, 1, 2], [0, 2, 3]])
}
