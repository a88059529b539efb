//! Widths of smoothies, against their definition in 64-bit floats.

use contrejour_layout::{Corner, OWN_END_HIGH, OWN_END_LOW, Quad};
use contrejour_plan::{Projection, ShadowSettings, SmoothieSettings, SmoothieWidth, Technique, View};
use glam::{DMat4, DVec2, DVec3, DVec4, Vec4Swizzles};

use super::super::device::DeviceMesh;

/// The least width that smoothies are drawn with. Unit: texels.
const LEAST_TEXELS: f64 = 1.5;

/// How wide smoothies are by definition: `t(b) = S (q_max - q(b))`, or as given, within its limits.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct WidthDefinition {
    view: View,
    smoothies: SmoothieSettings,
    least_ndc: f64,
}

impl WidthDefinition {
    /// None where the technique has no smoothies.
    pub fn new(view: &View, settings: &ShadowSettings) -> Option<Self> {
        let Technique::Smoothies(smoothies) = settings.technique else { return None };
        Some(Self { view: *view, smoothies, least_ndc: LEAST_TEXELS * 2.0 / f64::from(settings.map_size) })
    }

    /// The width for a blocker at a depth, in NDC.
    fn at_depth(&self, depth: f64) -> f64 {
        let width = match self.smoothies.width {
            SmoothieWidth::Ndc(width) => width.into(),
            SmoothieWidth::FromLightSize => self.view.light_size * (self.view.q_max() - self.view.q_of_depth(depth)),
        };
        width.clamp(self.least_ndc, f64::from(self.smoothies.width_max_ndc).max(self.least_ndc))
    }

    /// Largest error over the ends of all quads and all corners, as a share of the defined width. None where there is
    /// neither.
    pub fn error(&self, meshes: &[DeviceMesh], quads: &[Quad], corners: &[Corner]) -> Option<f64> {
        let of_quads = quads.iter().flat_map(|quad| {
            let [low, high] = [quad.low_vertex, quad.high_vertex].map(|vertex| self.clip(meshes, quad.caster, vertex));
            let is_own = [OWN_END_LOW, OWN_END_HIGH].map(|end| quad.own_ends & end != 0);
            let low_end = if is_own[0] { low } else { cut(low, high, quad.low_ndc) };
            let high_end = if is_own[1] { high } else { cut(low, high, quad.high_ndc) };
            [(low_end, quad.width_ndc[0]), (high_end, quad.width_ndc[1])]
        });
        let of_corners =
            corners.iter().map(|corner| (self.clip(meshes, corner.caster, corner.vertex_id), corner.width_ndc));
        let errors = of_quads.chain(of_corners).map(|(clip, width)| {
            let defined = self.at_depth(self.depth(clip));
            (f64::from(width) - defined).abs() / defined
        });
        // A maximum of floats drops NaN.
        errors.map(|error| if error.is_nan() { f64::INFINITY } else { error }).reduce(f64::max)
    }

    fn clip(&self, meshes: &[DeviceMesh], caster: u32, vertex: u32) -> DVec4 {
        let mesh = &meshes[caster as usize];
        let position = DVec3::from(mesh.topology.positions[vertex as usize].map(f64::from));
        let light_clip_from_object: DMat4 = self.view.light_clip_from_world * mesh.world_from_object;
        light_clip_from_object * position.extend(1.0)
    }

    fn depth(&self, clip: DVec4) -> f64 {
        match self.view.projection {
            Projection::Perspective => clip.w,
            Projection::Orthographic => self.view.near_depth + clip.z * (self.view.far_depth - self.view.near_depth),
        }
    }
}

/// The point of an edge that has these NDC: where the edge was cut.
fn cut(low: DVec4, high: DVec4, point_ndc: [f32; 2]) -> DVec4 {
    let point = DVec2::from(point_ndc.map(f64::from));
    let delta = high - low;
    // (low + t delta).xy / w = point, along the axis that tells more.
    let numerator = point * low.w - low.xy();
    let denominator = delta.xy() - point * delta.w;
    let axis = usize::from(denominator.y.abs() > denominator.x.abs());
    low + (numerator[axis] / denominator[axis]).clamp(0.0, 1.0) * delta
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mirror_frame::MirrorFrame;
    use crate::stability::lights;
    use crate::stability::meshes::{RING_RADIUS, ring};

    #[test]
    fn the_twins_widths_are_those_of_the_definition_and_a_wrong_one_is_found() {
        let mesh = DeviceMesh::new(&ring(1.0, DVec3::ZERO)).expect("a good mesh");
        for (name, view) in lights::views_of_all_kinds(DVec3::ZERO, 0.9 * RING_RADIUS) {
            let settings = ShadowSettings::default();
            let mut made = MirrorFrame::of_view(&[(&mesh.topology, DMat4::IDENTITY)], &view, &settings).run();
            let definition = WidthDefinition::new(&view, &settings).expect("smoothies");
            let meshes = std::slice::from_ref(&mesh);
            let error = definition.error(meshes, &made.quads, &made.corners).expect("there are quads");
            assert!(error > 0.0 && error < 1e-5, "{name}: {error}");

            made.quads[3].width_ndc[1] *= 1.01;
            let planted = definition.error(meshes, &made.quads, &made.corners).expect("there are quads");
            assert!((planted - 0.01).abs() < 1e-4, "{name}: {planted}");
            made.quads[3].width_ndc[1] /= 1.01;
            made.corners[1].width_ndc *= 0.98;
            let planted = definition.error(meshes, &made.quads, &made.corners).expect("there are quads");
            assert!((planted - 0.02).abs() < 1e-4, "{name}: {planted}");
        }
    }

    #[test]
    fn cut_ends_are_found_on_their_edge() {
        let [low, high] = [DVec4::new(-3.0, 0.5, 0.1, 2.0), DVec4::new(4.0, 1.0, 0.7, 5.0)];
        let expected = low.lerp(high, 0.25);
        let found = cut(low, high, (expected.xy() / expected.w).as_vec2().to_array());
        assert!(found.distance(expected) < 1e-6, "{found}");
    }
}
