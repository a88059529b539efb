//! Silhouettes by brute force over ordered maps: welding, partners and multiplicities.

use std::collections::BTreeMap;

use crate::facing::{is_collinear, lit};

/// An edge of the silhouette.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct OracleEdge {
    /// The lower vertex.
    pub low: u32,
    /// The higher vertex.
    pub high: u32,
    /// Faces on its left as seen from the light, looking from `low` to `high`.
    pub left: i32,
    /// Faces on its right.
    pub right: i32,
}

impl OracleEdge {
    /// The signed multiplicity: not zero in a silhouette.
    pub fn multiplicity(&self) -> i32 {
        self.left - self.right
    }
}

/// The silhouette of triangles as their file brings them, by ascending (low, high) vertex. Of source vertices with the
/// same position the lowest index stands for all.
///
/// # Panics
///
/// As [`lit`].
pub fn silhouette(positions: &[[f32; 3]], triangles: &[[u32; 3]], light: [f32; 4], mirrored: bool) -> Vec<OracleEdge> {
    let topology = OracleTopology::new(positions, triangles);
    topology.silhouette(light, mirrored)
}

/// What [`silhouette`] knows of a mesh before it knows the light; [`ManyLights`](crate::ManyLights) is made of it.
#[derive(Clone, Debug)]
pub struct OracleTopology {
    positions: Vec<[f32; 3]>,
    faces: Vec<[u32; 3]>,
    /// For each edge its faces, and whether each runs from the lower to the higher vertex.
    pub(crate) edges: BTreeMap<(u32, u32), Vec<(usize, bool)>>,
    /// Whose sign each face without area takes (`None`: that of an unlit face), and whether negated.
    pub(crate) partners: BTreeMap<usize, (Option<usize>, bool)>,
}

impl OracleTopology {
    /// Welds, and finds the faces at every edge and the partner of every face without area.
    pub fn new(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Self {
        Self::of_welded(positions, weld(positions, &vec![0; positions.len()], triangles))
    }

    /// The same where only source vertices that also have one number in `classes` are welded: those that move alike.
    ///
    /// # Panics
    ///
    /// When there are fewer numbers than positions.
    pub fn of_deforming(positions: &[[f32; 3]], classes: &[u32], triangles: &[[u32; 3]]) -> Self {
        Self::of_welded(positions, weld(positions, classes, triangles))
    }

    fn of_welded(positions: &[[f32; 3]], faces: Vec<[u32; 3]>) -> Self {
        let mut edges: BTreeMap<(u32, u32), Vec<(usize, bool)>> = BTreeMap::new();
        for (face, &[a, b, c]) in faces.iter().enumerate() {
            if a == b || b == c || c == a {
                continue;
            }
            for (from, to) in [(a, b), (b, c), (c, a)] {
                edges.entry((from.min(to), from.max(to))).or_default().push((face, from < to));
            }
        }
        let mut topology = Self { positions: positions.to_vec(), faces, edges, partners: BTreeMap::new() };
        let without_area: Vec<usize> =
            (0..topology.faces.len()).filter(|&face| topology.is_without_area(face)).collect();
        topology.partners = without_area.iter().map(|&face| (face, topology.partner(face))).collect();
        topology
    }

    /// The same topology when its vertices have moved, partners of faces without area included.
    pub fn moved(self, positions: &[[f32; 3]]) -> Self {
        Self { positions: positions.to_vec(), ..self }
    }

    /// The silhouette, by ascending (low, high) vertex.
    ///
    /// # Panics
    ///
    /// As [`lit`].
    pub fn silhouette(&self, light: [f32; 4], mirrored: bool) -> Vec<OracleEdge> {
        let own_lit = self.lit_faces(light, mirrored);
        let is_lit = |face: usize| match self.partners.get(&face) {
            None => own_lit[face],
            Some(&(other, negated)) => other.is_some_and(|other| own_lit[other]) != negated,
        };
        let mut silhouette = Vec::new();
        for (&(low, high), faces) in &self.edges {
            let left = faces.iter().filter(|&&(face, along)| is_lit(face) == along).count() as i32;
            let edge = OracleEdge { low, high, left, right: faces.len() as i32 - left };
            if edge.multiplicity() != 0 {
                silhouette.push(edge);
            }
        }
        silhouette
    }

    /// Whether each face is lit, by its own corners alone.
    ///
    /// # Panics
    ///
    /// As [`lit`].
    pub fn lit_faces(&self, light: [f32; 4], mirrored: bool) -> Vec<bool> {
        self.corners_of_faces().map(|[a, b, c]| lit(a, b, c, light, mirrored)).collect()
    }

    /// The three positions of each face.
    pub(crate) fn corners_of_faces(&self) -> impl Iterator<Item = [[f32; 3]; 3]> + '_ {
        (0..self.faces.len()).map(|face| self.corners(face))
    }

    fn is_without_area(&self, face: usize) -> bool {
        let [a, b, c] = self.faces[face];
        let [a_position, b_position, c_position] = self.corners(face);
        a != b && b != c && c != a && is_collinear(a_position, b_position, c_position)
    }

