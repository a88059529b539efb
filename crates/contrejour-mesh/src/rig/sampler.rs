//! Numbers that change over time: keys, and what is between them.

use glam::DQuat;

/// What is between two keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Interpolation {
    /// The earlier key.
    Step,
    /// A straight line; between rotations the shorter great arc.
    Linear,
    /// A cubic Hermite spline.
    CubicSpline,
}

/// Keys of some numbers each.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Sampler {
    interpolation: Interpolation,
    /// Seconds; ascending, not empty.
    times: Vec<f64>,
    /// For each key its numbers; for splines three times as many: the tangent before it, the numbers, the tangent
    /// after it.
    values: Vec<f64>,
    /// Numbers of a key.
    width: usize,
}

/// Where a time lies among the keys.
struct Place {
    /// The last key before the time, or the first.
    key: usize,
    /// The way to the next key, 0 to 1; none where there is no way to go.
    way: Option<Way>,
}

struct Way {
    share: f64,
    seconds: f64,
}

impl Sampler {
    /// Keys; `None` where there is none, a number is not finite, times do not ascend or the values are not the
    /// same number for each.
    pub fn new(interpolation: Interpolation, times: Vec<f64>, values: Vec<f64>) -> Option<Self> {
        let per_key = values.len().checked_div(times.len())?;
        let width = if interpolation == Interpolation::CubicSpline { per_key / 3 } else { per_key };
        let sampler = Self { interpolation, times, values, width };
        let is_whole = sampler.values.len() == sampler.times.len() * sampler.numbers_per_key();
        let is_finite = sampler.times.iter().chain(&sampler.values).all(|number| number.is_finite());
        (width > 0 && is_whole && is_finite && sampler.times.is_sorted()).then_some(sampler)
    }

    /// Numbers of a sample.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Time of the last key.
    pub fn end(&self) -> f64 {
        self.times.last().copied().unwrap_or_default()
    }

    /// The numbers at a time; before the first key those of the first, after the last key those of the last.
    pub fn at(&self, time: f64) -> Vec<f64> {
        let Place { key, way } = self.place(time);
        match (self.interpolation, way) {
            (Interpolation::Step, _) | (_, None) => self.numbers(key).to_vec(),
            (Interpolation::Linear, Some(Way { share, .. })) => {
                let pairs = self.numbers(key).iter().zip(self.numbers(key + 1));
                pairs.map(|(from, to)| (1.0 - share) * from + share * to).collect()
            }
            (Interpolation::CubicSpline, Some(way)) => self.on_spline(key, &way),
        }
    }

    /// A rotation at a time, of unit length.
    pub fn rotation_at(&self, time: f64) -> DQuat {
        let Place { key, way } = self.place(time);
        match (self.interpolation, way) {
            (Interpolation::Linear, Some(Way { share, .. })) => {
                slerp(rotation(self.numbers(key)), rotation(self.numbers(key + 1)), share)
            }
            _ => rotation(&self.at(time)),
        }
    }

    fn place(&self, time: f64) -> Place {
        let key = self.times.partition_point(|&key| key <= time).saturating_sub(1);
        let way = match self.times.get(key..key + 2) {
            Some(&[from, to]) if time > from => {
                let seconds = to - from;
                Some(Way { share: (time - from) / seconds, seconds })
            }
            _ => None,
        };
        Place { key, way }
    }

    /// glTF 2.0, appendix C.5.
    fn on_spline(&self, key: usize, way: &Way) -> Vec<f64> {
        let t = way.share;
        let (squared, cubed) = (t * t, t * t * t);
        let of_value = 2.0 * cubed - 3.0 * squared + 1.0;
        let of_tangent = way.seconds * (cubed - 2.0 * squared + t);
        let of_next_tangent = way.seconds * (cubed - squared);
        let tangents = self.part(key, 2).iter().zip(self.part(key + 1, 0));
        let values = self.numbers(key).iter().zip(self.numbers(key + 1));
        let number = |((value, next), (tangent, next_tangent)): ((&f64, &f64), (&f64, &f64))| {
            of_value * value + of_tangent * tangent + (1.0 - of_value) * next + of_next_tangent * next_tangent
        };
        values.zip(tangents).map(number).collect()
    }

    fn numbers(&self, key: usize) -> &[f64] {
        self.part(key, usize::from(self.interpolation == Interpolation::CubicSpline))
    }

    fn part(&self, key: usize, part: usize) -> &[f64] {
        &self.values[key * self.numbers_per_key() + part * self.width..][..self.width]
    }

    fn numbers_per_key(&self) -> usize {
        if self.interpolation == Interpolation::CubicSpline { 3 * self.width } else { self.width }
    }
}

