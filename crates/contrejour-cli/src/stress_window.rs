//! The world of a stress run in a window.

use std::sync::Arc;
use std::time::{Duration, Instant};

use contrejour_lab::stress::{Show, StressOptions, Summary};
use contrejour_render::{Gpu, OpenGpuError};
use winit::application::ApplicationHandler;
use winit::dpi::LogicalSize;
use winit::event::{ElementState, KeyEvent, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::keyboard::{Key, NamedKey};
use winit::window::{Window, WindowId};

use crate::failure::{Failure, one_line};

/// The size of the window as it opens, in logical pixels.
const SIZE: [u32; 2] = [1280, 720];

/// How often the title tells what a frame costs.
const TITLE_EVERY: Duration = Duration::from_millis(500);

/// Why there is no window.
#[derive(Debug, thiserror::Error)]
pub enum WindowError {
    /// There is no display, or it refuses.
    #[error("no window can be opened ({0}): run this where there is a desktop, or leave --window away")]
    Display(String),
    /// The device can't show pictures there.
    #[error(
        "the graphics device can't show pictures in a window ({0}): leave --window away, or choose another device with WGPU_BACKEND"
    )]
    Surface(String),
}

/// Shows a run until its time is over or the window is closed; Esc closes it too.
pub fn run(options: &StressOptions) -> Result<Summary, Failure> {
    let event_loop = EventLoop::new().map_err(|error| no_display(&error))?;
    event_loop.set_control_flow(ControlFlow::Poll);
    let mut app = App { options, shown: None, ended: None };
    event_loop.run_app(&mut app).map_err(|error| no_display(&error))?;
    app.ended.unwrap_or_else(|| Err(WindowError::Display("it was closed before it was shown".into()).into()))
}

fn no_display(error: &dyn std::error::Error) -> WindowError {
    WindowError::Display(without_place(&one_line(error)).to_owned())
}

/// winit begins what the system says with the place in its own source: `os error at /path/of/a/file.rs:12: ...`.
fn without_place(told: &str) -> &str {
    let said = told.strip_prefix("os error at ").and_then(|told| told.split_once(".rs:")?.1.split_once(": "));
    said.map_or(told, |(_, said)| said.trim_end_matches('.'))
}

/// A run in a window.
struct App<'a> {
    options: &'a StressOptions,
    shown: Option<Shown>,
    ended: Option<Result<Summary, Failure>>,
}

/// What there is while the window is open. The surface goes before its window.
struct Shown {
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    gpu: Gpu,
    show: Show,
    window: Arc<Window>,
    told: Instant,
    frames_since: u32,
}

impl App<'_> {
    fn open(&self, event_loop: &ActiveEventLoop) -> Result<Shown, Failure> {
        let attributes = Window::default_attributes()
            .with_title("contrejour stress")
            .with_inner_size(LogicalSize::new(f64::from(SIZE[0]), f64::from(SIZE[1])));
        let window = event_loop.create_window(attributes).map_err(|error| no_display(&error))?;
        let window = Arc::new(window);
        let display = Box::new(event_loop.owned_display_handle());
        let instance = wgpu::Instance::new(Gpu::instance_descriptor().with_display_handle(display));
        let no_surface = |error: &dyn std::error::Error| WindowError::Surface(one_line(error));
        let surface = instance.create_surface(Arc::clone(&window)).map_err(|error| no_surface(&error))?;
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            compatible_surface: Some(&surface),
            ..Default::default()
        }));
        let adapter = adapter.map_err(OpenGpuError::NoAdapter)?;
        let gpu = Gpu::open_on(&adapter)?;
        let [width, height] = size_of_pictures(&window);
        let config = surface.get_default_config(&adapter, width, height);
        let config = config.ok_or_else(|| WindowError::Surface(gpu.description()))?;
        surface.configure(&gpu.device, &config);
        let show = Show::new(gpu.clone(), self.options, [width, height])?;
        Ok(Shown { surface, config, gpu, show, window, told: Instant::now(), frames_since: 0 })
    }

    fn end(&mut self, event_loop: &ActiveEventLoop, ended: Result<Summary, Failure>) {
        self.shown = None;
        self.ended.get_or_insert(ended);
        event_loop.exit();
    }

    /// Closes the window and says what came of the run.
    fn close(&mut self, event_loop: &ActiveEventLoop) {
        if let Some(shown) = self.shown.take() {
            let Shown { show, .. } = shown;
            let summary = show.finish().map_err(Failure::from);
            self.end(event_loop, summary);
        }
    }
}

