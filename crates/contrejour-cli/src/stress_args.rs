//! What can be said about a stress run.

use std::path::PathBuf;

use clap::Args;
use contrejour_lab::stress::{LightMix, SweepAxis};

use crate::shadow_args::ShadowArguments;
use crate::values::parse_duration;

#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub struct StressArguments {
    /// Lights, which move
    #[arg(long, value_name = "N", default_value_t = 8)]
    pub lights: usize,

    /// Kinds of lights: mixed, point, spot or directional; every second directional one has cascades
    #[arg(long, value_name = "KIND", default_value_t = LightMix::Mixed)]
    pub kind: LightMix,

    /// Casters, which move, and every fourth deforms
    #[arg(long, value_name = "N", default_value_t = 16)]
    pub casters: usize,

    /// Triangles of each caster, nearly
    #[arg(long, value_name = "N", default_value_t = 1000)]
    pub triangles_per_caster: usize,

    /// Let nothing move: the maps of the first frame stand
    #[arg(long)]
    pub still: bool,

    /// How long frames are drawn; a sweep draws 15 with each value in any case
    #[arg(long, value_name = "S", default_value = "5", value_parser = parse_duration)]
    pub seconds: f64,

    /// Seed of all paths
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,

    /// Compare frames that are taken at random, and their pictures, with exact arithmetic and with frames drawn from scratch
    #[arg(long)]
    pub verify: bool,

    /// Show it in a window, until its time is over or the window is closed; a frame's cost then holds its picture
    #[cfg(feature = "window")]
    #[arg(long, conflicts_with_all = ["verify", "sweep"])]
    pub window: bool,

    /// Vary one number (lights, casters or triangles) and write stress-AXIS.csv and stress-AXIS.svg
    #[arg(long, value_name = "AXIS")]
    pub sweep: Option<SweepAxis>,

    /// Where the files of a sweep go; made where it is missing
    #[arg(short, long, value_name = "DIR", default_value = ".")]
    pub output: PathBuf,

    /// Print one JSON object, with --sweep one array of them
    #[arg(long)]
    pub json: bool,

    #[command(flatten)]
    pub shadow: ShadowArguments,
}

const AFTER_HELP: &str = "\
Mixed lights have techniques, map sizes and softness of their own, by the seed: three of five have smoothies, maps have 256
to 1024 texels. What is given here holds for all of them: --technique, or what tunes it, and --map-size; --preset both.
Sweeps give all lights the same.

Exit status: 0 when done, 1 when `--verify` found a difference, 2 when something is wrong.";
