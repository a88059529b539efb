//! What can be said on the command line.

use std::path::PathBuf;

use crate::report_args::ReportArguments;
use crate::shadow_args::ShadowArguments;
use crate::stability_args::StabilityArguments;
use crate::stress_args::StressArguments;
use crate::values::{parse_seconds, parse_size, parse_vector};
use clap::{Args, Parser, Subcommand, ValueEnum};

/// Soft shadows whose silhouettes the GPU finds, for any triangle mesh.
#[derive(Debug, Parser)]
#[command(name = "contrejour", version, propagate_version = true, after_help = AFTER_HELP)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

const AFTER_HELP: &str = "Exit status: 0 when done, 2 with one line on stderr when something is wrong; 1 when `stability` found a fault or \
`stress --verify` a difference.";

/// What every frame cost is kept until all are drawn.
const MAX_FRAMES: i64 = 100_000;

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Draw a picture with soft shadows
    Render(RenderArguments),
    /// Find the silhouette edges of a mesh
    Silhouette(SilhouetteArguments),
    /// Report what a mesh is made of, what is wrong with it, and its textures, cameras, lights and animations
    Inspect(InspectArguments),
    /// Print what a frame of a scene would do, and what it leaves out and why
    Plan(PlanArguments),
    /// Measure error against run time of all techniques, and write a page about it
    Report(ReportArguments),
    /// Try extreme cases until they break by definition, and write a table and a page about them
    Stability(StabilityArguments),
    /// Draw many moving lights over many moving casters, and say what a frame costs
    Stress(StressArguments),
}

#[derive(Debug, Args)]
pub struct RenderArguments {
    /// A scene (.toml), a mesh (.obj, .gltf, .glb, .ply, .stl) or the name of a built-in scene [default: a built-in
    /// scene]
    pub scene: Option<String>,

    /// Where the picture goes [default: contrejour.png]; with --orbit or --animate a name such as
    /// frame-%03d.png. Folders are made
    /// where they are missing
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// Also write the maps that each light has (shadow map, smoothie depth and alpha, silhouette depth, signed distance), the
    /// scaled faces or the strips that filled a silhouette map, visibility and silhouette as PNG; maps of a light with several
    /// views are a file for each: each side of the cube around a point light, each cascade
    #[arg(long, value_name = "DIR")]
    pub views: Option<PathBuf>,

    /// Print one JSON object: device, costs and counts
    #[arg(long)]
    pub json: bool,

    /// Move the light around the scene in N frames, at most 100000; without --output no picture is read back
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=MAX_FRAMES))]
    pub orbit: Option<u32>,

    /// See a glTF file through its camera of this name; one without a name has its number, from 0 [default: the first]
    #[arg(long, value_name = "NAME", requires = "scene")]
    pub camera: Option<String>,

    /// Pose a glTF model as its animation of this name does; one without a name has its number in the file, from 0
    #[arg(long, value_name = "NAME", requires = "scene")]
    pub animation: Option<String>,

    /// Time of the pose; beyond the animation's end it stays as it ends [default: 0]
    #[arg(long, value_name = "SECONDS", requires = "animation", value_parser = parse_seconds, allow_hyphen_values = true)]
    pub time: Option<f64>,

    /// Play the whole animation in N frames at even times, at most 100000; without --output no picture is read back
    #[arg(
        long,
        value_name = "N",
        requires = "animation",
        conflicts_with_all = ["orbit", "time"],
        value_parser = clap::value_parser!(u32).range(1..=MAX_FRAMES)
    )]
    pub animate: Option<u32>,

    /// Pixels of the picture [default: the scene's]
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<[u32; 2]>,

    #[command(flatten)]
    pub shadow: ShadowArguments,
}

#[derive(Debug, Args)]
pub struct PlanArguments {
    /// As in `render`
    pub scene: Option<String>,

    /// Print one JSON object
    #[arg(long)]
    pub json: bool,

    #[command(flatten)]
    pub shadow: ShadowArguments,
}

#[derive(Debug, Args)]
pub struct SilhouetteArguments {
    /// A mesh (.obj, .gltf, .glb, .ply, .stl)
    pub mesh: PathBuf,

    #[command(flatten)]
    pub light: LightArguments,

    /// Who finds them
    #[arg(long, value_enum, default_value_t = Finder::Gpu)]
    pub on: Finder,

    /// How they are written
    #[arg(long, value_enum, default_value_t = Format::Json)]
    pub format: Format,

    /// Where they go [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

#[derive(Debug, Args)]
#[group(required = true, multiple = false)]
pub struct LightArguments {
    /// A light at a point
    #[arg(long, value_name = "x,y,z", value_parser = parse_vector, allow_hyphen_values = true)]
    pub point: Option<[f32; 3]>,

    /// Parallel light; the direction points from the mesh towards the light
    #[arg(long, value_name = "x,y,z", value_parser = parse_vector, allow_hyphen_values = true)]
    pub direction: Option<[f32; 3]>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Finder {
    /// The compute stages on the graphics device
    Gpu,
    /// Their twins on the CPU, which need no device
    Cpu,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// `edges`: [a, b, m] with a < b and the signed multiplicity m from a to b
    Json,
    /// A drawing as seen from the light
    Svg,
    /// Line elements
    Obj,
}

#[derive(Debug, Args)]
pub struct InspectArguments {
    /// A mesh (.obj, .gltf, .glb, .ply, .stl)
    pub mesh: PathBuf,

    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    fn parse(line: &str) -> Result<Command, clap::Error> {
        Arguments::try_parse_from(line.split_whitespace()).map(|arguments| arguments.command)
    }

    #[test]
    fn the_definition_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn negative_coordinates_are_values() {
        for line in
            ["contrejour silhouette a.obj --point -1,-2.5,-3e2", "contrejour silhouette a.obj --point=-1,-2.5,-3e2"]
        {
            let Ok(Command::Silhouette(silhouette)) = parse(line) else { panic!("{line} is a silhouette command") };
            assert_eq!(silhouette.light.point, Some([-1.0, -2.5, -300.0]));
        }
    }

    #[test]
    fn a_silhouette_needs_one_light() {
        assert!(parse("contrejour silhouette a.obj").is_err());
        assert!(parse("contrejour silhouette a.obj --point 1,2,3 --direction 1,2,3").is_err());
        assert!(parse("contrejour silhouette a.obj --direction 1,2,3").is_ok());
    }

    #[test]
    fn what_makes_no_sense_is_refused() {
        for line in [
            "contrejour",
            "contrejour render --orbit 0",
            "contrejour render --orbit 100001",
            "contrejour render --animation Walk",
            "contrejour render fox.glb --time 1",
            "contrejour render fox.glb --animate 3",
            "contrejour render fox.glb --animation Walk --animate 0",
            "contrejour render fox.glb --animation Walk --animate 3 --time 1",
            "contrejour render fox.glb --animation Walk --animate 3 --orbit 3",
            "contrejour render fox.glb --animation Walk --time nan",
            "contrejour render fox.glb --animation Walk --time -1",
            "contrejour render --map-size 0",
            "contrejour render --size 0x100",
            "contrejour render --technique magic",
            "contrejour render --preset best",
            "contrejour render --width wide",
        ] {
            assert!(parse(line).is_err(), "{line}");
        }
    }
}
