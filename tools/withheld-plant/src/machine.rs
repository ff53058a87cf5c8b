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
    /// The same with each measure of a device larger by `share` of itself, one at a time.
    fn with_each_larger(&self, device: &str, share: f64) -> Vec<Box<dyn Machine>>;
    /// Whether it has what stands for a device of the rig.
    fn has(&self, device: &str) -> bool;
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

    fn with_each_larger(&self, device: &str, share: f64) -> Vec<Box<dyn Machine>> {
        let all = RigParameters::with_each_larger(self, device, share);
        all.into_iter().map(|one| Box::new(one) as Box<dyn Machine>).collect()
    }

    fn has(&self, _device: &str) -> bool {
        true
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
