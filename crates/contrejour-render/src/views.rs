//! Pictures of what stands behind a picture: maps, visibility and silhouettes.

use contrejour_gpu::LightHandle;
use contrejour_layout::SilhouetteEdge;
use contrejour_plan::{DepthPrecision, LightKind, Pass, Stage, TextureKind, frame_views};
use image::RgbaImage;

use crate::error::DrawError;
use crate::filled_views::{CountedTriangles, Found};
use crate::map_texels::read_texels;
use crate::map_views::{MapView, alpha_view, count_view, depth_view, distance_view};
use crate::readback::{ReadError, read_picture};
use crate::renderer::Renderer;
use crate::silhouette_lines::SilhouetteLines;
use crate::targets::{COLOR_FORMAT, Targets};

/// One view of the last frame.
#[derive(Clone, Debug)]
pub struct View {
    /// File name without ending. Where the scene has several lights it begins with `light-` and the light's number, from 1;
    /// maps of a light with several views end with the cube's face, as `-positive-x`, or with `-cascade-` and the cascade's
    /// number, from 1.
    pub name: String,
    /// The picture.
    pub picture: RgbaImage,
    /// What its colours mean, one line.
    pub legend: String,
}

/// A light that casts: its place among the scene's lights, and what the library calls it.
type Casting = (usize, LightHandle);

impl Renderer {
    /// Every view of the scene as it is now: for each light that casts, the maps that it has, its visibility, and its
    /// silhouettes over the picture.
    ///
    /// # Errors
    ///
    /// [`DrawError`] when the device does not allow the frame or fails.
    pub fn views(&mut self) -> Result<Vec<View>, DrawError> {
        let casting: Vec<Casting> = self.lights.casting_indices().collect();
        let found = self.find_in_views()?;
        let mut views = Vec::new();
        for light in casting {
            let found: Vec<&Found> = found.iter().filter(|found| found.light == light.1).collect();
            let mut of_light = self.map_views(light, &found)?;
            of_light.push(View {
                name: "visibility".to_owned(),
                picture: self.visibility_picture(light)?,
                legend: "white: the light is seen, black: it is hidden".to_owned(),
            });
            let edges: Vec<SilhouetteEdge> = found.iter().flat_map(|found| &found.silhouettes).copied().collect();
            let looks = self.cast.shadows.plan(light.1).is_some_and(|plan| plan.has_stage(Stage::DetectSilhouette));
            let legend = if looks {
                "orange: outlines, blue: silhouette edges with faces on both sides; faint where hidden"
            } else {
                "no lines: no compute stage finds silhouettes for this technique"
            };
            of_light.push(View {
                name: "silhouette".to_owned(),
                picture: self.silhouette_picture(&edges)?,
                legend: legend.to_owned(),
            });
            if self.lights.count() > 1 {
                of_light.iter_mut().for_each(|view| view.name = format!("light-{}-{}", light.0 + 1, view.name));
            }
            views.extend(of_light);
        }
        Ok(views)
    }

    /// The maps of a light, view by view.
    fn map_views(&self, light: Casting, found: &[&Found]) -> Result<Vec<View>, ReadError> {
        let kind = self.lights.local(light.0).kind;
        let mut views = Vec::new();
        let depth_ranges = self.depth_ranges(light);
        let count = depth_ranges.len() as u32;
        for (index, depths) in (0..).zip(depth_ranges) {
            let mut of_view = self.maps_of_view(light, (index, count), depths)?;
            let found = found.iter().find(|found| found.view == index as usize);
            if let Some(triangles) = found.and_then(|found| found.triangles.as_ref()) {
                of_view.push(self.triangle_view(triangles)?);
            }
            views.extend(of_view.into_iter().map(|view| View { name: view.name + &suffix(&kind, index), ..view }));
        }
        Ok(views)
    }

    fn maps_of_view(
        &self,
        light: Casting,
        (index, count): (u32, u32),
        depths: [f64; 2],
    ) -> Result<Vec<View>, ReadError> {
        let maps = self.cast.shadows.maps(light.1);
        let mut views = Vec::new();
        let mut push =
            |name: &str, MapView { picture, legend }| views.push(View { name: String::from(name), picture, legend });
        let texels = |(map, layer)| read_texels(&self.gpu, map, layer);
        let channel =
            |texels: &[[f32; 2]], channel: usize| -> Vec<f32> { texels.iter().map(|texel| texel[channel]).collect() };
        // A map that nobody keeps for each view is that of the last one.
        let in_view = |map: &wgpu::Texture| (index + map.depth_or_array_layers()).checked_sub(count);
        let unit = self.depth_unit(light, depths);
        let linear = |depth: Vec<f32>| depth.into_iter().map(|depth| unit * depth).collect::<Vec<_>>();
        let depth_view = |depth: &[f32], size| depth_view(depth, size, depths[1] as f32, self.local.length_world(1.0));
        if let Some(map) = maps.shadow_depth {
            if let Some(layer) = in_view(map) {
                push("shadow_map", depth_view(&linear(channel(&texels((map, layer))?, 0)), map.width()));
            }
        } else if let Some((map, layer)) = maps.shadow_hardware_depth.and_then(|map| Some((map, in_view(map)?))) {
            let depth = self.linear_from_hardware(light, depths, &channel(&texels((map, layer))?, 0));
            push("shadow_map", depth_view(&depth, map.width()));
        }
        if let Some(map) = maps.smoothie_buffer {
            let texels = texels((map, index))?;
            push("smoothie_depth", depth_view(&linear(channel(&texels, 0)), map.width()));
            push("smoothie_alpha", alpha_view(&channel(&texels, 1), map.width()));
        }
        if let Some(map) = maps.smoothie_depth {
            let depth = self.linear_from_hardware(light, depths, &channel(&texels((map, index))?, 0));
            push("smoothie_depth", depth_view(&depth, map.width()));
        }
        if let Some(map) = maps.smoothie_alpha {
            push("smoothie_alpha", alpha_view(&channel(&texels((map, index))?, 0), map.width()));
        }
        if let Some(map) = maps.silhouette_map {
            let texels = texels((map, index))?;
            let depth = linear(channel(&texels, 0));
            push("silhouette_depth", depth_view(&depth, map.width()));
            let is_near: Vec<bool> = depth.iter().map(|&depth| depth < depths[1] as f32).collect();
            let plan = self.cast.shadows.plan(light.1);
            let has_sides = plan.is_some_and(|plan| plan.texture(TextureKind::SilhouetteOrder).is_some());
            push("signed_distance", distance_view(&channel(&texels, 1), &is_near, map.width(), has_sides));
        }
        Ok(views)
    }

