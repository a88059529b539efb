//! Silhouettes alone: found on the device, read back for tools.

use contrejour_gpu::Shadows;
use contrejour_layout::{Counters, SilhouetteEdge};
use contrejour_plan::BufferKind;

use crate::Gpu;
use crate::readback::{ReadError, read_buffer};

/// Reads the silhouette edges of the last frame, sorted by caster and edge; waits for them.
///
/// # Errors
///
/// [`ReadError`] when the device fails.
pub fn read_silhouettes(gpu: &Gpu, shadows: &Shadows) -> Result<Vec<SilhouetteEdge>, ReadError> {
    let pages = shadows.buffers(BufferKind::Counters).zip(shadows.buffers(BufferKind::Silhouettes));
    read_pages(gpu, pages)
}

/// Reads the edges of lists that lie beside their counters, sorted; an edge that is in several of them comes several times.
pub(crate) fn read_pages<'a>(
    gpu: &Gpu,
    pages: impl Iterator<Item = (wgpu::BufferSlice<'a>, wgpu::BufferSlice<'a>)>,
) -> Result<Vec<SilhouetteEdge>, ReadError> {
    let mut edges = Vec::new();
    for (counters, silhouettes) in pages {
        let counters: Counters =
            bytemuck::pod_read_unaligned(&read_buffer(gpu, counters, size_of::<Counters>() as u64)?);
        let bytes = u64::from(counters.silhouette_edges) * size_of::<SilhouetteEdge>() as u64;
        let page: Vec<SilhouetteEdge> =
            bytemuck::pod_collect_to_vec(&read_buffer(gpu, silhouettes, bytes.min(silhouettes.size()))?);
        edges.extend(page);
    }
    edges.sort_unstable_by_key(|edge| (edge.caster, edge.edge_id));
    Ok(edges)
}
