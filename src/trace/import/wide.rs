//! A table with a column for each signal.

use std::io::Read;

use super::csv::Opened;
use super::names::{Names, Pick};
use super::{ImportError, Row, Rows, Settings};

pub(super) struct Wide<'a, R: Read> {
    table: Opened<R>,
    names: &'a Names,
    missing: &'a [String],
    /// The columns that become something.
    picks: Vec<(usize, Vec<Pick>)>,
}

impl<'a, R: Read> Wide<'a, R> {
    pub fn new(table: Opened<R>, names: &'a Names, settings: &'a Settings) -> Wide<'a, R> {
        let mut picks: Vec<(usize, Vec<Pick>)> = Vec::new();
        for (index, column) in table.columns.iter().enumerate() {
            let picked: Vec<Pick> = names.picks(&table.file, column).collect();
            if picked.is_empty() {
                continue;
            }
            picks.push((index, picked));
        }
        Wide { table, names, missing: &settings.missing, picks }
    }
}

impl<R: Read> Rows for Wide<'_, R> {
    fn next_row(&mut self) -> Result<Option<Row>, ImportError> {
        let Some(at) = self.table.advance()? else { return Ok(None) };
        let mut values = Vec::new();
        for (index, picks) in &self.picks {
            let text = self.table.cell(*index);
            let read = self.names.values(picks, &text, self.missing, &mut values);
            read.map_err(|problem| self.table.wrong(&self.table.columns[*index], problem))?;
        }
        Ok(Some(Row { at, values }))
    }

    fn place(&self) -> (&str, u64) {
        (&self.table.file, self.table.line)
    }
}
