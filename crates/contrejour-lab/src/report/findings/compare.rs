//! When one contestant is better than another, and how that is written.

use super::super::number::significant;
use super::super::{BASELINE_TECHNIQUE, Contestant, Group};
use super::OURS;

impl Contestant {
    pub(super) fn is_ours(&self) -> bool {
        self.technique == OURS
    }

    /// Whether it is neither ours nor the plain shadow map.
    pub(super) fn is_peer(&self) -> bool {
        !self.is_ours() && self.technique != BASELINE_TECHNIQUE
    }

    pub(super) fn rmse(&self) -> f64 {
        self.errors.receivers.rmse
    }

    /// Whether its slow frames are faster than the other's fast ones.
    pub(super) fn is_faster_than(&self, other: &Self) -> bool {
        self.cost.whole().high_ms < other.cost.whole().low_ms
    }
}

impl Group {
    /// Whether the first contestant's RMSE is less by more than the truth's noise moves an RMSE: the
    /// pixels' errors are independent, so their mean is finer than one pixel by the root of their number.
    pub(super) fn is_more_exact(&self, contestant: &Contestant, than: &Contestant) -> bool {
        let receivers = contestant.errors.receivers.pixels as f64;
        than.rmse() - contestant.rmse() > self.truth.standard_error_rms / receivers.sqrt()
    }

    /// Whether the first contestant is both more exact and faster.
    pub(super) fn beats(&self, contestant: &Contestant, other: &Contestant) -> bool {
        self.is_more_exact(contestant, other) && contestant.is_faster_than(other)
    }

    /// The standing contestant of least RMSE among some.
    pub(super) fn most_exact(&self, among: impl Fn(&Contestant) -> bool) -> Option<&Contestant> {
        self.standing().filter(|contestant| among(contestant)).min_by(|a, b| a.rmse().total_cmp(&b.rmse()))
    }
}

/// An error as the text gives it.
pub(super) fn error(value: f64) -> String {
    significant(value, 3)
}

/// Families with their RMSE: `a (0.140), b (0.0160) and c (0.110)`.
pub(super) fn with_errors(contestants: &[&Contestant]) -> String {
    listed(contestants.iter().map(|contestant| format!("{} ({})", contestant.family, error(contestant.rmse()))))
}

/// `a, b and c`.
pub(super) fn listed(items: impl IntoIterator<Item = impl Into<String>>) -> String {
    let mut items: Vec<String> = items.into_iter().map(Into::into).collect();
    match items.pop() {
        Some(last) if items.is_empty() => last,
        Some(last) => format!("{} and {last}", items.join(", ")),
        None => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_end_with_and() {
        let of = |items: &[&str]| listed(items.iter().copied());
        assert_eq!([of(&[]), of(&["a"]), of(&["a", "b"]), of(&["a", "b", "c"])], ["", "a", "a and b", "a, b and c"]);
    }
}
