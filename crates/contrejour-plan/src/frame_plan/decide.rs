//! Decides what a frame runs and who casts in it, and writes down what that leaves out.

use super::{LeftOut, Omitted, Outputs, Pass, PlanInput, Reason, SceneFacts, Stage};
use crate::{SmoothieBlend, SmoothieSettings, SmoothieWidth, Technique, object_light};

/// Texels by which a frustum is widened for filters and for rounding.
const GUARD_TEXELS: f64 = 2.0;

/// What was left out so far.
#[derive(Default)]
pub(super) struct LeftOutList(pub Vec<LeftOut>);

impl LeftOutList {
    pub fn add(&mut self, what: Omitted, reason: Reason) {
        self.0.push(LeftOut { what, reason });
    }

    pub fn all(&mut self, what: impl Iterator<Item = Omitted>, reason: Reason) {
        self.0.extend(what.map(|what| LeftOut { what, reason }));
    }

    pub fn count(&self, reason: Reason) -> u32 {
        self.0.iter().filter(|left_out| left_out.reason == reason).count() as u32
    }
}

/// The smoothies of the frame, where there is any reason to make them.
pub(super) fn smoothies_wanted(input: &PlanInput<'_>, left_out: &mut LeftOutList) -> Option<SmoothieSettings> {
    let reason = match input.settings.technique {
        _ if input.outputs == Outputs::Silhouettes => Reason::OnlySilhouettesWanted,
        Technique::ShadowMap => Reason::TechniqueIsShadowMap,
        _ if nothing_casts(input.scene) => Reason::NothingCasts,
        Technique::Smoothies(smoothies) => {
            if smoothies.width != SmoothieWidth::FromLightSize || input.view.light_size > 0.0 {
                return Some(smoothies);
            }
            Reason::LightHasNoSize
        }
    };
    left_out.add(Omitted::ExtrusionStages, reason);
    left_out.add(Omitted::SmoothiePasses, reason);
    // Silhouettes serve the smoothies, or are wanted for themselves.
    if input.outputs != Outputs::Silhouettes {
        left_out.add(Omitted::DetectionStages, reason);
    }
    None
}

/// The compute stages of the frame.
pub(super) fn stages(input: &PlanInput<'_>, has_smoothies: bool, left_out: &mut LeftOutList) -> Vec<Stage> {
    if has_smoothies {
        return Stage::ALL.to_vec();
    }
    if input.outputs != Outputs::Silhouettes {
        return Vec::new();
    }
    if nothing_casts(input.scene) {
        left_out.add(Omitted::DetectionStages, Reason::NothingCasts);
        return Vec::new();
    }
    Stage::DETECTION.to_vec()
}

/// The raster passes of the frame.
pub(super) fn passes(
    input: &PlanInput<'_>,
    smoothies: Option<&SmoothieSettings>,
    left_out: &mut LeftOutList,
) -> Vec<Pass> {
    if input.outputs == Outputs::Silhouettes {
        left_out.add(Omitted::Pass(Pass::ShadowMap), Reason::OnlySilhouettesWanted);
        left_out.add(Omitted::Pass(Pass::Visibility), Reason::OnlySilhouettesWanted);
        return Vec::new();
    }
    // Without casters too: it clears the map that receivers look up.
    let mut passes = vec![Pass::ShadowMap];
    if let Some(smoothies) = smoothies {
        let two_passes = match smoothies.blend {
            SmoothieBlend::TwoPasses => Some(Reason::TwoPassesAskedFor),
            SmoothieBlend::BestOfDevice if input.device.float32_blendable => None,
            SmoothieBlend::BestOfDevice => Some(Reason::DeviceBlendsNoFloats),
        };
        if let Some(reason) = two_passes {
            passes.extend([Pass::SmoothieDepth, Pass::SmoothieAlpha]);
            left_out.add(Omitted::Pass(Pass::SmoothieBuffer), reason);
        } else {
            passes.push(Pass::SmoothieBuffer);
            left_out.add(Omitted::Pass(Pass::SmoothieDepth), Reason::DeviceBlendsFloats);
            left_out.add(Omitted::Pass(Pass::SmoothieAlpha), Reason::DeviceBlendsFloats);
        }
    }
    if input.outputs == Outputs::VisibilityTexture {
        passes.push(Pass::Visibility);
    } else {
        left_out.add(Omitted::Pass(Pass::Visibility), Reason::NoVisibilityTextureWanted);
    }
    passes
}

/// Indices of the casters that have work items.
pub(super) fn casting(
    input: &PlanInput<'_>,
    smoothies: Option<&SmoothieSettings>,
    left_out: &mut LeftOutList,
) -> Vec<usize> {
    let map_size = input.settings.map_size;
    let widest = smoothies.map_or(0.0, |smoothies| input.view.widest_smoothie_ndc(smoothies, map_size));
    let guard_ndc = widest + GUARD_TEXELS * 2.0 / f64::from(map_size);
    let mut casting = Vec::new();
    for (index, caster) in input.scene.casters.iter().enumerate() {
        let reason = match &caster.bounds {
            _ if input.scene.meshes[caster.mesh].faces == 0 => Some(Reason::NoFaces),
            Some(bounds) if object_light(input.view.light_world, &bounds.world_from_object).singular => {
                Some(Reason::SingularMatrix)
            }
            // The list of silhouette edges does not end where the maps do.
            Some(bounds) if input.outputs != Outputs::Silhouettes && !input.view.can_see(bounds, guard_ndc) => {
                Some(Reason::OutsideFrustum)
            }
            _ => None,
        };
        match reason {
            Some(reason) => left_out.add(Omitted::CasterWork(caster.name.clone()), reason),
            None => casting.push(index),
        }
    }
    casting
}

fn nothing_casts(scene: &SceneFacts) -> bool {
    scene.casters.iter().all(|caster| scene.meshes[caster.mesh].faces == 0)
}
