use glam::{DMat4, DVec3};

use super::*;
use crate::{
    AlphaRemap, CasterFacts, DepthPrecision, EntryPoints, Light, LightKind, MapSampler, MaskFacts, MeshFacts,
    MeshPiece, ObjectBox, PagedCaster, PoolHoles, Seating, SettingsError, SilhouetteMapSettings, SilhouetteSource,
    SilhouetteWinner, SmoothieBlend, SmoothieSettings, SmoothieWidth, StreamPrecision, Technique, TextureFormat,
    VarianceSettings, views,
};

mod masked;
mod silhouette_maps;

/// A closed cube of 12 faces: 18 edges, 6 of them coplanar diagonals that can be in no silhouette.
const CUBE: MeshFacts = MeshFacts {
    vertices: 8,
    faces: 12,
    two_face_edges: 12,
    other_edges: 0,
    incidence_words: 0,
    vertex_edges: 24,
    is_masked: false,
};

/// A closed torus of a million faces.
const TORUS: MeshFacts = MeshFacts {
    vertices: 500_000,
    faces: 1_000_000,
    two_face_edges: 1_500_000,
    other_edges: 0,
    incidence_words: 0,
    vertex_edges: 3_000_000,
    is_masked: false,
};

/// Looks down at the origin from a height of 10; the sides of its frustum are at 45 degrees.
fn spot(radius: f64) -> View {
    let kind = LightKind::Spot {
        position: DVec3::new(0.0, 10.0, 0.0),
        target: DVec3::ZERO,
        cone_angle: core::f64::consts::FRAC_PI_2,
        radius,
        near: 1.0,
        far: 20.0,
    };
    views(&Light { kind, color: [1.0; 3] }).expect("a good spot")[0]
}

fn caster(name: &str, mesh: usize, world_from_object: DMat4) -> CasterFacts {
    let bounds = Some(ObjectBox { min: [-0.5; 3], max: [0.5; 3], world_from_object });
    CasterFacts { slot: 0, name: name.to_owned(), mesh, bounds, own_position_words: 0 }
}

fn caster_at(name: &str, mesh: usize, place: DVec3) -> CasterFacts {
    caster(name, mesh, DMat4::from_translation(place))
}

fn cube_scene() -> SceneFacts {
    SceneFacts {
        meshes: vec![CUBE],
        pieces: Vec::new(),
        casters: vec![caster_at("cube", 0, DVec3::ZERO)],
        receivers: vec!["floor".to_owned()],
        masks: MaskFacts::default(),
        holes: PoolHoles::default(),
    }
}

fn smoothies(change: impl FnOnce(&mut SmoothieSettings)) -> ShadowSettings {
    let mut smoothies = SmoothieSettings::default();
    change(&mut smoothies);
    ShadowSettings { technique: Technique::Smoothies(smoothies), ..ShadowSettings::default() }
}

struct Case {
    scene: SceneFacts,
    views: Vec<View>,
    all_views: usize,
    settings: ShadowSettings,
    device: DeviceFacts,
    outputs: Outputs,
    capacity: Capacity,
    shared: Vec<BufferKind>,
    made: Vec<BufferPlan>,
}

impl Case {
    fn new(scene: SceneFacts) -> Self {
        Self {
            scene,
            views: vec![spot(0.2)],
            all_views: 0,
            settings: smoothies(|_| ()),
            device: DeviceFacts::default(),
            outputs: Outputs::Maps,
            capacity: Capacity::default(),
            shared: Vec::new(),
            made: Vec::new(),
        }
    }

    fn plan(&self) -> Result<FramePlan, PlanError> {
        let mut scene = self.scene.clone();
        for (slot, caster) in scene.casters.iter_mut().enumerate() {
            caster.slot = slot;
        }
        FramePlan::new(&PlanInput {
            scene: &scene,
            views: &self.views,
            all_views: self.all_views,
            settings: &self.settings,
            device: &self.device,
            outputs: self.outputs,
            capacity: self.capacity,
            shared: &self.shared,
            made: &self.made,
        })
    }

    fn good(&self) -> FramePlan {
        let plan = self.plan().expect("can be planned");
        assert_consistent(&plan);
        plan
    }
}

/// Nothing is missing and nothing is too much: what holds for every plan.
fn assert_consistent(plan: &FramePlan) {
    assert!(
        plan.stages.is_sorted()
            && plan.passes.is_sorted()
            && plan.buffers.is_sorted_by_key(|buffer| (buffer.kind, buffer.page))
    );
    for kind in BufferKind::ALL {
        let bound = plan.stages.iter().any(|stage| stage.buffers().contains(&kind))
            || plan.passes.iter().any(|pass| pass.buffers().contains(&kind))
            || kind == BufferKind::ReceiverView && plan.passes.iter().any(|pass| pass.fills_shadow_map())
            || [BufferKind::LightView, BufferKind::ViewBundle, BufferKind::BundleShapes].contains(&kind)
                && (!plan.stages.is_empty() || plan.passes.iter().any(|pass| pass.fills_shadow_map()));
        assert_eq!(plan.buffer(kind).is_some(), bound, "{}", kind.name());
    }
    for texture in &plan.textures {
        assert!(plan.passes.iter().any(|pass| pass.fills().contains(&texture.kind)));
        assert_eq!(texture.size, plan.settings.map_size);
    }
    let filled: usize = plan.passes.iter().map(|pass| pass.fills().len()).sum();
    assert_eq!(plan.textures.len(), filled);
    assert!(plan.buffers.iter().all(|buffer| buffer.bytes >= buffer.kind.item_bytes()));
    // Whatever does not run has its reason.
    let has_reason = |what: &[Omitted]| what.iter().any(|what| plan.reason(what).is_some());
    for stage in Stage::ALL {
        let groups: &[Omitted] = match stage {
            _ if Stage::PLACEMENT.contains(&stage) => &[Omitted::PlacementStages],
            _ if Stage::DETECTION.contains(&stage) => &[Omitted::DetectionStages],
            Stage::BuildCorners => &[Omitted::ExtrusionStages, Omitted::CornerStage],
            _ => &[Omitted::ExtrusionStages],
        };
        assert_eq!(plan.has_stage(stage), !has_reason(groups), "{}", stage.name());
    }
    for pass in Pass::ALL {
        let mut what = vec![Omitted::Pass(pass)];
        if pass.draws_smoothies() {
            what.push(Omitted::SmoothiePasses);
        }
        if pass.fills_silhouette_map() {
            what.push(Omitted::SilhouettePasses);
        }
        if matches!(pass, Pass::MaskedHardwareShadowMap | Pass::MaskedShadowMap) {
            what.push(Omitted::MaskedPasses);
        }
        assert_eq!(plan.has_pass(pass), !has_reason(&what), "{}", pass.name());
    }
}

