//! How many edges a silhouette has, against the number of faces.

use std::f64::consts::PI;

use contrejour_plan::{Light, LightKind};
use contrejour_scene::shapes::Shape;
use glam::DVec3;

use super::super::super::error::RunError;
use super::super::super::lab::Lab;
use super::LoneMesh;
use crate::metrics::{PowerLaw, power_law};
use crate::report::{Axis, Body, Extent, Figure, Plot, Scale, Series, Stroke};

/// The trend of many models of people (McGuire 2004, figure 8).
const MCGUIRE: PowerLaw = PowerLaw { factor: 0.7, exponent: 0.8 };

/// Faces of the tori.
const FACES: [u32; 7] = [1000, 3000, 10_000, 30_000, 100_000, 300_000, 1_000_000];

/// What the built-in scenes are made of.
const SHAPES: [Shape; 6] = [
    Shape::Box { size: [1.0, 1.0, 1.0] },
    Shape::Cylinder { radius: 0.4, height: 2.0, segments: 128 },
    Shape::Sphere { radius: 0.5, segments: 64 },
    Shape::Fence { size: [3.9, 1.5, 0.05], columns: 26, rows: 10, bar: 0.04 },
    Shape::Knot { radius: 0.95, tube_radius: 0.23, segments: 400, sides: 48 },
    Shape::Elephant { height: 2.0, segments: 48 },
];

/// Lights around a mesh whose silhouettes are counted.
const LIGHTS: u32 = 8;

pub(in super::super) fn make(lab: &Lab) -> Result<Figure, RunError> {
    let meshes = if lab.options.effort.extent == Extent::Quick { 5 } else { FACES.len() };
    let tori =
        FACES.iter().take(meshes).map(|&faces| point(&LoneMesh::torus(faces)?)).collect::<Result<Vec<_>, _>>()?;
    let shapes = SHAPES.iter().map(|shape| point(&LoneMesh::new(shape)?)).collect::<Result<Vec<_>, _>>()?;
    let caption = format!(
        "Mean number of silhouette edges over {LIGHTS} lights around a mesh, for tori of ever finer faces and for \
         the shapes of the built-in scenes, against 0.7 f^0.8, the trend that McGuire (2004, figure 8) found in \
         models made by people. {}",
        told(&tori, &shapes),
    );
    let trend = [&tori, &shapes].into_iter().flatten().map(|&[faces, _]| [faces, MCGUIRE.at(faces)]);
    let mut trend: Vec<[f64; 2]> = trend.collect();
    trend.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let series = |label: &str, points, stroke| Series { label: label.to_owned(), points, stroke };
    let plot = Plot {
        x: Axis { label: "faces".to_owned(), scale: Scale::Log },
        y: Axis { label: "silhouette edges".to_owned(), scale: Scale::Log },
        series: vec![
            series("tori", tori, Stroke::Line),
            series("built-in shapes", shapes, Stroke::Marks),
            series("0.7 f^0.8 (McGuire 2004)", trend, Stroke::Dashed),
        ],
    };
    Ok(Figure { title: "Size of silhouettes".to_owned(), caption, body: Body::Plot(plot) })
}

/// Faces and mean silhouette edges of a mesh.
fn point(mesh: &LoneMesh) -> Result<[f64; 2], RunError> {
    let mut edges = 0.0;
    for step in 0..LIGHTS {
        let frame = mesh.mirror_frame(&on_sphere(&mesh.light, step))?;
        edges += f64::from(frame.run().counters.silhouette_edges);
    }
    Ok([mesh.faces(), edges / f64::from(LIGHTS)])
}

/// The light moved to one of [`LIGHTS`] points spread evenly on the sphere around its target: a spiral of golden angles
/// (Vogel 1979) from pole to pole.
fn on_sphere(light: &Light, step: u32) -> Light {
    let height = 1.0 - f64::from(2 * step + 1) / f64::from(LIGHTS);
    let (sin, cos) = (f64::from(step) * PI * (3.0 - 5.0_f64.sqrt())).sin_cos();
    let radius = (1.0 - height * height).sqrt();
    let mut moved = *light;
    if let LightKind::Spot { position, target, .. } = &mut moved.kind {
        *position = *target + position.distance(*target) * DVec3::new(radius * cos, height, radius * sin);
    }
    moved
}

/// How the counts grow, and how they lie to the trend.
fn told(tori: &[[f64; 2]], shapes: &[[f64; 2]]) -> String {
    let exponent = power_law(tori).map_or_else(String::new, |law| {
        format!(
            "The silhouette of the tori grows as f^{:.2}: that of a smooth surface grows as its square root. ",
            law.exponent
        )
    });
    let above = shapes.iter().filter(|[faces, edges]| *edges > MCGUIRE.at(*faces)).count();
    format!("{exponent}Of the {} built-in shapes {above} have more silhouette edges than the trend.", shapes.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_has_a_silhouette_of_four_or_six_edges() {
        let [faces, edges] = point(&LoneMesh::new(&SHAPES[0]).expect("a box")).expect("a point");
        assert_eq!(faces, 12.0);
        assert!((4.0..=6.0).contains(&edges), "{edges}");
    }

    #[test]
    fn lights_are_all_around_and_as_far_as_before() {
        let torus = LoneMesh::torus(1000).expect("a torus");
        let of = |light: &Light| match light.kind {
            LightKind::Spot { position, target, .. } => position - target,
            LightKind::Point { position, .. } => position,
            LightKind::Directional { towards_light, .. } | LightKind::Cascaded { towards_light, .. } => towards_light,
        };
        let distance = of(&torus.light).length();
        let offsets: Vec<DVec3> = (0..LIGHTS).map(|step| of(&on_sphere(&torus.light, step))).collect();
        assert!(offsets.iter().all(|offset| (offset.length() / distance - 1.0).abs() < 1e-9));
        // Their middle is the target; that of lights on one side would not be.
        let middle = |offsets: &[DVec3]| offsets.iter().sum::<DVec3>().length() / (offsets.len() as f64 * distance);
        assert!(middle(&offsets) < 0.1, "{}", middle(&offsets));
        assert!(middle(&offsets[..4]) > 0.3);
    }

    #[test]
    fn what_is_told_follows_the_counts() {
        let tori = [1e3, 1e5].map(|faces: f64| [faces, faces.sqrt()]);
        let trend = MCGUIRE.at(1e3);
        assert!(told(&tori, &[[1e3, trend + 1.0], [1e3, trend - 1.0]]).contains("f^0.50"));
        assert!(told(&tori, &[[1e3, trend + 1.0], [1e3, trend - 1.0]]).contains("2 built-in shapes 1 have"));
        assert!(told(&tori, &[[1e3, trend + 1.0]; 2]).contains("2 built-in shapes 2 have"));
    }
}
