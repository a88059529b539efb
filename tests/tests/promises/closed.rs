//! The silhouette is a cycle: at every vertex the multiplicities that arrive and leave add up to zero.

use contrejour_layout::SilhouetteEdge;
use contrejour_mesh::TopologyAwareMesh;
use contrejour_oracle::open_vertices;
use contrejour_tests::harness::{Outcome, cpu_trial};
use libtest_mimic::Trial;

pub fn trials() -> Vec<Trial> {
    vec![cpu_trial("closed::comparer_finds_planted_faults", comparer_finds_planted_faults)]
}

/// Checks the list of one caster.
pub fn check(mesh: &TopologyAwareMesh, silhouettes: &[SilhouetteEdge]) -> Outcome {
    match open_vertices(&mesh.edges, silhouettes)[..] {
        [] => Ok(()),
        [vertex, ..] => Err(format!("the silhouette is open at vertex {vertex}")),
    }
}

fn comparer_finds_planted_faults() -> Outcome {
    let tetrahedron = contrejour_tests::meshes::tiny().swap_remove(7);
    let mesh = &tetrahedron.parts[0].topology;
    // The three edges of face 0, in the direction in which it runs along them.
    let face = mesh.faces[0];
    let along = [(face.a, face.b), (face.b, face.c), (face.c, face.a)].map(|(from, to)| {
        let is_edge =
            |edge: &contrejour_layout::Edge| (edge.low_vertex, edge.high_vertex) == (from.min(to), from.max(to));
        let edge_id = mesh.edges.iter().position(is_edge).expect("a face has edges") as u32;
        let (left, right) = if from < to { (2, 0) } else { (0, 2) };
        SilhouetteEdge { caster: 0, edge_id, left, right }
    });
    check(mesh, &along)?;
    let mut turned = along;
    (turned[1].left, turned[1].right) = (along[1].right, along[1].left);
    let mut weaker = along;
    (weaker[0].left, weaker[0].right) = (along[0].left / 2, along[0].right / 2);
    for faulty in [&along[..2], &turned, &weaker] {
        if check(mesh, faulty).is_ok() {
            return Err(format!("{faulty:?} counts as closed"));
        }
    }
    Ok(())
}
