//! Silhouette maps are as defined, and all sources leave the same one: the compute stages, which are exact, and the vertex
//! stage, as topology-aware meshes do it, by what is across the edges of faces or by a stream of normals.
//!
//! For every mesh under eight lights, two of them wide, each texel holds depth and signed distance of the nearest silhouette
//! that the light reaches, as worked out in 64-bit floats from the twins' quads: the distance up to [`DISTANCE_ROUNDING`], the
//! depth up to [`DEPTH_ROUNDING`], and along the silhouette the one may be off as far as the other makes it. Two kinds of texels
//! are left open, and counted:
//!
//! - **Ties**, for all sources: silhouettes that are equally far, and those on the brink of where distances are drawn, or as
//!   deep as what hides them. Rounding decides, and each outcome is as good.
//! - **By facing**, for the vertex stage: texels within reach of an edge at a face that the light sees edge-on up to
//!   [`FACING_ROUNDING`], since that stage asks in floats, or of an edge beside faces without area that have no sign, which it
//!   draws whatever the light or not at all. For a stream, which asks faces in pairs, also of an edge of more than two that
//!   has some on each side. [`MOST_BY_FACING`] of a mesh's texels may be such, but under lights that see all of a flat mesh
//!   edge-on; of a stream's where the mesh has no edge of more than two.
//!
//! [`FACING_ROUNDING`]: crate::silhouette_doubts::FACING_ROUNDING

use contrejour_gpu::ShadowOptions;
use contrejour_layout::INCIDENCE_LIST;
use contrejour_plan::{
    Light, ShadowSettings, SilhouetteMapSettings, SilhouetteSource, StreamPrecision, Technique, View, frame_views,
    views,
};
use contrejour_tests::frame::Frame;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, cpu_trial, float_blending_trial, gpu_trial};
use contrejour_tests::lights::{lights, widened};
use contrejour_tests::meshes::{self, TestMesh};
use contrejour_tests::pipeline::Pipeline;
use contrejour_tests::silhouette_texels::{Candidate, Definition, Expected, SilhouetteTexel};
use contrejour_tests::texture::read_floats;
use libtest_mimic::Trial;

use crate::silhouette_doubts::{Doubtful, near_doubtful_edges};

const MAP_SIZE: u32 = 128;

/// In texels.
const DISTANCE_ROUNDING: f64 = 2e-3;

/// Of the depth, and of all depths of a view together.
const DEPTH_ROUNDING: [f64; 2] = [1e-4, 1e-6];

/// Of the texels of a mesh that are certain.
const MOST_BY_FACING: f64 = 0.1;

pub fn trials() -> Vec<Trial> {
    let mut trials: Vec<_> = meshes::all()
        .iter()
        .map(|mesh| {
            let name = format!("silhouette_maps::as_defined_from_all_sources::{}", mesh.name);
            gpu_trial(name, |gpu| as_defined_from_all_sources(gpu, mesh))
        })
        .collect();
    trials.push(float_blending_trial(
        "silhouette_maps::blended_ones_hold_the_least_distance",
        blended_ones_hold_the_least_distance,
    ));
    trials.push(cpu_trial(
        "silhouette_maps::comparer_of_blended_ones_finds_planted_faults",
        comparer_of_blended_ones_finds_planted_faults,
    ));
    trials.push(cpu_trial("silhouette_maps::comparer_finds_planted_faults", comparer_finds_planted_faults));
    trials
}

const SOURCES: [SilhouetteSource; 3] =
    [SilhouetteSource::Stages, SilhouetteSource::Faces, SilhouetteSource::Stream(StreamPrecision::Bits32)];

pub type Map = Vec<Option<SilhouetteTexel>>;

/// Texels of each kind.
#[derive(Debug, Default)]
pub struct Counts {
    empty: usize,
    certain: usize,
    ties: usize,
    by_facing: usize,
    /// The same where the light is in the plane of all there is.
    of_flat: usize,
}

impl Counts {
    pub fn has_certain(&self) -> bool {
        self.certain > 0
    }

