//! Writes the meshes that contrejour ships into `assets/meshes`.

use std::error::Error;
use std::path::Path;

use contrejour_scene::MESH_ASSETS;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/meshes");
    for asset in MESH_ASSETS {
        let path = folder.join(asset.file_name);
        std::fs::write(&path, asset.text()?)?;
        println!("{}", path.display());
    }
    Ok(())
}
