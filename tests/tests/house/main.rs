//! The house is in order: names, bytes and shader text agree on all sides.
