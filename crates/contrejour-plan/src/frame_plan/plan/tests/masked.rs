use super::*;

/// Leaves: faces alone.
const LEAVES: MeshFacts = MeshFacts {
    vertices: 400,
    faces: 200,
    two_face_edges: 0,
    other_edges: 0,
    incidence_words: 0,
    vertex_edges: 0,
    is_masked: true,
};

fn leaves_and_cube() -> SceneFacts {
    SceneFacts {
        meshes: vec![CUBE, LEAVES],
        casters: vec![caster_at("cube", 0, DVec3::ZERO), caster_at("leaves", 1, DVec3::ZERO)],
        masks: MaskFacts { count: 1, words: 3 * 400 + 64 },
        ..cube_scene()
    }
}

#[test]
fn what_a_mask_cuts_is_in_the_shadow_map_alone() {
    let case = Case::new(leaves_and_cube());
    let plan = case.good();
    assert_eq!(plan.passes[..2], [Pass::ShadowMap, Pass::MaskedShadowMap]);
    assert_eq!(plan.reason(&Omitted::Silhouette("leaves".into())), Some(Reason::MaskCutsIt));
    assert_eq!(plan.reason(&Omitted::Silhouette("cube".into())), None);
    assert_eq!(plan.reason(&Omitted::Pass(Pass::MaskedHardwareShadowMap)), Some(Reason::LinearDepthIsRead));
    let mask_bytes = [BufferKind::Masks, BufferKind::MaskWords].map(|kind| bytes(&plan, kind));
    assert_eq!(mask_bytes, [Some(36), Some(4 * 1264)]);
    // As much room for edges as without leaves.
    let alone = Case::new(cube_scene()).good();
    for kind in [BufferKind::Edges, BufferKind::EdgeBlocks, BufferKind::Silhouettes, BufferKind::Quads] {
        assert_eq!(bytes(&plan, kind), bytes(&alone, kind), "{}", kind.name());
    }
    assert_eq!(alone.reason(&Omitted::MaskedPasses), Some(Reason::NothingIsMasked));
    assert_eq!(bytes(&alone, BufferKind::Masks), None);
}

#[test]
fn each_technique_draws_masks_into_its_own_map() {
    for (technique, pass) in [
        (Technique::ShadowMap, Pass::MaskedHardwareShadowMap),
        (Technique::Variance(VarianceSettings::default()), Pass::MaskedShadowMap),
    ] {
        let settings = ShadowSettings { technique, ..ShadowSettings::default() };
        let plan = Case { settings, ..Case::new(leaves_and_cube()) }.good();
        assert_eq!(plan.passes[1], pass);
        // Nobody looks for silhouettes, so none is missed.
        assert_eq!(plan.reason(&Omitted::Silhouette("leaves".into())), None);
    }
}

#[test]
fn where_masks_cut_all_there_are_no_silhouettes() {
    let mut case = Case::new(leaves_and_cube());
    case.scene.casters.remove(0);
    let plan = case.good();
    assert_eq!(plan.passes, [Pass::HardwareShadowMap, Pass::MaskedHardwareShadowMap]);
    assert_eq!(plan.reason(&Omitted::DetectionStages), Some(Reason::MasksCutAll));
    case.outputs = Outputs::Silhouettes;
    let plan = case.good();
    assert!(plan.stages.is_empty() && plan.passes.is_empty());
}

#[test]
fn a_light_that_does_nothing_has_records_where_others_have_seats() {
    let mut case = Case::new(leaves_and_cube());
    case.scene.casters.remove(0);
    case.settings.technique = Technique::ShadowMap;
    case.shared = case.good().buffers.iter().map(|buffer| buffer.kind).filter(|kind| !kind.is_of_light()).collect();
    case.outputs = Outputs::Silhouettes;
    let plan = case.plan().expect("can be planned");
    assert!(plan.stages.is_empty() && plan.passes.is_empty());
    assert_eq!(bytes(&plan, BufferKind::LightView), Some(256));
}

#[test]
fn what_the_caller_moves_too_lacks_a_silhouette_once() {
    let mut case = Case::new(leaves_and_cube());
    case.settings.technique = Technique::SilhouetteMap(SilhouetteMapSettings::STREAM);
    case.scene.casters[1].own_position_words = 24;
    let plan = case.good();
    let leaves = Omitted::Silhouette("leaves".into());
    let reasons = plan.left_out.iter().filter(|left_out| left_out.what == leaves).map(|left_out| left_out.reason);
    assert_eq!(reasons.collect::<Vec<_>>(), [Reason::MaskCutsIt]);
}
