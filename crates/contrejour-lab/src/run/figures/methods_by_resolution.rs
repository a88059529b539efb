//! Pictures of all methods at several map sizes, with the truth.

use super::super::error::RunError;
use super::super::lab::Lab;
use super::methods::{BICUBIC, BY_LIGHT_SIZE, Method, SHADOW_MAP, THICK, THIN};
use super::sight::{Sight, built_in};
use crate::report::{Body, Extent, Figure, GridRow, PictureGrid};

const SCENES: [&str; 2] = ["cylinder", "fence"];

const METHODS: [Method; 5] = [SHADOW_MAP, BICUBIC, THIN, THICK, BY_LIGHT_SIZE];

/// Texels along the map's side.
const MAP_SIZES: [u32; 4] = [256, 1024, 512, 2048];

/// A method's error in a row of pictures.
struct Judged {
    scene: &'static str,
    map_size: u32,
    method: &'static str,
    rmse: f64,
}

pub(super) fn make(lab: &Lab) -> Result<Figure, RunError> {
    let count = if lab.options.effort.extent == Extent::Quick { 2 } else { MAP_SIZES.len() };
    let mut map_sizes = MAP_SIZES[..count].to_vec();
    map_sizes.sort_unstable();
    let mut rows = Vec::new();
    let mut judged = Vec::new();
    for scene in SCENES {
        let sight = Sight::new(lab, scene, built_in(scene)?)?;
        let truth = sight.shaded(&sight.truth.visibility)?;
        let alt = format!("{scene}, ray-traced truth");
        let truth = lab.keep_picture("figure-methods", &format!("{scene}-truth"), &alt, &truth)?;
        for &map_size in &map_sizes {
            let mut cells = Vec::new();
            for method in METHODS {
                let visibility = sight.visibility(&method.settings(sight.shadow(), map_size))?;
                judged.push(Judged { scene, map_size, method: method.label, rmse: sight.rmse(&visibility)? });
                let name = format!("{scene}-{map_size}-{}", method.file);
                let alt = format!("{scene}, {} at {map_size} texels", method.label);
                cells.push(Some(lab.keep_picture("figure-methods", &name, &alt, &sight.shaded(&visibility)?)?));
            }
            cells.push(Some(truth.clone()));
            rows.push(GridRow { label: format!("{scene}, {map_size}"), cells });
        }
    }
    let columns = METHODS.iter().map(|method| method.label).chain(["truth"]).map(str::to_owned).collect();
    let caption = format!(
        "The methods that Chan and Durand (2003) compare, on a cylinder and on a fence with small openings, at \
         {} texels, beside the ray-traced truth. {}",
        map_sizes.iter().map(u32::to_string).collect::<Vec<_>>().join(", "),
        told(&judged),
    );
    let body = Body::Pictures(PictureGrid { columns, rows });
    Ok(Figure { title: "Methods and map sizes in pictures".to_owned(), caption, body })
}

/// The nearest to the truth in each scene, and the farthest.
fn told(judged: &[Judged]) -> String {
    let in_scene = |scene| judged.iter().filter(move |one| one.scene == scene);
    let sentences = SCENES.iter().filter_map(|&scene| {
        let best = in_scene(scene).min_by(|a, b| a.rmse.total_cmp(&b.rmse))?;
        let worst = in_scene(scene).max_by(|a, b| a.rmse.total_cmp(&b.rmse))?;
        let one = |one: &Judged| format!("{} at {} texels (RMSE {:.3})", one.method, one.map_size, one.rmse);
        Some(format!("On the {scene} the nearest to the truth is: {}; the farthest: {}.", one(best), one(worst)))
    });
    sentences.collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn best_and_worst_follow_the_errors() {
        let judged = |errors: [f64; 2]| {
            let methods = errors.into_iter().zip([SHADOW_MAP, THIN]);
            let one =
                |(rmse, method): (f64, Method)| Judged { scene: "fence", map_size: 256, method: method.label, rmse };
            told(&methods.map(one).collect::<Vec<_>>())
        };
        assert_eq!(
            judged([0.25, 0.125]),
            "On the fence the nearest to the truth is: smoothies, t = 0.02 at 256 texels (RMSE 0.125); the farthest: \
             shadow map at 256 texels (RMSE 0.250)."
        );
        assert!(judged([0.125, 0.25]).contains("truth is: shadow map"));
    }
}
