//! Every technique on an ordinary scene, and under light beyond measure.

use contrejour_plan::{DepthPrecision, ShadowSettings, SmoothieBlend, SmoothieSettings, Technique};

use super::super::case::Case;
use super::super::effort::Effort;
use super::super::family::Family;
use super::super::plates::{HEIGHT, lamp_and_sky, plate_over_floor};
use crate::report::Scale;

pub(super) const TECHNIQUES: Family = Family {
    name: "techniques",
    stresses: "Every technique, with depth of 32 and of 16 bits, and smoothies in one pass and in two, under light of the \
               largest number.",
    parameter: "the technique's number",
    scale: Scale::Linear,
    cases,
};

fn cases(_: &Effort) -> Vec<Case> {
    let two_passes = SmoothieSettings { blend: SmoothieBlend::TwoPasses, ..SmoothieSettings::DEFAULT };
    let techniques = Technique::NAMES.into_iter().filter_map(|name| Some((name, name.parse().ok()?)));
    let techniques = techniques.chain([("smoothies in two passes", Technique::Smoothies(two_passes))]);
    let precisions = [("32 bits", DepthPrecision::Bits32), ("16 bits", DepthPrecision::Bits16)];
    let cases = techniques.enumerate().flat_map(|(number, (name, technique))| {
        precisions.into_iter().zip(lamp_and_sky()).map(move |((bits, depth_precision), (light_name, light))| {
            let parameter = format!("{name}, {bits}, {light_name}");
            let mut case = plate_over_floor(parameter, number as f64, HEIGHT, light);
            case.settings = ShadowSettings { technique, depth_precision, ..case.settings };
            case.light.color = [f32::MAX; 3];
            case
        })
    });
    cases.collect()
}
