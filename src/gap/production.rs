//! What a plant brings forth: parts per hour and cycle times, told from its reports alone, so that a machine's recording
//! and a run of the model are measured in one way.
//!
//! A part has left when the light barrier nearest to a way out is free again. A device's cycle is the mean time between two
//! of the same events of it: parts at its barrier, strokes of a pusher, grips of a gripper, arrivals of a robot. Both are
//! taken between the first and the last such event, so that neither the filling of an empty plant nor the moment at which a
//! recording ends is part of them.
//!
//! What a gap means for production is asked of the model with its automation in the loop, without and with the causes, over
//! as much time as was recorded. That is an answer only where the machine was driven by the same automation: where the
//! recorded commands are those that the model's automation gives.

use std::collections::BTreeMap;

use super::Recording;
use super::report::{Beside, Consequence, DeviceConsequence};
use crate::plant::{Instance, Plant};
use crate::signal_map::{Direction, RegisterId};
use crate::value::{ElementaryType, SignalType};

/// The least events that make a cycle: two intervals.
const LEAST_EVENTS: usize = 3;

/// The reports of which one counts a device's cycles, the first that it has; whether it counts when it becomes true.
const COUNTING: &[(&str, bool)] = &[
    ("lightBarrierB", true),
    ("lightBarrierA", true),
    ("limitExtended", true),
    ("vacuumOn", true),
    ("cartesianArrived", true),
];

/// When a boolean report changed, in the order of time: seconds, and what it became.
pub type Changes = Vec<(f64, bool)>;

/// What a recording, or a run, holds of all this.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Observation {
    /// Of the boolean reports.
    pub changes: BTreeMap<RegisterId, Changes>,
    /// The values that each command took, SI, one after the other, none twice in a row; the first is 0.
    pub commands: BTreeMap<RegisterId, Vec<f64>>,
}

impl Observation {
    /// What a recording of `plant` holds up to `ends`, s.
    pub fn of(plant: &Plant, recording: &Recording, ends: f64) -> Observation {
        let mut observed = Observation::default();
        for (index, signal) in plant.signal_map.signals().iter().enumerate() {
            let register = RegisterId(index as u32);
            let values = recording.values(register).iter().take_while(|stamped| stamped.at <= ends);
            match signal.direction {
                Direction::Command => {
                    // Every command is 0 until a line says otherwise.
                    let mut all = vec![0.0];
                    all.extend(values.map(|stamped| stamped.value));
                    all.dedup();
                    observed.commands.insert(register, all);
                }
                Direction::Report if signal.ty == SignalType::scalar(ElementaryType::Bool) => {
                    let mut changes: Changes = values.map(|stamped| (stamped.at, stamped.value != 0.0)).collect();
                    changes.dedup_by_key(|(_, is)| *is);
                    // What a recording begins with is no change.
                    observed.changes.insert(register, changes.split_off(changes.len().min(1)));
                }
                Direction::Report => {}
            }
        }
        observed
    }
}

/// What a plant brought forth in a recording or in a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Production {
    /// Of the whole plant; `None` where fewer than three parts left.
    pub parts_per_hour: Option<f64>,
    /// The mean time from one part that leaves to the next, s.
    pub cycle_s: Option<f64>,
    /// Each device's cycle, s, by the instance's name.
    pub devices: BTreeMap<String, f64>,
}

/// The reports of a plant that tell what it brings forth.
#[derive(Clone, Debug)]
pub struct Counters {
    /// One for each way out.
    exits: Vec<RegisterId>,
    /// One for each device that has one.
    devices: BTreeMap<String, (RegisterId, bool)>,
}

impl Counters {
    /// Those of `plant`. Ways out are its unloading bays for anything but pallets; without a bay, the ends of its belts.
    pub fn of(plant: &Plant) -> Counters {
        let register =
            |instance: &Instance, report: &str| plant.signal_map.register(&format!("{}.{report}", instance.name));
        let named = |name: &str| plant.instances.iter().find(|instance| instance.name == name);
        let bays: Vec<_> = plant
            .instances
            .iter()
            .flat_map(|instance| &instance.tasks)
            .filter(|task| task.kind.name == "kinetwin.UnloadingBay")
            .collect();
        let mut exits: Vec<RegisterId> = bays
            .iter()
            .filter(|bay| bay.parameters.text("kind") != "pallet")
            .filter_map(|bay| {
                let barrier = if bay.parameters.text("place") == "start" { "lightBarrierA" } else { "lightBarrierB" };
                register(named(bay.parameters.text("belt"))?, barrier)
            })
            .collect();
        if bays.is_empty() {
            exits = plant.instances.iter().filter_map(|instance| register(instance, "lightBarrierB")).collect();
        }
        exits.sort_unstable();
        exits.dedup();
        let devices = plant.instances.iter().filter_map(|instance| {
            let counting = COUNTING.iter().find_map(|(report, to)| Some((register(instance, report)?, *to)));
            Some((instance.name.clone(), counting?))
        });
        Counters { exits, devices: devices.collect() }
    }

    /// Measures what was observed.
    pub fn measure(&self, observed: &Observation) -> Production {
        let events = |register: RegisterId, to: bool| {
            let all = observed.changes.get(&register).into_iter().flatten();
            all.filter(move |(_, is)| *is == to).map(|(at, _)| *at).collect::<Vec<f64>>()
        };
        let mut left: Vec<f64> = self.exits.iter().flat_map(|exit| events(*exit, false)).collect();
        left.sort_by(f64::total_cmp);
        let cycle_s = mean_interval(&left);
        let devices = self
            .devices
            .iter()
            .filter_map(|(name, (register, to))| Some((name.clone(), mean_interval(&events(*register, *to))?)));
        Production { parts_per_hour: cycle_s.map(|cycle| 3600.0 / cycle), cycle_s, devices: devices.collect() }
    }
}

