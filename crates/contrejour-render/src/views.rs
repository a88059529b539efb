//! Pictures of what stands behind a picture: maps, visibility and silhouettes. Of a light with several views the maps are
//! those of the first one.

use contrejour_plan::{DepthPrecision, LightKind, guard_ndc, views_with_guard};
use image::RgbaImage;

use crate::map_texels::read_texels;
use crate::map_views::{MapView, alpha_view, depth_view};
use crate::picture_pass::Shading;
use crate::readback::{ReadError, read_picture};
use crate::renderer::Renderer;
use crate::silhouette_lines::SilhouetteLines;
use crate::silhouettes::read_silhouettes;

/// One view of the last frame.
#[derive(Clone, Debug)]
pub struct View {
    /// File name without ending.
    pub name: &'static str,
    /// The picture.
    pub picture: RgbaImage,
    /// What its colours mean, one line.
    pub legend: String,
}

impl Renderer {
    /// Every view of the last frame: the maps that it has, its visibility, and its silhouettes over the picture.
    ///
    /// # Errors
    ///
    /// [`ReadError`] when the device fails.
    pub fn views(&self) -> Result<Vec<View>, ReadError> {
        let mut views = self.map_views()?;
        views.push(View {
            name: "visibility",
            picture: self.visibility_picture()?,
            legend: "white: the light is seen, black: it is hidden".to_owned(),
        });
        views.push(View {
            name: "silhouette",
            picture: self.silhouette_picture()?,
            legend: "orange: outlines, blue: silhouette edges with faces on both sides; faint where hidden".to_owned(),
        });
        Ok(views)
    }

    fn map_views(&self) -> Result<Vec<View>, ReadError> {
        let maps = self.cast.shadows.maps(self.cast.light);
        let mut views = Vec::new();
        let mut push = |name, MapView { picture, legend }| views.push(View { name, picture, legend });
        let texels = |map| read_texels(&self.gpu, map);
        let channel =
            |texels: &[[f32; 2]], channel: usize| -> Vec<f32> { texels.iter().map(|texel| texel[channel]).collect() };
        let linear = |depth: Vec<f32>| depth.into_iter().map(|depth| self.depth_unit() * depth).collect::<Vec<_>>();
        if let Some(map) = maps.shadow_depth {
            push("shadow_map", self.linear_depth_view(&linear(channel(&texels(map)?, 0)), map.width()));
        } else if let Some(map) = maps.shadow_hardware_depth {
            let depth = self.linear_from_hardware(&channel(&texels(map)?, 0));
            push("shadow_map", self.linear_depth_view(&depth, map.width()));
        }
        if let Some(map) = maps.smoothie_buffer {
            let texels = texels(map)?;
            push("smoothie_depth", self.linear_depth_view(&linear(channel(&texels, 0)), map.width()));
            push("smoothie_alpha", alpha_view(&channel(&texels, 1), map.width()));
        }
        if let Some(map) = maps.smoothie_depth {
            let depth = self.linear_from_hardware(&channel(&texels(map)?, 0));
            push("smoothie_depth", self.linear_depth_view(&depth, map.width()));
        }
        if let Some(map) = maps.smoothie_alpha {
            push("smoothie_alpha", alpha_view(&channel(&texels(map)?, 0), map.width()));
        }
        Ok(views)
    }

    /// Depth in local units that 1 stands for in maps of linear depth.
    fn depth_unit(&self) -> f32 {
        let precision = self.cast.shadows.plan(self.cast.light).map(|plan| plan.settings.depth_precision);
        if precision == Some(DepthPrecision::Bits16) { self.depth_range().1 as f32 } else { 1.0 }
    }

    fn linear_depth_view(&self, depth: &[f32], size: u32) -> MapView {
        let (_, far) = self.depth_range();
        depth_view(depth, size, far as f32, self.local.length_world(1.0))
    }

    /// Linear depth from clip z, as the visibility function of two textures does it.
    fn linear_from_hardware(&self, ndc_z: &[f32]) -> Vec<f32> {
        let (near, far) = self.depth_range();
        let is_perspective = matches!(self.light_local.kind, LightKind::Spot { .. } | LightKind::Point { .. });
        let linear =
            |z: f64| if is_perspective { near * far / (far + (near - far) * z) } else { near + (far - near) * z };
        ndc_z.iter().map(|&z| if z < 1.0 { linear(z.into()) as f32 } else { far as f32 }).collect()
    }

    /// Nearest and farthest depth of the light's views, in local units.
    fn depth_range(&self) -> (f64, f64) {
        let settings = self.cast.shadows.plan(self.cast.light).map(|plan| plan.settings).unwrap_or_default();
        let views = views_with_guard(&self.light_local, guard_ndc(&self.light_local, &settings));
        // A light that has maps has views.
        views.ok().and_then(|views| views.first().map(|view| (view.near_depth, view.far_depth))).unwrap_or((0.0, 1.0))
    }

    fn visibility_picture(&self) -> Result<RgbaImage, ReadError> {
        self.draw_view(Shading::Visibility, wgpu::Color::WHITE, None)
    }

    fn silhouette_picture(&self) -> Result<RgbaImage, ReadError> {
        let edges = read_silhouettes(&self.gpu, &self.cast.shadows)?;
        let size = [self.targets.picture.width(), self.targets.picture.height()];
        let lines = SilhouetteLines::new(&self.gpu, &self.casters, &edges, self.uniforms.eye_clip_from_local, size);
        self.draw_view(Shading::Lit, self.background, Some(&lines))
    }

    /// Draws over the last picture, from the same maps.
    fn draw_view(
        &self,
        shading: Shading,
        background: wgpu::Color,
        lines: Option<&SilhouetteLines>,
    ) -> Result<RgbaImage, ReadError> {
        let pipeline = self.pass.pipeline(&self.gpu, shading);
        let mut encoder = self.encoder();
        {
            let mut pass = self.targets.begin_pass(&mut encoder, background, None);
            self.pass.draw(&mut pass, &pipeline, &self.cast, &self.meshes);
            if let Some(lines) = lines {
                lines.draw(&mut pass);
            }
        }
        self.gpu.queue.submit([encoder.finish()]);
        read_picture(&self.gpu, &self.targets.picture)
    }
}
