//! Smoothies beside the truth, and where they differ.

use contrejour_plan::ShadowSettings;

use super::super::error::RunError;
use super::super::lab::Lab;
use super::sight::Sight;
use crate::metrics::{UmbraArea, umbra_area};
use crate::report::{GridRow, PictureGrid};

/// Pictures of a scene, and figures to tell.
pub(super) struct BesideTruth {
    /// One row for each of the settings: truth, technique, difference.
    pub grid: PictureGrid,
    /// Error and umbra of each of the settings.
    pub errors: Vec<(f64, UmbraArea)>,
}

/// Draws a scene with settings, each named for readers.
pub(super) fn beside_truth(
    lab: &Lab,
    figure: &str,
    sight: &Sight,
    named: &[(&str, ShadowSettings)],
) -> Result<BesideTruth, RunError> {
    let keep = |name: &str, alt: &str, picture| lab.keep_picture(figure, name, alt, &picture);
    let truth = keep("truth", "shaded with the ray-traced truth", sight.shaded(&sight.truth.visibility)?)?;
    let mut rows = Vec::new();
    let mut errors = Vec::new();
    for (number, (label, settings)) in (1..).zip(named) {
        let visibility = sight.visibility(settings)?;
        let umbra = umbra_area(&sight.truth.visibility, &visibility, &sight.truth.compared)?;
        let umbra = umbra.ok_or_else(|| RunError::NothingToCompare { scene: figure.to_owned() })?;
        errors.push((sight.rmse(&visibility)?, umbra));
        let pictures = [
            keep(&format!("{number}"), &format!("shaded: {label}"), sight.shaded(&visibility)?)?,
            keep(&format!("{number}-grey"), &format!("visibility: {label}"), sight.grey(&visibility)?)?,
            keep(
                &format!("{number}-difference"),
                &format!("difference from the truth: {label}"),
                sight.difference(&visibility)?,
            )?,
        ];
        let cells = [truth.clone()].into_iter().chain(pictures).map(Some).collect();
        rows.push(GridRow { label: (*label).to_owned(), cells });
    }
    let columns = ["truth", "shaded", "visibility", "difference from the truth"].map(str::to_owned).to_vec();
    Ok(BesideTruth { grid: PictureGrid { columns, rows }, errors })
}
