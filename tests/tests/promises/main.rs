//! The promises on the whole library, one file each.

mod closed;
mod exact;
mod left_out;
mod no_gaps;
mod nothing_lost;
mod nothing_per_edge;
mod silhouettes;

use std::process::ExitCode;

fn main() -> ExitCode {
    let trials = [
        exact::trials(),
        closed::trials(),
        silhouettes::trials(),
        nothing_lost::trials(),
        nothing_per_edge::trials(),
        no_gaps::trials(),
        left_out::trials(),
    ];
    contrejour_tests::harness::run(trials.into_iter().flatten().collect())
}
