//! What a machine reported, signal by signal: of its recording one wants to see the machine and not the model.

use std::io::BufRead;

use crate::engine::{Engine, PartState};
use crate::signal_map::{RegisterId, SignalMap};
use crate::time::Instant;
use crate::trace::{Body, Reader, Sender, Source, TraceError};
use crate::value::Value;
use crate::wire::{Message, TextForm, read_value};

/// Who is seen in a trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seen {
    /// Whoever recorded it, as far as its reports go.
    Recorded,
    /// The model under the recorded commands.
    Model,
}

impl Seen {
    /// A machine as it reported itself. What a simulation recorded, the model does again, and more of it than it reported.
    pub fn by_default(source: Source) -> Seen {
        match source {
            Source::Plant => Seen::Recorded,
            _ => Seen::Model,
        }
    }
}

/// The reports of a recording, by register id: when it was told to be what.
#[derive(Debug)]
pub struct Reported(Vec<Vec<(Instant, Value)>>);

impl Reported {
    /// Those of the trace that `reader` is at the start of.
    pub fn read<R: BufRead>(map: &SignalMap, mut reader: Reader<R>) -> Result<Reported, TraceError> {
        let mut values: Vec<Vec<(Instant, Value)>> = vec![Vec::new(); map.signals().len()];
        while let Some(line) = reader.next_line()? {
            let (Body::Message(Message::SendValue(entries)), Sender::Plant) = (&line.body, line.from) else { continue };
            for entry in entries {
                let (Some(name), Some(raw)) = (&entry.name, entry.value) else { continue };
                let Some(register) = map.register(name) else { continue };
                if let Ok(value) = read_value(raw, map.signal(register).ty, TextForm::Base64) {
                    values[register.index()].push((line.at, value));
                }
            }
        }
        Ok(Reported(values))
    }

    /// Shows in `engine` what the machine was like by now, and gives the parts, as [`Engine::show_reported`] does.
    pub fn show(&self, engine: &mut Engine) -> Vec<PartState> {
        let now = engine.now();
        engine.show_reported(|register| self.at(register, now))
    }

    /// What a register was told to be last, `at` included.
    pub fn at(&self, register: RegisterId, at: Instant) -> Option<&Value> {
        let values = &self.0[register.index()];
        let index = values.partition_point(|(told, _)| *told <= at);
        index.checked_sub(1).map(|index| &values[index].1)
    }

    /// Whether anything was told of a register.
    pub fn tells_of(&self, register: RegisterId) -> bool {
        !self.0[register.index()].is_empty()
    }

    /// When a register was told to be what, as a number.
    pub fn history(&self, register: RegisterId) -> Vec<(Instant, f64)> {
        let values = &self.0[register.index()];
        values.iter().filter_map(|(at, value)| Some((*at, value.to_f64()?))).collect()
    }
}
