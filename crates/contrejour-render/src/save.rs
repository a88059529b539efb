//! Every file that the command line leaves: as a whole, or not at all.

use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Why a file could not be written.
#[derive(Debug, thiserror::Error)]
pub enum SaveError {
    /// The folder cannot be made.
    #[error("cannot make the folder {}; choose another place", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The file cannot be written.
    #[error(
        "cannot write {}; check that the folder can be written, the disk has room and files may be that large",
        path.display()
    )]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The path names no file.
    #[error("{} names no file; give a path that ends in a file name", path.display())]
    NoFileName {
        /// The path.
        path: PathBuf,
    },
    /// The picture cannot be encoded.
    #[error("cannot encode {} as PNG", path.display())]
    Encode {
        /// The file.
        path: PathBuf,
        /// What the encoder says.
        source: image::ImageError,
    },
}

/// Writes a file as a whole or not at all: under another name first, which is then changed. Its folder is made where
/// it is missing; a link to a file stays and the file is written. Devices and pipes are written to as they are.
///
/// # Errors
///
/// [`SaveError`]; an older file of the same name then stays as it was.
pub fn save_file(bytes: &[u8], path: &Path) -> Result<(), SaveError> {
    save(path, |file| file.write_all(bytes))
}

/// Makes a folder where it is missing, and sees that files can be made in it: before hours of work that end there.
///
/// # Errors
///
/// [`SaveError`] where no folder can be made or no file in it.
pub fn check_folder(folder: &Path) -> Result<(), SaveError> {
    make_folder(folder)?;
    let made = tempfile::tempfile_in(folder);
    made.map(drop).map_err(|source| SaveError::Write { path: folder.into(), source })
}

fn make_folder(folder: &Path) -> Result<(), SaveError> {
    fs::create_dir_all(folder).map_err(|source| SaveError::Folder { path: folder.into(), source })
}

/// Writes a file with `write`, whose error leaves the file as it was.
fn save(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), SaveError> {
    if path.file_name().is_none() {
        return Err(SaveError::NoFileName { path: path.into() });
    }
    make_folder(folder_of(path))?;
    let written = if is_stream(path) {
        // Appends, since a shell may have put its own output into the file behind /dev/stdout.
        OpenOptions::new().append(true).open(path).and_then(|mut stream| write(&mut stream))
    } else {
        replace(&fs::canonicalize(path).unwrap_or_else(|_| path.into()), write)
    };
    written.map_err(|source| SaveError::Write { path: path.into(), source })
}

/// Whether a path names a device, a pipe or an open file of a process, which can't be replaced by a file.
fn is_stream(path: &Path) -> bool {
    let is_special = fs::metadata(path).is_ok_and(|kind| !kind.is_file() && !kind.is_dir());
    let is_of_the_system = |folder: PathBuf| folder == Path::new("/dev") || folder.starts_with("/proc");
    is_special || fs::canonicalize(folder_of(path)).is_ok_and(is_of_the_system)
}

