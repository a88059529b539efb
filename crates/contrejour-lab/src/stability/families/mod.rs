//! The families, a file a subject.

mod broken;
mod cone_angles;
mod contact;
mod counts;
mod far_plane;
mod intensity;
mod lamps;
mod light_places;
mod map_sizes;
mod overlaps;
mod projections;
mod shapes;
mod silhouette_maps;
mod sizes;
mod techniques;
mod wide_smoothies;

use super::family::Family;
#[cfg(test)]
pub(super) use lamps::a_lamp_amid_a_ring;

/// All families, in the order of the page.
pub const FAMILIES: [Family; 34] = [
    sizes::SCALE,
    sizes::DISTANCE,
    shapes::SLIVERS,
    shapes::COPLANAR,
    shapes::COLLINEAR,
    light_places::ON_PLANE,
    light_places::INSIDE,
    light_places::LIGHT_DISTANCE,
    light_places::PARALLEL,
    projections::POINT_EDGES,
    projections::COINCIDENT,
    projections::SHARP_TURNS,
    projections::NEAR_PLANE,
    projections::BEHIND_LIGHT,
    lamps::BORDERS,
    lamps::AMID,
    lamps::SIZES,
    lamps::SCALES,
    lamps::NEAR_PLANES,
    counts::TEXEL_FACES,
    counts::EDGE_ON,
    counts::FAN,
    counts::TEN_MILLION,
    broken::BROKEN,
    broken::FEW,
    contact::CONTACT,
    far_plane::FAR_PLANE,
    wide_smoothies::WIDE_SMOOTHIES,
    map_sizes::MAP_SIZES,
    cone_angles::CONE_ANGLES,
    overlaps::OVERLAPS,
    intensity::INTENSITY,
    techniques::TECHNIQUES,
    silhouette_maps::SILHOUETTE_MAPS,
];
