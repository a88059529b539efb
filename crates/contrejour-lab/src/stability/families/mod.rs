//! The families, a file a subject.

mod broken;
mod counts;
mod light_places;
mod projections;
mod shapes;
mod sizes;

use super::family::Family;

/// All families, in the order of the page.
pub const FAMILIES: [Family; 20] = [
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
    counts::TEXEL_FACES,
    counts::EDGE_ON,
    counts::FAN,
    counts::TEN_MILLION,
    broken::BROKEN,
    broken::FEW,
];
