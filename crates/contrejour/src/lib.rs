//! Exact silhouettes and smoothie soft shadows of any triangle mesh, found on the GPU with wgpu.
//!
//! contrejour finds the silhouette of any triangle mesh (closed, open, badly wound, non-manifold) in compute shaders and
//! turns it into soft shadows that are hard at the contact and soft far away. No silhouette work is left on the CPU: a
//! frame uploads light and instance records, and draws are indirect. The caller owns device, queue, encoder and
//! submission.
//!
//! ```no_run
//! use std::sync::Arc;
//! use contrejour::prelude::*;
//! use contrejour::glam::{DMat4, DVec3};
//! use contrejour::wgpu;
//!
//! # fn frame(device: &wgpu::Device, queue: &wgpu::Queue) -> Result<(), Box<dyn std::error::Error>> {
//! // Once: a mesh with its topology, a caster and a light.
//! let positions = [[-1.0, 1.0, -1.0], [1.0, 1.0, -1.0], [0.0, 1.0, 1.0]];
//! let mesh = TopologyAwareMesh::build(&positions, &[[0, 2, 1]], &BuildOptions::default())?;
//! let mut shadows = Shadows::new(device)?;
//! let mesh = shadows.add_mesh(Arc::new(mesh))?;
//! let caster = CasterInput { mesh, world_from_object: DMat4::IDENTITY, positions: Positions::OfMesh };
//! let caster = shadows.add_caster(&caster)?;
//! let spot = Light {
//!     kind: LightKind::Spot {
//!         position: DVec3::new(2.0, 5.0, 1.0),
//!         target: DVec3::ZERO,
//!         cone_angle: 0.9,
//!         radius: 0.2,
//!         near: 1.0,
//!         far: 12.0,
//!     },
//!     color: [1.0; 3],
//! };
//! let light = shadows.add_light(&spot, &ShadowOptions::default())?;
//!
//! // Each frame: say what moved, and record into your own encoder.
//! shadows.place_caster(caster, &DMat4::from_rotation_y(0.1))?;
//! shadows.set_light(light, &spot)?;
//! shadows.prepare(device, queue)?;
//! let mut encoder = device.create_command_encoder(&Default::default());
//! shadows.encode(&mut encoder, &mut Untimed);
//!
//! // In your shader: `contrejour_visibility(position_world, normal_world)`, at a bind group that you name.
//! let receiver_wgsl = shadows.visibility_wgsl(light, 2);
//! let bind_group = shadows.visibility_bind_group(light);
//! # let _ = (receiver_wgsl, bind_group);
//! queue.submit([encoder.finish()]);
//! # Ok(())
//! # }
//! ```
//!
//! | Crate | What it holds |
//! | --- | --- |
//! | [`mesh`] | triangles in; welded, diagnosed, GPU-ready topology out |
//! | [`plan`] | lights, settings, light views, the frame plan |
//! | [`gpu`] | the stages and passes on a wgpu device |
//! | [`layout`] | the bytes that Rust and WGSL share, and the table of conventions |

pub use contrejour_gpu as gpu;
pub use contrejour_layout as layout;
pub use contrejour_mesh as mesh;
pub use contrejour_plan as plan;
pub use glam;
pub use wgpu;

/// What most users need.
pub mod prelude {
    pub use contrejour_gpu::{
        CasterHandle, CasterInput, DeformInput, Deformer, EyeInput, KnownPositions, LightHandle, MeshHandle, PassTimer,
        Positions, ShadowOptions, Shadows, Untimed,
    };
    pub use contrejour_mesh::{AlphaMask, BuildOptions, DeformingMesh, MaskImage, MaskedMesh, TopologyAwareMesh};
    pub use contrejour_plan::{
        CascadeSettings, DepthBias, Eye, Light, LightKind, Outputs, ShadowSettings, SmoothieWidth, Technique,
    };
}

/// The README's snippet, compiled.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
