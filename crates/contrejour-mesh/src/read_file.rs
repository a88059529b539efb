//! Files as a whole, whatever the path turns out to name.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// Why a file is not read; each message is one line with path, problem and remedy.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadFileError {
    /// The file is missing or may not be read, or memory has no room for it.
    #[error("{}: cannot be read ({source}); check the path, the permissions and the free memory", path.display())]
    System {
        /// The path as given.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The path names a directory.
    #[error("{}: is a directory; name a file in it", path.display())]
    Directory {
        /// The path as given.
        path: PathBuf,
    },
    /// The path names a pipe, a socket or a device.
    #[error("{}: is no regular file; write what it gives to a file first, and name that", path.display())]
    NotAFile {
        /// The path as given.
        path: PathBuf,
    },
    /// The file has more bytes than are read.
    #[error("{}: has {bytes} bytes, and at most {most} are read; split the file or make it smaller", path.display())]
    TooLarge {
        /// The path as given.
        path: PathBuf,
        /// Its size in bytes, as far as it is known.
        bytes: u64,
        /// The most bytes that are read.
        most: u64,
    },
}

impl ReadFileError {
    /// Whether there is nothing at that path.
    pub fn is_not_found(&self) -> bool {
        matches!(self, Self::System { source, .. } if source.kind() == io::ErrorKind::NotFound)
    }
}

/// Reads a regular file of at most `most` bytes. Pipes and devices may never end, so they are refused unopened.
///
/// # Errors
///
/// Any [`ReadFileError`].
pub fn read_file(path: &Path, most: u64) -> Result<Vec<u8>, ReadFileError> {
    let system = |source| ReadFileError::System { path: path.into(), source };
    let too_large = |bytes| ReadFileError::TooLarge { path: path.into(), bytes, most };
    // Before it is opened: that alone would wait for who writes to a pipe.
    let metadata = fs::metadata(path).map_err(system)?;
    if metadata.is_dir() {
        return Err(ReadFileError::Directory { path: path.into() });
    }
    if !metadata.is_file() {
        return Err(ReadFileError::NotAFile { path: path.into() });
    }
    let size = metadata.len();
    if size > most {
        return Err(too_large(size));
    }
    let mut bytes = Vec::new();
    // Some of the system's own files have no size and are like pipes.
    if size > 0 {
        bytes.try_reserve_exact(size as usize).map_err(|_| system(io::ErrorKind::OutOfMemory.into()))?;
        // It may grow meanwhile.
        File::open(path).and_then(|file| file.take(most + 1).read_to_end(&mut bytes)).map_err(system)?;
    }
    let read = bytes.len() as u64;
    if read > most { Err(too_large(read)) } else { Ok(bytes) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_read_up_to_their_limit() {
        let folder = tempfile::tempdir().expect("a temporary folder can be made");
        let path = folder.path().join("seven");
        fs::write(&path, b"1234567").expect("the folder is writable");
        assert_eq!(read_file(&path, 7).expect("it is not larger"), b"1234567");
        assert!(matches!(read_file(&path, 6), Err(ReadFileError::TooLarge { bytes: 7, most: 6, .. })));
        assert!(matches!(read_file(folder.path(), 7), Err(ReadFileError::Directory { .. })));
        assert!(read_file(&folder.path().join("missing"), 7).expect_err("there is none").is_not_found());
        // A file of a TiB that takes no room.
        let huge = File::create(folder.path().join("huge")).expect("the folder is writable");
        huge.set_len(1 << 40).expect("holes take no room");
        let error = read_file(&folder.path().join("huge"), 1 << 31).expect_err("it is larger than memory").to_string();
        assert!(error.contains("1099511627776") && error.contains("2147483648"), "{error}");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn what_never_ends_is_not_read() {
        for device in ["/dev/zero", "/dev/urandom", "/dev/null"] {
            assert!(matches!(read_file(Path::new(device), 7), Err(ReadFileError::NotAFile { .. })), "{device}");
        }
        // Regular files by their kind; the first has no size and waits for the kernel's next message.
        assert!(read_file(Path::new("/proc/kmsg"), 7).is_ok_and(|bytes| bytes.is_empty()));
        assert!(read_file(Path::new("/proc/self/mem"), 7).is_ok_and(|bytes| bytes.is_empty()));
    }
}
