//! Smoothie shadows for a deferred renderer: a full-screen visibility texture from the eye's depth buffer.
//!
//! `cargo run --release -p contrejour --example deferred`

#[allow(dead_code, reason = "each example uses its part")]
mod common;

use std::sync::Arc;

use common::{Outcome, Torus};
use contrejour::glam::DMat4;
use contrejour::prelude::*;
use contrejour::wgpu;

fn main() -> Outcome {
    let (device, queue) = common::open_device()?;
    let torus = Torus::new(96, 48);
    let mut shadows = Shadows::new(&device)?;
    let mesh = TopologyAwareMesh::build(&torus.positions, &torus.triangles, &BuildOptions::default())?;
    let mesh = shadows.add_mesh(Arc::new(mesh))?;
    // The floor too: a shadow hardens towards what is in the map.
    let floor = TopologyAwareMesh::build(&common::FLOOR, &[[0, 1, 2], [3, 4, 5]], &BuildOptions::default())?;
    let floor = shadows.add_mesh(Arc::new(floor))?;

    let body = CasterInput { mesh, world_from_object: common::world_from_body(), positions: Positions::OfMesh };
    let floor = CasterInput { mesh: floor, world_from_object: DMat4::IDENTITY, positions: Positions::OfMesh };
    shadows.add_caster(&body)?;
    shadows.add_caster(&floor)?;
    let options = ShadowOptions { outputs: Outputs::VisibilityTexture, ..Default::default() };
    let light = shadows.add_light(&common::light(), &options)?;
    shadows.prepare(&device, &queue)?;
    let mut encoder = device.create_command_encoder(&Default::default());
    shadows.encode(&mut encoder, &mut Untimed);

    // The renderer's own depth (and its other buffers too), then visibility for each of its pixels.
    let depth = common::target(&device, wgpu::TextureFormat::Depth32Float, wgpu::TextureUsages::TEXTURE_BINDING);
    let depth = depth.create_view(&Default::default());
    common::draw_depth(&device, &mut encoder, &torus, &depth);
    let visibility = common::target(&device, wgpu::TextureFormat::R8Unorm, wgpu::TextureUsages::COPY_SRC);
    let eye = EyeInput {
        depth: &depth,
        world_from_eye_clip: common::eye_clip_from_world().inverse(),
        background_depth: 1.0,
        target: &visibility.create_view(&Default::default()),
    };
    shadows.encode_visibility((&device, &queue), &mut encoder, light, &eye, &mut Untimed)?;
    queue.submit([encoder.finish()]);
    println!("{}", common::save(&device, &queue, &visibility, "contrejour-deferred.png")?.display());
    Ok(())
}
