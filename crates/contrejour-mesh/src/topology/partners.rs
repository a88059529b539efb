//! Faces without area: whose sign they take.
//!
//! A face with three distinct, exactly collinear corners has no side. It takes the sign that makes its longest edge
//! no silhouette against the one face across it; where that face has no area either, the chain is followed. Where
//! there is no single face across, the face is unlit, and so are all faces of a ring, whose chain comes back to them.

use contrejour_layout::{Face, INCIDENCE_ALONG, UNLIT_FACE, incidence};

use super::edge_table::{EdgeTable, incidence_words};
use super::exact::between;

/// Whose sign a face without area takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Partner {
    /// The face without area.
    pub face: u32,
    /// The face with area whose sign it takes; `None`: that of an unlit face.
    pub of: Option<u32>,
    /// Whether it takes the opposite of that sign.
    pub negated: bool,
}

/// The sign of another face, or its opposite.
#[derive(Clone, Copy)]
struct SignOf {
    face: u32,
    negated: bool,
}

const UNLIT: SignOf = SignOf { face: UNLIT_FACE, negated: false };

/// Finds the partner of each of the faces `without_area`, which are ascending.
pub(super) fn find_partners(
    positions: &[[f32; 3]],
    faces: &[Face],
    table: &EdgeTable,
    without_area: &[u32],
) -> Vec<Partner> {
    let across: Vec<Option<SignOf>> =
        without_area.iter().map(|&face| across_longest_edge(positions, faces, table, face)).collect();
    let signs = follow_chains(&across, |face| without_area.binary_search(&face).ok());
    without_area
        .iter()
        .zip(signs)
        .map(|(&face, sign)| Partner {
            face,
            of: (sign.face != UNLIT_FACE).then_some(sign.face),
            negated: sign.negated,
        })
        .collect()
}

/// The sign that makes the longest edge of a face no silhouette, when there is one other face at that edge.
fn across_longest_edge(positions: &[[f32; 3]], faces: &[Face], table: &EdgeTable, face: u32) -> Option<SignOf> {
    let [low, high] = longest_edge(positions, &faces[face as usize]);
    let edge = &table.edges[table.find(low, high)?];
    let [first, second] = *incidence_words(edge, &table.incidences) else { return None };
    let other = if first >> 1 == face { second } else { first };
    // s o + s' o' = 0: wound consistently, the faces have the same sign.
    Some(SignOf { face: other >> 1, negated: (first ^ second) & INCIDENCE_ALONG == 0 })
}

/// The longest edge of a face with collinear corners, from its lower vertex; of equals, the lowest pair.
fn longest_edge(positions: &[[f32; 3]], face: &Face) -> [u32; 2] {
    let at = |vertex: u32| positions[vertex as usize];
    let by_opposite = [(face.a, face.b, face.c), (face.b, face.c, face.a), (face.c, face.a, face.b)];
    by_opposite
        .into_iter()
        .filter(|&(middle, p, q)| between(at(p), at(middle), at(q)))
        .map(|(_, p, q)| [p.min(q), p.max(q)])
        .min()
        .unwrap_or([face.a, face.b])
}

/// State of one chain's face.
#[derive(Clone, Copy)]
enum Chain {
    Unknown,
    /// On the path that is being followed.
    Open,
    Known(SignOf),
}

/// Replaces each sign that is taken from a face without area by the one at the end of the chain. `slot_of` gives the
/// place of a face without area.
fn follow_chains(across: &[Option<SignOf>], slot_of: impl Fn(u32) -> Option<usize>) -> Vec<SignOf> {
    let mut chains = vec![Chain::Unknown; across.len()];
    let mut path = Vec::new();
    for start in 0..across.len() {
        let mut slot = start;
        let mut sign = loop {
            match chains[slot] {
                Chain::Known(sign) => break sign,
                Chain::Open => {
                    // A ring, in which each face asks the next one: none has a sign to take. What led into it has.
                    let ring = path.iter().position(|&earlier| earlier == slot).unwrap_or(0);
                    for slot in path.drain(ring..) {
                        chains[slot] = Chain::Known(UNLIT);
                    }
                    break UNLIT;
                }
                Chain::Unknown => {}
            }
            let Some(next) = across[slot] else {
                chains[slot] = Chain::Known(UNLIT);
                break UNLIT;
            };
            chains[slot] = Chain::Open;
            path.push(slot);
            match slot_of(next.face) {
                Some(next_slot) => slot = next_slot,
                // Taken as it is here; the way back below adds what each link negates.
                None => break SignOf { face: next.face, negated: false },
            }
        };
        while let Some(slot) = path.pop() {
            let is_negated = across[slot].is_some_and(|link| link.negated);
            sign = SignOf { negated: sign.negated != is_negated, ..sign };
            chains[slot] = Chain::Known(sign);
        }
    }
    chains.into_iter().map(|chain| if let Chain::Known(sign) = chain { sign } else { UNLIT }).collect()
}

/// Lets the incidence words of faces without area name their partners.
pub(super) fn apply_partners(table: &mut EdgeTable, faces: &[Face], partners: &[Partner]) {
    for partner in partners {
        let Face { a, b, c } = faces[partner.face as usize];
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let Some(edge_id) = table.find(from.min(to), from.max(to)) else { continue };
            for word in table.words_mut(edge_id).iter_mut().filter(|word| **word >> 1 == partner.face) {
                *word = incidence(partner.of.unwrap_or(UNLIT_FACE), (from < to) != partner.negated);
            }
        }
    }
}
