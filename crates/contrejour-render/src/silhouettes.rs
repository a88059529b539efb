//! Silhouettes alone: found on the device, read back for tools.

use contrejour_gpu::{CountersError, Shadows, Untimed};
use contrejour_layout::{Counters, SilhouetteEdge};
use contrejour_plan::BufferKind;

use crate::Gpu;
use crate::casters::PrepareShadowsError;
use crate::error::{DrawError, MAX_REPEATS};
use crate::readback::{ReadError, read_buffer};

/// Finds silhouette edges for the last view of the last light, sorted by caster and edge: runs frames until the lists held
/// everything, and waits for each.
///
/// # Errors
///
/// [`DrawError`] when the device does not allow the frame or fails.
pub fn find_silhouettes(gpu: &Gpu, shadows: &mut Shadows) -> Result<Vec<SilhouetteEdge>, DrawError> {
    for _ in 0..MAX_REPEATS {
        // Else only lights whose lists were too short would run again, and the last view would be one of theirs.
        shadows.redraw();
        shadows.prepare(&gpu.device, &gpu.queue).map_err(PrepareShadowsError::from)?;
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        shadows.encode(&mut encoder, &mut Untimed);
        gpu.queue.submit([encoder.finish()]);
        if had_room(gpu, shadows)? {
            let pages = shadows.buffers(BufferKind::Counters).zip(shadows.buffers(BufferKind::Silhouettes));
            return Ok(read_pages(gpu, pages)?);
        }
    }
    Err(DrawError::Incomplete)
}

/// Waits for the submitted frames; returns whether the last one had room for everything.
///
/// # Errors
///
/// The device was lost, or a frame was encoded and not submitted.
pub fn had_room(gpu: &Gpu, shadows: &mut Shadows) -> Result<bool, CountersError> {
    match shadows.wait_for_counters(&gpu.device) {
        Ok(_) => Ok(shadows.is_complete()),
        // Frames without silhouettes count nothing and miss nothing.
        Err(CountersError::NoFrame) => Ok(true),
        Err(error) => Err(error),
    }
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
