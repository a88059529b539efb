use super::*;
use crate::{CascadeSettings, SmoothieSettings, SmoothieWidth, Technique, views};
use glam::{DQuat, DVec3};

const EYE: Eye = Eye {
    position: DVec3::new(2.0, 1.7, 3.0),
    forward: DVec3::new(0.3, -0.1, -1.0),
    fov_y: 0.9,
    aspect: 1.7,
    near: 0.1,
    far: 90.0,
};

fn sun(change: impl FnOnce(&mut CascadeSettings)) -> Light {
    let mut cascades = CascadeSettings::DEFAULT;
    change(&mut cascades);
    let towards_light = DVec3::new(1.0, 2.0, 0.5);
    Light { kind: LightKind::Cascaded { towards_light, angular_radius: 0.00465, cascades }, color: [1.0; 3] }
}

fn cascades_of(light: &Light, eye: &Eye) -> Vec<Cascade> {
    cascade_views(light, eye, &ShadowSettings::default()).expect("a good sun and eye").cascades
}

/// Around what each cascade is looked up for.
fn spheres(cascades: &[Cascade]) -> Vec<Sphere> {
    let seen_from = core::iter::once(EYE.near).chain(cascades.iter().map(|cascade| cascade.blend_depth));
    let slices = seen_from.zip(cascades.iter().map(|cascade| cascade.end_depth));
    slices.map(|(begin, end)| Sphere::around_slice(&EYE, [begin, end])).collect()
}

/// Points in the eye's view at a depth: on its rim and in its middle.
fn points_at(eye: &Eye, depth: f64) -> [DVec3; 5] {
    let axis = eye.axis_world();
    let right = axis.cross(DVec3::Y).normalize();
    let y = depth * (0.5 * eye.fov_y).tan();
    let at = |u: f64, v: f64| eye.position + depth * axis + u * eye.aspect * y * right + v * y * right.cross(axis);
    [at(0.0, 0.0), at(1.0, 1.0), at(1.0, -1.0), at(-1.0, 1.0), at(-1.0, -1.0)]
}

#[test]
fn slices_follow_each_other() {
    for count in 1..=CascadeSettings::MAX_COUNT {
        let cascades = cascades_of(&sun(|settings| settings.count = count), &EYE);
        assert_eq!(cascades.len(), count as usize);
        assert_eq!((cascades[0].begin_depth, cascades[count as usize - 1].end_depth), (EYE.near, EYE.far));
        assert!(cascades.windows(2).all(|pair| pair[0].end_depth == pair[1].begin_depth));
        assert!(cascades.windows(2).all(|pair| pair[0].view.half_side < pair[1].view.half_side));
        for cascade in &cascades {
            let blended = (cascade.end_depth - cascade.blend_depth) / (cascade.end_depth - cascade.begin_depth);
            assert!((blended - 0.1).abs() < 1e-9);
        }
    }
}

#[test]
fn receivers_are_in_their_maps() {
    let cascades = cascade_views(&sun(|_| ()), &EYE, &ShadowSettings::default()).expect("a good sun and eye");
    let spheres = spheres(&cascades.cascades);
    for step in 0..=1000 {
        let depth = EYE.near + (EYE.far - EYE.near) * (f64::from(step) / 1000.0).powi(2);
        let share = cascades.at(depth).expect("in view");
        let mut looked_up = vec![share.cascade];
        if share.next_share > 0.0 {
            looked_up.push(share.cascade + 1);
        }
        for (cascade, sphere) in looked_up.into_iter().filter_map(|i| cascades.cascades.get(i).zip(spheres.get(i))) {
            // The grid moves the middle by half a texel.
            let most = sphere.radius / cascade.view.half_side + 1.0 / 1024.0 + 1e-9;
            for point in points_at(&EYE, depth) {
                assert!((EYE.depth_of(point) - depth).abs() < 1e-9);
                let clip = cascade.view.light_clip_from_world * point.extend(1.0);
                assert!(clip.x.abs() <= most && clip.y.abs() <= most, "{depth}: {clip}");
                let view = &cascade.view;
                let light_depth = view.near_depth + clip.z * (view.far_depth - view.near_depth);
                assert!((-1e-9..=view.far_depth).contains(&light_depth), "{depth}: {light_depth}");
            }
        }
    }
}

