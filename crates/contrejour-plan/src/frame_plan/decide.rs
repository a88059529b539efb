//! Decides what a frame runs and who casts in it, and writes down what that leaves out.

use super::plan::has_size;
use super::{BufferKind, CasterFacts, LeftOut, Omitted, Outputs, Pass, PlanInput, Reason, SceneFacts, Stage};
use crate::{DepthPrecision, ObjectBox, SmoothieBlend, SmoothieSettings, SmoothieWidth, Technique, object_light};

/// The passes that one technique or another can do without, smoothies apart, and why; masked ones as those that they follow.
const MAP_PASSES: [Pass; 4] = [Pass::HardwareShadowMap, Pass::ShadowMap, Pass::Moments, Pass::BlurredMoments];
const MASKED_PASSES: [Pass; 2] = [Pass::MaskedHardwareShadowMap, Pass::MaskedShadowMap];
const WITHOUT_MAP_PASS: [Reason; 4] = [
    Reason::LinearDepthIsRead,
    Reason::HardwareDepthIsEnough,
    Reason::TechniqueHasNoMoments,
    Reason::TechniqueHasNoMoments,
];

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
        Technique::Smoothies(_) if nothing_casts(input.scene) => Reason::NothingCasts,
        Technique::Smoothies(_) if !has_silhouettes(input.scene) => Reason::MasksCutAll,
        Technique::Smoothies(smoothies) => {
            if smoothies.width != SmoothieWidth::FromLightSize || has_size(input) {
                return Some(smoothies);
            }
            Reason::LightHasNoSize
        }
        _ => Reason::TechniqueHasNoSmoothies,
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
    if nothing_casts(input.scene) {
        left_out.add(Omitted::PlacementStages, Reason::NothingCasts);
        if input.outputs == Outputs::Silhouettes {
            left_out.add(Omitted::DetectionStages, Reason::NothingCasts);
        }
        return Vec::new();
    }
    match input.outputs {
        Outputs::Silhouettes if !has_silhouettes(input.scene) => {
            left_out.add(Omitted::PlacementStages, Reason::MasksCutAll);
            left_out.add(Omitted::DetectionStages, Reason::MasksCutAll);
            Vec::new()
        }
        Outputs::Silhouettes => Stage::UP_TO_SILHOUETTES.to_vec(),
        _ => Stage::PLACEMENT.to_vec(),
    }
}

/// The raster passes of the frame.
pub(super) fn passes(
    input: &PlanInput<'_>,
    smoothies: Option<&SmoothieSettings>,
    left_out: &mut LeftOutList,
) -> Vec<Pass> {
    if input.outputs == Outputs::Silhouettes {
        for pass in MAP_PASSES.into_iter().chain([Pass::Visibility]) {
            left_out.add(Omitted::Pass(pass), Reason::OnlySilhouettesWanted);
        }
        left_out.add(Omitted::MaskedPasses, Reason::OnlySilhouettesWanted);
        return Vec::new();
    }
    // The shadow map without casters too: it clears the map that receivers look up.
    let mut passes = Vec::new();
    let is_masked = masked_casters(input.scene).next().is_some();
    let with_masked = |pass, masked| if is_masked { vec![pass, masked] } else { vec![pass] };
    if let Some(smoothies) = smoothies {
        passes.extend(with_masked(Pass::ShadowMap, Pass::MaskedShadowMap));
        passes.extend(smoothie_passes(input, smoothies, left_out));
    } else if let Technique::Variance(_) = input.settings.technique {
        passes.extend(with_masked(Pass::ShadowMap, Pass::MaskedShadowMap));
        passes.extend([Pass::Moments, Pass::BlurredMoments]);
        if input.settings.depth_precision == DepthPrecision::Bits16 {
            left_out.add(Omitted::FullMoments, Reason::HalvesAskedFor);
        } else if !input.device.float32_filterable {
            left_out.add(Omitted::FullMoments, Reason::DeviceFiltersNoFloats);
        }
    } else {
        passes.extend(with_masked(Pass::HardwareShadowMap, Pass::MaskedHardwareShadowMap));
        if matches!(input.settings.technique, Technique::Pcss(_)) && !has_size(input) {
            left_out.add(Omitted::BlockerSearch, Reason::LightHasNoSize);
        }
    }
    for (pass, reason) in MAP_PASSES.into_iter().zip(WITHOUT_MAP_PASS) {
        if !passes.contains(&pass) {
            left_out.add(Omitted::Pass(pass), reason);
        }
    }
    if !is_masked {
        left_out.add(Omitted::MaskedPasses, Reason::NothingIsMasked);
    }
    for (pass, reason) in MASKED_PASSES.into_iter().zip(WITHOUT_MAP_PASS) {
        if is_masked && !passes.contains(&pass) {
            left_out.add(Omitted::Pass(pass), reason);
        }
    }
    if input.outputs == Outputs::VisibilityTexture {
        passes.push(Pass::Visibility);
    } else {
        left_out.add(Omitted::Pass(Pass::Visibility), Reason::NoVisibilityTextureWanted);
    }
    passes
}

