//! How the faces meet at each edge.

use contrejour_layout::{Edge, Face, INCIDENCE_ALONG};
use rayon::prelude::*;

use super::edge_table::{EdgeTable, incidence_words};
use super::exact::{PlaneSide, opposite_sides, side_of_plane};
use super::faces::apex;
use super::report::Findings;

/// How the faces meet at an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum EdgeClass {
    /// Two consistently wound faces that bend away from their fronts.
    Convex,
    /// Two consistently wound faces that bend towards their fronts.
    Concave,
    /// Two consistently wound faces in one plane, side by side or folded onto each other; or one has no area.
    Coplanar,
    /// One face.
    Border,
    /// Three and more faces.
    NonManifold,
    /// Two faces that are wound against each other.
    Flipped,
}

/// What is known of one edge.
#[derive(Clone, Copy)]
pub(super) struct Classified {
    pub(super) class: EdgeClass,
    /// Whether its two faces are consistently wound and lie side by side in exactly one plane, so that a light sees
    /// both from the same side.
    pub(super) flat: bool,
}

/// What the edges add up to.
#[derive(Default)]
pub(super) struct EdgeCensus {
    pub(super) convex: u32,
    pub(super) concave: u32,
    pub(super) coplanar: u32,
    pub(super) border: Findings<[u32; 2]>,
    pub(super) non_manifold: Findings<[u32; 2]>,
    pub(super) flipped: Findings<[u32; 2]>,
    pub(super) duplicate_faces: Findings<u32>,
    pub(super) most_faces: u32,
}

/// Classifies all edges of a table whose words still name the faces themselves.
pub(super) fn classify(positions: &[[f32; 3]], faces: &[Face], table: &EdgeTable) -> (Vec<Classified>, EdgeCensus) {
    const EDGES_PER_TASK: usize = 1 << 12;
    let around = Neighbourhood { positions, faces, incidences: &table.incidences };
    let mut classified = vec![Classified { class: EdgeClass::Border, flat: false }; table.edges.len()];
    let census = table
        .edges
        .par_chunks(EDGES_PER_TASK)
        .zip(classified.par_chunks_mut(EDGES_PER_TASK))
        .map_init(Vec::new, |apexes, (edges, classified)| {
            // Faces lie in memory in any order. Fetched in a loop of their own, many are on their way at once.
            apexes.clear();
            apexes.extend(edges.iter().map(|edge| around.apexes(edge)));
            let mut census = EdgeCensus::default();
            for ((edge, apexes), classified) in edges.iter().zip(apexes).zip(classified) {
                *classified = around.classify(edge, *apexes);
                around.count(edge, classified.class, &mut census);
            }
            census
        })
        .reduce(EdgeCensus::default, EdgeCensus::merge);
    (classified, census)
}

/// All that is known around an edge.
struct Neighbourhood<'a> {
    positions: &'a [[f32; 3]],
    faces: &'a [Face],
    incidences: &'a [u32],
}

impl Neighbourhood<'_> {
    fn words<'a>(&'a self, edge: &'a Edge) -> &'a [u32] {
        incidence_words(edge, self.incidences)
    }

    fn apex(&self, edge: &Edge, word: u32) -> u32 {
        apex(&self.faces[(word >> 1) as usize], edge.low_vertex, edge.high_vertex)
    }

    /// For two consistently wound faces, the apex of the one that runs along the edge and that of the other.
    fn apexes(&self, edge: &Edge) -> Option<[u32; 2]> {
        let [first, second] = *self.words(edge) else { return None };
        if (first ^ second) & INCIDENCE_ALONG == 0 {
            return None;
        }
        let (along, against) = if first & INCIDENCE_ALONG != 0 { (first, second) } else { (second, first) };
        Some([self.apex(edge, along), self.apex(edge, against)])
    }

    fn classify(&self, edge: &Edge, apexes: Option<[u32; 2]>) -> Classified {
        let Some([along, against]) = apexes else {
            let class = match self.words(edge).len() {
                1 => EdgeClass::Border,
                2 => EdgeClass::Flipped,
                _ => EdgeClass::NonManifold,
            };
            return Classified { class, flat: false };
        };
        let [low, high, p, q] =
            [edge.low_vertex, edge.high_vertex, along, against].map(|vertex| self.positions[vertex as usize]);
        match side_of_plane(low, high, p, q) {
            PlaneSide::Behind => Classified { class: EdgeClass::Convex, flat: false },
            PlaneSide::InFront => Classified { class: EdgeClass::Concave, flat: false },
            PlaneSide::On => Classified { class: EdgeClass::Coplanar, flat: opposite_sides(low, high, p, q) },
        }
    }

    fn count(&self, edge: &Edge, class: EdgeClass, census: &mut EdgeCensus) {
        let ends = [edge.low_vertex, edge.high_vertex];
        match class {
            EdgeClass::Convex => census.convex += 1,
            EdgeClass::Concave => census.concave += 1,
            EdgeClass::Coplanar => census.coplanar += 1,
            EdgeClass::Border => census.border.add(ends),
            EdgeClass::NonManifold => census.non_manifold.add(ends),
            EdgeClass::Flipped => census.flipped.add(ends),
        }
        census.most_faces = census.most_faces.max(self.words(edge).len() as u32);
        // Two faces with the same corners are folded onto each other: no other class has a pair of them.
        if matches!(class, EdgeClass::Coplanar | EdgeClass::Flipped | EdgeClass::NonManifold) {
            self.count_duplicates(edge, census);
        }
    }

    /// Counts faces with the same three corners at the edge between the two lowest of them, so each one once.
    fn count_duplicates(&self, edge: &Edge, census: &mut EdgeCensus) {
        let apex_and_face = |&word: &u32| (self.apex(edge, word), word >> 1);
        let is_highest = |&(apex, _): &(u32, u32)| apex > edge.high_vertex;
        let mut count_same = |faces: &mut [(u32, u32)]| {
            faces.sort_unstable();
            for pair in faces.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
                census.duplicate_faces.add(pair[1].1);
            }
        };
        match *self.words(edge) {
            [first, second] => {
                let mut both = [apex_and_face(&first), apex_and_face(&second)];
                if both.iter().all(is_highest) {
                    count_same(&mut both);
                }
            }
            ref words => count_same(&mut words.iter().map(apex_and_face).filter(is_highest).collect::<Vec<_>>()),
        }
    }
}

impl EdgeCensus {
    fn merge(self, other: Self) -> Self {
        Self {
            convex: self.convex + other.convex,
            concave: self.concave + other.concave,
            coplanar: self.coplanar + other.coplanar,
            border: self.border.merge(other.border),
            non_manifold: self.non_manifold.merge(other.non_manifold),
            flipped: self.flipped.merge(other.flipped),
            duplicate_faces: self.duplicate_faces.merge(other.duplicate_faces),
            most_faces: self.most_faces.max(other.most_faces),
        }
    }
}

/// Moves what can be in a silhouette to the front. Keeps the order otherwise.
pub(super) fn candidates_first<T: Copy>(values: &[T], is_candidate: impl Fn(usize) -> bool) -> Vec<T> {
    let mut ordered = Vec::with_capacity(values.len());
    for wanted in [true, false] {
        ordered
            .extend(values.iter().enumerate().filter(|&(id, _)| is_candidate(id) == wanted).map(|(_, &value)| value));
    }
    ordered
}
