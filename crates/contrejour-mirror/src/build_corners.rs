//! Closes the gap between an outline edge's quad and its neighbour's with a wedge around their common vertex.
//!
//! Each outside sector around a vertex lies between two ends; the one that has it on its counter-clockwise side makes
//! the wedge. An end whose neighbour can't be told apart closes its own side with a quarter disk: never a gap, and what
//! overlaps is settled by minimum blending.

use contrejour_layout::{
    CORNER_CAP, CORNER_WEDGE, Caster, CasterLight, Corner, Counters, LightView, MAX_SEARCHED_VALENCE,
    OUTLINE_BLOCKER_RIGHT, OUTLINE_NONE, OWN_END_HIGH, OWN_END_LOW, Quad,
};
use glam::Vec2;

use crate::caster_position::scaled_position;
use crate::image_plane::{clip_from_object, clockwise, counter_clockwise, halfway, image_direction};

/// Two directions whose cosine is nearer to 1 than this can't be told apart.
const COINCIDENT: f32 = 1e-4;
const HALF_TURN: f32 = 2.0;

/// The stage `build_corners`: ends of quads to wedges and caps.
pub struct BuildCorners<'a> {
    /// The room in the lists of quads and corners.
    pub view: &'a LightView,
    /// The quads.
    pub quads: &'a [Quad],
    /// Where the parts of each caster lie.
    pub casters: &'a [Caster],
    /// The light as each caster sees it.
    pub caster_lights: &'a [CasterLight],
    /// Positions of all casters, as bits.
    pub positions: &'a [u32],
    /// Outline sides of all casters, two bits an edge.
    pub outline_sides: &'a [u32],
    /// Offsets and edges of the vertices of all casters.
    pub vertex_edges: &'a [u32],
    /// The corners.
    pub corners: &'a mut [Corner],
    /// Counts corners; holds the number of quads.
    pub counters: &'a mut Counters,
}

impl BuildCorners<'_> {
    /// Does what the whole dispatch does.
    ///
    /// # Panics
    ///
    /// When a record names a part of a buffer that does not exist.
    pub fn run(self) {
        let quad_count = self.counters.quads.min(self.view.quad_capacity) as usize;
        for quad in &self.quads[..quad_count] {
            for end in [OWN_END_LOW, OWN_END_HIGH] {
                if quad.own_ends & end == 0 {
                    continue;
                }
                let is_high = end == OWN_END_HIGH;
                if let Some(corner) = self.corner_at(quad, is_high) {
                    let slot = self.counters.corners;
                    self.counters.corners += 1;
                    if slot < self.view.corner_capacity {
                        self.corners[slot as usize] = corner;
                    }
                }
            }
        }
    }

    fn corner_at(&self, quad: &Quad, is_high: bool) -> Option<Corner> {
        let edge_end = end_of_quad(quad, is_high);
        let wedge = match self.find_neighbour(&edge_end, quad) {
            Some(neighbour) => wedge_between(&edge_end, &neighbour)?,
            None => cap(&edge_end),
        };
        let index = usize::from(is_high);
        Some(Corner {
            apex_ndc: [quad.low_ndc, quad.high_ndc][index],
            begin: wedge.begin.to_array(),
            middle: halfway(wedge.begin, wedge.end).to_array(),
            end: wedge.end.to_array(),
            width_ndc: quad.width_ndc[index],
            q: quad.q[index],
            caster: quad.caster,
            vertex_id: edge_end.vertex,
            edge_id: quad.edge_id,
            kind: wedge.kind,
        })
    }
}

/// One end of an outline edge, on the image plane.
struct EdgeEnd {
    vertex: u32,
    /// Unit direction from the vertex along the edge.
    direction: Vec2,
    /// +1 where the outside lies counter-clockwise of the direction, -1 where clockwise.
    turn: f32,
}

/// The outline edge that one meets first when turning through the outside.
struct Neighbour {
    direction: Vec2,
    turn: f32,
    /// Monotone in the angle: 0 at none, 2 at a half turn, 4 at a full one.
    pseudo_angle: f32,
}

/// Directions where a wedge begins and ends, counter-clockwise.
struct Wedge {
    begin: Vec2,
    end: Vec2,
    kind: u32,
}

