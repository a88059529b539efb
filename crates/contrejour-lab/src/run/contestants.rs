//! Who is measured: every technique with a small sweep of the parameters that its own literature names.

use contrejour_plan::{DepthPrecision, SettingsError, ShadowSettings, Technique, UnknownTechnique};

use crate::report::{Extent, Parameter};

/// A technique with one set of parameters, before it is measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Entrant {
    /// Names it among all entrants, e.g. `PCSS 16+32, search_max_ndc 0.1`.
    pub label: String,
    /// What it is a variant of, e.g. `PCSS 16+32`.
    pub family: &'static str,
    /// The technique and its parameters.
    pub technique: Technique,
    /// How exactly its maps keep linear depth.
    pub depth_precision: DepthPrecision,
}

/// Why there are no entrants.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EntrantsError {
    /// No family or technique has a name that was asked for.
    #[error("there is no technique or family {name:?} in the report; give one of {}", known.join(", "))]
    Unknown {
        /// The name that was given.
        name: String,
        /// All names.
        known: Vec<String>,
    },
    /// The table of families names a technique that is not there.
    #[error(transparent)]
    Technique(#[from] UnknownTechnique),
    /// The table of families tunes what a technique does not take.
    #[error(transparent)]
    Settings(#[from] SettingsError),
}

/// A technique whose parameters are swept.
struct Family {
    name: &'static str,
    technique: &'static str,
    /// Parameters that make the family what it is.
    fixed: &'static [(&'static str, f64)],
    /// Every combination of these is a variant. The first values make a quick report.
    swept: &'static [Sweep],
    /// Bits in which linear depth is kept. The first makes a quick report.
    depth_bits: &'static [DepthPrecision],
}

/// Values of one parameter.
struct Sweep {
    parameter: &'static str,
    values: &'static [f64],
    /// How many of the values a quick report has.
    quick: usize,
}

const BITS_32: &[DepthPrecision] = &[DepthPrecision::Bits32];
const BOTH_BITS: &[DepthPrecision] = &[DepthPrecision::Bits32, DepthPrecision::Bits16];

const fn sweep(parameter: &'static str, values: &'static [f64], quick: usize) -> Sweep {
    Sweep { parameter, values, quick }
}

/// The plain shadow map is first: all others are compared with it.
const FAMILIES: &[Family] = &[
    Family { name: "shadow map", technique: "shadow-map", fixed: &[], swept: &[], depth_bits: BITS_32 },
    Family { name: "2x2 PCF", technique: "pcf", fixed: &[], swept: &[], depth_bits: BITS_32 },
    Family {
        name: "Gaussian PCF",
        technique: "gaussian-pcf",
        fixed: &[],
        swept: &[sweep("kernel", &[5.0, 7.0, 3.0], 2)],
        depth_bits: BITS_32,
    },
    Family { name: "bicubic PCF", technique: "bicubic-pcf", fixed: &[], swept: &[], depth_bits: BITS_32 },
    Family {
        name: "PCSS 8+8",
        technique: "pcss",
        fixed: &[("blocker_samples", 8.0), ("filter_samples", 8.0)],
        swept: &[sweep("search_max_ndc", &[0.2, 0.05, 0.1, 0.4], 2)],
        depth_bits: BITS_32,
    },
    Family {
        name: "PCSS 16+32",
        technique: "pcss",
        fixed: &[("blocker_samples", 16.0), ("filter_samples", 32.0)],
        swept: &[sweep("search_max_ndc", &[0.2, 0.05, 0.1, 0.4], 2)],
        depth_bits: BITS_32,
    },
    Family {
        name: "VSM",
        technique: "vsm",
        fixed: &[],
        swept: &[sweep("blur_texels", &[4.0, 16.0, 24.0, 8.0, 32.0, 48.0, 2.0], 3), sweep("bleed_cut", &[0.0, 0.2], 1)],
        depth_bits: BOTH_BITS,
    },
    Family {
        name: "EVSM",
        technique: "evsm",
        fixed: &[],
        swept: &[
            sweep("blur_texels", &[4.0, 16.0, 24.0, 8.0, 32.0, 48.0, 2.0], 3),
            sweep("warp_exponent", &[5.54, 10.0], 1),
        ],
        depth_bits: BOTH_BITS,
    },
    Family {
        name: "VSM PCSS",
        technique: "vsm-pcss",
        fixed: &[],
        swept: &[sweep("search_max_ndc", &[0.2, 0.1, 0.4], 1), sweep("bleed_cut", &[0.0, 0.2], 2)],
        depth_bits: BOTH_BITS,
    },
    Family {
        name: "EVSM PCSS",
        technique: "evsm-pcss",
        fixed: &[],
        swept: &[sweep("search_max_ndc", &[0.2, 0.1, 0.4], 1), sweep("warp_exponent", &[5.54, 10.0], 1)],
        depth_bits: BOTH_BITS,
    },
    Family {
        name: "smoothies 0.02",
        technique: "smoothies",
        fixed: &[("width_ndc", 0.02)],
        swept: &[],
        depth_bits: BOTH_BITS,
    },
    Family {
        name: "smoothies 0.08",
        technique: "smoothies",
        fixed: &[("width_ndc", 0.08)],
        swept: &[],
        depth_bits: BOTH_BITS,
    },
    Family { name: "smoothies by light size", technique: "smoothies", fixed: &[], swept: &[], depth_bits: BOTH_BITS },
    Family {
        name: "silhouette map",
        technique: "silhouette-map",
        fixed: &[],
        swept: &[sweep("samples", &[8.0, 1.0, 4.0, 16.0], 2), sweep("width_max_ndc", &[0.1, 0.25], 1)],
        depth_bits: BOTH_BITS,
    },
    Family {
        name: "silhouette map TAM",
        technique: "silhouette-map-tam",
        fixed: &[],
        swept: &[sweep("samples", &[8.0, 1.0], 1)],
        depth_bits: BITS_32,
    },
    Family {
        name: "silhouette map stream",
        technique: "silhouette-map-stream",
        fixed: &[],
        swept: &[sweep("stream_bits", &[32.0, 16.0], 1)],
        depth_bits: BITS_32,
    },
    Family {
        name: "blended silhouette map",
        technique: "silhouette-map",
        fixed: &[("blending", 1.0)],
        swept: &[],
        depth_bits: BOTH_BITS,
    },
    Family {
        name: "blended silhouette map TAM",
        technique: "silhouette-map-tam",
        fixed: &[("blending", 1.0)],
        swept: &[],
        depth_bits: BITS_32,
    },
];

