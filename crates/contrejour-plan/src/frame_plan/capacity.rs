//! Room for silhouette edges, quads and corners, which are few and whose number only the GPU knows.

use contrejour_layout::Counters;

/// Capacities end at a multiple of this, so that small differences between frames do not matter.
const GRANULE: u64 = 64;

/// Small meshes have outlines far from the estimate, and room for them costs nothing.
const LEAST_ROOM: u64 = 4096;

/// Room for silhouette edges, quads and corners.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Capacity {
    /// Silhouette edges, for each view that has a seat. Never more than there are edges.
    pub silhouettes: u32,
    /// Quads. Never more than there are edges.
    pub quads: u32,
    /// Corners. Never more than there are ends of edges.
    pub corners: u32,
}

impl Capacity {
    /// Whether there was room for what a frame counted.
    pub fn holds(&self, needed: &Counters) -> bool {
        needed.silhouette_edges <= self.silhouettes && needed.quads <= self.quads && needed.corners <= self.corners
    }

    /// Room for both.
    pub fn max(self, other: Self) -> Self {
        Self {
            silhouettes: self.silhouettes.max(other.silhouettes),
            quads: self.quads.max(other.quads),
            corners: self.corners.max(other.corners),
        }
    }

    /// The capacity for the next frame after one that counted `needed` with this one: where that was too much a quarter
    /// more than needed, else as it is. Only silhouette edges that fit count their quads, and only quads that fit their
    /// corners, so those of the others are expected in proportion.
    pub fn grown_for(self, needed: &Counters) -> Self {
        let silhouettes = u64::from(needed.silhouette_edges);
        let quads = in_proportion(needed.quads.into(), (silhouettes, self.silhouettes));
        let corners = in_proportion(needed.corners.into(), (quads, self.quads.min(needed.quads)));
        Self {
            silhouettes: grown(self.silhouettes, silhouettes),
            quads: grown(self.quads, quads),
            corners: grown(self.corners, corners),
        }
    }

    /// Room for a first frame where so many outline edges are expected, at least `floor`, at most what so many edges can
    /// ever need.
    pub(super) fn expecting(outline_edges: u64, most_edges: u64, floor: Self) -> Self {
        let outline_edges = round_up(outline_edges).max(LEAST_ROOM);
        let between = |floor: u32, most: u64| saturating_u32(outline_edges.max(floor.into()).min(most));
        Self {
            silhouettes: between(floor.silhouettes, most_edges),
            quads: between(floor.quads, most_edges),
            // An outline that is a loop has as many vertices as edges, and at most one wedge at each. Where many edges
            // meet in a vertex, each can need one at both ends.
            corners: between(floor.corners, 2 * most_edges),
        }
    }
}

/// What is to be expected of all, where those that fit counted `found`.
fn in_proportion(found: u64, (all, fit): (u64, u32)) -> u64 {
    let fit = all.min(fit.into()).max(1);
    found.saturating_mul(all).div_ceil(fit).max(found)
}

fn grown(capacity: u32, needed: u64) -> u32 {
    if needed <= capacity.into() {
        capacity
    } else {
        saturating_u32(round_up(needed.saturating_add(needed.div_ceil(4))))
    }
}

/// A mesh of f faces has about 0.7 f^0.8 silhouette edges between two faces (McGuire 2004, "Observations on silhouette
/// sizes"), and all of them may be among the given ones. A border or non-manifold edge may always be one.
pub(super) fn expected_outline_edges(mesh_faces: u32, two_face_edges: u32, other_edges: u32) -> u64 {
    let two_face = (0.7 * f64::from(mesh_faces).powf(0.8)).ceil() as u64;
    two_face.min(two_face_edges.into()) + u64::from(other_edges)
}

fn round_up(count: u64) -> u64 {
    count.next_multiple_of(GRANULE)
}

