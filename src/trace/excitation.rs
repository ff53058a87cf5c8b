//! Which effects a trace could show, device by device: an effect is seen only where a trace holds what excites it. Whether
//! it is then told apart from others is the diagnosis's question.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::effect::{EFFECTS, EffectDescriptor, Fit, Needs, SignalClass};
use crate::plant::{Instance, Plant};
use crate::prototype::kind::PortType;
use crate::signal_map::{Direction, Signal};

use super::info::{Info, SignalInfo};
use super::motion::Motion;

/// What a trace holds of a device.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Excitation {
    pub device: String,
    /// The device's signals that the trace lacks.
    pub missing: Vec<String>,
    /// The most of any of its numbers.
    pub reversals: u64,
    pub starts: u64,
    pub stops: u64,
    /// Changes of its commands, and of its reports.
    pub commands: u64,
    pub reports: u64,
    /// Edges of all its truth values.
    pub rising: u64,
    pub falling: u64,
    /// Effects whose excitation the trace holds, by their ids.
    pub shows: Vec<&'static str>,
    /// Effects whose excitation it does not hold, with what that is.
    pub lacks: BTreeMap<&'static str, &'static str>,
}

/// What a trace holds of each device of `plant` that has signals, in the plant's order.
pub fn excitations(plant: &Plant, info: &Info, motions: &BTreeMap<String, Motion>) -> Vec<Excitation> {
    let of = |instance: &Instance| {
        let signals = plant.signal_map.signals().iter().filter(|signal| signal.instance == instance.name);
        let mut found = Excitation { device: instance.name.clone(), ..Excitation::default() };
        let mut has_signals = false;
        for signal in signals {
            has_signals = true;
            match info.signals.get(&signal.name) {
                Some(counted) => found.add(signal, counted, motions.get(&signal.name)),
                None => found.missing.push(signal.name.clone()),
            }
        }
        found.judge(instance);
        has_signals.then_some(found)
    };
    plant.instances.iter().filter_map(of).collect()
}

impl Excitation {
    fn add(&mut self, signal: &Signal, counted: &SignalInfo, motion: Option<&Motion>) {
        match signal.direction {
            Direction::Command => self.commands += counted.changes,
            Direction::Report => self.reports += counted.changes,
        }
        self.rising += counted.rising.unwrap_or_default();
        self.falling += counted.falling.unwrap_or_default();
        if let Some(motion) = motion {
            self.reversals = self.reversals.max(motion.reversals);
            self.starts = self.starts.max(motion.starts);
            self.stops = self.stops.max(motion.stops);
        }
    }

    fn judge(&mut self, instance: &Instance) {
        for effect in EFFECTS.iter().filter(|effect| may_act_on(instance, effect)) {
            if self.shows_what(effect.excited_by) {
                self.shows.push(effect.id);
            } else {
                self.lacks.insert(effect.id, effect.excited_by);
            }
        }
    }

    /// Whether it holds what the registry's words say. They are written for people: one of the things between semicolons
    /// suffices, of each of them what excites most stands first, and of what cannot be counted here any change at all is
    /// taken for it.
    fn shows_what(&self, excited_by: &str) -> bool {
        excited_by.split(';').any(|thing| {
            let first = thing.split(',').next().unwrap_or_default();
            let moves = self.starts + self.stops + self.reversals;
            let counts = [
                ("reversals", self.reversals),
                ("both directions", self.reversals),
                ("rising edges", self.rising),
                ("falling edges", self.falling),
                ("edges", self.rising + self.falling),
                // What is switched starts and stops by its edges.
                ("starts", self.starts + self.rising),
                ("stops", self.stops + self.falling),
                ("acceleration", moves),
                ("changes of speed", moves),
            ];
            let needed = counts.iter().find(|(words, _)| first.contains(words)).map(|(_, count)| *count);
            needed.unwrap_or(self.commands + self.reports) > 0
        })
    }
}

/// Whether one of the instance's devices could have the effect.
fn may_act_on(instance: &Instance, effect: &EffectDescriptor) -> bool {
    instance.tasks.iter().any(|task| {
        let short = task.kind.name.rsplit('.').next().unwrap_or(task.kind.name);
        let mode = if short == "ServoAxis" { task.parameters.text("mode") } else { "" };
        let has_what_it_needs = match effect.needs {
            Needs::Nothing => true,
            Needs::Dynamics => mode != "ideal",
            Needs::Speed => mode != "force",
        };
        let has_signal = |class: SignalClass| {
            task.kind.ports.iter().any(|port| match class {
                SignalClass::Any => true,
                SignalClass::Boolean => port.ty == PortType::Boolean,
                SignalClass::Number | SignalClass::Motion => port.ty != PortType::Boolean,
            })
        };
        let fits = |fit: &Fit| match fit {
            Fit::Signals(class) => has_signal(*class),
            Fit::Drives(kinds) | Fit::Parts(kinds) => kinds.contains(&short),
        };
        has_what_it_needs && effect.fits.iter().any(fits)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::device;
    use crate::plant::{self, embedded::Embedded};

    fn rig(signals: &[(&str, SignalInfo)], motions: &[(&str, Motion)]) -> Vec<Excitation> {
        let plant = plant::load(&Embedded, "rig", device::KINDS).expect("the rig");
        let mut info = crate::trace::info(
            crate::trace::Reader::new("t", &b"{\"trace\":\"kinetwin/1\",\"source\":\"plant\"}\n"[..]).expect("a trace"),
        )
        .expect("an info");
        info.signals = signals.iter().map(|(name, signal)| ((*name).to_owned(), signal.clone())).collect();
        let motions = motions.iter().map(|(name, motion)| ((*name).to_owned(), *motion)).collect();
        excitations(&plant, &info, &motions)
    }

    fn of<'a>(found: &'a [Excitation], device: &str) -> &'a Excitation {
        found.iter().find(|excitation| excitation.device == device).expect("a device")
    }

    #[test]
    fn backlash_is_not_seen_without_a_reversal() {
        let changes = SignalInfo { reports: 100, changes: 100, ..SignalInfo::default() };
        let one_way = Motion { starts: 3, stops: 3, ..Motion::default() };
        let found = rig(&[("Axis.position", changes.clone())], &[("Axis.position", one_way)]);
        let axis = of(&found, "Axis");
        assert_eq!(axis.lacks.get("backlash"), Some(&"reversals"));
        assert!(axis.shows.contains(&"velocity-limit") && axis.missing.contains(&"Axis.force".to_owned()));
        let back = Motion { reversals: 1, ..one_way };
        let found = rig(&[("Axis.position", changes)], &[("Axis.position", back)]);
        assert!(of(&found, "Axis").shows.contains(&"backlash"));
    }

    #[test]
    fn what_the_trace_does_not_speak_of_shows_nothing() {
        let found = rig(&[], &[]);
        let gripper = of(&found, "Gripper");
        assert!(gripper.shows.is_empty() && gripper.lacks.contains_key("on-delay"), "{gripper:?}");
        assert!(!gripper.lacks.contains_key("backlash"), "a gripper has no drive");
        assert!(found.iter().all(|excitation| excitation.device != "Feed"), "a bay without signals has nothing to say");
    }

    #[test]
    fn every_effect_says_what_excites_it() {
        for effect in EFFECTS {
            assert!(!effect.excited_by.is_empty(), "{}", effect.id);
        }
    }
}
