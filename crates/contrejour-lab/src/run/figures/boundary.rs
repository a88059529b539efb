//! The edge of a hard shadow on a floor, seen from near, and how far it is from where it should be.

use std::sync::Arc;

use contrejour_plan::{Light, LightKind, ShadowSettings, View, views};
use contrejour_render::{Gpu, Judge};
use contrejour_scene::{Camera, Scene, SceneLight};
use glam::{DVec2, DVec3, Vec4Swizzles};
use image::RgbaImage;

use super::super::error::RunError;
use super::sight::{built_in, with_radii};
use crate::report::visibility_picture;

/// What casts: a sheet of an outline that is straight or round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Outline {
    /// A square, turned so that no side runs along texels.
    Straight,
    /// A polygon of so many corners that it looks round.
    Round,
}

/// Height of the sheet over the floor, half its side and its radius. Unit: metres.
const HEIGHT: f64 = 1.2;
const HALF_SIDE: f64 = 0.8;

/// By how much the square is turned. Unit: radians.
const TURN: f64 = 0.3;

const ROUND_CORNERS: u32 = 512;

/// Texels across the picture.
const TEXELS_ACROSS: f64 = 40.0;

/// Where the camera stands: beside the edge and lower than the sheet.
const EYE_OFFSET: DVec3 = DVec3::new(0.5, 0.8, 0.7);

/// The edge of a shadow at one map size.
pub(super) struct BoundaryScene {
    judge: Judge,
    light: Light,
    shadow: ShadowSettings,
    size: [u32; 2],
    /// Corners of the outline on the image plane, in order.
    outline_ndc: Vec<DVec2>,
    /// Where each pixel's receiver is on the image plane.
    places_ndc: Vec<Option<DVec2>>,
}

/// Distances between the edge of a shadow and the true one. Unit: texels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct BoundaryError {
    /// Places where the edge crosses from pixel to pixel.
    pub crossings: usize,
    pub mean: f64,
    pub largest: f64,
}

impl BoundaryScene {
    pub fn new(gpu: &Gpu, outline: Outline, map_size: u32, size: [u32; 2]) -> Result<Self, RunError> {
        let mut scene = with_radii(built_in("square")?, |_| 0.0);
        let corners_world = corners(outline);
        place_sheet(&mut scene, &corners_world);
        let SceneLight { light, mut shadow, .. } = *scene.first_light()?;
        shadow.map_size = map_size;
        look_at_edge(&mut scene, &light, map_size, (corners_world[0] + corners_world[1]) / 2.0)?;
        scene.resize(size);

        let judge = Judge::new(gpu.clone(), &scene)?;
        let local = judge.local_space();
        let view = views(&local.light(&light))?[0];
        let outline_ndc = corners_world.iter().map(|corner| place_ndc(&view, local.point(*corner))).collect();
        let places = judge.receivers()?.points.into_iter();
        let places_ndc = places.map(|point| point.map(|point| place_ndc(&view, point.position.as_dvec3()))).collect();
        Ok(Self { judge, light, shadow, size, outline_ndc, places_ndc })
    }

    /// The visibility that a technique gives each pixel.
    pub fn visibility(&self, settings: impl Fn(&ShadowSettings) -> ShadowSettings) -> Result<Vec<f32>, RunError> {
        let mut contestant = self.judge.contestant(&settings(&self.shadow))?;
        contestant.draw(&self.light)?;
        Ok(contestant.visibility()?)
    }

    /// Visibility as grey.
    pub fn grey(&self, visibility: &[f32]) -> Result<RgbaImage, RunError> {
        let receives: Vec<bool> = self.places_ndc.iter().map(Option::is_some).collect();
        Ok(visibility_picture(self.size, visibility, &receives)?)
    }

    /// How far the places where a visibility is one half are from the outline's image.
    pub fn error(&self, visibility: &[f32]) -> BoundaryError {
        let [width, _] = self.size.map(|side| side as usize);
        let texels_per_ndc = 0.5 * f64::from(self.shadow.map_size);
        let crossing = |one: usize, other: usize| {
            let places = self.places_ndc.get(one).copied().flatten().zip(self.places_ndc.get(other).copied().flatten());
            let (first, second) = places?;
            let [begin, end] = [one, other].map(|pixel| f64::from(visibility[pixel]) - 0.5);
            let crosses = (begin < 0.0) != (end < 0.0);
            crosses.then(|| first.lerp(second, begin / (begin - end)))
        };
        let pixels = 0..self.places_ndc.len();
        let across =
            pixels.clone().filter(|pixel| (pixel + 1) % width != 0).filter_map(|pixel| crossing(pixel, pixel + 1));
        let down = pixels.filter_map(|pixel| crossing(pixel, pixel + width));
        let distances: Vec<f64> =
            across.chain(down).map(|place| texels_per_ndc * distance_to(&self.outline_ndc, place)).collect();
        BoundaryError {
            crossings: distances.len(),
            mean: distances.iter().sum::<f64>() / distances.len().max(1) as f64,
            largest: distances.iter().copied().fold(0.0, f64::max),
        }
    }
}

