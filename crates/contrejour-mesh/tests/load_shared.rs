//! Loads meshes that nobody here wrote and compares their counts with those of independent programs.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use contrejour_mesh::{LoadError, MeshFile, load};
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

/// The records of `meshes.json`, whose writer puts NaN and Infinity where JSON has null.
fn records(folder: &Path) -> Vec<Value> {
    let text = std::fs::read_to_string(folder.join("meshes.json")).expect("is a readable file");
    let is_number = |line: &str| !matches!(line.trim().trim_end_matches(','), "NaN" | "Infinity" | "-Infinity");
    let lines = text.lines().map(|line| match is_number(line) {
        true => line.to_owned(),
        false => line.replace("-Infinity", "null").replace("Infinity", "null").replace("NaN", "null"),
    });
    let text: Vec<String> = lines.collect();
    serde_json::from_str(&text.join("\n")).expect("is JSON once null stands for what is no number")
}

/// Distinct positions of triangle corners, `-0.0` = `0.0`.
fn used_position_count(file: &MeshFile) -> u64 {
    let mesh = &file.meshes[0];
    let bits = |&vertex: &u32| mesh.positions[vertex as usize].map(|x| (x + 0.0).to_bits());
    let used: HashSet<[u32; 3]> = mesh.triangles.as_flattened().iter().map(bits).collect();
    used.len() as u64
}

fn check_lists(file: &MeshFile, name: &str) {
    for mesh in &file.meshes {
        let count = mesh.positions.len();
        assert_eq!(mesh.normals.len(), count, "{name}");
        assert_eq!(mesh.colors.len(), count, "{name}");
        assert_eq!(mesh.vertex_numbers.len(), count, "{name}");
        assert!(mesh.triangles.as_flattened().iter().all(|&vertex| (vertex as usize) < count), "{name}");
        for normal in &mesh.normals {
            let length = normal.iter().map(|x| x * x).sum::<f32>().sqrt();
            assert!((length - 1.0).abs() < 1e-5, "{name}: normal {normal:?}");
        }
        assert!(mesh.colors.as_flattened().iter().all(|channel| (0.0..=1.0).contains(channel)), "{name}");
    }
}

#[test]
fn counts_agree_with_independent_programs() {
    let Some(folder) = mesh_folder() else { return };
    for record in records(&folder) {
        let name = record["dst"].as_str().expect("is a path");
        let count = |key: &str| record["s"][key].as_u64().expect("is a count");
        let loaded = load(&folder.join(name));
        if matches!(count_or_zero(&record, "nonfinite_verts"), 1..) || count("bad_index_tris") > 0 {
            check_refused(name, loaded);
            continue;
        }
        let file = loaded.unwrap_or_else(|error| panic!("{error}"));
        check_lists(&file, name);
        assert_eq!(file.triangle_count() as u64, count("T"), "{name}: triangles");

        let numbers = || file.meshes.iter().flat_map(|mesh| &mesh.vertex_numbers);
        let highest_number = u64::from(*numbers().max().expect("has vertices"));
        if name.ends_with(".obj") {
            // Only used vertices are listed, and equal positions share their lowest number.
            assert!(highest_number < count("V"), "{name}: numbers");
            let distinct: HashSet<&u32> = numbers().collect();
            assert_eq!(distinct.len() as u64, count_in(&record, "weld", "V"), "{name}: numbers");
            assert_eq!(u64::from(file.meshes[0].unlisted_vertices), count("unreferenced_verts"), "{name}: unused");
        } else {
            assert_eq!(highest_number + 1, count("V"), "{name}: vertices");
        }
        // Theirs are welded in world space, all nodes together.
        if file.nodes.len() == 1 {
            assert_eq!(used_position_count(&file), count_in(&record, "weld", "V"), "{name}: welded vertices");
        }
    }
}

fn count_or_zero(record: &Value, key: &str) -> u64 {
    record["s"][key].as_u64().unwrap_or(0)
}

fn count_in(record: &Value, group: &str, key: &str) -> u64 {
    record["s"][group][key].as_u64().expect("is a count")
}

fn check_refused(name: &str, loaded: Result<MeshFile, LoadError>) {
    let error = loaded.expect_err("has a vertex that is not finite, or an index out of range");
    let place = match &error {
        LoadError::NotFinite { place, .. } | LoadError::IndexOutOfRange { place, .. } => place.clone(),
        _ => panic!("{error}"),
    };
    let message = error.to_string();
    assert!(message.contains(name) && message.contains(&place) && !message.contains('\n'), "{message}");
    let expected = match name {
        "nasty/BoxWithInfinites.glb" => "node 1 \"nodes_1\", mesh 0, primitive 0, vertex 0",
        "nasty/IndexOutOfRange/IndexOutOfRange.gltf" => "node 1, mesh 0, primitive 0",
        "nasty/invalid_index.obj" => "line 12",
        "nasty/inf_nan.obj" => "line 1",
        _ => panic!("{name} is refused: {message}"),
    };
    assert_eq!(place, expected, "{name}");
}

/// Files that are cut off or have wrong bytes are loaded or refused: no panic, no endless loop, no huge allocation.
#[test]
fn broken_bytes_never_panic() {
    let Some(folder) = mesh_folder() else { return };
    let temporary = tempfile::tempdir().expect("a temporary folder can be made");
    let mut state = 1_u32;
    let mut random = move || {
        // xorshift (Marsaglia 2003)
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        state as usize
    };
    for name in [
        "nasty/BoxWithInfinites.glb",
        "nasty/IndexOutOfRange/IndexOutOfRange.gltf",
        "nasty/fan3.obj",
        "nasty/large_block_obb.STL",
        "animated/RiggedSimple.glb",
        "animated/SimpleSkin/SimpleSkin.gltf",
    ] {
        let original = std::fs::read(folder.join(name)).expect("is a readable file");
        let file_name = Path::new(name).file_name().expect("names a file");
        let path = temporary.path().join(file_name);
        for _ in 0..400 {
            let mut bytes = original.clone();
            for _ in 0..1 + random() % 4 {
                let at = random() % bytes.len();
                bytes[at] = if random() % 2 == 0 { b'0' + (random() % 10) as u8 } else { random() as u8 };
            }
            if random() % 4 == 0 {
                bytes.truncate(1 + random() % bytes.len());
            }
            std::fs::write(&path, &bytes).expect("the temporary folder is writable");
            if let Ok(file) = load(&path) {
                check_lists(&file, name);
            }
        }
    }
}