fn bytes(plan: &FramePlan, kind: BufferKind) -> Option<u64> {
    plan.buffer(kind).map(|buffer| buffer.bytes)
}

#[test]
fn smoothies_run_everything_in_two_passes() {
    let plan = Case::new(cube_scene()).good();
    assert_eq!(plan.stages, Stage::ALL);
    assert_eq!(plan.passes, [Pass::ShadowMap, Pass::SmoothieDepth, Pass::SmoothieAlpha]);
    assert_eq!(plan.pipelines.len(), 14 + 1 + 2 + 2);
    assert_eq!(plan.reason(&Omitted::Pass(Pass::SmoothieBuffer)), Some(Reason::DeviceBlendsNoFloats));
    assert_eq!(plan.reason(&Omitted::Topology("floor".to_owned())), Some(Reason::ReceivesOnly));
    assert_eq!(plan.reason(&Omitted::InstanceTransforms), Some(Reason::NothingIsInstanced));
    assert_eq!((plan.casting.as_slice(), plan.casts(0), plan.casts(1)), (&[0][..], true, false));
}

#[test]
fn sizes_follow_the_counts() {
    let mut case = Case::new(cube_scene());
    case.scene.casters.push(caster_at("twin", 0, DVec3::X));
    let plan = case.good();
    assert_eq!(bytes(&plan, BufferKind::Positions), Some(8 * 12), "twins share the mesh");
    assert_eq!(bytes(&plan, BufferKind::Faces), Some(12 * 12));
    assert_eq!(bytes(&plan, BufferKind::Planes), Some(12 * 16));
    assert_eq!(bytes(&plan, BufferKind::Edges), Some(12 * 16));
    assert_eq!(bytes(&plan, BufferKind::Incidences), Some(4), "never empty");
    assert_eq!(bytes(&plan, BufferKind::VertexEdges), Some((9 + 2 * 24) * 4));
    assert_eq!(bytes(&plan, BufferKind::Casters), Some(2 * 64));
    assert_eq!(bytes(&plan, BufferKind::CasterPlaces), Some(2 * 224));
    for kind in [BufferKind::FaceBlocks, BufferKind::FaceItems, BufferKind::EdgeBlocks] {
        assert_eq!(bytes(&plan, kind), Some(2 * 12));
    }
    for kind in [BufferKind::FaceTests, BufferKind::EdgeTests] {
        assert_eq!(bytes(&plan, kind), Some(2 * 16));
    }
    assert_eq!(bytes(&plan, BufferKind::ItemArgs), Some(2 * 12));
    assert_eq!(bytes(&plan, BufferKind::Lit), Some(2 * 2 * 4));
    assert_eq!(bytes(&plan, BufferKind::RecheckWords), Some(2 * 2 * 12));
    assert_eq!(bytes(&plan, BufferKind::RecheckArgs), Some(12));
    assert_eq!(bytes(&plan, BufferKind::OutlineSides), Some(2 * 4 * 4));
    assert_eq!(bytes(&plan, BufferKind::Undecided), Some(24 * 8));
    assert_eq!(bytes(&plan, BufferKind::Silhouettes), Some(24 * 16));
    assert_eq!(bytes(&plan, BufferKind::RefineArgs), Some(2 * 12));
    assert_eq!(bytes(&plan, BufferKind::DrawArgs), Some(4 * 16));
    let counts = ViewCounts {
        casters: 2,
        face_blocks: 2,
        edge_blocks: 2,
        undecided: 24,
        silhouettes: 24,
        quads: 24,
        corners: 48,
    };
    assert_eq!(plan.pages[0].counts, counts);
    assert_eq!(plan.texture(TextureKind::ShadowDepth).map(|texture| texture.bytes), Some(1024 * 1024 * 4));
    assert_eq!(plan.texture(TextureKind::SmoothieAlpha).map(|texture| texture.bytes), Some(1024 * 1024 * 2));
}

