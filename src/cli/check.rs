//! `kinetwin check` and `kinetwin signals-map`.

use std::path::Path;

use serde::Serialize;

use super::arguments::{CheckArguments, SignalsMapArguments};
use super::report::extent;
use super::run::connecting;
use super::words::{self, counted};
use super::{Answer, Failure};
use crate::plant::Plant;
use crate::prototype::source::Source;
use crate::run::model::{self, Disk, MapState};
use crate::run::{self, Facts, Options};
use crate::session::mismatches;
use crate::signal_map::xml;
use crate::wire::from_base64;

/// The result of a check, as `--json` prints it.
#[derive(Debug, Serialize)]
struct Checked<'a> {
    model: &'a str,
    plant: &'a str,
    instances: usize,
    signals: usize,
    prototypes: usize,
    /// The signals map's file, where the plant's file names one.
    #[serde(skip_serializing_if = "Option::is_none")]
    signals_map: Option<String>,
    /// The server that was asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    server: Option<String>,
    /// What the server calls itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    server_name: Option<String>,
    /// What is no mistake and may yet not be meant, each in a sentence.
    remarks: Vec<String>,
    /// Each in a sentence; none where all fits.
    mismatches: Vec<String>,
}

/// Checks a model, its map, and where it is asked for a server's interface.
pub fn check(arguments: &CheckArguments) -> Result<Answer, Failure> {
    let options = connecting(&arguments.model, &arguments.connection)?;
    let plant = model::load(&arguments.model)?;
    // Some of what can be wrong shows only when the plant is built.
    model::engine(&plant, Options::STEP, 0)?;
    let mut checked = Checked {
        model: &arguments.model,
        plant: &plant.name,
        instances: plant.instances.len(),
        signals: plant.signal_map.signals().len(),
        prototypes: Facts::prototypes_of(&plant),
        signals_map: plant.adapter.signals_map.clone(),
        server: None,
        server_name: None,
        remarks: plant.remarks(),
        mismatches: Vec::new(),
    };
    checked.compare_map(&plant)?;
    if options.connect.is_some() {
        let asked = run::ask(&options, &plant)?;
        asked.notices.iter().for_each(|notice| words::tell(format_args!("warning: {notice}")));
        let interface = asked
            .answer
            .map_err(|why| Failure(format!("error: failed to ask {} for its interface: {why}", asked.server)))?;
        checked.server = Some(asked.server);
        checked.server_name = Some(from_base64(&interface.server_name));
        checked.mismatches.extend(mismatches(&plant.signal_map, &interface).iter().map(ToString::to_string));
    }
    if arguments.json {
        words::answer_line(serde_json::to_string(&checked)?)?;
    } else {
        words::answer(checked.text())?;
    }
    Ok(if checked.mismatches.is_empty() { Answer::Yes } else { Answer::No })
}

impl Checked<'_> {
    fn compare_map(&mut self, plant: &Plant) -> Result<(), Failure> {
        match model::map_state(plant)? {
            MapState::Unnamed | MapState::Same(_) => {}
            MapState::Absent(path) => {
                // A model of the catalogue is carried along without its map, which follows from it.
                if is_on_disk(self.model) {
                    let write = format!("kinetwin signals-map {} -o {path}", self.model);
                    self.mismatches.push(format!("{path}: there is no such file; {write} writes it"));
                }
                self.signals_map = None;
            }
            MapState::Differs { path, differences } => {
                self.mismatches.extend(differences.iter().map(|difference| format!("{path}: {difference}")));
            }
        }
        Ok(())
    }

    fn text(&self) -> String {
        let mut out = format!("{}: {}\n", self.model, extent(self.instances, self.signals, self.prototypes));
        if let Some(path) = &self.signals_map {
            out.push_str(&format!("signals map {path}: compared\n"));
        }
        if let (Some(server), Some(name)) = (&self.server, &self.server_name) {
            out.push_str(&format!("{name:?} at {server}: compared\n"));
        }
        for remark in &self.remarks {
            out.push_str(&format!("note: {remark}\n"));
        }
        match self.mismatches.len() {
            0 => out.push_str("all fits\n"),
            some => out.push_str(&format!("{}:\n", counted(some, "mismatch", "mismatches"))),
        }
        for mismatch in &self.mismatches {
            out.push_str(&format!("  {mismatch}\n"));
        }
        out
    }
}

/// Whether `model` names something on the disk, not only in the catalogue that the program carries along.
fn is_on_disk(model: &str) -> bool {
    Path::new(model).exists() || Path::new("models").join(model).exists()
}

/// Writes, prints or compares the signals map of a model.
pub fn signals_map(arguments: &SignalsMapArguments) -> Result<Answer, Failure> {
    let plant = model::load(&arguments.model)?;
    let text = xml::write(&plant.signal_map);
    if let Some(path) = &arguments.output {
        std::fs::write(path, text)
            .map_err(|error| Failure(format!("error: failed to write {}: {error}", path.display())))?;
        return Ok(Answer::Yes);
    }
    let Some(path) = &arguments.check else {
        words::answer(text)?;
        return Ok(Answer::Yes);
    };
    let path = path.to_string_lossy();
    let found = Disk.read(&path).map_err(|error| Failure(format!("error: {error}")))?;
    let found = xml::read(&path, &found).map_err(crate::plant::ModelError::Faulty)?;
    let differences = xml::differences(&plant.signal_map, &found);
    if differences.is_empty() {
        words::answer_line(format_args!("{path} is the signals map of {}", arguments.model))?;
        return Ok(Answer::Yes);
    }
    let listed: Vec<String> = differences.iter().map(|difference| format!("  {difference}\n")).collect();
    words::answer(format_args!("{path} is not the signals map of {}:\n{}", arguments.model, listed.concat()))?;
    Ok(Answer::No)
}
