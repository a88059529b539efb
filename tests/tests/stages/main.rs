//! Each compute stage against its CPU twin, buffer by buffer, fed with inputs made on the CPU.

mod build_corners;
mod bundles;
mod classify_faces;
mod deform_positions;
mod detect_silhouette;
mod device_errors;
mod extrude_edges;
mod float64;
mod huge_edges;
mod light_formulas;
mod list_blocks;
mod outline_balls;
mod parity;
mod place_casters;
mod recheck_faces;
mod refine_faces;
mod resolve_faces;
mod write_draw_args;
mod write_extrude_args;
mod write_item_args;
mod write_recheck_args;
mod write_refine_args;

use std::process::ExitCode;

fn main() -> ExitCode {
    let trials = [
        device_errors::trials(),
        deform_positions::trials(),
        float64::trials(),
        light_formulas::trials(),
        place_casters::trials(),
        list_blocks::trials(),
        write_item_args::trials(),
        classify_faces::trials(),
        write_recheck_args::trials(),
        recheck_faces::trials(),
        write_refine_args::trials(),
        refine_faces::trials(),
        resolve_faces::trials(),
        detect_silhouette::trials(),
        bundles::trials(),
        write_extrude_args::trials(),
        extrude_edges::trials(),
        huge_edges::trials(),
        build_corners::trials(),
        write_draw_args::trials(),
    ];
    contrejour_tests::harness::run(trials.into_iter().flatten().collect())
}
