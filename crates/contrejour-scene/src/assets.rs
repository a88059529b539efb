//! Meshes that contrejour ships as files.

use crate::obj_text;
use crate::shapes::{Shape, ShapeError};

/// A generated mesh that is also kept as a file in `assets/meshes`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshAsset {
    /// Name of the file.
    pub file_name: &'static str,
    /// What is in it.
    pub shape: Shape,
}

/// All of them.
pub const MESH_ASSETS: &[MeshAsset] = &[
    MeshAsset {
        file_name: "knot.obj",
        shape: Shape::Knot { radius: 1.0, tube_radius: 0.22, segments: 100, sides: 10 },
    },
    MeshAsset { file_name: "elephant.obj", shape: Shape::Elephant { height: 2.0, segments: 24 } },
];

impl MeshAsset {
    /// The text of the file.
    ///
    /// # Errors
    /// None for the assets in [`MESH_ASSETS`], as a test asserts.
    pub fn text(&self) -> Result<String, ShapeError> {
        Ok(obj_text(&self.shape.generate()?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_hold_what_the_code_generates() {
        for asset in MESH_ASSETS {
            let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/meshes").join(asset.file_name);
            let kept = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            let text = asset.text().unwrap_or_else(|error| panic!("{error}"));
            let same = kept.lines().eq(text.lines());
            assert!(same, "{} differs: run `cargo run -p contrejour-scene --example write_assets`", path.display());
        }
    }
}