    fn corners(&self, face: usize) -> [[f32; 3]; 3] {
        self.faces[face].map(|vertex| self.positions[vertex as usize])
    }

    /// Follows the chain of faces without area across their longest edges. A face without a single one across is unlit;
    /// so are those whose chain comes back to them.
    fn partner(&self, face: usize) -> (Option<usize>, bool) {
        let mut current = face;
        let mut negated = false;
        let mut negated_where_reached = BTreeMap::new();
        while self.is_without_area(current) {
            // Reached again first: the face where the chain enters a ring.
            if let Some(where_entered) = negated_where_reached.insert(current, negated) {
                return (None, where_entered);
            }
            let Some((across, is_negated)) = self.across_longest_edge(current) else {
                return (None, negated);
            };
            current = across;
            negated ^= is_negated;
        }
        (Some(current), negated)
    }

    /// The one face across the longest edge of a face without area, and whether the edge is no silhouette when their
    /// signs differ.
    fn across_longest_edge(&self, face: usize) -> Option<(usize, bool)> {
        // Points on a line have the order of their coordinates.
        let mut corners = self.faces[face];
        let key = |vertex: &u32| self.positions[*vertex as usize];
        corners.sort_by(|v, w| key(v).partial_cmp(&key(w)).expect("coordinates are finite"));
        let [first, _, last] = corners;
        match self.edges[&(first.min(last), first.max(last))][..] {
            [(one, along_one), (other, along_other)] => {
                // m = s o + s' o' = 0: consistently wound faces (o != o') need the same sign.
                Some((if one == face { other } else { one }, along_one == along_other))
            }
            _ => None,
        }
    }
}

fn weld(positions: &[[f32; 3]], classes: &[u32], triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    // Adding zero turns -0.0 into 0.0 and changes nothing else.
    let key = |vertex: usize| (positions[vertex].map(|coordinate| (coordinate + 0.0).to_bits()), classes[vertex]);
    let mut lowest = BTreeMap::new();
    for vertex in 0..positions.len() {
        lowest.entry(key(vertex)).or_insert(vertex as u32);
    }
    triangles.iter().map(|triangle| triangle.map(|vertex| lowest[&key(vertex as usize)])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: [f32; 3] = [0.0, 0.0, 0.0];
    const B: [f32; 3] = [1.0, 0.0, 0.0];
    const C: [f32; 3] = [0.0, 1.0, 0.0];

    #[test]
    fn a_lone_triangle_is_its_own_silhouette() {
        let edges = silhouette(&[A, B, C], &[[0, 1, 2]], [0.0, 0.0, 1.0, 0.0], false);
        let signed: Vec<_> = edges.iter().map(|edge| (edge.low, edge.high, edge.multiplicity())).collect();
        assert_eq!(signed, [(0, 1, 1), (0, 2, -1), (1, 2, 1)]);
    }

    #[test]
    fn a_seam_in_the_vertices_makes_no_border() {
        // 0,1,2 and 3,4,5 share the edge 1-2, once with the other zero.
        let positions = [A, B, C, [1.0, -0.0, 0.0], [1.0, 1.0, 0.0], C];
        let edges = silhouette(&positions, &[[0, 1, 2], [3, 4, 5]], [0.0, 0.0, 1.0, 0.0], false);
        assert_eq!(edges.len(), 4);
        assert!(edges.iter().all(|edge| (edge.low, edge.high) != (1, 2)));
    }

    /// ```text
    ///      2
    ///     / \       0-3-1 is a face without area below 0-1-2.
    ///    /   \
    ///   0--3--1
    /// ```
    #[test]
    fn a_face_without_area_takes_the_sign_of_its_partner() {
        let positions = [A, [2.0, 0.0, 0.0], C, [1.0, 0.0, 0.0]];
        let edges = silhouette(&positions, &[[0, 1, 2], [0, 3, 1]], [0.0, 0.0, 1.0, 0.0], false);
        let signed: Vec<_> = edges.iter().map(|edge| (edge.low, edge.high, edge.multiplicity())).collect();
        assert_eq!(signed, [(0, 2, -1), (0, 3, 1), (1, 2, 1), (1, 3, -1)]);
    }

    #[test]
    fn a_face_that_names_a_vertex_twice_cancels_itself() {
        assert_eq!(silhouette(&[A, B, C], &[[0, 1, 1], [2, 2, 2]], [0.0, 0.0, 1.0, 0.0], false), []);
    }

    #[test]
    fn three_faces_at_an_edge_all_count() {
        let positions = [A, B, C, [0.0, -1.0, 0.0], [0.0, 0.5, 1.0]];
        let faces = [[0, 1, 2], [1, 0, 3], [0, 1, 4]];
        let edges = silhouette(&positions, &faces, [0.0, 0.0, 1.0, 0.0], false);
        let spine = edges.iter().find(|edge| (edge.low, edge.high) == (0, 1)).expect("an odd edge is always in");
        assert_eq!((spine.left, spine.right), (2, 1));
    }
}
