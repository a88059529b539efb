//! Every shader module that the workspace creates, with naga's understanding of it.

use std::fs;
use std::path::{Path, PathBuf};

use contrejour_gpu::shaders::visibility_wgsl;
use contrejour_plan::{ViewChoice, VisibilityKind};

/// A module's name and whole text.
pub struct Module {
    pub name: String,
    pub wgsl: String,
}

/// The checkout.
pub fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// A file of `shaders/`.
pub fn shader_file(path: &str) -> String {
    let path = workspace().join("shaders").join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Stems of the files in a folder of the checkout with an ending, sorted.
pub fn stems(folder: &str, ending: &str) -> Vec<String> {
    let path = workspace().join(folder);
    let entries = fs::read_dir(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut stems: Vec<_> = entries
        .filter_map(|entry| {
            let name = entry.expect("the folder can be read").file_name().into_string().expect("names are plain");
            Some(name.strip_suffix(ending)?.to_owned())
        })
        .collect();
    stems.sort();
    stems
}

/// The library's modules, and those of the renderer joined with each visibility function.
pub fn all() -> Vec<Module> {
    let library = contrejour_gpu::shaders::all();
    let mut modules: Vec<_> =
        library.map(|module| Module { name: module.name.into(), wgsl: module.wgsl.into() }).collect();
    let joined = |files: &[&str]| -> String {
        let text: Vec<_> = files.iter().map(|file| shader_file(&format!("{file}.wgsl"))).collect();
        text.join("\n")
    };
    let both = VisibilityKind::examples().flat_map(|kind| ViewChoice::EXAMPLES.map(|choice| (kind, choice)));
    for (kind, choice) in both {
        // At the bind groups that the renderer's modules leave to the library.
        for (own, files, group) in [
            ("shade", &["raster/shade", "shared/surface_light", "shared/falloff", "shared/surface"][..], 2),
            ("judged_visibility", &["raster/judged_visibility", "shared/full_screen"], 1),
        ] {
            let wgsl = format!("{}\n{}", joined(files), visibility_wgsl(kind, choice, group));
            modules.push(Module { name: format!("{own}+{kind:?}+{choice:?}"), wgsl });
        }
    }
    for (name, files) in [
        ("receivers", &["raster/receivers", "shared/surface"][..]),
        ("ambient", &["raster/ambient", "shared/surface_light", "shared/falloff", "shared/surface"]),
        (
            "shade+unshadowed",
            &["raster/shade", "shared/surface_light", "shared/falloff", "shared/surface", "shared/unshadowed"],
        ),
        ("picture", &["raster/picture", "shared/tone_map", "shared/full_screen"]),
        ("compose", &["raster/compose", "shared/surface_light", "shared/falloff", "shared/tone_map", "shared/surface"]),
        ("silhouette_lines", &["raster/silhouette_lines"]),
        ("counted_triangles", &["raster/counted_triangles"]),
    ] {
        modules.push(Module { name: name.into(), wgsl: joined(files) });
    }
    modules
}

/// Parses WGSL; the message of a fault shows its line.
pub fn parse(module: &Module) -> naga::Module {
    naga::front::wgsl::parse_str(&module.wgsl)
        .unwrap_or_else(|error| panic!("{}: {}", module.name, error.emit_to_string(&module.wgsl)))
}

#[test]
fn every_shader_file_is_part_of_a_module() {
    let modules = all();
    for folder in ["compute", "raster", "shared"] {
        for stem in stems(&format!("shaders/{folder}"), ".wgsl") {
            let text = shader_file(&format!("{folder}/{stem}.wgsl"));
            assert!(modules.iter().any(|module| module.wgsl.contains(&text)), "{folder}/{stem}.wgsl is used nowhere");
        }
    }
}
