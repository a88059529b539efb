//! The bytes that accessors look into: binary chunk, data URIs, files beside the glTF file.

use std::borrow::Cow;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use gltf::Document;
use gltf::buffer::Source;

use crate::LoadError;
use crate::load::ReadFile;

/// The buffers of a file.
pub(super) struct Buffers<'a> {
    /// Contents of each, at least as long as the document says. Those that name the same file share it.
    pub(super) contents: Vec<Rc<Cow<'a, [u8]>>>,
    /// Bytes of all contents together.
    pub(super) byte_count: u64,
}

pub(super) fn read_buffers<'a>(
    document: &Document,
    binary_chunk: Option<Cow<'a, [u8]>>,
    path: &Path,
    read_beside: &ReadFile,
) -> Result<Buffers<'a>, LoadError> {
    let mut binary_chunk = binary_chunk;
    let mut buffers = Buffers { contents: Vec::new(), byte_count: 0 };
    let mut contents_of_files: HashMap<PathBuf, Rc<Cow<[u8]>>> = HashMap::new();
    for buffer in document.buffers() {
        let place = || format!("buffer {}", buffer.index());
        let malformed =
            |problem: &str| LoadError::Malformed { path: path.into(), place: place(), problem: problem.into() };
        let mut added = |bytes: Cow<'a, [u8]>| {
            buffers.byte_count += bytes.len() as u64;
            Rc::new(bytes)
        };
        let bytes =
            match buffer.source() {
                Source::Bin => added(binary_chunk.take().ok_or_else(|| {
                    malformed("has no uri, and the file no binary chunk for it; export the file again")
                })?),
                Source::Uri(uri) => match uri.strip_prefix("data:") {
                    Some(data) => added(Cow::Owned(
                        data_uri_bytes(data)
                            .ok_or_else(|| malformed("its data URI cannot be decoded; export the file again"))?,
                    )),
                    None if uri.contains("://") => {
                        return Err(malformed("is on the network; download it and name the file"));
                    }
                    None => {
                        let file = beside(path, uri);
                        if file.to_string_lossy().contains(char::is_control) {
                            return Err(malformed("its uri has a control character; rename the file"));
                        }
                        match contents_of_files.get(&file) {
                            Some(bytes) => Rc::clone(bytes),
                            None => {
                                let bytes = added(Cow::Owned(read_beside(&file)?));
                                contents_of_files.insert(file, Rc::clone(&bytes));
                                bytes
                            }
                        }
                    }
                },
            };
        if (bytes.len() as u64) < buffer.length() as u64 {
            return Err(LoadError::BeyondData {
                path: path.into(),
                place: place(),
                needed: buffer.length() as u64,
                available: bytes.len() as u64,
            });
        }
        buffers.contents.push(bytes);
    }
    Ok(buffers)
}

/// The file that a relative URI names.
pub(super) fn beside(path: &Path, uri: &str) -> PathBuf {
    let name = percent_decoded(uri);
    let name = String::from_utf8_lossy(&name);
    path.parent().unwrap_or(Path::new("")).join(&*name)
}

/// Bytes of a data URI without its `data:` (RFC 2397).
pub(super) fn data_uri_bytes(data: &str) -> Option<Vec<u8>> {
    let (kind, content) = data.split_once(',')?;
    let content = percent_decoded(content);
    if kind.ends_with(";base64") { base64_decoded(&content) } else { Some(content) }
}

/// `%41` becomes `A` (RFC 3986, 2.1); a `%` without two digits stays.
fn percent_decoded(text: &str) -> Vec<u8> {
    let mut decoded = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((&byte, after)) = rest.split_first() {
        let digits = after.first_chunk::<2>().filter(|_| byte == b'%');
        let value = digits
            .and_then(|digits| str::from_utf8(digits).ok())
            .and_then(|digits| u8::from_str_radix(digits, 16).ok());
        decoded.push(value.unwrap_or(byte));
        rest = if value.is_some() { &after[2..] } else { after };
    }
    decoded
}

/// Bytes of a base64 text (RFC 4648, 4), with or without padding at its end; `None` for other characters.
fn base64_decoded(text: &[u8]) -> Option<Vec<u8>> {
    let mut decoded = Vec::with_capacity(text.len() / 4 * 3 + 3);
    let (mut bits, mut bit_count) = (0_u32, 0);
    for &byte in text.trim_ascii_end() {
        let digit = match byte {
            b'A'..=b'Z' => byte - b'A',
            b'a'..=b'z' => byte - b'a' + 26,
            b'0'..=b'9' => byte - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            b'=' => break,
            _ => return None,
        };
        bits = (bits << 6) | u32::from(digit);
        bit_count += 6;
        if bit_count >= 8 {
            bit_count -= 8;
            decoded.push((bits >> bit_count) as u8);
        }
    }
    Some(decoded)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_of_the_rfc() {
        for (text, bytes) in [("", ""), ("Zg==", "f"), ("Zm8=", "fo"), ("Zm9vYmE", "fooba"), ("Zm9vYmFy", "foobar")] {
            assert_eq!(base64_decoded(text.as_bytes()).as_deref(), Some(bytes.as_bytes()));
        }
        assert_eq!(base64_decoded(b"Zm9v*"), None);
    }

    #[test]
    fn percent_signs() {
        assert_eq!(percent_decoded("a%20b%C3%A9%"), "a b\u{e9}%".as_bytes());
        assert_eq!(percent_decoded("100%zz"), b"100%zz");
    }
}
