//! The set of silhouette edges is the one that exact arithmetic finds, with the same faces on both sides.

use contrejour_layout::{CasterLight, SilhouetteEdge};
use contrejour_mesh::TopologyAwareMesh;
use contrejour_oracle::{ManyLights, OracleEdge};
use contrejour_tests::compare::{edge_differences, edges_of};
use contrejour_tests::harness::{Outcome, cpu_trial};
use libtest_mimic::Trial;

pub fn trials() -> Vec<Trial> {
    vec![cpu_trial("exact::comparer_finds_planted_faults", comparer_finds_planted_faults)]
}

/// Compares the list of one caster with the oracle's.
pub fn check(
    mesh: &TopologyAwareMesh,
    oracle: &ManyLights,
    light: &CasterLight,
    silhouettes: &[SilhouetteEdge],
) -> Outcome {
    let expected = match light.casts {
        0 => Vec::new(),
        _ => oracle.silhouette(&oracle.lit_faces(light.light_object.map(f32::from_bits), light.mirrored == 1)),
    };
    compare(mesh, &expected, silhouettes)
}

fn compare(mesh: &TopologyAwareMesh, expected: &[OracleEdge], silhouettes: &[SilhouetteEdge]) -> Outcome {
    match edge_differences(expected, &edges_of(mesh, silhouettes))[..] {
        [] => Ok(()),
        [edge, ..] if expected.contains(&edge) => Err(format!("expected {edge:?}, not found")),
        [edge, ..] => Err(format!("found {edge:?}, not expected")),
    }
}

fn comparer_finds_planted_faults() -> Outcome {
    let mesh = &contrejour_tests::meshes::tiny().swap_remove(7).parts[0].topology;
    let edges = &mesh.edges[..4];
    let oracle =
        |edge: &contrejour_layout::Edge| OracleEdge { low: edge.low_vertex, high: edge.high_vertex, left: 2, right: 0 };
    let mut expected: Vec<_> = edges.iter().map(oracle).collect();
    expected.sort();
    let good: Vec<_> = (0..4).rev().map(|edge_id| SilhouetteEdge { caster: 0, edge_id, left: 2, right: 0 }).collect();
    compare(mesh, &expected, &good)?;
    let faults: [fn(&mut Vec<SilhouetteEdge>); 5] = [
        |edges| edges.truncate(3),
        |edges| edges.push(edges[0]),
        |edges| edges[1].edge_id = 5,
        |edges| (edges[2].left, edges[2].right) = (0, 2),
        |edges| edges[0].left = 3,
    ];
    for (index, fault) in faults.iter().enumerate() {
        let mut faulty = good.clone();
        fault(&mut faulty);
        if compare(mesh, &expected, &faulty).is_ok() {
            return Err(format!("fault {index} was not found"));
        }
    }
    Ok(())
}
