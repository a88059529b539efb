//! Where silhouette maps are wrong, as Valient and Bujnak (2005) say of theirs: where silhouettes touch and cross, where
//! shadows are thin, and where the light is wide.

use std::path::Path;

use contrejour_scene::Scene;

use super::super::error::RunError;
use super::super::lab::Lab;
use super::beside_truth::beside_truth;
use super::methods::SILHOUETTE_MAP;
use super::sight::{Sight, built_in, with_radii};
use crate::report::{Body, Figure, GridRow, PictureGrid};

/// A weak spot.
struct Spot {
    name: &'static str,
    label: &'static str,
    /// A built-in scene, or [`TOUCHING`].
    scene: &'static str,
    map_size: u32,
    /// By how much the scene's light is wider.
    wider: f64,
}

const SPOTS: [Spot; 4] = [
    Spot { name: "touching", label: "touching silhouettes", scene: TOUCHING, map_size: 512, wider: 1.0 },
    Spot { name: "crossing", label: "crossing silhouettes", scene: "boxes", map_size: 256, wider: 1.0 },
    Spot { name: "thin", label: "thin shadows", scene: "fence", map_size: 256, wider: 0.3 },
    Spot { name: "wide", label: "a wide light", scene: "square", map_size: 512, wider: 2.5 },
];

const TOUCHING: &str = "two boxes side by side";

/// Two boxes that share a side, over a floor.
const TOUCHING_SCENE: &str = r#"
[camera]
eye = [0, 5, 5]
target = [0, 0, 0]
fov_y_degrees = 30
[light]
kind = "spot"
position = [-2, 6, 1]
target = [0, 0, 0]
radius = 0.4
[[mesh]]
shape = { kind = "box", size = [8, 0.3, 8] }
translate = [0, -0.15, 0]
[[mesh]]
shape = { kind = "box" }
translate = [-0.5, 0.8, 0]
[[mesh]]
shape = { kind = "box" }
translate = [0.5, 0.8, 0]
"#;

fn scene_of(spot: &Spot) -> Result<Scene, RunError> {
    match spot.scene {
        TOUCHING => Ok(Scene::from_toml(TOUCHING_SCENE, Path::new(""), TOUCHING)?),
        name => built_in(name),
    }
}

pub(super) fn make(lab: &Lab) -> Result<Figure, RunError> {
    let mut rows = Vec::new();
    let mut columns = Vec::new();
    let mut errors = Vec::new();
    for spot in &SPOTS {
        let sight =
            Sight::new(lab, &format!("weak-{}", spot.name), with_radii(scene_of(spot)?, |radius| spot.wider * radius))?;
        let settings = SILHOUETTE_MAP.settings(sight.shadow(), spot.map_size);
        let label = format!("{}, {}, {} texels", spot.label, spot.scene, spot.map_size);
        let beside = beside_truth(lab, &format!("figure-weak-{}", spot.name), &sight, &[(&label, settings)])?;
        errors.extend(beside.errors.iter().map(|(rmse, _)| (spot.label, *rmse)));
        columns = beside.grid.columns;
        rows.extend(beside.grid.rows.into_iter().map(|row| GridRow { label: label.clone(), ..row }));
    }
    let caption = format!(
        "What Valient and Bujnak (2005) say that silhouette maps do badly, by the technique silhouette-map: a texel knows one \
         silhouette, so light leaks through where two touch within a shadow, and the edge of the other one has steps where two \
         cross; a shadow thinner than a texel has holes; a wide \
         light reaches around more than the nearest edge. {}",
        told(&errors),
    );
    let body = Body::Pictures(PictureGrid { columns, rows });
    Ok(Figure { title: "Weak spots of silhouette maps".to_owned(), caption, body })
}

/// The error at each of them.
fn told(errors: &[(&str, f64)]) -> String {
    let one = |(label, rmse): &(&str, f64)| format!("{label} {rmse:.3}");
    format!("RMSE of visibility: {}.", errors.iter().map(one).collect::<Vec<_>>().join(", "))
}

#[cfg(test)]
mod tests {
    use contrejour_plan::LightKind;

    use super::*;

    #[test]
    fn what_is_told_follows_the_errors() {
        assert_eq!(told(&[("thin shadows", 0.125)]), "RMSE of visibility: thin shadows 0.125.");
    }

    #[test]
    fn the_lights_are_as_wide_as_asked() {
        for spot in &SPOTS {
            let Ok(scene) = scene_of(spot) else { panic!("{} is a scene", spot.scene) };
            let radius = |scene: &Scene| match scene.lights[0].light.kind {
                LightKind::Spot { radius, .. } => radius,
                _ => panic!("{} has no spot", spot.scene),
            };
            assert_eq!(radius(&with_radii(scene.clone(), |radius| spot.wider * radius)), spot.wider * radius(&scene));
        }
    }
}
