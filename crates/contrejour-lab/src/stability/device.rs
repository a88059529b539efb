//! A case on the device, and everything that its frame leaves there.

use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;
use std::time::Instant;

use bytemuck::{AnyBitPattern, NoUninit, cast_slice, pod_collect_to_vec};
use contrejour_gpu::{CasterInput, LightHandle, Positions, ShadowOptions, Shadows, Untimed};
use contrejour_layout::{CasterLight, Corner, Counters, LightView, Quad, ReceiverView, SilhouetteEdge, lit_of_seat};
use contrejour_mesh::{BuildOptions, TopologyAwareMesh, TopologyError};
use contrejour_plan::{BufferKind, FramePlan, Light, ShadowSettings};
use contrejour_render::{Gpu, copied_buffer, read_buffer, read_rows};
use glam::DMat4;
use half::f16;

use super::case::CaseMesh;
use super::checks::{non_finite, open_boundary};
use super::error::{CaseError, Ended, Refusal};
use super::lights::with_another_depth;
use crate::metrics::Timing;

/// Frames after which a frame must have had room for everything.
const REPEATS_MAX: usize = 8;

/// Frames whose median is told.
const TIMED_FRAMES: usize = 3;

/// A mesh with its topology, in its place.
#[derive(Clone, Debug)]
pub(super) struct DeviceMesh {
    pub topology: Arc<TopologyAwareMesh>,
    pub world_from_object: DMat4,
}

impl DeviceMesh {
    pub fn new(mesh: &CaseMesh) -> Result<Self, TopologyError> {
        let topology = TopologyAwareMesh::build(&mesh.positions, &mesh.triangles, &BuildOptions::default())?;
        Ok(Self { topology: Arc::new(topology), world_from_object: mesh.world_from_object })
    }
}

/// Meshes and their shadow on the device.
pub(super) struct DeviceFrame<'a> {
    gpu: &'a Gpu,
    pub shadows: Shadows,
    light: LightHandle,
}

/// What the frame of a view leaves.
pub(super) struct DeviceOutputs {
    /// Indices of the meshes that cast.
    pub casting: Vec<usize>,
    /// Lit bits of all casting meshes, one after the other; none where the frame finds none.
    pub lit: Option<Vec<u32>>,
    pub silhouettes: Vec<SilhouetteEdge>,
    pub quads: Vec<Quad>,
    pub corners: Vec<Corner>,
    /// Numbers that are not finite, in all records.
    pub non_finite: u64,
}

/// Kinds of buffers that are read.
const READ: [BufferKind; 9] = [
    BufferKind::Counters,
    BufferKind::Quads,
    BufferKind::Corners,
    BufferKind::CasterLights,
    BufferKind::LightView,
    BufferKind::Planes,
    BufferKind::ReceiverView,
    BufferKind::Lit,
    BufferKind::Silhouettes,
];

/// What a view has of a frame's buffers.
struct Buffers {
    /// Parts of them, by their kinds.
    parts: HashMap<BufferKind, Vec<(wgpu::Buffer, Range<u64>)>>,
    /// Whose the lit bits are: seats of the bundle, and the view's own.
    seat: (usize, usize),
}

impl<'a> DeviceFrame<'a> {
    pub fn new(gpu: &'a Gpu, meshes: &[DeviceMesh], light: &Light, settings: &ShadowSettings) -> Result<Self, Refusal> {
        let options = ShadowOptions { settings: *settings, ..ShadowOptions::default() };
        let mut shadows = Shadows::new(&gpu.device)?;
        for mesh in meshes {
            let handle = shadows.add_mesh(Arc::clone(&mesh.topology))?;
            let world_from_object = mesh.world_from_object;
            shadows.add_caster(&CasterInput { mesh: handle, world_from_object, positions: Positions::OfMesh })?;
        }
        let light = shadows.add_light(light, &options)?;
        Ok(Self { gpu, shadows, light })
    }

    /// Draws one frame and waits for it. Returns the time from its submission. Unit: milliseconds.
    fn draw(&mut self, light: &Light) -> Result<f64, Ended> {
        let Gpu { device, queue, .. } = self.gpu;
        self.shadows.set_light(self.light, light).map_err(Refusal::from)?;
        self.shadows.prepare(device, queue).map_err(Refusal::from)?;
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.shadows.encode(&mut encoder, &mut Untimed);
        let clock = Instant::now();
        queue.submit([encoder.finish()]);
        self.gpu.wait(None).map_err(CaseError::from)?;
        let time_ms = 1000.0 * clock.elapsed().as_secs_f64();
        if self.shadows.buffer(BufferKind::Counters).is_some() {
            self.shadows.wait_for_counters(device).map_err(CaseError::from)?;
        }
        self.gpu.check().map_err(CaseError::from)?;
        Ok(time_ms)
    }

