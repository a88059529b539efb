//! Exact predicates on points of a mesh, by the adaptive arithmetic of Shewchuk (1997).
//!
//! The differences and products of up to three `f32` coordinates stay far inside the exponent range of `f64`, where
//! the adaptive predicates are exact.

use std::cmp::Ordering;

use robust::{Coord, Coord3D, orient2d, orient3d};

/// Where a point lies, seen against the front of a plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PlaneSide {
    /// On the side from which the plane's triangle looks counter-clockwise.
    InFront,
    /// Exactly in the plane.
    On,
    /// On the other side.
    Behind,
}

/// Where `point` lies against the plane of the triangle `a`, `b`, `c`; in it when the triangle has no area.
pub(super) fn side_of_plane(a: [f32; 3], b: [f32; 3], c: [f32; 3], point: [f32; 3]) -> PlaneSide {
    let coord = |p: [f32; 3]| Coord3D { x: p[0], y: p[1], z: p[2] };
    // Shewchuk's sign is positive below the plane.
    match orient3d(coord(a), coord(b), coord(c), coord(point)).partial_cmp(&0.0) {
        Some(Ordering::Greater) => PlaneSide::Behind,
        Some(Ordering::Less) => PlaneSide::InFront,
        _ => PlaneSide::On,
    }
}

/// Axes that span each of the three coordinate planes.
const PLANES: [(usize, usize); 3] = [(0, 1), (1, 2), (2, 0)];

/// Sign of the area of the triangle's projection onto one coordinate plane.
fn projected_area((x, y): (usize, usize), a: [f32; 3], b: [f32; 3], c: [f32; 3]) -> f64 {
    let coord = |p: [f32; 3]| Coord { x: p[x], y: p[y] };
    orient2d(coord(a), coord(b), coord(c))
}

/// Whether three points lie exactly on one line.
pub(super) fn collinear(a: [f32; 3], b: [f32; 3], c: [f32; 3]) -> bool {
    // A triangle without area is one whose three projections have none.
    PLANES.iter().all(|&plane| projected_area(plane, a, b, c) == 0.0)
}

/// Whether `p` and `q` lie strictly on opposite sides of the line through `low` and `high`, all four being exactly in
/// one plane. False when one of them is on the line.
pub(super) fn opposite_sides(low: [f32; 3], high: [f32; 3], p: [f32; 3], q: [f32; 3]) -> bool {
    // A projection that keeps the area on one side maps the common plane one to one, so it keeps sides.
    PLANES
        .iter()
        .map(|&plane| (projected_area(plane, low, high, p), projected_area(plane, low, high, q)))
        .find(|&(of_p, _)| of_p != 0.0)
        .is_some_and(|(of_p, of_q)| if of_p > 0.0 { of_q < 0.0 } else { of_q > 0.0 })
}

/// Whether `point`, on the line through `a` and `b`, lies between them or on one of them.
pub(super) fn between(a: [f32; 3], point: [f32; 3], b: [f32; 3]) -> bool {
    // Along a line, the order of the coordinates (x first, then y, then z) is the order of the points.
    let in_order = |p: [f32; 3], q: [f32; 3]| p.partial_cmp(&q).is_some_and(Ordering::is_le);
    (in_order(a, point) && in_order(point, b)) || (in_order(b, point) && in_order(point, a))
}

#[cfg(test)]
mod tests {
    use super::*;

    const O: [f32; 3] = [0.0, 0.0, 0.0];
    const X: [f32; 3] = [1.0, 0.0, 0.0];
    const Y: [f32; 3] = [0.0, 1.0, 0.0];

    #[test]
    fn a_counter_clockwise_triangle_has_its_front_above() {
        assert_eq!(side_of_plane(O, X, Y, [0.0, 0.0, 1.0]), PlaneSide::InFront);
        assert_eq!(side_of_plane(O, X, Y, [0.0, 0.0, -1.0]), PlaneSide::Behind);
        assert_eq!(side_of_plane(O, X, Y, [7.0, -3.0, 0.0]), PlaneSide::On);
    }

    #[test]
    fn the_smallest_step_leaves_the_plane() {
        let smallest = f32::from_bits(1);
        assert_eq!(side_of_plane(O, X, Y, [1e30, 1e30, smallest]), PlaneSide::InFront);
        assert_eq!(side_of_plane(O, X, Y, [1e30, 1e30, -smallest]), PlaneSide::Behind);
        let tiny_x = [smallest, 0.0, 0.0];
        let tiny_y = [0.0, smallest, 0.0];
        assert_eq!(side_of_plane(O, tiny_x, tiny_y, [0.0, 0.0, smallest]), PlaneSide::InFront);
    }

    #[test]
    fn collinear_is_exact() {
        assert!(collinear(O, [0.1, 0.2, 0.3], [0.2, 0.4, 0.6]));
        assert!(!collinear(O, [0.1, 0.2, 0.3], [0.2, 0.4, 0.6f32.next_up()]));
        assert!(!collinear([1e20, 0.0, 0.0], [0.0, f32::from_bits(1), 0.0], [-1e20, 0.0, 0.0]));
    }

    #[test]
    fn sides_of_a_line_in_a_tilted_plane() {
        // The plane x + y + z = 0 seen along any axis.
        let (low, high) = ([1.0, -1.0, 0.0], [-1.0, 1.0, 0.0]);
        assert!(opposite_sides(low, high, [1.0, 1.0, -2.0], [-1.0, -1.0, 2.0]));
        assert!(!opposite_sides(low, high, [1.0, 1.0, -2.0], [2.0, 1.0, -3.0]));
        assert!(!opposite_sides(low, high, [1.0, 1.0, -2.0], O));
        assert!(!opposite_sides(low, high, O, [1.0, 1.0, -2.0]));
    }

    #[test]
    fn between_holds_along_every_axis() {
        for axis in 0..3 {
            let at = |t: f32| std::array::from_fn(|i| if i == axis { t } else { 5.0 });
            assert!(between(at(-1.0), at(0.0), at(2.0)));
            assert!(between(at(2.0), at(2.0), at(-1.0)));
            assert!(!between(at(-1.0), at(2.0), at(0.0)));
        }
    }
}
