//! Quantiles by nearest rank, which are always values that were measured.

/// The least value that `percent` of all values do not exceed; none where there is no value. Range of `percent`: 1 to
/// 100.
pub(super) fn percentile(values: &mut [f64], percent: usize) -> Option<f64> {
    let rank = (values.len() * percent).div_ceil(100);
    let index = rank.checked_sub(1)?;
    Some(*values.select_nth_unstable_by(index, f64::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use super::percentile;

    #[test]
    fn percentiles_are_nearest_ranks() {
        let of_hundred = |percent| percentile(&mut (1..=100).rev().map(f64::from).collect::<Vec<_>>(), percent);
        assert_eq!([1, 50, 99, 100].map(of_hundred), [1.0, 50.0, 99.0, 100.0].map(Some));
        // Of five values, 10 % is half a value: the first. 90 % is four and a half: the fifth.
        let of_five = |percent| percentile(&mut [3.0, 1.0, 2.0, 5.0, 4.0], percent);
        assert_eq!([10, 20, 21, 50, 90].map(of_five), [1.0, 1.0, 2.0, 3.0, 5.0].map(Some));
        assert_eq!(percentile(&mut [], 50), None);
    }
}
