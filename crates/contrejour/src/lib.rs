//! Exact silhouettes and smoothie soft shadows of any triangle mesh, found on the GPU with wgpu.
