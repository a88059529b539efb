//! What can be said on the command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use contrejour_plan::{PRESETS, ShadowSettings, SmoothieWidth, Technique};

use crate::values::{parse_size, parse_vector, parse_width};

/// Soft shadows whose silhouettes the GPU finds, for any triangle mesh.
#[derive(Debug, Parser)]
#[command(name = "contrejour", version, propagate_version = true, after_help = AFTER_HELP)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

const AFTER_HELP: &str = "Exit status: 0 when done, 2 with one line on stderr when something is wrong.";

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Draw a picture with soft shadows
    Render(RenderArguments),
    /// Find the silhouette edges of a mesh
    Silhouette(SilhouetteArguments),
    /// Report what a mesh is made of and what is wrong with it
    Inspect(InspectArguments),
    /// Print what a frame of a scene would do, and what it leaves out and why
    Plan(PlanArguments),
}

#[derive(Debug, Args)]
pub struct RenderArguments {
    /// A scene (.toml), a mesh (.obj, .gltf, .glb, .ply, .stl) or the name of a built-in scene [default: a built-in
    /// scene]
    pub scene: Option<String>,

    /// Where the picture goes [default: contrejour.png]; with --orbit a name such as frame-%03d.png
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// Also write shadow map, smoothie depth, smoothie alpha, visibility and silhouette as PNG
    #[arg(long, value_name = "DIR")]
    pub views: Option<PathBuf>,

    /// Print one JSON object: device, costs and counts
    #[arg(long)]
    pub json: bool,

    /// Move the light around the scene in N frames; without --output no picture is read back
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub orbit: Option<u32>,

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

/// What changes the scene's shadow settings.
#[derive(Debug, Default, Args)]
#[command(next_help_heading = "Shadow")]
pub struct ShadowArguments {
    /// Settings to start from [default: the scene's]
    #[arg(long, value_name = "NAME", value_parser = PRESETS.map(|preset| preset.name))]
    pub preset: Option<String>,

    /// How the shadow is made
    #[arg(long, value_name = "NAME", value_parser = Technique::NAMES)]
    pub technique: Option<String>,

    /// Texels along a side of the light's maps
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub map_size: Option<u32>,

    /// Width of the soft edge: a part of the light's image plane, whose side is 2 (the paper shows 0.02 and 0.08), or
    /// `light` to take it from the light's size
    #[arg(long, value_name = "T|light", value_parser = parse_width, allow_hyphen_values = true)]
    pub width: Option<SmoothieWidth>,

    /// Leave alpha as it is, to see the contact problem that its remap cures
    #[arg(long)]
    pub unremapped_alpha: bool,

    /// Fill the smoothie buffer in two passes also where the device could do it in one
    #[arg(long)]
    pub two_passes: bool,
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

impl ShadowArguments {
    /// The scene's settings with what was asked for.
    pub fn applied_to(&self, scene: ShadowSettings) -> Result<ShadowSettings, ShadowArgumentError> {
        let mut settings = match &self.preset {
            Some(name) => ShadowSettings::preset(name)?,
            None => scene,
        };
        if let Some(name) = self.technique.as_ref().filter(|name| *name != settings.technique.name()) {
            settings.technique = name.parse()?;
        }
        settings.map_size = self.map_size.unwrap_or(settings.map_size);
        match &mut settings.technique {
            Technique::Smoothies(smoothies) => {
                smoothies.width = self.width.unwrap_or(smoothies.width);
                if self.unremapped_alpha {
                    smoothies.remap = contrejour_plan::AlphaRemap::Off;
                }
                if self.two_passes {
                    smoothies.blend = contrejour_plan::SmoothieBlend::TwoPasses;
                }
            }
            technique if self.width.is_some() || self.unremapped_alpha || self.two_passes => {
                return Err(ShadowArgumentError::NotSmoothies { technique: technique.name() });
            }
            _ => {}
        }
        settings.validate()?;
        Ok(settings)
    }
}

/// What is wrong with the shadow that was asked for.
#[derive(Debug, thiserror::Error)]
pub enum ShadowArgumentError {
    #[error(transparent)]
    Settings(#[from] contrejour_plan::SettingsError),
    #[error(transparent)]
    Technique(#[from] contrejour_plan::UnknownTechnique),
    #[error(
        "--width, --unremapped-alpha and --two-passes are for smoothies, and the technique is {technique}; leave them out or add --technique smoothies"
    )]
    NotSmoothies { technique: &'static str },
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;
    use contrejour_plan::{AlphaRemap, SmoothieSettings};

    fn parse(line: &str) -> Result<Command, clap::Error> {
        Arguments::try_parse_from(line.split_whitespace()).map(|arguments| arguments.command)
    }

    fn shadow(line: &str) -> Result<ShadowSettings, ShadowArgumentError> {
        let Ok(Command::Render(render)) = parse(line) else { panic!("{line} is a render command") };
        render.shadow.applied_to(ShadowSettings::default())
    }

    #[test]
    fn the_definition_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn negative_coordinates_are_values() {
        for line in ["contrejour silhouette a.obj --point -1,-2.5,-3e2", "contrejour silhouette a.obj --point=-1,-2.5,-3e2"]
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
            "contrejour render --map-size 0",
            "contrejour render --size 0x100",
            "contrejour render --technique magic",
            "contrejour render --preset best",
            "contrejour render --width wide",
        ] {
            assert!(parse(line).is_err(), "{line}");
        }
    }

    #[test]
    fn settings_start_from_the_preset() {
        let settings = shadow("contrejour render --preset low --width 0.02 --unremapped-alpha").expect("all is fine");
        let low = ShadowSettings::preset("low").expect("there is one");
        assert_eq!(settings.map_size, low.map_size);
        let Technique::Smoothies(smoothies) = settings.technique else { panic!("presets are smoothies") };
        assert_eq!(smoothies.width, SmoothieWidth::Ndc(0.02));
        assert_eq!(smoothies.remap, AlphaRemap::Off);
    }

    #[test]
    fn naming_the_technique_that_there_is_keeps_its_settings() {
        let scene = ShadowSettings {
            technique: Technique::Smoothies(SmoothieSettings { width: SmoothieWidth::Ndc(0.3), ..Default::default() }),
            ..Default::default()
        };
        let arguments = ShadowArguments { technique: Some("smoothies".into()), ..Default::default() };
        assert_eq!(arguments.applied_to(scene).expect("all is fine"), scene);
    }

    #[test]
    fn smoothie_settings_need_smoothies() {
        assert!(matches!(
            shadow("contrejour render --technique shadow-map --width 0.1"),
            Err(ShadowArgumentError::NotSmoothies { .. })
        ));
        assert!(matches!(shadow("contrejour render --width 5"), Err(ShadowArgumentError::Settings(_))));
    }
}
