//! Looks for gaps between quads and corners around outline vertices.
//!
//! What must hold, whatever the mesh: a point of the image plane that no blocker covers, but that is nearer to a
//! blocker than the smoothies are wide, lies in a quad or in a corner. For its nearest blocker point is on the boundary
//! of the blockers' image: inside an outline edge, and then the edge's quad has it; or at a vertex, and then a corner.
//!
//! Smoothies are looked at as a disk of light has them. Those of a sphere are drawn stretched, around each vertex by one
//! linear map that turns no order of directions around: where the ones leave no gap, the others leave none.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use contrejour_layout::{Corner, OWN_END_HIGH, OWN_END_LOW, Quad};
use glam::{DVec2, Mat4, Vec3, Vec4, Vec4Swizzles};

/// How densely to look.
#[derive(Clone, Copy, Debug)]
pub struct GapSearch {
    /// Distance of the tried points from their vertex, in NDC. Range: well above rounding (1e-4), below every width.
    pub radius_ndc: f64,
    /// Points tried around each vertex.
    pub directions: u32,
    /// At most so many vertices, evenly chosen from all.
    pub max_vertices: usize,
}

/// Default: radius 0.001, 720 directions, 2000 vertices.
impl Default for GapSearch {
    fn default() -> Self {
        Self { radius_ndc: 1e-3, directions: 720, max_vertices: 2000 }
    }
}

/// A point beside an outline vertex that neither a blocker nor a smoothie covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutlineGap {
    /// Index of the caster.
    pub caster: u32,
    /// The vertex.
    pub vertex_id: u32,
    /// Where the vertex is, in NDC.
    pub apex_ndc: DVec2,
    /// Direction from the vertex to the point, radians counter-clockwise from +x.
    pub direction: f64,
}

/// Every uncovered point that the search tries around the outline vertices in view.
///
/// `blockers` are the images of all faces of all casters in NDC; see [`blocker_image`].
pub fn outline_gaps(
    quads: &[Quad],
    corners: &[Corner],
    blockers: &[[DVec2; 3]],
    search: &GapSearch,
) -> Vec<OutlineGap> {
    let vertices = outline_vertices(quads);
    let stride = vertices.len().div_ceil(search.max_vertices.max(1)).max(1);
    let reach = 2.0 * search.radius_ndc;
    let quad_grid = Grid::new(quads.iter().map(|quad| quad_box(quad, reach)));
    let corner_grid = Grid::new(corners.iter().map(|corner| around(ndc(corner.apex_ndc), reach)));
    let blocker_grid = Grid::new(blockers.iter().map(|corners| box_around(corners, reach)));
    // What is cut off here is a thousandth of a radian as seen from the vertex.
    let tolerance = 1e-3 * search.radius_ndc;

    let mut gaps = Vec::new();
    for (&(caster, vertex_id), &apex_ndc) in vertices.iter().step_by(stride) {
        let near_quads = quad_grid.at(apex_ndc);
        let near_corners = corner_grid.at(apex_ndc);
        let near_blockers = blocker_grid.at(apex_ndc);
        for step in 0..search.directions {
            // Off the axes, where edges of literal meshes lie.
            let direction = TAU * (f64::from(step) + 0.37) / f64::from(search.directions);
            let point = apex_ndc + search.radius_ndc * DVec2::from_angle(direction);
            let covered = near_blockers.iter().any(|&i| distance_to_triangle(&blockers[i], point) <= tolerance)
                || near_quads.iter().any(|&i| quad_covers(&quads[i], point, tolerance))
                || near_corners.iter().any(|&i| corner_covers(&corners[i], point, tolerance));
            if !covered {
                gaps.push(OutlineGap { caster, vertex_id, apex_ndc, direction });
            }
        }
    }
    gaps
}

/// Images of a caster's faces in NDC, without what is in front of the near plane or behind the far one.
///
/// `positions` are brought near 1 by the caster's `position_origin` and `position_scale`, as `light_clip_from_object`
/// expects.
pub fn blocker_image(positions: &[Vec3], faces: &[[u32; 3]], light_clip_from_object: &Mat4) -> Vec<[DVec2; 3]> {
    let clip: Vec<Vec4> = positions.iter().map(|position| light_clip_from_object * position.extend(1.0)).collect();
    let mut image = Vec::new();
    for face in faces {
        let polygon: Vec<Vec4> = face.iter().map(|&vertex| clip[vertex as usize]).collect();
        let polygon = clip_polygon(&polygon, |clip| clip.z);
        let polygon = clip_polygon(&polygon, |clip| clip.w - clip.z);
        let polygon: Vec<DVec2> = polygon.iter().map(|clip| clip.xy().as_dvec2() / f64::from(clip.w)).collect();
        for i in 2..polygon.len() {
            image.push([polygon[0], polygon[i - 1], polygon[i]]);
        }
    }
    image
}

