//! Edges that project to a point, neighbours whose images coincide, turns of almost half a circle, edges that cross the
//! near plane and the plane of the light.

use contrejour_plan::{Light, LightKind};
use glam::DVec3;

use super::super::case::{Case, CaseMesh};
use super::super::effort::Effort;
use super::super::family::Family;
use super::super::lights::{spot_from, sun};
use super::super::meshes::{RING_RADIUS, ring};
use crate::report::Scale;

pub(super) const POINT_EDGES: Family = Family {
    name: "point-edges",
    stresses: "A prism and a pyramid without its top whose side edges point at the light, but for an angle.",
    parameter: "angle between side edges and light, radians (0 is left out of the plots)",
    scale: Scale::Log,
    cases: point_edges,
};

pub(super) const COINCIDENT: Family = Family {
    name: "coincident-edges",
    stresses: "Folded sheets with a vertex from which two outline edges go in nearly and exactly the same direction of \
               the image.",
    parameter: "angle between the images of two neighbours, radians (0 is left out of the plots)",
    scale: Scale::Log,
    cases: coincident,
};

pub(super) const SHARP_TURNS: Family = Family {
    name: "sharp-turns",
    stresses: "Spikes whose outline turns by almost half a circle at the tip.",
    parameter: "angle of the spikes, radians",
    scale: Scale::Log,
    cases: sharp_turns,
};

pub(super) const NEAR_PLANE: Family = Family {
    name: "near-plane",
    stresses: "The near plane comes from the light, reaches the mesh and passes through it.",
    parameter: "near depth over the distance of the mesh's middle",
    scale: Scale::Log,
    cases: near_plane,
};

pub(super) const BEHIND_LIGHT: Family = Family {
    name: "behind-light",
    stresses: "Faces with one corner at, beside and behind the plane through the light across its axis, where w is 0.",
    parameter: "the case's number",
    scale: Scale::Linear,
    cases: behind_light,
};

/// Sides of the prism.
const SIDES: u32 = 12;

fn point_edges(effort: &Effort) -> Vec<Case> {
    let straight = [("0".to_owned(), 0.0)];
    let angles = straight.into_iter().chain(effort.powers_of_ten(-9, -1, 1));
    let light = DVec3::new(0.3, 3.0, -0.2);
    let cases = angles.flat_map(|(name, angle)| {
        let off = DVec3::new(angle, 0.0, 0.7 * angle);
        let prism = frustum(|bottom| bottom + DVec3::new(0.25, 0.5, 0.125));
        let parallel = sun(DVec3::new(0.25, 0.5, 0.125) + 0.57 * off, DVec3::ZERO, 1.3);
        let pyramid = frustum(|bottom| bottom.lerp(light, 0.25));
        let spot = spot_from(light + 3.0 * off, DVec3::ZERO, 1.3);
        [("prism", prism, parallel), ("pyramid", pyramid, spot)]
            .map(|(mesh_name, mesh, light)| Case::new(format!("{name}, {mesh_name}"), angle, mesh, light))
    });
    cases.collect()
}

/// A closed body between a polygon and its image on top.
fn frustum(top: impl Fn(DVec3) -> DVec3) -> CaseMesh {
    let bottom = |index: u32| {
        let (sin, cos) = (std::f64::consts::TAU * (f64::from(index) + 0.2) / f64::from(SIDES)).sin_cos();
        DVec3::new(0.8 * cos, -0.4, -0.8 * sin)
    };
    let mut positions: Vec<_> = (0..SIDES).map(bottom).collect();
    positions.extend((0..SIDES).map(|index| top(bottom(index))));
    let mut triangles = Vec::new();
    for index in 0..SIDES {
        let next = (index + 1) % SIDES;
        triangles.extend([[index, next, SIDES + next], [index, SIDES + next, SIDES + index]]);
    }
    for index in 2..SIDES {
        triangles.extend([[0, index, index - 1], [SIDES, SIDES + index - 1, SIDES + index]]);
    }
    rounded(&positions, triangles)
}

fn rounded(positions: &[DVec3], triangles: Vec<[u32; 3]>) -> CaseMesh {
    CaseMesh::new(positions.iter().map(|position| position.as_vec3().to_array()).collect(), triangles)
}

fn coincident(effort: &Effort) -> Vec<Case> {
    let same = [("0".to_owned(), 0.0)];
    let angles = same.into_iter().chain(effort.powers_of_ten(-9, -1, 1));
    let light = DVec3::new(0.1, 4.0, 0.2);
    let cases = angles.flat_map(|(name, angle)| {
        let parallel = folded(angle, |point, height| point + DVec3::Y * height);
        let spot = folded(angle, |point, height| point.lerp(light, 0.2 * height));
        [("parallel", parallel, sun(DVec3::Y, DVec3::ZERO, 1.3)), ("spot", spot, spot_from(light, DVec3::ZERO, 1.3))]
            .map(|(light_name, mesh, light)| Case::new(format!("{name}, {light_name}"), angle, mesh, light))
    });
    cases.collect()
}

