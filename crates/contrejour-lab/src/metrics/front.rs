//! Who can't be beaten.

/// Which points are on the Pareto front where less is better in both coordinates: no other point is as good in both and
/// better in one.
pub fn pareto_front(points: &[[f64; 2]]) -> Vec<bool> {
    let beats = |a: &[f64; 2], b: &[f64; 2]| a[0] <= b[0] && a[1] <= b[1] && a != b;
    points.iter().map(|point| !points.iter().any(|other| beats(other, point))).collect()
}

#[cfg(test)]
mod tests {
    use super::pareto_front;

    #[test]
    fn the_front_goes_down_as_it_goes_right() {
        let points = [[1.0, 9.0], [2.0, 5.0], [3.0, 5.0], [3.0, 2.0], [4.0, 6.0], [2.0, 5.0]];
        assert_eq!(pareto_front(&points), [true, true, false, true, false, true]);
        // Better in nothing: off. Better in one thing by a hair: on.
        assert_eq!(pareto_front(&[[1.0, 1.0], [2.0, 1.0]]), [true, false]);
        assert_eq!(pareto_front(&[[1.0, 1.0], [2.0, 0.999]]), [true, true]);
    }
}