/// The passes that fill the smoothie buffer.
fn smoothie_passes(input: &PlanInput<'_>, smoothies: &SmoothieSettings, left_out: &mut LeftOutList) -> &'static [Pass] {
    let halves = input.settings.depth_precision == DepthPrecision::Bits16;
    let two_passes = match smoothies.blend {
        SmoothieBlend::TwoPasses => Some(Reason::TwoPassesAskedFor),
        SmoothieBlend::BestOfDevice if halves || input.device.float32_blendable => None,
        SmoothieBlend::BestOfDevice => Some(Reason::DeviceBlendsNoFloats),
    };
    if let Some(reason) = two_passes {
        left_out.add(Omitted::Pass(Pass::SmoothieBuffer), reason);
        return &[Pass::SmoothieDepth, Pass::SmoothieAlpha];
    }
    let reason = if halves { Reason::HalvesBlend } else { Reason::DeviceBlendsFloats };
    left_out.add(Omitted::Pass(Pass::SmoothieDepth), reason);
    left_out.add(Omitted::Pass(Pass::SmoothieAlpha), reason);
    &[Pass::SmoothieBuffer]
}

/// Indices of the casters that have work items.
pub(super) fn casting(input: &PlanInput<'_>, left_out: &mut LeftOutList) -> Vec<usize> {
    let mut casting = Vec::new();
    for (index, caster) in input.scene.casters.iter().enumerate() {
        let reason = match &caster.bounds {
            _ if input.scene.meshes[caster.mesh].faces == 0 => Some(Reason::NoFaces),
            Some(bounds) if is_singular(input, bounds) => Some(Reason::SingularMatrix),
            // The list of silhouette edges does not end where the maps do.
            Some(bounds) if input.outputs != Outputs::Silhouettes && !is_seen(input, bounds) => {
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

fn is_singular(input: &PlanInput<'_>, bounds: &ObjectBox) -> bool {
    input.views.iter().any(|view| object_light(view.light_world, &bounds.world_from_object).singular)
}

fn is_seen(input: &PlanInput<'_>, bounds: &ObjectBox) -> bool {
    input.views.iter().any(|view| view.can_see(bounds, view.reach_ndc(input.settings)))
}

/// Notes who casts and has no silhouette, where silhouettes are looked for.
pub(super) fn note_masked(scene: &SceneFacts, stages: &[Stage], left_out: &mut LeftOutList) {
    if stages.contains(&Stage::DetectSilhouette) {
        let names = masked_casters(scene).map(|caster| caster.name.clone());
        left_out.all(names.map(Omitted::Silhouette), Reason::MaskCutsIt);
    }
}

/// Whether no face has a plane; notes it where a stage would read them. Planes that were made stay: a caster without
/// positions of its own may come again.
pub(super) fn lacks_planes(input: &PlanInput<'_>, stages: &[Stage], left_out: &mut LeftOutList) -> bool {
    let were_made = input.made.iter().any(|made| made.kind == BufferKind::Planes && made.items > 0);
    let lacks_planes = !were_made && !input.scene.casters.iter().any(CasterFacts::has_planes);
    if lacks_planes && stages.contains(&Stage::ClassifyFaces) {
        left_out.add(Omitted::FacePlanes, Reason::PositionsAreTheCallers);
    }
    lacks_planes
}

fn nothing_casts(scene: &SceneFacts) -> bool {
    !scene.casters.iter().any(|caster| has_faces(scene, caster))
}

/// Whether something casts that no mask cuts.
fn has_silhouettes(scene: &SceneFacts) -> bool {
    scene.casters.iter().any(|caster| has_faces(scene, caster) && !scene.meshes[caster.mesh].is_masked)
}

fn masked_casters(scene: &SceneFacts) -> impl Iterator<Item = &CasterFacts> {
    scene.casters.iter().filter(|caster| has_faces(scene, caster) && scene.meshes[caster.mesh].is_masked)
}

fn has_faces(scene: &SceneFacts, caster: &CasterFacts) -> bool {
    scene.meshes[caster.mesh].faces > 0
}
