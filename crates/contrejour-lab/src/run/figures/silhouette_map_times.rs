//! What silhouette maps cost beside the plain shadow map, and where it goes.

use std::sync::Arc;

use contrejour_plan::{Pass, Stage};
use contrejour_scene::Scene;
use contrejour_scene::shapes::Shape;

use super::super::error::RunError;
use super::super::lab::Lab;
use super::super::subject::{NamedScene, Subject};
use super::methods::{
    BLENDED_SILHOUETTE_MAP, BLENDED_SILHOUETTE_MAP_TAM, BY_LIGHT_SIZE, Method, SHADOW_MAP, SILHOUETTE_MAP,
    SILHOUETTE_MAP_HALF_STREAM, SILHOUETTE_MAP_STREAM, SILHOUETTE_MAP_TAM,
};
use super::sight::built_in;
use super::turns::turns;
use crate::metrics::Timing;
use crate::report::{Body, Cost, Figure, Table};

/// 2 * 600 * 25 = 30 000 faces, as many as the paper's scene has.
const KNOT: Shape = Shape::Knot { radius: 0.95, tube_radius: 0.23, segments: 600, sides: 25 };

const METHODS: [Method; 8] = [
    SHADOW_MAP,
    BY_LIGHT_SIZE,
    SILHOUETTE_MAP,
    SILHOUETTE_MAP_TAM,
    SILHOUETTE_MAP_STREAM,
    SILHOUETTE_MAP_HALF_STREAM,
    BLENDED_SILHOUETTE_MAP,
    BLENDED_SILHOUETTE_MAP_TAM,
];

/// How many times as long as the plain shadow map the paper's technique takes: "about".
const RATIO_OF_2005: f64 = 5.0;

/// Texels along the map's side.
const MAP_SIZES: [u32; 2] = [512, 1024];

/// The built-in scene with this knot for its own.
fn with_knot(mut scene: Scene) -> Result<Scene, RunError> {
    for placed in scene.meshes.iter_mut().filter(|placed| placed.name == "knot") {
        placed.mesh = Arc::new(KNOT.generate()?);
    }
    Ok(scene)
}

/// What a part of a frame's shadow is for.
#[derive(Clone, Copy, PartialEq)]
enum Part {
    Detection,
    Rasterising,
    Shading,
}

pub(super) fn make(lab: &Lab) -> Result<Figure, RunError> {
    let named = NamedScene { name: "knot of 30000".to_owned(), scene: with_knot(built_in("knot")?)? };
    let subject = Subject::new(lab.gpu, &named, lab.options.effort.picture_size)?;
    let [faces, _] = subject.faces_and_edges()?;
    let mut rows = Vec::new();
    let mut told_of = Vec::new();
    for map_size in MAP_SIZES {
        let costs = turns(lab, &subject, &METHODS, map_size, &lab.options.effort)?;
        for (method, cost) in METHODS.iter().zip(&costs) {
            let vertices_ms =
                if method.finds_in_vertex_stage() { vertices_ms(lab, &subject, method, map_size)? } else { None };
            rows.push(row(map_size, method, (cost, vertices_ms.unwrap_or(0.0)), &costs[0]));
        }
        told_of.push((map_size, [2, 3, 4].map(|method| ratio(&costs[method], &costs[0]))));
    }
    let clock = if lab.gpu.is_software() { "the clock on the wall, around a submission" } else { "device timestamps" };
    let caption = format!(
        "The scene knot with a knot of 30 000 faces, {faces} together, under a light that moves; Valient and Bujnak (2005) have a scene of some \
         30 000 polygons. Medians by {clock}, of the whole shadow work and of asking all receivers; the parts are sums of \
         their passes' medians. Where the vertex stage detects, that is its pass, drawn once more into a single texel. {}",
        told(&told_of),
    );
    let columns = ["map, method", "ms", "ratio", "detection, ms", "rasterising, ms", "shading, ms", "maps", "buffers"];
    let table = Table { columns: columns.map(str::to_owned).to_vec(), rows };
    Ok(Figure { title: "What silhouette maps cost".to_owned(), caption, body: Body::Table(table) })
}

