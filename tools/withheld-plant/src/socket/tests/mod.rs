//! What the ends of a connection do, and what becomes of them when one fails.

mod failing;
mod links;
mod recording;

use crate::plant::Command;
use crate::quirk::Quirk;
use crate::record::{self, Surroundings};
use crate::rig::RigParameters;
use crate::script::Part;
use crate::workbench::Take;

/// A rig built to its figures, told `commands` and heard every 20 ms without noise.
pub fn take(quirks: Vec<Quirk>, commands: &[(f64, &str, f64)]) -> Take {
    let command =
        |(at, signal, value): &(f64, &str, f64)| Command { at: *at, signal: (*signal).to_owned(), value: *value };
    let commands: Vec<Command> = commands.iter().map(command).collect();
    let around = Surroundings {
        cycle: 0.02,
        phase: 0.013,
        age: 5e-4,
        jitter: 0.0,
        task: 5e-4,
        task_phase: 2e-4,
        filter: 1e-3,
        noise: 0.0,
        noise_time: 5e-3,
    };
    let (built, script) = (RigParameters::nominal(), record::heard(&commands, &crate::rig::commands()));
    Take { part: Part::Train, built, quirks, script, around, seed: 3, model: "models/rig" }
}
