//! Why there is no plan.

use super::BufferKind;
use crate::SettingsError;

/// Why a frame can't be planned.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The shadow settings are out of range.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// A caster names a mesh that the scene does not have.
    #[error("caster {caster} names mesh {mesh} of {meshes}: give an index below the number of meshes")]
    UnknownMesh {
        /// Index of the caster.
        caster: usize,
        /// The mesh that it names.
        mesh: usize,
        /// Meshes that there are.
        meshes: usize,
    },
    /// The maps are larger than the device's textures.
    #[error("the map size is {map_size} texels and the device allows {limit}: choose a smaller map")]
    MapTooLarge {
        /// Texels along a side.
        map_size: u32,
        /// The device's `max_texture_dimension_2d`.
        limit: u32,
    },
    /// A buffer is larger than the device allows.
    #[error(
        "buffer {} needs {needed} bytes and the device's {limit_name} is {limit}: request the device with a larger \
         {limit_name}, or give casters with {}",
        buffer.name(),
        less(*buffer)
    )]
    BufferTooLarge {
        /// Which buffer.
        buffer: BufferKind,
        /// Its size in bytes.
        needed: u64,
        /// What the device allows, in bytes.
        limit: u64,
        /// Name of the device's limit.
        limit_name: &'static str,
    },
    /// A list has more records than 32 bits can count.
    #[error("buffer {} needs {needed} records and shaders count to 4294967295: give casters with fewer faces", buffer.name())]
    TooManyRecords {
        /// Which buffer.
        buffer: BufferKind,
        /// Records that are needed.
        needed: u64,
    },
}

/// What a smaller buffer asks of casters.
fn less(buffer: BufferKind) -> &'static str {
    if buffer == BufferKind::MaskWords { "smaller pictures in their masks" } else { "fewer faces" }
}