#[test]
fn blends_are_continuous() {
    let cascades = cascade_views(&sun(|_| ()), &EYE, &ShadowSettings::default()).expect("a good sun and eye");
    // Share of each cascade, and of light beyond the last.
    let weights = |depth: f64| {
        let mut weights = [0.0; 5];
        match cascades.at(depth) {
            Some(CascadeShare { cascade, next_share }) => {
                weights[cascade] += 1.0 - next_share;
                weights[cascade + 1] += next_share;
            }
            None => weights[4] = 1.0,
        }
        weights
    };
    let steps = 200_000;
    let depth = |step: u32| 1.01 * EYE.far * f64::from(step) / f64::from(steps);
    for step in 1..=steps {
        let (before, after) = (weights(depth(step - 1)), weights(depth(step)));
        let largest = before.iter().zip(&after).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(largest < 0.01, "at {}: {before:?} {after:?}", depth(step));
    }
    assert_eq!(weights(0.0), [1.0, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(cascades.at(1.001 * EYE.far), None);
    assert_eq!(cascades.at(f64::NAN), None);

    let hard = cascades_of(&sun(|settings| settings.border_share = 0.0), &EYE);
    let hard = Cascades { cascades: hard, ..cascades };
    let end = hard.cascades[0].end_depth;
    assert_eq!(hard.at(end), Some(CascadeShare { cascade: 0, next_share: 0.0 }));
    assert_eq!(hard.at(end * 1.0001), Some(CascadeShare { cascade: 1, next_share: 0.0 }));
}

#[test]
fn receivers_get_their_depth_and_the_borders() {
    let cascades = cascade_views(&sun(|_| ()), &EYE, &ShadowSettings::default()).expect("a good sun and eye");
    let records = cascades.receiver_views(&ShadowSettings::default());
    let point = EYE.position + DVec3::new(1.0, -2.0, -7.0);
    for (record, cascade) in records.iter().zip(&cascades.cascades) {
        let depth = glam::Vec4::from(record.eye_depth_from_world).dot(point.as_vec3().extend(1.0));
        assert!((f64::from(depth) - EYE.depth_of(point)).abs() < 1e-5);
        assert_eq!([record.blend_depth, record.end_depth], [cascade.blend_depth as f32, cascade.end_depth as f32]);
    }
}

/// What is not an offset by whole texels is the same to the bit, however the eye moves and turns.
#[test]
fn maps_are_stable_when_the_eye_moves_and_turns() {
    let first = cascades_of(&sun(|_| ()), &EYE);
    let mut moved = 0;
    for i in 0..300 {
        let step = f64::from(i);
        let reach = 10f64.powf(step / 75.0 - 3.0);
        let offset = reach * DVec3::new((0.7 * step).sin(), (0.3 * step).cos(), (1.1 * step).sin());
        let turn = DQuat::from_rotation_y(0.01 * step) * DQuat::from_rotation_x(0.003 * step);
        let eye = Eye { position: EYE.position + offset, forward: turn * EYE.forward, ..EYE };
        for (before, after) in first.iter().zip(cascades_of(&sun(|_| ()), &eye)) {
            let (a, b) = (before.view.light_clip_from_world, after.view.light_clip_from_world);
            assert_eq!(a.to_cols_array()[..12], b.to_cols_array()[..12], "to the bit");
            let texels = 512.0 * (b.w_axis - a.w_axis).truncate().truncate();
            assert_eq!(texels, texels.round(), "to the bit");
            moved += u32::from(texels != glam::DVec2::ZERO);
            let matrix_aside = View { light_clip_from_world: a, ..after.view };
            assert_eq!(matrix_aside, before.view, "size and depths stay");
        }
    }
    assert!(moved > 600, "{moved}");
}

#[test]
fn guards_hold_the_widest_smoothie_of_the_margin() {
    let smoothies = SmoothieSettings { width: SmoothieWidth::FromLightSize, ..SmoothieSettings::DEFAULT };
    let settings = ShadowSettings { technique: Technique::Smoothies(smoothies), ..ShadowSettings::default() };
    let light = sun(|settings| settings.caster_margin = 0.2);
    let cascades = cascade_views(&light, &EYE, &settings).expect("a good sun and eye").cascades;
    for (cascade, sphere) in cascades.iter().zip(spheres(&cascades)) {
        let guard = 1.0 - sphere.radius / cascade.view.half_side;
        let width = cascade.view.light_size * (cascade.view.q_max() - cascade.view.near_depth);
        assert!(guard > width && guard < width + 0.02 || guard > 0.5, "{guard} {width}");
        assert_eq!(cascade.view.widest_edge_ndc(&settings), 2.0, "a caster may be anywhere in front");
    }
}

#[test]
fn what_is_out_of_range_has_its_error() {
    let settings = ShadowSettings::default();
    let kind =
        LightKind::Spot { position: DVec3::ZERO, target: DVec3::X, cone_angle: 1.0, radius: 0.0, near: 0.1, far: 1.0 };
    let spot = Light { kind, color: [1.0; 3] };
    assert_eq!(cascade_views(&spot, &EYE, &settings), Err(CascadeError::NotCascaded));
    assert_eq!(views(&sun(|_| ())), Err(LightError::NeedsEye));
    let many = sun(|settings| settings.count = 9);
    let error = CascadeError::Light(LightError::CascadeCount { count: 9 });
    assert_eq!(cascade_views(&many, &EYE, &settings), Err(error));
    let blind = Eye { far: 0.05, ..EYE };
    assert!(matches!(cascade_views(&sun(|_| ()), &blind, &settings), Err(CascadeError::Eye(_))));
    let tiny = ShadowSettings { map_size: 3, ..settings };
    assert_eq!(cascade_views(&sun(|_| ()), &EYE, &tiny), Err(CascadeError::MapSize { map_size: 3 }));
    let none = ShadowSettings { map_size: 0, ..settings };
    assert_eq!(cascade_views(&sun(|_| ()), &EYE, &none), Err(CascadeError::Settings(SettingsError::NoTexels)));
}
