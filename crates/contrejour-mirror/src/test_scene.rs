//! One small mesh and one light for the unit tests of the outline stages.

use std::collections::BTreeMap;

use contrejour_layout::{
    BLOCK_BY_POSITIONS, BLOCK_SIZE, Caster, CasterLight, Edge, Face, INCIDENCE_LIST, INCIDENCE_NONE, LightView,
    WorkItem, incidence,
};
use glam::{Mat4, Vec3, Vec4};

use crate::{FrameInputs, FrameOutputs, run_frame};

/// Looks down the z axis with x to the right and y up.
pub(crate) enum TestLight {
    /// At a point, half a right angle to each side, near plane at distance 1, far plane at 9.
    Spot(Vec3),
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

    pub(crate) fn frame(&self) -> FrameOutputs {
        let topology = self.topology();
        let caster = self.caster(&topology);
        let face_items: Vec<_> =
            items(caster.face_count).into_iter().map(|item| WorkItem { kind: BLOCK_BY_POSITIONS, ..item }).collect();
        let edge_items = items(caster.edge_count);
        let positions: Vec<u32> = self.positions.iter().flatten().map(|value| value.to_bits()).collect();
        let faces: Vec<_> = self.faces.iter().map(|&[a, b, c]| Face { a, b, c }).collect();
        run_frame(&FrameInputs {
            view: &LightView {
                face_block_count: face_items.len() as u32,
                edge_block_count: edge_items.len() as u32,
                ..self.view()
            },
            face_items: &face_items,
            edge_items: &edge_items,
            casters: &[caster],
            caster_lights: &[self.caster_light()],
            positions: &positions,
            faces: &faces,
            planes: &[],
            edges: &topology.edges,
            incidences: &topology.incidences,
            vertex_edges: &topology.vertex_edges,
        })
    }

    /// (low vertex, high vertex, left, right) of the silhouette.
    pub(crate) fn silhouette(&self) -> Vec<(u32, u32, u32, u32)> {
        let edges = self.topology().edges;
        let vertices = |edge_id: u32| (edges[edge_id as usize].low_vertex, edges[edge_id as usize].high_vertex);
        let silhouettes = self.frame().silhouettes.into_iter();
        silhouettes.map(|edge| (vertices(edge.edge_id).0, vertices(edge.edge_id).1, edge.left, edge.right)).collect()
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

    fn caster_light(&self) -> CasterLight {
        let light_clip_from_object = match self.light {
            TestLight::Spot(position) => {
                let clip_from_eye =
                    Mat4::from_cols(Vec4::X, Vec4::Y, Vec4::new(0.0, 0.0, -1.125, -1.0), -1.125 * Vec4::Z);
                clip_from_eye * Mat4::from_translation(-position)
            }
            TestLight::Directional => {
                Mat4::from_cols(Vec4::X, Vec4::Y, -0.125 * Vec4::Z, Vec4::new(0.0, 0.0, 0.5, 1.0))
            }
        };
        let light_object = match self.light {
            TestLight::Spot(position) => position.extend(1.0),
            TestLight::Directional => Vec4::Z,
        };
        CasterLight {
            light_object: light_object.to_array().map(f32::to_bits),
            light_clip_from_object: light_clip_from_object.to_cols_array(),
            casts: 1,
            ..Default::default()
        }
    }

    fn view(&self) -> LightView {
        let perspective = matches!(self.light, TestLight::Spot(_));
        LightView {
            perspective: u32::from(perspective),
            undecided_capacity: self.faces.len() as u32,
            silhouette_capacity: self.capacity,
            quad_capacity: self.capacity,
            corner_capacity: self.capacity,
            near_depth: if perspective { 1.0 } else { 0.0 },
            far_depth: if perspective { 9.0 } else { 8.0 },
            q_max: if perspective { 0.0 } else { 8.0 },
            width_min_ndc: self.width_ndc,
            width_max_ndc: 1.0,
            ..Default::default()
        }
    }
}

fn items(count: u32) -> Vec<WorkItem> {
    (0..count.div_ceil(BLOCK_SIZE)).map(|block| WorkItem { block, ..Default::default() }).collect()
}