/// All entrants of an extent that were asked for, by the name of their technique or family; all where no name is given.
///
/// # Errors
///
/// A name that nobody has, with those that there are.
pub fn entrants(extent: Extent, names: &[String]) -> Result<Vec<Entrant>, EntrantsError> {
    for name in names {
        if !FAMILIES.iter().any(|family| family.is_called(name)) {
            let mut known: Vec<String> = Technique::NAMES.map(str::to_owned).to_vec();
            known.extend(FAMILIES.iter().map(Family::plain_name).filter(|name| !Technique::NAMES.contains(&&**name)));
            return Err(EntrantsError::Unknown { name: name.clone(), known });
        }
    }
    let wanted = FAMILIES.iter().filter(|family| names.is_empty() || names.iter().any(|name| family.is_called(name)));
    let entrants = wanted.map(|family| family.entrants(extent)).collect::<Result<Vec<_>, _>>()?;
    Ok(entrants.into_iter().flatten().collect())
}

impl Family {
    fn is_called(&self, name: &str) -> bool {
        name == self.technique || name.eq_ignore_ascii_case(self.name) || name == self.plain_name()
    }

    /// Its name as a word on the command line.
    fn plain_name(&self) -> String {
        self.name.to_ascii_lowercase().replace(' ', "-")
    }

    fn entrants(&self, extent: Extent) -> Result<Vec<Entrant>, EntrantsError> {
        let mut variants: Vec<Vec<(&str, f64)>> = vec![Vec::new()];
        for Sweep { parameter, values, quick } in self.swept {
            let values = if extent == Extent::Quick { &values[..*quick] } else { values };
            let with = |variant: &Vec<_>, value: &f64| variant.iter().copied().chain([(*parameter, *value)]).collect();
            variants = variants
                .iter()
                .flat_map(|variant| values.iter().map(|value| with(variant, value)).collect::<Vec<_>>())
                .collect();
        }
        let bits = if extent == Extent::Quick { &self.depth_bits[..1] } else { self.depth_bits };
        let all = bits.iter().flat_map(|&precision| variants.iter().map(move |variant| (variant, precision)));
        all.map(|(variant, precision)| self.entrant(variant, precision)).collect()
    }