#[test]
fn callers_positions_come_behind_the_meshes() {
    let mut case = Case::new(cube_scene());
    case.scene.casters[0].own_position_words = 7 * 4 + 3;
    case.scene.casters[0].bounds = None;
    let plan = case.good();
    assert_eq!(bytes(&plan, BufferKind::Positions), Some((24 + 31) * 4));
    assert_eq!(plan.casting, [0], "where it is only the GPU knows");
    assert_eq!(bytes(&plan, BufferKind::Planes), Some(16), "never empty");
    assert_eq!(plan.reason(&Omitted::FacePlanes), Some(Reason::PositionsAreTheCallers));
    case.scene.casters.push(caster_at("rigid", 0, DVec3::ZERO));
    let plan = case.good();
    assert_eq!((bytes(&plan, BufferKind::Planes), plan.reason(&Omitted::FacePlanes)), (Some(12 * 16), None));
}

#[test]
fn floats_that_blend_save_a_pass() {
    let mut case = Case::new(cube_scene());
    case.device.float32_blendable = true;
    let plan = case.good();
    assert_eq!(plan.passes, [Pass::ShadowMap, Pass::SmoothieBuffer]);
    assert_eq!(plan.reason(&Omitted::Pass(Pass::SmoothieAlpha)), Some(Reason::DeviceBlendsFloats));
    assert!(plan.texture(TextureKind::SmoothieDepth).is_none());
    case.settings = smoothies(|smoothies| smoothies.blend = SmoothieBlend::TwoPasses);
    let plan = case.good();
    assert!(plan.has_pass(Pass::SmoothieAlpha));
    assert_eq!(plan.reason(&Omitted::Pass(Pass::SmoothieBuffer)), Some(Reason::TwoPassesAskedFor));
}

#[test]
fn a_shadow_map_needs_no_silhouettes() {
    let mut case = Case::new(cube_scene());
    case.settings.technique = Technique::ShadowMap;
    let plan = case.good();
    assert_eq!(plan.stages, Stage::PLACEMENT);
    assert_eq!(plan.passes, [Pass::HardwareShadowMap]);
    assert_eq!(plan.pages[0].counts.edge_blocks, 0);
    assert_eq!(bytes(&plan, BufferKind::EdgeBlocks), Some(12), "never empty");
    assert_eq!(plan.reason(&Omitted::DetectionStages), Some(Reason::TechniqueHasNoSilhouettes));
    assert_eq!(plan.reason(&Omitted::Pass(Pass::ShadowMap)), Some(Reason::HardwareDepthIsEnough));
    assert!(plan.buffer(BufferKind::Edges).is_none() && plan.buffer(BufferKind::FaceItems).is_some());
}

#[test]
fn each_technique_has_the_maps_that_its_receivers_read() {
    let mut case = Case::new(cube_scene());
    for name in Technique::NAMES {
        case.settings.technique = name.parse().expect("listed");
        let plan = case.good();
        let visibility = plan.visibility.expect("maps are wanted");
        for texture in visibility.textures() {
            assert!(plan.texture(*texture).is_some(), "{name} reads {}", texture.name());
        }
        let only_while_drawn =
            [TextureKind::ShadowHardwareDepth, TextureKind::ShadowDepth, TextureKind::SilhouetteOrder];
        for texture in plan.textures.iter().filter(|texture| !only_while_drawn.contains(&texture.kind)) {
            assert!(visibility.textures().contains(&texture.kind), "{name} fills {}", texture.kind.name());
        }
        let stages = match name {
            "smoothies" => Stage::ALL.to_vec(),
            "silhouette-map" => Stage::ALL.into_iter().filter(|stage| *stage != Stage::BuildCorners).collect(),
            _ => Stage::PLACEMENT.to_vec(),
        };
        assert_eq!(plan.stages, stages, "{name}");
    }
}

#[test]
fn moments_are_as_exact_as_samplers_weigh() {
    let mut case = Case::new(cube_scene());
    let strong = VarianceSettings { warp_exponent: 40.0, ..VarianceSettings::EVSM_PCSS };
    case.settings.technique = Technique::Variance(strong);
    let plan = case.good();
    assert_eq!(plan.passes, [Pass::ShadowMap, Pass::Moments, Pass::BlurredMoments]);
    let format = |plan: &FramePlan| plan.texture(TextureKind::Moments).map(|texture| texture.format);
    assert_eq!(format(&plan), Some(TextureFormat::Rgba16Float));
    assert_eq!(plan.reason(&Omitted::FullMoments), Some(Reason::DeviceFiltersNoFloats));
    assert_ne!(plan.settings, case.settings, "the warp is weaker, and the plan says so");
    case.device.float32_filterable = true;
    let plan = case.good();
    assert_eq!(format(&plan), Some(TextureFormat::Rgba32Float));
    assert_eq!((plan.settings, plan.reason(&Omitted::FullMoments)), (case.settings, None));
}

#[test]
fn halves_need_one_smoothie_pass() {
    let mut case = Case::new(cube_scene());
    case.settings.depth_precision = DepthPrecision::Bits16;
    let plan = case.good();
    assert_eq!(plan.passes, [Pass::ShadowMap, Pass::SmoothieBuffer]);
    assert_eq!(plan.reason(&Omitted::Pass(Pass::SmoothieDepth)), Some(Reason::HalvesBlend));
}

#[test]
fn a_light_without_size_needs_no_search() {
    let mut case = Case::new(cube_scene());
    case.settings.technique = "pcss".parse().expect("listed");
    assert!(matches!(case.good().visibility, Some(VisibilityKind::Pcss { blocker_samples: 16, filter_samples: 32 })));
    case.views = vec![spot(0.0)];
    let plan = case.good();
    assert_eq!(plan.visibility, Some(VisibilityKind::Compared(MapSampler::CompareLinear)));
    assert_eq!(plan.reason(&Omitted::BlockerSearch), Some(Reason::LightHasNoSize));
}

