//! Who finds silhouettes at less cost: compute stages or the vertex stage, on all built-in scenes of many faces.

use contrejour_scene::BUILT_IN_SCENES;

use super::super::effort::Effort;
use super::super::error::RunError;
use super::super::lab::Lab;
use super::super::subject::{NamedScene, Subject};
use super::methods::{Method, SHADOW_MAP, SILHOUETTE_MAP, SILHOUETTE_MAP_TAM};
use super::sight::built_in;
use super::turns::turns;
use crate::report::{Body, Extent, Figure, Table};

const METHODS: [Method; 3] = [SHADOW_MAP, SILHOUETTE_MAP, SILHOUETTE_MAP_TAM];

/// A scene with fewer casting faces has no row.
const LEAST_FACES: u64 = 10_000;

/// Texels along the map's side; the first for a quick report.
const MAP_SIZES: [u32; 2] = [512, 1024];

/// What a scene costs at one size of the maps.
struct Measured {
    scene: &'static str,
    faces: u64,
    map_size: u32,
    /// Of each method, in milliseconds.
    ms: [f64; 3],
}

pub(super) fn make(lab: &Lab) -> Result<Figure, RunError> {
    // Frames of many faces are long, and vary less.
    let effort = Effort { timed_rounds: lab.options.effort.timed_rounds.div_ceil(3), ..lab.options.effort };
    let map_sizes = if lab.options.effort.extent == Extent::Quick { &MAP_SIZES[..1] } else { &MAP_SIZES };
    let mut measured = Vec::new();
    for built in BUILT_IN_SCENES {
        let named = NamedScene { name: built.name.to_owned(), scene: built_in(built.name)? };
        let subject = Subject::new(lab.gpu, &named, lab.options.effort.picture_size)?;
        let [faces, _] = subject.faces_and_edges()?;
        if faces <= LEAST_FACES {
            continue;
        }
        for &map_size in map_sizes {
            let costs = turns(lab, &subject, &METHODS, map_size, &effort)?;
            let ms = [0, 1, 2].map(|method: usize| costs[method].whole().median_ms);
            measured.push(Measured { scene: built.name, faces, map_size, ms });
        }
    }
    let columns = ["scene, map", "faces", "shadow map, ms", "silhouette map, ms", "ratio", "TAM, ms", "ratio"];
    let table = Table { columns: columns.map(str::to_owned).to_vec(), rows: measured.iter().map(row).collect() };
    let caption = format!(
        "The built-in scenes of more than {LEAST_FACES} faces that cast, under a light that moves: medians of the whole \
         shadow work and of asking all receivers. {}",
        told(&measured),
    );
    Ok(Figure { title: "Silhouette maps of many faces".to_owned(), caption, body: Body::Table(table) })
}

fn row(measured: &Measured) -> Vec<String> {
    let Measured { scene, faces, map_size, ms: [plain, stages, vertices] } = measured;
    let ratio = |ms: f64| if *plain > 0.0 { format!("{:.2}", ms / plain) } else { "too short".to_owned() };
    vec![
        format!("{scene}, {map_size}"),
        faces.to_string(),
        format!("{plain:.3}"),
        format!("{stages:.3}"),
        ratio(*stages),
        format!("{vertices:.3}"),
        ratio(*vertices),
    ]
}

/// Where the compute stages cost less than the vertex stage, and where they don't.
fn told(measured: &[Measured]) -> String {
    let dearer: Vec<String> = (measured.iter().filter(|one| one.ms[1] >= one.ms[2]))
        .map(|one| format!("{} at {}", one.scene, one.map_size))
        .collect();
    if dearer.is_empty() {
        return "Where compute stages find silhouettes, each costs less than where the vertex stage does.".to_owned();
    }
    format!("Compute stages cost no less than the vertex stage on {}; elsewhere they do.", dearer.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measured(ms: [f64; 3]) -> Measured {
        Measured { scene: "knot", faces: 30_000, map_size: 512, ms }
    }

    #[test]
    fn what_is_told_follows_the_times() {
        assert!(told(&[measured([1.0, 2.0, 3.0])]).contains("each costs less"));
        let mixed = told(&[measured([1.0, 2.0, 3.0]), measured([1.0, 3.0, 3.0])]);
        assert_eq!(mixed, "Compute stages cost no less than the vertex stage on knot at 512; elsewhere they do.");
    }

    #[test]
    fn rows_have_ratios_where_there_is_time() {
        assert_eq!(row(&measured([2.0, 3.0, 5.0]))[4..], ["1.50", "5.000", "2.50"]);
        assert_eq!(row(&measured([0.0, 3.0, 5.0]))[4], "too short");
    }
}