fn replace(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut builder = tempfile::Builder::new();
    // Short, whatever the length of the file's own name.
    builder.prefix(".contrejour-").suffix(".unfinished");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    // Removed where it is dropped.
    let mut unfinished = builder.tempfile_in(folder_of(path))?;
    // A private file stays private.
    if let Ok(older) = fs::metadata(path) {
        unfinished.as_file().set_permissions(older.permissions())?;
    }
    write(&mut unfinished)?;
    // Some file systems find room only now.
    unfinished.as_file().sync_all()?;
    unfinished.persist(path)?;
    Ok(())
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

#[cfg(test)]
mod tests {
    use std::fs::File;

    use super::*;

    const OLD: &[u8] = b"an older file";

    /// What saving leaves in a folder with an older file where the disk is full after seven bytes.
    fn left_by_a_full_disk(save: impl FnOnce(&Path, &dyn Fn(&mut dyn Write) -> io::Result<()>)) -> Vec<Vec<u8>> {
        let folder = tempfile::tempdir().expect("there is room for a folder");
        let path = folder.path().join("out.json");
        fs::write(&path, OLD).expect("the folder can be written");
        save(&path, &|file| {
            file.write_all(b"half a ")?;
            file.flush()?;
            Err(io::ErrorKind::StorageFull.into())
        });
        let entries = fs::read_dir(folder.path()).expect("it exists");
        entries.map(|entry| fs::read(entry.expect("it is listed").path()).expect("it is a file")).collect()
    }

    #[test]
    fn a_full_disk_leaves_the_older_file_alone() {
        let left = left_by_a_full_disk(|path, write| {
            let error = save(path, write).expect_err("the disk is full");
            assert!(matches!(error, SaveError::Write { .. }), "{error}");
        });
        assert_eq!(left, [OLD]);
    }

    #[test]
    fn the_test_of_a_full_disk_sees_a_file_that_is_written_in_place() {
        let left = left_by_a_full_disk(|path, write| {
            let mut file = File::create(path).expect("the folder can be written");
            write(&mut file).expect_err("the disk is full");
        });
        assert_eq!(left, [b"half a "]);
    }

    #[cfg(unix)]
    #[test]
    fn a_private_file_stays_private() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().expect("there is room for a folder");
        let path = folder.path().join("out.json");
        fs::write(&path, OLD).expect("the folder can be written");
        fs::set_permissions(&path, fs::Permissions::from_mode(0o600)).expect("it is ours");
        save_file(b"new", &path).expect("the folder can be written");
        let mode = fs::metadata(&path).expect("it was written").permissions().mode();
        assert_eq!(mode & 0o777, 0o600);
    }

    #[test]
    fn a_folder_that_can_be_none_is_refused() {
        let folder = tempfile::tempdir().expect("there is room for a folder");
        check_folder(&folder.path().join("a/b")).expect("it can be made");
        assert_eq!(fs::read_dir(folder.path().join("a/b")).expect("it was made").count(), 0);
        fs::write(folder.path().join("file"), OLD).expect("the folder can be written");
        assert!(matches!(check_folder(&folder.path().join("file")), Err(SaveError::Folder { .. })));
    }

    #[test]
    fn a_file_is_replaced_as_a_whole() {
        let folder = tempfile::tempdir().expect("there is room for a folder");
        // As long as a name may be.
        let path = folder.path().join("n".repeat(255));
        fs::write(&path, OLD).expect("the folder can be written");
        save_file(b"new", &path).expect("the folder can be written");
        assert_eq!(fs::read(&path).expect("it was written"), b"new");
        assert_eq!(fs::read_dir(folder.path()).expect("it exists").count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn links_stay_and_others_may_read() {
        use std::os::unix::fs::{PermissionsExt, symlink};

        let folder = tempfile::tempdir().expect("there is room for a folder");
        let [file, link, plain] = ["file", "link", "plain"].map(|name| folder.path().join(name));
        fs::write(&file, OLD).expect("the folder can be written");
        fs::write(&plain, OLD).expect("the folder can be written");
        symlink(&file, &link).expect("the folder can be written");
        save_file(b"new", &link).expect("the folder can be written");
        assert!(link.is_symlink() && fs::read(&file).expect("it is there") == b"new");
        let mode = |path: &Path| fs::metadata(path).expect("it is there").permissions().mode();
        assert_eq!(mode(&file), mode(&plain), "as the user's mask wants it");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn devices_are_written_to_and_stay() {
        save_file(b"x", Path::new("/dev/null")).expect("it takes everything");
        let error = save_file(b"x", Path::new("/dev/full")).expect_err("it has no room");
        assert!(matches!(error, SaveError::Write { .. }), "{error}");
        for device in ["/dev/null", "/dev/full"] {
            assert!(!fs::metadata(device).expect("it is there").is_file(), "{device}");
        }
    }

    #[test]
    fn what_is_in_the_way_is_an_error_and_stays() {
        let folder = tempfile::tempdir().expect("there is room for a folder");
        let taken = folder.path().join("taken.png");
        fs::create_dir_all(taken.join("inside")).expect("the folder can be written");
        assert!(matches!(save_file(b"x", &taken), Err(SaveError::Write { .. })));
        fs::write(folder.path().join("file"), OLD).expect("the folder can be written");
        assert!(matches!(save_file(b"x", &folder.path().join("file/a")), Err(SaveError::Folder { .. })));
        assert!(matches!(save_file(b"x", Path::new("/")), Err(SaveError::NoFileName { .. })));
        assert_eq!(fs::read_dir(folder.path()).expect("it exists").count(), 2);
    }
}
