//! What is wrong in a file, where, what was expected there and what to do; and several of these at once.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, NamedSource, SourceCode};

/// A file as it was read.
#[derive(Debug)]
pub struct SourceFile {
    text: Arc<str>,
    /// The same text under its name, as miette wants it.
    named: NamedSource<Arc<str>>,
}

impl SourceFile {
    /// The file called `name`, a path for people.
    pub fn new(name: &str, text: &str) -> Arc<SourceFile> {
        let text: Arc<str> = text.into();
        Arc::new(SourceFile { named: NamedSource::new(name, Arc::clone(&text)), text })
    }

    /// Its name.
    pub fn name(&self) -> &str {
        self.named.name()
    }

    /// What stands in it.
    pub fn text(&self) -> &str {
        &self.text
    }
}

/// Some bytes of a file: where something was read.
#[derive(Clone)]
pub struct Place {
    file: Arc<SourceFile>,
    span: Range<usize>,
}

impl Place {
    /// The bytes `span` of `file`, clamped to what the file has.
    pub fn new(file: &Arc<SourceFile>, span: Range<usize>) -> Place {
        let end = span.end.min(file.text.len());
        Place { file: Arc::clone(file), span: span.start.min(end)..end }
    }

    /// Its bytes in the file's text, which begins behind a byte order mark.
    pub fn span(&self) -> Range<usize> {
        self.span.clone()
    }

    /// What stands there.
    pub fn text(&self) -> &str {
        self.file.text.get(self.span.clone()).unwrap_or_default()
    }

    /// The name of the file.
    pub fn file(&self) -> &str {
        self.file.name()
    }

    /// Line and column of its first character, both counted from 1, columns in characters.
    pub fn line_and_column(&self) -> (usize, usize) {
        let before = self.file.text.get(..self.span.start).unwrap_or(&self.file.text);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
    }

    /// A fault here: `found` says what is there, `expected` what should be.
    pub fn fault(&self, found: impl Into<String>, expected: impl Into<String>) -> Fault {
        Fault { place: self.clone(), found: found.into(), expected: expected.into(), other: None, help: None }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (line, column) = self.line_and_column();
        write!(f, "{}:{line}:{column}", self.file())
    }
}

impl fmt::Debug for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self}")
    }
}

impl PartialEq for Place {
    fn eq(&self, other: &Place) -> bool {
        self.span == other.span && self.file.name() == other.file.name()
    }
}

/// Something read, with the place it was read at.
#[derive(Clone, Debug, PartialEq)]
pub struct Located<T> {
    pub value: T,
    pub place: Place,
}

impl<T> Located<T> {
    /// `value`, read at `place`.
    pub fn new(value: T, place: &Place) -> Located<T> {
        Located { value, place: place.clone() }
    }

    /// A fault where it was read.
    pub fn fault(&self, found: impl Into<String>, expected: impl Into<String>) -> Fault {
        self.place.fault(found, expected)
    }
}

/// One thing wrong in a file.
#[derive(Clone, Debug)]
pub struct Fault {
    place: Place,
    found: String,
    expected: String,
    /// A second place that has to do with it.
    other: Option<(Place, String)>,
    help: Option<String>,
}

impl Fault {
    /// With what to do about it.
    pub fn help(mut self, help: impl Into<String>) -> Fault {
        self.help = Some(help.into());
        self
    }

    /// With a word it may have been meant for, where there is one.
    pub fn did_you_mean(self, nearest: Option<&str>) -> Fault {
        match nearest {
            Some(word) => self.help(format!("did you mean {word:?}?")),
            None => self,
        }
    }

    /// With a second place that has to do with it, such as that of the first of two things of one name.
    pub fn beside(mut self, place: &Place, label: &str) -> Fault {
        self.other = Some((place.clone(), label.to_owned()));
        self
    }

    /// Where it is.
    pub fn place(&self) -> &Place {
        &self.place
    }

    /// What was found there.
    pub fn found(&self) -> &str {
        &self.found
    }

    /// The second place, if it stands in another file and so cannot be shown as a label.
    fn elsewhere(&self) -> Option<&(Place, String)> {
        self.other.as_ref().filter(|(place, _)| place.file() != self.place.file())
    }

    /// Whether what was expected is too long to stand beside the line of the file.
    fn is_long(&self) -> bool {
        self.expected.chars().count() > LONGEST_LABEL
    }

