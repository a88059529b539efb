//! Turns each outline edge into a quad on the light's image plane, clipped to the frustum widened by the quad's width.
//!
//! Chan & Durand 2003, section 4.2, with the outward side taken from the faces instead of averaged normals.

use contrejour_layout::{
    Caster, CasterLight, Counters, Edge, LightView, OUTLINE_BLOCKER_LEFT, OUTLINE_BLOCKER_RIGHT, OWN_END_HIGH,
    OWN_END_LOW, Quad, SilhouetteEdge,
};

use crate::caster_position::scaled_position;
use crate::edge_image::edge_image;
use crate::image_plane::{clip_from_object, clockwise, counter_clockwise, image_direction};
use crate::view_depth::smoothie_width;

/// The stage `extrude_edges`: silhouette edges to quads.
pub struct ExtrudeEdges<'a> {
    /// The light view that is drawn into, and the room in the lists.
    pub view: &'a LightView,
    /// The silhouette.
    pub silhouettes: &'a [SilhouetteEdge],
    /// Where the parts of each caster lie.
    pub casters: &'a [Caster],
    /// The light as each caster sees it.
    pub caster_lights: &'a [CasterLight],
    /// Edges of all casters.
    pub edges: &'a [Edge],
    /// Positions of all casters, as bits.
    pub positions: &'a [u32],
    /// The quads.
    pub quads: &'a mut [Quad],
    /// Counts quads and edges that project to a point; holds the number of silhouette edges.
    pub counters: &'a mut Counters,
}

impl ExtrudeEdges<'_> {
    /// Does what the whole dispatch does.
    ///
    /// # Panics
    ///
    /// When a record names a part of a buffer that does not exist.
    pub fn run(mut self) {
        let silhouette_count = self.counters.silhouette_edges.min(self.view.silhouette_capacity) as usize;
        for silhouette in &self.silhouettes[..silhouette_count] {
            if silhouette.left > 0 && silhouette.right > 0 {
                continue;
            }
            if let Some(quad) = self.extrude(silhouette) {
                let slot = self.counters.quads;
                self.counters.quads += 1;
                if slot < self.view.quad_capacity {
                    self.quads[slot as usize] = quad;
                }
            }
        }
    }

    /// The quad of an outline edge; none where none of it is in view.
    fn extrude(&mut self, silhouette: &SilhouetteEdge) -> Option<Quad> {
        // Project.
        let caster = &self.casters[silhouette.caster as usize];
        let clip_from_object = clip_from_object(&self.caster_lights[silhouette.caster as usize]);
        let edge = &self.edges[caster.first_edge.wrapping_add(silhouette.edge_id) as usize];
        let low = scaled_position(caster, self.positions, edge.low_vertex);
        let high = scaled_position(caster, self.positions, edge.high_vertex);
        let Some(direction) = image_direction(&clip_from_object, low, high) else {
            self.counters.point_edges += 1;
            return None;
        };
        let image = edge_image(self.view, &clip_from_object, low, high)?;

        // Extrude away from the blocker.
        let q = [image.low.q, image.high.q];
        let (side, outward) = if silhouette.right == 0 {
            (OUTLINE_BLOCKER_LEFT, clockwise(direction))
        } else {
            (OUTLINE_BLOCKER_RIGHT, counter_clockwise(direction))
        };
        let own_low = if image.span.begin == 0.0 { OWN_END_LOW } else { 0 };
        let own_high = if image.span.end == 1.0 { OWN_END_HIGH } else { 0 };
        Some(Quad {
            low_ndc: image.low.ndc.to_array(),
            high_ndc: image.high.ndc.to_array(),
            outward: outward.to_array(),
            width_ndc: q.map(|q| smoothie_width(self.view, q)),
            q,
            caster: silhouette.caster,
            edge_id: silhouette.edge_id,
            low_vertex: edge.low_vertex,
            high_vertex: edge.high_vertex,
            own_ends: own_low | own_high,
            side,
        })
    }
}

#[cfg(test)]
mod tests {
    use glam::{Vec2, Vec3};

    use super::*;
    use crate::test_scene::{TestLight, TestScene};

