//! Silhouette maps, by any source.

use super::*;

#[test]
fn each_source_of_a_silhouette_map_needs_its_own() {
    let mut case = Case::new(cube_scene());
    case.settings.technique = Technique::SilhouetteMap(SilhouetteMapSettings::DEFAULT);
    let plan = case.good();
    assert_eq!(plan.passes, [Pass::ShadowMap, Pass::SilhouetteMap]);
    assert_eq!(plan.reason(&Omitted::CornerStage), Some(Reason::QuadsReachAroundEnds));
    assert_eq!(plan.reason(&Omitted::Pass(Pass::SilhouetteMapTam)), Some(Reason::StagesFindThem));
    assert!(plan.buffer(BufferKind::Corners).is_none() && plan.buffer(BufferKind::FaceNeighbours).is_none());
    case.settings.technique = Technique::SilhouetteMap(SilhouetteMapSettings::TAM);
    let plan = case.good();
    assert_eq!(plan.passes, [Pass::ShadowMap, Pass::SilhouetteMapTam]);
    assert_eq!(plan.reason(&Omitted::DetectionStages), Some(Reason::VertexStageFindsThem));
    assert_eq!(bytes(&plan, BufferKind::FaceNeighbours), bytes(&plan, BufferKind::Faces));
    assert!(plan.buffer(BufferKind::Edges).is_none() && plan.buffer(BufferKind::Quads).is_none());
    let passes_and_faces = [
        (StreamPrecision::Bits32, Pass::SilhouetteMapStream, BufferKind::StreamFaces, 6),
        (StreamPrecision::Bits16, Pass::SilhouetteMapHalfStream, BufferKind::HalfStreamFaces, 3),
    ];
    for (precision, pass, faces, times) in passes_and_faces {
        let source = SilhouetteSource::Stream(precision);
        case.settings.technique = Technique::SilhouetteMap(SilhouetteMapSettings { source, ..Default::default() });
        let plan = case.good();
        assert_eq!(plan.passes, [Pass::ShadowMap, pass]);
        assert_eq!(plan.reason(&Omitted::Pass(Pass::SilhouetteMapTam)), Some(Reason::StreamTellsThem));
        assert_eq!(bytes(&plan, faces), bytes(&plan, BufferKind::Faces).map(|bytes| times * bytes));
        assert!(plan.buffer(BufferKind::FaceNeighbours).is_none() && plan.buffer(BufferKind::EdgeFans).is_none());
    }
}

#[test]
fn a_stream_has_no_silhouette_of_what_the_caller_moves() {
    let mut case = Case::new(cube_scene());
    let moved = Omitted::Silhouette(case.scene.casters[0].name.clone());
    for (technique, reason) in
        [(SilhouetteMapSettings::STREAM, Some(Reason::StreamIsAtRest)), (SilhouetteMapSettings::TAM, None)]
    {
        case.settings.technique = Technique::SilhouetteMap(technique);
        case.scene.casters[0].own_position_words = 0;
        assert_eq!(case.good().reason(&moved), None);
        case.scene.casters[0].own_position_words = 24;
        assert_eq!(case.good().reason(&moved), reason);
    }
}

#[test]
fn blending_leaves_out_the_order_of_silhouettes_where_the_device_blends() {
    let mut case = Case::new(cube_scene());
    case.device.float32_blendable = true;
    for (source, pass) in [
        (SilhouetteSource::Stages, Pass::BlendedSilhouetteMap),
        (SilhouetteSource::Faces, Pass::BlendedSilhouetteMapTam),
        (SilhouetteSource::Stream(StreamPrecision::Bits32), Pass::BlendedSilhouetteMapStream),
        (SilhouetteSource::Stream(StreamPrecision::Bits16), Pass::BlendedSilhouetteMapHalfStream),
    ] {
        let winner = SilhouetteWinner::ByBlending;
        case.settings.technique =
            Technique::SilhouetteMap(SilhouetteMapSettings { source, winner, ..Default::default() });
        let plan = case.good();
        assert_eq!(plan.passes, [Pass::ShadowMap, pass]);
        assert!(plan.texture(TextureKind::SilhouetteOrder).is_none());
        assert_eq!(plan.reason(&Omitted::Pass(Pass::SilhouetteMap)), Some(Reason::BlendingAskedFor));
        assert!(matches!(plan.visibility, Some(VisibilityKind::SilhouetteMap { .. })));

        case.device.float32_blendable = false;
        let plan = case.good();
        assert!(plan.texture(TextureKind::SilhouetteOrder).is_some());
        assert_eq!(plan.reason(&Omitted::Pass(pass)), Some(Reason::DeviceBlendsNoFloats));
        case.settings.depth_precision = DepthPrecision::Bits16;
        assert_eq!(case.good().passes, [Pass::ShadowMap, pass]);
        case.settings.depth_precision = DepthPrecision::Bits32;
        case.device.float32_blendable = true;
    }
}

#[test]
fn a_light_without_size_asks_a_silhouette_map_once() {
    let mut case = Case::new(cube_scene());
    case.settings.technique = Technique::SilhouetteMap(SilhouetteMapSettings { samples: 7, ..Default::default() });
    let samples = |plan: FramePlan| match plan.visibility {
        Some(VisibilityKind::SilhouetteMap { samples, .. }) => samples,
        other => panic!("{other:?}"),
    };
    assert_eq!(samples(case.good()), 7);
    case.views.iter_mut().for_each(|view| view.light_size = 0.0);
    assert_eq!(samples(case.good()), 1);
    case.scene.casters.clear();
    assert_eq!(case.good().reason(&Omitted::SilhouettePasses), Some(Reason::NothingCasts));
}
