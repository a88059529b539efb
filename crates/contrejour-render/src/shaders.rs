//! WGSL text of the modules that only our own pictures need.

/// Joins files of `shaders/`.
macro_rules! wgsl {
    ($file:literal) => {
        include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/shaders/", $file))
    };
}

/// Shading from the eye; to be joined with the library's visibility function at bind group 2.
pub(crate) const SHADE: &str = wgsl!("raster/shade.wgsl");

/// Silhouette edges as lines.
pub(crate) const SILHOUETTE_LINES: &str = wgsl!("raster/silhouette_lines.wgsl");

/// The bind group of the light's maps in [`SHADE`].
pub(crate) const VISIBILITY_GROUP: u32 = 2;
