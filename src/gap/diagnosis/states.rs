//! What a device is told in the held-out recordings and never in the training: torque off, a gripper closed.

use crate::gap::report::NotTestable;
use crate::gap::{Study, Subject};
use crate::prototype::kind::PortType;

/// A line for each command that is true, or false, in the held-out recordings alone: what a device does then no fit has seen.
pub(super) fn untrained(training: &Study, held_out: &Study) -> Vec<NotTestable> {
    let pairs = training.subjects.iter().zip(&held_out.subjects);
    pairs.flat_map(|(trained, measured)| of_device(trained, measured)).collect()
}

fn of_device(trained: &Subject, measured: &Subject) -> Vec<NotTestable> {
    let ports = trained.kind.ports.iter().enumerate().filter(|(_, port)| port.ty == PortType::Boolean);
    let states = ports.flat_map(|(port, of)| [true, false].map(|state| (port, of.name, state)));
    let new = states.filter(|(port, _, state)| {
        is_told(measured, *port, *state) && is_told(trained, *port, !state) && !is_told(trained, *port, *state)
    });
    let entry = |(_, name, state): (usize, &str, bool)| NotTestable {
        device: Some(trained.name.clone()),
        component: Some(name.to_owned()),
        reason: format!("{name} is {state} in the held-out recordings, and never in the training"),
        needs: format!("a training recording in which {name} is {state}"),
        ..NotTestable::default()
    };
    new.map(entry).collect()
}

/// Whether a command is ever `state`.
fn is_told(subject: &Subject, port: usize, state: bool) -> bool {
    let told = subject.runs.iter().flat_map(|run| &run.commands);
    told.into_iter().any(|(to, stamped)| *to == port && (stamped.value != 0.0) == state)
}
