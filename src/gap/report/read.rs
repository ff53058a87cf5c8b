//! `report.json` to its types and back.

use std::path::Path;

use super::Report;

/// Why a text is no report.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}:{line}:{column}: no report of a diagnosis: {problem}; expected what `kinetwin gap diagnose` writes")]
pub struct ReportError {
    pub file: String,
    /// From 1, like the column.
    pub line: usize,
    pub column: usize,
    pub problem: String,
}

impl Report {
    /// Reads a report from the text of the file called `file`. Members that it does not know are skipped.
    pub fn from_json(file: &Path, text: &str) -> Result<Report, ReportError> {
        serde_json::from_str(text).map_err(|error| {
            let whole = error.to_string();
            // The place stands in the fields already.
            let problem = whole.rsplit_once(" at line ").map_or(whole.as_str(), |(problem, _)| problem).to_owned();
            let (line, column) = (error.line().max(1), error.column().max(1));
            ReportError { file: file.display().to_string(), line, column, problem }
        })
    }

    /// The report as it stands in `report.json`, ended by a line break.
    pub fn to_json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).expect("texts and numbers always have a JSON form");
        text.push('\n');
        text
    }
}
