//! What a mesh is made of and what is wrong with it.

/// Ids that [`Findings`] lists.
pub const FINDINGS_LISTED: usize = 8;

/// How often something was found, and where first.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Findings<Id> {
    /// How often.
    pub count: u32,
    /// The lowest ids, ascending, at most [`FINDINGS_LISTED`].
    pub first: Vec<Id>,
}

impl<Id> Default for Findings<Id> {
    fn default() -> Self {
        Self { count: 0, first: Vec::new() }
    }
}

impl<Id: Ord> Findings<Id> {
    /// Counts one more, which may have been found in any order.
    pub(super) fn add(&mut self, id: Id) {
        self.count += 1;
        self.list(id);
    }

    /// Counts those of both.
    pub(super) fn merge(mut self, other: Self) -> Self {
        self.count += other.count;
        for id in other.first {
            self.list(id);
        }
        self
    }

    fn list(&mut self, id: Id) {
        if self.first.len() == FINDINGS_LISTED && self.first.last().is_some_and(|last| *last <= id) {
            return;
        }
        self.first.insert(self.first.partition_point(|listed| *listed < id), id);
        self.first.truncate(FINDINGS_LISTED);
    }
}

impl<Id: Ord> FromIterator<Id> for Findings<Id> {
    fn from_iter<Ids: IntoIterator<Item = Id>>(ids: Ids) -> Self {
        let mut findings = Self::default();
        ids.into_iter().for_each(|id| findings.add(id));
        findings
    }
}

/// What a mesh is made of and what is wrong with it.
///
/// Faces and vertices are listed by their index in the source, edges by their two welded vertices. Its `Display` is a
/// table for people.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct TopologyReport {
    /// Source vertices.
    pub vertices: u32,
    /// Places of vertices that faces use: vertices after welding.
    pub used_vertices: u32,
    /// Source vertices for which a lower one stands.
    pub welded_vertices: u32,
    /// Source vertices that no triangle names.
    pub unused_vertices: Findings<u32>,
    /// Triangles.
    pub faces: u32,
    /// Edges of faces with three distinct vertices.
    pub edges: u32,
    /// Sets of such faces that hang together by their vertices.
    pub components: u32,
    /// Edges that bend away from the fronts of their two faces.
    pub convex_edges: u32,
    /// Edges that bend towards the fronts of their two faces.
    pub concave_edges: u32,
    /// Edges whose two faces are exactly in one plane.
    pub coplanar_edges: u32,
    /// Edges left out because they can never be in a silhouette.
    pub never_silhouette_edges: u32,
    /// Most faces at one edge.
    pub most_faces_at_an_edge: u32,
    /// Edges with one face.
    pub border_edges: Findings<[u32; 2]>,
    /// Edges with three and more faces.
    pub non_manifold_edges: Findings<[u32; 2]>,
    /// Edges whose two faces are wound against each other.
    pub flipped_edges: Findings<[u32; 2]>,
    /// Faces that name a vertex twice after welding; they cancel themselves.
    pub repeated_vertex_faces: Findings<u32>,
    /// Faces with three distinct vertices that are exactly on one line.
    pub zero_area_faces: Findings<u32>,
    /// Those of them that are unlit for want of a partner.
    pub unlit_faces: Findings<u32>,
    /// Faces with the same three vertices, in any order, as a face before them.
    pub duplicate_faces: Findings<u32>,
    /// No border edge.
    pub closed: bool,
    /// No edge with three and more faces.
    pub manifold: bool,
    /// No two faces are wound against each other at an edge of their own.
    pub oriented: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn findings_list_the_lowest_whatever_the_order() {
        let ascending: Findings<u32> = (0..100).collect();
        let descending: Findings<u32> = (0..100).rev().collect();
        assert_eq!(ascending, Findings { count: 100, first: (0..8).collect() });
        assert_eq!(descending, ascending);

        let odd: Findings<u32> = (0..100).filter(|id| id % 2 == 1).collect();
        let even: Findings<u32> = (0..100).filter(|id| id % 2 == 0).collect();
        assert_eq!(odd.merge(even), ascending);
    }
}
