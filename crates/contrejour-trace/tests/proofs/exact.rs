//! How much of a light is hidden, exactly or by quadrature.

use std::f64::consts::{PI, TAU};

/// The part of a disk of radius 1 on the lower side of a line at the signed distance `d` from its centre.
pub fn disk_below(d: f64) -> f64 {
    let d = d.clamp(-1.0, 1.0);
    ((-d).acos() + d * (1.0 - d * d).sqrt()) / PI
}

/// The part of the square -1..1 where `along_u * u + along_v * v < d`.
pub fn square_below(d: f64, along_u: f64, along_v: f64) -> f64 {
    // The area under a line is made of four triangles with signs, one for each corner that it has passed.
    let (u, v) = (along_u.abs(), along_v.abs());
    let corners = [(d + u + v, 1.0), (d + u - v, -1.0), (d - u + v, -1.0), (d - u - v, 1.0)];
    corners.iter().map(|&(past, sign)| sign * past.max(0.0).powi(2)).sum::<f64>() / (8.0 * u * v)
}

/// The part of a cone of directions of half angle `radius` on the lower side of a plane through its tip, whose angle
/// to the axis is `d`.
pub fn cone_below(d: f64, radius: f64) -> f64 {
    let d_inside = d.clamp(-radius, radius).abs();
    // Beyond the plane, the ring of directions at the angle t from the axis spans 2 acos(tan d / tan t). The square of
    // s makes the integrand smooth where t leaves d.
    let ring = |s: f64| {
        let t = d_inside + s * s;
        2.0 * (d_inside.tan() / t.tan()).min(1.0).acos() * t.sin() * 2.0 * s
    };
    let beyond = simpson(ring, 0.0, (radius - d_inside).sqrt(), 2000) / (TAU * (1.0 - radius.cos()));
    if d >= 0.0 { 1.0 - beyond } else { beyond }
}

/// The part of a disk of radius 1 that lies in another, of radius `radius` at the distance `d`.
pub fn disk_in_disk(d: f64, radius: f64) -> f64 {
    if d >= 1.0 + radius {
        return 0.0;
    }
    if d <= (1.0 - radius).abs() {
        return radius.min(1.0).powi(2);
    }
    let own = ((d * d + 1.0 - radius * radius) / (2.0 * d)).acos();
    let other = ((d * d + radius * radius - 1.0) / (2.0 * d * radius)).acos();
    // Two sectors less the kite between the centres and where the circles meet.
    (own + radius * radius * other - d * own.sin()) / PI
}

/// The part of a disk of radius 1 around the origin that lies in the rectangle from `low` to `high`, by quadrature
/// with `panels` panels between kinks.
pub fn disk_in_rectangle(low: [f64; 2], high: [f64; 2], panels: u32) -> f64 {
    let [left, right] = [low[0], high[0]].map(|x| x.clamp(-1.0, 1.0).asin());
    // With x = sin(angle) the integrand has no root at the rim. It has kinks where the circle meets the sides.
    let mut kinks = vec![left, right];
    for side in [low[1], high[1]] {
        if side.abs() < 1.0 {
            kinks.extend([side.acos() - PI / 2.0, PI / 2.0 - side.acos()].map(|a| a.clamp(left, right)));
            let x = (1.0 - side * side).sqrt().asin();
            kinks.extend([x, -x].map(|angle| angle.clamp(left, right)));
        }
    }
    kinks.sort_by(f64::total_cmp);
    let chord = |angle: f64| {
        let half = angle.cos();
        (high[1].min(half) - low[1].max(-half)).max(0.0) * angle.cos()
    };
    kinks.windows(2).map(|pair| simpson(chord, pair[0], pair[1], panels)).sum::<f64>() / PI
}

/// Simpson's rule over `2 * panels` steps.
fn simpson(f: impl Fn(f64) -> f64, from: f64, to: f64, panels: u32) -> f64 {
    let step = (to - from) / f64::from(2 * panels);
    let weight = |i: u32| match i {
        0 => 1.0,
        _ if i == 2 * panels => 1.0,
        _ if i % 2 == 1 => 4.0,
        _ => 2.0,
    };
    (0..=2 * panels).map(|i| weight(i) * f(from + f64::from(i) * step)).sum::<f64>() * step / 3.0
}

#[test]
fn the_formulas_agree_with_each_other() {
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-9, "{a} {b}");
    for d in [-0.95, -0.7, -0.2, 0.0, 0.4, 0.95] {
        close(disk_in_rectangle([-2.0, -2.0], [d, 2.0], 500), disk_below(d));
        close(disk_in_rectangle([-2.0, -2.0], [2.0, d], 500), disk_below(d));
        let (low, high) = ([-0.3, d - 0.2], [0.8, d + 0.5]);
        close(disk_in_rectangle(low, high, 250), disk_in_rectangle(low, high, 500));
        // A small cone is flat.
        assert!((cone_below(d * 1e-4, 1e-4) - disk_below(d)).abs() < 1e-7);
        // A line that meets two opposite sides at d - 0.01 and d + 0.01.
        close(square_below(d * 0.9, 0.9, 0.009), (1.0 + d) / 2.0);
    }
    // A line that cuts a corner.
    close(square_below(-1.0, 1.0, 1.0), 1.0 / 8.0);
    // A wide disk has a straight rim.
    assert!((disk_in_disk(1e3 - 0.3, 1e3) - disk_below(0.3)).abs() < 1e-3);
    close(disk_in_disk(0.2, 0.3), 0.09);
    close(disk_in_disk(1.0, 1.0), (2.0 * PI / 3.0 - 3.0_f64.sqrt() / 2.0) / PI);
    close(cone_below(0.0, 1.0), 0.5);
    close(cone_below(-0.3, 0.8), 1.0 - cone_below(0.3, 0.8));
    // A half sphere between its rim and a plane at 60 degrees to it is a third of it, like a slice of an orange.
    assert!((cone_below(-PI / 6.0, PI / 2.0 - 1e-9) - 1.0 / 3.0).abs() < 1e-5);
}
