//! Faults that are planted where a property must see them.

use std::panic::{AssertUnwindSafe, catch_unwind};

/// What is told of a fault, and the fault.
pub(crate) type Planted<T> = (&'static str, fn(&mut T));

/// Fails where the check passes, or fails without a word of what is planted.
pub(crate) fn assert_found(told: &str, check: impl FnOnce()) {
    let Err(panic) = catch_unwind(AssertUnwindSafe(check)) else { panic!("not found: {told}") };
    let message = panic.downcast_ref::<String>().cloned();
    let message = message.or_else(|| panic.downcast_ref::<&str>().map(|text| (*text).to_owned())).unwrap_or_default();
    assert!(message.contains(told), "{message:?} does not tell of {told:?}");
}
