//! What the command line can say about the shadow.

use clap::Args;
use contrejour_plan::{
    AlphaRemap, DepthPrecision, PRESETS, SettingsError, ShadowSettings, SmoothieBlend, SmoothieWidth, Technique,
    UnknownTechnique,
};

use contrejour_scene::Scene;

use crate::values::{parse_assignment, parse_depth_bits, parse_width};

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

    /// Tunes the technique: a parameter's name and a number, as in filter_samples=64; can be given several times.
    #[arg(long = "set", value_name = "NAME=NUMBER", value_parser = parse_assignment, allow_hyphen_values = true)]
    pub parameters: Vec<(String, f64)>,

    /// Bits in which the maps keep linear depth
    #[arg(long, value_name = "N", value_parser = parse_depth_bits)]
    pub depth_bits: Option<DepthPrecision>,

    /// Width of smoothies: a part of the light's image plane, whose side is 2 (the paper shows 0.02 and 0.08), or
    /// `light` to take it from the light's size
    #[arg(long, value_name = "T|light", value_parser = parse_width, allow_hyphen_values = true)]
    pub width: Option<SmoothieWidth>,

    /// Leave the smoothies' alpha as it is, to see the contact problem that its remap cures
    #[arg(long)]
    pub unremapped_alpha: bool,

    /// Fill the smoothie buffer in two passes also where the device could do it in one
    #[arg(long)]
    pub two_passes: bool,
}

impl ShadowArguments {
    /// Changes how the shadows of all lights of a scene are made.
    pub fn apply_to_lights(&self, scene: &mut Scene) -> Result<(), ShadowArgumentError> {
        for light in &mut scene.lights {
            light.shadow = self.applied_to(light.shadow)?;
        }
        Ok(())
    }

    /// Whether a technique is asked for, by its name or by what tunes it.
    pub fn has_technique(&self) -> bool {
        let is_tuned = !self.parameters.is_empty() || self.width.is_some() || self.unremapped_alpha || self.two_passes;
        self.preset.is_some() || self.technique.is_some() || is_tuned
    }

    /// Whether a map size is asked for.
    pub fn has_map_size(&self) -> bool {
        self.preset.is_some() || self.map_size.is_some()
    }

    /// A light's settings with what was asked for.
    pub fn applied_to(&self, scene: ShadowSettings) -> Result<ShadowSettings, ShadowArgumentError> {
        let mut settings = match &self.preset {
            Some(name) => ShadowSettings::preset(name)?,
            None => scene,
        };
        if let Some(name) = &self.technique {
            settings.technique = settings.technique.named(name)?;
        }
        settings.map_size = self.map_size.unwrap_or(settings.map_size);
        settings.depth_precision = self.depth_bits.unwrap_or(settings.depth_precision);
        for (name, value) in &self.parameters {
            settings.technique.set(name, *value)?;
        }
        match &mut settings.technique {
            Technique::Smoothies(smoothies) => {
                smoothies.width = self.width.unwrap_or(smoothies.width);
                if self.unremapped_alpha {
                    smoothies.remap = AlphaRemap::Off;
                }
                if self.two_passes {
                    smoothies.blend = SmoothieBlend::TwoPasses;
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
    Settings(#[from] SettingsError),
    #[error(transparent)]
    Technique(#[from] UnknownTechnique),
    #[error(
        "--width, --unremapped-alpha and --two-passes are for smoothies, and the technique is {technique}; leave them out or add --technique smoothies"
    )]
    NotSmoothies { technique: &'static str },
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::{Arguments, Command};
    use clap::Parser;
    use contrejour_plan::SmoothieSettings;

    fn shadow(line: &str) -> Result<ShadowSettings, ShadowArgumentError> {
        let arguments = Arguments::try_parse_from(line.split_whitespace()).map(|arguments| arguments.command);
        let Ok(Command::Render(render)) = arguments else { panic!("{line} is a render command") };
        render.shadow.applied_to(ShadowSettings::default())
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

    #[test]
    fn techniques_are_tuned_by_name() {
        let settings = shadow("contrejour render --technique pcss --set filter_samples=64 --set search_max_ndc=0.5")
            .expect("all is fine");
        let Technique::Pcss(pcss) = settings.technique else { panic!("it was asked for") };
        assert_eq!((pcss.filter_samples, pcss.search_max_ndc), (64, 0.5));
        for line in ["--technique pcss --set kernel=5", "--technique pcss --set filter_samples=-1", "--set width_ndc=3"]
        {
            let error = shadow(&format!("contrejour render {line}"));
            assert!(matches!(error, Err(ShadowArgumentError::Settings(_))), "{line}");
        }
    }
}
