//! Where rays start.

use glam::DVec3;

/// Starts keep so many lifts off the lines of their face's sides, about, so that rounding never puts one behind a wall
/// that meets the face there.
const LIFTS_INWARDS: f64 = 3.0;

/// The most of the way to the middle of a face that a start moves inwards: slivers are thinner than rounding.
const MOST_INWARDS: f64 = 1.0 / 64.0;

/// A start of rays on the side of a face that is looked at, in trace space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfacePoint {
    pub position: DVec3,
    /// Unit, to the side that is looked at.
    pub normal: DVec3,
}

impl SurfacePoint {
    /// Above the point of the face nearest to `position`, by `lift`, and about as much inwards from its border. The
    /// face must have area.
    pub fn above_face(corners: &[DVec3; 3], position: DVec3, seen_from: DVec3, lift: f64) -> Self {
        let [a, b, c] = *corners;
        let nearest = nearest_point(corners, position);
        let across = (b - a).cross(c - a);
        let normal = across.normalize();
        let normal = if normal.dot(seen_from - nearest) >= 0.0 { normal } else { -normal };
        // The middle is a third of the least height off the longest side, and more off the others.
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let least_height = across.length() / longest;
        let inwards = (3.0 * LIFTS_INWARDS * lift / least_height).min(MOST_INWARDS);
        let on_face = nearest + ((a + b + c) / 3.0 - nearest) * inwards;
        Self { position: on_face + lift * normal, normal }
    }
}

/// The point of a triangle that is nearest to another (Ericson 2005, section 5.1.5).
fn nearest_point(&[a, b, c]: &[DVec3; 3], point: DVec3) -> DVec3 {
    let (ab, ac) = (b - a, c - a);
    let from_a = [ab, ac].map(|edge| edge.dot(point - a));
    let from_b = [ab, ac].map(|edge| edge.dot(point - b));
    let from_c = [ab, ac].map(|edge| edge.dot(point - c));
    if from_a[0] <= 0.0 && from_a[1] <= 0.0 {
        return a;
    }
    if from_b[0] >= 0.0 && from_b[1] <= from_b[0] {
        return b;
    }
    if from_c[1] >= 0.0 && from_c[0] <= from_c[1] {
        return c;
    }
    // Barycentric weights of c, b and a, times the same number.
    let weight_c = from_a[0] * from_b[1] - from_b[0] * from_a[1];
    if weight_c <= 0.0 && from_a[0] >= 0.0 && from_b[0] <= 0.0 {
        return a + ab * (from_a[0] / (from_a[0] - from_b[0]));
    }
    let weight_b = from_c[0] * from_a[1] - from_a[0] * from_c[1];
    if weight_b <= 0.0 && from_a[1] >= 0.0 && from_c[1] <= 0.0 {
        return a + ac * (from_a[1] / (from_a[1] - from_c[1]));
    }
    let weight_a = from_b[0] * from_c[1] - from_c[0] * from_b[1];
    let (past_b, past_c) = (from_b[1] - from_b[0], from_c[0] - from_c[1]);
    if weight_a <= 0.0 && past_b >= 0.0 && past_c >= 0.0 {
        return b + (c - b) * (past_b / (past_b + past_c));
    }
    let sum = weight_a + weight_b + weight_c;
    a + ab * (weight_b / sum) + ac * (weight_c / sum)
}
