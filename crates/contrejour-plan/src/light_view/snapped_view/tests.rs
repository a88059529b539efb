use super::*;
use crate::ObjectBox;

const MAP: SnappedMap = SnappedMap {
    towards_light: DVec3::new(0.3, 1.0, -0.4),
    angular_radius: 0.005,
    map_size: 1024,
    guard_ndc: 0.1,
    caster_margin: 30.0,
};

fn sphere(center_world: DVec3) -> Sphere {
    Sphere { center_world, radius: 7.3 }
}

/// Steps from a hair to many texels, in all directions.
fn places() -> impl Iterator<Item = DVec3> {
    (0..500).map(|i| {
        let step = f64::from(i);
        let fract = |factor: f64| (factor * step).fract() - 0.5;
        let reach = 10f64.powf(step / 100.0 - 4.0);
        DVec3::new(3.0, -1.0, 8.0) + reach * DVec3::new(fract(0.819), fract(0.671), fract(0.549))
    })
}

/// Whole steps of the grid between two views, where nothing but the offset differs.
fn steps_between(a: &View, b: &View, map_size: u32) -> DVec3 {
    assert_eq!(View { light_clip_from_world: b.light_clip_from_world, ..*a }, *b, "to the bit");
    let offset = b.light_clip_from_world.w_axis - a.light_clip_from_world.w_axis;
    let columns = |view: &View| view.light_clip_from_world.to_cols_array()[..12].to_vec();
    assert_eq!(columns(a), columns(b), "to the bit");
    assert_eq!(offset.w, 0.0);
    let texels = f64::from(map_size);
    let range_texels = (a.far_depth - a.near_depth) / (2.0 * a.half_side) * texels;
    offset.truncate() * DVec3::new(0.5 * texels, 0.5 * texels, range_texels)
}

#[test]
fn views_move_by_whole_texels() {
    let first = MAP.view(&sphere(DVec3::new(3.0, -1.0, 8.0)));
    let mut moved = 0;
    for place in places() {
        let steps = steps_between(&first, &MAP.view(&sphere(place)), 1024);
        assert_eq!(steps.truncate(), steps.truncate().round(), "to the bit: {place}");
        assert!((steps.z - steps.z.round()).abs() < 1e-9, "{place}: {steps}");
        moved += u32::from(steps != DVec3::ZERO);
    }
    assert!((200..500).contains(&moved), "some steps are less than a texel: {moved}");
}

/// Sizes that are no power of two divide with a rounding, but by the same numbers each time.
#[test]
fn views_of_any_size_move_by_whole_texels() {
    for map_size in [4, 5, 500, 1000, 3001] {
        let map = SnappedMap { map_size, ..MAP };
        let first = map.view(&sphere(DVec3::ZERO));
        for place in places() {
            let steps = steps_between(&first, &map.view(&sphere(place)), map_size);
            assert!((steps - steps.round()).abs().max_element() < 1e-9, "{map_size}, {place}: {steps}");
        }
    }
}

#[test]
fn a_view_that_does_not_snap_is_found() {
    let first = MAP.view(&sphere(DVec3::ZERO));
    let mut other = first;
    other.light_clip_from_world.w_axis.x += 0.3 * 2.0 / 1024.0;
    let steps = steps_between(&first, &other, 1024);
    assert_ne!(steps.x, steps.x.round());
}

#[test]
fn spheres_are_inside_the_guard_band() {
    for map_size in [4, 64, 1024] {
        let map = SnappedMap { map_size, ..MAP };
        for place in places() {
            let view = map.view(&sphere(place));
            let clip = view.light_clip_from_world * place.extend(1.0);
            let reach_ndc = 7.3 / view.half_side;
            assert!(clip.x.abs().max(clip.y.abs()) + reach_ndc <= 0.9 + 1e-9, "{map_size}, {place}: {clip}");
            let depth = view.near_depth + clip.z * (view.far_depth - view.near_depth);
            assert!(depth - 7.3 >= -1e-9 && depth + 7.3 <= view.far_depth + 1e-9, "{map_size}, {place}: {depth}");
        }
    }
}

#[test]
fn depth_is_zero_at_the_cube_and_negative_in_front() {
    let view = MAP.view(&sphere(DVec3::ZERO));
    assert!(view.near_depth <= -30.0 && view.near_depth > -30.0 - view.texel_world(1024));
    let depth = |point: DVec3| {
        let clip = view.light_clip_from_world * point.extend(1.0);
        view.near_depth + clip.z * (view.far_depth - view.near_depth)
    };
    let middle = depth(DVec3::ZERO);
    assert!((middle - view.half_side).abs() <= 0.5 * view.texel_world(1024) + 1e-9);
    let in_front = depth(-view.axis_world * (view.half_side + 20.0));
    assert!((in_front - (middle - view.half_side - 20.0)).abs() < 1e-9);
    let ndc_z = |depth: f64| view.q_of_depth(depth) * view.ndc_scale() + view.ndc_offset();
    assert!(ndc_z(view.near_depth).abs() < 1e-12 && (ndc_z(view.far_depth) - 1.0).abs() < 1e-12);
}

#[test]
fn casters_far_in_front_are_seen() {
    let view = MAP.view(&sphere(DVec3::ZERO));
    let sees = |along: f64| {
        let world_from_object = DMat4::from_translation(along * view.axis_world);
        view.can_see(&ObjectBox { min: [-0.5; 3], max: [0.5; 3], world_from_object }, 0.0)
    };
    assert!(sees(-20.0) && sees(-1e4), "towards the light");
    assert!(sees(0.0) && !sees(20.0), "away from it");
    let clipped = View { casters_in_front: CastersInFront::Clipped, ..view };
    let world_from_object = DMat4::from_translation(-1e4 * view.axis_world);
    assert!(!clipped.can_see(&ObjectBox { min: [-0.5; 3], max: [0.5; 3], world_from_object }, 0.0));
}
