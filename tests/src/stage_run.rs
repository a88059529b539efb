//! One compute stage alone on the device, fed with inputs made on the CPU.

use std::collections::HashMap;

use naga::{AddressSpace, StorageAccess};

use crate::gpu::Gpu;

/// A compute pipeline whose bindings are known by the names in its WGSL.
#[derive(Debug)]
pub struct StageRun {
    name: String,
    pipeline: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
    bindings: Vec<Binding>,
}

/// A buffer that a shader binds.
#[derive(Debug)]
pub(crate) struct Binding {
    pub name: String,
    pub index: u32,
    pub kind: wgpu::BufferBindingType,
}

/// What the stage wrote: the bytes of each buffer that it may write, by name.
#[derive(Debug)]
pub struct Outputs {
    stage: String,
    bytes: HashMap<String, Vec<u8>>,
}

impl Outputs {
    /// The records of a buffer.
    ///
    /// # Panics
    ///
    /// When the stage does not write a buffer of this name.
    pub fn get<T: bytemuck::Pod>(&self, name: &str) -> Vec<T> {
        let bytes = self.bytes.get(name).unwrap_or_else(|| panic!("{} does not write {name}", self.stage));
        bytemuck::pod_collect_to_vec(bytes)
    }
}

impl IntoIterator for Outputs {
    type Item = (String, Vec<u8>);
    type IntoIter = std::collections::hash_map::IntoIter<String, Vec<u8>>;

    /// Each buffer's name and bytes.
    fn into_iter(self) -> Self::IntoIter {
        self.bytes.into_iter()
    }
}

impl StageRun {
    /// Builds the pipeline of an entry point; its bind group 0 is read off the WGSL.
    ///
    /// # Panics
    ///
    /// When the WGSL is not valid.
    pub fn new(gpu: &Gpu, wgsl: &str, entry_point: &str) -> Self {
        Self::with_constants(gpu, wgsl, entry_point, &[])
    }

    /// The same with other override constants than those of the WGSL.
    ///
    /// # Panics
    ///
    /// As [`new`](Self::new).
    pub fn with_constants(gpu: &Gpu, wgsl: &str, entry_point: &str, constants: &[(&str, f64)]) -> Self {
        let bindings = bindings_of(wgsl);
        let entries: Vec<_> = bindings
            .iter()
            .map(|binding| wgpu::BindGroupLayoutEntry {
                binding: binding.index,
                visibility: wgpu::ShaderStages::COMPUTE,
                ty: wgpu::BindingType::Buffer { ty: binding.kind, has_dynamic_offset: false, min_binding_size: None },
                count: None,
            })
            .collect();
        let layout = gpu
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(entry_point), entries: &entries });
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(entry_point),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(entry_point),
            source: wgpu::ShaderSource::Wgsl(wgsl.into()),
        });
        let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry_point),
            layout: Some(&pipeline_layout),
            module: &module,
            entry_point: Some(entry_point),
            compilation_options: wgpu::PipelineCompilationOptions { constants, ..Default::default() },
            cache: None,
        });
        Self { name: entry_point.into(), pipeline, layout, bindings }
    }

    /// The names of its bindings.
    pub fn bindings(&self) -> impl Iterator<Item = &str> {
        self.bindings.iter().map(|binding| binding.name.as_str())
    }

    /// Runs one dispatch with a buffer for each binding, by name, and returns what it wrote.
    ///
    /// # Panics
    ///
    /// When an input is missing or has a name that no binding has.
    pub fn run(&self, gpu: &Gpu, groups: [u32; 3], inputs: &[(&str, &[u8])]) -> Outputs {
        for (name, _) in inputs {
            assert!(self.bindings.iter().any(|binding| binding.name == *name), "{} binds no {name}", self.name);
        }
        let bytes_of = |binding: &Binding| {
            let input = inputs.iter().find(|(name, _)| *name == binding.name);
            input.unwrap_or_else(|| panic!("{} needs {}", self.name, binding.name)).1
        };
        let buffers: Vec<_> = self
            .bindings
            .iter()
            .map(|binding| {
                let usage = match binding.kind {
                    wgpu::BufferBindingType::Uniform => wgpu::BufferUsages::UNIFORM,
                    wgpu::BufferBindingType::Storage { .. } => wgpu::BufferUsages::STORAGE,
                };
                gpu.upload(&binding.name, bytes_of(binding), usage)
            })
            .collect();
        let entries: Vec<_> = self
            .bindings
            .iter()
            .zip(&buffers)
            .map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding: binding.index,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        let bind_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(&self.name),
            layout: &self.layout,
            entries: &entries,
        });

        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &bind_group, &[]);
        pass.dispatch_workgroups(groups[0], groups[1], groups[2]);
        drop(pass);
        gpu.queue.submit([encoder.finish()]);

        let bytes = self
            .bindings
            .iter()
            .zip(&buffers)
            .filter(|(binding, _)| binding.kind == wgpu::BufferBindingType::Storage { read_only: false })
            .map(|(binding, buffer)| (binding.name.clone(), gpu.read_back(buffer, bytes_of(binding).len())))
            .collect();
        Outputs { stage: self.name.clone(), bytes }
    }
}

/// Bind group 0 as the WGSL declares it, also what the entry point does not use.
pub(crate) fn bindings_of(wgsl: &str) -> Vec<Binding> {
    let module = naga::front::wgsl::parse_str(wgsl).unwrap_or_else(|error| panic!("{}", error.emit_to_string(wgsl)));
    let mut bindings: Vec<_> = module
        .global_variables
        .iter()
        .filter_map(|(_, variable)| {
            let resource = variable.binding.as_ref().filter(|resource| resource.group == 0)?;
            let kind = match variable.space {
                AddressSpace::Uniform => wgpu::BufferBindingType::Uniform,
                AddressSpace::Storage { access } => {
                    wgpu::BufferBindingType::Storage { read_only: !access.contains(StorageAccess::STORE) }
                }
                _ => return None,
            };
            Some(Binding { name: variable.name.clone()?, index: resource.binding, kind })
        })
        .collect();
    bindings.sort_by_key(|binding| binding.index);
    bindings
}
