//! Cameras and lights of the scene's nodes.

use std::f64::consts::FRAC_PI_2;
use std::ops::RangeInclusive;
use std::path::Path;

use glam::{DMat4, DVec3};
use gltf::Node;
use gltf::camera::Projection;
use gltf::khr_lights_punctual::Kind;

use super::nodes::node_place;
use crate::{FileCamera, FileLight, FileLightKind, LoadError, MeshFile};

/// Full vertical opening angles that make a picture.
const FOV_Y_DEGREES: RangeInclusive<f64> = 0.01..=179.0;

/// Coordinates beyond this leave no digits for what is seen.
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
    let position = world_from_node.w_axis.truncate();
    let axis = |axis: DVec3, what: &str| {
        // Scaled first, since squares of extreme axes leave the range.
        let axis = axis / axis.abs().max_element();
        axis.try_normalize()
            .ok_or_else(|| malformed(&format!("its scale leaves {what} no direction; give one that is not 0")))
    };
    if (node.camera().is_some() || node.light().is_some()) && position.abs().max_element() > FARTHEST {
        return Err(malformed("its camera or light is farther out than 1e15; move it nearer"));
    }
    let forward = |what| axis(-world_from_node.z_axis.truncate(), what);
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
                let forward = forward("its camera")?;
                let up = axis(world_from_node.y_axis.truncate(), "its camera")?;
                if up.cross(forward).length() < 1e-6 {
                    return Err(malformed("its matrix leaves its camera no direction; correct it"));
                }
                let name = node.name().or(camera.name()).unwrap_or_default().to_owned();
                file.cameras.push(FileCamera { name, eye: position, forward, up, fov_y, near, far });
            }
        }
    }
    if let Some(light) = node.light() {
        let kind = match light.kind() {
            Kind::Directional => FileLightKind::Directional { direction: forward("its light")? },
            Kind::Point => FileLightKind::Point { position },
            Kind::Spot { inner_cone_angle, outer_cone_angle } => {
                let [inner, outer] = [inner_cone_angle, outer_cone_angle].map(f64::from);
                if !(0.0 <= inner && inner < outer && outer > 1e-4 && outer <= FRAC_PI_2 + 1e-6) {
                    return Err(malformed(
                        "its light's cone angles are not 0 <= innerConeAngle < outerConeAngle <= pi / 2, or too narrow; correct them",
                    ));
                }
                FileLightKind::Spot {
                    position,
                    direction: forward("its light")?,
                    inner_half_angle: inner,
                    outer_half_angle: outer,
                }
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
        file.lights.push(FileLight { name, kind, color, intensity, range });
    }
    Ok(())
}
