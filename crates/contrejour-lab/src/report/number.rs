//! Numbers as people read them.

/// A number with a few significant digits, without an exponent: `0.0123`, `12.3`, `12300`.
pub(crate) fn significant(value: f64, digits: i32) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let decimals = |value: f64| digits - 1 - value.abs().log10().floor() as i32;
    // Rounding may carry into one more digit: 0.0999 becomes 0.100 and not 0.1000.
    let step = 10_f64.powi(-decimals(value));
    let rounded = (value / step).round() * step;
    format!("{rounded:.places$}", places = decimals(rounded).max(0) as usize)
}

/// A number on an axis: as short as it can be, with k for thousands and M for millions, and with an exponent where many
/// zeros would stand.
pub(super) fn tick(value: f64) -> String {
    if value != 0.0 && !(1e-4..1e9).contains(&value.abs()) {
        // To a few digits, as below.
        let text = format!("{value:.5e}");
        let (share, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{exponent}", share.trim_end_matches('0').trim_end_matches('.'));
    }
    let (share, unit) = match value.abs() {
        large if large >= 1e6 => (value * 1e-6, " M"),
        large if large >= 1e4 => (value * 1e-3, " k"),
        _ => (value, ""),
    };
    // Ticks are 1, 2 or 5 times a power of ten, or small multiples of it; more digits are rounding.
    let text = significant(share, 6);
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    format!("{text}{unit}")
}

/// Bytes in the unit that suits them.
pub(super) fn bytes(bytes: u64) -> String {
    match bytes as f64 {
        large if large >= 1024.0 * 1024.0 => format!("{} MiB", significant(large / 1024.0 / 1024.0, 3)),
        large if large >= 1024.0 => format!("{} KiB", significant(large / 1024.0, 3)),
        small => format!("{small} B"),
    }
}

/// A share as per cent, which no line break parts.
pub(super) fn percent(share: f64) -> String {
    format!("{}\u{a0}%", significant(100.0 * share, 2))
}

/// A whole number with thin spaces between thousands.
pub(crate) fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (place, digit) in (0..digits.len()).rev().zip(digits.chars()) {
        text.push(digit);
        if place > 0 && place % 3 == 0 {
            text.push('\u{202f}');
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn significant_digits() {
        let three = [0.012_345, 0.0999, 0.099_96, 1.0, 12.34, 99.96, 1234.0, 0.0, -0.5].map(|x| significant(x, 3));
        assert_eq!(three, ["0.0123", "0.0999", "0.100", "1.00", "12.3", "100", "1230", "0", "-0.500"]);
    }

    #[test]
    fn ticks_are_short() {
        let ticks = [0.0, 0.02, 0.5, 1.0, 200.0, 2048.0, 10_000.0, 150_000.0, 2e6].map(tick);
        assert_eq!(ticks, ["0", "0.02", "0.5", "1", "200", "2048", "10 k", "150 k", "2 M"]);
        assert_eq!(tick(0.1 + 0.2), "0.3");
        assert_eq!([1e-30, 2e30, -5e-5, 1e9, 0.1 + 0.2e-30].map(tick), ["1e-30", "2e30", "-5e-5", "1e9", "0.1"]);
    }

    #[test]
    fn units() {
        assert_eq!([0, 1023, 1024, 5 << 20].map(bytes), ["0 B", "1023 B", "1.00 KiB", "5.00 MiB"]);
        assert_eq!(percent(0.031_4), "3.1\u{a0}%");
        assert_eq!([7, 1000, 1_234_567].map(grouped), ["7", "1\u{202f}000", "1\u{202f}234\u{202f}567"]);
    }
}
