//! Cones from a needle to all that a plane can show.

use std::f64::consts::PI;

use contrejour_plan::{LightKind, views};
use glam::DVec3;

use super::super::case::{Case, CaseMesh};
use super::super::effort::Effort;
use super::super::family::Family;
use super::super::plates::{HEIGHT, LAMP, aside, lamp, plate_over_floor};
use crate::report::Scale;

pub(super) const CONE_ANGLES: Family = Family {
    name: "cone-angles",
    stresses: "The cone of a spot over the corner of a plate opens from a needle to nearly half of all directions.",
    parameter: "tangent of half the cone",
    scale: Scale::Log,
    cases,
};

/// Degrees that a user may try, and what is left to 180.
const WIDE: [f64; 10] = [1.0, 10.0, 60.0, 120.0, 170.0, 179.0, 179.9, 179.99, 179.9999, 180.0];

fn cases(effort: &Effort) -> Vec<Case> {
    let narrow =
        effort.powers_of_ten(-37, -3, 2).into_iter().map(|(name, degrees)| (format!("{name} degrees"), degrees));
    let wide = WIDE.into_iter().map(|degrees| (format!("{degrees} degrees"), degrees));
    narrow.chain(wide).map(|(name, degrees)| case(name, degrees.to_radians())).collect()
}

fn case(name: String, cone: f64) -> Case {
    let mut light = lamp(0.05);
    if let LightKind::Spot { cone_angle, .. } = &mut light.kind {
        *cone_angle = cone;
    }
    let tangent = (0.5 * cone).tan();
    let mut case = plate_over_floor(name, tangent, HEIGHT, light);
    // The plate's corner lies on the axis, so that the narrowest cone sees both its sides.
    case.meshes[0] = at_corner(&case.meshes[0]);
    let shown = (2.0 * LAMP * tangent).min(4.0);
    let mut camera = aside();
    camera.target = DVec3::ZERO;
    camera.fov_y = 2.0 * (0.5 * shown / camera.eye.length()).atan();
    case.seen_from = Some(camera);
    explain(&mut case);
    case.refusal_is_due = cone < f64::from(f32::MIN_POSITIVE) || cone >= PI;
    case
}

fn at_corner(mesh: &CaseMesh) -> CaseMesh {
    let corner = mesh.positions[0];
    let moved = |position: &[f32; 3]| [position[0] - corner[0], position[1], position[2] - corner[2]];
    CaseMesh::new(mesh.positions.iter().map(moved).collect(), mesh.triangles.clone())
}

fn explain(case: &mut Case) {
    let Ok(views) = views(&case.light) else { return };
    let view = &views[0];
    if view.light_size / (LAMP - HEIGHT) > 2.0 {
        case.explain_error(0.5, "the cone sees less than the smoothie, whose width is held to the map's side");
    }
    if view.texel_world(case.settings.map_size) * LAMP > 0.1 * HEIGHT {
        case.explain_error(
            0.45,
            "a texel is larger than a tenth of the plate's height: its depth bias swallows the shadow",
        );
    }
}
