//! Positions that callers own: how they lie, and their copies into the pool.

use crate::casters::{CasterInput, Casters, Positions};
use crate::error::CasterError;
use crate::pool::PooledMesh;

/// Positions that are copied from a buffer of the caller's.
#[derive(Clone, Debug)]
pub(crate) struct LivePositions {
    buffer: wgpu::Buffer,
    offset: u64,
    vertex_count: u32,
    pub stride_words: u32,
    /// Where they lie among all positions.
    pub first_word: u64,
}

/// A copy of a caller's positions into the pool.
#[derive(Clone, Debug)]
pub(crate) struct LiveCopy {
    pub source: wgpu::Buffer,
    pub source_offset: u64,
    pub target_offset: u64,
    pub size: u64,
}

impl LivePositions {
    /// Words from the first position's start to the last one's end.
    pub fn words(&self) -> u64 {
        match self.vertex_count {
            0 => 0,
            count => u64::from(count - 1) * u64::from(self.stride_words) + 3,
        }
    }
}

/// Where a caster brings its own positions: checks the buffer and says how they lie.
pub(crate) fn live_positions(input: &CasterInput, mesh: &PooledMesh) -> Result<Option<LivePositions>, CasterError> {
    let Positions::InBuffer { buffer, offset, stride } = &input.positions else { return Ok(None) };
    let (offset, stride) = (*offset, *stride);
    let is_aligned =
        offset.is_multiple_of(4) && stride.is_multiple_of(4) && stride >= 12 && stride <= u64::from(u32::MAX);
    let vertex_count = mesh.topology.positions.len() as u32;
    let stride_words = (stride / 4) as u32;
    let live = LivePositions { buffer: buffer.clone(), offset, vertex_count, stride_words, first_word: 0 };
    let needed = offset.saturating_add(4 * live.words());
    let available = buffer.size();
    let can_copy = buffer.usage().contains(wgpu::BufferUsages::COPY_SRC);
    if is_aligned && can_copy && needed <= available {
        return Ok(Some(live));
    }
    Err(CasterError::Positions { needed, available, offset, stride })
}

impl Casters {
    /// Copies of all positions that are the caller's. What lies side by side both there and in the pool is one copy, so
    /// those of a deformer are few.
    pub fn live_copies(&self) -> Vec<LiveCopy> {
        let mut copies: Vec<LiveCopy> = Vec::new();
        for live in self.slots.iter().filter_map(|(_, caster)| caster.live.as_ref()) {
            let copy = LiveCopy {
                source: live.buffer.clone(),
                source_offset: live.offset,
                target_offset: 4 * live.first_word,
                size: 4 * live.words(),
            };
            match copies.last_mut() {
                Some(last) if last.is_continued_by(&copy) => last.size += copy.size,
                _ if copy.size == 0 => {}
                _ => copies.push(copy),
            }
        }
        copies
    }
}

impl LiveCopy {
    fn is_continued_by(&self, next: &Self) -> bool {
        self.source == next.source
            && self.source_offset + self.size == next.source_offset
            && self.target_offset + self.size == next.target_offset
    }
}
