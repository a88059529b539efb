//! One small mesh and one light for the unit tests of the outline stages.

use std::collections::BTreeMap;

use contrejour_layout::{
    BLOCK_SIZE, Caster, CasterLight, Corner, Counters, Edge, INCIDENCE_LIST, INCIDENCE_NONE, LIT_WORDS_PER_BLOCK,
    LightView, OUTLINE_WORDS_PER_BLOCK, Quad, SilhouetteEdge, WorkItem, incidence,
};
use glam::{DVec3, Mat4, Vec4};

use crate::{BuildCorners, DetectSilhouette, ExtrudeEdges};

/// Looks down the z axis with x to the right and y up.
pub(crate) enum TestLight {
    /// At a point, half a right angle to each side, near plane at distance 1, far plane at 9.
    Spot(DVec3),
    /// From +z; sees -1..1 in x and y, depth 0 at z = 4, depth 8 at z = -4.
    Directional,
}

pub(crate) struct TestScene {
    pub(crate) positions: Vec<[f32; 3]>,
    pub(crate) faces: Vec<[u32; 3]>,
    pub(crate) light: TestLight,
    pub(crate) width_ndc: f32,
    pub(crate) capacity: u32,
}

/// What the outline stages write.
pub(crate) struct Outline {
    pub(crate) edges: Vec<Edge>,
    pub(crate) silhouettes: Vec<SilhouetteEdge>,
    pub(crate) outline_sides: Vec<u32>,
    pub(crate) quads: Vec<Quad>,
    pub(crate) corners: Vec<Corner>,
    pub(crate) counters: Counters,
}

struct Topology {
    edges: Vec<Edge>,
    incidences: Vec<u32>,
    vertex_edges: Vec<u32>,
}

impl TestScene {
    /// A mesh in the plane z = 0 under a directional light.
    pub(crate) fn flat(positions: &[[f32; 2]], faces: &[[u32; 3]]) -> Self {
        let positions: Vec<_> = positions.iter().map(|&[x, y]| [x, y, 0.0]).collect();
        Self::new(&positions, faces, TestLight::Directional)
    }

    pub(crate) fn new(positions: &[[f32; 3]], faces: &[[u32; 3]], light: TestLight) -> Self {
        Self { positions: positions.to_vec(), faces: faces.to_vec(), light, width_ndc: 0.05, capacity: 10_000 }
    }

    pub(crate) fn outline(&self) -> Outline {
        let topology = self.topology();
        let caster = self.caster(&topology);
        let casters = [caster];
        let caster_lights = [self.caster_light()];
        let blocks = caster.edge_count.div_ceil(BLOCK_SIZE);
        let edge_items: Vec<_> = (0..blocks).map(|block| WorkItem { caster: 0, block }).collect();
        let view = LightView { edge_item_count: blocks, ..self.view() };
        let positions: Vec<u32> = self.positions.iter().flatten().map(|value| value.to_bits()).collect();
        let capacity = self.capacity as usize;
        let mut counters = Counters::default();
        let mut silhouettes = vec![SilhouetteEdge::default(); capacity];
        // Rubbish, so that a word that is not written shows.
        let mut outline_sides = vec![u32::MAX; (blocks * OUTLINE_WORDS_PER_BLOCK) as usize];
        let mut quads = vec![Quad::default(); capacity];
        let mut corners = vec![Corner::default(); capacity];
        DetectSilhouette {
            view: &view,
            edge_items: &edge_items,
            casters: &casters,
            edges: &topology.edges,
            incidences: &topology.incidences,
            lit: &self.lit(),
            silhouettes: &mut silhouettes,
            outline_sides: &mut outline_sides,
            counters: &mut counters,
        }
        .run();
        ExtrudeEdges {
            view: &view,
            silhouettes: &silhouettes,
            casters: &casters,
            caster_lights: &caster_lights,
            edges: &topology.edges,
            positions: &positions,
            quads: &mut quads,
            counters: &mut counters,
        }
        .run();
        BuildCorners {
            view: &view,
            quads: &quads,
            casters: &casters,
            caster_lights: &caster_lights,
            positions: &positions,
            outline_sides: &outline_sides,
            vertex_edges: &topology.vertex_edges,
            corners: &mut corners,
            counters: &mut counters,
        }
        .run();
        silhouettes.truncate(counters.silhouette_edges as usize);
        quads.truncate(counters.quads as usize);
        corners.truncate(counters.corners as usize);
        Outline { edges: topology.edges, silhouettes, outline_sides, quads, corners, counters }
    }

