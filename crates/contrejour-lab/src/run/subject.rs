//! A scene that techniques are judged by: on the device, and for the tracer.

use std::hash::{DefaultHasher, Hasher};
use std::ops::Range;
use std::sync::Arc;

use contrejour_mesh::{BuildOptions, MaskedMesh, TopologyAwareMesh, TriangleMesh};
use contrejour_plan::{Eye, FrameViews, Light, LightKind, ShadowSettings, View, frame_views};
use contrejour_render::{Gpu, Judge};
use contrejour_scene::{Scene, SceneLight};
use contrejour_trace::{Holes, LightShape, OccluderMesh, Occluders, Receiver, TraceOptions, Visibility, trace};
use glam::DVec3;

use super::error::RunError;

/// A scene and what the report calls it.
#[derive(Clone, Debug)]
pub struct NamedScene {
    /// Its name, which no other scene of the run has.
    pub name: String,
    /// The scene.
    pub scene: Scene,
}

/// A scene on the device and in the tracer, with the points that its picture shows.
pub(crate) struct Subject {
    pub scene: Scene,
    /// The light that the techniques are about: the scene's first.
    pub light: Light,
    /// How the scene makes its shadow.
    pub shadow: ShadowSettings,
    pub judge: Judge,
    occluders: Occluders,
    /// In local space, as everything that is traced.
    receivers: Vec<Receiver>,
    /// For each receiver, its pixel.
    pixels: Vec<usize>,
    /// How many points that receive shadow are left out, because their faces have no area.
    pub without_area: usize,
}

impl Subject {
    pub fn new(gpu: &Gpu, named: &NamedScene, picture_size: [u32; 2]) -> Result<Self, RunError> {
        let mut scene = named.scene.clone();
        scene.resize(picture_size);
        let SceneLight { light, shadow, .. } = *scene.first_light()?;
        let judge = Judge::new(gpu.clone(), &scene)?;
        let local = judge.local_space();
        let meshes: Vec<OccluderMesh> = scene
            .meshes
            .iter()
            .enumerate()
            .map(|(mesh, placed)| OccluderMesh {
                positions: &placed.mesh.positions,
                triangles: &placed.mesh.triangles,
                world_from_object: local.local_from_world() * placed.world_from_object,
                casts: placed.casts,
                holes: holes(&placed.mesh, judge.masked_parts(mesh)),
            })
            .collect();
        let occluders = Occluders::new(&meshes)?;
        let seen_from = local.point(scene.camera.eye);
        let points = judge.receivers()?.points;
        let (traced, flat): (Vec<_>, Vec<_>) = (0..)
            .zip(points)
            .filter_map(|(pixel, point)| Some((pixel, point?)))
            .partition(|(_, point)| occluders.has_area(point.face_id));
        let (pixels, receivers): (Vec<usize>, Vec<Receiver>) = traced
            .into_iter()
            .map(|(pixel, point)| {
                (pixel, Receiver { position: point.position.as_dvec3(), face: point.face_id, seen_from })
            })
            .unzip();
        if receivers.is_empty() {
            return Err(RunError::NothingToCompare { scene: named.name.clone() });
        }
        Ok(Self { scene, light, shadow, judge, occluders, receivers, pixels, without_area: flat.len() })
    }

    /// Number of pixels of its picture.
    pub fn pixel_count(&self) -> usize {
        self.scene.size.map(|side| side as usize).iter().product()
    }

    /// Pixel of each receiver.
    pub fn pixels(&self) -> &[usize] {
        &self.pixels
    }

    /// How much of a light, which is somewhere in the scene's world, the first of every `stride` receivers see.
    pub fn trace(
        &self,
        light: &Light,
        options: &TraceOptions,
        stride: usize,
        progress: &(dyn Fn(usize) + Sync),
    ) -> Result<Vec<Visibility>, RunError> {
        let shape = LightShape::of(&self.judge.local_space().light(light))?;
        let chosen: Vec<Receiver> = self.receivers.iter().step_by(stride).copied().collect();
        Ok(trace(&self.occluders, &shape, &chosen, options, progress)?)
    }

    /// For each receiver, whether a light's maps show it: what is outside is lit by definition and not compared. Where the
    /// last cascade fades into light it shows less than there is, which says nothing of a technique, so that is outside too.
    pub fn in_maps(&self, light: &Light) -> Result<Vec<bool>, RunError> {
        let eye = self.eye_local();
        let seen = self.views(light, &self.shadow)?;
        Ok(self.receivers.iter().map(|receiver| is_shown(&seen, &eye, receiver.position)).collect())
    }

    /// Whether its light has views where maps are so large.
    pub fn check_views(&self, map_size: u32) -> Result<(), RunError> {
        self.views(&self.light, &ShadowSettings { map_size, ..self.shadow }).map(drop)
    }

    /// What a light looks through, in local space.
    fn views(&self, light: &Light, settings: &ShadowSettings) -> Result<FrameViews, RunError> {
        Ok(frame_views(&self.judge.local_space().light(light), Some(&self.eye_local()), settings)?)
    }

    /// What cascades follow.
    fn eye_local(&self) -> Eye {
        self.judge.local_space().camera(&self.scene.camera).as_eye(self.scene.aspect())
    }

