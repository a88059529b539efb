//! Depth on the light's image plane. `q` is linear there: `-1 / z` in a perspective view, `z` in an orthographic one.

use contrejour_layout::{LightView, VIEW_PANCAKES};
use glam::Vec4;

/// Smoothie width at a blocker's `q`, in NDC, for a disk of light.
pub(crate) fn smoothie_width(view: &LightView, q: f32) -> f32 {
    let width = view.width_per_q_ndc * (view.q_max - q);
    // Not `clamp`, which panics on bounds that are out of order; WGSL's does not.
    width.max(view.width_min_ndc).min(view.width_max_ndc)
}

pub(crate) fn depth_of_clip(view: &LightView, clip: Vec4) -> f32 {
    if view.perspective == 1 {
        return clip.w;
    }
    view.near_depth * (1.0 - clip.z) + view.far_depth * clip.z
}

pub(crate) fn q_of_depth(view: &LightView, depth: f32) -> f32 {
    if view.perspective == 1 {
        return -1.0 / depth;
    }
    depth
}

/// Whether casters nearer to the light than the nearest depth cast too.
pub(crate) fn pancakes(view: &LightView) -> bool {
    view.flags & VIEW_PANCAKES != 0
}

/// The largest 16-bit float: maps may hold depth as a share of the farthest in 16 bits.
const LARGEST_HALF: f32 = 65_504.0;

/// The nearest depth that a caster has. What is still nearer, in front of a cascade, is taken to be there.
pub(crate) fn least_depth(view: &LightView) -> f32 {
    if pancakes(view) { -LARGEST_HALF * view.far_depth } else { view.near_depth }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn q_is_linear_on_the_image_plane() {
        let of_clip = |view: &LightView, clip| q_of_depth(view, depth_of_clip(view, clip));
        let perspective = LightView { perspective: 1, ..Default::default() };
        let orthographic = LightView { near_depth: 2.0, far_depth: 6.0, ..Default::default() };
        assert_eq!(of_clip(&perspective, Vec4::new(0.0, 0.0, 0.3, 4.0)), -0.25);
        assert_eq!(of_clip(&orthographic, Vec4::new(0.0, 0.0, 0.25, 1.0)), 3.0);
    }

    #[test]
    fn width_grows_towards_the_light_and_keeps_its_limits() {
        let view = LightView { width_per_q_ndc: 0.1, width_min_ndc: 0.02, width_max_ndc: 0.05, ..Default::default() };
        assert_eq!(smoothie_width(&view, -0.3), 0.1 * 0.3);
        assert_eq!(smoothie_width(&view, -0.01), 0.02);
        assert_eq!(smoothie_width(&view, -10.0), 0.05);
    }
}