    fn topology(&self) -> Topology {
        let mut faces_of_edges: BTreeMap<[u32; 2], Vec<u32>> = BTreeMap::new();
        for (face, &[a, b, c]) in self.faces.iter().enumerate() {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let words = faces_of_edges.entry([from.min(to), from.max(to)]).or_default();
                words.push(incidence(face as u32, from < to));
            }
        }
        let mut edges = Vec::new();
        let mut incidences = Vec::new();
        let mut edges_of_vertices = vec![Vec::new(); self.positions.len()];
        for (edge_id, (&[low_vertex, high_vertex], words)) in faces_of_edges.iter().enumerate() {
            let (first, second) = match words[..] {
                [only] => (only, INCIDENCE_NONE),
                [first, second] => (first, second),
                _ => {
                    let list = incidences.len() as u32;
                    incidences.push(words.len() as u32);
                    incidences.extend(words);
                    (INCIDENCE_LIST, list)
                }
            };
            edges.push(Edge { low_vertex, high_vertex, first, second });
            edges_of_vertices[low_vertex as usize].push([edge_id as u32, high_vertex]);
            edges_of_vertices[high_vertex as usize].push([edge_id as u32, low_vertex]);
        }
        let mut vertex_edges = vec![0];
        for edges in &edges_of_vertices {
            vertex_edges.push(vertex_edges[vertex_edges.len() - 1] + edges.len() as u32);
        }
        vertex_edges.extend(edges_of_vertices.iter().flatten().flatten());
        Topology { edges, incidences, vertex_edges }
    }

    fn caster(&self, topology: &Topology) -> Caster {
        Caster {
            position_stride_words: 3,
            face_count: self.faces.len() as u32,
            edge_count: topology.edges.len() as u32,
            first_vertex_edge_word: self.positions.len() as u32 + 1,
            position_scale: 1.0,
            ..Default::default()
        }
    }

    fn lit(&self) -> Vec<u32> {
        let mut lit = vec![0; self.faces.len().div_ceil(BLOCK_SIZE as usize) * LIT_WORDS_PER_BLOCK as usize];
        for (face, corners) in self.faces.iter().enumerate() {
            let [a, b, c] = corners.map(|vertex| DVec3::from(self.positions[vertex as usize].map(f64::from)));
            let towards_light = match self.light {
                TestLight::Spot(position) => position - a,
                TestLight::Directional => DVec3::Z,
            };
            if (b - a).cross(c - a).dot(towards_light) > 0.0 {
                lit[face / 32] |= 1 << (face % 32);
            }
        }
        lit
    }

    fn caster_light(&self) -> CasterLight {
        let light_clip_from_object = match self.light {
            TestLight::Spot(position) => {
                let clip_from_eye =
                    Mat4::from_cols(Vec4::X, Vec4::Y, Vec4::new(0.0, 0.0, -1.125, -1.0), -1.125 * Vec4::Z);
                clip_from_eye * Mat4::from_translation(-position.as_vec3())
            }
            TestLight::Directional => {
                Mat4::from_cols(Vec4::X, Vec4::Y, -0.125 * Vec4::Z, Vec4::new(0.0, 0.0, 0.5, 1.0))
            }
        };
        CasterLight { light_clip_from_object: light_clip_from_object.to_cols_array(), casts: 1, ..Default::default() }
    }

    fn view(&self) -> LightView {
        let perspective = matches!(self.light, TestLight::Spot(_));
        LightView {
            perspective: u32::from(perspective),
            silhouette_capacity: self.capacity,
            quad_capacity: self.capacity,
            corner_capacity: self.capacity,
            near_depth: if perspective { 1.0 } else { 0.0 },
            far_depth: if perspective { 9.0 } else { 8.0 },
            q_max: if perspective { 0.0 } else { 8.0 },
            width_fixed_ndc: self.width_ndc,
            width_max_ndc: 1.0,
            ..Default::default()
        }
    }
}