    #[test]
    fn smoothies_extend_away_from_the_face() {
        let corners = [[0.0, 0.0], [0.5, 0.0], [0.0, 0.5]];
        for faces in [[[0, 1, 2]], [[0, 2, 1]]] {
            let frame = TestScene::flat(&corners, &faces).frame();
            let outwards: Vec<_> = frame.quads.iter().map(|quad| quad.outward).collect();
            assert_eq!(outwards[..2], [[0.0, -1.0], [-1.0, 0.0]]);
            assert!(Vec2::from(outwards[2]).distance(Vec2::splat(0.5_f32.sqrt())) < 1e-6);
            assert!(frame.quads.iter().all(|quad| quad.own_ends == OWN_END_LOW | OWN_END_HIGH));
            assert_eq!((frame.quads[0].low_ndc, frame.quads[0].high_ndc), ([0.0, 0.0], [0.5, 0.0]));
            assert_eq!((frame.quads[0].q, frame.quads[0].width_ndc), ([4.0; 2], [0.05; 2]));
        }
    }

    #[test]
    fn edge_along_the_light_is_counted_and_has_no_quad() {
        let positions = [[0.0; 3], [0.5, 0.0, 0.0], [0.0, 0.0, 1.0]];
        let frame = TestScene::new(&positions, &[[0, 1, 2]], TestLight::Directional).frame();
        assert_eq!(frame.counters.silhouette_edges, 3);
        assert_eq!(frame.counters.point_edges, 1);
        assert_eq!(frame.quads.iter().map(|quad| quad.edge_id).collect::<Vec<_>>(), [0, 2]);
    }

    #[test]
    fn edges_are_cut_at_the_near_plane_and_behind_the_light() {
        // 0 and 1 lie before the light, 2 behind it.
        let positions = [[-1.0, 0.0, -4.0], [1.0, 0.0, -4.0], [0.0, 1.0, 4.0]];
        let frame = TestScene::new(&positions, &[[0, 1, 2]], TestLight::Spot(Vec3::ZERO)).frame();
        assert_eq!(frame.counters.quads, 3);
        let [base, left, right] = [0, 1, 2].map(|i| frame.quads[i]);
        assert_eq!(base.own_ends, OWN_END_LOW | OWN_END_HIGH);
        assert_eq!((base.low_ndc, base.high_ndc, base.outward), ([-0.25, 0.0], [0.25, 0.0], [0.0, -1.0]));
        for (quad, sign) in [(left, -1.0), (right, 1.0)] {
            // At depth 1, three eighths of the way: x = 5 / 8 of the lower end's, y = 3 / 8.
            assert_eq!(quad.own_ends, OWN_END_LOW);
            assert!(Vec2::from(quad.high_ndc).distance(Vec2::new(sign * 0.625, 0.375)) < 1e-6);
            assert!((quad.q[1] + 1.0).abs() < 1e-6);
            // The face lies between the two edges' images, above the base.
            let outward = Vec2::new(sign, -1.0).normalize();
            assert!(Vec2::from(quad.outward).distance(outward) < 1e-6, "{quad:?}");
        }
    }

    #[test]
    fn edges_are_cut_where_their_smoothie_leaves_the_view() {
        let frame = TestScene::flat(&[[0.0, 0.0], [3.0, 0.0], [0.0, 0.5]], &[[0, 1, 2]]).frame();
        let cut = frame.quads[0];
        assert_eq!(cut.own_ends, OWN_END_LOW);
        assert!((cut.high_ndc[0] - 1.05).abs() < 1e-6);

        let outside = TestScene::flat(&[[1.1, 0.0], [3.0, 0.0], [1.1, 0.5]], &[[0, 1, 2]]).frame();
        assert_eq!((outside.counters.silhouette_edges, outside.counters.quads), (3, 0));
    }

    #[test]
    fn nothing_behind_the_light_or_beyond_the_far_plane_has_quads() {
        for z in [0.5, 2.0, -9.5] {
            let positions = [[0.0, 0.0, z], [0.5, 0.0, z], [0.0, 0.5, z]];
            let frame = TestScene::new(&positions, &[[0, 1, 2]], TestLight::Spot(Vec3::ZERO)).frame();
            assert_eq!(frame.counters.silhouette_edges, 3);
            assert_eq!((frame.counters.quads, frame.counters.corners), (0, 0), "at {z}");
        }
    }
}
