//! What can be said about a report.

use std::path::PathBuf;

use clap::Args;
use contrejour_lab::report::Extent;
use contrejour_lab::run::{Effort, QUICK_SCENES, Shard};
use contrejour_scene::BUILT_IN_SCENES;

use crate::values::parse_size;

#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub struct ReportArguments {
    /// Scenes (.toml), meshes and built-in scenes, separated by commas [default: all built-in scenes; with --quick a
    /// few]
    #[arg(long, value_name = "SCENE,..", value_delimiter = ',')]
    pub scenes: Vec<String>,

    /// Techniques and families, separated by commas [default: all, and the papers' figures]
    #[arg(long, value_name = "NAME,..", value_delimiter = ',')]
    pub techniques: Vec<String>,

    /// Texels along a side of the shadow map, separated by commas [default: 256,512,1024,2048; with --quick
    /// 256,512,1024]
    #[arg(long, value_name = "N,..", value_delimiter = ',', value_parser = clap::value_parser!(u32).range(1..))]
    pub sizes: Vec<u32>,

    /// Small pictures, few frames and variants: done in three minutes on two cores
    #[arg(long)]
    pub quick: bool,

    /// Pixels of the compared pictures [default: 640x480; with --quick 320x240]
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub picture_size: Option<[u32; 2]>,

    /// Seed of everything random
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,

    /// Do only part I of N; see --merge
    #[arg(long, value_name = "I/N")]
    pub shard: Option<Shard>,

    /// Measure all again, also what an earlier run left in the folder
    #[arg(long)]
    pub restart: bool,

    /// Put the folders of all shards together instead of measuring
    #[arg(long, value_name = "DIR", num_args = 1.., conflicts_with_all = MEASURING)]
    pub merge: Vec<PathBuf>,

    /// Where everything goes; made where it is missing. The same command again goes on with what is there
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,

    /// Print one JSON object: paths of what was written
    #[arg(long)]
    pub json: bool,
}

/// Arguments that make no sense where nothing is measured.
const MEASURING: [&str; 8] = ["scenes", "techniques", "sizes", "quick", "picture_size", "seed", "shard", "restart"];

const AFTER_HELP: &str = "The last line that is printed is the path of the page.";

impl ReportArguments {
    pub fn effort(&self) -> Effort {
        let effort = Effort::of(if self.quick { Extent::Quick } else { Extent::Full });
        Effort { picture_size: self.picture_size.unwrap_or(effort.picture_size), ..effort }
    }

    /// Names of the scenes, asked for or not.
    pub fn scene_names(&self) -> Vec<String> {
        match (self.scenes.is_empty(), self.quick) {
            (false, _) => self.scenes.clone(),
            (true, true) => QUICK_SCENES.map(str::to_owned).to_vec(),
            (true, false) => BUILT_IN_SCENES.iter().map(|scene| scene.name.to_owned()).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use crate::args::{Arguments, Command};

    use super::*;

    fn report(line: &str) -> Result<ReportArguments, clap::Error> {
        let arguments = Arguments::try_parse_from(format!("contrejour report {line}").split_whitespace())?;
        let Command::Report(report) = arguments.command else { panic!("{line} is a report command") };
        Ok(report)
    }

    #[test]
    fn lists_and_defaults() {
        let asked = report("--scenes boxes,a.obj --sizes 64,128 --shard 2/3 -o out").expect("good");
        assert_eq!((asked.scene_names(), asked.sizes), (vec!["boxes".into(), "a.obj".into()], vec![64, 128]));
        assert_eq!(asked.shard, Shard::new(2, 3));
        let full = report("-o out").expect("good");
        assert_eq!(full.scene_names().len(), BUILT_IN_SCENES.len());
        let merged = report("--merge a b c -o out").expect("good").merge;
        assert_eq!(merged.len(), 3);
    }

    #[test]
    fn what_makes_no_sense_is_refused() {
        for line in ["", "--sizes 0 -o out", "--shard 4/3 -o out", "--merge -o out", "--merge a --quick -o out"] {
            assert!(report(line).is_err(), "{line}");
        }
    }
}