    fn entrant(&self, variant: &[(&str, f64)], depth_precision: DepthPrecision) -> Result<Entrant, EntrantsError> {
        let mut technique: Technique = self.technique.parse()?;
        let mut label = self.name.to_owned();
        for (name, value) in self.fixed.iter().chain(variant) {
            technique.set(name, *value)?;
        }
        for (name, value) in variant {
            label.push_str(&format!(", {name} {value}"));
        }
        if self.depth_bits.len() > 1 {
            label.push_str(&format!(", {} bits", bits(depth_precision)));
        }
        Ok(Entrant { label, family: self.name, technique, depth_precision })
    }
}

impl Entrant {
    /// Its shadow settings: all entrants have the same map size and bias policy.
    pub fn settings(&self, scene: &ShadowSettings, map_size: u32) -> ShadowSettings {
        ShadowSettings { technique: self.technique, map_size, depth_precision: self.depth_precision, ..*scene }
    }

    /// What draws it on the command line, as in `--technique pcss --set search_max_ndc=0.1`.
    pub fn arguments(&self) -> String {
        let mut arguments = format!("--technique {}", self.technique);
        for parameter in self.technique.parameters() {
            if let Some(value) = parameter.value {
                arguments.push_str(&format!(" --set {}={value}", parameter.name));
            }
        }
        arguments.push_str(&format!(" --depth-bits {}", bits(self.depth_precision)));
        arguments
    }

    /// Its parameters as the report has them.
    pub(super) fn parameters(&self) -> Vec<Parameter> {
        let tuned = self.technique.parameters().into_iter().map(|parameter| Parameter {
            name: parameter.name.to_owned(),
            value: parameter.value.map_or_else(|| "from the light's size".to_owned(), |value| value.to_string()),
        });
        let depth = Parameter { name: "depth_bits".to_owned(), value: bits(self.depth_precision).to_string() };
        tuned.chain([depth]).collect()
    }
}

fn bits(precision: DepthPrecision) -> u32 {
    match precision {
        DepthPrecision::Bits32 => 32,
        DepthPrecision::Bits16 => 16,
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    fn all(extent: Extent) -> Vec<Entrant> {
        entrants(extent, &[]).expect("nothing is asked for by name")
    }

    #[test]
    fn every_family_is_complete_and_every_label_unique() {
        for family in FAMILIES {
            let variants: usize = family.swept.iter().map(|sweep| sweep.values.len()).product();
            let entrants = family.entrants(Extent::Full).expect("the table is good");
            assert_eq!(entrants.len(), variants * family.depth_bits.len(), "{}", family.name);
            assert!(family.swept.iter().all(|sweep| (1..=sweep.values.len()).contains(&sweep.quick)));
            assert!(family.entrants(Extent::Quick).is_ok_and(|quick| !quick.is_empty()));
        }
        let entrants = all(Extent::Full);
        let labels: HashSet<_> = entrants.iter().map(|entrant| &entrant.label).collect();
        let settings: HashSet<_> = entrants.iter().map(Entrant::arguments).collect();
        assert_eq!([labels.len(), settings.len()], [entrants.len(); 2]);
        assert!(all(Extent::Quick).iter().all(|quick| entrants.contains(quick)));
        assert_eq!(entrants[0].technique.name(), crate::report::BASELINE_TECHNIQUE);
    }

    #[test]
    fn every_technique_takes_part() {
        for extent in [Extent::Quick, Extent::Full] {
            let present: HashSet<_> = all(extent).iter().map(|entrant| entrant.technique.name()).collect();
            assert_eq!(present, Technique::NAMES.into_iter().collect(), "{extent:?}");
        }
    }

    #[test]
    fn settings_are_good() {
        for entrant in all(Extent::Full) {
            let settings = entrant.settings(&ShadowSettings::default(), 512);
            assert_eq!(settings.validate(), Ok(()), "{}", entrant.label);
            assert_eq!(settings.map_size, 512);
        }
    }

    #[test]
    fn names_choose_techniques_and_families() {
        let count = |names: &[&str]| {
            let names: Vec<String> = names.iter().map(|&name| name.into()).collect();
            entrants(Extent::Full, &names).map(|entrants| entrants.len())
        };
        assert_eq!(count(&["pcss"]), Ok(8));
        assert_eq!(count(&["pcss-8+8", "shadow-map", "PCSS 8+8"]), Ok(5));
        assert_eq!(count(&["smoothies"]), Ok(6));
        let error = count(&["magic"]).expect_err("nobody is called so").to_string();
        assert!(error.contains("\"magic\"") && error.contains("pcss-16+32") && error.contains("vsm"), "{error}");
    }
}
