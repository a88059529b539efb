//! A glTF or GLB file, and what moves in it.
#![no_main]

use contrejour_fuzz::{check_file, run_on_one_thread};
use contrejour_properties::{Format, check_rig};
use libfuzzer_sys::fuzz_target;

fuzz_target!(init: run_on_one_thread(), |bytes: &[u8]| {
    check_file(Format::Gltf, bytes);
    check_rig(bytes);
});