/// How long the vertex stage of the pass takes that fills the silhouette map; `None` where the device has no timestamps.
fn vertices_ms(lab: &Lab, subject: &Subject, method: &Method, map_size: u32) -> Result<Option<f64>, RunError> {
    let mut contestant = subject.judge.contestant(&method.settings(&subject.shadow, map_size))?;
    contestant.draw(&subject.light)?;
    let rounds = 0..lab.options.effort.timed_rounds;
    let times =
        rounds.map(|_| contestant.silhouette_vertices_ms(&subject.light)).collect::<Result<Option<Vec<_>>, _>>()?;
    Ok(times.map(|times| Timing::from_samples(&times)).transpose()?.map(|timing| timing.median_ms))
}

/// A row of the table, with what of the rasterising is the vertex stage's detection.
fn row(map_size: u32, method: &Method, (cost, vertices_ms): (&Cost, f64), plain: &Cost) -> Vec<String> {
    let moved = [(Part::Detection, vertices_ms), (Part::Rasterising, -vertices_ms), (Part::Shading, 0.0)];
    let times = moved.map(|(part, moved_ms)| match part_ms(cost, part) {
        Some(ms) => format!("{:.2}", ms + moved_ms),
        None => "no clock".to_owned(),
    });
    let memory = |bytes: u64, of: u64| format!("{:.2}", bytes as f64 / of.max(1) as f64);
    let [detection, rasterising, shading] = times;
    vec![
        format!("{map_size}, {}", method.label),
        format!("{:.3}", cost.whole().median_ms),
        ratio(cost, plain).map_or("too short".to_owned(), |ratio| format!("{ratio:.2}")),
        detection,
        rasterising,
        shading,
        memory(cost.map_bytes, plain.map_bytes),
        memory(cost.buffer_bytes, plain.buffer_bytes),
    ]
}

fn ratio(cost: &Cost, plain: &Cost) -> Option<f64> {
    let plain = plain.whole().median_ms;
    (plain > 0.0).then(|| cost.whole().median_ms / plain)
}

/// None where the device has no timestamps.
fn part_ms(cost: &Cost, part: Part) -> Option<f64> {
    let of_part = cost.stages.iter().filter(|stage| part_of(&stage.name) == part);
    (!cost.stages.is_empty()).then(|| of_part.map(|stage| stage.timing.median_ms).sum())
}

fn part_of(name: &str) -> Part {
    if name == Pass::Visibility.name() {
        Part::Shading
    } else if Stage::ALL.iter().any(|stage| stage.name() == name) {
        Part::Detection
    } else {
        Part::Rasterising
    }
}

/// The ratios of all sources beside the paper's.
fn told(of_sizes: &[(u32, [Option<f64>; 3])]) -> String {
    let sentence = |(map_size, ratios): &(u32, [Option<f64>; 3])| match ratios {
        [Some(stages), Some(vertices), Some(stream)] => format!(
            "At {map_size} texels the silhouette map takes {stages:.2} times as long as the shadow map where compute stages \
             find silhouettes, {vertices:.2} times where the vertex stage does, and {stream:.2} times where a stream of \
             normals tells it; the paper's takes about {RATIO_OF_2005:.0} times as long."
        ),
        _ => format!("At {map_size} texels the shadow map is too fast for the clock."),
    };
    of_sizes.iter().map(sentence).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_a_scene_of_as_many_faces_as_the_papers() {
        let Ok(scene) = built_in("knot").and_then(with_knot) else { panic!("scene and shape are good") };
        let faces = scene.meshes.iter().map(|placed| placed.mesh.triangles.len());
        assert_eq!(faces.max(), Some(30_000));
    }

    #[test]
    fn stages_detect_passes_rasterise_and_visibility_shades() {
        assert!(part_of("extrude_edges") == Part::Detection && part_of("visibility") == Part::Shading);
        assert!(part_of("silhouette_map_tam") == Part::Rasterising && part_of("shadow_map") == Part::Rasterising);
    }

    #[test]
    fn what_is_told_follows_the_times() {
        let told = |stages| told(&[(512, [Some(stages), Some(4.0), Some(6.0)])]);
        assert!(told(1.5).starts_with("At 512 texels the silhouette map takes 1.50 times as long"));
        assert!(told(1.5).contains("4.00 times where the vertex stage does, and 6.00 times where a stream"));
        assert!(told(1.5).contains("tells it; the paper's takes about 5 times"));
        assert_ne!(told(1.5), told(1.6));
        assert!(super::told(&[(512, [None, Some(1.0), Some(1.0)])]).contains("too fast"));
    }
}
