//! The six views of a point light.

use glam::{DMat4, DVec3, DVec4};

use super::view::{CastersInFront, Projection, View, look_along};
use super::{CubeFace, LightOutline};
use crate::LightError;
use crate::light::is_normal;

/// One view for each face of the cube around `position`, in the order of [`CubeFace::ALL`], whose 90 degrees take
/// the middle `1 - guard_ndc` of the map.
///
/// What is in the guard band of one face is nearer to the light along that face's axis than along its own, by a factor
/// of 1 - guard at most. So all faces see from so much nearer on, and what casts in one face casts in its neighbours.
pub(super) fn cube_views(
    position: DVec3,
    radius: f64,
    [near, far]: [f64; 2],
    guard_ndc: f64,
) -> Result<Vec<View>, LightError> {
    let square = 1.0 - guard_ndc;
    let near_depth = near * square;
    if !(0.0..1.0).contains(&guard_ndc) || !is_normal(near_depth) {
        return Err(LightError::Guard { guard_ndc });
    }
    let view_along = |axis_world| View {
        projection: Projection::Perspective,
        light_clip_from_world: clip_from_light(square, near_depth, far) * look_along(position, axis_world),
        light_world: position.extend(1.0),
        axis_world,
        near_depth,
        far_depth: far,
        half_side: 1.0 / square,
        light_size: radius * square,
        light_outline: LightOutline::Sphere,
        casters_in_front: CastersInFront::Clipped,
    };
    Ok(CubeFace::ALL.map(|face| view_along(face.axis())).to_vec())
}

/// Clip space of a square view whose half side at depth 1 is one over `scale`. Unlike from an angle, no rounding moves
/// the borders of faces.
fn clip_from_light(scale: f64, near: f64, far: f64) -> DMat4 {
    let range = far - near;
    DMat4::from_cols(
        scale * DVec4::X,
        scale * DVec4::Y,
        DVec4::new(0.0, 0.0, -far / range, -1.0),
        DVec4::new(0.0, 0.0, -far * (near / range), 0.0),
    )
}

#[cfg(test)]
mod tests;
