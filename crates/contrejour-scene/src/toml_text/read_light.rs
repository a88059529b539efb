//! The section `light`, or the sections of that name.

use contrejour_plan::{CascadeSettings, Light, LightKind, ShadowSettings};
use glam::DVec3;

use super::read_camera::read_depths;
use super::read_shadow::read_shadow;
use super::section::Section;
use super::value::{
    ANGULAR_RADIUS, ANY, Accepts, CASCADES, HALF_SHARE, NOT_NEGATIVE, OPENING, POSITIVE, SHARE, UP_TO_A_THOUSAND, Value,
};
use crate::framing::{cone_angle, depths_all_around, light_depths, sun_extents};
use crate::scene_light::SUN_ANGULAR_RADIUS_DEGREES;
use crate::{Bounds, Problem, Scene, SceneError, SceneLight};

const KINDS: &[&str] = &["spot", "point", "directional"];
const ALL_KEYS: &[&str] = &[
    "kind",
    "name",
    "color",
    "intensity",
    "casts",
    "shadow",
    "position",
    "target",
    "cone_angle_degrees",
    "inner_cone_angle_degrees",
    "radius",
    "range",
    "near",
    "far",
    "towards_light",
    "center",
    "half_extent",
    "half_depth",
    "angular_radius_degrees",
    "cascades",
    "logarithmic_share",
    "border_share",
    "caster_margin",
];
/// Those of the keys that a spot has.
const SPOT_KEYS: &[&str] = ALL_KEYS.split_at(14).0;
const POINT_KEYS: &[&str] =
    &["kind", "name", "color", "intensity", "casts", "shadow", "position", "radius", "range", "near", "far"];
const DIRECTIONAL_KEYS: &[&str] = &[
    "kind",
    "name",
    "color",
    "intensity",
    "casts",
    "shadow",
    "towards_light",
    "center",
    "half_extent",
    "half_depth",
    "angular_radius_degrees",
    "cascades",
];
const CASCADED_KEYS: &[&str] = &[
    "kind",
    "name",
    "color",
    "intensity",
    "casts",
    "shadow",
    "towards_light",
    "angular_radius_degrees",
    "cascades",
    "logarithmic_share",
    "border_share",
    "caster_margin",
];

/// The lights; `shadow` is what their shadows fall back to.
pub(super) fn read_lights(
    value: &Value<'_>,
    bounds: &Bounds,
    shadow: ShadowSettings,
) -> Result<Vec<SceneLight>, SceneError> {
    let sections = if value.is_array() { value.tables()? } else { vec![value.clone()] };
    if !(1..=Scene::MAX_LIGHTS).contains(&sections.len()) {
        return Err(value.refuse(Problem::LightCount { count: sections.len() }));
    }
    sections.iter().map(|section| read_light(section, bounds, shadow)).collect()
}

fn read_light(value: &Value<'_>, bounds: &Bounds, shadow: ShadowSettings) -> Result<SceneLight, SceneError> {
    let kind = value.section("the light", ALL_KEYS)?.require("kind")?.name_of(KINDS)?;
    let (section, kind) = match KINDS[kind] {
        "spot" => {
            let section = value.section("a spot light", SPOT_KEYS)?;
            let kind = read_spot(&section, bounds)?;
            (section, kind)
        }
        "point" => {
            let section = value.section("a point light", POINT_KEYS)?;
            let kind = read_point(&section, bounds)?;
            (section, kind)
        }
        _ if value.section("the light", ALL_KEYS)?.get("cascades").is_some() => {
            let section = value.section("a directional light with cascades", CASCADED_KEYS)?;
            let kind = read_cascaded(&section)?;
            (section, kind)
        }
        _ => {
            let section = value.section("a directional light", DIRECTIONAL_KEYS)?;
            let kind = read_directional(&section, bounds)?;
            (section, kind)
        }
    };
    let color = section.read_or("color", [1.0; 3], |value| value.color(NOT_NEGATIVE))?;
    let light = SceneLight::new(Light { kind, color }, shadow);
    Ok(SceneLight {
        name: section.read_or("name", light.name.clone(), |value| Ok(value.text()?.to_owned()))?,
        intensity: read_option(&section, "intensity", NOT_NEGATIVE)?,
        range: read_option(&section, "range", POSITIVE)?,
        inner_cone_angle: read_inner_cone(&section, &light.light.kind)?,
        casts: section.read_or("casts", true, Value::flag)?,
        shadow: section.read_or("shadow", shadow, |value| read_shadow(value, shadow))?,
        ..light
    })
}