/// What the causes mean for production: `recorded` on the machine, `before` and `after` of the model with its automation,
/// without and with them. `None` where the machine was driven by another automation, or where no whole cycle was recorded.
pub fn consequence(
    counters: &Counters,
    recorded: &Observation,
    before: &Observation,
    after: &Observation,
) -> Option<Consequence> {
    if !is_driven_alike(recorded, before) {
        return None;
    }
    let [recorded, before, after] = [recorded, before, after].map(|observed| counters.measure(observed));
    recorded.cycle_s?;
    let beside = |figure: &dyn Fn(&Production) -> Option<f64>| Beside {
        recorded: figure(&recorded),
        before: figure(&before),
        after: figure(&after),
    };
    let devices = recorded.devices.keys().map(|name| {
        let cycle_s = beside(&|production| production.devices.get(name).copied());
        let per_hour = |cycle: Option<f64>| cycle.map(|cycle| 3600.0 / cycle);
        let parts_per_hour = Beside {
            recorded: per_hour(cycle_s.recorded),
            before: per_hour(cycle_s.before),
            after: per_hour(cycle_s.after),
        };
        DeviceConsequence { device: name.clone(), parts_per_hour, cycle_s }
    });
    Some(Consequence {
        parts_per_hour: beside(&|production| production.parts_per_hour),
        cycle_s: beside(&|production| production.cycle_s),
        devices: devices.collect(),
    })
}

/// Values that two automations have in common, of all that the shorter sequence of each command holds, to be one and the
/// same: a program may take another branch at times where the machine is late.
const ALIKE: f64 = 0.9;

/// Whether the commands of a recording are those of the automation that gave `run`'s: command by command the same values in
/// the same order, as far as both go.
pub fn is_driven_alike(recorded: &Observation, run: &Observation) -> bool {
    let (mut same, mut all) = (0, 0);
    for (register, values) in &recorded.commands {
        let Some(ours) = run.commands.get(register) else { continue };
        // The first value is 0 on both sides.
        let pairs = values.iter().zip(ours).skip(1);
        all += pairs.len();
        same += pairs.filter(|(theirs, ours)| (*theirs - *ours).abs() <= 1e-6 * ours.abs().max(1.0)).count();
        // A command that one side uses and the other does not.
        let unused = values.len().min(ours.len()) <= 1 && values.len().max(ours.len()) > 2;
        all += usize::from(unused);
    }
    all > 0 && same as f64 >= ALIKE * all as f64
}

/// Of events in the order of time; `None` for fewer than [`LEAST_EVENTS`], or where they all came at once.
fn mean_interval(events: &[f64]) -> Option<f64> {
    let (first, last) = (events.first()?, events.last()?);
    let mean = (last - first) / (events.len() - 1) as f64;
    (events.len() >= LEAST_EVENTS && mean > 0.0).then_some(mean)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::device::KINDS;
    use crate::plant::{embedded::Embedded, load};

    fn plant(model: &str) -> Plant {
        load(&Embedded, model, KINDS).expect(model)
    }

    /// A square wave: true for `width` from each of `times`.
    fn pulses(times: &[f64], width: f64) -> Changes {
        times.iter().flat_map(|at| [(*at, true), (at + width, false)]).collect()
    }

    #[test]
    fn the_line_s_ways_out_are_its_bays_for_boxes() {
        let plant = plant("models/depalletizer");
        let counters = Counters::of(&plant);
        let names: Vec<&str> = counters.exits.iter().map(|exit| plant.signal_map.signal(*exit).name.as_str()).collect();
        // Three exit belts with a bay at either end, and the end of the line itself.
        assert_eq!(names.len(), 7, "{names:?}");
        assert!(names.contains(&"Conveyor8.lightBarrierA") && names.contains(&"Conveyor8.lightBarrierB"), "{names:?}");
        assert!(!names.iter().any(|name| name.starts_with("Conveyor2.")), "that bay takes pallets: {names:?}");
        assert_eq!(counters.devices.len(), 18, "every device that reports: {:?}", counters.devices.keys());
    }

    #[test]
    fn parts_that_leave_are_counted_between_the_first_and_the_last() {
        let plant = plant("models/rig");
        let barrier = plant.signal_map.register("Belt.lightBarrierB").expect("it has one");
        let changes = BTreeMap::from([(barrier, pulses(&[10.0, 16.0, 22.5, 28.0], 0.6))]);
        let production = Counters::of(&plant).measure(&Observation { changes, ..Observation::default() });
        assert_eq!(production.cycle_s, Some(6.0));
        assert_eq!(production.parts_per_hour, Some(600.0));
        assert_eq!(production.devices, BTreeMap::from([("Belt".to_owned(), 6.0)]));
    }

    #[test]
    fn two_events_are_no_cycle() {
        assert_eq!(mean_interval(&[1.0, 3.0]), None);
        assert_eq!(mean_interval(&[1.0, 1.0, 1.0]), None);
        assert_eq!(mean_interval(&[1.0, 3.0, 4.0]), Some(1.5));
    }
}
