//! The truth: how much of an area light each point of a surface sees, by ray tracing on the CPU.
//!
//! [`Occluders`] hold the faces of a scene, a [`LightShape`] is the light, a [`Receiver`] is a point that a raster
//! pass shades, and [`trace`] gives the [`Visibility`] of the light from each with its standard error.
//!
//! **Visibility** is the part of the light, by area (by solid angle for a sphere), that the point sees: the segment to
//! a point of the light meets no casting face, and leaves the receiver's face on the side that is looked at. Nothing
//! else: the light's cone, its near and far planes and the cosine at the surface are shading, not visibility.
//!
//! So a face is an opaque sheet, and where its own plane cuts the light, the part below the plane is hidden, be the
//! face part of a closed body or not. [`Facing`] says so: a comparison with shadow techniques, which see one point of
//! the light and call a side averted from it dark, is fair where the receiver is [`Facing::Towards`] the whole light.
//!
//! ```
//! use contrejour_trace::{LightShape, Occluders, OccluderMesh, Receiver, TraceOptions, trace};
//! use glam::{DMat4, DVec3};
//!
//! // A floor, and a sheet above its left half.
//! let corners = [[-9.0, 0.0, -9.0], [-9.0, 0.0, 9.0], [9.0, 0.0, 9.0], [9.0, 0.0, -9.0_f32]];
//! let triangles = [[0, 1, 2], [0, 2, 3]];
//! let floor = OccluderMesh::new(&corners, &triangles, DMat4::IDENTITY);
//! let sheet = OccluderMesh::new(&corners, &triangles, DMat4::from_translation(DVec3::new(-9.0, 1.0, 0.0)));
//! let occluders = Occluders::new(&[floor, sheet])?;
//!
//! let light = LightShape::Disk { center: DVec3::new(0.0, 2.0, 0.0), normal: DVec3::Y, radius: 0.2 };
//! let receiver = Receiver { position: DVec3::ZERO, face: 0, seen_from: DVec3::Y };
//! let visibility = trace(&occluders, &light, &[receiver], &TraceOptions::default(), &|_| ())?;
//! assert!((visibility[0].mean - 0.5).abs() < 0.02);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod disk_map;
mod error;
mod face_tree;
mod light_shape;
mod local_light;
mod occluders;
mod options;
mod receiver;
mod shadow_ray;
mod shaft;
mod surface_point;
mod trace;
mod trace_space;

pub use error::{OccluderError, TraceError};
pub use light_shape::LightShape;
pub use occluders::{Holes, OccluderMesh, Occluders};
pub use options::TraceOptions;
pub use receiver::{Facing, Receiver, Visibility};
pub use trace::trace;
