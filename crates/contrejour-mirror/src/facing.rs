//! The input of the facing test, as bits: the twin of `shared/facing.wgsl`.

use contrejour_layout::{Caster, CasterLight, Face};

/// Three coordinates, as the bits of `f32` numbers.
pub(crate) type Bits3 = [u32; 3];

/// Spans up to this length are for `refine_faces`: differences of such coordinates are below 2^62.
pub(crate) const NEAR_SPAN: u32 = 61;

/// A face is lit when `det(b - a, c - a, light - light_origin) > 0`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FacingBits {
    pub a: Bits3,
    pub b: Bits3,
    pub c: Bits3,
    pub light: Bits3,
    /// `a` for a point, zero for a direction.
    pub light_origin: Bits3,
}

impl FacingBits {
    /// Reads a face. A mirrored caster exchanges b and c, which changes the sign of the determinant and nothing else.
    pub fn read(caster: &Caster, caster_light: &CasterLight, face: Face, positions: &[u32]) -> Self {
        let position = |vertex: u32| {
            let word = (caster.first_position_word + vertex * caster.position_stride_words) as usize;
            [positions[word], positions[word + 1], positions[word + 2]]
        };
        let a = position(face.a);
        let (b, c) = match caster_light.mirrored {
            0 => (position(face.b), position(face.c)),
            _ => (position(face.c), position(face.b)),
        };
        let [x, y, z, w] = caster_light.light_object;
        let is_point = w << 1 != 0;
        Self { a, b, c, light: [x, y, z], light_origin: if is_point { a } else { [0; 3] } }
    }

    /// The edges `b - a` and `c - a` share one grid.
    pub fn edge_span(&self) -> GridSpan {
        GridSpan::of([self.a, self.b, self.c].as_flattened())
    }

    /// The vector to the light has a grid of its own: its scale does not change the determinant's sign.
    pub fn light_span(&self) -> GridSpan {
        GridSpan::of([self.light, self.light_origin].as_flattened())
    }
}

/// The grid bits that some coordinates use: from the lowest set one to before `end`. Empty when all are zero.
///
/// Every finite `f32` is a multiple of 2^-149, the smallest one. Grid bit n stands for 2^(n - 149).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct GridSpan {
    pub begin: u32,
    pub end: u32,
}

impl GridSpan {
    fn of(coordinates: &[u32]) -> Self {
        let mut span = Self { begin: 512, end: 0 };
        for &bits in coordinates {
            let mantissa = mantissa(bits);
            if mantissa != 0 {
                span.begin = span.begin.min(grid_shift(bits) + mantissa.trailing_zeros());
                span.end = span.end.max(grid_shift(bits) + 32 - mantissa.leading_zeros());
            }
        }
        span
    }

    pub fn length(self) -> u32 {
        self.end.saturating_sub(self.begin)
    }
}

/// The 24 bits of the mantissa, the hidden one included.
pub(crate) fn mantissa(bits: u32) -> u32 {
    let hidden = if bits & 0x7f80_0000 != 0 { 1 << 23 } else { 0 };
    bits & 0x7f_ffff | hidden
}

/// The grid bit on which the mantissa's lowest bit lies.
pub(crate) fn grid_shift(bits: u32) -> u32 {
    (bits >> 23 & 0xff).max(1) - 1
}

pub(crate) fn is_negative(bits: u32) -> bool {
    bits >> 31 != 0
}
