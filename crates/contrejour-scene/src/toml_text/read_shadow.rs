//! The section `shadow`.

use contrejour_plan::{AlphaRemap, ShadowSettings, SmoothieSettings, SmoothieWidth, Technique};

use super::section::Section;
use super::value::{NOT_NEGATIVE, POSITIVE, Value};
use crate::{Problem, SceneError};

const PRESETS: &[&str] = &["low", "medium", "high", "ultra"];
const REMAPS: &[&str] = &["contact", "off"];
const ANY_KEYS: &[&str] = &[
    "technique",
    "preset",
    "map_size",
    "width_ndc",
    "width_max_ndc",
    "remap",
    "bias_constant_texels",
    "bias_slope_texels",
    "bias_normal_texels",
    "bias_smoothie_texels",
];
const SHADOW_MAP_KEYS: &[&str] =
    &["technique", "preset", "map_size", "bias_constant_texels", "bias_slope_texels", "bias_normal_texels"];
/// The largest side of a texture that devices commonly offer.
const MAX_MAP_SIZE: u32 = 16_384;

pub(super) fn read_shadow(value: &Value<'_>) -> Result<ShadowSettings, SceneError> {
    let section = value.section("the shadow", ANY_KEYS)?;
    let mut settings = section.read_or("preset", ShadowSettings::default(), |value| {
        let preset = PRESETS[value.name_of(PRESETS)?];
        ShadowSettings::preset(preset).map_err(|error| value.refuse(error.into()))
    })?;
    let technique = section.read_or("technique", settings.technique.name(), |value| {
        Ok(Technique::NAMES[value.name_of(&Technique::NAMES)?])
    })?;
    if technique == Technique::ShadowMap.name() {
        value.section("a shadow made by a shadow map alone", SHADOW_MAP_KEYS)?;
        settings.technique = Technique::ShadowMap;
    } else if let Technique::Smoothies(smoothies) = &mut settings.technique {
        read_smoothies(&section, smoothies)?;
    }
    settings.map_size = section.read_or("map_size", settings.map_size, |value| {
        let size = value.count()?;
        let known = (1..=MAX_MAP_SIZE).contains(&size);
        if known { Ok(size) } else { Err(value.refuse(Problem::MapSize { size, most: MAX_MAP_SIZE })) }
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

fn read_smoothies(section: &Section<'_>, smoothies: &mut SmoothieSettings) -> Result<(), SceneError> {
    let width = |value: &Value<'_>| Ok(value.number(POSITIVE)? as f32);
    if let Some(value) = section.get("width_ndc") {
        smoothies.width = SmoothieWidth::Ndc(width(&value)?);
    }
    smoothies.width_max_ndc = section.read_or("width_max_ndc", smoothies.width_max_ndc, width)?;
    smoothies.remap = section.read_or("remap", smoothies.remap, |value| {
        Ok(if REMAPS[value.name_of(REMAPS)?] == "contact" { AlphaRemap::Contact } else { AlphaRemap::Off })
    })?;
    Ok(())
}
