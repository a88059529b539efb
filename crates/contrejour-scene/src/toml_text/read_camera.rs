//! The section `camera`.

use glam::DVec3;

use super::section::Section;
use super::value::{ANY, OPENING, POSITIVE, Value};
use crate::framing::camera_depths;
use crate::{Bounds, Camera, Problem, SceneError};

const KEYS: &[&str] = &["eye", "target", "up", "fov_y_degrees", "near", "far"];
const FOV_Y_DEGREES: f64 = 40.0;

pub(super) fn read_camera(value: &Value<'_>, bounds: &Bounds) -> Result<Camera, SceneError> {
    let section = value.section("the camera", KEYS)?;
    let eye = DVec3::from(section.require("eye")?.numbers(ANY)?);
    let target = DVec3::from(section.require("target")?.numbers(ANY)?);
    let up = DVec3::from(section.read_or("up", DVec3::Y.to_array(), |value| value.numbers(ANY))?);
    let no_direction = |key, remedy| section.refuse_key(key, Problem::NoDirection { key, remedy });
    let forward =
        (target - eye).try_normalize().ok_or_else(|| no_direction("target", "give a point that is not `eye`"))?;
    let up = up.try_normalize().filter(|up| up.cross(forward).length() > 1e-6);
    let up = up.ok_or_else(|| no_direction("up", "give a vector that is not 0 and not along the view"))?;
    let fov_y = section.read_or("fov_y_degrees", FOV_Y_DEGREES, |value| value.number(OPENING))?.to_radians();
    let [near, far] = read_depths(&section, camera_depths(bounds, eye, forward))?;
    Ok(Camera { eye, target, up, fov_y, near, far })
}

/// `near` and `far`, or the ones given where the section has none.
pub(super) fn read_depths(section: &Section<'_>, default: [f64; 2]) -> Result<[f64; 2], SceneError> {
    let near = section.read_or("near", default[0], |value| value.number(POSITIVE))?;
    let far = section.read_or("far", default[1].max(1.01 * near), |value| value.number(POSITIVE))?;
    // An automatic `near` gives way to a `far` that was given.
    let near = if section.get("near").is_none() { near.min(0.5 * far) } else { near };
    if near < far { Ok([near, far]) } else { Err(section.refuse_key("far", Problem::FarNotBeyondNear { near, far })) }
}
