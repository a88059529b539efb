//! Reading accessors with every length checked first (the gltf crate's own readers trust the file).

use std::cell::Cell;
use std::path::Path;

use gltf::Accessor;
use gltf::accessor::DataType;
use gltf::buffer::View;

use super::buffers::Buffers;
use crate::LoadError;

/// Numbers that a file may bring for each of its bytes. A node of a few bytes can repeat a mesh of any size, and an
/// accessor without a buffer view is zeros of any number.
const NUMBERS_PER_BYTE: u64 = 256;

/// Numbers that any file may bring by repeating what it has: 11 million triangles of an ordinary mesh.
const MOST_REPEATED: u64 = 1 << 26;

/// How integers become numbers.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Integers {
    /// As the accessor's `normalized` says.
    AsDeclared,
    /// Always 0..1 or -1..1, as for colours and weights, whose exporters forget to say so.
    Normalized,
}

/// Bytes of all buffers, the path for messages, and how much has been made of them.
pub(super) struct Data<'a> {
    buffers: Buffers<'a>,
    pub(super) path: &'a Path,
    most_numbers: u64,
    numbers: Cell<u64>,
}

impl<'a> Data<'a> {
    /// The data of a file of so many bytes, buffers beside it not counted.
    pub(super) fn new(buffers: Buffers<'a>, path: &'a Path, file_bytes: usize) -> Self {
        let bytes = file_bytes as u64 + buffers.byte_count;
        let most_numbers = bytes + (NUMBERS_PER_BYTE * bytes).min(MOST_REPEATED);
        Self { buffers, path, most_numbers, numbers: Cell::new(0) }
    }

    /// Counts what a place of the file brings, so that memory and time follow the size of the file.
    pub(super) fn count_numbers(&self, numbers: u64, place: impl Fn() -> String) -> Result<(), LoadError> {
        self.numbers.set(self.numbers.get().saturating_add(numbers));
        if self.numbers.get() > self.most_numbers {
            return Err(LoadError::TooManyNumbers { path: self.path.into(), place: place(), most: self.most_numbers });
        }
        Ok(())
    }

    /// All elements of an accessor of `N` components; `f64` holds all component types exactly.
    pub(super) fn read<const N: usize>(
        &self,
        accessor: &Accessor,
        integers: Integers,
    ) -> Result<Vec<[f64; N]>, LoadError> {
        let place = || format!("accessor {}", accessor.index());
        if accessor.dimensions().multiplicity() != N {
            return Err(self.malformed(place(), "has the wrong number of components; export the file again"));
        }
        let data_type = accessor.data_type();
        let size = N * data_type.size();
        let is_normalized = integers == Integers::Normalized || accessor.normalized();
        let count = accessor.count();
        let numbers_of = |count: usize| (count as u64).saturating_mul(N as u64);
        let mut elements = match accessor.view() {
            Some(view) => {
                let stride = view.stride().unwrap_or(size);
                let bytes = self.slice(&view, accessor.offset(), stride, size, count, place)?;
                self.count_numbers(numbers_of(count), place)?;
                (0..count).map(|index| element(&bytes[index * stride..], data_type, is_normalized)).collect()
            }
            None => {
                self.count_numbers(numbers_of(count), place)?;
                vec![[0.0; N]; count]
            }
        };
        if let Some(sparse) = accessor.sparse() {
            let place = || format!("accessor {}, sparse", accessor.index());
            let (indices, values) = (sparse.indices(), sparse.values());
            let index_type = match indices.index_type() {
                gltf::accessor::sparse::IndexType::U8 => DataType::U8,
                gltf::accessor::sparse::IndexType::U16 => DataType::U16,
                gltf::accessor::sparse::IndexType::U32 => DataType::U32,
            };
            let index_size = index_type.size();
            let index_bytes =
                self.slice(&indices.view(), indices.offset(), index_size, index_size, sparse.count(), place)?;
            let value_bytes = self.slice(&values.view(), values.offset(), size, size, sparse.count(), place)?;
            self.count_numbers(numbers_of(sparse.count()), place)?;
            for nth in 0..sparse.count() {
                let [index] = element(&index_bytes[nth * index_size..], index_type, false);
                let target = elements.get_mut(index as usize).ok_or_else(|| LoadError::IndexOutOfRange {
                    path: self.path.into(),
                    place: place(),
                    what: "element",
                    index: index as i64,
                    count,
                })?;
                *target = element(&value_bytes[nth * size..], data_type, is_normalized);
            }
        }
        Ok(elements)
    }

