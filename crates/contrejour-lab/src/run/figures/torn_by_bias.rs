//! What an over-sized depth bias does to smoothies: it tears the soft edge from the hard one.

use contrejour_plan::{DepthBias, ShadowSettings};
use contrejour_scene::Scene;
use glam::DVec3;

use super::super::error::RunError;
use super::super::lab::Lab;
use super::methods::BY_LIGHT_SIZE;
use super::sight::{Sight, built_in};
use crate::metrics::{UmbraArea, umbra_area};
use crate::report::{Body, Figure, GridRow, PictureGrid};

const MAP_SIZE: u32 = 512;

/// Constant bias in texels: what is usual, and ever more.
const BIASES: [f32; 3] = [DepthBias::DEFAULT.constant_texels, 16.0, 64.0];

/// What a bias does.
struct Torn {
    constant_texels: f32,
    rmse: f64,
    umbra: UmbraArea,
}

pub(super) fn make(lab: &Lab) -> Result<Figure, RunError> {
    let sight = Sight::new(lab, "contact", contact(built_in("cylinder")?))?;
    let keep = |name: String, alt: String, picture| lab.keep_picture("figure-bias", &name, &alt, &picture);
    let truth = &sight.truth.visibility;
    let mut rows = vec![GridRow {
        label: "truth".to_owned(),
        cells: vec![Some(keep("truth".to_owned(), "contact, ray-traced".to_owned(), sight.shaded(truth)?)?), None],
    }];
    let mut torn = Vec::new();
    for constant_texels in BIASES {
        let usual = BY_LIGHT_SIZE.settings(sight.shadow(), MAP_SIZE);
        let bias = DepthBias { constant_texels, ..usual.bias };
        let visibility = sight.visibility(&ShadowSettings { bias, ..usual })?;
        let umbra = umbra_area(truth, &visibility, &sight.truth.compared)?;
        let umbra = umbra.ok_or_else(|| RunError::NothingToCompare { scene: "contact".to_owned() })?;
        torn.push(Torn { constant_texels, rmse: sight.rmse(&visibility)?, umbra });
        let label = format!("bias of {constant_texels} texels");
        let cells = vec![
            Some(keep(format!("{constant_texels}"), format!("contact, {label}"), sight.shaded(&visibility)?)?),
            Some(keep(
                format!("{constant_texels}-difference"),
                format!("difference from the truth, {label}"),
                sight.difference(&visibility)?,
            )?),
        ];
        rows.push(GridRow { label, cells });
    }
    let caption = format!(
        "Where the cylinder stands on the plane, with smoothies from the light's size at {MAP_SIZE} texels and a \
         growing constant bias, which they inherit from shadow maps (Chan and Durand 2003). With too much of it the \
         hard shadow sets in late, and light comes between it and the soft edge. {}",
        told(&torn),
    );
    let columns = ["picture", "difference from the truth"].map(str::to_owned).to_vec();
    let body = Body::Pictures(PictureGrid { columns, rows });
    Ok(Figure { title: "An over-sized bias".to_owned(), caption, body })
}

/// The same scene, seen from near the cylinder's foot.
fn contact(mut scene: Scene) -> Scene {
    scene.camera.eye = DVec3::new(2.2, 2.4, 2.3);
    scene.camera.target = DVec3::new(0.3, 0.15, -0.05);
    scene.camera.fov_y = 0.45;
    scene
}

/// Error and lost umbra of each bias.
fn told(torn: &[Torn]) -> String {
    let one = |Torn { constant_texels, rmse, umbra }: &Torn| {
        format!(
            "with {constant_texels} texels RMSE {rmse:.3}, and {:.2} % of the pixels are not dark though truly in the \
             umbra",
            100.0 * umbra.too_small(),
        )
    };
    let mut text = torn.iter().map(one).collect::<Vec<_>>().join("; ");
    text.replace_range(..text.len().min(1), "W");
    text + "."
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_told_follows_the_figures() {
        let told = |too_small_pixels| {
            let umbra = UmbraArea { pixels: 200, too_large_pixels: 0, too_small_pixels };
            told(&[Torn { constant_texels: 0.5, rmse: 0.125, umbra }])
        };
        assert_eq!(
            told(3),
            "With 0.5 texels RMSE 0.125, and 1.50 % of the pixels are not dark though truly in the umbra."
        );
        assert_ne!(told(4), told(3));
    }
}