    /// Draws until there was room for everything.
    pub fn complete(&mut self, light: &Light) -> Result<(), Ended> {
        for _ in 0..REPEATS_MAX {
            self.draw(light)?;
            if self.shadows.is_complete() {
                return Ok(());
            }
        }
        Err(CaseError::Incomplete(REPEATS_MAX).into())
    }

    /// The median time of a few frames. Between them others are drawn, since a frame like the one before is not.
    pub fn time_ms(&mut self, light: &Light) -> Result<Option<f64>, Ended> {
        let other = with_another_depth(light);
        if other.validate().is_err() {
            return Ok(None);
        }
        let mut times = Vec::new();
        for _ in 0..TIMED_FRAMES {
            self.draw(&other)?;
            times.push(self.draw(light)?);
        }
        Ok(Some(Timing::from_samples(&times).map_err(CaseError::from)?.median_ms))
    }

    /// The plan of the last frame.
    pub fn plan(&self) -> Option<&FramePlan> {
        self.shadows.plan(self.light)
    }

    /// What each of the light's views left.
    pub fn read(&mut self, view_count: usize) -> Result<Vec<DeviceOutputs>, Ended> {
        // One view's in place: some lists are as large as memory allows.
        let mut buffers =
            if view_count > 1 { self.copies()? } else { vec![Buffers { parts: HashMap::new(), seat: (1, 0) }] };
        for kind in READ {
            // The light's own hold the records of all its views.
            if view_count == 1 || kind.is_of_light() {
                let part =
                    |part: wgpu::BufferSlice<'_>| (part.buffer().clone(), part.offset()..part.offset() + part.size());
                buffers[0].parts.insert(kind, self.shadows.buffers(kind).map(part).collect());
            }
        }
        Ok(buffers.iter().map(|buffers| self.outputs(buffers)).collect::<Result<_, _>>()?)
    }

    /// Draws once more, and keeps what each view leaves in the lists before the next one fills them.
    fn copies(&mut self) -> Result<Vec<Buffers>, Ended> {
        let Gpu { device, queue, .. } = self.gpu;
        self.shadows.redraw();
        self.shadows.prepare(device, queue).map_err(Refusal::from)?;
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut views = Vec::new();
        self.shadows.encode_each(&mut encoder, &mut Untimed, |encoder, view| {
            let mut copy = |part: wgpu::BufferSlice<'_>| (copied_buffer(self.gpu, encoder, part), 0..part.size());
            let parts = READ.into_iter().map(|kind| (kind, view.buffers(kind).map(&mut copy).collect())).collect();
            views.push(Buffers { parts, seat: (view.seat_count, view.seat) });
        });
        queue.submit([encoder.finish()]);
        self.gpu.wait(None).map_err(CaseError::from)?;
        self.gpu.check().map_err(CaseError::from)?;
        Ok(views)
    }

    fn outputs(&self, buffers: &Buffers) -> Result<DeviceOutputs, CaseError> {
        let quads: Vec<Quad> = self.counted(buffers, BufferKind::Quads, |counters| counters.quads)?;
        let corners: Vec<Corner> = self.counted(buffers, BufferKind::Corners, |counters| counters.corners)?;
        let caster_lights: Vec<CasterLight> = self.records(buffers, BufferKind::CasterLights)?;
        let light_view: Vec<LightView> = self.records(buffers, BufferKind::LightView)?;
        let planes: Vec<[f32; 4]> = self.records(buffers, BufferKind::Planes)?;
        let receiver_view: Vec<ReceiverView> = self.records(buffers, BufferKind::ReceiverView)?;
        let (seat_count, seat) = buffers.seat;
        let lit = lit_of_seat(&self.records::<u32>(buffers, BufferKind::Lit)?, seat_count as u32, seat as u32);
        Ok(DeviceOutputs {
            casting: (0..caster_lights.len()).filter(|caster| caster_lights[*caster].casts == 1).collect(),
            lit: (!lit.is_empty()).then_some(lit),
            silhouettes: self.counted(buffers, BufferKind::Silhouettes, |counters| counters.silhouette_edges)?,
            non_finite: non_finite(&quads)
                + non_finite(&corners)
                + non_finite(&caster_lights)
                + non_finite(&light_view)
                + non_finite(&planes)
                + non_finite(&receiver_view),
            quads,
            corners,
        })
    }

