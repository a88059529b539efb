//! Decides what a frame runs and who casts in it, and writes down what that leaves out.

use super::plan::has_size;
use super::{BufferKind, CasterFacts, LeftOut, Omitted, Outputs, Pass, PlanInput, Reason, SceneFacts, Stage};
use crate::{
    DepthPrecision, ObjectBox, SilhouetteMapSettings, SilhouetteSource, SilhouetteWinner, SmoothieBlend,
    SmoothieSettings, SmoothieWidth, StreamPrecision, Technique, object_light,
};

/// The passes that one technique or another can do without, those of outlines apart, and why; masked ones as those that they follow.
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

/// What a frame draws of its casters' outlines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Outlines {
    Smoothies(SmoothieSettings),
    SilhouetteMap(SilhouetteMapSettings),
}

/// The outlines of the frame, where there is any reason to draw them.
pub(super) fn outlines_wanted(input: &PlanInput<'_>, left_out: &mut LeftOutList) -> Option<Outlines> {
    let asked_for = match input.settings.technique {
        Technique::Smoothies(smoothies) => Some(Outlines::Smoothies(smoothies)),
        Technique::SilhouetteMap(silhouettes) => Some(Outlines::SilhouetteMap(silhouettes)),
        _ => None,
    };
    let needs_size = matches!(asked_for, Some(Outlines::Smoothies(of)) if of.width == SmoothieWidth::FromLightSize);
    let reason = match asked_for {
        _ if input.outputs == Outputs::Silhouettes => Some(Reason::OnlySilhouettesWanted),
        None => None,
        Some(_) if nothing_casts(input.scene) => Some(Reason::NothingCasts),
        Some(_) if !has_silhouettes(input.scene) => Some(Reason::MasksCutAll),
        Some(_) if needs_size && !has_size(input) => Some(Reason::LightHasNoSize),
        Some(_) => None,
    };
    let wanted = asked_for.filter(|_| reason.is_none());
    let is_smoothies = matches!(asked_for, Some(Outlines::Smoothies(_)));
    let is_silhouette_map = matches!(asked_for, Some(Outlines::SilhouetteMap(_)));
    if !matches!(wanted, Some(Outlines::Smoothies(_))) {
        let reason = reason.filter(|_| is_smoothies || input.outputs == Outputs::Silhouettes);
        left_out.add(Omitted::SmoothiePasses, reason.unwrap_or(Reason::TechniqueHasNoSmoothies));
    }
    if !matches!(wanted, Some(Outlines::SilhouetteMap(_))) {
        let reason = reason.filter(|_| is_silhouette_map || input.outputs == Outputs::Silhouettes);
        left_out.add(Omitted::SilhouettePasses, reason.unwrap_or(Reason::TechniqueHasNoSilhouetteMap));
    }
    match wanted {
        Some(Outlines::Smoothies(_)) => {}
        Some(Outlines::SilhouetteMap(silhouettes)) => match silhouettes.source {
            SilhouetteSource::Stages => left_out.add(Omitted::CornerStage, Reason::QuadsReachAroundEnds),
            of_vertex_stage => {
                left_out.add(Omitted::DetectionStages, finds_them(of_vertex_stage));
                left_out.add(Omitted::ExtrusionStages, finds_them(of_vertex_stage));
            }
        },
        None => {
            let reason = reason.unwrap_or(Reason::TechniqueHasNoSilhouettes);
            left_out.add(Omitted::ExtrusionStages, reason);
            // Silhouettes serve what is drawn of them, or are wanted for themselves.
            if input.outputs != Outputs::Silhouettes {
                left_out.add(Omitted::DetectionStages, reason);
            }
        }
    }
    wanted
}

