//! Percentage-closer filters.

use contrejour_plan::LightKind;
use contrejour_tests::harness::Outcome;

use super::judged_scene::{Care, JudgedScene, falls_to, plates, rmse, settings};

/// One plate over a floor, both parallel to the light's disk: there the blockers' mean depth is the blocker's depth, and
/// percentage-closer filtering over the disk's image is the visible share of the disk.
pub fn many_samples_are_the_truth() -> Outcome {
    let mut scene = plates(&[("[1.4, 1.2]", "[0.1, 1.6, 0]")])?;
    scene.keep_floor();
    let truth = scene.truth(scene.light(), Care::Fine)?;
    falls_to(0.012, &pcss_errors(&scene, &truth)?)?;

    // A truth of a light that is a fifth larger is another one.
    let mut larger = *scene.light();
    let LightKind::Spot { radius, .. } = &mut larger.kind else { return Err("the light is a spot".into()) };
    *radius *= 1.2;
    let planted = falls_to(0.012, &pcss_errors(&scene, &scene.truth(&larger, Care::Fine)?)?);
    if planted.is_err() { Ok(()) } else { Err("a larger light passes".into()) }
}

fn pcss_errors(scene: &JudgedScene, truth: &[f64]) -> Result<Vec<f64>, String> {
    let error = |samples: f64| {
        let parameters = [("blocker_samples", samples), ("filter_samples", samples), ("search_max_ndc", 2.0)];
        Ok(rmse(&scene.visibility(&settings("pcss", &parameters, 1024))?, truth))
    };
    [8.0, 32.0, 512.0].into_iter().map(error).collect()
}

/// The smaller the kernel, the nearer the filter comes to the comparison with one texel.
pub fn small_kernels_are_hard() -> Outcome {
    let mut scene = plates(&[("[1.4, 1.2]", "[0.1, 1.6, 0]")])?;
    scene.keep_floor();
    const MAP_SIZE: u32 = 256;
    let hard = scene.visibility(&settings("shadow-map", &[], MAP_SIZE))?;
    if hard.iter().any(|visibility| *visibility != 0.0 && *visibility != 1.0) {
        return Err("one comparison gives something between 0 and 1".into());
    }
    let filters = [
        settings("gaussian-pcf", &[("kernel", 7.0)], MAP_SIZE),
        settings("gaussian-pcf", &[("kernel", 5.0)], MAP_SIZE),
        settings("gaussian-pcf", &[("kernel", 3.0)], MAP_SIZE),
        settings("pcf", &[], MAP_SIZE),
    ];
    let errors = |filters: &[_]| -> Result<Vec<f64>, String> {
        filters.iter().map(|filter| Ok(rmse(&scene.visibility(filter)?, &hard))).collect()
    };
    falls_to(0.1, &errors(&filters)?)?;
    // And on finer maps, whose texels are smaller.
    let finer = [256, 512, 1024].map(|size| settings("gaussian-pcf", &[("kernel", 5.0)], size));
    let mut point = *scene.light();
    let LightKind::Spot { radius, .. } = &mut point.kind else { return Err("the light is a spot".into()) };
    *radius = 0.0;
    let truth = scene.truth(&point, Care::Fine)?;
    let errors_on_finer_maps: Result<Vec<f64>, String> =
        finer.iter().map(|filter| Ok(rmse(&scene.visibility(filter)?, &truth))).collect();
    falls_to(0.1, &errors_on_finer_maps?)?;

    let mut planted = filters;
    planted.swap(0, 3);
    if falls_to(0.1, &errors(&planted)?).is_err() { Ok(()) } else { Err("growing kernels pass".into()) }
}
