//! The house is in order: names, bytes and shader text agree on all sides, without a device.

mod layout;
mod modules;
mod names;
mod shaders;
