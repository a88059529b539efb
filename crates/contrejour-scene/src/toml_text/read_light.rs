//! The section `light`.

use contrejour_plan::{Light, LightKind};
use glam::DVec3;

use super::read_camera::read_depths;
use super::section::Section;
use super::value::{ANGULAR_RADIUS, ANY, NOT_NEGATIVE, OPENING, POSITIVE, Value};
use crate::framing::{cone_angle, depths_all_around, light_depths, sun_extents};
use crate::{Bounds, Problem, SceneError};

const KINDS: &[&str] = &["spot", "point", "directional"];
const SPOT_KEYS: &[&str] = &["kind", "color", "position", "target", "cone_angle_degrees", "radius", "near", "far"];
const POINT_KEYS: &[&str] = &["kind", "color", "position", "radius", "near", "far"];
const DIRECTIONAL_KEYS: &[&str] =
    &["kind", "color", "towards_light", "center", "half_extent", "half_depth", "angular_radius_degrees"];
const ALL_KEYS: &[&str] = &[
    "kind",
    "color",
    "position",
    "target",
    "cone_angle_degrees",
    "radius",
    "near",
    "far",
    "towards_light",
    "center",
    "half_extent",
    "half_depth",
    "angular_radius_degrees",
];
const SUN_ANGULAR_RADIUS_DEGREES: f64 = 0.27;

pub(super) fn read_light(value: &Value<'_>, bounds: &Bounds) -> Result<Light, SceneError> {
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
        _ => {
            let section = value.section("a directional light", DIRECTIONAL_KEYS)?;
            let kind = read_directional(&section, bounds)?;
            (section, kind)
        }
    };
    let color = section.read_or("color", [1.0; 3], |value| value.color(NOT_NEGATIVE))?;
    Ok(Light { kind, color })
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

fn read_directional(section: &Section<'_>, bounds: &Bounds) -> Result<LightKind, SceneError> {
    let towards_light = DVec3::from(section.require("towards_light")?.numbers(ANY)?);
    let direction = towards_light.try_normalize().ok_or_else(|| {
        let remedy = "give a vector that is not 0";
        section.refuse_key("towards_light", Problem::NoDirection { key: "towards_light", remedy })
    })?;
    let middle = if bounds.is_empty() { DVec3::ZERO } else { bounds.center() };
    let center = DVec3::from(section.read_or("center", middle.to_array(), |value| value.numbers(ANY))?);
    let [half_extent, half_depth] = sun_extents(bounds, center, direction);
    let half_extent = section.read_or("half_extent", half_extent, |value| value.number(POSITIVE))?;
    let half_depth = section.read_or("half_depth", half_depth, |value| value.number(POSITIVE))?;
    let read_angle = |value: &Value<'_>| value.number(ANGULAR_RADIUS);
    let angular_radius =
        section.read_or("angular_radius_degrees", SUN_ANGULAR_RADIUS_DEGREES, read_angle)?.to_radians();
    Ok(LightKind::Directional { towards_light, center, half_extent, half_depth, angular_radius })
}
