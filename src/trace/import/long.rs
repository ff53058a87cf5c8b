//! A table with a row for each value. Rows of one time that follow each other are one row of the trace, until a signal
//! comes again.

use std::collections::BTreeSet;
use std::io::Read;

use super::csv::{Opened, column};
use super::names::{Names, Pick};
use super::{ImportError, Row, Rows, Settings};

pub(super) struct Long<'a, R: Read> {
    table: Opened<R>,
    names: &'a Names,
    missing: &'a [String],
    name: usize,
    value: usize,
    /// The row that was read and does not belong to the one before.
    next: Option<Row>,
    /// Where that row stands.
    line: u64,
}

impl<'a, R: Read> Long<'a, R> {
    pub fn new(
        table: Opened<R>,
        name: &str,
        value: &str,
        names: &'a Names,
        settings: &'a Settings,
    ) -> Result<Long<'a, R>, ImportError> {
        let name = column(&table.columns, name, &table.file, "signals' names (--name)")?;
        let value = column(&table.columns, value, &table.file, "values (--value)")?;
        Ok(Long { table, names, missing: &settings.missing, name, value, next: None, line: 1 })
    }

    /// The next row of the table that holds a value; one that holds none still has its time.
    fn read(&mut self) -> Result<Option<Row>, ImportError> {
        let Some(at) = self.table.advance()? else { return Ok(None) };
        let name = self.table.cell(self.name);
        let picks: Vec<Pick> = self.names.picks("", name.trim()).collect();
        let text = self.table.cell(self.value);
        let mut values = Vec::new();
        let read = self.names.values(&picks, &text, self.missing, &mut values);
        read.map_err(|problem| {
            self.table.wrong(&self.table.columns[self.value], format!("{}: {problem}", name.trim()))
        })?;
        Ok(Some(Row { at, values }))
    }
}

impl<R: Read> Rows for Long<'_, R> {
    fn next_row(&mut self) -> Result<Option<Row>, ImportError> {
        let mut row = match self.next.take() {
            Some(row) => row,
            None => match self.read()? {
                Some(row) => row,
                None => return Ok(None),
            },
        };
        self.line = self.table.line;
        while let Some(more) = self.read()? {
            let known: BTreeSet<usize> = row.values.iter().map(|(signal, _)| *signal).collect();
            let is_again = more.values.iter().any(|(signal, _)| known.contains(signal));
            if more.at != row.at || is_again {
                self.next = Some(more);
                break;
            }
            row.values.extend(more.values);
        }
        Ok(Some(row))
    }

    fn place(&self) -> (&str, u64) {
        (&self.table.file, self.line)
    }
}
