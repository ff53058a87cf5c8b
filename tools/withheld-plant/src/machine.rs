//! What cases are made of: the rig, or another plant that the same effects can befall.

use crate::chance::Dice;
use crate::plant::{Command, Kind, Plant};
use crate::quirk::Quirk;
use crate::rig::{self, RigParameters};
use crate::script::{self, Part};

/// A machine as it was built.
pub trait Machine {
    /// It with `quirks`, at rest; `seed` is that of what befalls its boxes.
    fn plant(&self, quirks: &[Quirk], seed: u64) -> Plant;
    /// What it can be told, in the order of the first message.
    fn commands(&self) -> Vec<(String, Kind)>;
    /// What its automation tells it while it has `quirks`; `seed` is that of what befalls its boxes.
    fn program(&self, part: Part, quirks: &[Quirk], seed: u64, dice: &mut Dice) -> Vec<Command>;
    /// Another like it.
    fn boxed(&self) -> Box<dyn Machine>;
    /// What of a device is built to a tolerance.
    fn measures(&mut self, device: &str) -> Vec<&mut f64>;
    /// Whether it has what stands for a device of the rig.
    fn has(&self, device: &str) -> bool;
    /// The device that reports what befalls the one called `device`: of a bay the belt that it feeds.
    fn reporter<'a>(&'a self, device: &'a str) -> &'a str {
        device
    }
    /// The devices that have to run so that the one called `device` does what it does among all, itself among them, where it is known what the others
    /// hand on to them.
    fn about(&self, device: &str) -> Vec<String> {
        vec![device.to_owned()]
    }
    /// What the rig calls a device of the kind of the one called `device`.
    fn kind(&self, device: &str) -> String;
    /// It as a rig, if it is one.
    fn rig(&self) -> Option<&RigParameters> {
        None
    }
    /// What was drawn for a device of the rig, as it is for the one that stands for it here.
    fn fitted(&self, quirk: Quirk) -> Quirk;
}

impl Machine for RigParameters {
    fn plant(&self, quirks: &[Quirk], seed: u64) -> Plant {
        RigParameters::plant(self, quirks, seed)
    }

    fn commands(&self) -> Vec<(String, Kind)> {
        rig::commands()
    }

    fn program(&self, part: Part, _quirks: &[Quirk], _seed: u64, dice: &mut Dice) -> Vec<Command> {
        script::program(part, dice)
    }

    fn boxed(&self) -> Box<dyn Machine> {
        Box::new(self.clone())
    }

    fn measures(&mut self, device: &str) -> Vec<&mut f64> {
        self.all_measures().into_iter().filter(|(of, _)| *of == device).map(|(_, measure)| measure).collect()
    }

    fn has(&self, _device: &str) -> bool {
        true
    }

    fn reporter<'a>(&'a self, device: &'a str) -> &'a str {
        if device == "Feed" { "Belt" } else { device }
    }

    fn kind(&self, device: &str) -> String {
        device.to_owned()
    }

    fn rig(&self) -> Option<&RigParameters> {
        Some(self)
    }

    fn fitted(&self, quirk: Quirk) -> Quirk {
        quirk
    }
}

/// The same with the measures of a device larger by these shares of themselves, in their order.
pub fn with_larger(machine: &dyn Machine, device: &str, shares: &[f64]) -> Box<dyn Machine> {
    let mut larger = machine.boxed();
    larger.measures(device).into_iter().zip(shares).for_each(|(measure, share)| *measure *= 1.0 + share);
    larger
}

/// The same with each measure of a device larger by `share` of itself, one at a time.
pub fn with_each_larger(machine: &dyn Machine, device: &str, share: f64) -> Vec<Box<dyn Machine>> {
    let count = machine.boxed().measures(device).len();
    let one = |place: usize| (0..count).map(|at| if at == place { share } else { 0.0 }).collect::<Vec<f64>>();
    (0..count).map(|place| with_larger(machine, device, &one(place))).collect()
}