    /// Nothing is certain where no face has an area.
    pub fn explains_too_much(&self) -> bool {
        self.certain > 0 && self.by_facing as f64 > MOST_BY_FACING * self.certain as f64
    }
}

fn as_defined_from_all_sources(gpu: &Gpu, mesh: &TestMesh) -> Outcome {
    let all = lights(mesh);
    let narrow = [0, 8, 12, 13, 26, 30].map(|index| all[index]);
    let wide = [3, 20].map(|index| widened(&all[index]));
    let counts = compare_sources(gpu, mesh, narrow.into_iter().chain(wide), MAP_SIZE)?;
    // A stream asks the faces around an edge in pairs.
    let asks_pairs = mesh.parts.iter().flat_map(|part| &part.topology.edges).any(|edge| edge.first == INCIDENCE_LIST);
    let [_, faces, stream] = &counts;
    if faces.explains_too_much() || (stream.explains_too_much() && !asks_pairs) {
        return Err(format!("too many texels are explained: {counts:?}"));
    }
    Ok(())
}

/// Holds the maps of all sources, of all views of these lights, against the definition; what was found from each source.
pub fn compare_sources(
    gpu: &Gpu,
    mesh: &TestMesh,
    lights: impl IntoIterator<Item = Light>,
    map_size: u32,
) -> Result<[Counts; 3], String> {
    let mut drawn = SOURCES.map(|source| Drawn::new(gpu, mesh, settings(source, map_size)));
    let mut counts: [Counts; 3] = Default::default();
    for light in lights {
        let views =
            frame_views(&light, None, &settings(SOURCES[0], map_size)).map_err(|error| error.to_string())?.views;
        let mut expected = None;
        for ((drawn, counts), source) in drawn.iter_mut().zip(&mut counts).zip(SOURCES) {
            let drawn = drawn.as_mut().map_err(|error| error.clone())?;
            let maps = match drawn.maps(&light, &views)? {
                Some(maps) => maps,
                None if expected.is_none() => continue,
                None => return Err(format!("{source:?} has no map where the stages have one")),
            };
            let expected = match &mut expected {
                Some(expected) => &*expected,
                none => none.insert(drawn.definitions(mesh, &views)?),
            };
            for ((map, expected), view) in maps.iter().zip(expected).zip(&views) {
                let doubtful = || near_doubtful_edges(mesh, view, source, map_size).or_hidden();
                compare(map, expected, view.far_depth, doubtful, counts)
                    .map_err(|difference| format!("{source:?}, {:?}: {difference}", light.kind))?;
            }
        }
    }
    let [stages, faces, stream] = &counts;
    eprintln!("{} faces, {}: stages {stages:?}, faces {faces:?}, stream {stream:?}", mesh.face_count(), mesh.name);
    Ok(counts)
}

/// A mesh whose silhouettes come from one source.
struct Drawn<'a> {
    gpu: &'a Gpu,
    settings: ShadowSettings,
    pipeline: Pipeline<'a>,
}

pub fn settings(source: SilhouetteSource, map_size: u32) -> ShadowSettings {
    let technique = Technique::SilhouetteMap(SilhouetteMapSettings { source, ..Default::default() });
    ShadowSettings { technique, map_size, ..Default::default() }
}

impl<'a> Drawn<'a> {
    fn new(gpu: &'a Gpu, mesh: &TestMesh, settings: ShadowSettings) -> Result<Self, String> {
        let options = ShadowOptions { settings, ..Default::default() };
        Ok(Self { gpu, settings, pipeline: Pipeline::new(gpu, mesh, &options)? })
    }

    /// The maps of a light, view by view; `None` where nothing casts.
    fn maps(&mut self, light: &Light, views: &[View]) -> Result<Option<Vec<Map>>, String> {
        self.pipeline.complete_frame(light)?;
        let Some(texture) = self.pipeline.maps().silhouette_map else { return Ok(None) };
        let floats = read_floats(self.gpu, texture);
        if floats.len() != 2 * self.texels() * views.len() {
            return Err(format!("{} floats for {} views", floats.len(), views.len()));
        }
        Ok(Some(floats.chunks(2 * self.texels()).zip(views).map(|(floats, view)| map_of(floats, view)).collect()))
    }

