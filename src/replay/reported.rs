//! What a machine reported, signal by signal: of its recording one wants to see the machine and not the model.

use std::io::BufRead;

use crate::scene::Scene;
use crate::signal_map::{RegisterId, SignalMap};
use crate::time::Instant;
use crate::trace::{Body, Reader, Sender, TraceError};
use crate::value::Value;
use crate::wire::{Message, TextForm, read_value};

/// The reports of a recording.
#[derive(Debug)]
pub struct Reported {
    /// By register id, when it was told to be what.
    values: Vec<Vec<(Instant, Value)>>,
    /// Of each beam of the scene the register of its light barrier.
    beams: Vec<Option<RegisterId>>,
}

impl Reported {
    /// Those of the trace that `reader` is at the start of.
    pub fn read<R: BufRead>(map: &SignalMap, scene: &Scene, mut reader: Reader<R>) -> Result<Reported, TraceError> {
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
        let beams = scene.beams().iter().map(|beam| map.register(&beam.name)).collect();
        Ok(Reported { values, beams })
    }

    /// What a register was told to be last, `at` included.
    pub fn at(&self, register: RegisterId, at: Instant) -> Option<&Value> {
        let values = &self.values[register.index()];
        let index = values.partition_point(|(told, _)| *told <= at);
        index.checked_sub(1).map(|index| &values[index].1)
    }

    /// Whether anything was told of a register.
    pub fn tells_of(&self, register: RegisterId) -> bool {
        !self.values[register.index()].is_empty()
    }

    /// When a register was told to be what, as a number.
    pub fn history(&self, register: RegisterId) -> Vec<(Instant, f64)> {
        let values = &self.values[register.index()];
        values.iter().filter_map(|(at, value)| Some((*at, value.to_f64()?))).collect()
    }

    /// Whether a light barrier was told to be cut; `None` where nothing was told of it by then.
    pub fn is_cut(&self, beam: usize, at: Instant) -> Option<bool> {
        let register = self.beams.get(beam).copied().flatten()?;
        self.at(register, at)?.to_f64().map(|number| number != 0.0)
    }
}
