use super::*;
use crate::{Light, LightKind, LightOutline, ShadowSettings, ViewCounts, views, views_with_guard};

const POSITION: DVec3 = DVec3::new(3.0, -2.0, 5.0);

fn lamp() -> Light {
    let kind = LightKind::Point { position: POSITION, radius: 0.2, near: 0.5, far: 30.0 };
    Light { kind, color: [1.0; 3] }
}

fn lamp_views(guard_ndc: f64) -> Vec<View> {
    views_with_guard(&lamp(), guard_ndc).expect("a good lamp")
}

/// Directions all over the sphere (Roberts' R2 sequence), and those in which borders and corners of faces lie.
fn directions() -> impl Iterator<Item = DVec3> {
    let even = (0..5000).map(|i| {
        let step = f64::from(i);
        let (turn, height) = ((0.754_877_666_246_693 * step).fract(), (0.569_840_290_998_053 * step).fract());
        let y = 2.0 * height - 1.0;
        let (sine, cosine) = (core::f64::consts::TAU * turn).sin_cos();
        let across = (1.0 - y * y).sqrt();
        DVec3::new(across * cosine, y, across * sine)
    });
    let steps = [-1.0, -0.3, 0.0, 0.7, 1.0];
    let borders = steps
        .into_iter()
        .flat_map(move |x| steps.into_iter().flat_map(move |y| steps.into_iter().map(move |z| DVec3::new(x, y, z))));
    even.chain(borders.filter(|direction| *direction != DVec3::ZERO))
}

fn ndc(view: &View, direction: DVec3) -> Option<DVec3> {
    let clip = view.light_clip_from_world * (POSITION + 3.0 * direction).extend(1.0);
    (clip.w > 0.0).then(|| clip.truncate() / clip.w)
}

#[test]
fn six_views_look_along_the_axes() {
    let views = views(&lamp()).expect("a good lamp");
    assert_eq!(views.len(), 6);
    for (face, view) in CubeFace::ALL.into_iter().zip(&views) {
        assert_eq!(view.axis_world, face.axis());
        assert_eq!(view.light_world, POSITION.extend(1.0));
        assert_eq!((view.near_depth, view.far_depth, view.half_side, view.light_size), (0.5, 30.0, 1.0, 0.2));
        for depth in [0.5, 1.0, 7.0, 30.0] {
            let clip = view.light_clip_from_world * (POSITION + face.axis() * depth).extend(1.0);
            assert!((clip.w - depth).abs() < 1e-9 && clip.x.abs() < 1e-9 && clip.y.abs() < 1e-9, "{clip}");
            let ndc_z = view.q_of_depth(depth) * view.ndc_scale() + view.ndc_offset();
            assert!((clip.z / clip.w - ndc_z).abs() < 1e-9, "{clip} {ndc_z}");
        }
        let x = view.light_clip_from_world.row(0).truncate();
        let y = view.light_clip_from_world.row(1).truncate();
        assert!(x.cross(y).dot(-view.axis_world) > 0.0, "right-handed");
    }
}

#[test]
fn faces_tile_the_sphere() {
    const ROUNDING: f64 = 1e-12;
    for guard in [0.0, 0.05, 0.5] {
        let views = lamp_views(guard);
        let square = 1.0 - guard;
        for direction in directions() {
            let face = CubeFace::of(direction);
            let place = ndc(&views[face.index()], direction).expect("a face sees its directions");
            assert!(place.x.abs().max(place.y.abs()) <= square + ROUNDING, "{direction}: {place}");
            for (other, view) in CubeFace::ALL.into_iter().zip(&views).filter(|(other, _)| *other != face) {
                let is_well_inside =
                    ndc(view, direction).is_some_and(|ndc| ndc.x.abs().max(ndc.y.abs()) < square - ROUNDING);
                assert!(!is_well_inside, "{direction} goes through {face:?} and {other:?}");
            }
        }
    }
}

#[test]
fn neighbours_agree_about_depth_at_their_border() {
    let views = lamp_views(0.1);
    for (a, b) in [(CubeFace::PositiveX, CubeFace::PositiveY), (CubeFace::NegativeZ, CubeFace::NegativeX)] {
        let border = 4.0 * (a.axis() + b.axis()) + 0.7 * a.axis().cross(b.axis());
        let clips = [a, b].map(|face| views[face.index()].light_clip_from_world * (POSITION + border).extend(1.0));
        assert!((clips[0].w - clips[1].w).abs() < 1e-12 && (clips[0].z - clips[1].z).abs() < 1e-12, "{clips:?}");
    }
}

/// What a face shows in its band, its neighbour shows in its square: it must be in the depth range of both.
#[test]
fn what_casts_in_a_square_casts_in_the_bands_of_neighbours() {
    let guard = 0.2;
    let views = lamp_views(guard);
    let mut in_bands = 0;
    for direction in directions() {
        let nearest = 0.5 / direction.abs().max_element();
        let nearest_world = (POSITION + nearest * direction).extend(1.0);
        for view in &views {
            let clip = view.light_clip_from_world * nearest_world;
            if clip.w > 0.0 && clip.x.abs().max(clip.y.abs()) <= clip.w {
                assert!(clip.z >= -1e-12, "{direction}: {clip}");
                in_bands += 1;
            }
        }
    }
    assert!(in_bands > 6000, "bands were looked at: {in_bands}");
}

#[test]
fn a_face_is_a_spot_of_ninety_degrees_that_sees_a_sphere() {
    let target = POSITION + DVec3::NEG_Z;
    let cone_angle = core::f64::consts::FRAC_PI_2;
    let kind = LightKind::Spot { position: POSITION, target, cone_angle, radius: 0.2, near: 0.5, far: 30.0 };
    let spot = views(&Light { kind, ..lamp() }).expect("a good spot")[0];
    let face = lamp_views(0.0)[CubeFace::NegativeZ.index()];
    let settings = ShadowSettings::default();
    assert_eq!(face.receiver_view(&settings), spot.receiver_view(&settings));
    let counts = ViewCounts::default();
    // Their matrices differ by the last bit of a 64-bit float, which no receiver sees.
    let light_view =
        |view: View| View { light_clip_from_world: DMat4::IDENTITY, ..view }.light_view(&settings, &counts);
    assert_eq!(light_view(View { light_outline: LightOutline::Disk, ..face }), light_view(spot));
    assert_eq!([face, spot].map(|view| light_view(view).sphere_half_side), [1.0, 0.0]);
}

#[test]
fn a_guard_leaves_something_of_the_map() {
    for guard_ndc in [-0.1, 1.0, f64::INFINITY] {
        assert_eq!(views_with_guard(&lamp(), guard_ndc), Err(LightError::Guard { guard_ndc }));
    }
    assert!(matches!(views_with_guard(&lamp(), f64::NAN), Err(LightError::Guard { .. })));
    let kind = LightKind::Point { position: POSITION, radius: 0.0, near: 1.2e-38, far: 1.0 };
    assert!(views_with_guard(&Light { kind, ..lamp() }, 0.5).is_err(), "near would be no normal number");
}
