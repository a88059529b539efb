//! Devices for tests: one for each thread that runs them.

use std::cell::OnceCell;
use std::env;
use std::fmt::Display;

use contrejour_gpu::{Shadows, Untimed};
use wgpu::util::DeviceExt;

/// Set to 1, a missing adapter fails the tests that need one. Otherwise they are reported as ignored.
pub const REQUIRE_GPU: &str = "CONTREJOUR_REQUIRE_GPU";

/// Set to a part of an adapter's name, every other adapter fails the tests that need one.
pub const ADAPTER: &str = "CONTREJOUR_ADAPTER";

/// A device with its queue.
#[derive(Debug)]
pub struct Gpu {
    /// The device. An error that nobody catches panics with wgpu's text, and so fails the test that made it.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// Name of the adapter and of its backend.
    pub adapter: String,
}

/// A device that is never given back, or why there is none.
type Kept = Result<&'static Gpu, &'static str>;

/// The thread's device with WebGPU's default limits and no optional feature.
///
/// A thread has its own so that none waits for another's work, and since a wait of one thread may take over another's
/// callback and return that other's wait before the callback has run.
///
/// # Errors
///
/// Why there is none, in one line.
pub fn gpu() -> Result<&'static Gpu, &'static str> {
    thread_local!(static GPU: OnceCell<Kept> = const { OnceCell::new() });
    GPU.with(|gpu| *gpu.get_or_init(|| kept(open(wgpu::Features::empty()))))
}

/// The thread's device that also blends 32-bit floats.
///
/// # Errors
///
/// Why there is none, in one line; that an adapter has no such feature is a normal reason.
pub fn gpu_blending_floats() -> Result<&'static Gpu, &'static str> {
    thread_local!(static GPU: OnceCell<Kept> = const { OnceCell::new() });
    GPU.with(|gpu| *gpu.get_or_init(|| kept(open(wgpu::Features::FLOAT32_BLENDABLE))))
}

fn kept(opened: Result<Gpu, String>) -> Kept {
    match opened {
        Ok(gpu) => Ok(Box::leak(Box::new(gpu))),
        Err(reason) => Err(reason.leak()),
    }
}

/// A device that no other test uses, so that its counters tell of one test alone.
///
/// # Errors
///
/// Why there is none, in one line.
pub fn gpu_alone() -> Result<Gpu, String> {
    open(wgpu::Features::empty())
}

/// What the renderer's device is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Equipment {
    /// What the command line asks for: optional features and larger limits, where the adapter has them.
    Best,
    /// WebGPU's default limits and no optional feature.
    Baseline,
}

/// A device of the renderer.
///
/// # Errors
///
/// Why there is none, in one line.
pub fn render_gpu(equipment: Equipment) -> Result<contrejour_render::Gpu, String> {
    let opened = match equipment {
        Equipment::Best => contrejour_render::Gpu::open(),
        Equipment::Baseline => contrejour_render::Gpu::open_with_defaults(),
    };
    let gpu = opened.map_err(text)?;
    check_adapter(&gpu.adapter_info.name, env::var(ADAPTER).ok().as_deref())?;
    Ok(gpu)
}

/// Whether tests that need a device fail without it.
pub fn is_required() -> bool {
    env::var(REQUIRE_GPU).is_ok_and(|value| value == "1") || env::var_os(ADAPTER).is_some()
}

/// A device that no other test uses, with textures as large as its adapter allows and samplers that weigh 32-bit floats.
///
/// # Errors
///
/// Why there is none, in one line; that an adapter has no such feature is a normal reason.
pub fn gpu_with_large_textures() -> Result<Gpu, String> {
    open_with(wgpu::Features::FLOAT32_FILTERABLE, |adapter| wgpu::Limits {
        max_texture_dimension_2d: adapter.max_texture_dimension_2d,
        ..wgpu::Limits::default()
    })
}

/// A device whose shaders see no storage buffer of more than so many bytes, so that small meshes are too large for it.
///
/// # Errors
///
/// Why there is none, in one line.
pub fn gpu_with_small_buffers(max_storage_buffer_binding_size: u64) -> Result<Gpu, String> {
    open_with(wgpu::Features::empty(), |_| wgpu::Limits { max_storage_buffer_binding_size, ..wgpu::Limits::default() })
}

fn open(features: wgpu::Features) -> Result<Gpu, String> {
    open_with(features, |_| wgpu::Limits::default())
}

fn open_with(features: wgpu::Features, limits: impl FnOnce(&wgpu::Limits) -> wgpu::Limits) -> Result<Gpu, String> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))
        .map_err(|error| format!("no adapter: {}", text(error)))?;
    let info = adapter.get_info();
    check_adapter(&info.name, env::var(ADAPTER).ok().as_deref())?;
    let descriptor = wgpu::DeviceDescriptor {
        label: Some("tests"),
        required_features: features,
        required_limits: limits(&adapter.limits()),
        ..Default::default()
    };
    let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
        .map_err(|error| format!("no device on {}: {}", info.name, text(error)))?;
    Ok(Gpu { device, queue, adapter: format!("{} ({})", info.name, info.backend) })
}

