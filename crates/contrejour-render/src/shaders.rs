//! WGSL text of the modules that only our own pictures need.

/// Joins files of `shaders/`, the module's own first so that the lines of error messages are its lines.
macro_rules! wgsl {
    ($($file:literal),+) => {
        concat!($(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/shaders/", $file, ".wgsl")), "\n",)+)
    };
}

/// Depth and ambient light from the eye.
pub(crate) const AMBIENT: &str = wgsl!("raster/ambient", "shared/surface_light", "shared/falloff", "shared/surface");

/// One light from the eye; to be joined with a visibility function, the library's at bind group 2.
pub(crate) const SHADE: &str = wgsl!("raster/shade", "shared/surface_light", "shared/falloff", "shared/surface");

/// The visibility function of a light that throws no shadow.
pub(crate) const UNSHADOWED: &str = wgsl!("shared/unshadowed");

/// Tones of what was added up.
pub(crate) const PICTURE: &str = wgsl!("raster/picture", "shared/tone_map", "shared/full_screen");

/// Shading from the eye by a visibility that was found before.
pub(crate) const COMPOSE: &str =
    wgsl!("raster/compose", "shared/surface_light", "shared/falloff", "shared/tone_map", "shared/surface");

/// The points on which shadow falls.
pub(crate) const RECEIVERS: &str = wgsl!("raster/receivers", "shared/surface");

/// Visibility of those points; to be joined with the library's visibility function at bind group 1.
pub(crate) const JUDGED_VISIBILITY: &str = wgsl!("raster/judged_visibility", "shared/full_screen");

/// Silhouette edges as lines.
pub(crate) const SILHOUETTE_LINES: &str = wgsl!("raster/silhouette_lines");

/// Triangles of a pass of the library's, counted.
pub(crate) const COUNTED_TRIANGLES: &str = wgsl!("raster/counted_triangles");

#[cfg(test)]
mod tests {
    use super::*;
    use naga::valid::{Capabilities, ValidationFlags, Validator};

    use crate::frame_uniforms::FrameUniforms;
    use crate::silhouette_lines::Overlay;
    use crate::surface::Surface;
    use crate::surface_light::SurfaceLight;

    /// The module, which must be valid without any feature of the device.
    fn valid(wgsl: &str) -> naga::Module {
        let module =
            naga::front::wgsl::parse_str(wgsl).unwrap_or_else(|error| panic!("{}", error.emit_to_string(wgsl)));
        let checked = Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(&module);
        checked.unwrap_or_else(|error| panic!("{}", error.emit_to_string(wgsl)));
        module
    }

    fn size_of_struct(module: &naga::Module, name: &str) -> usize {
        let types = module.types.iter().map(|(_, described)| described);
        let found = types.filter(|described| described.name.as_deref() == Some(name)).find_map(|described| {
            match described.inner {
                naga::TypeInner::Struct { span, .. } => Some(span as usize),
                _ => None,
            }
        });
        found.unwrap_or_else(|| panic!("the module has a struct {name}"))
    }

    #[test]
    fn what_draws_the_scene_is_valid() {
        // The library's own tests check its functions; here one of that name will do.
        for module in [AMBIENT, &format!("{SHADE}{UNSHADOWED}"), COMPOSE, RECEIVERS].map(valid) {
            assert_eq!(size_of_struct(&module, "Frame"), size_of::<FrameUniforms>());
            assert_eq!(size_of_struct(&module, "Surface"), size_of::<Surface>());
        }
        assert_eq!(size_of_struct(&valid(AMBIENT), "SurfaceLight"), size_of::<SurfaceLight>());
        valid(PICTURE);
    }

    #[test]
    fn judged_visibility_is_valid() {
        valid(&format!("{JUDGED_VISIBILITY}{UNSHADOWED}"));
    }

    #[test]
    fn counted_triangles_are_valid() {
        valid(COUNTED_TRIANGLES);
    }

    #[test]
    fn silhouette_lines_are_valid() {
        assert_eq!(size_of_struct(&valid(SILHOUETTE_LINES), "Overlay"), size_of::<Overlay>());
    }
}
