//! Results as files in a folder.

use std::path::Path;

use contrejour_render::{SaveError, save_file};

use super::run::Stability;
use crate::report::PageError;

/// Everything, to be read by programs.
pub const JSON_FILE: &str = "stability.json";
/// The table, a row a case.
pub const CSV_FILE: &str = "stability.csv";
/// The page.
pub const PAGE_FILE: &str = "index.html";

/// Why results are not written.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// A file can't be written.
    #[error(transparent)]
    File(#[from] SaveError),
    /// There is no JSON.
    #[error("the results can't be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// There is no CSV.
    #[error("the results can't be written as CSV: {0}")]
    Csv(#[from] csv::Error),
    /// There is no page.
    #[error(transparent)]
    Page(#[from] PageError),
}

impl Stability {
    /// Writes JSON, CSV and page into a folder, which is made where it is missing. Each file is written beside its place
    /// and then put there, so that readers never see half a file.
    ///
    /// # Errors
    ///
    /// What can't be written.
    pub fn write(&self, folder: &Path) -> Result<(), WriteError> {
        save_file(format!("{}\n", serde_json::to_string_pretty(self)?).as_bytes(), &folder.join(JSON_FILE))?;
        save_file(&self.to_csv()?, &folder.join(CSV_FILE))?;
        save_file(self.to_page()?.as_bytes(), &folder.join(PAGE_FILE))?;
        Ok(())
    }

    /// The table with its head, a row a case.
    ///
    /// # Errors
    ///
    /// None that results can cause: writing to memory is all that happens.
    pub fn to_csv(&self) -> Result<Vec<u8>, csv::Error> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        self.rows().try_for_each(|row| writer.serialize(row))?;
        writer.into_inner().map_err(|error| csv::Error::from(error.into_error()))
    }
}
