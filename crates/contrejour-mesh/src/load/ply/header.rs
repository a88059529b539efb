//! The header of a PLY file: which elements follow, in which form.

/// How the numbers after the header are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    BigEndian,
    LittleEndian,
}

/// Type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn named(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    pub(super) fn byte_count(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// What stands for 1 in a colour of this type.
    pub(super) fn color_one(self) -> f64 {
        match self {
            Self::I8 => 127.0,
            Self::U8 => 255.0,
            Self::I16 => 32_767.0,
            Self::U16 => 65_535.0,
            Self::I32 => f64::from(i32::MAX),
            Self::U32 => f64::from(u32::MAX),
            Self::F32 | Self::F64 => 1.0,
        }
    }
}

/// One property of an element: a number, or a list with the type of its length.
#[derive(Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) length: Option<Scalar>,
    pub(super) value: Scalar,
}

/// A table of the file.
#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

impl Element {
    /// Bytes that all rows need at least.
    pub(super) fn least_bytes(&self, encoding: Encoding) -> u64 {
        let of_property = |property: &Property| match encoding {
            // A digit and the white space after it, which the last one may lack.
            Encoding::Ascii => 1,
            _ => property.length.unwrap_or(property.value).byte_count() as u64,
        };
        let of_row: u64 = self.properties.iter().map(of_property).sum();
        of_row.saturating_mul(self.count)
    }
}

#[derive(Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Where the numbers start: byte in the file, and line from 1.
    pub(super) body_start: usize,
    pub(super) body_line: usize,
}

/// A problem with the line, from 1, where it is.
pub(super) type HeaderError = (usize, &'static str);

const ENCODINGS: &str = "unknown encoding; use ascii, binary_little_endian or binary_big_endian";
const NO_COUNT: &str = "the number of elements is no number; correct it";
const NO_ELEMENT: &str = "a property stands before the first element; put it after its element";
const NO_PROPERTY: &str = "no property; write property TYPE NAME or property list TYPE TYPE NAME";
const NO_END: &str = "the header has no end_header; export the file again";

impl Header {
    pub(super) fn read(bytes: &[u8]) -> Result<Self, HeaderError> {
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        let mut start = 0;
        for line in 1.. {
            let rest = &bytes[start..];
            let end = rest.iter().position(|&byte| byte == b'\n' || byte == b'\r').ok_or((line, NO_END))?;
            start += end + 1;
            if rest[end..].starts_with(b"\r\n") {
                start += 1;
            }
            let content = str::from_utf8(&rest[..end]).unwrap_or("comment");
            let words: Vec<&str> = content.split_whitespace().collect();
            match words[..] {
                ["ply"] if line == 1 => {}
                _ if line == 1 => return Err((1, "does not start with ply; is it a PLY file?")),
                [] | ["comment" | "obj_info", ..] => {}
                ["format", name, _] => encoding = Some(encoding_named(name).ok_or((line, ENCODINGS))?),
                ["element", name, count] => elements.push(Element {
                    name: name.to_owned(),
                    count: count.parse().map_err(|_| (line, NO_COUNT))?,
                    properties: Vec::new(),
                }),
                ["property", ref of_property @ ..] => {
                    let element = elements.last_mut().ok_or((line, NO_ELEMENT))?;
                    let property = property(of_property).ok_or((line, NO_PROPERTY))?;
                    element.properties.push(property);
                }
                ["end_header"] => {
                    return Ok(Self {
                        encoding: encoding.ok_or((line, "the header has no format line; add one"))?,
                        elements,
                        body_start: start,
                        body_line: line + 1,
                    });
                }
                _ => return Err((line, "no line of a PLY header; correct or delete it")),
            }
        }
        Err((0, NO_END))
    }
}

fn encoding_named(name: &str) -> Option<Encoding> {
    Some(match name {
        "ascii" => Encoding::Ascii,
        "binary_big_endian" => Encoding::BigEndian,
        "binary_little_endian" => Encoding::LittleEndian,
        _ => return None,
    })
}

fn property(words: &[&str]) -> Option<Property> {
    let (length, value, name) = match *words {
        ["list", length, value, name] => (Some(Scalar::named(length)?), value, name),
        [value, name] => (None, value, name),
        _ => return None,
    };
    Some(Property { name: name.to_owned(), length, value: Scalar::named(value)? })
}
