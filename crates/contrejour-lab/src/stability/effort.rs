//! How much is tried.

use contrejour_plan::DeviceFacts;

use crate::report::Extent;

/// How much is tried, and with which random numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Everything, or a few cases a family.
    pub extent: Extent,
    /// Seed of everything random.
    pub seed: u64,
    /// Texels along the side of the device's largest map, which a [run](super::run) fills in. Default: WebGPU's 8192.
    pub largest_map: u32,
}

impl Effort {
    /// For a device of which nothing is known.
    pub fn new(extent: Extent, seed: u64) -> Self {
        Self { extent, seed, largest_map: DeviceFacts::default().max_texture_dimension_2d }
    }

    /// Powers of ten with these exponents, both ends included: every `step`, or just ends and middle.
    pub fn powers_of_ten(&self, from: i32, to: i32, step: i32) -> Vec<(String, f64)> {
        let exponents: Vec<i32> = match self.extent {
            Extent::Full => (from..to).step_by(step as usize).chain([to]).collect(),
            Extent::Quick => vec![from, (from + to) / 2, to],
        };
        // Parsed, since powers computed by multiplication are not the nearest doubles.
        let power = |exponent: i32| format!("1e{exponent}");
        exponents.into_iter().map(|exponent| (power(exponent), power(exponent).parse().unwrap_or_default())).collect()
    }

    /// All of some values, or the first, the middle and the last.
    pub fn some_of<T: Clone>(&self, values: &[T]) -> Vec<T> {
        match self.extent {
            Extent::Quick if values.len() > 3 => {
                [0, values.len() / 2, values.len() - 1].map(|index| values[index].clone()).to_vec()
            }
            _ => values.to_vec(),
        }
    }
}
