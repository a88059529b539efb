//! The WGSL text of every shader module, joined at compile time from the files in `shaders/`.
//!
//! Module scope has no order in WGSL, so a module is its own file followed by the shared files that it names: line
//! numbers in error messages stay those of its own file.

use contrejour_plan::{ViewChoice, VisibilityKind};

use crate::visibility_wgsl::pass_wgsl;
pub use crate::visibility_wgsl::visibility_wgsl;
pub use crate::wgsl::ShaderModule;
use crate::{passes, stages};

/// Every shader module that this crate can create, for tests and tools; a frame creates only those that its plan lists.
pub fn all() -> impl Iterator<Item = ShaderModule> {
    let compute = stages::ALL.iter().map(|stage| ShaderModule::of(stage.stage.name(), stage.wgsl));
    let scene = stages::SCENE.iter().map(|stage| ShaderModule::of(stage.stage.name(), stage.wgsl));
    let both = VisibilityKind::examples().flat_map(|kind| ViewChoice::EXAMPLES.map(|choice| (kind, choice)));
    let visibility = both.map(|(kind, choice)| ShaderModule {
        name: format!("visibility+{kind:?}+{choice:?}").into(),
        wgsl: pass_wgsl(kind, choice).into(),
    });
    scene.chain(compute).chain(passes::MODULES.iter().cloned()).chain(visibility)
}