/// A number, where the section has one.
fn read_option(section: &Section<'_>, key: &str, accepts: Accepts) -> Result<Option<f64>, SceneError> {
    section.get(key).map(|value| value.number(accepts)).transpose()
}

fn read_inner_cone(section: &Section<'_>, kind: &LightKind) -> Result<Option<f64>, SceneError> {
    let (Some(value), LightKind::Spot { cone_angle, .. }) = (section.get("inner_cone_angle_degrees"), kind) else {
        return Ok(None);
    };
    let inner = value.number(NOT_NEGATIVE)?.to_radians();
    if inner <= *cone_angle {
        return Ok(Some(inner));
    }
    // As they were written: 60 degrees become radians and 59.99999999999999 degrees.
    let [inner, cone] = [inner, *cone_angle].map(|angle| (1e9 * angle.to_degrees()).round() / 1e9);
    Err(value.refuse(Problem::InnerCone { inner, cone }))
}

fn read_spot(section: &Section<'_>, bounds: &Bounds) -> Result<LightKind, SceneError> {
    let position = DVec3::from(section.require("position")?.numbers(ANY)?);
    let target = DVec3::from(section.require("target")?.numbers(ANY)?);
    let axis = (target - position).try_normalize().ok_or_else(|| {
        let remedy = "give a point that is not `position`";
        section.refuse_key("target", Problem::NoDirection { key: "target", remedy })
    })?;
    let cone_angle = match section.get("cone_angle_degrees") {
        Some(value) => value.number(OPENING)?.to_radians(),
        None => cone_angle(bounds, position, axis),
    };
    let radius = section.read_or("radius", 0.0, |value| value.number(NOT_NEGATIVE))?;
    let [near, far] = read_depths(section, light_depths(bounds, position, axis))?;
    Ok(LightKind::Spot { position, target, cone_angle, radius, near, far })
}

fn read_point(section: &Section<'_>, bounds: &Bounds) -> Result<LightKind, SceneError> {
    let position = DVec3::from(section.require("position")?.numbers(ANY)?);
    let radius = section.read_or("radius", 0.0, |value| value.number(NOT_NEGATIVE))?;
    let [near, far] = read_depths(section, depths_all_around(bounds, position))?;
    Ok(LightKind::Point { position, radius, near, far })
}

/// As it is given, and of unit length.
fn read_towards_light(section: &Section<'_>) -> Result<(DVec3, DVec3), SceneError> {
    let towards_light = DVec3::from(section.require("towards_light")?.numbers(ANY)?);
    let direction = towards_light.try_normalize().ok_or_else(|| {
        let remedy = "give a vector that is not 0";
        section.refuse_key("towards_light", Problem::NoDirection { key: "towards_light", remedy })
    })?;
    Ok((towards_light, direction))
}

fn read_angular_radius(section: &Section<'_>) -> Result<f64, SceneError> {
    let read = |value: &Value<'_>| value.number(ANGULAR_RADIUS);
    Ok(section.read_or("angular_radius_degrees", SUN_ANGULAR_RADIUS_DEGREES, read)?.to_radians())
}

fn read_cascaded(section: &Section<'_>) -> Result<LightKind, SceneError> {
    let (towards_light, _) = read_towards_light(section)?;
    let angular_radius = read_angular_radius(section)?;
    let default = CascadeSettings::DEFAULT;
    let share = |key, accepts, default| section.read_or(key, default, |value| value.number(accepts));
    let cascades = CascadeSettings {
        count: section.require("cascades")?.number(CASCADES)? as u32,
        logarithmic_share: share("logarithmic_share", SHARE, default.logarithmic_share)?,
        border_share: share("border_share", HALF_SHARE, default.border_share)?,
        caster_margin: share("caster_margin", UP_TO_A_THOUSAND, default.caster_margin)?,
    };
    Ok(LightKind::Cascaded { towards_light, angular_radius, cascades })
}

fn read_directional(section: &Section<'_>, bounds: &Bounds) -> Result<LightKind, SceneError> {
    let (towards_light, direction) = read_towards_light(section)?;
    let middle = if bounds.is_empty() { DVec3::ZERO } else { bounds.center() };
    let center = DVec3::from(section.read_or("center", middle.to_array(), |value| value.numbers(ANY))?);
    let [half_extent, half_depth] = sun_extents(bounds, center, direction);
    let half_extent = section.read_or("half_extent", half_extent, |value| value.number(POSITIVE))?;
    let half_depth = section.read_or("half_depth", half_depth, |value| value.number(POSITIVE))?;
    let angular_radius = read_angular_radius(section)?;
    Ok(LightKind::Directional { towards_light, center, half_extent, half_depth, angular_radius })
}