/// Two faces that share the edge v-u and lie one over the other, so that v-p and v-q have one image but for the angle.
///
/// ```text
///        u
///       /|      v-p below v-q
///      / |
///     v--pq
/// ```
fn folded(angle: f64, lifted: impl Fn(DVec3, f64) -> DVec3) -> CaseMesh {
    let v = DVec3::new(-0.7, 0.0, 0.1);
    let u = DVec3::new(0.2, 0.0, -0.7);
    let p = DVec3::new(0.7, 0.0, 0.3);
    let q = v + 0.9 * (DVec3::new(p.x - v.x, 0.0, p.z - v.z) + angle * DVec3::new(p.z - v.z, 0.0, v.x - p.x));
    let places = [v, u, lifted(p, -0.5), lifted(q, 0.5)];
    rounded(&places, vec![[0, 2, 1], [0, 1, 3]])
}

/// Spikes of the star.
const SPIKES: u32 = 7;

fn sharp_turns(effort: &Effort) -> Vec<Case> {
    let cases = effort.powers_of_ten(-8, 0, 1).into_iter().flat_map(|(name, angle)| {
        let mesh = star(angle);
        let lights = [
            ("spot", spot_from(DVec3::new(0.3, 3.0, 0.2), DVec3::ZERO, 1.0)),
            ("parallel", sun(DVec3::new(0.1, 1.0, 0.05), DVec3::ZERO, 1.0)),
        ];
        lights.map(|(light_name, light)| Case::new(format!("{name}, {light_name}"), angle, mesh.clone(), light))
    });
    cases.collect()
}

/// Triangles apart from each other, each with its tip on a circle and the angle there.
fn star(angle: f64) -> CaseMesh {
    let mut positions = Vec::new();
    for index in 0..SPIKES {
        let (sin, cos) = (0.1 + std::f64::consts::TAU * f64::from(index) / f64::from(SPIKES)).sin_cos();
        let [out, side] = [DVec3::new(cos, 0.0, -sin), DVec3::new(-sin, 0.0, -cos)];
        let half_base = 0.7 * (0.5 * angle).tan();
        positions.extend([0.2 * out - half_base * side, 0.9 * out, 0.2 * out + half_base * side]);
    }
    rounded(&positions, (0..SPIKES).map(|spike| [3 * spike, 3 * spike + 1, 3 * spike + 2]).collect())
}

fn near_plane(effort: &Effort) -> Vec<Case> {
    let mesh = ring(1.0, DVec3::ZERO);
    let shares = [1e-30, 1e-20, 1e-10, 1e-6, 1e-4, 1e-2, 0.1, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.3];
    let position = DVec3::new(1.3, 3.0, 1.1);
    let cases = effort.some_of(&shares).into_iter().map(|share| {
        let near = share * position.length();
        let kind = LightKind::Spot {
            position,
            target: DVec3::ZERO,
            cone_angle: 1.0,
            radius: 0.05,
            near,
            far: 1.5 * position.length(),
        };
        let case = Case::new(format!("{share:e}"), share, mesh.clone(), Light { kind, color: [1.0; 3] });
        if near < position.length() - RING_RADIUS {
            return case;
        }
        case.without_gap_search(
            "the near plane cuts the mesh; what is before it casts nothing, a cut is no edge and has no smoothie, and gaps \
             are not looked for",
        )
    });
    cases.collect()
}

fn behind_light(effort: &Effort) -> Vec<Case> {
    let depths = [1.0, 0.2, 0.1, 1e-3, 1e-8, 1e-30, 0.0, -1e-30, -1e-8, -1e-3, -0.1, -1.0, -1e3, -1e8];
    let kind = LightKind::Spot {
        position: DVec3::ZERO,
        target: -DVec3::Z,
        cone_angle: 1.6,
        radius: 0.02,
        near: 0.1,
        far: 9.0,
    };
    let light = Light { kind, color: [1.0; 3] };
    let cases = effort.some_of(&depths).into_iter().enumerate().map(|(number, depth)| {
        // Three corners before the light and one at the depth, beside the axis.
        let places = [
            DVec3::new(-0.9, -0.7, -3.0),
            DVec3::new(1.1, -0.6, -2.6),
            DVec3::new(0.1, 0.9, -2.8),
            DVec3::new(0.02, 0.03, -depth),
        ];
        let mesh = rounded(&places, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]);
        let case = Case::new(format!("depth {depth:e}"), number as f64, mesh, light);
        if depth >= 0.1 {
            return case;
        }
        case.without_gap_search(
            "a corner lies before the near plane, which cuts faces there; a cut is no edge and has no smoothie, and gaps \
             are not looked for",
        )
    });
    cases.collect()
}

#[cfg(test)]
mod tests {
    use contrejour_mesh::{BuildOptions, TopologyAwareMesh};

    use super::*;

    #[test]
    fn the_prism_is_closed_and_faces_outwards() {
        let mesh = frustum(|bottom| bottom + DVec3::Y);
        let mesh = TopologyAwareMesh::build(&mesh.positions, &mesh.triangles, &BuildOptions::default());
        let report = mesh.expect("a good mesh").report;
        assert!(report.closed && report.oriented && report.concave_edges == 0, "{report}");
    }
}