    /// What the maps of the last frame may hold, by the twins' quads and the device's shadow maps.
    fn definitions(&self, mesh: &TestMesh, views: &[View]) -> Result<Vec<Vec<Expected>>, String> {
        let texture = self.pipeline.maps().shadow_depth.ok_or("there is no shadow map")?;
        let depths = read_floats(self.gpu, texture);
        let definition = |(shadow_depth, view): (&[f32], &View)| {
            let mut frame = Frame::of_view(&mesh.parts, view, &self.settings);
            frame.run_mirrors("place_casters", "write_draw_args");
            Definition { record: frame.view(), shadow_depth }.texels(frame.made_quads())
        };
        Ok(depths.chunks(self.texels()).zip(views).map(definition).collect())
    }

    /// Of a view.
    fn texels(&self) -> usize {
        (self.settings.map_size * self.settings.map_size) as usize
    }
}

/// What the two floats of each texel say.
pub fn map_of(floats: &[f32], view: &View) -> Map {
    let texel = |texel: &[f32]| {
        let [depth, signed_distance] = [texel[0], texel[1]].map(f64::from);
        (texel[0] < view.far_depth as f32).then_some(SilhouetteTexel { depth, signed_distance })
    };
    floats.chunks_exact(2).map(texel).collect()
}

pub fn compare(
    map: &Map,
    expected: &[Expected],
    far_depth: f64,
    doubtful: impl Fn() -> Doubtful,
    counts: &mut Counts,
) -> Outcome {
    if map.len() != expected.len() {
        return Err(format!("{} texels of {}", map.len(), expected.len()));
    }
    let mut near_doubtful = None;
    for (index, (texel, expected)) in map.iter().zip(expected).enumerate() {
        let is_one_of_them = match texel {
            None => !expected.is_certain,
            Some(texel) => expected.candidates.iter().any(|candidate| is_alike(candidate, texel, far_depth)),
        };
        match (is_one_of_them, expected.candidates.len()) {
            (true, 0) => counts.empty += 1,
            (true, 1) if expected.is_certain => counts.certain += 1,
            (true, _) => counts.ties += 1,
            (false, _) if near_doubtful.get_or_insert_with(&doubtful).explains(index, texel, expected) => {
                let is_flat = near_doubtful.as_ref().is_some_and(|doubtful| doubtful.is_flat);
                *(if is_flat { &mut counts.of_flat } else { &mut counts.by_facing }) += 1;
            }
            (false, _) => return Err(format!("texel {index}: {texel:?}, and not {expected:?}")),
        }
    }
    Ok(())
}

fn is_alike(candidate: &Candidate, found: &SilhouetteTexel, far_depth: f64) -> bool {
    let &Candidate { texel, depth_per_texel, is_cut_by_depth } = candidate;
    let of_depth = DEPTH_ROUNDING[0] * texel.depth.abs() + DEPTH_ROUNDING[1] * far_depth;
    // What moves along the silhouette by the one rounding may be as much deeper there, and the other way round.
    let depth_rounding = of_depth + DISTANCE_ROUNDING * depth_per_texel;
    let of_cut = if is_cut_by_depth { of_depth / depth_per_texel } else { 0.0 };
    (texel.signed_distance - found.signed_distance).abs() <= DISTANCE_ROUNDING + of_cut
        && (texel.depth - found.depth).abs() <= depth_rounding
}

/// Blending leaves the distance of the nearest silhouette, without its side, and a depth that is not more than its depth.
fn blended_ones_hold_the_least_distance(gpu: &Gpu) -> Outcome {
    for mesh in meshes::shapes() {
        let light = &lights(&mesh)[8];
        let views = views(light).map_err(|error| error.to_string())?;
        for source in SOURCES {
            let by_depth = settings(source, MAP_SIZE);
            let mut by_blending = by_depth;
            by_blending.technique.set("blending", 1.0).map_err(|error| error.to_string())?;
            let [exact, blended] = [by_depth, by_blending].map(|settings| {
                Drawn::new(gpu, &mesh, settings)?.maps(light, &views)?.ok_or("nothing casts".to_owned())
            });
            compare_blended(&blended?[0], &exact?[0])
                .map_err(|difference| format!("{}, {source:?}: {difference}", mesh.name))?;
        }
    }
    Ok(())
}

