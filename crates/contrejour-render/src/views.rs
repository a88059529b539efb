//! Pictures of what stands behind a picture: maps, visibility and silhouettes.

use contrejour_plan::LightKind;
use image::RgbaImage;

use crate::map_views::{MapView, alpha_view, depth_view};
use crate::picture_pass::Shading;
use crate::readback::{ReadError, read_picture, read_texture};
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
        let maps = self.cast.shadows.maps();
        let mut views = Vec::new();
        let mut push = |name, MapView { picture, legend }| views.push(View { name, picture, legend });
        if let Some(map) = maps.shadow_depth {
            let depth = floats(&read_texture(&self.gpu, map, 4)?);
            push("shadow_map", self.linear_depth_view(&depth, map.width()));
        }
        if let Some(map) = maps.smoothie_buffer {
            let texels: Vec<[f32; 2]> = bytemuck::pod_collect_to_vec(&read_texture(&self.gpu, map, 8)?);
            let depth: Vec<f32> = texels.iter().map(|texel| texel[0]).collect();
            let alpha: Vec<f32> = texels.iter().map(|texel| texel[1]).collect();
            push("smoothie_depth", self.linear_depth_view(&depth, map.width()));
            push("smoothie_alpha", alpha_view(&alpha, map.width()));
        }
        if let Some(map) = maps.smoothie_depth {
            let depth = self.linear_from_hardware(&floats(&read_texture(&self.gpu, map, 4)?));
            push("smoothie_depth", self.linear_depth_view(&depth, map.width()));
        }
        if let Some(map) = maps.smoothie_alpha {
            let halves: Vec<u16> = bytemuck::pod_collect_to_vec(&read_texture(&self.gpu, map, 2)?);
            let alpha: Vec<f32> = halves.into_iter().map(float_from_half).collect();
            push("smoothie_alpha", alpha_view(&alpha, map.width()));
        }
        Ok(views)
    }

    fn linear_depth_view(&self, depth: &[f32], size: u32) -> MapView {
        let (_, far) = self.depth_range();
        depth_view(depth, size, far as f32, self.local.length_world(1.0))
    }

    /// Linear depth from clip z, as the visibility function of two textures does it.
    fn linear_from_hardware(&self, ndc_z: &[f32]) -> Vec<f32> {
        let (near, far) = self.depth_range();
        let is_perspective = matches!(self.light_local.kind, LightKind::Spot { .. });
        let linear =
            |z: f64| if is_perspective { near * far / (far + (near - far) * z) } else { near + (far - near) * z };
        ndc_z.iter().map(|&z| if z < 1.0 { linear(z.into()) as f32 } else { far as f32 }).collect()
    }

    /// Nearest and farthest depth of the light's view, in local units.
    fn depth_range(&self) -> (f64, f64) {
        match self.light_local.kind {
            LightKind::Spot { near, far, .. } => (near, far),
            LightKind::Directional { half_depth, .. } => (0.0, 2.0 * half_depth),
        }
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
            self.pass.draw(&mut pass, &pipeline, &self.cast.shadows, &self.meshes);
            if let Some(lines) = lines {
                lines.draw(&mut pass);
            }
        }
        self.gpu.queue.submit([encoder.finish()]);
        read_picture(&self.gpu, &self.targets.picture)
    }
}

fn floats(bytes: &[u8]) -> Vec<f32> {
    bytemuck::pod_collect_to_vec(bytes)
}

/// IEEE 754 binary16, not negative, without infinities: alpha is 0..1.
fn float_from_half(half: u16) -> f32 {
    let exponent = i32::from(half >> 10 & 31);
    let fraction = f32::from(half & 1023) / 1024.0;
    if exponent == 0 { fraction * 2f32.powi(-14) } else { (1.0 + fraction) * 2f32.powi(exponent - 15) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves() {
        for (half, float) in [(0x0000, 0.0), (0x3c00, 1.0), (0x3800, 0.5), (0x3555, 0.33325195), (0x0001, 5.9604645e-8)]
        {
            assert_eq!(float_from_half(half), float, "{half:04x}");
        }
    }
}
