//! The numbers that a technique can be tuned by, by name.

use core::fmt;
use core::ops::Bound;

use super::{
    GaussianKernel, GaussianPcfSettings, PcssSettings, SettingsError, SilhouetteMapSettings, SilhouetteSource,
    SilhouetteWinner, SmoothieSettings, SmoothieWidth, StreamPrecision, Technique, VarianceSettings, VarianceSoftness,
};

/// A number that a technique can be tuned by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Its name on the command line and in scene files.
    pub name: &'static str,
    /// What it holds; `None` where it comes from the light's size.
    pub value: Option<f64>,
    /// What it may hold.
    pub range: ParameterRange,
}

/// What a parameter may hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParameterRange {
    /// Any number from the first to the second.
    Between(f64, f64),
    /// Any number above the first, up to the second.
    Above(f64, f64),
    /// Any whole number from the first to the second.
    Whole(u32, u32),
    /// An odd number of texels for which there is a kernel.
    Kernel,
    /// The bits of the floats of a stream.
    StreamBits,
}

impl ParameterRange {
    /// Whether it holds a value; NaN is in no range.
    pub fn contains(&self, value: f64) -> bool {
        use core::ops::RangeBounds;
        match *self {
            Self::Between(least, most) => (least..=most).contains(&value),
            Self::Above(limit, most) => (Bound::Excluded(limit), Bound::Included(most)).contains(&value),
            Self::Whole(least, most) => value.fract() == 0.0 && (least.into()..=most.into()).contains(&value),
            Self::Kernel => kernel(value).is_some(),
            Self::StreamBits => stream_precision(value).is_some(),
        }
    }
}

impl fmt::Display for ParameterRange {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Between(least, most) => write!(formatter, "{least} to {most}"),
            Self::Above(limit, most) => write!(formatter, "more than {limit}, up to {most}"),
            Self::Whole(least, most) => write!(formatter, "a whole number from {least} to {most}"),
            Self::Kernel => {
                formatter.write_str(&GaussianKernel::ALL.map(|kernel| kernel.texels().to_string()).join(" or "))
            }
            Self::StreamBits => {
                formatter.write_str(&StreamPrecision::ALL.map(|precision| precision.bits().to_string()).join(" or "))
            }
        }
    }
}

