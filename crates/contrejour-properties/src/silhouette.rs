//! The silhouette of any triangles: exact, closed, and its smoothies finite.

use contrejour_layout::{Corner, Quad};
use contrejour_mesh::{BuildOptions, TopologyAwareMesh};
use contrejour_mirror::FrameOutputs;
use contrejour_oracle::{OracleEdge, OracleTopology, open_vertices};

use crate::Caster;

/// Builds the topology of a caster and runs the CPU twins of all stages on it.
///
/// # Panics
///
/// When a face's lit bit or the silhouette differs from the oracle's, when the silhouette is not closed, when a quad
/// or a corner holds a number that is not finite, or when there are more of them than can be.
pub fn check_silhouette(caster: &Caster) {
    let options =
        BuildOptions { motion: caster.motion, weld_distance: caster.weld_distance, ..BuildOptions::default() };
    let topology = TopologyAwareMesh::build(&caster.positions, &caster.triangles, &options);
    let topology = topology.unwrap_or_else(|error| panic!("{error}"));
    check_frame(caster, &topology, &caster.frame(&topology));
}

fn check_frame(caster: &Caster, topology: &TopologyAwareMesh, frame: &FrameOutputs) {
    // Welding by a distance is no business of the oracle's: it gets the faces that it leaves.
    let welded: Vec<[u32; 3]> = topology.faces.iter().map(|face| [face.a, face.b, face.c]).collect();
    let triangles = if caster.weld_distance.is_some() { &welded } else { &caster.triangles };
    let oracle = OracleTopology::new(&caster.positions, triangles);

    let expected = oracle.lit_faces(caster.light, caster.mirrored);
    let lit: Vec<bool> = (0..expected.len()).map(|face| frame.lit[face / 32] >> (face % 32) & 1 == 1).collect();
    assert_eq!(lit, expected, "lit faces");
    assert_eq!(silhouette(topology, frame), oracle.silhouette(caster.light, caster.mirrored), "silhouette");
    let open = open_vertices(&topology.edges, &frame.silhouettes);
    assert!(open.is_empty(), "open at vertices {open:?}");
    check_smoothies(topology, frame);
}

/// By ascending (low, high) vertex, as the oracle has it.
fn silhouette(topology: &TopologyAwareMesh, frame: &FrameOutputs) -> Vec<OracleEdge> {
    let mut silhouette: Vec<OracleEdge> = Vec::new();
    for found in &frame.silhouettes {
        let edge = topology.edges[found.edge_id as usize];
        silhouette.push(OracleEdge {
            low: edge.low_vertex,
            high: edge.high_vertex,
            left: found.left as i32,
            right: found.right as i32,
        });
    }
    silhouette.sort_unstable();
    silhouette
}

fn check_smoothies(topology: &TopologyAwareMesh, frame: &FrameOutputs) {
    let counters = &frame.counters;
    assert!(counters.quads + counters.point_edges <= counters.silhouette_edges, "{counters:?}");
    assert!(counters.silhouette_edges <= topology.candidate_edge_count, "{counters:?}");
    assert!(counters.corners <= 2 * counters.quads, "{counters:?}");
    for quad in &frame.quads {
        let Quad { low_ndc, high_ndc, outward, width_ndc, q, .. } = *quad;
        let numbers = [low_ndc, high_ndc, outward, width_ndc, q];
        assert!(numbers.as_flattened().iter().all(|number| number.is_finite()), "{quad:?}");
    }
    for corner in &frame.corners {
        let Corner { apex_ndc, begin, middle, end, width_ndc, q, .. } = *corner;
        let numbers = [apex_ndc, begin, middle, end, [width_ndc, q]];
        assert!(numbers.as_flattened().iter().all(|number| number.is_finite()), "{corner:?}");
    }
}

#[cfg(test)]
mod tests {
    use contrejour_mesh::Motion;
    use glam::DVec3;

    use super::*;
    use crate::Lens;
    use crate::planted::{Planted, assert_found};

    #[test]
    fn a_wrong_frame_is_found() {
        let tetrahedron = Caster {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
            light: [3.0, 2.5, 2.0, 1.0],
            mirrored: false,
            motion: Motion::Rigid,
            weld_distance: None,
            lens: Lens { target: DVec3::ZERO, cone_angle: 1.0, near: 0.1, far: 10.0, radius: 0.1 },
        };
        let topology =
            TopologyAwareMesh::build(&tetrahedron.positions, &tetrahedron.triangles, &BuildOptions::default());
        let topology = topology.expect("a good mesh");
        let good = tetrahedron.frame(&topology);
        check_frame(&tetrahedron, &topology, &good);
        let faults: [Planted<FrameOutputs>; 8] = [
            ("lit faces", |frame| frame.lit[0] ^= 1),
            ("silhouette", |frame| frame.silhouettes.truncate(1)),
            ("silhouette", |frame| frame.silhouettes[1].left += 1),
            ("silhouette", |frame| frame.silhouettes.push(frame.silhouettes[0])),
            ("Quad", |frame| frame.quads[0].width_ndc[1] = f32::NAN),
            ("Corner", |frame| frame.corners[2].middle[0] = f32::INFINITY),
            ("Counters", |frame| frame.counters.quads += 100),
            ("Counters", |frame| frame.counters.corners += 100),
        ];
        for (told, fault) in faults {
            let mut frame = good.clone();
            fault(&mut frame);
            assert_found(told, || check_frame(&tetrahedron, &topology, &frame));
        }
    }
}
