//! Comparers of buffers. Each returns the first difference in words, so that a test can prove that it finds one.

use std::fmt::Debug;

use contrejour_layout::{Corner, FaceTest, Quad, SilhouetteEdge};
use contrejour_mesh::TopologyAwareMesh;
use contrejour_oracle::OracleEdge;

/// A record of a list whose order is left to chance.
pub trait Record: Copy {
    /// What makes it unique in its list.
    fn key(&self) -> [u32; 3];
    /// Its other fields that must be equal to the bit.
    fn exact(&self) -> Vec<(&'static str, u32)>;
    /// Its fields that may differ within a tolerance.
    fn floats(&self) -> Vec<(&'static str, f32)>;
}

impl Record for FaceTest {
    fn key(&self) -> [u32; 3] {
        [self.caster, self.test, 0]
    }

    fn exact(&self) -> Vec<(&'static str, u32)> {
        Vec::new()
    }

    fn floats(&self) -> Vec<(&'static str, f32)> {
        Vec::new()
    }
}

impl Record for SilhouetteEdge {
    fn key(&self) -> [u32; 3] {
        [self.caster, self.edge_id, 0]
    }

    fn exact(&self) -> Vec<(&'static str, u32)> {
        vec![("left", self.left), ("right", self.right)]
    }

    fn floats(&self) -> Vec<(&'static str, f32)> {
        Vec::new()
    }
}

impl Record for Quad {
    fn key(&self) -> [u32; 3] {
        [self.caster, self.edge_id, 0]
    }

    fn exact(&self) -> Vec<(&'static str, u32)> {
        vec![
            ("low_vertex", self.low_vertex),
            ("high_vertex", self.high_vertex),
            ("own_ends", self.own_ends),
            ("side", self.side),
        ]
    }

    fn floats(&self) -> Vec<(&'static str, f32)> {
        vec![
            ("low_ndc.x", self.low_ndc[0]),
            ("low_ndc.y", self.low_ndc[1]),
            ("high_ndc.x", self.high_ndc[0]),
            ("high_ndc.y", self.high_ndc[1]),
            ("outward.x", self.outward[0]),
            ("outward.y", self.outward[1]),
            ("width_ndc.x", self.width_ndc[0]),
            ("width_ndc.y", self.width_ndc[1]),
            ("q.x", self.q[0]),
            ("q.y", self.q[1]),
        ]
    }
}

impl Record for Corner {
    fn key(&self) -> [u32; 3] {
        [self.caster, self.edge_id, self.vertex_id]
    }

    fn exact(&self) -> Vec<(&'static str, u32)> {
        vec![("kind", self.kind)]
    }

    fn floats(&self) -> Vec<(&'static str, f32)> {
        vec![
            ("apex_ndc.x", self.apex_ndc[0]),
            ("apex_ndc.y", self.apex_ndc[1]),
            ("begin.x", self.begin[0]),
            ("begin.y", self.begin[1]),
            ("middle.x", self.middle[0]),
            ("middle.y", self.middle[1]),
            ("end.x", self.end[0]),
            ("end.y", self.end[1]),
            ("width_ndc", self.width_ndc),
            ("q", self.q),
        ]
    }
}

/// Words, bits and counts: equal, element by element.
///
/// # Errors
///
/// The first difference, with `what` and the index.
pub fn compare_exact<T: PartialEq + Debug>(what: &str, expected: &[T], actual: &[T]) -> Result<(), String> {
    if expected.len() != actual.len() {
        return Err(format!("{what}: {} expected, {} found", expected.len(), actual.len()));
    }
    match expected.iter().zip(actual).position(|(expected, actual)| expected != actual) {
        None => Ok(()),
        Some(index) => Err(format!("{what}[{index}]: expected {:x?}, found {:x?}", expected[index], actual[index])),
    }
}

/// Lists in any order: the same keys, equal exact fields, and floats within `tolerance` times the larger of 1 and the
/// expected size.
///
/// # Errors
///
/// The first difference, with `what`, the key and the field; a key that is there twice is one.
pub fn compare_records<T: Record>(what: &str, expected: &[T], actual: &[T], tolerance: f32) -> Result<(), String> {
    let sorted = |records: &[T]| {
        let mut sorted = records.to_vec();
        sorted.sort_by_key(Record::key);
        sorted
    };
    let (expected, actual) = (sorted(expected), sorted(actual));
    compare_exact(&format!("keys of {what}"), &keys(&expected), &keys(&actual))?;
    if let Some(pair) = expected.windows(2).find(|pair| pair[0].key() == pair[1].key()) {
        return Err(format!("{what} {:?} is there twice", pair[0].key()));
    }
    for (expected, actual) in expected.iter().zip(&actual) {
        compare_record(what, expected, actual, tolerance)?;
    }
    Ok(())
}

fn keys<T: Record>(records: &[T]) -> Vec<[u32; 3]> {
    records.iter().map(Record::key).collect()
}

/// Two records of one key.
///
/// # Errors
///
/// The first field that differs.
pub fn compare_record<T: Record>(what: &str, expected: &T, actual: &T, tolerance: f32) -> Result<(), String> {
    for ((field, expected_word), (_, actual_word)) in expected.exact().into_iter().zip(actual.exact()) {
        if expected_word != actual_word {
            return Err(format!("{what} {:?}, {field}: expected {expected_word}, found {actual_word}", expected.key()));
        }
    }
    for ((field, expected_float), (_, actual_float)) in expected.floats().into_iter().zip(actual.floats()) {
        let allowed = tolerance * expected_float.abs().max(1.0);
        // NaN is not within.
        let is_within = (expected_float - actual_float).abs() <= allowed;
        if !is_within {
            return Err(format!(
                "{what} {:?}, {field}: expected {expected_float} within {allowed}, found {actual_float}",
                expected.key()
            ));
        }
    }
    Ok(())
}

/// Silhouettes of a mesh as the oracle writes them, in its order.
pub fn edges_of<'a>(
    mesh: &TopologyAwareMesh,
    silhouettes: impl IntoIterator<Item = &'a SilhouetteEdge>,
) -> Vec<OracleEdge> {
    let as_oracle = |silhouette: &SilhouetteEdge| {
        let edge = &mesh.edges[silhouette.edge_id as usize];
        let [left, right] = [silhouette.left, silhouette.right].map(u32::cast_signed);
        OracleEdge { low: edge.low_vertex, high: edge.high_vertex, left, right }
    };
    let mut edges: Vec<_> = silhouettes.into_iter().map(as_oracle).collect();
    edges.sort_unstable();
    edges
}

/// What only one of two ascending lists of edges has.
pub fn edge_differences(expected: &[OracleEdge], found: &[OracleEdge]) -> Vec<OracleEdge> {
    let mut differences = Vec::new();
    let (mut expected, mut found) = (expected.iter().peekable(), found.iter().peekable());
    while let Some(next) = expected.peek().into_iter().chain(found.peek()).min().copied() {
        let is_expected = expected.next_if_eq(&next).is_some();
        let is_found = found.next_if_eq(&next).is_some();
        if is_expected != is_found {
            differences.push(*next);
        }
    }
    differences
}

/// Every float is finite.
///
/// # Errors
///
/// The first that is not, with `what` and its index.
pub fn check_finite(what: &str, floats: &[f32]) -> Result<(), String> {
    match floats.iter().position(|float| !float.is_finite()) {
        None => Ok(()),
        Some(index) => Err(format!("{what}[{index}] is {}", floats[index])),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quads() -> Vec<Quad> {
        (0..5).map(|edge_id| Quad { edge_id, low_ndc: [0.5, -0.5], side: 1, ..Default::default() }).collect()
    }

    #[test]
    fn exact_finds_a_wrong_word_and_a_missing_one() {
        assert_eq!(compare_exact("lit", &[1, 2, 3], &[1, 2, 3]), Ok(()));
        assert!(compare_exact("lit", &[1, 2, 3], &[1, 2, 7]).is_err_and(|text| text.contains("lit[2]")));
        assert!(compare_exact("lit", &[1, 2, 3], &[1, 2]).is_err());
    }

    #[test]
    fn records_in_another_order_are_the_same() {
        let mut turned = quads();
        turned.rotate_left(2);
        assert_eq!(compare_records("quad", &quads(), &turned, 0.0), Ok(()));
    }

    #[test]
    fn records_find_planted_faults() {
        let plant = |fault: fn(&mut Vec<Quad>)| {
            let mut faulty = quads();
            fault(&mut faulty);
            compare_records("quad", &quads(), &faulty, 1e-3).expect_err("the fault is found")
        };
        assert!(plant(|quads| quads[3].side = 2).contains("side"));
        assert!(plant(|quads| quads[3].low_ndc[1] += 0.01).contains("low_ndc.y"));
        assert!(plant(|quads| quads[3].q[0] = f32::NAN).contains("q.x"));
        assert!(plant(|quads| quads[3].edge_id = 9).contains("keys"));
        assert!(plant(|quads| quads.truncate(4)).contains("keys"));
        assert!(plant(|quads| quads.push(quads[0])).contains("keys"));
    }

    #[test]
    fn records_find_an_edge_that_is_there_twice_on_both_sides() {
        let mut doubled = quads();
        doubled.push(doubled[0]);
        assert!(compare_records("quad", &doubled, &doubled, 0.0).is_err_and(|text| text.contains("twice")));
    }

    #[test]
    fn a_float_within_the_tolerance_passes() {
        let mut near = quads();
        near[0].low_ndc[0] += 5e-4;
        assert_eq!(compare_records("quad", &quads(), &near, 1e-3), Ok(()));
    }

    #[test]
    fn finite_finds_nan_and_infinity() {
        assert_eq!(check_finite("alpha", &[0.0, f32::MAX]), Ok(()));
        assert!(check_finite("alpha", &[0.0, f32::NAN]).is_err_and(|text| text.contains("alpha[1]")));
        assert!(check_finite("alpha", &[f32::NEG_INFINITY]).is_err());
    }
}
