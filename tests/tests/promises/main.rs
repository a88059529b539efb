//! The promises on the whole library, one file each.

mod cascade_borders;
mod cascades;
mod closed;
mod come_and_go;
mod deformed;
mod device_trouble;
mod drawn_lights;
mod exact;
mod facing;
mod judged;
mod lamp_borders;
mod lamp_truth;
mod left_out;
mod many_lights;
mod masked;
mod no_gaps;
mod nothing_lost;
mod nothing_per_edge;
mod own_positions;
mod pages;
mod peers;
mod pictures;
mod posed;
mod repeatable;
mod silhouette_doubts;
mod silhouette_maps;
mod silhouette_passes;
mod silhouette_scenes;
mod silhouette_shading;
mod silhouettes;
mod smoothie_ways;
mod ten_million;
mod textured;

use std::process::ExitCode;

fn main() -> ExitCode {
    let trials = [
        exact::trials(),
        facing::trials(),
        closed::trials(),
        silhouettes::trials(),
        silhouette_maps::trials(),
        silhouette_passes::trials(),
        silhouette_scenes::trials(),
        silhouette_shading::trials(),
        repeatable::trials(),
        nothing_lost::trials(),
        nothing_per_edge::trials(),
        own_positions::trials(),
        many_lights::trials(),
        masked::trials(),
        come_and_go::trials(),
        deformed::trials(),
        posed::trials(),
        device_trouble::trials(),
        pages::trials(),
        ten_million::trials(),
        no_gaps::trials(),
        smoothie_ways::trials(),
        lamp_borders::trials(),
        cascades::trials(),
        cascade_borders::trials(),
        lamp_truth::trials(),
        left_out::trials(),
        peers::trials(),
        drawn_lights::trials(),
        textured::trials(),
        pictures::trials(),
        judged::trials(),
    ];
    contrejour_tests::harness::run(trials.into_iter().flatten().collect())
}
