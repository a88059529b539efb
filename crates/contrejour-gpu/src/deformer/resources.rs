//! The stage `deform_positions` on the device: its pipeline, its buffers, its dispatch.

use contrejour_layout::DeformBlock;

use super::pool::{Batch, MESH_POOLS, POOLS, PerPool, Pool, SharedMesh};
use crate::compute::dispatch;
use crate::stages::{SCENE, SceneComputeStage};
use crate::timer::PassTimer;

/// The stage, made once.
#[derive(Debug)]
pub(super) struct DeformPipeline {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
}

/// The buffers of all casters.
#[derive(Debug)]
pub(super) struct DeformResources {
    pools: PerPool<wgpu::Buffer>,
    /// As those of the pool.
    batches: Vec<Option<BatchBuffers>>,
}

/// The buffers of a batch.
#[derive(Debug)]
struct BatchBuffers {
    positions: wgpu::Buffer,
    blocks: wgpu::Buffer,
    block_count: u32,
    bind_group: wgpu::BindGroup,
}

const STAGE: SceneComputeStage = SCENE[0];

/// Bindings; the last one is written.
const BINDING_COUNT: u32 = 7;

/// A binding must hold a record, also where no caster has one; the largest has 48 bytes.
const LEAST_BYTES: u64 = 64;

impl DeformPipeline {
    pub fn new(device: &wgpu::Device) -> Self {
        let label = Some(STAGE.stage.name());
        let entry = |binding| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { read_only: binding + 1 < BINDING_COUNT },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        };
        let entries: Vec<_> = (0..BINDING_COUNT).map(entry).collect();
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label, entries: &entries });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label,
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label,
            source: wgpu::ShaderSource::Wgsl(STAGE.wgsl.into()),
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label,
            layout: Some(&pipeline_layout),
            module: &module,
            entry_point: label,
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        Self { layout, pipeline }
    }

    /// Records a dispatch for each batch, in a pass of its own, so that a timer sees it alone.
    pub fn encode<T: PassTimer>(&self, encoder: &mut wgpu::CommandEncoder, resources: &DeformResources, timer: &mut T) {
        let name = STAGE.stage.name();
        let query = timer.begin(name, encoder);
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some(name),
                timestamp_writes: T::compute_writes(&query),
            });
            pass.set_pipeline(&self.pipeline);
            for batch in resources.batches.iter().flatten() {
                pass.set_bind_group(0, &batch.bind_group, &[]);
                dispatch(&mut pass, batch.block_count);
            }
        }
        timer.end(query, encoder);
    }
}

/// Makes buffers and writes to them, and counts the bytes.
struct Maker<'a> {
    device: &'a wgpu::Device,
    queue: &'a wgpu::Queue,
    /// Most bytes of a buffer.
    most: u64,
    /// Copies of what buffers held that grew.
    encoder: Option<wgpu::CommandEncoder>,
    bytes: u64,
}

impl DeformResources {
    /// Makes and fills what is needed; returns the bytes that it uploaded. Of what was made before, what stays is not
    /// uploaded again: pools that get too small grow by half, by copies on the device, and positions stay where they are.
    pub fn follow(
        before: Option<Self>,
        (device, queue): (&wgpu::Device, &wgpu::Queue),
        pipeline: &DeformPipeline,
        pool: &mut Pool,
        most: u64,
    ) -> (Self, u64) {
        let mut maker = Maker { device, queue, most, encoder: None, bytes: 0 };
        let (old_pools, mut old_batches) = match before {
            Some(Self { pools, batches }) => (pools.map(Some), batches),
            None => (PerPool::default(), Vec::new()),
        };
        old_batches.resize_with(pool.batches.len(), || None);
        let ends = pool.ends();
        let pools: PerPool<wgpu::Buffer> = std::array::from_fn(|index| {
            let (what, size) = POOLS[index];
            maker.grown(what, old_pools[index].as_ref(), size * ends[index], index < MESH_POOLS)
        });
        let are_new: PerPool<bool> = std::array::from_fn(|index| old_pools[index].as_ref() != Some(&pools[index]));
        let has_new_pools = are_new.contains(&true);
        let [.., joints_are_new, weights_are_new] = are_new;
        if joints_are_new {
            pool.joint_matrices.change_all();
        }
        if weights_are_new {
            pool.morph_weights.change_all();
        }
        let all_words: u64 = pool.batches.iter().flatten().filter_map(|batch| batch.room).sum();
        let batches = pool.batches.iter_mut().zip(old_batches).map(|(batch, old)| {
            // Another one may have come to the place of one that left.
            let old = old.filter(|_| batch.as_ref().is_some_and(|batch| batch.room.is_some()));
            batch.as_mut().map(|batch| maker.batch(batch, old, (pipeline, &pools, has_new_pools), all_words))
        });
        let batches = batches.collect();
        if let Some(encoder) = maker.encoder.take() {
            queue.submit([encoder.finish()]);
        }
        pool.meshes.values().filter(|mesh| mesh.is_new).for_each(|mesh| maker.write_mesh(&pools, mesh));
        let mut made = Self { pools, batches };
        made.write_blocks(pool, &mut maker);
        pool.note_written();
        (made, maker.bytes)
    }