#[test]
fn a_light_without_size_has_hard_shadows() {
    let mut case = Case::new(cube_scene());
    case.views = vec![spot(0.0)];
    let plan = case.good();
    assert_eq!(plan.passes, [Pass::HardwareShadowMap]);
    assert_eq!(plan.visibility, Some(VisibilityKind::Compared(MapSampler::CompareLinear)));
    assert_eq!(plan.reason(&Omitted::SmoothiePasses), Some(Reason::LightHasNoSize));
    case.settings = smoothies(|smoothies| smoothies.width = SmoothieWidth::Ndc(0.02));
    assert_eq!(case.good().stages, Stage::ALL, "a given width needs no light's size");
}

#[test]
fn silhouettes_alone_stop_at_the_list() {
    let mut case = Case::new(cube_scene());
    case.outputs = Outputs::Silhouettes;
    case.scene.casters.push(caster_at("far", 0, DVec3::new(100.0, 0.0, 0.0)));
    for technique in [case.settings.technique, Technique::ShadowMap] {
        case.settings.technique = technique;
        let plan = case.good();
        assert_eq!(plan.stages, Stage::UP_TO_SILHOUETTES);
        assert!(plan.passes.is_empty() && plan.textures.is_empty());
        assert!(plan.buffer(BufferKind::Quads).is_none() && plan.buffer(BufferKind::VertexEdges).is_none());
        assert_eq!(plan.casting, [0, 1], "the list does not end with the frustum");
        assert_eq!(plan.reason(&Omitted::ExtrusionStages), Some(Reason::OnlySilhouettesWanted));
    }
}

#[test]
fn the_visibility_texture_is_a_pass_more() {
    let mut case = Case::new(cube_scene());
    assert_eq!(case.good().reason(&Omitted::Pass(Pass::Visibility)), Some(Reason::NoVisibilityTextureWanted));
    case.outputs = Outputs::VisibilityTexture;
    assert_eq!(case.good().passes.last(), Some(&Pass::Visibility));
}

#[test]
fn casters_that_cannot_cast_have_no_work() {
    let mut case = Case::new(cube_scene());
    case.scene.meshes.push(MeshFacts::default());
    case.scene.casters.extend([
        caster_at("far", 0, DVec3::new(100.0, 0.0, 0.0)),
        caster("flat", 0, DMat4::from_scale(DVec3::new(1.0, 0.0, 1.0))),
        caster_at("empty", 1, DVec3::ZERO),
        caster_at("last", 0, DVec3::new(0.0, 1.0, 0.0)),
    ]);
    let plan = case.good();
    assert_eq!(plan.casting, [0, 4]);
    let ViewCounts { casters, face_blocks, edge_blocks, .. } = plan.pages[0].counts;
    assert_eq!((casters, face_blocks, edge_blocks, plan.singular_casters), (5, 4, 4, 1));
    let reason = |name: &str| plan.reason(&Omitted::CasterWork(name.to_owned()));
    assert_eq!(reason("far"), Some(Reason::OutsideFrustum));
    assert_eq!(reason("flat"), Some(Reason::SingularMatrix));
    assert_eq!(reason("empty"), Some(Reason::NoFaces));
    assert_eq!(reason("last"), None);
    assert_eq!(plan.buffer(BufferKind::FaceItems).map(|buffer| buffer.items), Some(4), "room for all of them");
}

#[test]
fn the_frustum_is_as_wide_as_smoothies_reach() {
    let mut case = Case::new(cube_scene());
    // The nearest corner is at 10.7 of 10 units from the axis, at a depth of 10.5: x / w = 1.07 at its top.
    case.scene.casters[0] = caster_at("beside", 0, DVec3::new(11.2, 0.0, 0.0));
    case.settings = smoothies(|smoothies| smoothies.width = SmoothieWidth::Ndc(0.1));
    assert_eq!(case.good().casting, [0]);
    case.settings = smoothies(|smoothies| smoothies.width = SmoothieWidth::Ndc(0.005));
    assert!(case.good().casting.is_empty());
}

#[test]
fn an_orbiting_light_creates_nothing() {
    let mut case = Case::new(cube_scene());
    case.scene.casters.push(caster_at("sometimes", 0, DVec3::new(100.0, 0.0, 0.0)));
    let before = case.good();
    case.scene.casters[1] = caster_at("sometimes", 0, DVec3::ZERO);
    let after = case.good();
    assert_ne!(before.casting, after.casting);
    assert_eq!((before.buffers, before.textures, before.pipelines), (after.buffers, after.textures, after.pipelines));
}

#[test]
fn an_empty_scene_clears_the_map() {
    for scene in [SceneFacts::default(), SceneFacts { meshes: vec![MeshFacts::default()], ..cube_scene() }] {
        let mut case = Case::new(scene);
        let plan = case.good();
        assert_eq!(plan.passes, [Pass::HardwareShadowMap]);
        assert_eq!(plan.reason(&Omitted::SmoothiePasses), Some(Reason::NothingCasts));
        let ViewCounts { face_blocks, edge_blocks, .. } = plan.pages[0].counts;
        assert_eq!((face_blocks, edge_blocks), (0, 0));
        case.outputs = Outputs::Silhouettes;
        let plan = case.good();
        assert!(plan.stages.is_empty() && plan.buffers.is_empty());
    }
}

