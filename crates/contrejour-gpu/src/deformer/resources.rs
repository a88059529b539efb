//! The stage `deform_positions` on the device: its pipeline, its buffers, its dispatch.

use contrejour_layout::{Influence, MorphDelta, RestVertex};

use super::pool::{Poses, Tables};
use crate::compute::dispatch;
use crate::stages::{SCENE, SceneComputeStage};
use crate::timer::PassTimer;

/// The stage, made once.
#[derive(Debug)]
pub(super) struct DeformPipeline {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
}

/// Buffers of a set of casters.
#[derive(Debug)]
pub(super) struct DeformResources {
    pub positions: wgpu::Buffer,
    joint_matrices: wgpu::Buffer,
    morph_weights: wgpu::Buffer,
    bind_group: wgpu::BindGroup,
    block_count: u32,
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

    /// Records the dispatch as a pass of its own, so that a timer sees it alone.
    pub fn encode<T: PassTimer>(&self, encoder: &mut wgpu::CommandEncoder, resources: &DeformResources, timer: &mut T) {
        let name = STAGE.stage.name();
        let query = timer.begin(name, encoder);
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some(name),
                timestamp_writes: T::compute_writes(&query),
            });
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &resources.bind_group, &[]);
            dispatch(&mut pass, resources.block_count);
        }
        timer.end(query, encoder);
    }
}

impl DeformResources {
    /// Makes the buffers and fills those that no pose changes.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, pipeline: &DeformPipeline, tables: &Tables) -> Self {
        let common = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
        let buffers = tables.pool_bytes().map(|(name, bytes)| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(&format!("deforming {name}")),
                size: bytes.max(LEAST_BYTES),
                // Renderers draw from the positions.
                usage: if name == "positions" { common | wgpu::BufferUsages::VERTEX } else { common },
                mapped_at_creation: false,
            })
        });
        let entries: Vec<_> = (buffers.iter().zip(0..))
            .map(|(buffer, binding)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(STAGE.stage.name()),
            layout: &pipeline.layout,
            entries: &entries,
        });
        let [blocks, vertices, influences, morph_deltas, joint_matrices, morph_weights, positions] = buffers;
        write(queue, &blocks, 0, bytemuck::cast_slice(&tables.blocks));
        let mut offsets = [0; 3];
        for mesh in &tables.meshes {
            write(queue, &vertices, offsets[0], bytemuck::cast_slice::<RestVertex, u8>(mesh.vertices()));
            write(queue, &influences, offsets[1], bytemuck::cast_slice::<Influence, u8>(mesh.influences()));
            write(queue, &morph_deltas, offsets[2], bytemuck::cast_slice::<MorphDelta, u8>(mesh.morph_deltas()));
            offsets[0] += size_of_val(mesh.vertices()) as u64;
            offsets[1] += size_of_val(mesh.influences()) as u64;
            offsets[2] += size_of_val(mesh.morph_deltas()) as u64;
        }
        let block_count = tables.blocks.len() as u32;
        Self { positions, joint_matrices, morph_weights, bind_group, block_count }
    }

    /// Uploads the poses; returns the number of bytes.
    pub fn upload(&self, queue: &wgpu::Queue, poses: &Poses) -> u64 {
        let joint_matrices = bytemuck::cast_slice(&poses.joint_matrices);
        let morph_weights = bytemuck::cast_slice(&poses.morph_weights);
        write(queue, &self.joint_matrices, 0, joint_matrices);
        write(queue, &self.morph_weights, 0, morph_weights);
        (joint_matrices.len() + morph_weights.len()) as u64
    }
}

fn write(queue: &wgpu::Queue, buffer: &wgpu::Buffer, offset: u64, bytes: &[u8]) {
    if !bytes.is_empty() {
        queue.write_buffer(buffer, offset, bytes);
    }
}