fn saturating_u32(count: u64) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Faces, edges with two faces, other edges of each mesh.
    fn capacity_above(meshes: &[(u32, u32, u32)], floor: Capacity) -> Capacity {
        let expected = meshes.iter().map(|&(faces, two_face, other)| expected_outline_edges(faces, two_face, other));
        let most = meshes.iter().map(|&(_, two_face, other)| u64::from(two_face) + u64::from(other));
        Capacity::expecting(expected.sum(), most.sum(), floor)
    }

    fn capacity(meshes: &[(u32, u32, u32)]) -> Capacity {
        capacity_above(meshes, Capacity::default())
    }

    #[test]
    fn closed_meshes_start_from_the_estimate() {
        // 0.7 * 1 000 000 ^ 0.8 = 44 167.
        let capacity = capacity(&[(1_000_000, 1_500_000, 0)]);
        assert_eq!(capacity, Capacity { silhouettes: 44_224, quads: 44_224, corners: 44_224 });
    }

    #[test]
    fn borders_all_count() {
        assert_eq!(capacity(&[(1_000, 0, 3_000)]).quads, 3_000);
        let two = [(1_000, 0, 3_000), (1_000_000, 1_500_000, 10)];
        assert_eq!(capacity(&two).quads, (44_167_u32 + 3_010).next_multiple_of(64));
    }

    #[test]
    fn small_meshes_have_room_for_everything() {
        assert_eq!(capacity(&[(12, 18, 0)]), Capacity { silhouettes: 18, quads: 18, corners: 36 });
        assert_eq!(capacity(&[]), Capacity::default());
    }

    #[test]
    fn what_was_missing_comes_with_a_quarter_more() {
        let capacity = Capacity { silhouettes: 64, quads: 64, corners: 64 };
        let counted = Counters { silhouette_edges: 64, quads: 100, corners: 64, ..Counters::default() };
        assert!(!capacity.holds(&counted));
        let grown = capacity.grown_for(&counted);
        // 64 corners at 64 of 100 quads are 100 corners.
        assert_eq!(grown, Capacity { silhouettes: 64, quads: 128, corners: 128 });
        let fits = Counters { quads: 64, corners: 65, ..Counters::default() };
        assert_eq!(capacity.grown_for(&fits), Capacity { silhouettes: 64, quads: 64, corners: 128 });
        assert!(grown.holds(&counted));
        let counted = Counters { quads: u32::MAX, ..Counters::default() };
        assert_eq!(capacity.grown_for(&counted).quads, u32::MAX);
    }

    #[test]
    fn edges_that_found_no_room_are_expected_to_have_quads_and_corners_too() {
        let capacity = Capacity { silhouettes: 100, quads: 100, corners: 100 };
        // 80 quads at 100 of 300 edges are 240, and 160 corners at 80 quads are 480.
        let counted = Counters { silhouette_edges: 300, quads: 80, corners: 160, ..Counters::default() };
        let grown = |needed: u32| (needed + needed.div_ceil(4)).next_multiple_of(64);
        let expected = Capacity { silhouettes: grown(300), quads: grown(240), corners: grown(480) };
        assert_eq!(capacity.grown_for(&counted), expected);
        // Without extrusion there are neither.
        let list = Capacity { silhouettes: 100, ..Capacity::default() };
        let counted = Counters { silhouette_edges: 101, ..Counters::default() };
        assert!(!list.holds(&counted));
        assert_eq!(list.grown_for(&counted), Capacity { silhouettes: 128, ..Capacity::default() });
    }

    #[test]
    fn the_floor_raises_up_to_what_can_be_needed() {
        let meshes = [(1_000_000, 1_500_000, 0)];
        let floor = Capacity { silhouettes: 200_000, quads: 100_000, corners: u32::MAX };
        let capacity = capacity_above(&meshes, floor);
        assert_eq!(capacity, Capacity { silhouettes: 200_000, quads: 100_000, corners: 3_000_000 });
    }
}
