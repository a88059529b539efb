//! Whether answers are what they should be, within what their standard errors allow.

use contrejour_trace::Visibility;

/// How answers differ from the truth.
#[derive(Debug)]
pub struct Differences {
    pub count: f64,
    /// Mean of z = (mean - exact) / standard error.
    pub z_mean: f64,
    /// Standard deviation of z around 0.
    pub z_deviation: f64,
    pub largest_z: f64,
    pub largest_error: f64,
    pub rms_error: f64,
}

impl Differences {
    pub fn of(answers: &[Visibility], exact: &[f64]) -> Self {
        assert_eq!(answers.len(), exact.len());
        let count = exact.len() as f64;
        let errors: Vec<f64> = answers.iter().zip(exact).map(|(answer, exact)| answer.mean - exact).collect();
        let z: Vec<f64> = answers.iter().zip(&errors).map(|(answer, error)| error / answer.standard_error).collect();
        let largest = |values: &[f64]| values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let rms = |values: &[f64]| (values.iter().map(|value| value * value).sum::<f64>() / count).sqrt();
        Self {
            count,
            z_mean: z.iter().sum::<f64>() / count,
            z_deviation: rms(&z),
            largest_z: largest(&z),
            largest_error: largest(&errors),
            rms_error: rms(&errors),
        }
    }

    /// Whether z is distributed like Student's t with 7 degrees of freedom (8 replicates), and the errors are bounded.
    ///
    /// That has mean 0, standard deviation sqrt(7 / 5) = 1.18 and kurtosis 5. Means over n values spread by
    /// 1.18 / sqrt(n), standard deviations by about as much: four times that is allowed. Beyond 12 lies one value in
    /// 160 000.
    pub fn check(&self) -> Result<(), String> {
        let student = (7.0_f64 / 5.0).sqrt();
        let slack = 4.0 * student / self.count.sqrt();
        let require = |holds: bool, what: &str| if holds { Ok(()) } else { Err(format!("{what}: {self:?}")) };
        require(self.count >= 200.0, "too few receivers to tell")?;
        require(self.z_mean.abs() < slack, "biased")?;
        require((self.z_deviation - student).abs() < slack, "the standard errors are wrong, or the means are")?;
        require(self.largest_z < 12.0, "an answer is off by more than chance explains")?;
        require(self.largest_error < 0.01, "an answer is off by a hundredth")
    }
}
