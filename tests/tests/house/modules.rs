//! Every shader module that the workspace creates, with naga's understanding of it.

use std::fs;
use std::path::{Path, PathBuf};

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
    for variant in [
        &["visibility_shadow_map"][..],
        &["visibility_smoothies", "smoothie_split"],
        &["visibility_smoothies", "smoothie_packed"],
    ] {
        let shared = ["receiver", "receiver_lookup"].iter().chain(variant);
        let shared = shared.map(|name| shader_file(&format!("shared/{name}.wgsl")));
        let shared: Vec<_> = shared.collect();
        // As the library's `visibility_wgsl` writes it for the bind group that the renderer's module leaves to it.
        for (own, files, group) in [
            ("shade", &["raster/shade", "shared/surface_light", "shared/surface"][..], 2),
            ("judged_visibility", &["raster/judged_visibility"], 1),
        ] {
            let own_text = files.iter().map(|file| shader_file(&format!("{file}.wgsl")));
            let group = format!("const CONTREJOUR_GROUP = {group}u;");
            let text: Vec<_> = own_text.chain([group]).chain(shared.iter().cloned()).collect();
            modules.push(Module { name: format!("{own}+{}", variant.join("+")), wgsl: text.join("\n") });
        }
    }
    for (name, files) in [
        ("receivers", &["raster/receivers", "shared/surface"][..]),
        ("compose", &["raster/compose", "shared/surface_light", "shared/surface"]),
        ("silhouette_lines", &["raster/silhouette_lines"]),
    ] {
        let text: Vec<_> = files.iter().map(|file| shader_file(&format!("{file}.wgsl"))).collect();
        modules.push(Module { name: name.into(), wgsl: text.join("\n") });
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
