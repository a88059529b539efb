//! A device is lost under way: the next frame says so, and everything is made anew on another device.
//!
//! `cargo run --release -p contrejour --example lost_device`

#[allow(dead_code, reason = "each example uses its part")]
mod common;

use std::error::Error;
use std::sync::Arc;

use common::{Outcome, Torus};
use contrejour::glam::DMat4;
use contrejour::gpu::{DeviceError, PrepareError};
use contrejour::prelude::*;
use contrejour::wgpu;

/// What outlives a device.
struct Meshes {
    torus: Torus,
    body: Arc<TopologyAwareMesh>,
    floor: Arc<TopologyAwareMesh>,
}

/// Everything that is made on a device, and goes with it.
struct Renderer {
    device: wgpu::Device,
    queue: wgpu::Queue,
    shadows: Shadows,
    light: LightHandle,
    visibility: wgpu::Texture,
}

fn main() -> Outcome {
    let torus = Torus::new(96, 48);
    let build = |positions: &[[f32; 3]], triangles: &[[u32; 3]]| {
        TopologyAwareMesh::build(positions, triangles, &BuildOptions::default()).map(Arc::new)
    };
    let body = build(&torus.positions, &torus.triangles)?;
    let meshes = Meshes { body, floor: build(&common::FLOOR, &[[0, 1, 2], [3, 4, 5]])?, torus };

    let mut renderer = Renderer::new(&meshes)?;
    renderer.draw(&meshes)?;
    let before = renderer.picture()?;

    // As when the driver is replaced, or resets the device since another program's work hung.
    renderer.device.destroy();
    match renderer.draw(&meshes) {
        Err(PrepareError::Device(error @ DeviceError::Lost)) => println!("{error}"),
        other => return Err(format!("a lost device has drawn: {other:?}").into()),
    }

    // The meshes are kept, so only what was on the device is made again.
    renderer = Renderer::new(&meshes)?;
    renderer.draw(&meshes)?;
    if renderer.picture()? != before {
        return Err("the picture is another one".into());
    }
    println!("drawn again, the same picture");
    Ok(())
}

impl Renderer {
    fn new(meshes: &Meshes) -> Result<Self, Box<dyn Error>> {
        let (device, queue) = common::open_device()?;
        let options = ShadowOptions { outputs: Outputs::VisibilityTexture, ..Default::default() };
        let mut shadows = Shadows::new(&device)?;
        let placed = [(&meshes.body, common::world_from_body()), (&meshes.floor, DMat4::IDENTITY)];
        for (mesh, world_from_object) in placed {
            let mesh = shadows.add_mesh(Arc::clone(mesh))?;
            shadows.add_caster(&CasterInput { mesh, world_from_object, positions: Positions::OfMesh })?;
        }
        let light = shadows.add_light(&common::light(), &options)?;
        let visibility = common::target(&device, wgpu::TextureFormat::R8Unorm, wgpu::TextureUsages::COPY_SRC);
        Ok(Self { device, queue, shadows, light, visibility })
    }

    fn draw(&mut self, meshes: &Meshes) -> Result<(), PrepareError> {
        let Self { device, queue, shadows, .. } = self;
        shadows.prepare(device, queue)?;
        let mut encoder = device.create_command_encoder(&Default::default());
        shadows.encode(&mut encoder, &mut Untimed);
        let depth = common::target(device, wgpu::TextureFormat::Depth32Float, wgpu::TextureUsages::TEXTURE_BINDING);
        let depth = depth.create_view(&Default::default());
        common::draw_depth(device, &mut encoder, &meshes.torus, &depth);
        let eye = EyeInput {
            depth: &depth,
            world_from_eye_clip: common::eye_clip_from_world().inverse(),
            background_depth: 1.0,
            target: &self.visibility.create_view(&Default::default()),
        };
        shadows.encode_visibility((&*device, &*queue), &mut encoder, self.light, &eye, &mut Untimed)?;
        queue.submit([encoder.finish()]);
        Ok(())
    }

    fn picture(&self) -> Result<Vec<u8>, Box<dyn Error>> {
        common::read_texture(&self.device, &self.queue, &self.visibility)
    }
}
