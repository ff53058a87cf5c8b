//! The lines of an experiment, and how the model would be recorded while it plays them.

use std::collections::BTreeMap;
use std::time::Duration;

use super::PlanError;
use super::bounds::{self, Bounds};
use super::design::{Design, SPAN_S};
use crate::engine::Engine;
use crate::gap::{Beat, Recording, Subject};
use crate::plant::Plant;
use crate::signal_map::{Direction, Kind, RegisterId, Signal};
use crate::time::Instant;
use crate::value::Value;

/// How long nothing is asked before a motion, s. A recording shows first how the machine stands: what is asked at its first
/// instant may as well have been asked before.
pub const LEAD_S: f64 = 1.0;
/// What a machine needs to come to rest after a motion, s.
pub const PAUSE_S: f64 = 1.0;
/// A motion with its lead and its pause, s.
pub const LENGTH_S: f64 = LEAD_S + SPAN_S + PAUSE_S;
/// How often a motion that may not jump is asked for a new target, s.
const STREAM_S: f64 = 0.01;
/// How often one that may jump is looked at, s.
const LOOK_S: f64 = 0.005;

/// A command at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// s.
    pub at: f64,
    pub register: RegisterId,
    /// As it stands on the wire.
    pub value: Value,
}

/// A command that takes part in an experiment.
#[derive(Clone, Debug)]
pub(super) struct Channel {
    register: RegisterId,
    signal: Signal,
    role: Role,
}

/// What a command does in it.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Role {
    /// It follows the shape within its bounds.
    Level(Bounds),
    /// It holds a value from the start: a drive is enabled.
    Held(f64),
    /// It has one value while the shape is above 0, another below.
    Switched { above: f64, below: f64 },
}

impl Channel {
    /// Whether it may jump; `None` where it does not take any value.
    pub fn jumps(&self) -> Option<bool> {
        match self.role {
            Role::Level(bounds) => Some(bounds.speed.is_infinite()),
            Role::Held(_) | Role::Switched { .. } => None,
        }
    }
}

/// The commands of `subject` that an experiment moves: those of the axis that `component` belongs to, where it has several.
pub(super) fn channels(
    plant: &Plant,
    subject: &Subject,
    component: Option<&str>,
    recordings: &[Recording],
    declared: &BTreeMap<RegisterId, Bounds>,
) -> Result<Vec<Channel>, PlanError> {
    let task = subject.id.task(plant);
    let bound = task.kind.ports.iter().zip(&task.ports).filter_map(|(port, register)| Some((port, (*register)?)));
    let commands: Vec<_> = bound.filter(|(port, _)| port.direction == Direction::Command).collect();
    let of_axis = |name: &str| {
        let axis = name.strip_suffix("Target").filter(|axis| axis.len() == 1);
        match (axis, component) {
            (Some(axis), Some(component)) => {
                component == axis || component == name || component.strip_prefix("actualPos") == Some(axis)
            }
            _ => true,
        }
    };
    let has_level = commands.iter().any(|(_, register)| plant.signal_map.signal(*register).kind == Kind::Level);
    let mut channels = Vec::new();
    for (port, register) in commands {
        let signal = plant.signal_map.signal(register).clone();
        let role = match port.name {
            name if signal.kind == Kind::Level => {
                if !of_axis(name) {
                    continue;
                }
                let asked = || Bounds::of(&signal, &bounds::asked(recordings, register));
                let bounds = declared.get(&register).copied().or_else(|| {
                    asked().map(|bounds| if shapes_itself(task.kind.name) { bounds.jumping() } else { bounds })
                });
                Role::Level(bounds.ok_or_else(|| PlanError::Unbounded { signal: signal.name.clone() })?)
            }
            "enable" | "torqueEnabled" | "motorDirection" if has_level => Role::Held(1.0),
            "command" => Role::Switched { above: 1.0, below: 2.0 },
            "suctionOn" => Role::Switched { above: 1.0, below: 0.0 },
            _ => continue,
        };
        channels.push(Channel { register, signal, role });
    }
    let moves = channels.iter().any(|channel| !matches!(channel.role, Role::Held(_)));
    if moves { Ok(channels) } else { Err(PlanError::NoCommand { device: subject.name.clone() }) }
}

