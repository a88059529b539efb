//! Light without colour, and light beyond all measure.

use super::super::case::Case;
use super::super::effort::Effort;
use super::super::family::Family;
use super::super::plates::{HEIGHT, lamp_and_sky, plate_over_floor};
use crate::report::Scale;

pub(super) const INTENSITY: Family = Family {
    name: "intensity",
    stresses: "The light's colour times intensity from nothing to the largest number, in one channel and in all.",
    parameter: "colour times intensity",
    scale: Scale::Log,
    cases,
};

fn cases(effort: &Effort) -> Vec<Case> {
    let none = [("0".to_owned(), 0.0)];
    let largest = [("3.4028235e38".to_owned(), f64::from(f32::MAX)), ("1e39".to_owned(), 1e39)];
    let intensities = none.into_iter().chain(effort.powers_of_ten(-45, 38, 3)).chain(largest);
    let cases = intensities.flat_map(|(name, intensity)| {
        let intensity_f32 = intensity as f32;
        lamp_and_sky().into_iter().zip([[1.0, 1.0, 1.0], [1.0, 0.0, 0.5]]).map(move |((light_name, light), share)| {
            let mut case = plate_over_floor(format!("{name}, {light_name}"), intensity, HEIGHT, light);
            case.refusal_is_due = intensity > f64::from(f32::MAX);
            case.light.color = share.map(|share| if share > 0.0 { share * intensity_f32 } else { 0.0 });
            case
        })
    });
    cases.collect()
}