/// The compute stages of the frame.
pub(super) fn stages(input: &PlanInput<'_>, outlines: Option<&Outlines>, left_out: &mut LeftOutList) -> Vec<Stage> {
    match outlines {
        Some(Outlines::Smoothies(_)) => return Stage::ALL.to_vec(),
        Some(Outlines::SilhouetteMap(silhouettes)) => {
            return match silhouettes.source {
                SilhouetteSource::Stages => {
                    Stage::ALL.into_iter().filter(|stage| *stage != Stage::BuildCorners).collect()
                }
                SilhouetteSource::Faces | SilhouetteSource::Stream(_) => Stage::PLACEMENT.to_vec(),
            };
        }
        None => {}
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
pub(super) fn passes(input: &PlanInput<'_>, outlines: Option<&Outlines>, left_out: &mut LeftOutList) -> Vec<Pass> {
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
    if let Some(outlines) = outlines {
        passes.extend(with_masked(Pass::ShadowMap, Pass::MaskedShadowMap));
        match outlines {
            Outlines::Smoothies(smoothies) => passes.extend(smoothie_passes(input, smoothies, left_out)),
            Outlines::SilhouetteMap(silhouettes) => passes.push(silhouette_pass(input, silhouettes, left_out)),
        }
    } else if let Technique::Variance(_) = input.settings.technique {
        passes.extend(with_masked(Pass::ShadowMap, Pass::MaskedShadowMap));
        passes.extend([Pass::Moments, Pass::BlurredMoments]);
        if has_halves(input) {
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
    let two_passes = match smoothies.blend {
        SmoothieBlend::TwoPasses => Some(Reason::TwoPassesAskedFor),
        SmoothieBlend::BestOfDevice if blends_depth(input) => None,
        SmoothieBlend::BestOfDevice => Some(Reason::DeviceBlendsNoFloats),
    };
    if let Some(reason) = two_passes {
        left_out.add(Omitted::Pass(Pass::SmoothieBuffer), reason);
        return &[Pass::SmoothieDepth, Pass::SmoothieAlpha];
    }
    let reason = if has_halves(input) { Reason::HalvesBlend } else { Reason::DeviceBlendsFloats };
    left_out.add(Omitted::Pass(Pass::SmoothieDepth), reason);
    left_out.add(Omitted::Pass(Pass::SmoothieAlpha), reason);
    &[Pass::SmoothieBuffer]
}

fn has_halves(input: &PlanInput<'_>) -> bool {
    input.settings.depth_precision == DepthPrecision::Bits16
}

/// Whether the device blends maps of linear depth.
fn blends_depth(input: &PlanInput<'_>) -> bool {
    has_halves(input) || input.device.float32_blendable
}

/// The pass that fills the silhouette map.
fn silhouette_pass(input: &PlanInput<'_>, silhouettes: &SilhouetteMapSettings, left_out: &mut LeftOutList) -> Pass {
    let (is_blended, not_otherwise) = match silhouettes.winner {
        SilhouetteWinner::ByDepth => (false, Reason::DepthTellsTheNearest),
        SilhouetteWinner::ByBlending if blends_depth(input) => (true, Reason::BlendingAskedFor),
        SilhouetteWinner::ByBlending => (false, Reason::DeviceBlendsNoFloats),
    };
    let omitted = |source, is_blended| Omitted::Pass(filling_pass(source, is_blended));
    left_out.all(SilhouetteSource::ALL.into_iter().map(|source| omitted(source, !is_blended)), not_otherwise);
    let not_asked = SilhouetteSource::ALL.into_iter().filter(|source| *source != silhouettes.source);
    left_out.all(not_asked.map(|source| omitted(source, is_blended)), finds_them(silhouettes.source));
    filling_pass(silhouettes.source, is_blended)
}

fn filling_pass(source: SilhouetteSource, is_blended: bool) -> Pass {
    match (source, is_blended) {
        (SilhouetteSource::Stages, false) => Pass::SilhouetteMap,
        (SilhouetteSource::Stages, true) => Pass::BlendedSilhouetteMap,
        (SilhouetteSource::Faces, false) => Pass::SilhouetteMapTam,
        (SilhouetteSource::Faces, true) => Pass::BlendedSilhouetteMapTam,
        (SilhouetteSource::Stream(StreamPrecision::Bits32), false) => Pass::SilhouetteMapStream,
        (SilhouetteSource::Stream(StreamPrecision::Bits32), true) => Pass::BlendedSilhouetteMapStream,
        (SilhouetteSource::Stream(StreamPrecision::Bits16), false) => Pass::SilhouetteMapHalfStream,
        (SilhouetteSource::Stream(StreamPrecision::Bits16), true) => Pass::BlendedSilhouetteMapHalfStream,
    }
}

fn finds_them(source: SilhouetteSource) -> Reason {
    match source {
        SilhouetteSource::Stages => Reason::StagesFindThem,
        SilhouetteSource::Faces => Reason::VertexStageFindsThem,
        SilhouetteSource::Stream(_) => Reason::StreamTellsThem,
    }
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
pub(super) fn note_without_silhouette(
    scene: &SceneFacts,
    stages: &[Stage],
    passes: &[Pass],
    left_out: &mut LeftOutList,
) {
    let silhouette = |caster: &CasterFacts| Omitted::Silhouette(caster.name.clone());
    if stages.contains(&Stage::DetectSilhouette) || passes.iter().any(|pass| pass.fills_silhouette_map()) {
        left_out.all(masked_casters(scene).map(silhouette), Reason::MaskCutsIt);
    }
    let reads = |kind| passes.iter().any(|pass| pass.buffers().contains(&kind));
    if reads(BufferKind::StreamFaces) || reads(BufferKind::HalfStreamFaces) {
        let moved = opaque_casters(scene).filter(|caster| !caster.has_planes());
        left_out.all(moved.map(silhouette), Reason::StreamIsAtRest);
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
    opaque_casters(scene).next().is_some()
}

fn opaque_casters(scene: &SceneFacts) -> impl Iterator<Item = &CasterFacts> {
    scene.casters.iter().filter(|caster| has_faces(scene, caster) && !scene.meshes[caster.mesh].is_masked)
}

fn masked_casters(scene: &SceneFacts) -> impl Iterator<Item = &CasterFacts> {
    scene.casters.iter().filter(|caster| has_faces(scene, caster) && scene.meshes[caster.mesh].is_masked)
}

fn has_faces(scene: &SceneFacts, caster: &CasterFacts) -> bool {
    scene.meshes[caster.mesh].faces > 0
}
