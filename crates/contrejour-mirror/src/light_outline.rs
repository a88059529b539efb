//! What a light looks like from where its shadows fall: a disk alike from everywhere, a sphere at a slant.

use core::f32::consts::SQRT_2;

use contrejour_layout::LightView;

/// Below that share a sphere is nearly as large as the blocker is far, and soft edges could come from anywhere.
const LEAST_GROWTH: f32 = 0.0625;

/// A bound of how wide smoothies are that reach into the map, where a disk's are as wide as given.
pub(crate) fn widest_ndc(view: &LightView, width_ndc: f32) -> f32 {
    let side = view.sphere_half_side;
    width_ndc * (1.0 + SQRT_2 * side) / (1.0 - width_ndc * side).max(LEAST_GROWTH)
}

#[cfg(test)]
mod tests {
    use glam::Vec2;

    use super::*;

    #[test]
    fn a_disks_width_is_the_same_to_the_bit() {
        for step in 1..1000 {
            let width = 0.002 * step as f32;
            assert_eq!(widest_ndc(&LightView::default(), width), width);
        }
    }

    /// `w (g + (p . g) p) / sqrt(1 + (p . g)^2)` from a point that is cut off by the side of the frustum.
    #[test]
    fn rims_of_what_is_cut_off_stay_out_of_the_map() {
        for (half_side, width_ndc) in [(1.0, 0.02), (1.0, 0.5), (1.0, 0.9), (2.0, 0.1), (2.0, 0.45)] {
            let view = LightView { sphere_half_side: half_side, ..Default::default() };
            let side = 1.0 + widest_ndc(&view, width_ndc);
            let innermost = |place_ndc: Vec2| {
                let of_turn = |turn: u32| {
                    let outward = Vec2::from_angle(0.01 * turn as f32);
                    let place = half_side * place_ndc;
                    let along = place.dot(outward);
                    place_ndc.x + width_ndc * (outward.x + along * place.x) / along.hypot(1.0)
                };
                (0..629).map(of_turn).fold(f32::MAX, f32::min)
            };
            for step in -10..=10 {
                let place_ndc = Vec2::new(side, 0.1 * step as f32 * side);
                assert!(innermost(place_ndc) >= 1.0, "{half_side}, {width_ndc}, {place_ndc}");
            }
            let found = innermost(Vec2::new(1.0 + width_ndc, 0.0));
            assert!(found < 1.0, "a cut at a disk's width is found: {found}");
        }
    }
}
