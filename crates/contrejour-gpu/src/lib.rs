//! Silhouettes and smoothie soft shadows of any triangle mesh in wgpu compute shaders.
