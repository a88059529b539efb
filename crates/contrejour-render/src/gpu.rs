//! A device without a window.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use contrejour_gpu::DeviceError;
use contrejour_plan::DeviceFacts;

/// A device, its queue and what went wrong on it; a clone is the same device.
#[derive(Clone, Debug)]
pub struct Gpu {
    /// Name and driver of the adapter.
    pub adapter_info: wgpu::AdapterInfo,
    /// Samples of a pixel in pictures: 4 where the device can, else 1.
    pub sample_count: u32,
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    faults: Faults,
}

/// The first error that the device reported outside of any call, or that it is lost.
#[derive(Clone, Debug, Default)]
struct Faults(Arc<Mutex<Option<DeviceFault>>>);

/// Why no device could be opened.
#[derive(Debug, thiserror::Error)]
pub enum OpenGpuError {
    /// There is no driver.
    #[error(
        "no graphics device was found; install a Vulkan driver (without a graphics card: the software driver of the package mesa-vulkan-drivers)"
    )]
    NoAdapter(#[source] wgpu::RequestAdapterError),
    /// The adapter cannot do what WebGPU promises.
    #[error(
        "the graphics device {adapter} cannot run contrejour; choose another one with WGPU_BACKEND or VK_DRIVER_FILES"
    )]
    NoDevice {
        /// Name of the adapter.
        adapter: String,
        /// What it lacks.
        source: wgpu::RequestDeviceError,
    },
}

/// What went wrong on the device that no other call returned.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DeviceFault {
    /// The device reported an error.
    #[error("the graphics device failed: {0}; where it ran out of memory, choose a smaller --size or --map-size")]
    Reported(String),
    /// The device is lost: its driver was reset or replaced, or it was destroyed.
    #[error("the graphics device was lost{0}: open it again and make everything anew, or run the command again")]
    Lost(String),
    /// The device does not finish what it is waited for.
    #[error("the graphics device does not finish its work: {0}")]
    Unfinished(String),
}

/// What is asked of a device beyond WebGPU's defaults.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Extras {
    /// Whatever it has and we can use.
    All,
    /// Nothing.
    None,
}

impl Gpu {
    /// Opens the fastest device that there is; software drivers count as devices.
    ///
    /// Timestamps, blending of 32-bit floats and larger buffers and textures than WebGPU's defaults are asked for
    /// where the adapter has them. `WGPU_BACKEND` in the environment chooses a backend.
    ///
    /// # Errors
    ///
    /// [`OpenGpuError`] when there is no driver or the device lacks a default of WebGPU.
    pub fn open() -> Result<Self, OpenGpuError> {
        Self::open_with(Extras::All)
    }

    /// Opens it with WebGPU's default limits and no optional feature, as the least that contrejour runs on.
    ///
    /// # Errors
    ///
    /// As [`open`](Self::open).
    pub fn open_with_defaults() -> Result<Self, OpenGpuError> {
        Self::open_with(Extras::None)
    }

    /// What we ask of wgpu, before the environment has its say.
    ///
    /// Arguments of indirect dispatches and draws are not checked again: the stages that write them clamp them, and our
    /// tests run with wgpu's check, which is a dispatch more for each.
    pub fn instance_descriptor() -> wgpu::InstanceDescriptor {
        let descriptor = wgpu::InstanceDescriptor {
            // OpenGL has less than WebGPU's defaults; to look for it costs time and lines on standard error.
            backends: wgpu::Backends::PRIMARY,
            flags: wgpu::InstanceFlags::default().difference(wgpu::InstanceFlags::VALIDATION_INDIRECT_CALL),
            ..wgpu::InstanceDescriptor::new_without_display_handle()
        };
        descriptor.with_env()
    }

