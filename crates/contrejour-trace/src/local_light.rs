//! The light where rays are traced, and the points of it that they go to.

use glam::{DVec2, DVec3};

use crate::disk_map::disk_from_square;
use crate::shadow_ray::ShadowRay;
use crate::shaft::Shaft;
use crate::surface_point::SurfacePoint;
use crate::trace_space::TraceSpace;
use crate::{Facing, LightShape};

/// Rays end this part of their length before the light, so that faces in the plane of the light never block it.
const SHORTER: f64 = 1.0 - 1.0 / (1_u64 << 40) as f64;

/// A light shape in trace space.
#[derive(Clone, Copy, Debug)]
pub(crate) enum LocalLight {
    Disk { center: DVec3, half_u: DVec3, half_v: DVec3 },
    Rectangle { center: DVec3, half_u: DVec3, half_v: DVec3 },
    Sphere { center: DVec3, radius: f64 },
    Sun { axis: DVec3, half_u: DVec3, half_v: DVec3 },
}

impl LocalLight {
    pub fn new(light: &LightShape, space: &TraceSpace) -> Self {
        match *light {
            LightShape::Disk { center, normal, radius } => {
                let (u, v) = unit(normal).any_orthonormal_pair();
                let radius = space.length_from_world(radius);
                Self::Disk { center: space.point_from_world(center), half_u: u * radius, half_v: v * radius }
            }
            LightShape::Rectangle { center, half_u, half_v } => Self::Rectangle {
                center: space.point_from_world(center),
                half_u: space.vector_from_world(half_u),
                half_v: space.vector_from_world(half_v),
            },
            LightShape::Sphere { center, radius } => {
                Self::Sphere { center: space.point_from_world(center), radius: space.length_from_world(radius) }
            }
            LightShape::Sun { towards_light, angular_radius } => {
                let axis = unit(towards_light);
                let (u, v) = axis.any_orthonormal_pair();
                Self::Sun { axis, half_u: u * angular_radius.tan(), half_v: v * angular_radius.tan() }
            }
        }
    }

    /// Whether it is a point or a direction, so that one ray tells all.
    pub fn has_no_size(&self) -> bool {
        match *self {
            Self::Disk { half_u, half_v, .. }
            | Self::Rectangle { half_u, half_v, .. }
            | Self::Sun { half_u, half_v, .. } => half_u == DVec3::ZERO && half_v == DVec3::ZERO,
            Self::Sphere { radius, .. } => radius == 0.0,
        }
    }

    /// Whether a point is inside a sphere of light: it then sees nothing else.
    pub fn surrounds(&self, point: DVec3) -> bool {
        matches!(*self, Self::Sphere { center, radius } if center.distance(point) < radius)
    }

    /// On which side of the receiver's plane it is.
    pub fn facing(&self, receiver: &SurfacePoint) -> Facing {
        let height_of = |point: DVec3| receiver.normal.dot(point - receiver.position);
        let [along_u, along_v] = match *self {
            Self::Disk { half_u, half_v, .. }
            | Self::Rectangle { half_u, half_v, .. }
            | Self::Sun { half_u, half_v, .. } => [half_u, half_v].map(|half| receiver.normal.dot(half)),
            Self::Sphere { radius, .. } => [radius, 0.0],
        };
        let (height, half_height) = match *self {
            Self::Disk { center, .. } | Self::Sphere { center, .. } => (height_of(center), along_u.hypot(along_v)),
            Self::Rectangle { center, .. } => (height_of(center), along_u.abs() + along_v.abs()),
            Self::Sun { axis, .. } => (receiver.normal.dot(axis), along_u.hypot(along_v)),
        };
        match height {
            _ if height >= half_height && height > 0.0 => Facing::Towards,
            _ if height <= -half_height => Facing::Averted,
            _ if height >= 0.0 => Facing::MostlyTowards,
            _ => Facing::MostlyAverted,
        }
    }

    /// All rays from a point above a face with the unit normal `normal`. None where the point is so near that they go
    /// everywhere.
    pub fn shaft_from(&self, apex: DVec3, normal: DVec3) -> Option<Shaft> {
        match *self {
            Self::Disk { center, half_u, .. } => Shaft::to_sphere(apex, normal, center, half_u.length()),
            Self::Rectangle { center, half_u, half_v } => {
                let radius = (half_u + half_v).length().max((half_u - half_v).length());
                Shaft::to_sphere(apex, normal, center, radius)
            }
            Self::Sphere { center, radius } => Shaft::to_sphere(apex, normal, center, radius),
            Self::Sun { axis, half_u, .. } => Some(Shaft::to_sun(apex, normal, axis, half_u.length().atan())),
        }
    }

    /// The ray from a point to the point of the light that belongs to a point of the square 0..1: equal areas of the
    /// square are equal areas of the light, equal solid angles for a sphere.
    pub fn ray_from(&self, origin: DVec3, square: DVec2) -> ShadowRay {
        match *self {
            Self::Disk { center, half_u, half_v } => {
                let disk = disk_from_square(square);
                ray_to(origin, center + disk.x * half_u + disk.y * half_v)
            }
            Self::Rectangle { center, half_u, half_v } => {
                let [u, v] = (2.0 * square - 1.0).to_array();
                ray_to(origin, center + u * half_u + v * half_v)
            }
            Self::Sphere { center, radius } => {
                let to_center = center - origin;
                let distance = to_center.length();
                let axis = to_center / distance;
                let (u, v) = axis.any_orthonormal_pair();
                // One minus the cosine of the cone that the sphere fills, without cancellation for small ones.
                let sine = radius / distance;
                let depth = sine * sine / (1.0 + (1.0 - sine * sine).sqrt());
                // One minus the cosine is uniform in solid angle, as the squared radius is in the disk's area.
                let disk = disk_from_square(square);
                let below_one = disk.length_squared() * depth;
                let across = disk * (depth * (2.0 - below_one)).sqrt();
                let direction = (axis * (1.0 - below_one) + across.x * u + across.y * v).normalize();
                let half_chord = (radius * radius - distance * distance * across.length_squared()).max(0.0).sqrt();
                ShadowRay::new(origin, direction, SHORTER * (distance * (1.0 - below_one) - half_chord))
            }
            Self::Sun { axis, half_u, half_v } => {
                let disk = disk_from_square(square);
                ShadowRay::new(origin, (axis + disk.x * half_u + disk.y * half_v).normalize(), f64::INFINITY)
            }
        }
    }
}

fn ray_to(origin: DVec3, target: DVec3) -> ShadowRay {
    let distance = origin.distance(target);
    ShadowRay::new(origin, (target - origin) / distance, SHORTER * distance)
}

/// Of any vector but zero; the largest component goes first, so that squares neither overflow nor vanish.
fn unit(direction: DVec3) -> DVec3 {
    (direction / direction.abs().max_element()).normalize()
}