#[test]
fn outlines_start_from_the_estimate_and_grow() {
    let mut case = Case::new(SceneFacts { meshes: vec![TORUS], ..cube_scene() });
    let plan = case.good();
    assert_eq!(plan.pages[0].capacity(), Capacity { silhouettes: 44_224, quads: 44_224, corners: 44_224 });
    assert_eq!(plan.pages[0].counts.undecided, 1_000_000, "the list has room for every face");
    let counted =
        contrejour_layout::Counters { silhouette_edges: 44_000, quads: 60_000, corners: 50, ..Default::default() };
    case.capacity = plan.pages[0].capacity().grown_for(&counted);
    let grown = Capacity { silhouettes: 44_224, quads: 75_008, corners: 44_224 };
    assert_eq!(case.good().pages[0].capacity(), grown);
}

#[test]
fn the_remap_is_an_override_constant() {
    let mut case = Case::new(cube_scene());
    for (remap, value) in [(AlphaRemap::Contact, 1.0), (AlphaRemap::Off, 0.0)] {
        case.settings = smoothies(|smoothies| smoothies.remap = remap);
        let plan = case.good();
        let is_raster = |pipeline: &&PipelinePlan| matches!(pipeline.entry_points, EntryPoints::Raster { .. });
        let with_constants = plan.pipelines.iter().filter(is_raster).filter(|pipeline| !pipeline.constants.is_empty());
        let with_constants: Vec<_> = with_constants.collect();
        assert_eq!(with_constants.len(), 4);
        assert!(with_constants.iter().all(|pipeline| pipeline.constants == [("remap_alpha", value)]));
    }
}

#[test]
fn bundles_of_one_view_have_a_pipeline_that_does_nothing_for_others() {
    let mut case = Case::new(cube_scene());
    for (views, expected) in [(1, vec![("one_seat", 1.0)]), (8, vec![("one_seat", 1.0), ("one_seat", 0.0)])] {
        case.all_views = views;
        let is_it = |pipeline: &&PipelinePlan| pipeline.entry_points == EntryPoints::Compute(Stage::ClassifyFaces);
        let pipelines = case.good().pipelines;
        let constants = pipelines.iter().filter(is_it).flat_map(|pipeline| pipeline.constants.clone());
        assert_eq!(constants.collect::<Vec<_>>(), expected);
    }
}

#[test]
fn what_the_device_cannot_hold_is_an_error() {
    let mut case = Case::new(SceneFacts { meshes: vec![TORUS], ..cube_scene() });
    case.device.max_storage_buffer_binding_size = 20_000_000;
    let error = case.plan().expect_err("24 MB of edges");
    let edges = PlanError::BufferTooLarge {
        buffer: BufferKind::Edges,
        needed: 24_000_000,
        limit: 20_000_000,
        limit_name: "max_storage_buffer_binding_size",
    };
    assert_eq!(error, edges);
    assert!(error.to_string().contains("request the device with a larger max_storage_buffer_binding_size"));
    case.device = DeviceFacts { max_texture_dimension_2d: 512, ..DeviceFacts::default() };
    assert_eq!(case.plan(), Err(PlanError::MapTooLarge { map_size: 1024, limit: 512 }));
    case.outputs = Outputs::Silhouettes;
    assert!(case.plan().is_ok(), "no maps, no limit");
    case.device.max_buffer_size = 1_000_000;
    assert!(matches!(case.plan(), Err(PlanError::BufferTooLarge { limit_name: "max_buffer_size", .. })));
}

#[test]
fn what_32_bits_cannot_count_is_an_error() {
    let mesh = MeshFacts { vertices: 1_000_000_000, ..CUBE };
    let mut case = Case::new(SceneFacts { meshes: vec![mesh, mesh], ..cube_scene() });
    case.device = DeviceFacts { max_storage_buffer_binding_size: u64::MAX, max_buffer_size: u64::MAX, ..case.device };
    let needed = 6_000_000_000;
    assert_eq!(case.plan(), Err(PlanError::TooManyRecords { buffer: BufferKind::Positions, needed }));
}

/// The torus in two pieces of about two thirds and one third of its edges; its faces are all in the first.
fn torus_pieces() -> [MeshPiece; 2] {
    let first_edge = 1_000_000 / 64 * 64;
    let whole = MeshPiece::whole(0, &TORUS);
    let first = MeshPiece { two_face_edges: first_edge, vertex_edges: 2_010_000, ..whole };
    let two_face_edges = whole.two_face_edges - first_edge;
    [first, MeshPiece { faces: 0, first_edge, two_face_edges, vertex_edges: 1_010_000, ..whole }]
}

fn check_limits(plan: &FramePlan, limit: u64) {
    for buffer in &plan.buffers {
        assert!(buffer.bytes <= limit, "{} of page {} has {} bytes", buffer.kind.name(), buffer.page, buffer.bytes);
    }
}