/// Whether a device of this kind goes to whatever it is asked by a profile or a ramp of its own, so that its target may jump.
fn shapes_itself(kind: &str) -> bool {
    !kind.ends_with("ServoAxis")
}

/// The lines of a motion, in the order of time; a value is said when it changes.
pub(super) fn lines(design: &Design, channels: &[Channel]) -> Vec<Line> {
    let mut lines: Vec<Line> = channels.iter().flat_map(|channel| channel_lines(design, channel)).collect();
    lines.sort_by(|a, b| a.at.total_cmp(&b.at));
    lines
}

fn channel_lines(design: &Design, channel: &Channel) -> Vec<Line> {
    let motion = match channel.role {
        Role::Held(value) => vec![(0.0, value)],
        Role::Switched { above, below } => {
            let looks = (0..(SPAN_S / LOOK_S) as usize).map(|look| look as f64 * LOOK_S);
            looks.map(|at| (at, if (design.shape)(at) > 0.0 { above } else { below })).collect()
        }
        Role::Level(bounds) => {
            let every = if bounds.speed.is_finite() { STREAM_S } else { LOOK_S };
            let start = 0.0_f64.clamp(bounds.least, bounds.greatest);
            bounds.follow(|at| bounds.at((design.shape)(at)), start, SPAN_S, every)
        }
    };
    let mut lines: Vec<Line> = Vec::new();
    for (at, si) in motion {
        let value = Value::from_f64(channel.signal.ty.element, si / channel.signal.unit.to_si);
        if lines.last().is_none_or(|last| last.value != value) {
            lines.push(Line { at: LEAD_S + at, register: channel.register, value });
        }
    }
    lines
}

/// The recording that the model alone would give of these lines, at the cycle at which the machine reports.
pub(super) fn play(plant: &Plant, lines: &[Line], span: f64, recordings: &[Recording]) -> Result<Recording, PlanError> {
    let cycle = cycle(recordings);
    let mut engine = Engine::new(plant, Duration::from_secs_f64(STEP_S), 0)?;
    let mut reports: Vec<(f64, RegisterId, f64)> = Vec::new();
    let mut rest = lines.iter().peekable();
    let mut last: Vec<Option<Value>> = vec![None; plant.signal_map.signals().len()];
    let mut next = 0.0;
    while engine.now() <= Instant::ZERO + Duration::from_secs_f64(span) {
        let now = engine.now().seconds();
        let mut inputs = Vec::new();
        while let Some(line) = rest.next_if(|line| line.at <= now + 1e-9) {
            inputs.push((line.register, line.value.clone()));
        }
        let registers = engine.tick(&inputs);
        if now + 1e-9 < next {
            continue;
        }
        next += cycle;
        for (register, _) in plant.signal_map.directed(Direction::Report) {
            let value = &registers[register.index()];
            if last[register.index()].as_ref() != Some(value) {
                last[register.index()] = Some(value.clone());
                reports.extend(value.to_f64().map(|number| (now, register, number)));
            }
        }
    }
    let commands: Vec<(f64, RegisterId, f64)> =
        lines.iter().filter_map(|line| Some((line.at, line.register, line.value.to_f64()?))).collect();
    Ok(Recording::of(plant, "experiment", &commands, &reports, span))
}

/// The engine's step while it plays, s.
const STEP_S: f64 = 1e-3;

/// The cycle at which the machine reports, s: the most frequent spacing of its stamps; 10 ms where there is none.
fn cycle(recordings: &[Recording]) -> f64 {
    let stamps = recordings.iter().map(|recording| {
        Beat::ALL.iter().map(|beat| &recording.stamps[*beat as usize]).max_by_key(|stamps| stamps.len())
    });
    let mut gaps: Vec<f64> =
        stamps.flatten().flat_map(|stamps| stamps.windows(2)).map(|pair| pair[1] - pair[0]).collect();
    gaps.sort_by(f64::total_cmp);
    let middle = gaps.get(gaps.len() / 2).copied().unwrap_or(0.01);
    (middle / STEP_S).round().max(1.0) * STEP_S
}
