//! From triangles to a topology-aware mesh.

use contrejour_layout::Face;

use super::classes::{Classified, EdgeCensus, candidates_first, classify};
use super::components::count_components;
use super::edge_table::EdgeTable;
use super::error::TopologyError;
use super::faces::{bounds, check, faces_without_area, repeats_a_vertex, used_vertices, welded_faces};
use super::partners::{Partner, apply_partners, find_partners};
use super::report::TopologyReport;
use super::vertex_edges::vertex_edges;
use super::weld::{WeldKeys, weld};
use super::weld_near::weld_near;
use super::{EdgeClass, TopologyAwareMesh};

/// How the vertices of a mesh move against each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Motion {
    /// They do not: edges that can never be in a silhouette are left out.
    #[default]
    Rigid,
    /// They do (skins, morph targets, the caller's own): every edge stays a candidate.
    Deforming,
}

/// How a mesh is built. The default is a rigid mesh that is welded by position bits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BuildOptions<'a> {
    /// How its vertices move; [`Motion::Rigid`] by default.
    pub motion: Motion,
    /// What else moves a vertex than its position (joints, weights, morph targets), as bytes: the same number for
    /// each source vertex, in their order. Vertices are welded only where these bytes agree too. None by default.
    pub weld_data: Option<&'a [u8]>,
    /// Welds vertices that are at most so far apart, in the unit of the positions; 0 or more, none by default.
    ///
    /// Source vertices are taken in their order: each is welded to the lowest one before it that is near enough and
    /// is not welded itself. So none moves by more than the distance, whatever chains there are. It is slower than
    /// welding by position bits, and faces that are smaller than the distance may collapse.
    pub weld_distance: Option<f32>,
}

impl TopologyAwareMesh {
    /// Builds the topology of a triangle mesh. Both slices are only read; the positions are copied into the mesh.
    ///
    /// Every thread of the current rayon pool takes part; the result does not depend on their number.
    ///
    /// # Errors
    ///
    /// [`TopologyError`] when an index is out of range, a position is not finite, there are too many of either, or an
    /// option does not fit.
    pub fn build(
        positions: &[[f32; 3]],
        triangles: &[[u32; 3]],
        options: &BuildOptions,
    ) -> Result<Self, TopologyError> {
        check(positions, triangles)?;
        let ids = vertex_ids(positions, options)?;
        let faces = welded_faces(triangles, &ids);
        let mut table = EdgeTable::of_faces(&faces, positions.len());

        let (classified, census) = classify(positions, &faces, &table);
        let without_area = faces_without_area(positions, &faces);
        let partners = find_partners(positions, &faces, &table, &without_area);
        apply_partners(&mut table, &faces, &partners);

        let used = used_vertices(positions.len(), triangles);
        let (bounds_min, bounds_max) = bounds(positions, &ids, &used);
        let (table, edge_classes, candidate_edge_count) = order_edges(table, &classified, options.motion);
        let candidates = &table.edges[..candidate_edge_count as usize];
        let (report, (vertex_edge_offsets, vertex_edges)) = rayon::join(
            || report(&faces, &ids, &used, &partners, &table, census, candidate_edge_count),
            || vertex_edges(candidates, positions.len()),
        );
        Ok(Self {
            positions: positions.to_vec(),
            faces,
            edges: table.edges,
            candidate_edge_count,
            edge_classes,
            incidences: table.incidences,
            partners,
            vertex_edge_offsets,
            vertex_edges,
            bounds_min,
            bounds_max,
            report,
        })
    }
}

/// For each source vertex, the one that stands for it.
fn vertex_ids(positions: &[[f32; 3]], options: &BuildOptions) -> Result<Vec<u32>, TopologyError> {
    let keys = match options.weld_data {
        None => WeldKeys::positions(positions),
        Some(data) if data.is_empty() || data.len().checked_rem(positions.len()) == Some(0) => {
            WeldKeys::with_data(positions, data)
        }
        Some(data) => {
            return Err(TopologyError::UnevenWeldData { bytes: data.len(), vertices: positions.len() });
        }
    };
    match options.weld_distance {
        None | Some(0.0) => Ok(weld(keys)),
        Some(distance) if distance > 0.0 && distance.is_finite() => Ok(weld_near(keys, distance)),
        Some(distance) => Err(TopologyError::WeldDistance { distance }),
    }
}

/// Puts the edges that can be in a silhouette first and counts them.
fn order_edges(table: EdgeTable, classified: &[Classified], motion: Motion) -> (EdgeTable, Vec<EdgeClass>, u32) {
    let is_candidate = |edge_id: usize| motion == Motion::Deforming || !classified[edge_id].flat;
    let count = (0..classified.len()).filter(|&edge_id| is_candidate(edge_id)).count();
    let classes: Vec<EdgeClass> = classified.iter().map(|classified| classified.class).collect();
    if count == classified.len() {
        return (table, classes, count as u32);
    }
    let EdgeTable { edges, incidences } = table;
    let edges = candidates_first(&edges, is_candidate);
    (EdgeTable { edges, incidences }, candidates_first(&classes, is_candidate), count as u32)
}

fn report(
    faces: &[Face],
    ids: &[u32],
    used: &[bool],
    partners: &[Partner],
    table: &EdgeTable,
    census: EdgeCensus,
    candidate_edge_count: u32,
) -> TopologyReport {
    let edges = table.edges.len() as u32;
    TopologyReport {
        vertices: ids.len() as u32,
        used_vertices: count_used_ids(ids, used),
        welded_vertices: ids.iter().zip(0..).filter(|&(&id, vertex)| id != vertex).count() as u32,
        unused_vertices: used.iter().zip(0..).filter(|&(&used, _)| !used).map(|(_, vertex)| vertex).collect(),
        faces: faces.len() as u32,
        edges,
        components: count_components(&table.edges, ids.len()),
        convex_edges: census.convex,
        concave_edges: census.concave,
        coplanar_edges: census.coplanar,
        never_silhouette_edges: edges - candidate_edge_count,
        most_faces_at_an_edge: census.most_faces,
        closed: census.border.count == 0,
        manifold: census.non_manifold.count == 0,
        oriented: census.flipped.count == 0,
        border_edges: census.border,
        non_manifold_edges: census.non_manifold,
        flipped_edges: census.flipped,
        repeated_vertex_faces: faces
            .iter()
            .zip(0..)
            .filter(|(face, _)| repeats_a_vertex(face))
            .map(|(_, id)| id)
            .collect(),
        zero_area_faces: partners.iter().map(|partner| partner.face).collect(),
        unlit_faces: partners
            .iter()
            .filter(|partner| partner.of.is_none() && !partner.negated)
            .map(|partner| partner.face)
            .collect(),
        duplicate_faces: census.duplicate_faces,
    }
}

/// Number of ids that stand for a used vertex.
fn count_used_ids(ids: &[u32], used: &[bool]) -> u32 {
    let mut stands_for_used = vec![false; ids.len()];
    for (&id, _) in ids.iter().zip(used).filter(|&(_, &used)| used) {
        stands_for_used[id as usize] = true;
    }
    stands_for_used.into_iter().map(u32::from).sum()
}
