//! One report from the shards of a run.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use contrejour_mesh::{ReadFileError, read_file};
use contrejour_render::{SaveError, save_file};

use super::error::RunError;
use super::folder::{PICTURES_FOLDER, RunFolder};
use super::manifest::{Manifest, Work};
use crate::report::{Figure, Group, MAX_FILE_BYTES, ReadError, Report, WriteError};

/// Why there is no merged report.
#[derive(Debug, thiserror::Error)]
pub enum MergeError {
    /// No folder was given.
    #[error("there is no folder to merge; give those of all shards")]
    NoFolder,
    /// A folder holds no run.
    #[error("{folder} holds no run; give folders that `contrejour report -o` filled", folder = folder.display())]
    NoRun {
        /// The folder.
        folder: PathBuf,
    },
    /// Two folders hold runs that do not belong together.
    #[error(
        "{folder} holds a run with another {what} than {first}; run its shard again with the arguments of the others",
        folder = folder.display(),
        first = first.display()
    )]
    AnotherRun {
        /// The folder.
        folder: PathBuf,
        /// The first folder.
        first: PathBuf,
        /// What differs.
        what: &'static str,
    },
    /// Two folders hold the same shard.
    #[error(
        "{first} and {second} both hold shard {number}; give one of them",
        first = first.display(),
        second = second.display()
    )]
    SameShard {
        /// One folder.
        first: PathBuf,
        /// The other folder.
        second: PathBuf,
        /// Number of the shard.
        number: usize,
    },
    /// A shard is not there.
    #[error("shard {number}/{of} is missing; run it with --shard {number}/{of}, then give its folder too")]
    NoShard {
        /// Number of the first one that is missing.
        number: usize,
        /// How many there are.
        of: usize,
    },
    /// A shard did not finish.
    #[error(
        "{folder} lacks {scene} at {map_size}; run its command again, which goes on where it stopped",
        folder = folder.display()
    )]
    Unfinished {
        /// The shard's folder.
        folder: PathBuf,
        /// The scene.
        scene: String,
        /// Texels along the shadow map's side.
        map_size: u32,
    },
    /// What a shard kept cannot be read.
    #[error(transparent)]
    Shard(#[from] RunError),
    /// A shard's report cannot be read.
    #[error(transparent)]
    Report(#[from] ReadError),
    /// A picture cannot be read.
    #[error(transparent)]
    File(#[from] ReadFileError),
    /// A picture cannot be written.
    #[error(transparent)]
    Save(#[from] SaveError),
    /// A folder of pictures cannot be read.
    #[error("{path}: {error}; check that it is a folder that can be read", path = path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system says.
        error: io::Error,
    },
    /// The report cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// Puts the shards of a run together and writes the report into a folder.
///
/// # Errors
///
/// [`MergeError`]: folders that hold no run, other runs, the same shard, not all shards or not all groups of one; files
/// that cannot be read or written.
pub fn merge(folders: &[PathBuf], command: &str, output: &Path) -> Result<Report, MergeError> {
    let mut shards = Vec::new();
    for folder in folders {
        let manifest = RunFolder::at(folder).manifest()?;
        shards.push((folder.as_path(), manifest.ok_or_else(|| MergeError::NoRun { folder: folder.clone() })?));
    }
    check(&shards)?;

    let first = &shards.first().ok_or(MergeError::NoFolder)?.1;
    let mut groups: Vec<(usize, Group)> = Vec::new();
    let mut figures: Vec<Figure> = Vec::new();
    let all_work = first.all_work();
    for (folder, manifest) in &shards {
        for (place, work) in all_work.iter().enumerate().filter(|(place, _)| manifest.does(*place)) {
            groups.push((place, finished(folder, work)?));
        }
        figures.extend(Report::read(folder)?.figures);
        copy_pictures(folder, output)?;
    }
    groups.sort_by_key(|(place, _)| *place);
    let mut header = first.header.clone();
    command.clone_into(&mut header.command);
    header.shard = None;
    let mut report = Report { header, groups: groups.into_iter().map(|(_, group)| group).collect(), figures };
    report.settle();
    report.write(output)?;
    Ok(report)
}

/// Whether the shards are those of one run, each of them once.
fn check(shards: &[(&Path, Manifest)]) -> Result<(), MergeError> {
    let (first, run) = shards.first().ok_or(MergeError::NoFolder)?;
    let of = run.shard().of();
    for (folder, other) in shards {
        let other_number = (other.shard().of() != of).then_some("number of shards");
        if let Some(what) = run.difference(other).or(other_number) {
            return Err(MergeError::AnotherRun { folder: (*folder).into(), first: (*first).into(), what });
        }
    }
    for number in 1..=of {
        let mut holding = shards.iter().filter(|(_, manifest)| manifest.shard().number() == number);
        match (holding.next(), holding.next()) {
            (None, _) => return Err(MergeError::NoShard { number, of }),
            (Some(_), None) => {}
            (Some((first, _)), Some((second, _))) => {
                return Err(MergeError::SameShard { first: (*first).into(), second: (*second).into(), number });
            }
        }
    }
    Ok(())
}

fn finished(folder: &Path, work: &Work) -> Result<Group, MergeError> {
    let group = RunFolder::at(folder).group(work)?;
    group.ok_or_else(|| MergeError::Unfinished {
        folder: folder.into(),
        scene: work.name.clone(),
        map_size: work.map_size,
    })
}

/// Copies a shard's pictures beside the report that will show them.
fn copy_pictures(from: &Path, output: &Path) -> Result<(), MergeError> {
    let [from, to] = [from, output].map(|folder| folder.join(PICTURES_FOLDER));
    let unreadable = |error| MergeError::Folder { path: from.clone(), error };
    if !from.exists() {
        return Ok(());
    }
    for entry in fs::read_dir(&from).map_err(unreadable)? {
        let picture = entry.map_err(unreadable)?.path();
        if let Some(name) = picture.file_name().filter(|_| picture.is_file() && from != to) {
            save_file(&read_file(&picture, MAX_FILE_BYTES)?, &to.join(name))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::manifest::tests::sample as manifest;
    use super::*;

    fn refusal(shards: &[Manifest]) -> String {
        let shards: Vec<_> = shards.iter().map(|manifest| (Path::new("here"), manifest.clone())).collect();
        check(&shards).expect_err("they do not make a whole").to_string()
    }

    #[test]
    fn only_a_whole_is_merged() {
        let [one, two, three] = [1, 2, 3].map(|number| manifest(number, 3));
        let whole = [&two, &one, &three].map(|manifest| (Path::new("here"), manifest.clone()));
        assert!(check(&whole).is_ok());
        assert!(refusal(&[one.clone(), three.clone()]).contains("shard 2/3 is missing"));
        assert!(refusal(&[one.clone(), two.clone(), three.clone(), two.clone()]).contains("both hold shard 2"));
        assert!(refusal(&[one.clone(), two, manifest(3, 4)]).contains("another number of shards"));
        let mut seeded = three;
        seeded.header.seed += 1;
        assert!(refusal(&[one, seeded]).contains("another seed"));
        assert!(matches!(merge(&[], "", Path::new("out")), Err(MergeError::NoFolder)));
    }

    #[test]
    fn a_folder_without_a_run_is_named() {
        let place = tempfile::tempdir().expect("there is room for a folder");
        let error = merge(&[place.path().into()], "", place.path()).expect_err("it is empty");
        assert!(matches!(error, MergeError::NoRun { folder } if folder == place.path()));
    }
}