fn compare_blended(blended: &Map, exact: &Map) -> Outcome {
    let is_least = |blended: &SilhouetteTexel, exact: &SilhouetteTexel| {
        (blended.signed_distance - exact.signed_distance.abs()).abs() <= DISTANCE_ROUNDING
            && blended.depth <= exact.depth
    };
    for (index, texels) in blended.iter().zip(exact).enumerate() {
        let is_good = match texels {
            (Some(blended), Some(exact)) => is_least(blended, exact),
            (None, None) => true,
            _ => false,
        };
        if !is_good {
            return Err(format!("texel {index}: {texels:?}"));
        }
    }
    Ok(())
}

fn comparer_of_blended_ones_finds_planted_faults() -> Outcome {
    let texel = |depth: f64, signed_distance: f64| Some(SilhouetteTexel { depth, signed_distance });
    let exact: Map = vec![None, texel(2.0, -0.5)];
    compare_blended(&vec![None, texel(1.5, 0.5)], &exact)?;
    let faults = [
        vec![texel(2.0, 0.5), texel(2.0, 0.5)],
        vec![None, None],
        vec![None, texel(2.0, -0.5)],
        vec![None, texel(2.0, 0.6)],
        vec![None, texel(2.1, 0.5)],
        vec![None, texel(f64::NAN, 0.5)],
    ];
    match faults.into_iter().find(|fault| compare_blended(fault, &exact).is_ok()) {
        Some(fault) => Err(format!("not found: {fault:?}")),
        None => Ok(()),
    }
}

fn comparer_finds_planted_faults() -> Outcome {
    let texel = |depth: f64, signed_distance: f64| SilhouetteTexel { depth, signed_distance };
    let candidate = |depth: f64, signed_distance: f64| Candidate {
        texel: texel(depth, signed_distance),
        depth_per_texel: 0.2,
        is_cut_by_depth: false,
    };
    let one = Expected { candidates: vec![candidate(2.0, -0.5)], is_certain: true, is_in_least_band: true };
    let two = Expected {
        candidates: vec![candidate(2.0, -0.5), candidate(3.0, 0.5)],
        is_certain: true,
        is_in_least_band: true,
    };
    let brink = Expected { is_certain: false, is_in_least_band: false, ..one.clone() };
    let expected = [Expected::default(), one, two, brink];
    let good: Map = vec![None, Some(texel(2.0, -0.5)), Some(texel(3.0, 0.5)), None];
    let compared = |map: &Map, [another, none]: [&[usize]; 2]| {
        let set = |texels: &[usize]| texels.iter().copied().collect();
        let doubtful = || Doubtful { another: set(another), none: set(none), is_flat: false };
        compare(map, &expected, 9.0, doubtful, &mut Counts::default())
    };
    compared(&good, [&[]; 2])?;
    let planted = [
        (0, Some(texel(2.0, -0.5))),
        (1, None),
        (1, Some(texel(2.0, 0.5))),
        (1, Some(texel(2.0, -0.51))),
        (1, Some(texel(2.001, -0.5))),
        (1, Some(texel(f64::NAN, -0.5))),
        (2, Some(texel(3.0, -0.5))),
        (2, None),
        (3, Some(texel(2.0, 0.0))),
    ];
    for (index, fault) in planted {
        let mut map = good.clone();
        map[index] = fault;
        if compared(&map, [&[]; 2]).is_ok() {
            return Err(format!("texel {index}: {fault:?} was not found"));
        }
        if compared(&map, [&[index], &[]]).is_ok() == fault.is_none() {
            return Err(format!("texel {index}: beside a face seen edge-on {fault:?} may be, but no hole"));
        }
        compared(&map, [&[], &[index]])
            .map_err(|error| format!("beside no face with an area it may be so: {error}"))?;
    }
    if compared(&good[1..].to_vec(), [&[]; 2]).is_ok() {
        return Err("a missing texel was not found".into());
    }
    Ok(())
}