    /// All records of a kind of buffers; none where the frame has no such buffer.
    fn records<T: AnyBitPattern + NoUninit>(&self, buffers: &Buffers, kind: BufferKind) -> Result<Vec<T>, CaseError> {
        let mut records = Vec::new();
        for (buffer, range) in buffers.parts.get(&kind).into_iter().flatten() {
            let part = buffer.slice(range.clone());
            records.extend(pod_collect_to_vec::<u8, T>(&read_buffer(self.gpu, part, part.size())?));
        }
        Ok(records)
    }

    /// The records of lists that the frame counted, page after page.
    fn counted<T: AnyBitPattern + NoUninit>(
        &self,
        buffers: &Buffers,
        kind: BufferKind,
        count: fn(&Counters) -> u32,
    ) -> Result<Vec<T>, CaseError> {
        let mut records = Vec::new();
        let lists = buffers.parts.get(&kind).into_iter().flatten();
        for (counters, (buffer, range)) in self.records(buffers, BufferKind::Counters)?.iter().zip(lists) {
            let size = u64::from(count(counters)) * size_of::<T>() as u64;
            records.extend(pod_collect_to_vec::<u8, T>(&read_buffer(self.gpu, buffer.slice(range.clone()), size)?));
        }
        Ok(records)
    }

    /// Places where a blocker ends and the silhouette map knows none; none where there is no such map.
    pub fn open_boundaries(&self, far_depths: &[f64]) -> Result<Option<u64>, CaseError> {
        let maps = self.shadows.maps(self.light);
        let Some((depths, silhouettes)) = maps.shadow_depth.zip(maps.silhouette_map) else { return Ok(None) };
        let mut count = 0;
        for (layer, far_depth) in (0..).zip(far_depths) {
            let side = depths.width() as usize;
            let silhouettes: Vec<[f32; 2]> =
                pod_collect_to_vec(cast_slice::<f32, u8>(&self.layer(silhouettes, layer)?));
            count += open_boundary(&self.layer(depths, layer)?, &silhouettes, side, *far_depth as f32);
        }
        Ok(Some(count))
    }

    /// The floats of a layer, row by row.
    fn layer(&self, texture: &wgpu::Texture, layer: u32) -> Result<Vec<f32>, CaseError> {
        let format = texture.format();
        let mut texels = Vec::new();
        let take = |row: &[u8]| texels.extend(floats(format, row));
        read_rows(self.gpu, texture, [layer, 0], bytes_per_texel(format), take)?;
        Ok(texels)
    }

    /// Numbers that are not finite, in all texels of all maps.
    pub fn non_finite_texels(&self) -> Result<u64, CaseError> {
        let maps = self.shadows.maps(self.light);
        let textures = [
            maps.shadow_depth,
            maps.shadow_hardware_depth,
            maps.moments,
            maps.smoothie_depth,
            maps.smoothie_alpha,
            maps.smoothie_buffer,
            maps.silhouette_map,
        ];
        let mut count = 0;
        for texture in textures.into_iter().flatten() {
            let format = texture.format();
            let layers = texture.depth_or_array_layers();
            for (layer, level) in
                (0..layers).flat_map(|layer| (0..texture.mip_level_count()).map(move |level| (layer, level)))
            {
                let take = |row: &[u8]| count += non_finite(&floats(format, row));
                read_rows(self.gpu, texture, [layer, level], bytes_per_texel(format), take)?;
            }
        }
        Ok(count)
    }
}

fn bytes_per_texel(format: wgpu::TextureFormat) -> u32 {
    // A depth buffer has no size of a block as a whole, and the aspect that it has.
    format.block_copy_size(None).or(format.block_copy_size(Some(wgpu::TextureAspect::DepthOnly))).unwrap_or(4)
}

fn floats(format: wgpu::TextureFormat, bytes: &[u8]) -> Vec<f32> {
    let is_half = matches!(
        format,
        wgpu::TextureFormat::R16Float | wgpu::TextureFormat::Rg16Float | wgpu::TextureFormat::Rgba16Float
    );
    if is_half {
        pod_collect_to_vec::<u8, f16>(bytes).into_iter().map(f32::from).collect()
    } else {
        pod_collect_to_vec(cast_slice::<u8, u8>(bytes))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_planted_nan_is_found_in_texels_of_both_sizes() {
        let halves = [f16::ONE, f16::NAN, f16::INFINITY, f16::MAX];
        assert_eq!(non_finite(&floats(wgpu::TextureFormat::Rg16Float, cast_slice(&halves))), 2);
        let singles = [1.0, f32::NAN, f32::MAX];
        assert_eq!(non_finite(&floats(wgpu::TextureFormat::R32Float, cast_slice(&singles))), 1);
        assert_eq!(bytes_per_texel(wgpu::TextureFormat::Depth32Float), 4);
        assert_eq!(bytes_per_texel(wgpu::TextureFormat::Rg32Float), 8);
    }
}
