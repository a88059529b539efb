//! Where sources of silhouette maps that ask in floats may see another silhouette than the stages, which are exact.

use std::collections::HashSet;

use contrejour_layout::{INCIDENCE_ALONG, LightView, UNLIT_FACE};
use contrejour_mesh::incidence_words;
use contrejour_plan::{SilhouetteSource, StreamPrecision, View, ViewCounts};
use contrejour_tests::meshes::{TestMesh, TestPart};
use contrejour_tests::silhouette_texels::{Expected, SilhouetteTexel};
use glam::{DMat4, DVec2, DVec3, DVec4, Vec4Swizzles};

use crate::silhouette_maps::settings;

/// Sine of the angle at which a face is seen that counts as edge-on.
pub const FACING_ROUNDING: f64 = 1e-5;

/// The same where normals are stored in 16 bits.
const HALF_FACING_ROUNDING: f64 = 1.0 / 512.0;

/// What may be otherwise in a map, texel by texel.
#[derive(Debug, Default)]
pub struct Doubtful {
    /// The silhouette may be another edge's of a face that is seen edge-on, at the same place but for rounding, and at another
    /// depth, which makes its band another one.
    pub another: HashSet<usize>,
    /// There may be no silhouette.
    pub none: HashSet<usize>,
    /// Whether the light sees all edges so: a flat mesh, edge-on.
    pub is_flat: bool,
}

impl Doubtful {
    /// The same where something hides silhouettes: it may hide the other edge.
    pub fn or_hidden(self) -> Self {
        Self { none: self.none.union(&self.another).copied().collect(), another: HashSet::new(), ..self }
    }

    pub fn explains(&self, index: usize, found: &Option<SilhouetteTexel>, expected: &Expected) -> bool {
        let is_hole = found.is_none() && expected.is_in_least_band;
        self.none.contains(&index) || (!is_hole && self.another.contains(&index))
    }
}

/// The texels near the edges that a source may see otherwise than the stages do.
pub fn near_doubtful_edges(mesh: &TestMesh, view: &View, source: SilhouetteSource, map_size: u32) -> Doubtful {
    let (facing_rounding, asks_pairs) = match source {
        SilhouetteSource::Stages => return Doubtful::default(),
        SilhouetteSource::Faces => (FACING_ROUNDING, false),
        SilhouetteSource::Stream(StreamPrecision::Bits32) => (FACING_ROUNDING, true),
        SilhouetteSource::Stream(StreamPrecision::Bits16) => (HALF_FACING_ROUNDING, true),
    };
    let record = view.light_view(&settings(source, map_size), &ViewCounts::default());
    let edges = mesh.parts.iter().flat_map(|part| doubtful_edges(part, view, facing_rounding, asks_pairs));
    let mut doubtful = Doubtful::default();
    let mut seen: u32 = mesh.parts.iter().map(|part| part.topology.candidate_edge_count).sum();
    for (doubt, segment) in edges {
        let texels = match doubt {
            Doubt::EdgeOn | Doubt::InPairs => &mut doubtful.another,
            Doubt::NoFace => &mut doubtful.none,
        };
        texels.extend(near_segment(segment, &record));
        seen -= u32::from(!matches!(doubt, Doubt::InPairs));
    }
    doubtful.is_flat = seen == 0;
    doubtful
}

/// Why a source may see another silhouette than the stages.
enum Doubt {
    /// A face at the edge is seen edge-on up to a rounding.
    EdgeOn,
    /// Some faces at the edge are on each side, of which a pair may lie on one.
    InPairs,
    /// Faces without area that have no sign: the edge is drawn whatever the light, or has no face that draws it.
    NoFace,
}

/// Edges with the clip coordinates of their ends. Only a stream asks faces in pairs.
fn doubtful_edges(part: &TestPart, view: &View, facing_rounding: f64, asks_pairs: bool) -> Vec<(Doubt, [DVec4; 2])> {
    let mesh = &part.topology;
    let clip_from_object: DMat4 = view.light_clip_from_world * part.world_from_object;
    let position = |vertex: u32| DVec3::from(mesh.positions[vertex as usize].map(f64::from));
    let clip = |vertex: u32| clip_from_object * position(vertex).extend(1.0);
    // Depth is a part of how long a side is: one that the light sees end-on has no direction.
    let near_one = |clip: DVec4| {
        let unit = clip / clip.abs().max_element().max(f64::MIN_POSITIVE);
        DVec3::new(unit.x, unit.y, unit.w)
    };
    // Sines of the angles at which the faces are seen.
    let facing: Vec<f64> = (mesh.faces.iter())
        .map(|face| {
            let side = |vertex: u32| near_one(clip_from_object * (position(vertex) - position(face.a)).extend(0.0));
            near_one(clip(face.a)).dot(side(face.b).cross(side(face.c)))
        })
        .collect();
    let facing_of = |word: u32| facing.get((word >> 1) as usize).copied();
    let is_left = |word: u32| facing_of(word).map(|facing| (facing > 0.0) == (word & INCIDENCE_ALONG != 0));
    let doubt = |words: &[u32]| {
        let unlit = words.iter().filter(|word| **word >> 1 == UNLIT_FACE).count();
        let asks_no_face = unlit == words.len() || (words.len() == 2 && unlit > 0);
        let has_two_sides = words.iter().any(|word| is_left(*word) != is_left(words[0]));
        let is_edge_on = |word: &u32| facing_of(*word).is_some_and(|facing| facing.abs() <= facing_rounding);
        if asks_no_face {
            return Some(Doubt::NoFace);
        }
        if words.iter().any(is_edge_on) {
            return Some(Doubt::EdgeOn);
        }
        (asks_pairs && words.len() > 2 && has_two_sides).then_some(Doubt::InPairs)
    };
    let candidates = &mesh.edges[..mesh.candidate_edge_count as usize];
    let doubtful = candidates.iter().filter_map(|edge| {
        let doubt = doubt(incidence_words(edge, &mesh.incidences))?;
        Some((doubt, [clip(edge.low_vertex), clip(edge.high_vertex)]))
    });
    doubtful.collect()
}

/// Texels that are as near to a segment as distances are drawn.
fn near_segment([low, high]: [DVec4; 2], record: &LightView) -> Vec<usize> {
    let side = f64::from(record.map_size);
    let most = DVec2::splat(side - 1.0);
    // What is in front of the near plane is cut off.
    let [mut begin, mut end] = [low, high];
    if begin.z.max(end.z) < 0.0 {
        return Vec::new();
    }
    if begin.z < 0.0 {
        begin = begin.lerp(end, -begin.z / (end.z - begin.z));
    } else if end.z < 0.0 {
        end = end.lerp(begin, -end.z / (begin.z - end.z));
    }
    let texel = |clip: DVec4| (clip.xy() / clip.w * DVec2::new(0.5, -0.5) + 0.5) * side;
    let [begin, end] = [begin, end].map(texel);
    let reach = 0.5 * side * f64::from(record.reach_ndc) + 1.0;
    let along = end - begin;
    let is_near = |[column, row]: [usize; 2]| {
        let place = DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
        let share = ((place - begin).dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        place.distance(begin + share * along) <= reach
    };
    let [first, last] = [begin.min(end) - reach, begin.max(end) + reach].map(|place| place.clamp(DVec2::ZERO, most));
    let rows = first.y as usize..=last.y as usize;
    let texels = rows.flat_map(|row| (first.x as usize..=last.x as usize).map(move |column| [column, row]));
    texels.filter(|texel| is_near(*texel)).map(|[column, row]| row * record.map_size as usize + column).collect()
}
