//! One ray against one face.

use glam::DVec3;

/// The way from a receiver to a point of the light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShadowRay {
    pub origin: DVec3,
    /// Unit.
    pub direction: DVec3,
    /// Distance of the light; infinite for a sun.
    pub reach: f64,
    /// The direction's largest component.
    along: Axis,
    /// The direction's other components over the largest: the shear that lays the ray along that axis.
    shear: [f64; 2],
}

#[derive(Clone, Copy, Debug)]
enum Axis {
    X,
    Y,
    Z,
}

impl Axis {
    /// Of the largest absolute component.
    fn of(direction: DVec3) -> Self {
        let size = direction.abs();
        if size.x >= size.y && size.x >= size.z {
            Self::X
        } else if size.y >= size.z {
            Self::Y
        } else {
            Self::Z
        }
    }

    /// The components, with this axis last.
    fn last(self, vector: DVec3) -> [f64; 3] {
        match self {
            Self::X => [vector.y, vector.z, vector.x],
            Self::Y => [vector.z, vector.x, vector.y],
            Self::Z => [vector.x, vector.y, vector.z],
        }
    }
}

impl ShadowRay {
    pub fn new(origin: DVec3, direction: DVec3, reach: f64) -> Self {
        let along = Axis::of(direction);
        let [x, y, z] = along.last(direction);
        Self { origin, direction, reach, along, shear: [x / z, y / z] }
    }

    /// Where the face lies between the origin and the light, borders included: the weights of its corners there; none where it
    /// does not.
    ///
    /// The test of Woop, Benthin & Wald 2013 in `f64`. Corners are sheared onto a plane where the ray is the origin: a
    /// corner falls on the same point for each of its faces. There an edge's side is the sign of the difference of two
    /// products; each is rounded once and rounding is monotonic, so the sign is right or zero, and zero counts as
    /// inside for the faces on both sides. So no ray slips between faces that share an edge or a corner.
    pub fn meets(&self, corners: &[DVec3; 3]) -> Option<[f64; 3]> {
        let [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = corners.map(|corner| self.sheared(corner));
        let u = cx * by - cy * bx;
        let v = ax * cy - ay * cx;
        let w = bx * ay - by * ax;
        let is_inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
        // Zero where the ray lies in the face's plane: it then passes along an opaque sheet of no thickness.
        let area = u + v + w;
        if !is_inside || area == 0.0 {
            return None;
        }
        let [_, _, step] = self.along.last(self.direction);
        let distance = (u * az + v * bz + w * cz) / (area * step);
        (distance > 0.0 && distance < self.reach).then(|| [u, v, w].map(|weight| weight / area))
    }

    /// A point relative to the origin, sheared so that the ray runs along the third axis.
    fn sheared(&self, point: DVec3) -> [f64; 3] {
        let [x, y, z] = self.along.last(point - self.origin);
        [x - self.shear[0] * z, y - self.shear[1] * z, z]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FACE: [DVec3; 3] = [DVec3::new(0.0, 0.0, 1.0), DVec3::new(1.0, 0.0, 1.0), DVec3::new(0.0, 1.0, 1.0)];

    fn blocks(origin: DVec3, direction: DVec3, reach: f64) -> bool {
        let ray = ShadowRay::new(origin, direction.normalize(), reach);
        let [a, b, c] = FACE;
        let is_met = ray.meets(&FACE).is_some();
        assert_eq!(is_met, ray.meets(&[a, c, b]).is_some(), "both sides are opaque");
        is_met
    }

    #[test]
    fn a_face_blocks_what_is_behind_it() {
        let inside = DVec3::new(0.25, 0.25, 0.0);
        assert!(blocks(inside, DVec3::Z, f64::INFINITY));
        assert!(blocks(inside, DVec3::Z, 1.001));
        assert!(!blocks(inside, DVec3::Z, 0.999), "the light is before it");
        assert!(!blocks(inside, -DVec3::Z, f64::INFINITY), "it is behind the receiver");
        assert!(!blocks(DVec3::new(0.75, 0.75, 0.0), DVec3::Z, f64::INFINITY), "the ray goes by");
    }

    #[test]
    fn weights_say_where_it_is_met() {
        let point = DVec3::new(0.25, 0.5, 0.0);
        let ray = ShadowRay::new(point, DVec3::Z, f64::INFINITY);
        assert_eq!(ray.meets(&FACE), Some([0.25, 0.25, 0.5]));
    }

    #[test]
    fn borders_belong_to_the_face() {
        for border in [DVec3::ZERO, DVec3::X, DVec3::new(0.5, 0.5, 0.0), DVec3::new(0.0, 0.3, 0.0)] {
            assert!(blocks(border, DVec3::Z, f64::INFINITY), "{border}");
        }
    }

    #[test]
    fn each_axis_can_lead() {
        let target = DVec3::new(0.25, 0.25, 1.0);
        for from in [DVec3::new(9.0, 0.0, 0.0), DVec3::new(0.0, -9.0, 0.0), DVec3::new(0.0, 0.0, 9.0)] {
            assert!(blocks(from, target - from, f64::INFINITY), "{from}");
            assert!(!blocks(from, from - target, f64::INFINITY), "{from}");
        }
    }

    #[test]
    fn a_ray_in_the_plane_passes() {
        assert!(!blocks(DVec3::new(-1.0, 0.25, 1.0), DVec3::X, f64::INFINITY));
    }
}
