//! How much memory an input may take, at most, on top of itself.

use crate::{Format, Loaded};

/// Whatever the input: tables, the thread pool's queues, messages.
const ALWAYS: usize = 1 << 20;

/// Bytes that a loader, the building of topology and a scene may hold at once for the bytes of a file and what it
/// held; `None` where it was refused.
pub fn most_bytes_of_mesh_file(format: Format, file_bytes: usize, loaded: Option<Loaded>) -> usize {
    match (format, loaded) {
        // A mesh can stand in many nodes, so what a glTF file holds does not follow from its bytes alone.
        (Format::Gltf, Some(loaded)) => ALWAYS + 512 * file_bytes + 1024 * (loaded.vertices + loaded.triangles),
        // What 257 numbers a byte become before the file is refused.
        (Format::Gltf, None) => ALWAYS + 257 * 512 * file_bytes,
        _ => ALWAYS + 1024 * file_bytes,
    }
}

/// Bytes that the reading of a scene may hold at once for the bytes of its text and the triangles of its meshes; `None`
/// where it was refused.
pub fn most_bytes_of_scene(text_bytes: usize, triangles: Option<usize>) -> usize {
    match triangles {
        Some(triangles) => ALWAYS + 1024 * (text_bytes + triangles),
        // Shapes of as many triangles as they have by default, 25 600 at most, are made before a later line is refused.
        None => ALWAYS + 65_536 * text_bytes,
    }
}

/// Bytes that the decoding of a picture may hold at once for the bytes of its file and its texels; `None` where it was
/// refused.
pub fn most_bytes_of_picture(file_bytes: usize, texels: Option<u64>) -> usize {
    match texels {
        // A decoder's planes, 16-bit channels, and the texels.
        Some(texels) => 16 * ALWAYS + 32 * file_bytes + 24 * texels as usize,
        // A damaged one may be refused when most of it is decoded.
        None => 16 * ALWAYS + 32 * file_bytes + 24 * ((1 << 24) + 256 * file_bytes),
    }
}

/// Bytes that topology, twin and oracle may hold at once for a mesh.
pub fn most_bytes_of_silhouette(vertices: usize, triangles: usize) -> usize {
    ALWAYS + 4096 * (vertices + triangles)
}
