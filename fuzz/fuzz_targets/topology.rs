//! Triangles under a light: topology, the CPU twins of all stages, and the oracle beside them.
#![no_main]

use contrejour_fuzz::{most_bytes_held, run_on_one_thread};
use contrejour_properties::{Caster, check_silhouette, most_bytes_of_silhouette};
use libfuzzer_sys::fuzz_target;

fuzz_target!(init: run_on_one_thread(), |caster: Caster| {
    let ((), held) = most_bytes_held(|| check_silhouette(&caster));
    let (vertices, triangles) = (caster.positions.len(), caster.triangles.len());
    let most = most_bytes_of_silhouette(vertices, triangles);
    assert!(held <= most, "{vertices} vertices, {triangles} triangles held {held} bytes, the bound is {most}");
});