    /// The fault in one line: file, line, column, what was found, what was expected, what to do.
    pub fn line(&self) -> String {
        let mut line = format!("{}: {}: {}", self.place, self.found, self.expected);
        if let Some((place, label)) = &self.other {
            line.push_str(&format!("; {label}: {place}"));
        }
        if let Some(help) = &self.help {
            line.push_str(&format!("; {help}"));
        }
        line
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.found)
    }
}

impl std::error::Error for Fault {}

impl Diagnostic for Fault {
    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(&self.place.file.named)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let span = self.place.span.clone();
        let label = if self.is_long() { "here" } else { &self.expected };
        let first = LabeledSpan::new_primary_with_span(Some(label.to_owned()), span);
        let second = self
            .other
            .iter()
            .filter(|(place, _)| place.file() == self.place.file())
            .map(|(place, label)| LabeledSpan::new_with_span(Some(label.clone()), place.span.clone()));
        Some(Box::new(std::iter::once(first).chain(second)))
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        let elsewhere = self.elsewhere().map(|(place, label)| format!("{label}: {place}"));
        let expected = self.is_long().then(|| self.expected.clone());
        let parts: Vec<String> = self.help.clone().into_iter().chain(elsewhere).chain(expected).collect();
        (!parts.is_empty()).then(|| Box::new(parts.join("\n")) as Box<dyn fmt::Display>)
    }
}

/// Everything found wrong, in the order it was found. Empty means that nothing is.
#[derive(Clone, Debug, Default)]
pub struct Faults(Vec<Fault>);

/// Labels are not wrapped: what is longer goes below, as help.
const LONGEST_LABEL: usize = 80;

/// The most faults that are told one by one: a file that is wrong from end to end needs no thousand messages.
const TOLD: usize = 20;

impl Faults {
    /// Adds one. What stands at the same place with the same words already is not told twice: a prototype's mistake
    /// shows at each of its instances.
    pub fn push(&mut self, fault: Fault) {
        if !self.0.iter().any(|known| known.place == fault.place && known.found == fault.found) {
            self.0.push(fault);
        }
    }

    /// Adds those of `other`.
    pub fn append(&mut self, other: Faults) {
        other.0.into_iter().for_each(|fault| self.push(fault));
    }

    /// Puts them in the order of their files, and within a file from its start to its end.
    pub fn sort(&mut self) {
        let mut files: Vec<String> = Vec::new();
        for fault in &self.0 {
            if !files.iter().any(|file| file == fault.place.file()) {
                files.push(fault.place.file().to_owned());
            }
        }
        let rank = |fault: &Fault| files.iter().position(|file| file == fault.place.file());
        self.0.sort_by_key(|fault| (rank(fault), fault.place.span.start));
    }

    /// Whether one of them is at `place`.
    pub fn any_at(&self, place: &Place) -> bool {
        self.0.iter().any(|fault| fault.place == *place)
    }

    /// Whether nothing is wrong.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Each of them.
    pub fn iter(&self) -> impl Iterator<Item = &Fault> {
        self.0.iter()
    }

    /// Writes them for people, each with the lines of its file, in the characters and colours of `theme`, no wider than
    /// `width` columns.
    pub fn render(&self, theme: GraphicalTheme, width: usize) -> String {
        let handler = GraphicalReportHandler::new_themed(theme).with_width(width);
        let mut text = String::new();
        for (index, fault) in self.0.iter().take(TOLD).enumerate() {
            if index > 0 {
                text.push('\n');
            }
            // Writing into a String does not fail.
            let _ = handler.render_report(&mut text, fault);
        }
        if let Some(more) = self.0.len().checked_sub(TOLD).filter(|more| *more > 0) {
            text.push_str(&format!("… and {more} more\n"));
        }
        text
    }
}

impl From<Fault> for Faults {
    fn from(fault: Fault) -> Faults {
        Faults(vec![fault])
    }
}

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines: Vec<String> = self.0.iter().take(TOLD).map(Fault::line).collect();
        f.write_str(&lines.join("\n"))?;
        match self.0.len().checked_sub(TOLD) {
            Some(more) if more > 0 => write!(f, "\n… and {more} more"),
            _ => Ok(()),
        }
    }
}

impl std::error::Error for Faults {}
