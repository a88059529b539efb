//! The folder of a run: what was measured is in it at once, so that little is lost when a run ends early.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use contrejour_mesh::read_file;
use contrejour_render::save_file;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::error::RunError;
use super::manifest::{Manifest, Work};
use crate::report::{Body, Figure, Group, MAX_FILE_BYTES};

/// What the run is to measure.
const MANIFEST_FILE: &str = "run.json";
/// A file a group.
const GROUPS_FOLDER: &str = "groups";
/// A file a table or figure of the papers.
const FIGURES_FOLDER: &str = "figures";
/// A file a scene.
const TRUTH_FOLDER: &str = "truth";
/// Pictures that the page shows.
pub(super) const PICTURES_FOLDER: &str = "pictures";

/// The folder of a run.
#[derive(Clone, Debug)]
pub(crate) struct RunFolder {
    root: PathBuf,
}

impl RunFolder {
    /// A folder as it is.
    pub(super) fn at(root: &Path) -> Self {
        Self { root: root.to_owned() }
    }

    /// Makes a folder the one of a run, or goes on in it. Truths of other runs may stay: they have keys of their own.
    pub(super) fn open(root: &Path, manifest: &Manifest, restart: bool) -> Result<Self, RunError> {
        let folder = Self::at(root);
        if restart {
            for part in [GROUPS_FOLDER, FIGURES_FOLDER] {
                folder.remove(part, |path| fs::remove_dir_all(path))?;
            }
            folder.remove(MANIFEST_FILE, |path| fs::remove_file(path))?;
        }
        if let Some(kept) = folder.manifest()? {
            let another_shard = (kept.shard != manifest.shard).then_some("shard");
            if let Some(what) = kept.difference(manifest).or(another_shard) {
                return Err(RunError::AnotherRun { folder: root.to_owned(), what });
            }
        }
        folder.write(MANIFEST_FILE, manifest)?;
        Ok(folder)
    }

    pub(super) fn root(&self) -> &Path {
        &self.root
    }

    /// A path from the folder as a path on disk.
    pub fn path(&self, relative: &str) -> PathBuf {
        self.root.join(relative)
    }

    /// Path of a picture from the folder.
    pub fn picture(&self, scene: &str, name: &str) -> String {
        format!("{PICTURES_FOLDER}/{}-{name}.png", plain(scene))
    }

    pub(super) fn truth_file(&self, scene: &str) -> PathBuf {
        self.path(&format!("{TRUTH_FOLDER}/{}.bin", plain(scene)))
    }

    /// What the folder's run is to measure; none where it has none.
    pub(super) fn manifest(&self) -> Result<Option<Manifest>, RunError> {
        self.read(MANIFEST_FILE)
    }

    /// A group that was measured before and whose pictures are there.
    pub(super) fn group(&self, work: &Work) -> Result<Option<Group>, RunError> {
        let group: Option<Group> = self.read(&group_file(work))?;
        Ok(group.filter(|group| pictures(group).all(|picture| self.path(picture).is_file())))
    }

    pub(super) fn keep_group(&self, work: &Work, group: &Group) -> Result<(), RunError> {
        self.write(&group_file(work), group)
    }

    /// A figure that was made before and whose pictures are there.
    pub(super) fn figure(&self, name: &str) -> Result<Option<Figure>, RunError> {
        let figure: Option<Figure> = self.read(&figure_file(name))?;
        Ok(figure.filter(|figure| match &figure.body {
            Body::Pictures(grid) => {
                let mut cells = grid.rows.iter().flat_map(|row| &row.cells).flatten();
                cells.all(|picture| self.path(&picture.path).is_file())
            }
            Body::Table(_) | Body::Plot(_) => true,
        }))
    }

    pub(super) fn keep_figure(&self, name: &str, figure: &Figure) -> Result<(), RunError> {
        self.write(&figure_file(name), figure)
    }

    fn read<T: DeserializeOwned>(&self, relative: &str) -> Result<Option<T>, RunError> {
        let path = self.path(relative);
        match read_file(&path, MAX_FILE_BYTES) {
            Ok(bytes) => serde_json::from_slice(&bytes).map(Some).map_err(|error| RunError::Damaged { path, error }),
            Err(error) if error.is_not_found() => Ok(None),
            Err(error) => Err(error.into()),
        }
    }