#[test]
fn a_mesh_in_pieces_fills_pages() {
    let mut case = Case::new(SceneFacts { meshes: vec![TORUS], ..cube_scene() });
    case.scene.pieces = torus_pieces().to_vec();
    let whole = case.good();
    assert_eq!((whole.pages.len(), whole.pages[0].pieces[0]), (1, MeshPiece::whole(0, &TORUS)), "it fits as it is");
    let limit = 20_000_000;
    case.device.max_storage_buffer_binding_size = limit;
    let plan = case.good();
    check_limits(&plan, limit);
    assert_eq!(
        plan.pages.iter().map(|page| page.pieces.as_slice()).collect::<Vec<_>>(),
        torus_pieces().each_ref().map(std::slice::from_ref)
    );
    assert!(plan.pages.iter().all(|page| page.casters == [PagedCaster { caster: 0, piece: 0 }]));
    let items = |items: fn(&ViewCounts) -> u32| plan.pages.iter().map(|page| items(&page.counts)).collect::<Vec<_>>();
    assert_eq!(items(|counts| counts.face_blocks), [15_625, 0]);
    assert_eq!(items(|counts| counts.edge_blocks), [15_625, 7_813]);
    assert_eq!(items(|counts| counts.silhouettes), [44_224, 44_224], "a whole outline may lie on each");
    assert_eq!(bytes(&plan, BufferKind::Lit), Some(15_625 * 8), "lit bits are those of the whole mesh");
    let print = plan.to_string();
    assert!(print.contains("pages: 2\n") && print.contains("edges, page 1"), "{print}");
    case.settings.technique = Technique::ShadowMap;
    assert_eq!(case.good().pages.len(), 1, "faces alone fit");
}

#[test]
fn many_meshes_fill_pages() {
    let meshes: Vec<_> = (0..40).map(|_| CUBE).collect();
    let casters = (0..80).map(|index| caster_at("cube", index % 40, DVec3::ZERO)).collect();
    let mut case = Case::new(SceneFacts { meshes, casters, ..cube_scene() });
    assert_eq!(case.good().pages.len(), 1);
    // Corners need 12 edges x 2 ends x 56 bytes for each caster, and places of all casters are in one buffer.
    let limit = 18_000;
    case.device.max_storage_buffer_binding_size = limit;
    let plan = case.good();
    check_limits(&plan, limit);
    assert_eq!(plan.pages.len(), 7);
    let mut cast: Vec<_> = plan.pages.iter().flat_map(|page| &page.casters).map(|here| here.caster).collect();
    cast.sort_unstable();
    assert_eq!(cast, (0..80).collect::<Vec<_>>(), "each caster is on one page");
    for page in &plan.pages {
        for here in &page.casters {
            assert_eq!(page.pieces[here.piece].mesh, here.caster % 40);
        }
    }
}

#[test]
fn bad_input_is_an_error() {
    let mut case = Case::new(cube_scene());
    case.settings.map_size = 0;
    assert_eq!(case.plan(), Err(PlanError::Settings(SettingsError::NoTexels)));
    let mut case = Case::new(cube_scene());
    case.scene.casters[0].mesh = 3;
    assert_eq!(case.plan(), Err(PlanError::UnknownMesh { caster: 0, mesh: 3, meshes: 1 }));
}

#[test]
fn the_print_shows_all_of_it() {
    let plan = Case::new(cube_scene()).good();
    let print = plan.to_string();
    for stage in &plan.stages {
        assert!(print.contains(stage.name()));
    }
    for buffer in &plan.buffers {
        assert!(print.contains(buffer.kind.name()));
    }
    for line in [
        "technique: smoothies, 1024 texels",
        "  shadow_depth           1024 x 1024 r32float      4.0 MiB",
        "  quads          12 x 64 B   768 B",
        "  topology of floor         it only receives",
    ] {
        assert!(print.lines().any(|printed| printed == line), "no line \"{line}\" in\n{print}");
    }
    assert!(print.lines().all(|line| line == line.trim_end()));
}

#[cfg(feature = "serde")]
#[test]
fn a_plan_is_json() {
    let json = serde_json::to_value(Case::new(cube_scene()).good()).expect("plain data");
    assert_eq!(json["stages"][0], "place_casters");
    assert_eq!(json["passes"][2], "smoothie_alpha");
    assert_eq!(json["buffers"][0]["kind"], "positions");
    assert_eq!(json["settings"]["technique"]["smoothies"]["width"], "from-light-size");
    assert_eq!(json["left_out"][0]["reason"], "technique_has_no_silhouette_map");
}

#[test]
fn six_views_have_a_layer_each() {
    let mut case = Case::new(cube_scene());
    case.views = vec![spot(0.2); 6];
    let plan = case.good();
    let layers: Vec<_> = plan.textures.iter().map(|texture| (texture.kind, texture.layers)).collect();
    let kept = [TextureKind::ShadowDepth, TextureKind::SmoothieDepth, TextureKind::SmoothieAlpha];
    assert!(layers.iter().all(|(kind, layers)| *layers == if kept.contains(kind) { 6 } else { 1 }), "{layers:?}");
    assert_eq!(bytes(&plan, BufferKind::LightView), Some(6 * 256));
    assert_eq!(bytes(&plan, BufferKind::ReceiverView), Some(6 * 176));
    case.settings.technique = "vsm".parse().expect("listed");
    let plan = case.good();
    let layers = |kind| plan.texture(kind).map(|texture| texture.layers);
    assert_eq!((layers(TextureKind::Moments), layers(TextureKind::ShadowDepth)), (Some(6), Some(1)));
}

