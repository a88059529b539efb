//! Why a file is not a mesh, and what to do about it.

use std::path::PathBuf;

use crate::ReadFileError;

/// Why a mesh file is refused; each message is one line with path, place, problem and remedy.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LoadError {
    /// The file, or a buffer beside it, is not read.
    #[error(transparent)]
    File(#[from] ReadFileError),
    /// The file has no bytes.
    #[error("{}: the file is empty; export the mesh again", path.display())]
    Empty {
        /// The path as given.
        path: PathBuf,
    },
    /// The file name's extension is none that is known.
    #[error("{}: unknown mesh format; name a file that ends in .obj, .gltf, .glb, .ply or .stl", path.display())]
    UnknownFormat {
        /// The path as given.
        path: PathBuf,
    },
    /// The format is known, and its loader is left out of this build.
    #[error("{}: the loader of this format is not built in; enable the cargo feature `{feature}` of contrejour-mesh", path.display())]
    FormatDisabled {
        /// The path as given.
        path: PathBuf,
        /// The cargo feature that brings the loader.
        feature: &'static str,
    },
    /// A part of the file does not follow the format.
    #[error("{}: {place}: {problem}", path.display())]
    Malformed {
        /// The path as given.
        path: PathBuf,
        /// Line, node, mesh or chunk.
        place: String,
        /// What is wrong and what to do.
        problem: String,
    },
    /// A coordinate is NaN, infinite, or too large for 32 bits.
    #[error("{}: {place}: a coordinate is not a finite 32-bit number; correct it or delete the vertex and its faces", path.display())]
    NotFinite {
        /// The path as given.
        path: PathBuf,
        /// Line, or node, mesh, primitive and vertex.
        place: String,
    },
    /// A face names a vertex that does not exist.
    #[error("{}: {place}: names {what} {index}, and there are {count}; correct the index or add what is missing", path.display())]
    IndexOutOfRange {
        /// The path as given.
        path: PathBuf,
        /// Line, or mesh and primitive.
        place: String,
        /// What the index counts: `vertex`, `normal`, `joint`, `element` or `accessor`.
        what: &'static str,
        /// The index as the file has it.
        index: i64,
        /// How many there are.
        count: usize,
    },
    /// The file claims more data than it has.
    #[error("{}: {place}: needs {needed} bytes, and there are {available}; the file is cut off or its lengths are wrong: export it again", path.display())]
    BeyondData {
        /// The path as given.
        path: PathBuf,
        /// Buffer, buffer view or accessor.
        place: String,
        /// Bytes that the file claims.
        needed: u64,
        /// Bytes that are there.
        available: u64,
    },
    /// A glTF file cannot be read without an extension that is not supported.
    #[error("{}: requires the glTF extension {extension:?}, which is not supported; export again without it (for compression: as plain buffers)", path.display())]
    UnsupportedExtension {
        /// The path as given.
        path: PathBuf,
        /// Name of the extension.
        extension: String,
    },
    /// A glTF node has two parents or is its own ancestor.
    #[error("{}: node {node} is reached twice in the scene; nodes must form a tree: remove one of its parents", path.display())]
    NodeReachedTwice {
        /// The path as given.
        path: PathBuf,
        /// Index of the node.
        node: usize,
    },
    /// A glTF file uses its data so often, or counts so many zeros, that it is too much for its size.
    #[error("{}: {place}: by here there are more than {most} numbers, too many for a file of this size; correct its counts, give fewer nodes a mesh, or split the file", path.display())]
    TooManyNumbers {
        /// The path as given.
        path: PathBuf,
        /// Where the limit is passed: accessor, node or skin.
        place: String,
        /// The most numbers that a file of this size may bring.
        most: u64,
    },
    /// More vertices than 32-bit indices can name.
    #[error("{}: has more than 4294967295 vertices; split the file", path.display())]
    TooManyVertices {
        /// The path as given.
        path: PathBuf,
    },
}