/// The part of a convex polygon where a distance, linear in clip space, is not negative. Sutherland & Hodgman 1974.
fn clip_polygon(polygon: &[Vec4], distance: impl Fn(Vec4) -> f32) -> Vec<Vec4> {
    let mut inside = Vec::new();
    for (i, &to) in polygon.iter().enumerate() {
        let from = polygon[(i + polygon.len() - 1) % polygon.len()];
        let (from_distance, to_distance) = (distance(from), distance(to));
        if (from_distance >= 0.0) != (to_distance >= 0.0) {
            inside.push(from.lerp(to, from_distance / (from_distance - to_distance)));
        }
        if to_distance >= 0.0 {
            inside.push(to);
        }
    }
    inside
}

/// Vertices in view at which quads have their own end, and where they are.
fn outline_vertices(quads: &[Quad]) -> BTreeMap<(u32, u32), DVec2> {
    let mut vertices = BTreeMap::new();
    for quad in quads {
        let low = (OWN_END_LOW, quad.low_vertex, quad.low_ndc);
        let high = (OWN_END_HIGH, quad.high_vertex, quad.high_ndc);
        for (own_end, vertex_id, apex_ndc) in [low, high] {
            let apex_ndc = ndc(apex_ndc);
            if quad.own_ends & own_end != 0 && apex_ndc.abs().max_element() <= 1.0 {
                vertices.insert((quad.caster, vertex_id), apex_ndc);
            }
        }
    }
    vertices
}

fn ndc(point: [f32; 2]) -> DVec2 {
    DVec2::from(point.map(f64::from))
}

