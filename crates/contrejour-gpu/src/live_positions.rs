//! Positions that callers own: how they lie, and their copies into the pool.

use crate::casters::{CasterInput, Casters, KnownPositions, Positions};
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
    known: Option<KnownPositions>,
    /// Whether those in the pool are the ones that are known.
    is_copied: bool,
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

    /// Whether they may be others in each frame, and nobody knows.
    pub fn are_unknown(&self) -> bool {
        self.known.is_none()
    }

    /// A box that holds them.
    pub fn bounds(&self) -> Option<[[f32; 3]; 2]> {
        self.known.map(|known| known.bounds)
    }

    /// Takes over what is known of them; says whether that is something else than before.
    ///
    /// # Errors
    ///
    /// The box is none.
    pub fn take_over(&mut self, known: &KnownPositions) -> Result<bool, CasterError> {
        check_bounds(known)?;
        if self.known == Some(*known) {
            return Ok(false);
        }
        (self.known, self.is_copied) = (Some(*known), false);
        Ok(true)
    }
}

fn check_bounds(KnownPositions { bounds: [min, max], .. }: &KnownPositions) -> Result<(), CasterError> {
    // NaN is not in order.
    let is_box = (0..3).all(|axis| min[axis] <= max[axis] && min[axis].is_finite() && max[axis].is_finite());
    if is_box { Ok(()) } else { Err(CasterError::Bounds { min: *min, max: *max }) }
}

/// Where a caster brings its own positions: checks the buffer and says how they lie.
pub(crate) fn live_positions(input: &CasterInput, mesh: &PooledMesh) -> Result<Option<LivePositions>, CasterError> {
    let Positions::InBuffer { buffer, offset, stride, known } = &input.positions else { return Ok(None) };
    let (offset, stride, known) = (*offset, *stride, *known);
    known.as_ref().map_or(Ok(()), check_bounds)?;
    let is_aligned =
        offset.is_multiple_of(4) && stride.is_multiple_of(4) && stride >= 12 && stride <= u64::from(u32::MAX);
    let vertex_count = mesh.topology.positions.len() as u32;
    let stride_words = (stride / 4) as u32;
    let buffer = buffer.clone();
    let live = LivePositions { buffer, offset, vertex_count, stride_words, first_word: 0, known, is_copied: false };
    let needed = offset.saturating_add(4 * live.words());
    let available = live.buffer.size();
    let can_copy = live.buffer.usage().contains(wgpu::BufferUsages::COPY_SRC);
    if is_aligned && can_copy && needed <= available {
        return Ok(Some(live));
    }
    Err(CasterError::Positions { needed, available, offset, stride })
}

impl Casters {
    /// Copies of positions that are the caller's, where those in the pool may be others, for a frame that makes them. What
    /// lies side by side both there and in the pool is one copy, so those of a deformer are few.
    pub fn take_live_copies(&mut self) -> Vec<LiveCopy> {
        let mut copies: Vec<LiveCopy> = Vec::new();
        for &slot in &self.live {
            let Some(live) = self.slots.at_mut(slot).and_then(|caster| caster.live.as_mut()) else { continue };
            if std::mem::replace(&mut live.is_copied, live.known.is_some()) {
                continue;
            }
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

    /// Lets all of the caller's positions be copied again.
    pub fn copy_all(&mut self) {
        let live = self.slots.iter_mut().filter_map(|(_, caster)| caster.live.as_mut());
        live.for_each(|live| live.is_copied = false);
    }
}

impl LiveCopy {
    fn is_continued_by(&self, next: &Self) -> bool {
        self.source == next.source
            && self.source_offset + self.size == next.source_offset
            && self.target_offset + self.size == next.target_offset
    }
}
