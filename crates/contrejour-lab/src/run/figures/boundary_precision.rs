//! How exactly techniques find the edge of a hard shadow, in numbers and in pictures.

use super::super::error::RunError;
use super::super::lab::Lab;
use super::boundary::{BoundaryError, BoundaryScene, Outline};
use super::methods::{
    Method, SHADOW_MAP, SILHOUETTE_MAP, SILHOUETTE_MAP_HALF_STREAM, SILHOUETTE_MAP_STREAM, SILHOUETTE_MAP_TAM, THIN,
    TWO_BY_TWO,
};
use crate::report::{Axis, Body, Extent, Figure, GridRow, PictureGrid, Plot, Scale, Series, Stroke};

const METHODS: [Method; 7] = [
    SHADOW_MAP,
    TWO_BY_TWO,
    THIN,
    SILHOUETTE_MAP,
    SILHOUETTE_MAP_TAM,
    SILHOUETTE_MAP_STREAM,
    SILHOUETTE_MAP_HALF_STREAM,
];

const OUTLINES: [(Outline, &str); 2] = [(Outline::Straight, "straight"), (Outline::Round, "round")];

/// Texels along the map's side. Every second one makes a quick figure.
const MAP_SIZES: [u32; 4] = [256, 512, 1024, 2048];

/// The size of the pictures.
const SIZE: [u32; 2] = [320, 240];

/// The map size of the pictures.
const PICTURED: u32 = 512;

/// A method's error on an outline at one map size.
struct Measured {
    outline: &'static str,
    method: &'static str,
    map_size: u32,
    error: BoundaryError,
}

pub(super) fn precision(lab: &Lab) -> Result<Figure, RunError> {
    let step = if lab.options.effort.extent == Extent::Quick { 2 } else { 1 };
    let mut measured = Vec::new();
    for (outline, name) in OUTLINES {
        for map_size in MAP_SIZES.into_iter().step_by(step) {
            let scene = BoundaryScene::new(lab.gpu, outline, map_size, SIZE)?;
            for method in METHODS {
                let visibility = scene.visibility(|shadow| method.settings(shadow, map_size))?;
                let error = scene.error(&visibility);
                measured.push(Measured { outline: name, method: method.label, map_size, error });
            }
        }
    }
    let mut series = Vec::new();
    for (_, outline) in OUTLINES {
        for method in METHODS {
            series.push(Series {
                label: format!("{}, {outline}", method.label),
                points: points(&measured, outline, method.label),
                stroke: Stroke::Line,
            });
        }
    }
    let plot = Plot {
        x: Axis { label: "texels along the map's side".to_owned(), scale: Scale::Log },
        y: Axis { label: "mean distance from the true edge, texels".to_owned(), scale: Scale::Log },
        series,
    };
    let caption = format!(
        "Where visibility is one half, on a floor under a light without size, and how far that is from the outline of a \
         sheet as the light sees it: a turned square and a disk of 512 corners. Smoothies of a given width (t = 0.02) lie \
         outside the outline, so their middle does. {}",
        told(&measured),
    );
    Ok(Figure { title: "Precision of a shadow's boundary".to_owned(), caption, body: Body::Plot(plot) })
}

fn points(measured: &[Measured], outline: &str, method: &str) -> Vec<[f64; 2]> {
    let of_series = measured.iter().filter(|one| one.outline == outline && one.method == method);
    // An edge that is nowhere has no distance.
    let seen = of_series.filter(|one| one.error.mean > 0.0);
    seen.map(|one| [f64::from(one.map_size), one.error.mean]).collect()
}

/// How much nearer silhouette maps are than plain ones, at each size at least.
fn told(measured: &[Measured]) -> String {
    let find = |outline: &str, method: Method, map_size: u32| {
        let is_it = |one: &&Measured| (one.outline, one.method, one.map_size) == (outline, method.label, map_size);
        measured.iter().find(is_it).map(|one| one.error.mean)
    };
    let ratios = measured.iter().filter(|one| one.method == SHADOW_MAP.label).filter_map(|one| {
        let silhouettes = find(one.outline, SILHOUETTE_MAP, one.map_size)?;
        (silhouettes > 0.0).then(|| one.error.mean / silhouettes)
    });
    match ratios.reduce(f64::min) {
        Some(least) => format!("The silhouette map's edge is at least {least:.1} times as near as the plain map's."),
        None => "No edge was seen.".to_owned(),
    }
}

pub(super) fn pictures(lab: &Lab) -> Result<Figure, RunError> {
    let mut rows = Vec::new();
    let mut errors = Vec::new();
    for (outline, name) in OUTLINES {
        let scene = BoundaryScene::new(lab.gpu, outline, PICTURED, SIZE)?;
        let mut cells = Vec::new();
        for method in METHODS {
            let visibility = scene.visibility(|shadow| method.settings(shadow, PICTURED))?;
            let BoundaryError { mean, largest, .. } = scene.error(&visibility);
            errors.push(format!("{name}, {}: {mean:.3} and {largest:.3}", method.label));
            let alt = format!("{} edge, {}", name, method.label);
            let file = format!("{name}-{}", method.file);
            cells.push(Some(lab.keep_picture("figure-boundary", &file, &alt, &scene.grey(&visibility)?)?));
        }
        rows.push(GridRow { label: name.to_owned(), cells });
    }
    let columns = METHODS.iter().map(|method| method.label.to_owned()).collect();
    let caption = format!(
        "Some forty texels of the edge of a hard shadow at {PICTURED} texels, as each technique shows it. Mean and largest \
         distance from the true edge, in texels: {}.",
        errors.join("; "),
    );
    let body = Body::Pictures(PictureGrid { columns, rows });
    Ok(Figure { title: "The boundary of a shadow in pictures".to_owned(), caption, body })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_told_follows_the_errors() {
        let measured = |mean: f64| {
            [(SHADOW_MAP, 0.25), (SILHOUETTE_MAP, mean)].map(|(method, mean)| Measured {
                outline: "round",
                method: method.label,
                map_size: 512,
                error: BoundaryError { crossings: 9, mean, largest: 1.0 },
            })
        };
        let expected = "The silhouette map's edge is at least 12.5 times as near as the plain map's.";
        assert_eq!(told(&measured(0.02)), expected);
        assert_ne!(told(&measured(0.03)), expected);
        assert_eq!(points(&measured(0.5), "round", SILHOUETTE_MAP.label), [[512.0, 0.5]]);
    }
}
