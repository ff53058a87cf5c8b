//! A machine that a case is tried on: built as one is, listened to as it happens, with something wrong or nothing.

use std::cell::{OnceCell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use crate::catalogue::{Entry, Spot};
use crate::chance::Dice;
use crate::classes::{self, Alone, MOTIONS, Number, SMALL, numbers_at, with_number};
use crate::machine::{Machine, with_each_larger};
use crate::magnitude::{Hidden, Magnitude, distance, levels_apart, noise_beyond};
use crate::plant::{Command, Plant, Rest, Signal};
use crate::quirk::{Member, Quirk};
use crate::recent::Recent;
use crate::record::{self, Seen, Surroundings};
use crate::rig::RigParameters;
use crate::script::Part;
use crate::site::Design;

/// The tolerance that the models declare.
const TOLERANCE: f64 = 0.01;

/// With this share of its strength an effect shows at most so much of what it shows.
const WEAKER: f64 = 0.1;
const SHOWS_LESS: f64 = 0.5;

/// How far the numbers of another effect are moved, by their logarithms, where what is seen leaps with them.
const OFF: [f64; 6] = [-0.7, -0.3, -0.1, 0.1, 0.3, 0.7];

/// What is measured by how much a level scatters, and not by how it did.
const NOISE: &str = "noise";

/// Reports are at most so old, s, and so much older to see what that does.
const MOST_AGE: f64 = 1e-3;
const OLDER: f64 = 2e-6;

/// Whether how much an effect shows comes of its strength: a tenth of it shows less. A delay of a microsecond by which one command misses
/// its task, and comes a whole cycle of it later, is not told from any other cause of that by anyone.
fn is_its_strengths(distance: f64, weaker: f64) -> bool {
    weaker <= SHOWS_LESS * distance
}

/// How many runs, what others did and what they hide are kept for when they are asked for again: enough for two effects that are
/// looked at beside each other, while others are tried in the place of one.
const RESTS: usize = 6;
const SEEN: usize = 8;
const BESIDE: usize = 4;

/// What is easier about practice than about an exam.
#[derive(Clone, Copy, Debug, Default)]
pub struct Conditions {
    /// Reports of no age, tasks that take commands at once, unfiltered flags.
    pub prompt: bool,
    /// Machines built exactly to their figures.
    pub exact: bool,
    /// Answers without the classes of effects that cannot be told apart.
    pub classless: bool,
}

impl Conditions {
    /// The tolerance that the model declares.
    pub fn tolerance(self) -> f64 {
        if self.exact { 0.0 } else { TOLERANCE }
    }
}

/// What a recording is made of: a machine that has not run yet, and what it is told.
pub struct Take {
    pub part: Part,
    pub built: RigParameters,
    pub quirks: Vec<Quirk>,
    pub script: Vec<Command>,
    pub around: Surroundings,
    pub seed: u64,
    pub model: &'static str,
}

impl Take {
    /// The machine.
    pub fn plant(&self) -> Plant {
        self.built.plant(&self.quirks, self.seed)
    }
}

/// A machine that has run, and what was seen of it.
pub struct Run {
    plant: Plant,
    seen: Seen,
}

impl Run {
    fn signals_of(&self, device: &str) -> Vec<Signal> {
        self.plant.signals.iter().filter(|signal| signal.parts().0 == device).cloned().collect()
    }

    fn seen_of(&self, device: &str) -> Seen {
        self.seen.of(device, &self.plant.signals)
    }
}

/// A case that can be written.
pub struct Bench {
    pub design: Design,
    built: Box<dyn Machine>,
    pub around: Surroundings,
    scripts: [Vec<Command>; 2],
    seed: u64,
    tolerance: f64,
    /// By device, what its tolerances hide.
    hidden: RefCell<BTreeMap<String, Rc<Hidden>>>,
    /// By the devices that run and what is wrong elsewhere, what all others do.
    rests: Recent<(Vec<String>, Vec<Quirk>), Rest>,
    /// By what is wrong and the device, what was seen of it.
    seen: Recent<(Vec<Quirk>, String), Seen>,
    /// By what is wrong and the device, what its tolerances and the numbers of that hide.
    beside: Recent<(Vec<Quirk>, String), Hidden>,
    /// By device, how much its levels tell of the age of the reports, 1/s².
    age_known: OnceCell<BTreeMap<String, f64>>,
}

impl Bench {
    /// A machine that is built to `design`, and listened to, as `seed` has it.
    pub fn new(design: Design, seed: u64, conditions: Conditions) -> Bench {
        let mut dice = Dice::new(seed, 2);
        let tolerance = conditions.tolerance();
        let built = design.built(tolerance, &mut dice);
        let around = Surroundings::draw(&mut dice);
        let around = if conditions.prompt { around.prompt() } else { around };
        let known = built.commands();
        let scripts = [Part::Train, Part::HeldOut];
        // What the devices of one plant do to each other depends on how it was built.
        let told = if design.is_connected() { &*built } else { design.machine() };
        let scripts =
            scripts.map(|part| record::heard(&told.program(part, &[], seed ^ part as u64, &mut dice), &known));
        Bench::told(design, (built, tolerance), around, scripts, seed)
    }

    /// What was `built` to a design within its tolerance, told this in the one and the other recording.
    fn told(
        design: Design,
        (built, tolerance): (Box<dyn Machine>, f64),
        around: Surroundings,
        scripts: [Vec<Command>; 2],
        seed: u64,
    ) -> Bench {
        Bench {
            design,
            built,
            around,
            scripts,
            seed,
            tolerance,
            hidden: RefCell::default(),
            rests: Recent::new(RESTS),
            seen: Recent::new(SEEN),
            beside: Recent::new(BESIDE),
            age_known: OnceCell::new(),
        }
    }

    /// What all chance of a recording follows from.
    pub fn seed_of(&self, part: Part) -> u64 {
        self.seed ^ part as u64
    }

    /// The same, told in the training recording what it is told with these effects; nothing where that is the same.
    pub fn told_as_recorded(&self, quirks: &[Quirk]) -> Option<Bench> {
        if !self.design.is_connected() || quirks.is_empty() {
            return None;
        }
        let [_, held_out] = self.scripts.clone();
        let (train, ..) = self.recorded(Part::Train, quirks);
        let built = (self.built.boxed(), self.tolerance);
        Some(Bench::told(self.design.clone(), built, self.around.clone(), [train, held_out], self.seed))
    }

    /// What is seen of it with nothing wrong.
    pub fn healthy(&self) -> Run {
        let mut plant = self.built.plant(&[], self.seed_of(Part::Train)).telling_parts();
        let seen = self.listened(&mut plant, self.around.age);
        Run { plant, seen }
    }

    /// What is heard of a plant under the training recording's commands, reports being so old.
    fn listened(&self, plant: &mut Plant, age: f64) -> Seen {
        let around = Surroundings { age, ..self.around.clone() };
        let script = &self.scripts[Part::Train as usize];
        record::watch(plant, script, &around, Part::Train.seconds(), self.seed_of(Part::Train))
    }

    fn watched(&self, part: Part, quirks: &[Quirk], script: &[Command]) -> (Plant, Seen) {
        let seed = self.seed_of(part);
        let mut plant = self.built.plant(quirks, seed);
        let seen = record::watch(&mut plant, script, &self.around, part.seconds(), seed);
        (plant, seen)
    }

    /// What one device of `built` reports in the training recording while it has `quirks`, told what it is told without them. Only those
    /// run that have to.
    fn of_device(&self, built: &dyn Machine, quirks: &[Quirk], (device, age): (&str, f64), healthy: &Run) -> Seen {
        let mut plant = built.plant(quirks, self.seed_of(Part::Train)).telling_parts();
        let about = built.about(device);
        if let Some(rest) = self.rest(&about, quirks, healthy) {
            plant.keep(&about, &rest);
        }
        let seen = self.listened(&mut plant, age);
        seen.of(device, &plant.signals)
    }

    /// What all but these devices do while the machine has `quirks`; nothing where that depends on what these do.
    fn rest(&self, about: &[String], quirks: &[Quirk], healthy: &Run) -> Option<Rc<Rest>> {
        let is_elsewhere = |quirk: &&Quirk| self.design.is_connected() && !about.contains(&quirk.device);
        let elsewhere: Vec<Quirk> = quirks.iter().filter(is_elsewhere).cloned().collect();
        if elsewhere.iter().any(|quirk| quirk.effect == "supply-drop") {
            return None;
        }
        Some(self.rests.get((about.to_vec(), elsewhere.clone()), || {
            if elsewhere.is_empty() {
                return healthy.plant.rest_of(about);
            }
            let mut plant = self.built.plant(&elsewhere, self.seed_of(Part::Train));
            self.listened(&mut plant, self.around.age);
            plant.rest_of(about)
        }))
    }

    /// What was told and seen while it had these effects: where devices touch each other, their automation answers to them.
    pub fn recorded(&self, part: Part, quirks: &[Quirk]) -> (Vec<Command>, Plant, Seen) {
        let seed = self.seed_of(part);
        let script = match self.design.is_connected() {
            true => {
                let told = self.built.program(part, quirks, seed, &mut Dice::new(seed, 9));
                record::heard(&told, &self.built.commands())
            }
            false => self.scripts[part as usize].clone(),
        };
        let (plant, seen) = self.watched(part, quirks, &script);
        (script, plant, seen)
    }

    /// What a recording is made of; of another plant than the rig there is none, as its automation is no list of commands.
    pub fn take(&self, part: Part, quirks: &[Quirk], model: &'static str) -> Option<Take> {
        Some(Take {
            part,
            built: self.built.rig()?.clone(),
            quirks: quirks.to_vec(),
            script: self.scripts[part as usize].clone(),
            around: self.around.clone(),
            seed: self.seed_of(part),
            model,
        })
    }

    /// How far these effects carry the training recording from what it would be: what their devices report of it.
    pub fn distance(&self, quirks: &[Quirk], healthy: &Run) -> f64 {
        self.distance_from(&[], quirks, 0.0, healthy)
    }

    /// The same from where `others`, which are among them, have it by themselves: what the devices of the rest report of it. Of what is less than `least`
    /// it may be less still.
    fn distance_from(&self, others: &[Quirk], quirks: &[Quirk], least: f64, healthy: &Run) -> f64 {
        let machine = self.design.machine();
        let (noises, own): (Vec<&Quirk>, Vec<&Quirk>) =
            quirks.iter().filter(|quirk| !others.contains(quirk)).partition(|quirk| quirk.effect == NOISE);
        let devices: BTreeSet<&str> = own.iter().map(|quirk| machine.reporter(&quirk.device)).collect();
        let noisy = noises.into_iter().map(|noise| self.noise_shows(noise, healthy).powi(2)).sum::<f64>();
        let from = |device: &str, hidden: &Hidden| {
            let (there, base) = (self.run(quirks, device, healthy), self.run(others, device, healthy));
            distance(&there, &base, &healthy.signals_of(device), &self.around, hidden).powi(2)
        };
        let at_most =
            (devices.iter().map(|device| from(device, &self.hidden(device, healthy))).sum::<f64>() + noisy).sqrt();
        let is_alone = devices.iter().all(|device| numbers_at(machine, others, device).is_empty());
        if is_alone || at_most < least {
            return at_most;
        }
        let beside = devices.iter().map(|device| from(device, &self.hidden_beside(others, device, healthy)));
        (beside.sum::<f64>() + noisy).sqrt()
    }

    /// What is seen of a device while the machine has these effects; how much it scatters is no part of it.
    fn run(&self, quirks: &[Quirk], device: &str, healthy: &Run) -> Rc<Seen> {
        let quirks: Vec<Quirk> = quirks.iter().filter(|quirk| quirk.effect != NOISE).cloned().collect();
        if quirks.is_empty() {
            return Rc::new(healthy.seen_of(device));
        }
        let run = || self.of_device(&*self.built, &quirks, (device, self.around.age), healthy);
        self.seen.get((quirks.clone(), device.to_owned()), run)
    }

    /// What a device's tolerances hide, and the numbers of `others`: what they would do with other numbers tells nobody of any effect beside them.
    fn hidden_beside(&self, others: &[Quirk], device: &str, healthy: &Run) -> Rc<Hidden> {
        let numbers = numbers_at(self.design.machine(), others, device);
        self.beside.get((others.to_vec(), device.to_owned()), || {
            let signals = healthy.signals_of(device);
            let moved = |off: f64| -> Vec<Rc<Seen>> {
                let by = |number: &Number| self.run(&with_number(others, *number, off), device, healthy);
                numbers.iter().map(by).collect()
            };
            let is_flag = |signal: &Signal| signal.kind.is_edge();
            let levels = if signals.iter().all(is_flag) { Vec::new() } else { moved(SMALL) };
            let flags = if signals.iter().any(is_flag) { OFF.map(&moved).concat() } else { Vec::new() };
            let base = self.run(others, device, healthy);
            self.hidden(device, healthy).beside((&levels, SMALL), &flags, &base, (&signals, &self.around))
        })
    }

    /// Whether each of these effects shows at least so much beside the others, whatever the numbers of those are: a dead band may hide what a spring would
    /// show alone, and a mass a little less of it a friction.
    pub fn show_beside(&self, quirks: &[Quirk], least: f64, healthy: &Run) -> bool {
        let is_alone = quirks.len() < 2;
        // The last one first: what the others do by themselves was asked for when another was tried in its place.
        let is_alone_or_shows = |at: usize| {
            let others = [&quirks[..at], &quirks[at + 1..]].concat();
            is_alone || self.distance_from(&others, quirks, least, healthy) >= least
        };
        (0..quirks.len()).rev().all(is_alone_or_shows)
    }

    /// How far a level's noise goes beyond what its sensor may have anyway.
    fn noise_shows(&self, noise: &Quirk, healthy: &Run) -> f64 {
        let port = noise.component.as_deref().unwrap_or_default();
        let name = format!("{}.{port}", self.design.machine().reporter(&noise.device));
        let signal = healthy.plant.signals.iter().find(|signal| signal.name == name);
        let reports = self.around.due(Part::Train.seconds()).len();
        signal.map_or(0.0, |signal| noise_beyond(signal, noise.value("sigma"), &self.around, reports))
    }

    /// What a device's tolerances hide, and the age of its reports as far as the other devices leave it unknown: measured once.
    fn hidden(&self, device: &str, healthy: &Run) -> Rc<Hidden> {
        if let Some(known) = self.hidden.borrow().get(device) {
            return known.clone();
        }
        let age = self.around.age;
        let base = healthy.seen_of(device);
        let signals = healthy.signals_of(device);
        let mut moved = self.with_each_larger(device, self.deviation(), healthy);
        let older = self.of_device(&*self.built, &[], (device, age + self.age_unsure(device, healthy)), healthy);
        moved.push(older);
        let mut hidden = Hidden::new(&moved, &base, &signals, &self.around);
        if signals.iter().any(|signal| signal.kind.is_edge()) {
            let bounds = [self.tolerance, -self.tolerance];
            let at_bounds = bounds.map(|bound| self.with_each_larger(device, bound, healthy)).concat();
            hidden = hidden.with_bounds(&at_bounds, &base, &signals);
        }
        let hidden = Rc::new(hidden);
        self.hidden.borrow_mut().insert(device.to_owned(), hidden.clone());
        hidden
    }

    /// A standard deviation of a measure that is drawn anywhere within its tolerance, as a share of it.
    fn deviation(&self) -> f64 {
        self.tolerance / 3.0_f64.sqrt()
    }

    /// What is seen of a device with each of its measures larger by this share of itself; nothing where it is built exactly.
    fn with_each_larger(&self, device: &str, share: f64, healthy: &Run) -> Vec<Seen> {
        let larger = if share != 0.0 { with_each_larger(&*self.built, device, share) } else { Vec::new() };
        larger.iter().map(|built| self.of_device(&**built, &[], (device, self.around.age), healthy)).collect()
    }

    /// The standard deviation of the age of the reports, s, as all devices but this one know it: by the levels of each, but for what its
    /// tolerances hide of that.
    fn age_unsure(&self, but: &str, healthy: &Run) -> f64 {
        // What is known of it beforehand.
        let most = MOST_AGE / 12.0_f64.sqrt();
        let known = self.age_known.get_or_init(|| {
            let mut plant = self.built.plant(&[], self.seed_of(Part::Train)).telling_parts();
            let older = Run { seen: self.listened(&mut plant, self.around.age + OLDER), plant };
            let devices: BTreeSet<&str> = healthy.plant.signals.iter().map(|signal| signal.parts().0).collect();
            let of = |device: &str| {
                let (base, signals) = (healthy.seen_of(device), healthy.signals_of(device));
                // Where devices touch each other, each measure of each of them would be a run of all.
                let is_alone = !self.design.is_connected();
                let moved =
                    if is_alone { self.with_each_larger(device, self.deviation(), healthy) } else { Vec::new() };
                let hidden = Hidden::new(&moved, &base, &signals, &self.around);
                levels_apart(&older.seen_of(device), &base, &signals, &self.around, &hidden) / OLDER
            };
            devices.into_iter().map(|device| (device.to_owned(), of(device).powi(2))).collect()
        });
        let others = known.iter().filter(|(device, _)| *device != but).map(|(_, known)| known);
        (most.powi(-2) + others.sum::<f64>()).sqrt().recip()
    }

    /// What nobody can tell from each of `quirks`, beside the others, in the training recording, of which this is what was told and what ran.
    pub fn classes(&self, quirks: &[Quirk], train: (&[Command], &Plant)) -> Vec<Vec<Member>> {
        (0..quirks.len()).map(|at| self.class(train, quirks, at)).collect()
    }

    /// Whether one effect of the library imitates the one that this is, and which is not of it, so well in the training recording that nobody can tell.
    pub fn is_as_one_of_the_library(&self, quirks: &[Quirk]) -> bool {
        let (script, plant, _) = self.recorded(Part::Train, quirks);
        self.classes(quirks, (&script, &plant)).iter().any(|class| class.len() > 1)
    }

    /// What nobody can tell from the one at `at`, of those that `plant` ran with under `script`.
    fn class(&self, (script, plant): (&[Command], &Plant), quirks: &[Quirk], at: usize) -> Vec<Member> {
        let (built, quirk) = (&*self.built, &quirks[at]);
        let device = built.reporter(&quirk.device);
        // A belt of a line moves what the one before it hands on; all others move by their commands alone.
        let is_belt = self.design.is_connected() && built.kind(device) == "Belt";
        let about = if is_belt { built.about(device) } else { vec![device.to_owned()] };
        let is_its = |command: &&Command| is_belt || command.signal.split_once('.').is_some_and(|(of, _)| of == device);
        let alone = Alone {
            built,
            around: &self.around,
            device,
            script: script.iter().filter(is_its).cloned().collect(),
            others: [&quirks[..at], &quirks[at + 1..]].concat(),
            rest: plant.rest_of(&about),
            about,
            seed: self.seed_of(Part::Train),
            share: self.deviation(),
            motions: Recent::new(MOTIONS),
        };
        classes::class(&alone, quirk, Part::Train.seconds())
    }

    /// The effect with the strength that shows as much as it is to.
    pub fn quirk(
        &self,
        entry: &Entry,
        spot: Spot,
        magnitude: Magnitude,
        healthy: &Run,
        seed: u64,
    ) -> Option<(Quirk, f64)> {
        let (low, high) = magnitude.range();
        let at = |strength: f64| {
            let quirk = self.design.machine().fitted(entry.quirk(spot, strength, &mut Dice::new(seed, 3)));
            let distance = self.distance(std::slice::from_ref(&quirk), healthy);
            (quirk, distance)
        };
        if !entry.has_strength() {
            return Some(at(1.0)).filter(|(_, distance)| *distance >= Magnitude::Clear.range().0);
        }
        let mut dice = Dice::new(seed, 4);
        let shows = magnitude == Magnitude::Clear || magnitude == Magnitude::Gross;
        let least = if shows { entry.tolerated.max(1e-6) } else { 1e-6 };
        let (mut weak, mut strong) =
            (least, if magnitude == Magnitude::Gross { dice.log_between(0.3, 1.0) } else { 1.0 });
        let most = at(strong);
        let goal = match magnitude {
            Magnitude::Gross => return Some(most).filter(|(_, distance)| *distance >= low),
            Magnitude::BelowNoise => dice.between(0.2, 1.0),
            _ => dice.log_between(low, high),
        };
        if most.1 < goal {
            return Some(most).filter(|(_, distance)| *distance >= low);
        }
        if shows && least > 1e-6 {
            // What a tolerance would hide must be stronger than it, and then may show more.
            let found = at(least);
            if found.1 >= goal {
                return Some(found);
            }
        }
        // Bisection in the logarithm of the strength; how near it comes to its goal is chance.
        for _ in 0..14 {
            let middle = (weak * strong).sqrt();
            let distance = at(middle).1;
            if (low..=high).contains(&distance) && (distance / goal - 1.0).abs() < 0.15 {
                strong = middle;
                break;
            }
            if distance < goal { weak = middle } else { strong = middle }
        }
        let found = Some(at(strong)).filter(|(_, distance)| (low..=high).contains(distance))?;
        (!shows || is_its_strengths(found.1, at(WEAKER * strong).1)).then_some(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Edges that a tenth of a delay moves out of their reports are a tenth of those that all of it does, and D is a root of their number.
    #[test]
    fn a_strength_shows_by_itself_where_a_tenth_of_it_shows_less() {
        assert!(is_its_strengths(50.0, 5.0) && is_its_strengths(50.0, 50.0 / 10.0_f64.sqrt()));
        assert!(!is_its_strengths(140.0, 139.0));
    }
}