    fn write(&self, relative: &str, value: &impl Serialize) -> Result<(), RunError> {
        Ok(save_file(&serde_json::to_vec_pretty(value)?, &self.path(relative))?)
    }

    fn remove(&self, relative: &str, remove: impl Fn(&Path) -> io::Result<()>) -> Result<(), RunError> {
        let path = self.path(relative);
        match remove(&path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(RunError::Folder { path, error }),
            _ => Ok(()),
        }
    }
}

/// Paths of a group's pictures from the folder.
fn pictures(group: &Group) -> impl Iterator<Item = &String> {
    let of_contestants = group.contestants.iter().flat_map(|who| who.picture.iter().chain(&who.difference));
    group.truth_picture.iter().chain(of_contestants)
}

fn group_file(work: &Work) -> String {
    format!("{GROUPS_FOLDER}/{}-{}.json", plain(&work.name), work.map_size)
}

fn figure_file(name: &str) -> String {
    format!("{FIGURES_FOLDER}/{name}.json")
}

/// A name as files can be called everywhere.
pub(super) fn plain(name: &str) -> String {
    let is_plain = |char: char| char.is_alphanumeric() || matches!(char, '.' | '_');
    name.chars().map(|char| if is_plain(char) { char } else { '-' }).collect()
}

#[cfg(test)]
mod tests {
    use super::super::manifest::tests::sample as manifest;
    use super::*;
    use crate::report::sample;

    #[test]
    fn a_run_goes_on_with_the_same_arguments_only() {
        let place = tempfile::tempdir().expect("there is room for a folder");
        let root = place.path().join("new");
        let run = manifest(1, 2);
        let work = run.work().remove(0);
        let folder = RunFolder::open(&root, &run, false).expect("a new folder");
        assert_eq!(folder.group(&work).expect("it can be read"), None);
        let group = sample::group("square", 256, vec![sample::contestant("a", "a", "shadow-map", 0.1 + 0.2, 1.0)]);
        folder.keep_group(&work, &group).expect("it can be written");

        let again = RunFolder::open(&root, &run, false).expect("the same run");
        assert_eq!(again.group(&work).expect("it can be read"), Some(group));

        let mut other = run.clone();
        other.header.seed += 1;
        let refused = RunFolder::open(&root, &other, false).expect_err("another seed").to_string();
        assert!(refused.contains("another seed") && refused.contains("--restart"), "{refused}");
        let refused = RunFolder::open(&root, &manifest(2, 2), false).expect_err("another shard").to_string();
        assert!(refused.contains("another shard"), "{refused}");

        let restarted = RunFolder::open(&root, &other, true).expect("all again");
        assert_eq!(restarted.group(&work).expect("it can be read"), None);
    }

    #[test]
    fn a_group_without_its_pictures_is_measured_again() {
        let place = tempfile::tempdir().expect("there is room for a folder");
        let run = manifest(1, 1);
        let folder = RunFolder::open(place.path(), &run, false).expect("a new folder");
        let work = run.work().remove(0);
        let mut contestant = sample::contestant("a", "a", "shadow-map", 0.1, 1.0);
        contestant.difference = Some(folder.picture("square", "a"));
        folder.keep_group(&work, &sample::group("square", 256, vec![contestant])).expect("it can be written");
        assert_eq!(folder.group(&work).expect("it can be read"), None);
        fs::create_dir(folder.path(PICTURES_FOLDER)).expect("it is not there");
        fs::write(folder.path(&folder.picture("square", "a")), "").expect("it can be written");
        assert!(folder.group(&work).expect("it can be read").is_some());
    }

    #[test]
    fn damage_is_told_with_its_file() {
        let place = tempfile::tempdir().expect("there is room for a folder");
        let run = manifest(1, 1);
        let folder = RunFolder::open(place.path(), &run, false).expect("a new folder");
        let work = run.work().remove(0);
        fs::create_dir(folder.path(GROUPS_FOLDER)).expect("it is not there");
        fs::write(folder.path(&group_file(&work)), "{").expect("it can be written");
        let error = folder.group(&work).expect_err("that is no group").to_string();
        assert!(error.contains("square-256.json") && error.contains("--restart"), "{error}");
    }
}
