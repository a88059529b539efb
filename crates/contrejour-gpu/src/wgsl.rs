//! Shader text, joined at compile time.

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
#[derive(Clone, Copy, Debug)]
pub struct ShaderModule {
    /// The stem of its own file; a variant adds `+` and what it is joined with.
    pub name: &'static str,
    /// Its whole text.
    pub wgsl: &'static str,
}
