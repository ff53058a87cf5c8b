//! The gap that a diagnosis found, beside the plant: `report.json`, and the page with its plots where that lies beside it.

use std::io;
use std::path::{Path, PathBuf};

use crate::gap::page::{Evidence, page};
use crate::gap::report::{Report, ReportError};

/// A report to show.
#[derive(Clone, Debug)]
pub struct ReportFiles {
    pub report: Report,
    /// The page with the plots, whole.
    pub page: String,
}

/// Why a report cannot be shown.
#[derive(Debug, thiserror::Error)]
pub enum ReportFileError {
    #[error("failed to read the report {}: {source}", path.display())]
    Read { path: PathBuf, source: io::Error },
    #[error(transparent)]
    Faulty(#[from] ReportError),
}

impl ReportFiles {
    /// Reads the report at `path` and the `report.html` beside it; where there is none, the page is made of the report alone.
    pub fn read(path: &Path) -> Result<ReportFiles, ReportFileError> {
        let read = |source| ReportFileError::Read { path: path.to_owned(), source };
        let text = std::fs::read_to_string(path).map_err(read)?;
        let report = Report::from_json(path, &text)?;
        let page = match std::fs::read_to_string(path.with_extension("html")) {
            Ok(page) => page,
            Err(_) => {
                let plant = report.made_from.as_ref().map_or("the plant", |from| &from.model).to_owned();
                page(&report, &Evidence { plant, ..Evidence::default() })
            }
        };
        Ok(ReportFiles { report, page })
    }
}