fn text(error: impl Display) -> String {
    error.to_string().replace('\n', " ")
}

fn check_adapter(name: &str, wanted: Option<&str>) -> Result<(), String> {
    match wanted {
        Some(wanted) if !name.contains(wanted) => Err(format!("no {wanted} but {name}; see VK_DRIVER_FILES")),
        _ => Ok(()),
    }
}

impl Gpu {
    /// A buffer that holds the bytes and, after them, zeros up to 64 bytes: a buffer must hold at least one record.
    pub fn upload(&self, label: &str, bytes: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let mut contents = bytes.to_vec();
        contents.resize(bytes.len().max(64).next_multiple_of(4), 0);
        self.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some(label),
            contents: &contents,
            usage: usage | wgpu::BufferUsages::COPY_SRC,
        })
    }

    /// The first records of a buffer that may be copied from.
    ///
    /// # Panics
    ///
    /// When the buffer is shorter or the device is lost.
    pub fn read_back<T: bytemuck::Pod>(&self, buffer: &wgpu::Buffer, count: usize) -> Vec<T> {
        self.read_part(buffer.slice(..), count)
    }

    /// The first records of a part of a buffer that may be copied from.
    ///
    /// # Panics
    ///
    /// As [`read_back`](Self::read_back).
    pub fn read_part<T: bytemuck::Pod>(&self, part: wgpu::BufferSlice<'_>, count: usize) -> Vec<T> {
        let size = (count * size_of::<T>()) as u64;
        if size == 0 {
            return Vec::new();
        }
        let copy_size = size.next_multiple_of(wgpu::COPY_BUFFER_ALIGNMENT);
        let readable = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read back"),
            size: copy_size,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(part.buffer(), part.offset(), &readable, 0, copy_size);
        self.queue.submit([encoder.finish()]);
        let bytes = self.map(&readable);
        bytemuck::pod_collect_to_vec(&bytes[..size as usize])
    }

    /// Reads the bytes of a buffer that may be mapped for reading, when a submission is done; others may still be under
    /// way.
    ///
    /// # Panics
    ///
    /// When the device is lost.
    pub fn map_after<T>(
        &self,
        readable: &wgpu::Buffer,
        submission: wgpu::SubmissionIndex,
        read: impl FnOnce(&[u8]) -> T,
    ) -> T {
        readable.map_async(wgpu::MapMode::Read, .., |mapped| mapped.expect("the buffer can be mapped"));
        let poll = wgpu::PollType::Wait { submission_index: Some(submission), timeout: None };
        self.device.poll(poll).expect("the device works");
        let result = read(&readable.get_mapped_range(..).expect("the buffer is mapped"));
        readable.unmap();
        result
    }

    /// All bytes of a buffer that may be mapped for reading, when the work before it is done.
    ///
    /// # Panics
    ///
    /// When the device is lost.
    pub fn map(&self, readable: &wgpu::Buffer) -> Vec<u8> {
        readable.map_async(wgpu::MapMode::Read, .., |mapped| mapped.expect("a fresh buffer can be mapped"));
        self.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device works");
        readable.get_mapped_range(..).expect("the buffer is mapped").to_vec()
    }
}

/// Frames until all lists must have had room.
const MAX_FRAMES: usize = 5;

/// Draws until all lists had room; `before` records what goes before the shadows of each frame. Returns how many lights the
/// first frame made.
///
/// # Errors
///
/// What the library refuses, or lists that never have room.
pub fn draw_whole(
    gpu: &Gpu,
    shadows: &mut Shadows,
    mut before: impl FnMut(&mut wgpu::CommandEncoder),
) -> Result<u32, String> {
    let mut redone = None;
    for _ in 0..MAX_FRAMES {
        shadows.prepare(&gpu.device, &gpu.queue).map_err(|error| error.to_string())?;
        redone.get_or_insert(shadows.stats().lights_redone);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        before(&mut encoder);
        shadows.encode(&mut encoder, &mut Untimed);
        gpu.queue.submit([encoder.finish()]);
        shadows.wait_for_counters(&gpu.device).map_err(|error| error.to_string())?;
        if shadows.is_complete() {
            return redone.ok_or_else(|| "no frame was drawn".into());
        }
    }
    Err("lists never had room".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_wanted_adapter_passes() {
        let name = "SwiftShader Device (Subzero)";
        assert_eq!(check_adapter(name, None), Ok(()));
        assert_eq!(check_adapter(name, Some("SwiftShader")), Ok(()));
        let refused = check_adapter("llvmpipe (LLVM 15.0.6, 256 bits)", Some("SwiftShader"));
        assert!(refused.is_err_and(|text| text.contains("no SwiftShader but llvmpipe")));
    }
}