    fn write_blocks(&mut self, pool: &mut Pool, maker: &mut Maker<'_>) {
        for (batch, buffers) in pool.batches.iter_mut().zip(&self.batches) {
            let (Some(batch), Some(buffers)) = (batch, buffers) else { continue };
            batch.records.take_changed(false, |offset, bytes| maker.write(&buffers.blocks, offset, bytes));
        }
    }

    /// The buffer of the positions of a batch.
    pub fn positions(&self, batch: usize) -> Option<&wgpu::Buffer> {
        Some(&self.batches.get(batch)?.as_ref()?.positions)
    }

    /// Uploads the poses that changed; returns the number of bytes.
    pub fn upload(&self, queue: &wgpu::Queue, pool: &mut Pool) -> u64 {
        let [.., joint_matrices, morph_weights] = &self.pools;
        let mut uploaded = 0;
        let mut write = |buffer: &wgpu::Buffer, offset: u64, bytes: &[u8]| {
            if !bytes.is_empty() {
                queue.write_buffer(buffer, offset, bytes);
                uploaded += bytes.len() as u64;
            }
        };
        pool.joint_matrices.take_changed(false, |offset, bytes| write(joint_matrices, offset, bytes));
        pool.morph_weights.take_changed(false, |offset, bytes| write(morph_weights, offset, bytes));
        uploaded
    }
}

impl Maker<'_> {
    fn make(&self, what: &str, bytes: u64) -> wgpu::Buffer {
        let common = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(&format!("deforming {what}")),
            size: bytes.max(LEAST_BYTES),
            // Renderers draw from the positions.
            usage: if what == "positions" { common | wgpu::BufferUsages::VERTEX } else { common },
            mapped_at_creation: false,
        })
    }

    /// The buffer as it was where it has room; else one that has, as large as needed at first and later half larger.
    fn grown(&mut self, what: &str, old: Option<&wgpu::Buffer>, needed: u64, keeps_content: bool) -> wgpu::Buffer {
        let Some(old) = old else { return self.make(what, needed) };
        if needed <= old.size() {
            return old.clone();
        }
        let new = self.make(what, (needed + needed / 8 * 4).min(self.most / 4 * 4).max(needed));
        if keeps_content {
            let encoder = self.encoder.get_or_insert_with(|| self.device.create_command_encoder(&Default::default()));
            encoder.copy_buffer_to_buffer(old, 0, &new, 0, old.size());
        }
        new
    }

    fn batch(
        &mut self,
        batch: &mut Batch,
        old: Option<BatchBuffers>,
        (pipeline, pools, has_new_pools): (&DeformPipeline, &PerPool<wgpu::Buffer>, bool),
        all_words: u64,
    ) -> BatchBuffers {
        let needed = (batch.records.len() * size_of::<DeformBlock>()) as u64;
        let blocks = self.grown("blocks", old.as_ref().map(|old| &old.blocks), needed, true);
        let block_count = batch.records.len() as u32;
        let stays = |old: &BatchBuffers| !has_new_pools && old.blocks == blocks;
        let positions = match old {
            Some(old) if stays(&old) => return BatchBuffers { block_count, ..old },
            Some(old) => old.positions,
            // Those that come next may have room in it: so batches are few.
            None => {
                let words = batch.word_end().max((all_words / 2).min(self.most / 4));
                batch.room = Some(words);
                self.make("positions", 4 * words)
            }
        };
        let [vertices, influences, morph_deltas, joints, weights] = pools;
        let bound = [&blocks, vertices, influences, morph_deltas, joints, weights, &positions];
        let entries: Vec<_> = (bound.into_iter().zip(0..))
            .map(|(buffer, binding)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let bind_group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(STAGE.stage.name()),
            layout: &pipeline.layout,
            entries: &entries,
        });
        BatchBuffers { positions, blocks, block_count, bind_group }
    }

    fn write_mesh(&mut self, pools: &PerPool<wgpu::Buffer>, SharedMesh { mesh, starts, .. }: &SharedMesh) {
        let contents: [&[u8]; MESH_POOLS] = [
            bytemuck::cast_slice(mesh.vertices()),
            bytemuck::cast_slice(mesh.influences()),
            bytemuck::cast_slice(mesh.morph_deltas()),
        ];
        for (index, bytes) in contents.into_iter().enumerate() {
            self.write(&pools[index], POOLS[index].1 * starts[index], bytes);
        }
    }

    fn write(&mut self, buffer: &wgpu::Buffer, offset: u64, bytes: &[u8]) {
        if !bytes.is_empty() {
            self.queue.write_buffer(buffer, offset, bytes);
            self.bytes += bytes.len() as u64;
        }
    }
}
