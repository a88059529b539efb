//! The numbers after a PLY header, one after the other, whatever their encoding.

use super::header::{Encoding, Header, Scalar};

/// Reads numbers; all types of the format fit into `f64` exactly.
pub(super) struct Values<'a> {
    encoding: Encoding,
    rest: &'a [u8],
    /// Line of the next number, from 1; only lines of text files count.
    line: usize,
}

impl<'a> Values<'a> {
    pub(super) fn new(bytes: &'a [u8], header: &Header) -> Self {
        Self { encoding: header.encoding, rest: &bytes[header.body_start..], line: header.body_line }
    }

    /// Bytes that are left.
    pub(super) fn remaining(&self) -> u64 {
        self.rest.len() as u64
    }

    /// Where a reader finds the number that was read last, or failed.
    pub(super) fn place(&self, element: &str, row: u64) -> String {
        match self.encoding {
            Encoding::Ascii => format!("line {}", self.line),
            _ => format!("{element} {row}"),
        }
    }

    /// The next number; the error says what is wrong and what to do.
    pub(super) fn next(&mut self, scalar: Scalar) -> Result<f64, &'static str> {
        if self.encoding == Encoding::Ascii {
            return self.next_word(scalar);
        }
        let (bytes, rest) =
            self.rest.split_at_checked(scalar.byte_count()).ok_or("the file ends too early; export it again")?;
        self.rest = rest;
        let mut little_endian = [0; 8];
        little_endian[..bytes.len()].copy_from_slice(bytes);
        if self.encoding == Encoding::BigEndian {
            little_endian[..bytes.len()].reverse();
        }
        let [a, b, c, d, ..] = little_endian;
        Ok(match scalar {
            Scalar::I8 => f64::from(a as i8),
            Scalar::U8 => f64::from(a),
            Scalar::I16 => f64::from(i16::from_le_bytes([a, b])),
            Scalar::U16 => f64::from(u16::from_le_bytes([a, b])),
            Scalar::I32 => f64::from(i32::from_le_bytes([a, b, c, d])),
            Scalar::U32 => f64::from(u32::from_le_bytes([a, b, c, d])),
            Scalar::F32 => f64::from(f32::from_le_bytes([a, b, c, d])),
            Scalar::F64 => f64::from_le_bytes(little_endian),
        })
    }

    fn next_word(&mut self, scalar: Scalar) -> Result<f64, &'static str> {
        let start = self.rest.iter().position(|byte| !byte.is_ascii_whitespace());
        let (blank, rest) = self.rest.split_at(start.unwrap_or(self.rest.len()));
        self.line += blank.iter().filter(|&&byte| byte == b'\n').count();
        let end = rest.iter().position(u8::is_ascii_whitespace);
        let (word, rest) = rest.split_at(end.unwrap_or(rest.len()));
        self.rest = rest;
        if word.is_empty() {
            return Err("the file ends too early; export it again");
        }
        let word = str::from_utf8(word).unwrap_or("");
        let number = match scalar {
            // Straight to 32 bits: rounding to 64 bits first can end one step away.
            Scalar::F32 => word.parse::<f32>().map(f64::from),
            _ => word.parse::<f64>(),
        };
        number.map_err(|_| "a word is no number; write numbers like -1.5e3")
    }
}
