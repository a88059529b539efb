//! The text of the visibility functions.

use std::fmt::Write;

use contrejour_plan::{EdgeProfile, ViewChoice, VisibilityKind};

use crate::wgsl::wgsl;

/// Joins the files of a visibility function.
macro_rules! function {
    ($($shared:literal),*) => { wgsl!("shared/receiver_lookup", "receiver", $($shared),*) };
}

const COMPARED: &str = function!("visibility_shadow_map", "shadow_comparison");
const GAUSSIAN_PCF: &str = function!("visibility_gaussian_pcf", "shadow_comparison", "receiver_plane");
const BICUBIC_PCF: &str = function!("visibility_bicubic_pcf", "shadow_comparison", "receiver_plane");
const PCSS: &str =
    function!("visibility_pcss", "disk_samples", "blocker_search", "shadow_comparison", "receiver_plane");
const VSM: &str = function!("visibility_moments", "moments", "moments_plain");
const EVSM: &str = function!("visibility_moments", "moments", "moments_warped", "warp");
const VSM_PCSS: &str = function!("visibility_moments_pcss", "blocker_search", "moments", "moments_plain");
const EVSM_PCSS: &str = function!("visibility_moments_pcss", "blocker_search", "moments", "moments_warped", "warp");
const SMOOTHIES_SPLIT: &str = function!("visibility_smoothies", "receiver_texels", "receiver_depth", "smoothie_split");
const SMOOTHIES_PACKED: &str =
    function!("visibility_smoothies", "receiver_texels", "receiver_depth", "smoothie_packed");
const SILHOUETTE_MAP: &str =
    function!("visibility_silhouette_map", "receiver_depth", "disk_samples", "blocker_search", "receiver_plane");

const ONLY_VIEW: &str = wgsl!("shared/receiver_view_only");
const CUBE_VIEWS: &str = wgsl!("shared/receiver_view_of_cube");
const CASCADES: &str = wgsl!("shared/receiver_view_of_cascades");

const PASS: &str = wgsl!("raster/visibility", "eye", "full_screen");

/// The function `contrejour_visibility` of a kind, with its bindings in a bind group: what
/// [`Shadows::visibility_wgsl`](crate::Shadows::visibility_wgsl) gives for the kind that a light has.
pub fn visibility_wgsl(kind: VisibilityKind, choice: ViewChoice, group: u32) -> String {
    let (views, light_is_sphere) = (choice.views(), choice == ViewChoice::CubeFace);
    let mut text = format!("const CONTREJOUR_GROUP = {group}u;\nconst CONTREJOUR_VIEWS = {views}u;\n");
    text.push_str(&format!("const CONTREJOUR_LIGHT_IS_SPHERE = {light_is_sphere};\n"));
    text.push_str(&constants(kind));
    text.push_str(match kind {
        VisibilityKind::Compared(_) => COMPARED,
        VisibilityKind::GaussianPcf(_) => GAUSSIAN_PCF,
        VisibilityKind::BicubicPcf => BICUBIC_PCF,
        VisibilityKind::Pcss { .. } => PCSS,
        VisibilityKind::Variance { warped: false, from_light_size: false } => VSM,
        VisibilityKind::Variance { warped: true, from_light_size: false } => EVSM,
        VisibilityKind::Variance { warped: false, from_light_size: true } => VSM_PCSS,
        VisibilityKind::Variance { warped: true, from_light_size: true } => EVSM_PCSS,
        VisibilityKind::SmoothiesSplit => SMOOTHIES_SPLIT,
        VisibilityKind::SmoothiesPacked => SMOOTHIES_PACKED,
        VisibilityKind::SilhouetteMap { .. } => SILHOUETTE_MAP,
    });
    text.push_str(match choice {
        ViewChoice::Only => ONLY_VIEW,
        ViewChoice::CubeFace => CUBE_VIEWS,
        ViewChoice::Cascade { .. } => CASCADES,
    });
    text
}

/// The full-screen pass with the function of a kind.
pub(crate) fn pass_wgsl(kind: VisibilityKind, choice: ViewChoice) -> String {
    format!("{PASS}\n{}", visibility_wgsl(kind, choice, VISIBILITY_GROUP))
}

/// The bind group of the light's maps in the full-screen pass.
const VISIBILITY_GROUP: u32 = 1;

/// The numbers that loops and arrays of a kind are made for.
fn constants(kind: VisibilityKind) -> String {
    let mut text = String::new();
    let mut constant = |name: &str, value: String| {
        // Writing into a string does not fail.
        let _ = writeln!(text, "const CONTREJOUR_{name} = {value};");
    };
    match kind {
        VisibilityKind::GaussianPcf(kernel) => {
            let weights: Vec<_> = kernel.weights().iter().map(|weight| format!("{weight:?}")).collect();
            constant("KERNEL", format!("array<f32, {}>({})", weights.len(), weights.join(", ")));
            constant("LOOKUPS", weights.len().div_ceil(2).to_string());
        }
        VisibilityKind::Pcss { blocker_samples, filter_samples } => {
            constant("BLOCKER_SAMPLES", format!("{blocker_samples}u"));
            constant("FILTER_SAMPLES", format!("{filter_samples}u"));
        }
        VisibilityKind::SilhouetteMap { samples, profile } => {
            constant("SAMPLES", format!("{samples}u"));
            constant("PROFILE_IS_DISK", (profile == EdgeProfile::Disk).to_string());
        }
        _ => {}
    }
    text
}
