//! Where an axis starts, ends and has its ticks.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

use super::super::figure::Scale;
use super::super::number::tick;

/// An axis with its ticks.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Ticks {
    scale: Scale,
    low: f64,
    high: f64,
    ticks: Vec<f64>,
}

/// Most ticks of a logarithmic axis that has one a decade.
const TICKS_MAX: usize = 10;

impl Ticks {
    /// An axis that holds some values, which have a place on its scale; none where there is no value.
    pub(super) fn around(values: impl Iterator<Item = f64>, scale: Scale) -> Option<Self> {
        let mut values: Vec<f64> = values.collect();
        values.sort_by(f64::total_cmp);
        values.dedup();
        let (&least, &most) = values.first().zip(values.last())?;
        Some(match scale {
            Scale::Linear => Self::linear(most),
            Scale::Log if are_map_sizes(&values) => Self { ticks: values, ..Self::log(least, most) },
            Scale::Log => Self::log(least, most),
        })
    }

    fn linear(most: f64) -> Self {
        let most = if most > 0.0 { most } else { 1.0 };
        let step = round_step(most);
        // Rounding may put the most a hair beyond its own tick.
        let steps = (most / step * (1.0 - 1e-9)).ceil();
        let ticks = (0..=steps as u32).map(|i| f64::from(i) * step).collect();
        Self { scale: Scale::Linear, low: 0.0, high: steps * step, ticks }
    }

    fn log(least: f64, most: f64) -> Self {
        // Room for marks at the ends; a single value gets a decade.
        let pad = if most > least { (most / least).powf(0.06).max(1.1) } else { 10_f64.sqrt() };
        let [low, high] = [least / pad, most * pad];
        let decades = low.log10().floor() as i32..=high.log10().ceil() as i32;
        // Of a hundred decades only some have a tick.
        let decade_step =
            [1, 2, 5, 10, 20, 50, 100].into_iter().find(|step| decades.clone().count() / step < TICKS_MAX);
        let decades = decades.step_by(decade_step.unwrap_or(200));
        let step = round_step(high - low);
        let even = (1..).map(|i| f64::from(i) * step).skip_while(|&tick| tick < low).take_while(|&tick| tick <= high);
        let in_decades = |factors: &[f64]| -> Vec<f64> {
            let all = decades.clone().flat_map(|decade| factors.iter().map(move |factor| factor * 10_f64.powi(decade)));
            all.filter(|tick| (low..=high).contains(tick)).collect()
        };
        // The coarsest ticks of which there are enough.
        let choices = [in_decades(&[1.0]), in_decades(&[1.0, 2.0, 5.0])];
        let ticks = choices.into_iter().find(|ticks| ticks.len() >= 3).unwrap_or_else(|| even.collect());
        Self { scale: Scale::Log, low, high, ticks }
    }

    /// Where a value is along the axis: 0 at its start, 1 at its end.
    fn share(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => (value - self.low) / (self.high - self.low),
            Scale::Log => (value / self.low).ln() / (self.high / self.low).ln(),
        }
    }
}

/// Whether values are a few powers of two, as the sizes of maps are: each is then a tick of its own.
fn are_map_sizes(values: &[f64]) -> bool {
    let is_power_of_two = |value: f64| value >= 2.0 && value.log2().fract() == 0.0;
    (3..=9).contains(&values.len()) && values.iter().copied().all(is_power_of_two)
}

/// A step of 1, 2 or 5 times a power of ten that fits four to nine times into a length.
fn round_step(length: f64) -> f64 {
    let most = length / 4.0;
    let power = 10_f64.powf(most.log10().floor());
    [5.0, 2.0].into_iter().find(|step| step * power <= most).unwrap_or(1.0) * power
}

impl Ranged for Ticks {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (start, end): (i32, i32)) -> i32 {
        start + (self.share(*value) * f64::from(end - start)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _hint: Hint) -> Vec<f64> {
        self.ticks.clone()
    }

    fn range(&self) -> Range<f64> {
        self.low..self.high
    }
}

impl ValueFormatter<f64> for Ticks {
    fn format_ext(&self, value: &f64) -> String {
        tick(*value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ticks(values: &[f64], scale: Scale) -> Ticks {
        Ticks::around(values.iter().copied(), scale).expect("there are values")
    }

    #[test]
    fn linear_axes_start_from_zero_and_hold_the_most() {
        let axis = ticks(&[0.14, 0.05], Scale::Linear);
        assert_eq!(
            axis.ticks.iter().copied().map(tick).collect::<Vec<_>>(),
            ["0", "0.02", "0.04", "0.06", "0.08", "0.1", "0.12", "0.14"]
        );
        assert_eq!(axis.map(&0.07, (0, 100)), 50);
        for most in [1e-6, 0.3, 1.0, 9.99, 10.0, 123.0, 7e9] {
            let axis = ticks(&[most], Scale::Linear);
            assert!(axis.high >= most && (4..=10).contains(&axis.ticks.len()), "{most}: {axis:?}");
        }
        assert_eq!(ticks(&[0.0], Scale::Linear).high, 1.0);
    }

    #[test]
    fn sizes_of_maps_are_their_own_ticks() {
        let sizes = [1024.0, 256.0, 512.0, 256.0, 2048.0];
        assert_eq!(ticks(&sizes, Scale::Log).ticks, [256.0, 512.0, 1024.0, 2048.0]);
        assert_ne!(ticks(&[256.0, 500.0, 1024.0], Scale::Log).ticks, [256.0, 500.0, 1024.0]);
    }

    #[test]
    fn log_axes_have_a_few_ticks() {
        for (least, most) in
            [(1.0, 1.0), (0.9, 1.4), (0.5, 4.0), (256.0, 8192.0), (10.0, 1e7), (1e-8, 10.0), (1e-45, 1e38)]
        {
            let axis = ticks(&[most, least], Scale::Log);
            assert!(axis.low < least && axis.high > most, "{axis:?}");
            assert!((3..=9).contains(&axis.ticks.len()), "{axis:?}");
            assert!(axis.ticks.is_sorted());
        }
        let axis = ticks(&[1.0, 100.0], Scale::Log);
        assert_eq!(axis.ticks, [1.0, 10.0, 100.0]);
        assert_eq!(axis.map(&10.0, (0, 100)), 50);
        // Turned round, as plotters asks for the vertical axis.
        assert_eq!(axis.map(&axis.high, (100, 0)), 0);
    }
}