#[test]
fn fragments_write_the_depth_of_casters_in_front() {
    let fragments = |technique: &str, view: View| {
        let mut case = Case::new(cube_scene());
        case.views = vec![view; 3];
        case.settings.technique = technique.parse().expect("listed");
        let fragments = case.good().pipelines.into_iter().filter_map(|pipeline| match pipeline.entry_points {
            EntryPoints::Raster { fragment, .. } => Some(fragment),
            EntryPoints::Compute(_) => None,
        });
        fragments.collect::<Vec<_>>()
    };
    let pancaked = View { casters_in_front: CastersInFront::Pancaked, ..spot(0.2) };
    let found = fragments("smoothies", pancaked);
    let expected = ["fragment_pancaked_shadow_map", "fragment_pancaked_smoothie_depth", "fragment_smoothie_alpha"];
    assert!(expected.iter().all(|name| found.contains(&Some(name))), "{found:?}");
    assert!(fragments("smoothies", spot(0.2)).iter().flatten().all(|name| !name.contains("pancaked")));
    assert_eq!(fragments("pcf", pancaked), [Some("fragment_pancaked_hardware_depth")]);
    assert_eq!(fragments("pcf", spot(0.2)), [None]);
}

#[test]
fn lights_that_share_lists_list_the_same() {
    let mut case = Case::new(cube_scene());
    let smoothies = case.good();
    case.settings.technique = Technique::ShadowMap;
    case.shared = smoothies.buffers.iter().map(|buffer| buffer.kind).collect();
    let plan = case.plan().expect("can be planned");
    let shared = |plan: &FramePlan| -> Vec<BufferPlan> {
        plan.buffers.iter().filter(|buffer| !buffer.kind.is_of_light()).copied().collect()
    };
    assert_eq!(shared(&plan), shared(&smoothies));
    assert_eq!((&plan.pages, plan.stages.as_slice()), (&smoothies.pages, Stage::PLACEMENT));
}

#[test]
fn holes_have_room_in_pools_and_lists_of_blocks_alone() {
    let mut case = Case::new(cube_scene());
    let before = case.good();
    case.scene.holes = PoolHoles {
        position_words: 1,
        faces: 2,
        edges: 3,
        incidence_words: 4,
        vertex_edge_words: 5,
        face_blocks: 6,
        edge_blocks: 7,
    };
    let after = case.good();
    let items = |plan: &FramePlan, kind| plan.buffer(kind).map_or(0, |buffer| buffer.items);
    let larger_by = |kind| items(&after, kind) - items(&before, kind);
    let larger = BufferKind::ALL.into_iter().map(|kind| (kind, larger_by(kind))).filter(|(_, more)| *more > 0);
    let expected = [
        (BufferKind::Positions, 1),
        (BufferKind::Faces, 2),
        (BufferKind::Planes, 2),
        (BufferKind::Edges, 3),
        (BufferKind::Incidences, 4),
        (BufferKind::VertexEdges, 5),
        (BufferKind::FaceBlocks, 6),
        (BufferKind::EdgeBlocks, 7),
        (BufferKind::FaceItems, 6),
        (BufferKind::Lit, 12),
        (BufferKind::OutlineSides, 28),
    ];
    assert_eq!(larger.collect::<Vec<_>>(), expected);
    let ViewCounts { face_blocks, edge_blocks, .. } = after.pages[0].counts;
    assert_eq!((face_blocks, edge_blocks), (7, 8), "stages look for blocks in the holes too");
}

#[test]
fn buffers_grow_by_half_and_are_kept() {
    let mut case = Case::new(cube_scene());
    let shared = |plan: &FramePlan| -> Vec<BufferPlan> {
        plan.buffers.iter().filter(|buffer| !buffer.kind.is_of_light()).copied().collect()
    };
    let first = case.good();
    case.made = shared(&first);
    assert_eq!(shared(&case.good()), case.made, "what has room stays");
    case.scene.casters.extend((0..9).map(|_| caster_at("more", 0, DVec3::ZERO)));
    let grown = case.good();
    for (before, after) in first.buffers.iter().zip(&grown.buffers).filter(|(before, _)| !before.kind.is_of_light()) {
        let exact = Case::new(case.scene.clone()).good();
        let needed = exact.buffer(after.kind).map_or(0, |buffer| buffer.items);
        let expected = if needed > before.items { needed + needed / 2 } else { before.items };
        assert_eq!((after.items, after.bytes), (expected, expected.max(1) * after.kind.item_bytes()), "{after:?}");
    }
    assert_eq!(grown.pages[0].counts.silhouettes, 180, "lists say how much room they have");
    assert_eq!(grown.pages[0].counts.face_blocks, 10, "no stage looks for blocks in the room that is left");
    case.made = shared(&grown);
    case.scene.casters.truncate(1);
    assert_eq!(shared(&case.good()), case.made, "what shrank is kept");
}

#[test]
fn lists_that_were_too_short_grow_as_far_as_was_counted() {
    let mut case = Case::new(SceneFacts { meshes: vec![TORUS], ..cube_scene() });
    let first = case.good();
    case.made = first.buffers.clone();
    let counted = contrejour_layout::Counters { quads: 60_000, ..Default::default() };
    case.capacity = first.pages[0].capacity().grown_for(&counted);
    let grown = Case { made: Vec::new(), ..case };
    let (exact, case) = (grown.good(), Case { made: first.buffers, ..grown });
    assert_eq!(case.good().buffers, exact.buffers);
}

#[test]
fn planes_that_were_made_stay() {
    let mut case = Case::new(cube_scene());
    case.made = case.good().buffers;
    case.scene.casters[0].own_position_words = 24;
    let plan = case.good();
    assert_eq!((plan.reason(&Omitted::FacePlanes), bytes(&plan, BufferKind::Planes)), (None, Some(12 * 16)));
}

