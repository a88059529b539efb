use super::*;
use crate::{CubeFace, Light, LightKind, views};
use glam::{DVec3, Vec4Swizzles};

const RADIUS: f64 = 0.02;

fn lamp_views() -> Vec<View> {
    let kind = LightKind::Point { position: DVec3::ZERO, radius: RADIUS, near: 0.1, far: 50.0 };
    views(&Light { kind, color: [1.0; 3] }).expect("a good lamp")
}

fn as_disks(views: &[View]) -> Vec<View> {
    views.iter().map(|view| View { light_outline: LightOutline::Disk, ..*view }).collect()
}

/// An edge and a receiver beyond it, from the light.
#[derive(Clone, Copy, Debug)]
struct Sight {
    edge: [DVec3; 2],
    receiver: DVec3,
}

impl Sight {
    /// The receiver's alpha on a view's image plane, as stages and passes make it; none beside the edge's quad.
    fn alpha(&self, view: &View) -> Option<f64> {
        let image = |point: DVec3| {
            let clip = view.light_clip_from_world * point.extend(1.0);
            (clip.w > view.near_depth).then(|| (clip.xy() / clip.w, clip.w))
        };
        let [(low, low_depth), (high, high_depth)] = [image(self.edge[0])?, image(self.edge[1])?];
        let (receiver, receiver_depth) = image(self.receiver)?;
        let direction = (high - low).normalize();
        let normal = direction.perp() * direction.perp().dot(receiver - low).signum();
        let share = direction.dot(receiver - low) / low.distance(high);
        let q = view.q_of_depth(low_depth) * (1.0 - share) + view.q_of_depth(high_depth) * share;
        let width = view.light_size * (view.q_max() - q);
        let rim = width * view.rim_offset(low.lerp(high, share), normal).dot(normal);
        let alpha = normal.dot(receiver - low) / rim;
        let remapped = alpha * (view.q_max() - q) / (view.q_of_depth(receiver_depth) - q);
        (0.0..=1.0).contains(&share).then_some(remapped.clamp(0.0, 1.0))
    }

    /// Where the plane through edge and receiver cuts the sphere, as a share of its radius: what alpha means.
    fn truth(&self) -> f64 {
        let [low, high] = self.edge;
        let normal = (high - low).cross(self.receiver - low).normalize();
        (normal.dot(low).abs() / RADIUS).min(1.0)
    }
}

/// Edges of all directions before receivers, where the receiver sees a part of the sphere.
fn sights(receiver: impl Fn(f64, f64) -> DVec3) -> Vec<Sight> {
    let sights = (1..20_000).map(|i| {
        let fract = |factor: f64| (factor * f64::from(i)).fract() - 0.5;
        let receiver = (5.0 + 4.0 * fract(0.912)) * receiver(2.0 * fract(0.819), 2.0 * fract(0.671));
        let offset = DVec3::new(fract(0.549), fract(0.450), fract(0.369)) * 4.0 * RADIUS;
        let along = DVec3::new(fract(0.303), fract(0.248), fract(0.203)).normalize();
        let middle = (0.45 + 0.2 * fract(0.167)) * receiver + offset;
        Sight { edge: [middle - 0.4 * along, middle + 0.4 * along], receiver }
    });
    // Where an edge almost points at the receiver, hardly a part of it is seen from there.
    let is_across = |sight: &Sight| {
        let along = (sight.edge[1] - sight.edge[0]).normalize();
        along.cross((sight.receiver - sight.edge[0]).normalize()).length() > 0.3
    };
    sights.filter(|sight| is_across(sight) && sight.truth() < 1.0).collect()
}

/// Mean difference of alpha in two views, of those sights that both show.
fn mean_difference(sights: &[Sight], a: impl Fn(&Sight) -> Option<f64>, b: impl Fn(&Sight) -> Option<f64>) -> f64 {
    let differences: Vec<f64> = sights.iter().filter_map(|sight| Some((a(sight)? - b(sight)?).abs())).collect();
    assert!(differences.len() > 2000, "enough to tell: {}", differences.len());
    differences.iter().sum::<f64>() / differences.len() as f64
}

#[test]
fn neighbours_agree_about_soft_edges_at_their_border() {
    let sights = sights(|along, _| DVec3::new(1.0, 1.0, along));
    let difference = |views: &[View]| {
        let [a, b] = [CubeFace::PositiveX, CubeFace::PositiveY].map(|face| views[face.index()]);
        mean_difference(&sights, |sight| sight.alpha(&a), |sight| sight.alpha(&b))
    };
    let (spheres, disks) = (difference(&lamp_views()), difference(&as_disks(&lamp_views())));
    println!("spheres {spheres}, disks {disks}");
    assert!(spheres < 0.005, "{spheres}");
    assert!(disks > 0.04, "a border that shows is found: {disks}");
}

#[test]
fn soft_edges_end_where_the_sphere_does() {
    let sights = sights(|x, y| DVec3::new(1.0, x, y));
    let difference = |views: &[View]| {
        let view = views[CubeFace::PositiveX.index()];
        mean_difference(&sights, |sight| sight.alpha(&view), |sight| Some(sight.truth()))
    };
    let (spheres, disks) = (difference(&lamp_views()), difference(&as_disks(&lamp_views())));
    println!("spheres {spheres}, disks {disks}");
    assert!(spheres < 0.005, "{spheres}");
    assert!(disks > 0.03, "the wrong shape is found: {disks}");
}

#[test]
fn rims_of_edges_and_corners_meet() {
    let view = lamp_views()[0];
    for step in 0..100 {
        let [place, outward] = [0.7, 1.9].map(|factor| DVec2::from_angle(factor * f64::from(step)));
        let place = place * 0.014 * f64::from(step);
        let rim = view.rim_offset(place, outward);
        assert!((view.rim_distance(place, rim) - 1.0).abs() < 1e-12, "{place} {outward}");
        let line_distance = place.dot(outward) * view.half_side;
        assert!((rim.dot(outward) - line_distance.hypot(1.0)).abs() < 1e-12, "{place} {outward}");
        // The corner's ellipse touches the edge's rim there and lies inside of it elsewhere.
        for turn in [-0.3, 0.3] {
            let aside = DVec2::from_angle(turn).rotate(rim);
            let on_ellipse = aside / view.rim_distance(place, aside);
            assert!(on_ellipse.dot(outward) < rim.dot(outward), "{place} {outward} {turn}");
        }
        let disk = as_disks(&[view])[0];
        assert_eq!(disk.rim_offset(place, outward), outward);
        assert!((disk.rim_distance(place, 3.0 * outward) - 3.0).abs() < 1e-12);
    }
}

#[test]
fn no_edge_on_the_map_is_wider_than_the_bound() {
    let view = lamp_views()[0];
    for width in [0.001, 0.1, 0.3] {
        let bound = view.widest_ndc(width);
        for step in 0..400 {
            let outward = DVec2::from_angle(f64::from(step));
            // A line that passes the corner as far away as its soft edge reaches.
            let rim_at = |distance: f64| width * view.rim_offset(distance * outward, outward).dot(outward);
            let distance = SQRT_2 + bound;
            assert!(rim_at(distance) <= bound, "{width}: {} {bound}", rim_at(distance));
        }
        assert_eq!(as_disks(&[view])[0].widest_ndc(width), width);
    }
    assert_eq!(view.widest_ndc(1.0), 16.0 * (1.0 + SQRT_2), "where it would be everywhere");
}