    /// The triangles that were drawn to fill a silhouette map.
    fn triangle_view(&self, triangles: &CountedTriangles) -> Result<View, ReadError> {
        let (name, what) = match triangles.pass {
            Pass::SilhouetteMap | Pass::BlendedSilhouetteMap => ("strips", "strips along silhouette edges"),
            _ => ("scaled_faces", "scaled faces"),
        };
        let counts = read_texels(&self.gpu, &triangles.counts, 0)?;
        let counts: Vec<f32> = counts.into_iter().map(|[count, _]| count).collect();
        let MapView { picture, legend } = count_view(&counts, triangles.counts.width(), what);
        Ok(View { name: name.to_owned(), picture, legend })
    }

    /// Depth in local units that 1 stands for in maps of linear depth.
    fn depth_unit(&self, light: Casting, [_, far]: [f64; 2]) -> f32 {
        let precision = self.cast.shadows.plan(light.1).map(|plan| plan.settings.depth_precision);
        if precision == Some(DepthPrecision::Bits16) { far as f32 } else { 1.0 }
    }

    /// Linear depth from clip z, as the visibility function of two textures does it.
    fn linear_from_hardware(&self, light: Casting, [near, far]: [f64; 2], ndc_z: &[f32]) -> Vec<f32> {
        let is_perspective =
            matches!(self.lights.local(light.0).kind, LightKind::Spot { .. } | LightKind::Point { .. });
        let linear =
            |z: f64| if is_perspective { near * far / (far + (near - far) * z) } else { near + (far - near) * z };
        ndc_z.iter().map(|&z| if z < 1.0 { linear(z.into()) as f32 } else { far as f32 }).collect()
    }

    /// Nearest and farthest depth of each of the light's views, in local units.
    fn depth_ranges(&self, light: Casting) -> Vec<[f64; 2]> {
        let settings = self.cast.shadows.plan(light.1).map(|plan| plan.settings).unwrap_or_default();
        let seen = frame_views(self.lights.local(light.0), Some(&self.eye_local()), &settings);
        // A light that has maps has views.
        seen.map_or(Vec::new(), |seen| seen.views.iter().map(|view| [view.near_depth, view.far_depth]).collect())
    }

    fn visibility_picture(&self, light: Casting) -> Result<RgbaImage, ReadError> {
        let targets = Targets::new(&self.gpu, self.targets.size);
        let mut encoder = self.encoder();
        {
            let mut pass = targets.begin_pass(&mut encoder, wgpu::Color::WHITE, None);
            self.pass.draw_visibility(&self.gpu, &mut pass, &self.cast, light, &self.meshes);
        }
        self.gpu.queue.submit([encoder.finish()]);
        read_picture(&self.gpu, &targets.picture)
    }

    fn silhouette_picture(&mut self, edges: &[SilhouetteEdge]) -> Result<RgbaImage, ReadError> {
        let eye_clip_from_local = self.uniforms.eye_clip_from_local;
        let lines = SilhouetteLines::new(&self.gpu, &self.casters, edges, eye_clip_from_local, self.targets.size);
        self.picture_pass.prepare(&self.gpu, COLOR_FORMAT);
        let mut encoder = self.encoder();
        {
            let mut pass = self.targets.begin_pass(&mut encoder, self.background, None);
            self.pass.draw(&mut pass, &self.cast, &self.lights.handles, &self.meshes);
            lines.draw(&mut pass);
        }
        let view = self.picture.create_view(&wgpu::TextureViewDescriptor::default());
        self.picture_pass.encode(&mut encoder, (&view, COLOR_FORMAT), None);
        self.gpu.queue.submit([encoder.finish()]);
        read_picture(&self.gpu, &self.picture)
    }
}

/// What tells the maps of a light's views apart.
fn suffix(kind: &LightKind, view: u32) -> String {
    const FACES: [&str; 6] = ["positive-x", "negative-x", "positive-y", "negative-y", "positive-z", "negative-z"];
    match kind {
        LightKind::Point { .. } => format!("-{}", FACES[view as usize]),
        LightKind::Cascaded { .. } => format!("-cascade-{}", view + 1),
        LightKind::Spot { .. } | LightKind::Directional { .. } => String::new(),
    }
}
