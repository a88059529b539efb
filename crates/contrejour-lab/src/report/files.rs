//! A report's files in its folder.

use std::path::{Path, PathBuf};

use contrejour_mesh::{ReadFileError, read_file};
use contrejour_render::{SaveError, save_file};

use super::json::{FromJsonError, ToJsonError};
use super::page::PageError;
use super::{PlotError, PlotUse, Report};

/// Everything, to be read by programs and merged with other reports.
pub const JSON_FILE: &str = "report.json";
/// Everything that was measured, a row a contestant.
pub const CSV_FILE: &str = "report.csv";
/// The page.
pub const PAGE_FILE: &str = "index.html";
/// Error-against-time plots, a file a scene.
pub const PLOTS_FOLDER: &str = "plots";

/// The most bytes of any file that a report is read from: 1 GiB.
pub(crate) const MAX_FILE_BYTES: u64 = 1 << 30;

/// Why a report is not written.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// A file or folder can't be written.
    #[error(transparent)]
    Save(#[from] SaveError),
    /// There is no JSON.
    #[error(transparent)]
    Json(#[from] ToJsonError),
    /// There is no CSV.
    #[error("the report can't be written as CSV: {0}")]
    Csv(#[from] csv::Error),
    /// A plot can't be drawn.
    #[error("error against time of \"{scene}\": {error}")]
    Plot {
        /// The scene.
        scene: String,
        /// What is wrong.
        error: PlotError,
    },
    /// There is no page.
    #[error(transparent)]
    Page(#[from] PageError),
}

/// Why a report is not read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file can't be read.
    #[error("{0}; give the folder of a report")]
    File(#[from] ReadFileError),
    /// The file is no report.
    #[error("{path}: {error}", path = path.display())]
    Json {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        error: FromJsonError,
    },
}

impl Report {
    /// Writes JSON, CSV, plots and page into a folder, which is made where it is missing and holds the pictures that
    /// the report names. Each file is written beside its place and then put there, so that readers never see half a
    /// file.
    ///
    /// # Errors
    ///
    /// What can't be written; a figure that is no number; a picture that is missing.
    pub fn write(&self, folder: &Path) -> Result<(), WriteError> {
        // First, so that what was measured is safe whatever happens to the rest.
        save_file(self.to_json()?.as_bytes(), &folder.join(JSON_FILE))?;
        save_file(&self.to_csv()?, &folder.join(CSV_FILE))?;
        let plots = folder.join(PLOTS_FOLDER);
        for (number, scene) in (1..).zip(self.scenes()) {
            if let Some(plot) = self.error_plot(scene) {
                let drawn = plot.to_svg(&format!("Error against time: {scene}"), PlotUse::File);
                let svg = drawn.map_err(|error| WriteError::Plot { scene: scene.to_owned(), error })?;
                save_file(svg.as_bytes(), &plots.join(plot_file(number, scene)))?;
            }
        }
        Ok(save_file(self.to_page(folder)?.as_bytes(), &folder.join(PAGE_FILE))?)
    }

    /// Reads a report from the JSON in its folder.
    ///
    /// # Errors
    ///
    /// A file that can't be read or is no report.
    pub fn read(folder: &Path) -> Result<Self, ReadError> {
        let path = folder.join(JSON_FILE);
        let text = read_file(&path, MAX_FILE_BYTES)?;
        // What is no text is no JSON either.
        Self::from_json(&String::from_utf8_lossy(&text)).map_err(|error| ReadError::Json { path, error })
    }
}

/// Name of a scene's plot. The number keeps scenes apart whose names differ only in what files can't be called.
fn plot_file(number: usize, scene: &str) -> String {
    let plain: String = scene.chars().map(|char| if char.is_alphanumeric() { char } else { '-' }).collect();
    format!("{number:02}-{plain}.svg")
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::*;

    fn report() -> Report {
        let contestants = vec![
            sample::contestant("plain", "plain", "shadow-map", 0.11, 1.0),
            sample::contestant("smoothies", "smoothies", "smoothies", 0.14, 1.3),
        ];
        sample::report(vec![sample::group("a/b", 1024, contestants)])
    }

    #[test]
    fn a_written_report_reads_back_and_leaves_no_parts() {
        let folder = tempfile::tempdir().expect("there is room for a folder");
        let place = folder.path().join("new");
        let report = report();
        report.write(&place).expect("it can be written");
        report.write(&place).expect("it can be written over");
        assert_eq!(Report::read(&place).expect("it was just written"), report);
        let mut files: Vec<_> = std::fs::read_dir(&place)
            .expect("the folder is there")
            .map(|entry| entry.expect("it is there").file_name().into_string().expect("it is text"))
            .collect();
        files.sort();
        assert_eq!(files, [PAGE_FILE, PLOTS_FOLDER, CSV_FILE, JSON_FILE]);
        assert!(place.join(PLOTS_FOLDER).join("01-a-b.svg").exists());
    }

    #[test]
    fn what_cannot_be_read_or_written_is_named() {
        let folder = tempfile::tempdir().expect("there is room for a folder");
        let missing = Report::read(folder.path()).expect_err("there is no report").to_string();
        assert!(missing.contains(JSON_FILE) && missing.contains("give the folder"), "{missing}");
        std::fs::write(folder.path().join(JSON_FILE), "{").expect("it can be written");
        let broken = Report::read(folder.path()).expect_err("this is no report").to_string();
        assert!(broken.contains(JSON_FILE) && broken.contains("line 1"), "{broken}");

        let in_the_way = folder.path().join("file");
        std::fs::write(&in_the_way, "").expect("it can be written");
        let refused = report().write(&in_the_way);
        assert!(matches!(refused, Err(WriteError::Save(SaveError::Folder { path, .. })) if path == in_the_way));
    }

    #[test]
    fn a_missing_picture_loses_no_figures() {
        let folder = tempfile::tempdir().expect("there is room for a folder");
        let mut report = report();
        report.groups[0].contestants[0].picture = Some("pictures/none.png".into());
        let error = report.write(folder.path()).expect_err("the picture is missing").to_string();
        assert!(error.contains("none.png"), "{error}");
        assert_eq!(Report::read(folder.path()).expect("JSON was written first"), report);
    }
}