#[test]
fn pages_are_as_large_as_they_must_be() {
    let mut case = Case::new(SceneFacts { meshes: vec![TORUS], ..cube_scene() });
    case.scene.pieces = torus_pieces().to_vec();
    case.device.max_storage_buffer_binding_size = 20_000_000;
    let exact = case.good();
    case.made = Case::new(cube_scene()).good().buffers;
    assert_eq!(case.good().buffers, exact.buffers, "one page before");
    case.made = exact.buffers.clone();
    case.scene.meshes[0] = CUBE;
    case.scene.pieces.clear();
    assert_eq!(case.good().buffers, Case { made: Vec::new(), ..case }.good().buffers, "several pages before");
}

#[test]
fn seats_have_whole_records_that_can_be_bound() {
    for casters in 1..40 {
        let mut case = Case::new(cube_scene());
        case.scene.casters.extend((1..casters).map(|_| caster_at("more", 0, DVec3::ZERO)));
        let alone = case.good();
        assert!(alone.seats == 1 && alone.buffers.iter().all(|buffer| buffer.seats == 1));
        for (views, seats) in [(2, 2), (3, 4), (8, 8), (100, 8)] {
            case.all_views = views;
            let plan = case.good();
            assert_eq!((plan.seats, &plan.pages), (seats, &alone.pages), "room for each view is what one alone has");
            for (buffer, alone) in plan.buffers.iter().zip(&alone.buffers) {
                let BufferPlan { kind, items, seats: had, bytes, .. } = *buffer;
                assert_eq!((kind, items), (alone.kind, alone.items));
                match kind.seating() {
                    Seating::None => assert_eq!((had, bytes), (1, alone.bytes), "{}", kind.name()),
                    Seating::SideBySide => assert_eq!((had, bytes), (seats, alone.bytes * u64::from(seats))),
                    Seating::Apart => {
                        let stride = buffer.stride();
                        assert_eq!((had, bytes), (seats, stride * u64::from(seats)), "{}", kind.name());
                        assert!(stride >= alone.bytes && stride.is_multiple_of(256), "{}", kind.name());
                        assert!(stride.is_multiple_of(kind.item_bytes()), "{} is cut", kind.name());
                    }
                }
            }
        }
    }
}

#[test]
fn as_many_views_are_tested_together_as_have_room() {
    let mut case = Case::new(SceneFacts { meshes: vec![TORUS], ..cube_scene() });
    case.all_views = 8;
    case.device.max_storage_buffer_binding_size = u64::MAX;
    case.device.max_buffer_size = u64::MAX;
    let reason = |plan: &FramePlan| plan.reason(&Omitted::TestsTogether);
    let seats = |faces: u32| {
        let mut case = Case { scene: case.scene.clone(), settings: case.settings, ..Case::new(cube_scene()) };
        (case.all_views, case.scene.meshes[0].faces) = (8, faces);
        case.scene.meshes[0].two_face_edges = faces * 3 / 2;
        case.device =
            DeviceFacts { max_storage_buffer_binding_size: u64::MAX, max_buffer_size: u64::MAX, ..case.device };
        let plan = case.good();
        assert_eq!(reason(&plan), (plan.seats < 8).then_some(Reason::ListsAreTooLarge), "{faces}");
        let bytes = plan.buffers.iter().filter(|buffer| buffer.kind.seating() != Seating::None);
        assert!(plan.seats == 1 || bytes.map(|buffer| buffer.bytes).sum::<u64>() <= 192 << 20);
        plan.seats
    };
    assert_eq!([1000, 2_000_000, 3_000_000, 6_000_000, 12_000_000].map(seats), [8, 8, 4, 2, 1]);
    // One list may be too large before all of them are.
    case.scene.meshes[0] =
        MeshFacts { faces: 100_000, two_face_edges: 150_000, vertices: 50_000, vertex_edges: 300_000, ..TORUS };
    assert_eq!(case.good().seats, 8);
    case.device.max_storage_buffer_binding_size = 100_000 * 8 * 7 / 2;
    assert_eq!((case.good().seats, reason(&case.good())), (2, Some(Reason::ListsAreTooLarge)));
    // What was made for more views is kept.
    case.all_views = 1;
    assert_eq!(case.good().seats, 1);
    case.all_views = 2;
    case.made = case.good().buffers.into_iter().filter(|buffer| !buffer.kind.is_of_light()).collect();
    case.all_views = 1;
    assert_eq!(case.good().seats, 2);
}

#[test]
fn room_to_grow_takes_no_seats() {
    for limit in [128 << 20, 1 << 40] {
        let mut case = Case::new(SceneFacts { meshes: vec![TORUS], ..cube_scene() });
        case.all_views = 8;
        (case.device.max_storage_buffer_binding_size, case.device.max_buffer_size) = (limit, limit);
        let shared = |plan: FramePlan| -> Vec<BufferPlan> {
            plan.buffers.into_iter().filter(|buffer| !buffer.kind.is_of_light()).collect()
        };
        case.made = shared(case.good());
        // A second torus of a million faces less some: together they have just room.
        case.scene.meshes.push(MeshFacts { faces: 950_000, two_face_edges: 1_425_000, ..TORUS });
        case.scene.casters.push(caster_at("second", 1, DVec3::ZERO));
        let grown = case.good();
        let undecided = |plan: &FramePlan| plan.buffer(BufferKind::Undecided).map_or(0, |buffer| buffer.items);
        assert_eq!(grown.seats, 8, "of {limit} bytes");
        assert!(undecided(&grown) > 2_000_000, "{} faces have room", undecided(&grown));
        case.made = shared(grown.clone());
        assert_eq!(shared(case.good()), case.made, "what has room stays");
    }
}
