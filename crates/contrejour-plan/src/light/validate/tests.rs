use super::*;

fn spot(change: impl FnOnce(&mut [f64; 4])) -> Result<(), LightError> {
    let mut numbers = [1.0, 0.1, 0.5, 20.0];
    change(&mut numbers);
    let [cone_angle, radius, near, far] = numbers;
    let (position, target) = (DVec3::new(0.0, 5.0, 0.0), DVec3::ZERO);
    Light { kind: LightKind::Spot { position, target, cone_angle, radius, near, far }, color: [1.0; 3] }.validate()
}

fn sun(towards_light: DVec3, change: impl FnOnce(&mut [f64; 3])) -> Result<(), LightError> {
    let mut numbers = [4.0, 6.0, 0.01];
    change(&mut numbers);
    let [half_extent, half_depth, angular_radius] = numbers;
    let center = DVec3::ZERO;
    let kind = LightKind::Directional { towards_light, center, half_extent, half_depth, angular_radius };
    Light { kind, color: [1.0; 3] }.validate()
}

fn point(change: impl FnOnce(&mut [f64; 3])) -> Result<(), LightError> {
    let mut numbers = [0.1, 0.5, 20.0];
    change(&mut numbers);
    let [radius, near, far] = numbers;
    Light { kind: LightKind::Point { position: DVec3::ONE, radius, near, far }, color: [1.0; 3] }.validate()
}

#[test]
fn good_lights_pass() {
    assert_eq!(spot(|_| ()), Ok(()));
    assert_eq!(spot(|n| n[1] = 0.0), Ok(()));
    assert_eq!(sun(DVec3::Y, |_| ()), Ok(()));
    assert_eq!(sun(DVec3::splat(1e-200), |_| ()), Ok(()), "only the direction counts");
}

#[test]
fn each_bad_field_has_its_error() {
    assert_eq!(spot(|n| n[0] = 0.0), Err(LightError::ConeAngle { radians: 0.0 }));
    assert_eq!(spot(|n| n[0] = PI), Err(LightError::ConeAngle { radians: PI }));
    assert!(matches!(spot(|n| n[0] = f64::NAN), Err(LightError::ConeAngle { .. })));
    assert_eq!(spot(|n| n[1] = -1.0), Err(LightError::Negative { field: "radius", value: -1.0 }));
    assert_eq!(spot(|n| n[2] = 0.0), Err(LightError::NotPositive { field: "near", value: 0.0 }));
    assert_eq!(spot(|n| n[2] = 1e-50), Err(LightError::NotPositive { field: "near", value: 1e-50 }));
    assert_eq!(spot(|n| n[3] = 0.5), Err(LightError::DepthRange { near: 0.5, far: 0.5 }));
    assert_eq!(spot(|n| n[3] = 0.5 + 1e-12), Err(LightError::DepthRange { near: 0.5, far: 0.5 + 1e-12 }));
    assert_eq!(spot(|n| n[3] = 8.5e37), Ok(()));
    assert_eq!(spot(|n| n[3] = 1e38), Err(LightError::TooFar { far: 1e38 }));
    assert_eq!(spot(|n| n[3] = 1e40), Err(LightError::NotFinite { field: "far", value: 1e40 }));
    assert_eq!(sun(DVec3::ZERO, |_| ()), Err(LightError::NoDirection));
    assert!(matches!(sun(DVec3::new(0.0, f64::INFINITY, 0.0), |_| ()), Err(LightError::NotFinite { .. })));
    assert_eq!(sun(DVec3::Y, |n| n[0] = 0.0), Err(LightError::NotPositive { field: "half extent", value: 0.0 }));
    assert_eq!(sun(DVec3::Y, |n| n[1] = -2.0), Err(LightError::NotPositive { field: "half depth", value: -2.0 }));
    assert_eq!(sun(DVec3::Y, |n| n[2] = FRAC_PI_2), Err(LightError::AngularRadius { radians: FRAC_PI_2 }));
}

#[test]
fn a_spot_on_its_target_has_no_axis() {
    let target = DVec3::ONE;
    let kind = LightKind::Spot { position: target, target, cone_angle: 1.0, radius: 0.0, near: 0.1, far: 1.0 };
    assert_eq!(Light { kind, color: [1.0; 3] }.validate(), Err(LightError::NoAxis { target }));
}

#[test]
fn colors_must_be_light() {
    let kind =
        LightKind::Spot { position: DVec3::ZERO, target: DVec3::X, cone_angle: 1.0, radius: 0.0, near: 0.1, far: 1.0 };
    let error = Light { kind, color: [1.0, -0.5, 1.0] }.validate();
    assert_eq!(error, Err(LightError::Negative { field: "color", value: -0.5 }));
}

#[test]
fn each_bad_field_of_a_point_light_has_its_error() {
    assert_eq!(point(|_| ()), Ok(()));
    assert_eq!(point(|n| n[0] = 0.0), Ok(()));
    assert_eq!(point(|n| n[0] = -1.0), Err(LightError::Negative { field: "radius", value: -1.0 }));
    assert_eq!(point(|n| n[1] = 0.0), Err(LightError::NotPositive { field: "near", value: 0.0 }));
    assert_eq!(point(|n| n[2] = 0.5), Err(LightError::DepthRange { near: 0.5, far: 0.5 }));
    assert_eq!(point(|n| n[2] = 1e38), Err(LightError::TooFar { far: 1e38 }));
    assert!(matches!(point(|n| n[2] = f64::NAN), Err(LightError::NotFinite { field: "far", .. })));

    let position = DVec3::new(0.0, f64::INFINITY, 0.0);
    let kind = LightKind::Point { position, radius: 0.0, near: 0.5, far: 20.0 };
    let error = Light { kind, color: [1.0; 3] }.validate();
    assert_eq!(error, Err(LightError::NotFinite { field: "position", value: f64::INFINITY }));
}

#[test]
fn each_bad_field_of_cascades_has_its_error() {
    let cascaded = |towards_light, angular_radius, cascades| {
        let kind = LightKind::Cascaded { towards_light, angular_radius, cascades };
        Light { kind, color: [1.0; 3] }.validate()
    };
    let with = |change: &dyn Fn(&mut CascadeSettings)| {
        let mut cascades = CascadeSettings::DEFAULT;
        change(&mut cascades);
        cascaded(DVec3::Y, 0.01, cascades)
    };
    assert_eq!(with(&|_| ()), Ok(()));
    assert_eq!(with(&|cascades| cascades.count = 8), Ok(()));
    for count in [0, 9] {
        assert_eq!(with(&|cascades| cascades.count = count), Err(LightError::CascadeCount { count }));
    }
    let share = |field, value, most| Err(LightError::CascadeShare { field, value, most });
    assert_eq!(with(&|cascades| cascades.logarithmic_share = 1.5), share("logarithmic share", 1.5, 1.0));
    assert_eq!(with(&|cascades| cascades.border_share = -0.1), share("border share", -0.1, 0.5));
    assert!(with(&|cascades| cascades.border_share = f64::NAN).is_err());
    assert_eq!(with(&|cascades| cascades.caster_margin = -1.0), share("caster margin", -1.0, 1e3));

    assert_eq!(cascaded(DVec3::ZERO, 0.01, CascadeSettings::DEFAULT), Err(LightError::NoDirection));
    let error = cascaded(DVec3::Y, -0.1, CascadeSettings::DEFAULT);
    assert_eq!(error, Err(LightError::AngularRadius { radians: -0.1 }));
}
