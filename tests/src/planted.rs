//! Faults in the text of shaders.

use crate::harness::Outcome;

/// A piece of a text, which it has once, and what is there with a fault.
pub type Replaced = (&'static str, &'static str);

/// A text with a fault.
///
/// # Panics
///
/// When the text does not have the piece exactly once: then the fault would be none.
pub fn planted(wgsl: &str, (piece, fault): Replaced) -> String {
    assert_eq!(wgsl.matches(piece).count(), 1, "the text says {piece:?} not once");
    wgsl.replace(piece, fault)
}

/// Checks that a check of a text fails with each of these faults.
///
/// # Errors
///
/// The first fault with which it passes.
///
/// # Panics
///
/// As [`planted`].
pub fn check_each_is_found(wgsl: &str, faults: &[Replaced], check: impl Fn(&str) -> Outcome) -> Outcome {
    for &(piece, fault) in faults {
        if check(&planted(wgsl, (piece, fault))).is_ok() {
            return Err(format!("not found: {piece:?} is {fault:?}"));
        }
    }
    Ok(())
}
