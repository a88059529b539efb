//! Cameras and lights of the scene's nodes.

use std::f64::consts::FRAC_PI_2;
use std::ops::RangeInclusive;
use std::path::Path;

use glam::{DMat4, DVec3};
use gltf::Node;
use gltf::camera::Projection;
use gltf::khr_lights_punctual::Kind;

use super::nodes::node_place;
use crate::{FileCamera, FileLight, FileLightKind, LoadError, MeshFile, OutlookError};

/// Full vertical opening angles that make a picture.
const FOV_Y_DEGREES: RangeInclusive<f64> = 0.01..=179.0;

/// Depths beyond this leave no digits for what is seen.
const FARTHEST: f64 = 1e15;

/// Adds what a node has; a camera that is not in perspective is counted in `orthographic`.
pub(super) fn read_node(
    node: &Node,
    world_from_node: &DMat4,
    path: &Path,
    file: &mut MeshFile,
    orthographic: &mut usize,
) -> Result<(), LoadError> {
    let malformed =
        |problem: &str| LoadError::Malformed { path: path.into(), place: node_place(node), problem: problem.into() };
    let unseen = |what: &str, error: OutlookError| malformed(&format!("its {what}: {error}"));
    let node_id = node.index();
    if let Some(camera) = node.camera() {
        match camera.projection() {
            Projection::Orthographic(_) => *orthographic += 1,
            Projection::Perspective(perspective) => {
                let [fov_y, near] = [perspective.yfov(), perspective.znear()].map(f64::from);
                let far = perspective.zfar().map(f64::from);
                if !FOV_Y_DEGREES.contains(&fov_y.to_degrees()) {
                    return Err(malformed("its camera's yfov is not between 0.01 and 179 degrees; correct it"));
                }
                let is_far = far.is_none_or(|far| far > near && far.is_finite());
                if !(near > 0.0 && near < FARTHEST && is_far) {
                    return Err(malformed("its camera's znear is not above 0, or zfar not beyond it; correct them"));
                }
                let name = node.name().or(camera.name()).unwrap_or_default().to_owned();
                let [eye, forward, up] = [DVec3::ZERO, DVec3::NEG_Z, DVec3::Y];
                let camera = FileCamera { name, node: node_id, eye, forward, up, fov_y, near, far };
                file.cameras.push(camera.seen_from(world_from_node).map_err(|error| unseen("camera", error))?);
            }
        }
    }
    if let Some(light) = node.light() {
        let (position, direction) = (DVec3::ZERO, DVec3::NEG_Z);
        let kind = match light.kind() {
            Kind::Directional => FileLightKind::Directional { direction },
            Kind::Point => FileLightKind::Point { position },
            Kind::Spot { inner_cone_angle, outer_cone_angle } => {
                let [inner, outer] = [inner_cone_angle, outer_cone_angle].map(f64::from);
                if !(0.0 <= inner && inner < outer && outer > 1e-4 && outer <= FRAC_PI_2 + 1e-6) {
                    return Err(malformed(
                        "its light's cone angles are not 0 <= innerConeAngle < outerConeAngle <= pi / 2, or too narrow; correct them",
                    ));
                }
                FileLightKind::Spot { position, direction, inner_half_angle: inner, outer_half_angle: outer }
            }
        };
        let (color, intensity) = (light.color(), f64::from(light.intensity()));
        let is_strength = |number: f64| (0.0..f64::INFINITY).contains(&number);
        if !color.iter().all(|&channel| is_strength(channel.into())) || !is_strength(intensity) {
            return Err(malformed("its light's color or intensity is negative or infinite; correct it"));
        }
        let range = light.range().map(f64::from);
        if range.is_some_and(|range| !(range > 0.0 && range.is_finite())) {
            return Err(malformed("its light's range is not above 0; correct it or leave it out"));
        }
        let name = node.name().or(light.name()).unwrap_or_default().to_owned();
        let light = FileLight { name, node: node_id, kind, color, intensity, range };
        file.lights.push(light.shining_from(world_from_node).map_err(|error| unseen("light", error))?);
    }
    Ok(())
}