/// Whether a point is in a quad as it is drawn: from its edge along `outward`, which is across the true edge and not
/// quite across the rounded ends of a short one.
fn quad_covers(quad: &Quad, point: DVec2, tolerance: f64) -> bool {
    let (low, high, outward) = (ndc(quad.low_ndc), ndc(quad.high_ndc), ndc(quad.outward));
    let length = (high - low).length();
    let along = (high - low).try_normalize().unwrap_or(outward.perp());
    // point = low + distance_along * along + across * outward
    let sine = along.perp_dot(outward);
    let distance_along = (point - low).perp_dot(outward) / sine;
    let across = along.perp_dot(point - low) / sine;
    let share = (distance_along / length.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    let width = f64::from(quad.width_ndc[0]) * (1.0 - share) + f64::from(quad.width_ndc[1]) * share;
    (-tolerance..=width + tolerance).contains(&across) && (-tolerance..=length + tolerance).contains(&distance_along)
}

fn corner_covers(corner: &Corner, point: DVec2, tolerance: f64) -> bool {
    let from_apex = point - ndc(corner.apex_ndc);
    from_apex.length() <= f64::from(corner.width_ndc) + tolerance
        && ndc(corner.begin).perp_dot(from_apex) >= -tolerance
        && from_apex.perp_dot(ndc(corner.end)) >= -tolerance
        && ndc(corner.middle).dot(from_apex) >= -tolerance
}

/// Zero inside.
fn distance_to_triangle(triangle: &[DVec2; 3], point: DVec2) -> f64 {
    let [a, b, c] = *triangle;
    let sides = [(a, b), (b, c), (c, a)].map(|(from, to)| Side::new(from, to, point));
    let area = (b - a).perp_dot(c - a);
    if area != 0.0 && sides.iter().all(|side| side.doubled_area() * area > 0.0) {
        return 0.0;
    }
    sides.iter().map(Side::distance).fold(f64::MAX, f64::min)
}

/// A side of a triangle as seen from a point: from the end that is nearer to it, since beside a side that is 1e16 times
/// longer than the point is away, the other end would swallow the point's digits.
struct Side {
    /// From the nearer end to the point.
    to_point: DVec2,
    /// From the nearer end to the farther one.
    to_far_end: DVec2,
    /// 1, or -1 where the nearer end is the side's second.
    sign: f64,
}

impl Side {
    fn new(from: DVec2, to: DVec2, point: DVec2) -> Self {
        if point.distance_squared(from) <= point.distance_squared(to) {
            Self { to_point: point - from, to_far_end: to - from, sign: 1.0 }
        } else {
            Self { to_point: point - to, to_far_end: from - to, sign: -1.0 }
        }
    }

    /// Twice the area of the triangle that the side has with the point. Positive to the left of the side.
    fn doubled_area(&self) -> f64 {
        self.sign * self.to_far_end.perp_dot(self.to_point)
    }

    fn distance(&self) -> f64 {
        let length_squared = self.to_far_end.length_squared().max(f64::MIN_POSITIVE);
        let share = (self.to_point.dot(self.to_far_end) / length_squared).clamp(0.0, 1.0);
        self.to_point.distance(share * self.to_far_end)
    }
}

type Box2 = (DVec2, DVec2);

fn box_around(points: &[DVec2], reach: f64) -> Box2 {
    let min = points.iter().copied().fold(DVec2::MAX, DVec2::min);
    let max = points.iter().copied().fold(DVec2::MIN, DVec2::max);
    (min - reach, max + reach)
}

fn around(point: DVec2, reach: f64) -> Box2 {
    box_around(&[point], reach)
}

fn quad_box(quad: &Quad, reach: f64) -> Box2 {
    let (low, high, outward) = (ndc(quad.low_ndc), ndc(quad.high_ndc), ndc(quad.outward));
    let rim = [low + f64::from(quad.width_ndc[0]) * outward, high + f64::from(quad.width_ndc[1]) * outward];
    box_around(&[low, high, rim[0], rim[1]], reach)
}

/// Which boxes lie near a point of the view.
struct Grid {
    cells: Vec<Vec<usize>>,
}

impl Grid {
    const SIDE: usize = 128;

    fn new(boxes: impl Iterator<Item = Box2>) -> Self {
        let mut cells = vec![Vec::new(); Self::SIDE * Self::SIDE];
        for (i, (min, max)) in boxes.enumerate() {
            if max.min_element() < -1.0 || min.max_element() > 1.0 {
                continue;
            }
            for y in Self::cell(min.y)..=Self::cell(max.y) {
                for x in Self::cell(min.x)..=Self::cell(max.x) {
                    cells[y * Self::SIDE + x].push(i);
                }
            }
        }
        Self { cells }
    }

    fn at(&self, point: DVec2) -> &[usize] {
        &self.cells[Self::cell(point.y) * Self::SIDE + Self::cell(point.x)]
    }

    fn cell(coordinate: f64) -> usize {
        // Saturates: what is outside the view falls into the cells at its border.
        ((0.5 * (coordinate + 1.0) * Self::SIDE as f64) as usize).min(Self::SIDE - 1)
    }
}

#[cfg(test)]
mod tests {
    use contrejour_layout::CORNER_WEDGE;

    use super::*;

    const TRIANGLE: [[f32; 2]; 3] = [[-0.5, -0.4], [0.5, -0.4], [0.0, 0.6]];

    fn normal(from: [f32; 2], to: [f32; 2]) -> [f32; 2] {
        // The right of a counter-clockwise edge is outside.
        (ndc(to) - ndc(from)).perp().normalize().as_vec2().to_array().map(|value| -value)
    }

    fn closed_triangle() -> (Vec<Quad>, Vec<Corner>, Vec<[DVec2; 3]>) {
        let mut quads = Vec::new();
        let mut corners = Vec::new();
        for i in 0..3 {
            let next = (i + 1) % 3;
            let outward = normal(TRIANGLE[i], TRIANGLE[next]);
            let next_outward = normal(TRIANGLE[next], TRIANGLE[(i + 2) % 3]);
            quads.push(Quad {
                low_ndc: TRIANGLE[i],
                high_ndc: TRIANGLE[next],
                outward,
                width_ndc: [0.05; 2],
                low_vertex: i as u32,
                high_vertex: next as u32,
                own_ends: OWN_END_LOW | OWN_END_HIGH,
                ..Default::default()
            });
            corners.push(Corner {
                apex_ndc: TRIANGLE[next],
                begin: outward,
                middle: (ndc(outward) + ndc(next_outward)).normalize().as_vec2().to_array(),
                end: next_outward,
                width_ndc: 0.05,
                vertex_id: next as u32,
                kind: CORNER_WEDGE,
                ..Default::default()
            });
        }
        (quads, corners, vec![TRIANGLE.map(ndc)])
    }

    #[test]
    fn a_closed_triangle_has_no_gap() {
        let (quads, corners, blockers) = closed_triangle();
        assert_eq!(outline_gaps(&quads, &corners, &blockers, &GapSearch::default()), []);
    }

    #[test]
    fn a_missing_corner_is_found() {
        let (quads, mut corners, blockers) = closed_triangle();
        let missing = corners.swap_remove(1);
        let gaps = outline_gaps(&quads, &corners, &blockers, &GapSearch::default());
        assert!(gaps.len() > 100 && gaps.iter().all(|gap| gap.vertex_id == missing.vertex_id), "{gaps:?}");
    }

    #[test]
    fn a_missing_quad_is_found() {
        let (mut quads, corners, blockers) = closed_triangle();
        quads.swap_remove(0);
        assert!(!outline_gaps(&quads, &corners, &blockers, &GapSearch::default()).is_empty());
    }

    /// A hundred edges of an outline that rounding turns by hundredths of a radian, and their outward directions by
    /// nothing: quads are drawn along those.
    #[test]
    fn short_edges_with_rounded_ends_have_no_gap() {
        let vertex = |index: u32| 0.7 * DVec2::from_angle(0.3 + 1e-5 * f64::from(index));
        let rounded = |index| vertex(index).as_vec2().to_array();
        let outward = |index| (vertex(index + 1) - vertex(index)).normalize().perp().as_vec2().to_array().map(|x| -x);
        let quads = (0..100).map(|index| Quad {
            low_ndc: rounded(index),
            high_ndc: rounded(index + 1),
            outward: outward(index),
            width_ndc: [0.05; 2],
            low_vertex: index,
            high_vertex: index + 1,
            // Where the row of edges ends, nothing closes it.
            own_ends: if (40..60).contains(&index) { OWN_END_LOW } else { 0 },
            ..Default::default()
        });
        let corners = (0..99).map(|index| Corner {
            apex_ndc: rounded(index + 1),
            begin: outward(index),
            middle: outward(index),
            end: outward(index + 1),
            width_ndc: 0.05,
            vertex_id: index + 1,
            kind: CORNER_WEDGE,
            ..Default::default()
        });
        let (quads, mut corners): (Vec<_>, Vec<_>) = (quads.collect(), corners.collect());
        let blockers: Vec<_> =
            (0..100).map(|index| [DVec2::ZERO, ndc(rounded(index)), ndc(rounded(index + 1))]).collect();
        // Near enough that all points beside a vertex are beside the row.
        let search = GapSearch { radius_ndc: 2e-4, ..GapSearch::default() };
        assert_eq!(outline_gaps(&quads, &corners, &blockers, &search), []);
        let mut turned = quads.clone();
        turned[50].outward = (DVec2::from_angle(0.02).rotate(ndc(quads[50].outward))).as_vec2().to_array();
        corners.retain(|corner| corner.vertex_id != 51);
        assert!(!outline_gaps(&turned, &corners, &blockers, &search).is_empty());
    }

    #[test]
    fn a_corner_turned_by_two_degrees_is_found() {
        let (quads, mut corners, blockers) = closed_triangle();
        let turned = DVec2::from_angle(2_f64.to_radians()).rotate(ndc(corners[0].begin));
        corners[0].begin = turned.as_vec2().to_array();
        assert!(!outline_gaps(&quads, &corners, &blockers, &GapSearch::default()).is_empty());
    }

    /// A triangle that is 1e22 times the view, whose corner lies in it: what it covers is known by its angle.
    #[test]
    fn a_point_beside_the_corner_of_a_huge_triangle_is_told_from_one_in_it() {
        let (apex, size) = (DVec2::new(0.25, -0.5), 1e22);
        for turn in 0..360 {
            let direction = |angle: f64| DVec2::from_angle((f64::from(turn) + angle).to_radians());
            let mut corners = [apex, apex + size * direction(0.0), apex + 3.0 * size * direction(50.0)];
            for _ in 0..3 {
                corners.rotate_left(1);
                let distance = |angle| distance_to_triangle(&corners, apex + 1e-3 * direction(angle));
                assert_eq!(distance(25.0), 0.0, "{turn}");
                for (outside, expected) in [(-10.0, 10_f64), (60.0, 10.0), (205.0, 90.0)] {
                    let expected = 1e-3 * expected.to_radians().sin();
                    assert!((distance(outside) - expected).abs() < 1e-9, "{turn}: {outside}");
                }
            }
        }
    }

    #[test]
    fn faces_across_the_near_plane_are_cut() {
        let perspective = Mat4::from_cols_array(&[
            1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.25, -1.0, 0.0, 0.0, -1.25, 0.0,
        ]);
        let positions = [Vec3::new(-1.0, 0.0, -2.0), Vec3::new(1.0, 0.0, -2.0), Vec3::new(0.0, 1.0, 2.0)];
        let image = blocker_image(&positions, &[[0, 1, 2]], &perspective);
        assert_eq!(image.len(), 2);
        assert!(image.iter().flatten().all(|point| point.is_finite() && point.y >= 0.0));
    }
}
