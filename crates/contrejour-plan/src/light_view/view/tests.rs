use super::*;

fn spot(position: DVec3, target: DVec3) -> View {
    let kind = LightKind::Spot { position, target, cone_angle: 1.2, radius: 0.3, near: 0.5, far: 30.0 };
    views(&Light { kind, color: [1.0; 3] }).expect("a good spot")[0]
}

fn sun(towards_light: DVec3) -> View {
    let center = DVec3::new(1.0, 2.0, 3.0);
    let kind =
        LightKind::Directional { towards_light, center, half_extent: 4.0, half_depth: 5.0, angular_radius: 0.02 };
    views(&Light { kind, color: [1.0; 3] }).expect("a good sun")[0]
}

fn directions() -> impl Iterator<Item = DVec3> {
    let near_y = DVec3::new(1e-9, 1.0, 0.0);
    [DVec3::X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::new(1.0, -2.0, 0.5), near_y, DVec3::splat(1e-200)].into_iter()
}

#[test]
fn perspective_w_is_the_linear_depth() {
    let position = DVec3::new(3.0, 4.0, -2.0);
    for axis in directions().map(unit) {
        let view = spot(position, position + axis);
        for depth in [0.5, 1.0, 7.0, 30.0] {
            let clip = view.light_clip_from_world * (position + axis * depth).extend(1.0);
            assert!((clip.w - depth).abs() < 1e-9, "{clip}");
            assert!(clip.x.abs() < 1e-9 && clip.y.abs() < 1e-9, "the axis hits the middle: {clip}");
            let ndc_z = view.q_of_depth(depth) * view.ndc_scale() + view.ndc_offset();
            assert!((clip.z / clip.w - ndc_z).abs() < 1e-9, "{clip} {ndc_z}");
        }
    }
}

#[test]
fn orthographic_z_is_the_share_of_the_depth() {
    for towards_light in directions() {
        let view = sun(towards_light);
        let nearest = DVec3::new(1.0, 2.0, 3.0) - view.axis_world * 5.0;
        for depth in [0.0, 1.0, 5.0, 10.0] {
            let clip = view.light_clip_from_world * (nearest + view.axis_world * depth).extend(1.0);
            assert!((clip.w - 1.0).abs() < 1e-12);
            assert!(clip.x.abs() < 1e-9 && clip.y.abs() < 1e-9);
            assert!((clip.z - depth / 10.0).abs() < 1e-9, "{clip}");
            let ndc_z = view.q_of_depth(depth) * view.ndc_scale() + view.ndc_offset();
            assert!((clip.z - ndc_z).abs() < 1e-9);
        }
    }
}

#[test]
fn near_is_zero_and_far_is_one() {
    for view in [spot(DVec3::ZERO, DVec3::X), sun(DVec3::ONE)] {
        let ndc_z = |depth| view.q_of_depth(depth) * view.ndc_scale() + view.ndc_offset();
        assert!(ndc_z(view.near_depth).abs() < 1e-12);
        assert!((ndc_z(view.far_depth) - 1.0).abs() < 1e-12);
        assert!(view.q_max() >= view.q_of_depth(view.far_depth));
    }
}

#[test]
fn q_gives_ndc_z_over_a_sweep_of_depths() {
    for view in [spot(DVec3::ONE, DVec3::new(-2.0, 0.0, 9.0)), sun(DVec3::new(0.3, 1.0, 0.2))] {
        let eye = match view.projection {
            Projection::Perspective => view.light_world.truncate(),
            Projection::Orthographic => DVec3::new(1.0, 2.0, 3.0) - view.axis_world * 5.0,
        };
        for step in 0..=1000 {
            let depth = view.near_depth + (view.far_depth - view.near_depth) * f64::from(step) / 1000.0;
            let clip = view.light_clip_from_world * (eye + view.axis_world * depth).extend(1.0);
            let ndc_z = view.q_of_depth(depth) * view.ndc_scale() + view.ndc_offset();
            assert!((clip.z / clip.w - ndc_z).abs() < 1e-9, "depth {depth}");
        }
    }
}

#[test]
fn space_stays_right_handed() {
    for direction in directions() {
        for view in [spot(DVec3::ZERO, unit(direction)), sun(direction)] {
            // x and y of the image plane and the axis towards the light are a right-handed frame.
            let x = view.light_clip_from_world.row(0).truncate();
            let y = view.light_clip_from_world.row(1).truncate();
            assert!(x.cross(y).dot(-view.axis_world) > 0.0);
            assert!((x.length() - y.length()).abs() < 1e-9, "square");
        }
    }
}

#[test]
fn up_is_up_on_the_image_plane() {
    let view = spot(DVec3::ZERO, DVec3::new(0.0, 0.0, -5.0));
    let clip = view.light_clip_from_world * DVec4::new(0.0, 1.0, -5.0, 1.0);
    assert!(clip.y > 0.0);
    let right = view.light_clip_from_world * DVec4::new(1.0, 0.0, -5.0, 1.0);
    assert!(right.x > 0.0);
}

#[test]
fn the_cone_touches_the_sides_of_the_map() {
    let view = spot(DVec3::ZERO, DVec3::new(0.0, 0.0, -1.0));
    let clip = view.light_clip_from_world * DVec4::new(0.6_f64.tan() * 3.0, 0.0, -3.0, 1.0);
    assert!((clip.x / clip.w - 1.0).abs() < 1e-12);
    assert!((view.texel_world(1024) * 1024.0 - 2.0 * 0.6_f64.tan()).abs() < 1e-12);
}

/// The penumbra of an edge that is parallel to the image plane, from similar triangles.
#[test]
fn light_size_gives_the_half_penumbra() {
    let (blocker, receiver) = (4.0, 9.0);

    let view = spot(DVec3::ZERO, DVec3::X);
    // From the disk's far rim over the edge to the receiver, minus the same from the middle of the disk.
    let half_penumbra_world = 0.3 * (receiver - blocker) / blocker;
    let half_penumbra_ndc = half_penumbra_world / (receiver * 0.6_f64.tan());
    let ours = view.light_size * (view.q_of_depth(receiver) - view.q_of_depth(blocker));
    assert!((ours - half_penumbra_ndc).abs() < 1e-12);

    let view = sun(DVec3::ONE);
    let half_penumbra_ndc = 0.02_f64.tan() * (receiver - blocker) / 4.0;
    let ours = view.light_size * (view.q_of_depth(receiver) - view.q_of_depth(blocker));
    assert!((ours - half_penumbra_ndc).abs() < 1e-12);
}

#[test]
fn a_bad_light_has_no_views() {
    let kind =
        LightKind::Spot { position: DVec3::ZERO, target: DVec3::X, cone_angle: 1.0, radius: 0.0, near: 2.0, far: 1.0 };
    let error = views(&Light { kind, color: [1.0; 3] });
    assert_eq!(error, Err(LightError::DepthRange { near: 2.0, far: 1.0 }));
}