    fn open_with(extras: Extras) -> Result<Self, OpenGpuError> {
        let instance = wgpu::Instance::new(Self::instance_descriptor());
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..Default::default()
        };
        let adapter = pollster::block_on(instance.request_adapter(&options)).map_err(OpenGpuError::NoAdapter)?;
        Self::open_on_with(&adapter, extras)
    }

    /// Opens the device of an adapter that the caller chose, such as one that can show pictures in a window, with all that
    /// [`open`](Self::open) asks for.
    ///
    /// # Errors
    ///
    /// [`OpenGpuError`] when the device lacks a default of WebGPU.
    pub fn open_on(adapter: &wgpu::Adapter) -> Result<Self, OpenGpuError> {
        Self::open_on_with(adapter, Extras::All)
    }

    fn open_on_with(adapter: &wgpu::Adapter, extras: Extras) -> Result<Self, OpenGpuError> {
        let adapter_info = adapter.get_info();
        let wanted = contrejour_gpu::Shadows::optional_features() | wgpu::Features::TIMESTAMP_QUERY;
        let (optional, limits) = match extras {
            Extras::All => (adapter.features() & wanted, limits(&adapter.limits())),
            Extras::None => (wgpu::Features::empty(), contrejour_gpu::Shadows::required_limits()),
        };
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("contrejour"),
            required_features: contrejour_gpu::Shadows::required_features() | optional,
            required_limits: limits,
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|source| OpenGpuError::NoDevice { adapter: adapter_info.name.clone(), source })?;

        let faults = Faults::default();
        let reported = faults.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| reported.note_error(&error)));
        let lost = faults.clone();
        device.set_device_lost_callback(move |_, message| lost.note_loss(&message));
        let sample_count = sample_count(adapter);
        Ok(Self { adapter_info, sample_count, device, queue, faults })
    }

    /// One line that names the device and its driver.
    pub fn description(&self) -> String {
        let wgpu::AdapterInfo { name, backend, driver, driver_info, .. } = &self.adapter_info;
        let driver = format!("{driver} {driver_info}");
        match driver.trim() {
            "" => format!("{name} ({backend})"),
            driver => format!("{name} ({backend}, {driver})"),
        }
    }

    /// Whether the device computes on the CPU's cores. Its timestamps tell little of compute passes: judge it by the time
    /// from submission to completion.
    pub fn is_software(&self) -> bool {
        self.adapter_info.device_type == wgpu::DeviceType::Cpu
    }

    /// Frames that may be under way while the next one is recorded. None on a software device: it computes on the cores
    /// that frames are recorded on, and would be measured with the CPU.
    pub fn frames_in_flight(&self) -> usize {
        if self.is_software() { 0 } else { 2 }
    }

    /// What the frame plan needs to know of the device.
    pub fn facts(&self) -> DeviceFacts {
        contrejour_gpu::device_facts(&self.device)
    }

    /// Tells what the device reported outside of any call.
    ///
    /// # Errors
    ///
    /// [`DeviceFault`] with the first report.
    pub fn check(&self) -> Result<(), DeviceFault> {
        self.faults.first().map_or(Ok(()), Err)
    }

    /// A buffer with contents; `create_buffer_init` of wgpu panics where there is no memory or no device.
    pub(crate) fn upload(&self, label: &str, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: contents.len() as u64,
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        self.queue.write_buffer(&buffer, 0, contents);
        buffer
    }

    /// Waits for a submission, or for all of them.
    ///
    /// # Errors
    ///
    /// [`DeviceFault`] when the device fails or is lost.
    pub fn wait(&self, submission: Option<wgpu::SubmissionIndex>) -> Result<(), DeviceFault> {
        let waited =
            contrejour_gpu::poll(&self.device, wgpu::PollType::Wait { submission_index: submission, timeout: None });
        if waited.is_err() {
            // A lost device says so when it is polled, and has no submission to wait for.
            let _ = contrejour_gpu::poll(&self.device, wgpu::PollType::Poll);
        }
        self.check()?;
        match waited {
            Ok(_) => Ok(()),
            Err(DeviceError::Lost) => Err(DeviceFault::Lost(String::new())),
            Err(error) => Err(DeviceFault::Unfinished(error.to_string())),
        }
    }
}

impl Faults {
    /// The first error says what happened; those that follow from it are not kept.
    fn note_error(&self, error: &wgpu::Error) {
        // Reports go over many lines.
        let text = error.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
        self.lock().get_or_insert(DeviceFault::Reported(text));
    }

    /// Whatever was reported before: nothing else matters then.
    fn note_loss(&self, message: &str) {
        let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
        let reason = if message.is_empty() { message } else { format!(" ({message})") };
        *self.lock() = Some(DeviceFault::Lost(reason));
    }

    fn first(&self) -> Option<DeviceFault> {
        self.lock().clone()
    }

    fn lock(&self) -> MutexGuard<'_, Option<DeviceFault>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// WebGPU's defaults, with room for larger meshes and pictures where the adapter has it.
fn limits(adapter: &wgpu::Limits) -> wgpu::Limits {
    let required = contrejour_gpu::Shadows::required_limits();
    wgpu::Limits {
        max_buffer_size: required.max_buffer_size.max(adapter.max_buffer_size),
        max_storage_buffer_binding_size: required
            .max_storage_buffer_binding_size
            .max(adapter.max_storage_buffer_binding_size),
        max_texture_dimension_2d: required.max_texture_dimension_2d.max(adapter.max_texture_dimension_2d),
        ..required
    }
}

fn sample_count(adapter: &wgpu::Adapter) -> u32 {
    let formats = [crate::targets::COLOR_FORMAT, crate::targets::RADIANCE_FORMAT, crate::targets::DEPTH_FORMAT];
    let all_can =
        formats.iter().all(|&format| adapter.get_texture_format_features(format).flags.sample_count_supported(4));
    if all_can { 4 } else { 1 }
}