    /// Like [`Self::read`], for an attribute that must have one element for each of `count` vertices.
    pub(super) fn read_attribute<const N: usize>(
        &self,
        accessor: &Accessor,
        integers: Integers,
        count: usize,
    ) -> Result<Vec<[f64; N]>, LoadError> {
        if accessor.count() != count {
            let place = format!("accessor {}", accessor.index());
            return Err(self.malformed(place, "has another length than the positions; export the file again"));
        }
        self.read(accessor, integers)
    }

    /// The bytes of a view. They are counted, since many images can name one view.
    pub(super) fn view_bytes(&self, view: &View, place: impl Fn() -> String) -> Result<&[u8], LoadError> {
        self.count_numbers(view.length() as u64, &place)?;
        self.slice(view, 0, 1, 1, view.length(), place)
    }

    /// `count` elements of `size` bytes in a view, after checking that view and elements are there.
    fn slice(
        &self,
        view: &View,
        offset: usize,
        stride: usize,
        size: usize,
        count: usize,
        place: impl Fn() -> String,
    ) -> Result<&[u8], LoadError> {
        let beyond = |needed: u64, available: usize| LoadError::BeyondData {
            path: self.path.into(),
            place: place(),
            needed,
            available: available as u64,
        };
        if stride < size {
            return Err(
                self.malformed(place(), "has elements that overlap (byteStride too small); export the file again")
            );
        }
        let buffer = &self.buffers.contents[view.buffer().index()];
        let view_end = (view.offset() as u64).saturating_add(view.length() as u64);
        if view_end > buffer.len() as u64 {
            return Err(beyond(view_end, buffer.len()));
        }
        let of_elements = match count {
            0 => 0,
            _ => (stride as u64).saturating_mul(count as u64 - 1).saturating_add(size as u64),
        };
        let end = (offset as u64).saturating_add(of_elements);
        if end > view.length() as u64 {
            return Err(beyond(end, view.length()));
        }
        Ok(&buffer[view.offset() + offset..view.offset() + offset + of_elements as usize])
    }

    pub(super) fn malformed(&self, place: String, problem: &str) -> LoadError {
        LoadError::Malformed { path: self.path.into(), place, problem: problem.into() }
    }
}

/// The first element in `bytes`, which hold it whole.
fn element<const N: usize>(bytes: &[u8], data_type: DataType, is_normalized: bool) -> [f64; N] {
    let mut components = [0.0; N];
    let sizes = bytes.chunks_exact(data_type.size());
    for (component, bytes) in components.iter_mut().zip(sizes) {
        let mut word = [0; 4];
        word[..bytes.len()].copy_from_slice(bytes);
        let [a, b, ..] = word;
        let (number, one) = match data_type {
            DataType::I8 => (f64::from(a as i8), 127.0),
            DataType::U8 => (f64::from(a), 255.0),
            DataType::I16 => (f64::from(i16::from_le_bytes([a, b])), 32_767.0),
            DataType::U16 => (f64::from(u16::from_le_bytes([a, b])), 65_535.0),
            DataType::U32 => (f64::from(u32::from_le_bytes(word)), 1.0),
            DataType::F32 => (f64::from(f32::from_le_bytes(word)), 1.0),
        };
        *component = if is_normalized && one > 1.0 { (number / one).max(-1.0) } else { number };
    }
    components
}