impl BuildCorners<'_> {
    /// The neighbour of an end; none where it can't be told apart.
    fn find_neighbour(&self, edge_end: &EdgeEnd, quad: &Quad) -> Option<Neighbour> {
        let caster = &self.casters[quad.caster as usize];
        let offset_word = (caster.first_vertex_offset_word + edge_end.vertex) as usize;
        let (first, last) = (self.vertex_edges[offset_word], self.vertex_edges[offset_word + 1]);
        if last - first > MAX_SEARCHED_VALENCE {
            return None;
        }

        let mut nearest: Option<Neighbour> = None;
        let mut second: Option<Neighbour> = None;
        for i in first..last {
            let word = (caster.first_vertex_edge_word + 2 * i) as usize;
            let (edge_id, other_vertex) = (self.vertex_edges[word], self.vertex_edges[word + 1]);
            let side = self.side_of_edge(caster, edge_id);
            if edge_id == quad.edge_id || side == OUTLINE_NONE {
                continue;
            }
            let direction = self.direction_to(edge_end, other_vertex, quad.caster)?;
            if coincide(edge_end.direction, direction) {
                return None;
            }
            let pseudo_angle = turned(edge_end, direction);
            let turn = outside_turn(side, edge_end.vertex < other_vertex);
            let neighbour = Neighbour { direction, turn, pseudo_angle };
            if nearest.as_ref().is_none_or(|nearest| pseudo_angle < nearest.pseudo_angle) {
                second = nearest.replace(neighbour);
            } else if second.as_ref().is_none_or(|second| pseudo_angle < second.pseudo_angle) {
                second = Some(neighbour);
            }
        }
        let nearest = nearest.filter(|nearest| nearest.turn != edge_end.turn)?;
        // The neighbour closes its side alone when it coincides with another; then this end must do so too.
        second.is_none_or(|second| !coincide(nearest.direction, second.direction)).then_some(nearest)
    }

    /// Direction of an edge from an end's vertex, found from the edge's lower vertex as its own quad finds it, so that
    /// all ends agree on it to the bit.
    fn direction_to(&self, edge_end: &EdgeEnd, other_vertex: u32, caster_id: u32) -> Option<Vec2> {
        let caster = &self.casters[caster_id as usize];
        let clip_from_object = clip_from_object(&self.caster_lights[caster_id as usize]);
        let low = scaled_position(caster, self.positions, edge_end.vertex.min(other_vertex));
        let high = scaled_position(caster, self.positions, edge_end.vertex.max(other_vertex));
        let direction = image_direction(&clip_from_object, low, high)?;
        Some(if edge_end.vertex < other_vertex { direction } else { -direction })
    }

    fn side_of_edge(&self, caster: &Caster, edge_id: u32) -> u32 {
        self.outline_sides[(caster.first_outline_word + edge_id / 16) as usize] >> (edge_id % 16 * 2) & 3
    }
}

fn end_of_quad(quad: &Quad, is_high: bool) -> EdgeEnd {
    let vertex = if is_high { quad.high_vertex } else { quad.low_vertex };
    let turn = outside_turn(quad.side, !is_high);
    let direction = turn * clockwise(Vec2::from_array(quad.outward));
    EdgeEnd { vertex, direction, turn }
}

/// The outside lies on the right of an edge whose blocker is on its left. Seen from its high end it runs the other way.
fn outside_turn(side: u32, from_low: bool) -> f32 {
    if (side == OUTLINE_BLOCKER_RIGHT) == from_low { 1.0 } else { -1.0 }
}

fn coincide(direction: Vec2, other: Vec2) -> bool {
    direction.dot(other) > 1.0 - COINCIDENT
}

/// How far one turns through the outside from the edge to a direction.
fn turned(edge_end: &EdgeEnd, direction: Vec2) -> f32 {
    let cosine = edge_end.direction.dot(direction);
    let sine = edge_end.turn * edge_end.direction.perp_dot(direction);
    if sine >= 0.0 { 1.0 - cosine } else { 3.0 + cosine }
}

