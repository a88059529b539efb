//! The WGSL text of every shader module, joined at compile time from the files in `shaders/`.
//!
//! Module scope has no order in WGSL, so a module is its own file followed by the shared files that it names: line
//! numbers in error messages stay those of its own file.

/// Joins a file of `shaders/` with files of `shaders/shared/`.
macro_rules! wgsl {
    ($file:literal $(, $shared:literal)* $(,)?) => {
        concat!(
            include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/shaders/", $file, ".wgsl")),
            $("\n", include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/shaders/shared/", $shared, ".wgsl")),)*
        )
    };
}
pub(crate) use wgsl;

use crate::{passes, stages};

/// One shader module.
#[derive(Clone, Copy, Debug)]
pub struct ShaderModule {
    /// Path of its own file below `shaders/`, without the ending; a variant adds `+` and what it is joined with.
    pub name: &'static str,
    /// Its whole text.
    pub wgsl: &'static str,
}

/// Every shader module that this crate can create, for tests and tools; a frame creates only those that its plan lists.
pub fn all() -> impl Iterator<Item = ShaderModule> {
    let compute = stages::ALL.iter().map(|stage| ShaderModule { name: stage.stage.name(), wgsl: stage.wgsl });
    compute.chain(passes::MODULES.iter().copied())
}