/// Corners of the sheet, counter-clockwise from above.
fn corners(outline: Outline) -> Vec<DVec3> {
    let (count, radius) = match outline {
        Outline::Straight => (4, HALF_SIDE * 2.0_f64.sqrt()),
        Outline::Round => (ROUND_CORNERS, HALF_SIDE),
    };
    let corner = |index: u32| {
        let angle = TURN + std::f64::consts::TAU * f64::from(index) / f64::from(count);
        DVec3::new(radius * angle.cos(), HEIGHT, -radius * angle.sin())
    };
    (0..count).map(corner).collect()
}

/// Puts the sheet where the scene's square is. It casts and does not receive; the floor receives and does not cast, so there
/// is no other edge.
fn place_sheet(scene: &mut Scene, corners: &[DVec3]) {
    for placed in &mut scene.meshes {
        let is_sheet = placed.name == "square";
        (placed.casts, placed.receives) = (is_sheet, !is_sheet);
        if is_sheet {
            placed.world_from_object = glam::DMat4::IDENTITY;
            let mesh = Arc::make_mut(&mut placed.mesh);
            mesh.positions = corners.iter().map(|corner| corner.as_vec3().to_array()).collect();
            mesh.normals = vec![[0.0, 1.0, 0.0]; corners.len()];
            mesh.colors.resize(corners.len(), contrejour_mesh::TriangleMesh::DEFAULT_COLOR);
            mesh.vertex_numbers = (0..corners.len() as u32).collect();
            mesh.triangles = (1..corners.len() as u32 - 1).map(|index| [0, index, index + 1]).collect();
        }
    }
}

/// Turns the camera to where the shadow of a point of the outline falls, so near that texels can be told apart.
fn look_at_edge(scene: &mut Scene, light: &Light, map_size: u32, edge: DVec3) -> Result<(), RunError> {
    let view = views(light)?[0];
    let LightKind::Spot { position, .. } = light.kind else { return Err(RunError::NoScene { name: "square" }) };
    let target = position + (edge - position) * (position.y / (position.y - edge.y));
    let eye = target + EYE_OFFSET;
    let across = TEXELS_ACROSS * view.texel_world(map_size) * position.distance(target);
    let distance = eye.distance(target);
    let fov_y = 2.0 * (0.75 * 0.5 * across / distance).atan();
    scene.camera = Camera { eye, target, fov_y, near: 0.1 * distance, far: 10.0 * distance, ..scene.camera };
    Ok(())
}

fn place_ndc(view: &View, position: DVec3) -> DVec2 {
    let clip = view.light_clip_from_world * position.extend(1.0);
    clip.xy() / clip.w
}

/// Distance of a place to the nearest side of a closed polygon.
fn distance_to(polygon: &[DVec2], place: DVec2) -> f64 {
    let sides = polygon.iter().zip(polygon.iter().cycle().skip(1));
    let distance = |(begin, end): (&DVec2, &DVec2)| {
        let along = end - begin;
        let share = ((place - begin).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        place.distance(begin + share * along)
    };
    sides.map(distance).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use contrejour_plan::Technique;

    use super::*;
    use crate::test_device::device;

    const SIZE: [u32; 2] = [320, 240];

    fn error(scene: &BoundaryScene, name: &str) -> BoundaryError {
        let technique: Technique = name.parse().expect("listed");
        let visibility = scene.visibility(|shadow| ShadowSettings { technique, ..*shadow });
        scene.error(&visibility.expect("it can be drawn"))
    }

    #[test]
    fn silhouette_maps_are_four_times_as_exact_as_shadow_maps() {
        let Some(gpu) = device() else { return };
        for outline in [Outline::Straight, Outline::Round] {
            let scene = BoundaryScene::new(&gpu, outline, 512, SIZE).expect("it can be drawn");
            let stairs = error(&scene, "shadow-map");
            assert!(stairs.crossings > 300 && stairs.mean > 0.1 && stairs.largest < 2.0, "{outline:?}: {stairs:?}");
            for name in ["silhouette-map", "silhouette-map-tam", "silhouette-map-stream"] {
                let edge = error(&scene, name);
                eprintln!("{outline:?}, {name}: {edge:?}; shadow map: {stairs:?}");
                assert!(edge.crossings > 200 && 4.0 * edge.mean <= stairs.mean, "{outline:?}, {name}: {edge:?}");
                assert!(4.0 * edge.largest <= stairs.largest, "{outline:?}, {name}: {edge:?}");
            }
        }
    }

    #[test]
    fn an_edge_elsewhere_is_as_far_as_it_is() {
        let Some(gpu) = device() else { return };
        let scene = BoundaryScene::new(&gpu, Outline::Round, 512, SIZE).expect("it can be drawn");
        let inside = |place: DVec2, grown_texels: f64| {
            let middle = scene.outline_ndc.iter().sum::<DVec2>() / scene.outline_ndc.len() as f64;
            let distance = distance_to(&scene.outline_ndc, place) * 256.0;
            let is_inside = scene
                .outline_ndc
                .iter()
                .all(|corner| (place - middle).dot(corner - middle) < (corner - middle).length_squared());
            let signed = if is_inside { distance } else { -distance };
            // A ramp of two texels.
            (0.5 - 0.5 * (signed + grown_texels)).clamp(0.0, 1.0) as f32
        };
        for grown in [0.0, 0.75] {
            let visibility: Vec<f32> =
                scene.places_ndc.iter().map(|place| place.map_or(1.0, |place| inside(place, grown))).collect();
            let error = scene.error(&visibility);
            assert!((error.mean - grown).abs() < 0.05 && error.crossings > 200, "{grown}: {error:?}");
        }
    }
}