/// A rotation of unit length from four numbers; none for numbers without a direction.
pub(crate) fn rotation(numbers: &[f64]) -> DQuat {
    let [x, y, z, w] = numbers else { return DQuat::IDENTITY };
    let rotation = DQuat::from_xyzw(*x, *y, *z, *w);
    let unit = rotation.normalize();
    if unit.is_finite() { unit } else { DQuat::IDENTITY }
}

/// Along the shorter great arc; glam's own takes the angle from an approximation.
fn slerp(from: DQuat, to: DQuat, share: f64) -> DQuat {
    let cosine = from.dot(to);
    let to = if cosine < 0.0 { -to } else { to };
    let angle = cosine.abs().min(1.0).acos();
    let sine = angle.sin();
    if sine > 1e-9 {
        return (from * (((1.0 - share) * angle).sin() / sine) + to * ((share * angle).sin() / sine)).normalize();
    }
    (from * (1.0 - share) + to * share).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_3};

    fn sampler(interpolation: Interpolation, times: &[f64], values: &[f64]) -> Sampler {
        Sampler::new(interpolation, times.to_vec(), values.to_vec()).expect("it is well formed")
    }

    #[test]
    fn steps_and_lines_hold_at_their_ends() {
        let (times, values) = ([1.0, 2.0, 4.0], [1.0, 10.0, 3.0, 30.0, 5.0, 50.0]);
        let step = sampler(Interpolation::Step, &times, &values);
        let linear = sampler(Interpolation::Linear, &times, &values);
        for (time, of_step, of_linear) in [
            (-1.0, 1.0, 1.0),
            (1.0, 1.0, 1.0),
            (1.5, 1.0, 2.0),
            (2.0, 3.0, 3.0),
            (3.0, 3.0, 4.0),
            (4.0, 5.0, 5.0),
            (9.0, 5.0, 5.0),
        ] {
            assert_eq!(step.at(time), [of_step, 10.0 * of_step], "{time}");
            assert_eq!(linear.at(time), [of_linear, 10.0 * of_linear], "{time}");
        }
        assert_eq!(linear.end(), 4.0);
    }

    #[test]
    fn one_key_holds_for_ever() {
        for interpolation in [Interpolation::Step, Interpolation::Linear] {
            assert_eq!(sampler(interpolation, &[1.0], &[7.0]).at(3.0), [7.0]);
        }
        assert_eq!(sampler(Interpolation::CubicSpline, &[1.0], &[1.0, 7.0, 2.0]).at(0.0), [7.0]);
    }

    #[test]
    fn a_spline_is_the_cubic_that_its_keys_are_of() {
        let cubic = |t: f64| t * t * t - 2.0 * t + 1.0;
        let slope = |t: f64| 3.0 * t * t - 2.0;
        let times = [0.5, 1.0, 3.0];
        let values: Vec<f64> = times.iter().flat_map(|&t| [slope(t), cubic(t), slope(t)]).collect();
        let spline = sampler(Interpolation::CubicSpline, &times, &values);
        for step in 0..=20 {
            let time = 0.5 + 2.5 * f64::from(step) / 20.0;
            assert!((spline.at(time)[0] - cubic(time)).abs() < 1e-12, "{time}");
        }
        assert_eq!(spline.at(9.0), [cubic(3.0)]);
    }

    #[test]
    fn rotations_keep_to_the_shorter_arc_and_an_even_speed() {
        let quarter = DQuat::from_rotation_y(FRAC_PI_2);
        for sign in [1.0, -1.0] {
            let to = (quarter * sign).to_array();
            let values = [DQuat::IDENTITY.to_array(), to].concat();
            let turn = sampler(Interpolation::Linear, &[0.0, 3.0], &values).rotation_at(2.0);
            assert!(turn.angle_between(DQuat::from_rotation_y(FRAC_PI_3)) < 1e-7, "{turn}");
        }
        assert_eq!(rotation(&[0.0; 4]), DQuat::IDENTITY);
    }

    #[test]
    fn keys_that_make_no_sense_are_none() {
        let new = |times: &[f64], values: &[f64]| {
            Sampler::new(Interpolation::Linear, times.to_vec(), values.to_vec()).is_some()
        };
        assert!(new(&[0.0, 1.0], &[0.0, 1.0]));
        assert!(!new(&[], &[]));
        assert!(!new(&[1.0, 0.0], &[0.0, 1.0]));
        assert!(!new(&[f64::NAN], &[0.0]));
        assert!(!new(&[0.0], &[f64::INFINITY]));
        assert!(!new(&[0.0, 1.0], &[0.0, 1.0, 2.0]));
        assert!(Sampler::new(Interpolation::CubicSpline, vec![0.0], vec![0.0; 4]).is_none());
    }
}
