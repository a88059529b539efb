//! A Wavefront OBJ file and its material library.
#![no_main]

use contrejour_fuzz::{check_file, run_on_one_thread};
use contrejour_properties::Format;
use libfuzzer_sys::fuzz_target;

fuzz_target!(init: run_on_one_thread(), |bytes: &[u8]| {
    check_file(Format::Obj, bytes);
});
