//! The one type that the compute stages read, and how it is built.

use contrejour_layout::{Edge, Face, VertexEdge};

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

/// How the faces meet at an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum EdgeClass {
    /// Two consistently wound faces that bend away from their fronts.
    Convex,
    /// Two consistently wound faces that bend towards their fronts.
    Concave,
    /// Two faces in one plane.
    Coplanar,
    /// One face.
    Border,
    /// Three and more faces.
    NonManifold,
    /// Two faces that are wound against each other.
    Flipped,
}

/// Whose sign a face without area takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Partner {
    /// The face without area.
    pub face: u32,
    /// The face with area whose sign it takes; `None`: it is unlit.
    pub of: Option<u32>,
    /// Whether it takes the opposite of that sign.
    pub negated: bool,
}

/// What a mesh is made of and what is wrong with it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TopologyReport {}
