//! Shader text, joined at compile time.

use std::borrow::Cow;

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

/// One shader module.
#[derive(Clone, Debug)]
pub struct ShaderModule {
    /// The stem of its own file; a variant adds `+` and what it is joined with.
    pub name: Cow<'static, str>,
    /// Its whole text.
    pub wgsl: Cow<'static, str>,
}

impl ShaderModule {
    pub(crate) const fn of(name: &'static str, wgsl: &'static str) -> Self {
        Self { name: Cow::Borrowed(name), wgsl: Cow::Borrowed(wgsl) }
    }
}