/// Where a parameter is kept.
enum Slot<'a> {
    Number(&'a mut f32),
    Count(&'a mut u32),
    Kernel(&'a mut GaussianKernel),
    Width(&'a mut SmoothieWidth),
    Blending(&'a mut SilhouetteWinner),
    StreamBits(&'a mut StreamPrecision),
}

impl Slot<'_> {
    fn value(&self) -> Option<f64> {
        Some(match self {
            // The shortest decimal that means the same number: 0.2 and not 0.20000000298.
            Self::Number(value) => value.to_string().parse().unwrap_or((**value).into()),
            Self::Count(value) => (**value).into(),
            Self::Kernel(kernel) => kernel.texels().into(),
            Self::Width(SmoothieWidth::Ndc(width)) => width.to_string().parse().unwrap_or((*width).into()),
            Self::Width(SmoothieWidth::FromLightSize) => return None,
            Self::Blending(winner) => f64::from(u8::from(**winner == SilhouetteWinner::ByBlending)),
            Self::StreamBits(precision) => precision.bits().into(),
        })
    }

    /// Takes a value that is in the parameter's range.
    fn set(&mut self, value: f64) {
        match self {
            Self::Number(number) => **number = value as f32,
            Self::Count(count) => **count = value as u32,
            Self::Kernel(slot) => **slot = kernel(value).unwrap_or(**slot),
            Self::Width(width) => **width = SmoothieWidth::Ndc(value as f32),
            Self::Blending(winner) if value == 1.0 => **winner = SilhouetteWinner::ByBlending,
            Self::Blending(winner) => **winner = SilhouetteWinner::ByDepth,
            Self::StreamBits(precision) => **precision = stream_precision(value).unwrap_or(**precision),
        }
    }
}

fn kernel(value: f64) -> Option<GaussianKernel> {
    GaussianKernel::ALL.into_iter().find(|kernel| f64::from(kernel.texels()) == value)
}

fn stream_precision(value: f64) -> Option<StreamPrecision> {
    StreamPrecision::ALL.into_iter().find(|precision| f64::from(precision.bits()) == value)
}

const NDC: ParameterRange = ParameterRange::Above(0.0, 2.0);
const SAMPLES: ParameterRange = ParameterRange::Whole(1, 1024);

impl Technique {
    /// The numbers that it can be tuned by, with what they hold.
    pub fn parameters(&self) -> Vec<Parameter> {
        let mut copy = *self;
        let slots = copy.slots();
        slots.into_iter().map(|(name, range, slot)| Parameter { name, value: slot.value(), range }).collect()
    }

    /// Tunes it.
    ///
    /// # Errors
    ///
    /// It has no such parameter, or the value is out of range; then nothing has changed.
    pub fn set(&mut self, name: &str, value: f64) -> Result<(), SettingsError> {
        let technique = self.name();
        let mut slots = self.slots();
        let known = slots.iter().map(|(name, ..)| *name).collect();
        match slots.iter_mut().find(|(known, ..)| *known == name) {
            None => Err(SettingsError::UnknownParameter { technique, name: name.to_owned(), known }),
            // As the device gets it, so that nothing is out of range after rounding.
            Some((name, range, _)) if !range.contains(f64::from(value as f32)) => {
                Err(SettingsError::Parameter { name, value, range: *range })
            }
            Some((.., slot)) => {
                slot.set(value);
                Ok(())
            }
        }
    }

    fn slots(&mut self) -> Vec<(&'static str, ParameterRange, Slot<'_>)> {
        match self {
            Self::ShadowMap | Self::Pcf | Self::BicubicPcf => Vec::new(),
            Self::GaussianPcf(GaussianPcfSettings { kernel }) => {
                vec![("kernel", ParameterRange::Kernel, Slot::Kernel(kernel))]
            }
            Self::Pcss(PcssSettings { blocker_samples, filter_samples, search_max_ndc }) => vec![
                ("blocker_samples", SAMPLES, Slot::Count(blocker_samples)),
                ("filter_samples", SAMPLES, Slot::Count(filter_samples)),
                ("search_max_ndc", NDC, Slot::Number(search_max_ndc)),
            ],
            Self::Variance(VarianceSettings { warp_exponent, softness, bleed_cut, min_variance }) => {
                let mut slots = vec![match softness {
                    VarianceSoftness::Texels(texels) => {
                        ("blur_texels", ParameterRange::Between(0.0, 1024.0), Slot::Number(texels))
                    }
                    VarianceSoftness::FromLightSize { search_max_ndc } => {
                        ("search_max_ndc", NDC, Slot::Number(search_max_ndc))
                    }
                }];
                // A plain map stays one, and a warped one too: they have names of their own.
                if *warp_exponent != 0.0 {
                    slots.push(("warp_exponent", ParameterRange::Above(0.0, 42.0), Slot::Number(warp_exponent)));
                }
                slots.push(("bleed_cut", ParameterRange::Between(0.0, 0.95), Slot::Number(bleed_cut)));
                slots.push(("min_variance", ParameterRange::Between(0.0, 1.0), Slot::Number(min_variance)));
                slots
            }
            Self::Smoothies(SmoothieSettings { width, width_max_ndc, .. }) => {
                vec![("width_ndc", NDC, Slot::Width(width)), ("width_max_ndc", NDC, Slot::Number(width_max_ndc))]
            }
            Self::SilhouetteMap(SilhouetteMapSettings {
                source, edge_texels, width_max_ndc, samples, winner, ..
            }) => {
                let mut slots = vec![
                    ("edge_texels", ParameterRange::Above(0.0, 4.0), Slot::Number(edge_texels)),
                    ("width_max_ndc", NDC, Slot::Number(width_max_ndc)),
                    ("samples", SAMPLES, Slot::Count(samples)),
                    ("blending", ParameterRange::Whole(0, 1), Slot::Blending(winner)),
                ];
                if let SilhouetteSource::Stream(precision) = source {
                    slots.push(("stream_bits", ParameterRange::StreamBits, Slot::StreamBits(precision)));
                }
                slots
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn techniques() -> impl Iterator<Item = Technique> {
        Technique::NAMES.iter().map(|name| name.parse().expect("listed"))
    }

    #[test]
    fn defaults_are_in_range_and_what_is_set_comes_back() {
        for mut technique in techniques() {
            let name = technique.name();
            for parameter in technique.parameters() {
                let good = match parameter.range {
                    ParameterRange::Between(_, most) | ParameterRange::Above(_, most) => most,
                    ParameterRange::Whole(_, most) => most.into(),
                    ParameterRange::Kernel => 7.0,
                    ParameterRange::StreamBits => 16.0,
                };
                assert!(parameter.value.is_none_or(|value| parameter.range.contains(value)), "{name} {parameter:?}");
                assert_eq!(technique.set(parameter.name, good), Ok(()));
                let now = technique.parameters().into_iter().find(|now| now.name == parameter.name);
                let value = now.and_then(|now| now.value).expect("it was just set");
                assert!((value - good).abs() <= 1e-6 * good, "{name} {}", parameter.name);
                assert_eq!(technique.name(), name, "tuning does not make it another technique");
            }
        }
    }

    #[test]
    fn what_is_out_of_range_or_unknown_is_refused() {
        for mut technique in techniques() {
            let before = technique;
            for parameter in technique.parameters() {
                for bad in [-1.0, 1e9, f64::NAN, f64::INFINITY] {
                    assert!(technique.set(parameter.name, bad).is_err(), "{technique} {} {bad}", parameter.name);
                }
            }
            let error = technique.set("magic", 1.0).expect_err("no such parameter");
            assert!(matches!(error, SettingsError::UnknownParameter { .. }));
            assert_eq!(technique, before);
        }
    }

    #[test]
    fn ranges_are_told() {
        let mut pcss = Technique::Pcss(PcssSettings::DEFAULT);
        let error = pcss.set("filter_samples", 2.5).expect_err("not whole");
        assert_eq!(error.to_string(), "filter_samples is 2.5: give a whole number from 1 to 1024");
        let error = pcss.set("kernel", 5.0).expect_err("of another technique").to_string();
        assert_eq!(
            error,
            "the technique pcss has no parameter \"kernel\": give one of blocker_samples, filter_samples, search_max_ndc"
        );
        let mut pcf = Technique::Pcf;
        let error = pcf.set("kernel", 5.0).expect_err("it has none").to_string();
        assert_eq!(error, "the technique pcf has no parameter \"kernel\": it has none");
    }
}