impl ApplicationHandler for App<'_> {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.shown.is_some() {
            return;
        }
        match self.open(event_loop) {
            Ok(shown) => self.shown = Some(shown),
            Err(error) => self.end(event_loop, Err(error)),
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(shown) = &mut self.shown else { return };
        match event {
            WindowEvent::CloseRequested => self.close(event_loop),
            WindowEvent::KeyboardInput {
                event: KeyEvent { logical_key: Key::Named(NamedKey::Escape), state: ElementState::Pressed, .. },
                ..
            } => self.close(event_loop),
            WindowEvent::RedrawRequested => {
                if let Err(error) = shown.draw() {
                    self.end(event_loop, Err(error));
                } else if shown.show.is_over() {
                    self.close(event_loop);
                }
            }
            _ => {}
        }
    }

    fn about_to_wait(&mut self, _: &ActiveEventLoop) {
        if let Some(shown) = &self.shown {
            shown.window.request_redraw();
        }
    }
}

impl Shown {
    fn draw(&mut self) -> Result<(), Failure> {
        let [width, height] = size_of_pictures(&self.window);
        if [self.config.width, self.config.height] != [width, height] {
            (self.config.width, self.config.height) = (width, height);
            self.configure()?;
        }
        let picture = match self.surface.get_current_texture() {
            wgpu::CurrentSurfaceTexture::Success(picture) | wgpu::CurrentSurfaceTexture::Suboptimal(picture) => picture,
            // Nobody would see it: the next one may be.
            wgpu::CurrentSurfaceTexture::Timeout | wgpu::CurrentSurfaceTexture::Occluded => return Ok(()),
            wgpu::CurrentSurfaceTexture::Outdated => return self.configure(),
            wgpu::CurrentSurfaceTexture::Lost | wgpu::CurrentSurfaceTexture::Validation => {
                return Err(WindowError::Surface("its surface was lost".into()).into());
            }
        };
        let view = picture.texture.create_view(&wgpu::TextureViewDescriptor::default());
        let cpu_ms = self.show.draw_into(&view, self.config.format)?;
        self.window.pre_present_notify();
        self.gpu.queue.present(picture);
        self.tell(cpu_ms);
        Ok(())
    }

    fn configure(&mut self) -> Result<(), Failure> {
        self.show.resize([self.config.width, self.config.height])?;
        self.surface.configure(&self.gpu.device, &self.config);
        Ok(())
    }

    /// Tells in the title how it goes.
    fn tell(&mut self, cpu_ms: f64) {
        self.frames_since += 1;
        let elapsed = self.told.elapsed();
        if elapsed >= TITLE_EVERY {
            let rate = f64::from(self.frames_since) / elapsed.as_secs_f64();
            self.window.set_title(&format!("contrejour stress: {rate:.1} frames/s, CPU {cpu_ms:.2} ms a frame"));
            (self.told, self.frames_since) = (Instant::now(), 0);
        }
    }
}

/// A minimised window has no size, a picture has.
fn size_of_pictures(window: &Window) -> [u32; 2] {
    let size = window.inner_size();
    [size.width.max(1), size.height.max(1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_in_the_source_is_not_told() {
        let told = "os error at /home/somebody/.cargo/winit-0.30.13/src/linux/mod.rs:765: neither WAYLAND_DISPLAY nor DISPLAY is set.";
        assert_eq!(without_place(told), "neither WAYLAND_DISPLAY nor DISPLAY is set");
        for told in ["the requested operation is not supported", "os error at once"] {
            assert_eq!(without_place(told), told);
        }
    }
}
