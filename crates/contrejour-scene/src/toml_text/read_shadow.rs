//! The sections `shadow`: the scene's, and those of its lights.

use contrejour_plan::{AlphaRemap, DepthPrecision, EdgeProfile, SettingsError, ShadowSettings, Technique};

use super::value::{ANY, NOT_NEGATIVE, Value};
use crate::{Problem, SceneError};

const PRESETS: &[&str] = &["low", "medium", "high", "ultra"];
const REMAPS: &[&str] = &["contact", "off"];
const PROFILES: &[&str] = &["linear", "disk"];
const KEYS: &[&str] = &[
    "technique",
    "preset",
    "map_size",
    "depth_bits",
    "bias_constant_texels",
    "bias_slope_texels",
    "bias_normal_texels",
    "bias_smoothie_texels",
    "remap",
    "profile",
    "width_ndc",
    "width_max_ndc",
    "kernel",
    "blocker_samples",
    "filter_samples",
    "search_max_ndc",
    "blur_texels",
    "warp_exponent",
    "bleed_cut",
    "min_variance",
    "edge_texels",
    "samples",
    "blending",
    "stream_bits",
];
/// Those of the keys that are parameters of one technique or another.
const PARAMETERS: &[&str] = KEYS.split_at(10).1;
/// The largest side of a texture that devices commonly offer.
const MAX_MAP_SIZE: u32 = 16_384;

/// The section's settings; what it does not say is as in `base`, or as in the preset that it names.
pub(super) fn read_shadow(value: &Value<'_>, base: ShadowSettings) -> Result<ShadowSettings, SceneError> {
    let section = value.section("the shadow", KEYS)?;
    let mut settings = section.read_or("preset", base, |value| {
        let preset = PRESETS[value.name_of(PRESETS)?];
        ShadowSettings::preset(preset).map_err(|error| value.refuse(error.into()))
    })?;
    let technique = &mut settings.technique;
    if let Some(value) = section.get("technique") {
        let name = Technique::NAMES[value.name_of(&Technique::NAMES)?];
        *technique = technique.named(name).map_err(|_| value.refuse(unknown(technique, name)))?;
    }
    for key in PARAMETERS {
        if let Some(value) = section.get(key) {
            technique.set(key, value.number(ANY)?).map_err(|error| value.refuse(error.into()))?;
        }
    }
    let has_smoothies = matches!(technique, Technique::Smoothies(_));
    let has_silhouette_map = matches!(technique, Technique::SilhouetteMap(_));
    let keys = [
        ("remap", has_smoothies),
        ("profile", has_silhouette_map),
        ("bias_smoothie_texels", has_smoothies || has_silhouette_map),
    ];
    for (key, is_of_technique) in keys {
        if let Some(value) = section.get(key).filter(|_| !is_of_technique) {
            return Err(value.refuse(unknown(technique, key)));
        }
    }
    if let Technique::Smoothies(smoothies) = technique {
        smoothies.remap = section.read_or("remap", smoothies.remap, |value| {
            Ok(if REMAPS[value.name_of(REMAPS)?] == "contact" { AlphaRemap::Contact } else { AlphaRemap::Off })
        })?;
    }
    if let Technique::SilhouetteMap(silhouettes) = technique {
        silhouettes.profile = section.read_or("profile", silhouettes.profile, |value| {
            Ok(if PROFILES[value.name_of(PROFILES)?] == "linear" { EdgeProfile::Linear } else { EdgeProfile::Disk })
        })?;
    }
    settings.map_size = section.read_or("map_size", settings.map_size, |value| {
        let size = value.count()?;
        let known = (1..=MAX_MAP_SIZE).contains(&size);
        if known { Ok(size) } else { Err(value.refuse(Problem::MapSize { size, most: MAX_MAP_SIZE })) }
    })?;
    settings.depth_precision =
        section.read_or("depth_bits", settings.depth_precision, |value| match value.count()? {
            16 => Ok(DepthPrecision::Bits16),
            32 => Ok(DepthPrecision::Bits32),
            bits => Err(value.refuse(Problem::OutOfRange {
                key: "depth_bits".to_owned(),
                value: bits.to_string(),
                expected: "16 or 32".to_owned(),
            })),
        })?;
    let bias = &mut settings.bias;
    for (key, texels) in [
        ("bias_constant_texels", &mut bias.constant_texels),
        ("bias_slope_texels", &mut bias.slope_texels),
        ("bias_normal_texels", &mut bias.normal_texels),
        ("bias_smoothie_texels", &mut bias.smoothie_texels),
    ] {
        *texels = section.read_or(key, *texels, |value| Ok(value.number(NOT_NEGATIVE)? as f32))?;
    }
    settings.validate().map_err(|error| section.refuse(error.into()))?;
    Ok(settings)
}

fn unknown(technique: &Technique, key: &str) -> Problem {
    let known = technique.parameters().into_iter().map(|parameter| parameter.name).collect();
    SettingsError::UnknownParameter { technique: technique.name(), name: key.to_owned(), known }.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_parameter_is_a_key() {
        let mut names: Vec<_> = (Technique::NAMES.iter())
            .flat_map(|name| name.parse::<Technique>().expect("listed").parameters())
            .map(|parameter| parameter.name)
            .collect();
        names.sort_unstable();
        names.dedup();
        let mut keys = PARAMETERS.to_vec();
        keys.sort_unstable();
        assert_eq!(keys, names);
    }
}
