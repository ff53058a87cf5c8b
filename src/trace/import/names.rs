//! Columns find their signals.

use std::collections::HashMap;

use crate::trace::Sender;
use crate::xml::nearest;

use super::mapping::{Mapping, Transform};
use super::signals::Target;
use super::{ImportError, Settings, cell};

/// What becomes of a column: its signal, by index, and what is done with its cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pick {
    pub signal: usize,
    pub transform: Transform,
}

/// The columns of all sources, each with its signal or none.
#[derive(Clone, Debug, Default)]
pub(super) struct Names {
    pub targets: Vec<Target>,
    /// By file and column.
    picks: HashMap<(String, String), Pick>,
    /// Columns that become nothing, once each.
    pub unused: Vec<String>,
}

impl Names {
    /// Lets every mapping find its column among `sources`: the files' names, each with its columns' names.
    pub fn resolve(settings: &Settings, sources: &[(String, Vec<String>)]) -> Result<Names, ImportError> {
        let mut names = Names::default();
        if settings.maps.is_empty() {
            for (file, columns) in sources {
                for column in columns.iter().filter(|column| settings.signals.has(column)) {
                    names.add(settings, column, (file, column), Transform::NONE).map_err(|problem| {
                        ImportError::File { file: file.clone(), problem: format!("column {column:?}: {problem}") }
                    })?;
                }
            }
        }
        for map in &settings.maps {
            let error = |problem: String| ImportError::Map { map: map.text.clone(), problem };
            let (file, column, transform) = find(map, sources).map_err(error)?;
            names.add(settings, &map.signal, (file, column), transform).map_err(error)?;
        }
        let all = sources.iter().flat_map(|(file, columns)| columns.iter().map(move |column| (file, column)));
        names.unused = all
            .filter(|(file, column)| !names.picks.contains_key(&((*file).clone(), (*column).clone())))
            .map(|(_, column)| column.clone())
            .collect();
        Ok(names)
    }

    /// For long tables, whose names show only as they are read: every reading of a mapping is taken, the plainest first.
    /// Their file is the empty name: they are of all files.
    pub fn of_long(settings: &Settings) -> Result<Names, ImportError> {
        let mut names = Names::default();
        let error = |map: &str, problem: String| ImportError::Map { map: map.to_owned(), problem };
        if settings.maps.is_empty() {
            let Some(map) = &settings.signals.map else {
                let problem = "expected at least one, or --model: a long table's names show only as it is read";
                return Err(error("COLUMN=SIGNAL", problem.to_owned()));
            };
            for signal in map.signals() {
                let added = names.add(settings, &signal.name, ("", &signal.name), Transform::NONE);
                added.map_err(|problem| error(&signal.name, problem))?;
            }
        }
        for map in &settings.maps {
            let [(plainest, _), others @ ..] = &map.readings[..] else { continue };
            let added = names.add(settings, &map.signal, ("", plainest), Transform::NONE);
            added.map_err(|problem| error(&map.text, problem))?;
            let signal = names.targets.len() - 1;
            for (column, transform) in others {
                names.insert(("", column), Pick { signal, transform: *transform });
            }
        }
        Ok(names)
    }

    fn add(
        &mut self,
        settings: &Settings,
        signal: &str,
        (file, column): (&str, &str),
        transform: Transform,
    ) -> Result<(), String> {
        let target = settings.signals.target(signal)?;
        if self.targets.iter().any(|known| known.name == signal) {
            return Err(format!("{signal} has a column already: expected each signal once"));
        }
        self.insert((file, column), Pick { signal: self.targets.len(), transform });
        self.targets.push(target);
        Ok(())
    }

    fn insert(&mut self, (file, column): (&str, &str), pick: Pick) {
        let mut key = (file.to_owned(), column.to_owned());
        // Bits of one word become several signals.
        while self.picks.contains_key(&key) {
            key.1.push(AGAIN);
        }
        self.picks.insert(key, pick);
    }

    /// What becomes of a column; nothing, one signal, or several.
    pub fn picks<'a>(&'a self, file: &str, column: &str) -> impl Iterator<Item = Pick> + use<'a> {
        let mut key = (file.to_owned(), column.to_owned());
        std::iter::from_fn(move || {
            let pick = self.picks.get(&key).copied();
            key.1.push(AGAIN);
            pick
        })
    }

    /// The values of a cell; none where it holds nothing.
    pub fn values(
        &self,
        picks: &[Pick],
        text: &str,
        missing: &[String],
        values: &mut Vec<(usize, String)>,
    ) -> Result<(), cell::Wrong> {
        let text = text.trim();
        if text.is_empty() || missing.iter().any(|word| word == text) {
            return Ok(());
        }
        for pick in picks {
            values.push((pick.signal, cell::value(text, &pick.transform, self.targets[pick.signal].ty)?));
        }
        Ok(())
    }

    /// The signals' names and senders, by index.
    pub fn senders(&self) -> Vec<(String, Sender)> {
        self.targets.iter().map(|target| (target.name.clone(), target.from)).collect()
    }
}

/// Stands behind a column's name for each signal that it becomes beyond the first; no name ends so.
const AGAIN: char = '\0';

/// The column that a mapping names: the plainest reading that some file has.
fn find<'a>(map: &Mapping, sources: &'a [(String, Vec<String>)]) -> Result<(&'a str, &'a str, Transform), String> {
    for (name, transform) in &map.readings {
        let found: Vec<(&str, &str)> = sources
            .iter()
            .flat_map(|(file, columns)| columns.iter().map(move |column| (file.as_str(), column.as_str())))
            .filter(|(file, column)| is_meant(name, file, column))
            .collect();
        match found[..] {
            [] => {}
            [(file, column)] => return Ok((file, column, *transform)),
            [(first, column), (second, _), ..] if first == second => {
                return Err(format!("column {column:?} stands twice in {first}"));
            }
            [(first, column), (second, _), ..] => {
                return Err(format!(
                    "column {column:?} stands in {first} and again in {second}: name one file, {}:{column}",
                    base(first)
                ));
            }
        }
    }
    let columns: Vec<&str> = sources.iter().flat_map(|(_, columns)| columns.iter().map(String::as_str)).collect();
    let names = map.readings.iter().map(|(name, _)| name.as_str());
    let near = names.clone().find_map(|name| nearest(name, columns.iter().copied()));
    let hint = near.map(|near| format!("; did you mean {near:?}?")).unwrap_or_default();
    let shortest = names.min_by_key(|name| name.len()).unwrap_or_default();
    Err(format!("there is no column {shortest:?}: expected one of {}{hint}", listed(&columns)))
}

fn is_meant(name: &str, file: &str, column: &str) -> bool {
    if name == column {
        return true;
    }
    let Some(prefix) = name.strip_suffix(column).and_then(|rest| rest.strip_suffix(':')) else { return false };
    let base = base(file);
    [file, base, base.strip_suffix(".csv").unwrap_or(base)].contains(&prefix)
}

/// A file's name without its folders.
fn base(file: &str) -> &str {
    file.rsplit('/').next().unwrap_or(file)
}

/// Names for people: not more than twenty.
fn listed(names: &[&str]) -> String {
    const TOLD: usize = 20;
    let told = names.iter().take(TOLD).copied().collect::<Vec<_>>().join(", ");
    if names.len() > TOLD { format!("{told}, … ({} in all)", names.len()) } else { told }
}