    /// Faces of all casters, and edges that can be in their silhouettes.
    pub fn faces_and_edges(&self) -> Result<[u64; 2], RunError> {
        let mut counts = [0, 0];
        for placed in self.scene.meshes.iter().filter(|placed| placed.casts && !placed.mesh.triangles.is_empty()) {
            // Parts with masks have no edges.
            let uncut = placed.mesh.uncut_triangles();
            let topology = TopologyAwareMesh::build(&placed.mesh.positions, &uncut, &BuildOptions::default())?;
            counts[0] += placed.mesh.triangles.len() as u64;
            counts[1] += u64::from(topology.candidate_edge_count);
        }
        Ok(counts)
    }

    /// Size of the light as its kind means it: radius in metres, or angular radius in radians.
    pub fn light_size(&self) -> f64 {
        match self.light.kind {
            LightKind::Spot { radius, .. } | LightKind::Point { radius, .. } => radius,
            LightKind::Directional { angular_radius, .. } | LightKind::Cascaded { angular_radius, .. } => {
                angular_radius
            }
        }
    }

    /// A number that changes with the receivers, which another device may place otherwise.
    pub fn receivers_fingerprint(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        for (receiver, pixel) in self.receivers.iter().zip(&self.pixels) {
            receiver.position.to_array().into_iter().for_each(|value| hasher.write_u64(value.to_bits()));
            hasher.write_u32(receiver.face);
            hasher.write_usize(*pixel);
        }
        hasher.finish()
    }
}

impl NamedScene {
    /// A number that changes with what is seen, what casts and what shines.
    pub(super) fn fingerprint(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        let Scene { camera, lights, exposure_ev100, ambient, background, meshes, .. } = &self.scene;
        let told = format!("{camera:?} {lights:?} {exposure_ev100:?} {ambient:?} {background:?}");
        hasher.write(told.as_bytes());
        for placed in meshes {
            let (casts, receives) = (placed.casts, placed.receives);
            hasher.write(format!("{:?} {:?} {casts} {receives}", placed.world_from_object, placed.material).as_bytes());
            hasher.write(bytemuck::cast_slice(&placed.mesh.positions));
            hasher.write(bytemuck::cast_slice(&placed.mesh.triangles));
            for (part, cutoff) in placed.mesh.cut_parts() {
                hasher.write(format!("{:?} {cutoff}", part.triangles).as_bytes());
                hasher.write(part.texture.as_ref().map_or(&[], |texture| &texture.image.bytes[..]));
                hasher.write(bytemuck::cast_slice(&placed.mesh.texture_coordinates));
                hasher.write(bytemuck::cast_slice(&placed.mesh.alphas));
            }
        }
        hasher.finish()
    }
}

/// Whether maps show a point as far as a light's shadow goes.
fn is_shown(seen: &FrameViews, eye: &Eye, position: DVec3) -> bool {
    match seen.cascades.as_ref().map(|cascades| &cascades.cascades[..]) {
        Some([.., last]) => eye.depth_of(position) <= last.blend_depth,
        _ => seen.views.iter().any(|view| shows(view, position)),
    }
}

fn shows(view: &View, position: DVec3) -> bool {
    let clip = view.light_clip_from_world * position.extend(1.0);
    clip.w > 0.0 && clip.x.abs() <= clip.w && clip.y.abs() <= clip.w && clip.z <= clip.w
}

/// Where a mesh is cut, by its parts with masks.
fn holes<'a>(mesh: &TriangleMesh, masked: impl Iterator<Item = &'a Arc<MaskedMesh>>) -> Option<Holes> {
    let triangles = mesh.cut_parts().map(|(part, _)| part.triangles.clone());
    let parts: Vec<(Range<u32>, Arc<MaskedMesh>)> = triangles.zip(masked.cloned()).collect();
    let is_hole = move |triangle: usize, weights: [f64; 3]| {
        let triangle = triangle as u32;
        let part = parts.iter().find(|(triangles, _)| triangles.contains(&triangle));
        part.is_some_and(|(triangles, masked)| !masked.keeps(triangle - triangles.start, weights))
    };
    mesh.cut_parts().next().map(|_| Holes::new(is_hole))
}

#[cfg(test)]
mod tests {
    use contrejour_plan::CascadeSettings;

    use super::*;

    #[test]
    fn a_cascade_that_fades_into_light_shows_nothing_to_compare() {
        let eye = Eye { position: DVec3::Y, forward: DVec3::NEG_Z, fov_y: 0.8, aspect: 1.5, near: 1.0, far: 21.0 };
        let cascades =
            CascadeSettings { count: 2, logarithmic_share: 0.0, border_share: 0.2, ..CascadeSettings::DEFAULT };
        let kind = LightKind::Cascaded { towards_light: DVec3::ONE, angular_radius: 0.01, cascades };
        let seen = |kind| {
            let light = Light { kind, color: [1.0; 3] };
            frame_views(&light, Some(&eye), &ShadowSettings::default()).expect("a good light")
        };
        // Slices end at 11 and 21, and the last one fades from 19 on; in the first one's border the second takes over.
        for (depth, is_compared) in [(2.0, true), (10.5, true), (18.9, true), (19.1, false), (20.9, false)] {
            let point = DVec3::new(0.3, 1.2, -depth);
            assert_eq!(is_shown(&seen(kind), &eye, point), is_compared, "{depth}");
        }
        let kind = LightKind::Directional {
            towards_light: DVec3::Y,
            center: DVec3::ZERO,
            half_extent: 5.0,
            half_depth: 5.0,
            angular_radius: 0.0,
        };
        for (x, is_compared) in [(0.0, true), (4.9, true), (5.1, false)] {
            assert_eq!(is_shown(&seen(kind), &eye, x * DVec3::X), is_compared, "{x}");
        }
    }
}
