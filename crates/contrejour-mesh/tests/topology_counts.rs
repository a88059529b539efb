//! Counts of the topology report on meshes that nobody here wrote, against those of independent programs.
#![cfg(all(feature = "obj", feature = "gltf", feature = "ply", feature = "stl"))]

use std::path::{Path, PathBuf};

use contrejour_mesh::{BuildOptions, MeshFile, TopologyAwareMesh, TopologyReport, load};
use serde_json::Value;

/// The folder with `meshes.json`; `None`, after saying so, when it is not there.
fn mesh_folder() -> Option<PathBuf> {
    let beside_workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/meshes");
    let folder = std::env::var_os("CONTREJOUR_MESHES").map_or(beside_workspace, PathBuf::from);
    if folder.join("meshes.json").is_file() {
        return Some(folder);
    }
    println!("no meshes at {}: this test checks nothing", folder.display());
    None
}

/// The records of `meshes.json`, which has the numbers NaN and Infinity that JSON does not know.
fn records(folder: &Path) -> Vec<Value> {
    let text = std::fs::read_to_string(folder.join("meshes.json")).expect("meshes.json can be read");
    let text = text.replace("-Infinity", "null").replace("Infinity,", "null,").replace("NaN", "null");
    serde_json::from_str(&text.replace("Infinity\n", "null\n")).expect("meshes.json is JSON")
}

/// All of a file's meshes as one, in world space: the other programs weld across nodes, which the library never does.
fn world_report(file: &MeshFile) -> TopologyReport {
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for node in &file.nodes {
        let mesh = &file.meshes[node.mesh];
        let first = positions.len() as u32;
        triangles.extend(mesh.triangles.iter().map(|corners| corners.map(|index| first + index)));
        positions.extend(mesh.positions.iter().map(|&position| {
            let world = node.world_from_object.transform_point3(position.map(f64::from).into());
            world.as_vec3().to_array()
        }));
    }
    TopologyAwareMesh::build(&positions, &triangles, &BuildOptions::default()).expect("loaded meshes are sound").report
}

/// Their counts beside ours, each with its key in `meshes.json`.
fn pairs(theirs: &Value, ours: &TopologyReport, unlisted_vertices: u32) -> [(&'static str, u32, Value); 15] {
    let of = |key: &str| theirs[key].clone();
    let welded = |key: &str| theirs["weld"][key].clone();
    [
        ("T", ours.faces, of("T")),
        ("weld.V", ours.used_vertices, welded("V")),
        ("weld.edges", ours.edges, welded("edges")),
        ("weld.border", ours.border_edges.count, welded("border")),
        ("weld.nonmanifold", ours.non_manifold_edges.count, welded("nonmanifold")),
        ("weld.flipped_pairs", ours.flipped_edges.count, welded("flipped_pairs")),
        ("weld.max_tris_on_edge", ours.most_faces_at_an_edge, welded("max_tris_on_edge")),
        ("degenerate_tris", ours.repeated_vertex_faces.count, of("degenerate_tris")),
        ("zero_area_extra", ours.zero_area_faces.count, of("zero_area_extra")),
        ("duplicate_tris", ours.duplicate_faces.count, of("duplicate_tris")),
        ("unreferenced_verts", ours.unused_vertices.count + unlisted_vertices, of("unreferenced_verts")),
        ("components", ours.components, of("components")),
        ("closed", u32::from(ours.closed), of("closed")),
        ("manifold", u32::from(ours.manifold), of("manifold")),
        ("oriented", u32::from(ours.oriented), of("oriented")),
    ]
}

/// A count, or 1 for true and 0 for false.
fn number(value: &Value) -> u64 {
    value.as_u64().or(value.as_bool().map(u64::from)).expect("a count or an answer")
}

#[test]
fn counts_agree() {
    let Some(folder) = mesh_folder() else { return };
    let mut compared = 0;
    let mut differences = Vec::new();
    for record in records(&folder) {
        let name = record["dst"].as_str().expect("every record names its file");
        let theirs = &record["s"];
        if number(&theirs["bad_index_tris"]) > 0 || number(&theirs["nonfinite_verts"]) > 0 {
            assert!(load(&folder.join(name)).is_err(), "{name} has no topology and was loaded");
            continue;
        }
        let file = load(&folder.join(name)).unwrap_or_else(|error| panic!("{error}"));
        let ours = world_report(&file);
        let unlisted_vertices = file.meshes.iter().map(|mesh| mesh.unlisted_vertices).sum();
        for (key, ours, theirs) in pairs(theirs, &ours, unlisted_vertices) {
            if u64::from(ours) != number(&theirs) {
                differences.push(format!("{name}: {key} is {ours} and not {theirs}"));
            }
        }
        compared += 1;
    }
    assert!(differences.is_empty(), "{}", differences.join("\n"));
    assert!(compared > 0, "{} lists no mesh", folder.display());
}
