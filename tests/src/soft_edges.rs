//! The alpha of smoothies by definition: what the raster passes draw from quads and corners, in 64-bit floats.

use contrejour_layout::{Corner, Quad};
use contrejour_plan::View;
use glam::DVec2;

/// Steps to where a quad's ends have different widths; each leaves some hundredth of what was missing.
const STEPS: u32 = 4;

/// The least alpha of those quads and corners that a point of the image plane lies on, before the remap; 1 where there is
/// none.
pub fn alpha(view: &View, quads: &[Quad], corners: &[Corner], place_ndc: DVec2) -> f64 {
    let of_quads = quads.iter().filter_map(|quad| on_quad(view, quad, place_ndc));
    let of_corners = corners.iter().filter_map(|corner| on_corner(view, corner, place_ndc));
    of_quads.chain(of_corners).fold(1.0, f64::min)
}

/// From 0 at the edge to 1 at the rim, along the way between its ends' rims.
fn on_quad(view: &View, quad: &Quad, place_ndc: DVec2) -> Option<f64> {
    let [low, high, outward] = [quad.low_ndc, quad.high_ndc, quad.outward].map(vector);
    let [low_rim, high_rim] =
        [(low, 0), (high, 1)].map(|(end, index)| f64::from(quad.width_ndc[index]) * view.rim_offset(end, outward));
    let (mut alpha, mut share) = (0.0, 0.5_f64);
    for _ in 0..STEPS {
        let rim = low_rim.lerp(high_rim, share.clamp(0.0, 1.0));
        alpha = (place_ndc - low).dot(outward) / rim.dot(outward);
        share = (place_ndc - alpha * rim - low).dot(high - low) / low.distance_squared(high);
    }
    ((0.0..=1.0).contains(&alpha) && (0.0..=1.0).contains(&share)).then_some(alpha)
}

fn on_corner(view: &View, corner: &Corner, place_ndc: DVec2) -> Option<f64> {
    let [apex, begin, middle, end] = [corner.apex_ndc, corner.begin, corner.middle, corner.end].map(vector);
    let offset = place_ndc - apex;
    let [begin_rim, middle_rim, end_rim] = [begin, middle, end].map(|outward| view.rim_offset(apex, outward));
    let is_between = |from: DVec2, to: DVec2| from.perp_dot(offset) >= 0.0 && offset.perp_dot(to) >= 0.0;
    let alpha = view.rim_distance(apex, offset) / f64::from(corner.width_ndc);
    (alpha <= 1.0 && (is_between(begin_rim, middle_rim) || is_between(middle_rim, end_rim))).then_some(alpha)
}

fn vector(of: [f32; 2]) -> DVec2 {
    DVec2::from(of.map(f64::from))
}

#[cfg(test)]
mod tests {
    use contrejour_plan::{Light, LightKind, views};
    use glam::DVec3;

    use super::*;

    fn view() -> View {
        let kind = LightKind::Point { position: DVec3::ZERO, radius: 0.1, near: 0.5, far: 9.0 };
        views(&Light { kind, color: [1.0; 3] }).expect("a good lamp")[0]
    }

    const QUAD: Quad = Quad {
        low_ndc: [0.5, -0.25],
        high_ndc: [0.5, 0.5],
        outward: [1.0, 0.0],
        width_ndc: [0.1, 0.2],
        q: [-1.0; 2],
        caster: 0,
        edge_id: 0,
        low_vertex: 0,
        high_vertex: 1,
        own_ends: 3,
        side: 1,
    };

    #[test]
    fn alpha_grows_from_a_quads_edge_to_its_rim() {
        let view = view();
        for share in [0.1, 0.5, 0.9] {
            let [low, high] = [QUAD.low_ndc, QUAD.high_ndc].map(vector);
            let rim = (0.1 * view.rim_offset(low, DVec2::X)).lerp(0.2 * view.rim_offset(high, DVec2::X), share);
            for expected in [0.01, 0.5, 0.99] {
                let found = alpha(&view, &[QUAD], &[], low.lerp(high, share) + expected * rim);
                assert!((found - expected).abs() < 1e-3, "{share}: {found} for {expected}");
            }
            assert_eq!(alpha(&view, &[QUAD], &[], low.lerp(high, share) + 1.01 * rim), 1.0);
            assert_eq!(alpha(&view, &[QUAD], &[], low.lerp(high, share) - 0.01 * rim), 1.0);
        }
    }

    #[test]
    fn a_corner_goes_on_where_a_quad_ends() {
        let view = view();
        let corner = Corner {
            apex_ndc: QUAD.high_ndc,
            begin: [1.0, 0.0],
            middle: [0.5_f32.sqrt(); 2],
            end: [0.0, 1.0],
            width_ndc: 0.2,
            ..Default::default()
        };
        let [apex, along] = [vector(corner.apex_ndc), DVec2::new(0.0, 1e-6)];
        let rim = 0.2 * view.rim_offset(apex, DVec2::X);
        for expected in [0.01, 0.5, 0.99] {
            let [before, after] =
                [-along, along].map(|along| alpha(&view, &[QUAD], &[corner], apex + expected * rim + along));
            assert!((before - expected).abs() < 1e-3 && (after - expected).abs() < 1e-3, "{before} {after}");
        }
        assert_eq!(alpha(&view, &[], &[corner], apex - 0.1 * rim), 1.0);
    }
}
