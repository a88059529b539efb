//! The one type that the compute stages read, and how it is built.

mod build;
mod classes;
mod components;
mod edge_table;
mod error;
mod exact;
mod faces;
mod half_edges;
mod partners;
mod report;
mod report_text;
mod vertex_edges;
mod weld;
mod weld_near;

pub use build::{BuildOptions, Motion};
pub use classes::EdgeClass;
pub use edge_table::{EdgeTable, incidence_words};
pub use error::{MAX_FACES, MAX_VERTICES, TopologyError};
pub use partners::Partner;
pub use report::{FINDINGS_LISTED, Findings, TopologyReport};

use contrejour_layout::{Edge, Face, VertexEdge};

use edge_table::find_edge;
pub(crate) use faces::repeats_a_vertex;

/// The triangles plus all that a shader must know about their neighbours, ready for upload.
///
/// A vertex id is the lowest index among the source vertices with the same position bits (`-0.0` = `0.0`), so a
/// vertex id indexes `positions` and also any buffer of the caller's with the source vertices in the same order.
#[derive(Clone, Debug)]
pub struct TopologyAwareMesh {
    /// Positions of the source vertices, unchanged.
    pub positions: Vec<[f32; 3]>,
    /// One face for each source triangle, by welded vertex ids.
    pub faces: Vec<Face>,
    /// Edges by (low, high) vertex; first the `candidate_edge_count` that can be in a silhouette, then the others.
    pub edges: Vec<Edge>,
    /// Number of edges that can be in a silhouette of the mesh.
    pub candidate_edge_count: u32,
    /// Class of each edge.
    pub edge_classes: Vec<EdgeClass>,
    /// Lists of incidence words, each after its count, for edges with more than two faces.
    pub incidences: Vec<u32>,
    /// The partner of each face without area that has three distinct corners, by ascending face.
    pub partners: Vec<Partner>,
    /// For vertex `v`, its candidate edges are `vertex_edges[vertex_edge_offsets[v] .. vertex_edge_offsets[v + 1]]`.
    pub vertex_edge_offsets: Vec<u32>,
    /// Candidate edges of each vertex, by ascending edge.
    pub vertex_edges: Vec<VertexEdge>,
    /// Smallest corner of the box around all used vertices; zeros when there is none.
    pub bounds_min: [f32; 3],
    /// Largest corner of the box around all used vertices; zeros when there is none.
    pub bounds_max: [f32; 3],
    /// What was found on the way.
    pub report: TopologyReport,
}

impl TopologyAwareMesh {
    /// Triangles without any edge, and so without silhouettes: what is cut by a mask, or is drawn and nothing more. Nothing is
    /// welded.
    ///
    /// # Errors
    ///
    /// [`TopologyError`] when an index is out of range, a position is not finite, or there are too many of either.
    pub fn faces_alone(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<Self, TopologyError> {
        faces::check(positions, triangles)?;
        let ids: Vec<u32> = (0..positions.len() as u32).collect();
        let used = faces::used_vertices(positions.len(), triangles);
        let (bounds_min, bounds_max) = faces::bounds(positions, &ids, &used);
        Ok(Self {
            positions: positions.to_vec(),
            faces: triangles.iter().map(|&[a, b, c]| Face { a, b, c }).collect(),
            edges: Vec::new(),
            candidate_edge_count: 0,
            edge_classes: Vec::new(),
            incidences: Vec::new(),
            partners: Vec::new(),
            vertex_edge_offsets: Vec::new(),
            vertex_edges: Vec::new(),
            bounds_min,
            bounds_max,
            report: TopologyReport::default(),
        })
    }

    /// Where the corners of a face are.
    ///
    /// # Panics
    ///
    /// When the face names a vertex without position.
    pub fn corners(&self, face: &Face) -> [[f32; 3]; 3] {
        [face.a, face.b, face.c].map(|vertex| self.positions[vertex as usize])
    }

    /// The edge between two vertices, the lower first.
    pub(crate) fn edge_between(&self, low_vertex: u32, high_vertex: u32) -> Option<usize> {
        let (candidates, others) = self.edges.split_at(self.candidate_edge_count as usize);
        let among = |edges| find_edge(edges, low_vertex, high_vertex);
        among(candidates).or_else(|| Some(candidates.len() + among(others)?))
    }

    /// The candidate edges of a vertex, by ascending edge.
    ///
    /// # Panics
    ///
    /// When the mesh has no such vertex.
    pub fn edges_of_vertex(&self, vertex: u32) -> &[VertexEdge] {
        let [begin, end] = [vertex as usize, vertex as usize + 1].map(|index| self.vertex_edge_offsets[index] as usize);
        &self.vertex_edges[begin..end]
    }
}