/// What fills the sector between two neighbours; none where their quads do, or where the neighbour's end makes it.
fn wedge_between(edge_end: &EdgeEnd, neighbour: &Neighbour) -> Option<Wedge> {
    if edge_end.turn < 0.0 || neighbour.pseudo_angle <= HALF_TURN {
        return None;
    }
    Some(Wedge {
        begin: counter_clockwise(edge_end.direction),
        end: clockwise(neighbour.direction),
        kind: CORNER_WEDGE,
    })
}

/// A quarter disk from the quad's outward direction to beyond the edge's end.
fn cap(edge_end: &EdgeEnd) -> Wedge {
    let outward = edge_end.turn * counter_clockwise(edge_end.direction);
    let beyond = -edge_end.direction;
    let (begin, end) = if edge_end.turn > 0.0 { (outward, beyond) } else { (beyond, outward) };
    Wedge { begin, end, kind: CORNER_CAP }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_scene::{TestLight, TestScene};

    fn angle(corner: &Corner) -> f32 {
        Vec2::from(corner.begin).angle_to(Vec2::from(corner.end)).to_degrees()
    }

    /// (vertex, angle in degrees, kind) by ascending vertex.
    fn wedges(scene: &TestScene) -> Vec<(u32, f32, u32)> {
        let mut corners = scene.frame().corners;
        corners.sort_by_key(|corner| (corner.vertex_id, corner.edge_id));
        for corner in &corners {
            let middle = 0.5 * angle(corner).to_radians();
            assert!(
                Vec2::from(corner.middle).distance(Vec2::from_angle(middle).rotate(Vec2::from(corner.begin))) < 1e-5
            );
        }
        corners.iter().map(|corner| (corner.vertex_id, angle(corner).round(), corner.kind)).collect()
    }

    #[test]
    fn wedges_of_a_triangle_turn_once_around() {
        let corners = [[0.0, 0.0], [0.5, 0.0], [0.0, 0.5]];
        let wedges = wedges(&TestScene::flat(&corners, &[[0, 1, 2]]));
        assert_eq!(wedges, [(0, 90.0, CORNER_WEDGE), (1, 135.0, CORNER_WEDGE), (2, 135.0, CORNER_WEDGE)]);
    }

    #[test]
    fn wedge_begins_and_ends_at_the_quads() {
        let corners = [[0.0, 0.0], [0.5, 0.0], [0.0, 0.5]];
        let frame = TestScene::flat(&corners, &[[0, 1, 2]]).frame();
        let corner = frame.corners.iter().find(|corner| corner.vertex_id == 0).expect("vertex 0 is convex");
        assert_eq!((corner.begin, corner.end), ([-1.0, 0.0], [0.0, -1.0]));
        assert_eq!((corner.apex_ndc, corner.q, corner.width_ndc), ([0.0, 0.0], 4.0, 0.05));
    }

    #[test]
    fn concave_vertex_needs_no_corner() {
        // 5-----4
        // |     |
        // |  2--3
        // |  |
        // 0--1
        let corners = [[0.0, 0.0], [0.2, 0.0], [0.2, 0.2], [0.4, 0.2], [0.4, 0.4], [0.0, 0.4]];
        let wedges = wedges(&TestScene::flat(&corners, &[[0, 1, 2], [0, 2, 5], [2, 4, 5], [2, 3, 4]]));
        let vertices: Vec<_> = wedges.iter().map(|&(vertex, ..)| vertex).collect();
        assert_eq!(vertices, [0, 1, 3, 4, 5]);
        assert!(wedges.iter().all(|&(_, angle, kind)| angle == 90.0 && kind == CORNER_WEDGE));
    }

    #[test]
    fn vertex_between_collinear_edges_needs_no_corner() {
        let corners = [[0.0, 0.0], [0.25, 0.1], [0.5, 0.2], [0.0, 0.5]];
        let wedges = wedges(&TestScene::flat(&corners, &[[0, 1, 3], [1, 2, 3]]));
        assert_eq!(wedges.iter().map(|&(vertex, ..)| vertex).collect::<Vec<_>>(), [0, 2, 3]);
    }

    #[test]
    fn bow_tie_closes_each_sector_that_needs_it() {
        // 3     2
        // | \ / |
        // |  0  |
        // | / \ |
        // 4     1
        let corners = [[0.0, 0.0], [0.2, -0.2], [0.2, 0.2], [-0.2, 0.2], [-0.2, -0.2]];
        let quarter_sectors = TestScene::flat(&corners, &[[0, 1, 2], [0, 3, 4]]);
        assert!(wedges(&quarter_sectors).iter().all(|&(vertex, ..)| vertex != 0));

        // Both faces above the vertex: the sector below them spans more than half a turn.
        let corners = [[0.0, 0.0], [0.3, 0.0], [0.3, 0.2], [-0.3, 0.2], [-0.3, 0.1]];
        let one_wide_sector = wedges(&TestScene::flat(&corners, &[[0, 1, 2], [0, 3, 4]]));
        let at_the_tie: Vec<_> = one_wide_sector.iter().filter(|&&(vertex, ..)| vertex == 0).collect();
        assert_eq!(at_the_tie, [&(0, 18.0, CORNER_WEDGE)]);
    }

    #[test]
    fn needle_is_closed_by_two_caps() {
        // The tip's outside sector is a full turn but for a thousandth.
        let corners = [[0.0, 0.0], [0.5, 0.0], [0.5, 0.0005]];
        let wedges = wedges(&TestScene::flat(&corners, &[[0, 1, 2]]));
        assert_eq!(wedges[..2], [(0, 90.0, CORNER_CAP), (0, 90.0, CORNER_CAP)]);
        assert!(wedges[2..].iter().all(|&(_, _, kind)| kind == CORNER_WEDGE));
    }

    #[test]
    fn both_sides_of_a_sector_know_when_an_edge_coincides() {
        // Edge 0-1 nearly coincides with 0-3, so it closes its side alone. Edge 0-2 across the outside must know.
        let corners = [[0.0, 0.0], [0.5, 0.0], [0.45, -0.2], [0.4, -0.002], [0.4, -0.05]];
        let scene = TestScene::flat(&corners, &[[0, 1, 2], [0, 3, 4]]);
        let at_vertex: Vec<_> = wedges(&scene).into_iter().filter(|&(vertex, ..)| vertex == 0).collect();
        assert_eq!(at_vertex, [(0, 90.0, CORNER_CAP); 4]);
    }

    #[test]
    fn neighbour_that_projects_to_a_point_asks_for_caps() {
        let positions = [[0.0; 3], [0.5, 0.0, 0.0], [0.0, 0.0, 1.0]];
        let frame = TestScene::new(&positions, &[[0, 1, 2]], TestLight::Directional).frame();
        assert_eq!(frame.corners.len(), 4);
        assert!(frame.corners.iter().all(|corner| corner.kind == CORNER_CAP));
        // At vertex 0 from below to the left, at vertex 2 from the left to above.
        let at = |vertex| frame.corners.iter().find(|corner| corner.vertex_id == vertex).expect("both ends are capped");
        let rounded = |direction: [f32; 2]| Vec2::from(direction).round() + 0.0;
        assert_eq!(rounded(at(0).end), rounded(at(2).begin));
    }

    #[test]
    fn hub_with_too_many_spokes_is_capped() {
        for (spokes, kind) in [(100, CORNER_WEDGE), (300, CORNER_CAP)] {
            // Half a disk: the two straight edges meet at the hub at slightly less than half a turn.
            let rim = |i| Vec2::from_angle(3.0 * i as f32 / spokes as f32) * 0.5;
            let mut positions = vec![[0.0, 0.0]];
            positions.extend((0..spokes).map(|i| rim(i).to_array()));
            let faces: Vec<_> = (1..spokes).map(|i| [0, i, i + 1]).collect();
            let frame = TestScene::flat(&positions, &faces).frame();
            let at_hub: Vec<_> = frame.corners.iter().filter(|corner| corner.vertex_id == 0).collect();
            assert!(!at_hub.is_empty() && at_hub.iter().all(|corner| corner.kind == kind), "{spokes} spokes");
        }
    }

    #[test]
    fn ends_that_were_cut_off_have_no_corner() {
        let wedges = wedges(&TestScene::flat(&[[0.0, 0.0], [3.0, 0.0], [0.0, 0.5]], &[[0, 1, 2]]));
        assert_eq!(wedges.iter().map(|&(vertex, ..)| vertex).collect::<Vec<_>>(), [0, 2]);
    }
}
