//! Cases: machines as they are built, listened to as it happens, with something wrong or nothing.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::Path;
use std::rc::Rc;

use serde::{Deserialize, Serialize};

use crate::catalogue::{ENTRIES, Entry, Spot};
use crate::chance::Dice;
use crate::classes::{self, Alone};
use crate::machine::Machine;
use crate::magnitude::{Hidden, Magnitude, distance};
use crate::plant::{Command, Plant, Signal};
use crate::quirk::{Member, Quirk};
use crate::record::{self, Seen, Surroundings};
use crate::rig::RigParameters;
use crate::script::Part;
use crate::site::{Design, Site, Sites};

/// The tolerance that the models declare.
const TOLERANCE: f64 = 0.01;

/// What sort of case one is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sort {
    /// One effect of the library.
    Single,
    /// Nothing is wrong.
    None,
    /// Two effects on one device.
    TwoOnOneDevice,
    /// One effect on each of two devices.
    OneOnEachOfTwo,
    /// An effect that no file of the library describes.
    Outside,
}

/// The truth about a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// `case-017`
    pub case: String,
    pub model: String,
    pub sort: Sort,
    pub magnitude: Magnitude,
    /// Of the whole, in the training recording.
    pub distance: f64,
    pub effects: Vec<Quirk>,
    /// All effects that nobody can tell from the one effect in this recording, itself first: of one that is clear or gross.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub class: Vec<Member>,
    /// What the rig calls a device of the kind of the first effect's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kind: Option<String>,
    /// How the machine was listened to.
    pub surroundings: Surroundings,
}

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
    fn tolerance(self) -> f64 {
        if self.exact { 0.0 } else { TOLERANCE }
    }
}

/// A case to be made.
#[derive(Clone, Debug)]
pub struct Plan {
    sort: Sort,
    site: Site,
    magnitude: Magnitude,
    /// The effects that are to be tried first; what does not show enough in the recording is replaced.
    first: Vec<(usize, Spot)>,
    seed: u64,
}

/// How many cases of each sort.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sizes {
    pub single: usize,
    pub faint: usize,
    pub below: usize,
    pub none: usize,
    pub two_on_one: usize,
    pub one_on_each: usize,
    pub outside: usize,
}

impl Sizes {
    /// A fixed sample of 24, by the shares of the whole but for the rarest.
    pub const SHORT: Sizes =
        Sizes { single: 8, faint: 2, below: 2, none: 6, two_on_one: 1, one_on_each: 1, outside: 4 };
    /// The whole exam.
    pub const WHOLE: Sizes =
        Sizes { single: 400, faint: 150, below: 150, none: 400, two_on_one: 60, one_on_each: 60, outside: 200 };

    /// All of them together.
    pub fn sum(self) -> usize {
        self.single + self.faint + self.below + self.none + self.two_on_one + self.one_on_each + self.outside
    }

    /// So many cases in the shares of these; the rest is single effects.
    pub fn scaled(self, cases: usize) -> Sizes {
        let part = |of: usize| (of * cases) / self.sum().max(1);
        let mut scaled = Sizes {
            single: 0,
            faint: part(self.faint),
            below: part(self.below),
            none: part(self.none),
            two_on_one: part(self.two_on_one),
            one_on_each: part(self.one_on_each),
            outside: part(self.outside),
        };
        scaled.single = cases - scaled.sum();
        scaled
    }
}

/// The cases of `seed` at `sites`, in an order that says nothing.
pub fn plans(sizes: Sizes, sites: Sites, seed: u64) -> Vec<Plan> {
    let mut dice = Dice::new(seed, 1);
    let mut library = Deck::new(false);
    let mut outside = Deck::new(true);
    let mut plans = Vec::new();
    let clear = |k: usize| if k.is_multiple_of(2) { Magnitude::Clear } else { Magnitude::Gross };
    for (count, sort, magnitude) in [
        (sizes.single, Sort::Single, None),
        (sizes.faint, Sort::Single, Some(Magnitude::Faint)),
        (sizes.below, Sort::Single, Some(Magnitude::BelowNoise)),
        (sizes.none, Sort::None, Some(Magnitude::None)),
        (sizes.two_on_one, Sort::TwoOnOneDevice, None),
        (sizes.one_on_each, Sort::OneOnEachOfTwo, None),
        (sizes.outside, Sort::Outside, None),
    ] {
        for k in 0..count {
            let magnitude = magnitude.unwrap_or(clear(k));
            let graded = magnitude == Magnitude::Faint || magnitude == Magnitude::BelowNoise;
            let site = sites.site(plans.len());
            let first = match sort {
                Sort::None => Vec::new(),
                Sort::Single => vec![
                    library.next(&mut dice, |entry, spot| site.fits(entry, spot) && (entry.has_strength() || !graded)),
                ],
                Sort::Outside => vec![outside.next(&mut dice, |entry, spot| site.fits(entry, spot))],
                Sort::TwoOnOneDevice | Sort::OneOnEachOfTwo => {
                    let one = library.next(&mut dice, |entry, spot| site.fits(entry, spot) && entry.has_strength());
                    let same = sort == Sort::TwoOnOneDevice;
                    let two = library.next(&mut dice, |entry, spot| {
                        let other = entry.effect != ENTRIES[one.0].effect && entry.place != ENTRIES[one.0].place;
                        let is_where = (spot.0 == one.1.0) == same && site.fits(entry, spot);
                        entry.has_strength() && is_where && (other || !same)
                    });
                    vec![one, two]
                }
            };
            plans.push(Plan { sort, site, magnitude, first, seed: dice.seed() });
        }
    }
    dice.shuffle(&mut plans);
    plans
}

/// Every effect at every spot, dealt out again when all have had their turn.
struct Deck {
    outside: bool,
    left: Vec<(usize, Spot)>,
}

impl Deck {
    fn new(outside: bool) -> Deck {
        Deck { outside, left: Vec::new() }
    }

    fn next(&mut self, dice: &mut Dice, fits: impl Fn(&Entry, Spot) -> bool) -> (usize, Spot) {
        let is_fit = |(entry, spot): &(usize, Spot)| fits(&ENTRIES[*entry], *spot);
        if !self.left.iter().any(is_fit) {
            let all = ENTRIES.iter().enumerate().filter(|(_, entry)| entry.effect.starts_with("x-") == self.outside);
            let mut all: Vec<_> = all.flat_map(|(at, entry)| entry.spots.iter().map(move |spot| (at, *spot))).collect();
            dice.shuffle(&mut all);
            // Each effect once before any comes at its second spot.
            let mut turns = BTreeMap::new();
            let turn = |(at, _): &(usize, Spot)| {
                let turn = turns.entry(*at).or_insert(0);
                *turn += 1;
                *turn
            };
            let order: Vec<i32> = all.iter().map(turn).collect();
            let mut both: Vec<_> = order.into_iter().zip(all).collect();
            both.sort_by_key(|(turn, _)| std::cmp::Reverse(*turn));
            self.left.extend(both.into_iter().map(|(_, one)| one));
        }
        let at = self.left.iter().rposition(is_fit).unwrap_or(0);
        self.left.remove(at)
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

/// A case that can be written.
struct Bench {
    design: Design,
    built: Box<dyn Machine>,
    around: Surroundings,
    scripts: [Vec<Command>; 2],
    seed: u64,
    tolerance: f64,
    /// By device, what its tolerances hide.
    hidden: RefCell<BTreeMap<String, Rc<Hidden>>>,
}

impl Bench {
    fn new(design: Design, seed: u64, conditions: Conditions) -> Bench {
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
        Bench { design, built, around, scripts, seed, tolerance, hidden: RefCell::default() }
    }

    fn run(&self, part: Part, quirks: &[Quirk], around: &Surroundings) -> (Plant, Seen) {
        let mut plant = self.built.plant(quirks, self.seed ^ part as u64);
        let script = &self.scripts[part as usize];
        let seen = record::watch(&mut plant, script, around, part.seconds(), self.seed ^ part as u64);
        (plant, seen)
    }

    /// What was told and seen while it had these effects: where devices touch each other, their automation answers to them.
    fn recorded(&self, part: Part, quirks: &[Quirk]) -> (Vec<Command>, Plant, Seen) {
        let seed = self.seed ^ part as u64;
        let script = match self.design.is_connected() {
            true => {
                let told = self.built.program(part, quirks, seed, &mut Dice::new(seed, 9));
                record::heard(&told, &self.built.commands())
            }
            false => self.scripts[part as usize].clone(),
        };
        let mut plant = self.built.plant(quirks, seed);
        let seen = record::watch(&mut plant, &script, &self.around, part.seconds(), seed);
        (script, plant, seen)
    }

    /// A run with what others than these devices report as `healthy` has it, where what befalls one shows in others.
    fn of_devices(&self, mut seen: Seen, healthy: &Seen, signals: &[Signal], devices: &BTreeSet<&str>) -> Seen {
        let others = signals.iter().enumerate().filter(|(_, signal)| !devices.contains(signal.parts().0));
        for (at, _) in others.filter(|_| self.design.is_connected()) {
            seen.values.iter_mut().zip(&healthy.values).for_each(|(one, other)| one[at] = other[at]);
        }
        seen
    }

    /// What a recording is made of; of another plant than the rig there is none, as its automation is no list of commands.
    fn take(&self, part: Part, quirks: &[Quirk], model: &'static str) -> Option<Take> {
        Some(Take {
            part,
            built: self.built.rig()?.clone(),
            quirks: quirks.to_vec(),
            script: self.scripts[part as usize].clone(),
            around: self.around.clone(),
            seed: self.seed ^ part as u64,
            model,
        })
    }

    /// How far these effects carry the training recording from what it would be.
    fn distance(&self, quirks: &[Quirk], healthy: &Seen) -> f64 {
        let (plant, seen) = self.run(Part::Train, quirks, &self.around);
        let devices: BTreeSet<&str> = quirks.iter().map(|quirk| quirk.device.as_str()).collect();
        let seen = self.of_devices(seen, healthy, &plant.signals, &devices);
        let hidden: Vec<Rc<Hidden>> = devices.into_iter().map(|device| self.hidden(device, healthy)).collect();
        distance(&seen, healthy, &plant.signals, &self.around, &hidden)
    }

    /// What a device's tolerances hide: measured once.
    fn hidden(&self, device: &str, healthy: &Seen) -> Rc<Hidden> {
        if let Some(known) = self.hidden.borrow().get(device) {
            return known.clone();
        }
        // The standard deviation of what is drawn anywhere between two bounds.
        let share = self.tolerance / 3.0_f64.sqrt();
        let larger = self.built.with_each_larger(device, share);
        let larger = if share > 0.0 { larger } else { Vec::new() };
        let signals = self.built.plant(&[], 0).signals;
        let run = |built: &dyn Machine| {
            let mut plant = built.plant(&[], self.seed ^ Part::Train as u64);
            let (script, part) = (&self.scripts[Part::Train as usize], Part::Train);
            let seen = record::watch(&mut plant, script, &self.around, part.seconds(), self.seed ^ part as u64);
            self.of_devices(seen, healthy, &signals, &[device].into())
        };
        let moved: Vec<Seen> = larger.iter().map(|built| run(&**built)).collect();
        let hidden = Rc::new(Hidden::new(&moved, healthy, &signals, &self.around));
        self.hidden.borrow_mut().insert(device.to_owned(), hidden.clone());
        hidden
    }

    /// What nobody can tell from `quirk` in the training recording; of another plant than the rig nothing is known of that.
    fn class(&self, quirk: &Quirk) -> Vec<Member> {
        let Some(built) = self.built.rig() else { return Vec::new() };
        // A bay is told by the belt that it feeds.
        let device = if quirk.device == "Feed" { "Belt" } else { &quirk.device };
        let (plant, _) = self.run(Part::Train, std::slice::from_ref(quirk), &self.around);
        let own = plant.devices.iter().position(|(name, _)| name == device).unwrap_or_default();
        let others = |(from, moved): &(f64, u64)| (*from, (moved & !(1 << own)).count_ones() as usize);
        let script = &self.scripts[Part::Train as usize];
        let own = |command: &&Command| command.signal.split_once('.').is_some_and(|(of, _)| of == device);
        let alone = Alone {
            built,
            around: &self.around,
            device,
            script: script.iter().filter(own).cloned().collect(),
            company: plant.moved.iter().map(others).collect(),
            seed: self.seed ^ Part::Train as u64,
            share: self.tolerance / 3.0_f64.sqrt(),
        };
        classes::class(&alone, quirk, Part::Train.seconds())
    }

    /// The effect with the strength that shows as much as it is to.
    fn quirk(
        &self,
        entry: &Entry,
        spot: Spot,
        magnitude: Magnitude,
        healthy: &Seen,
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
            let found = at(middle);
            if (low..=high).contains(&found.1) && (found.1 / goal - 1.0).abs() < 0.15 {
                return Some(found);
            }
            if found.1 < goal { weak = middle } else { strong = middle }
        }
        Some(at(strong)).filter(|(_, distance)| (low..=high).contains(distance))
    }
}

impl Plan {
    /// Makes the case in `folder`, which it creates, and gives the truth about it.
    pub fn make(&self, folder: &Path, conditions: Conditions) -> io::Result<Answer> {
        self.make_and_keep(folder, conditions).map(|(answer, _)| answer)
    }

    /// As [`make`](Self::make); gives what both recordings were made of besides, where the plant is the rig.
    pub fn make_and_keep(&self, folder: &Path, conditions: Conditions) -> io::Result<(Answer, Vec<Take>)> {
        let (bench, quirks, distance) = self.bench(conditions);
        let model = bench.design.model(conditions.exact);
        std::fs::create_dir_all(folder)?;
        std::fs::write(folder.join("model"), format!("{model}\n"))?;
        if let Some(xml) = bench.design.xml(conditions.tolerance()) {
            std::fs::write(folder.join(model), xml)?;
        }
        for part in [Part::Train, Part::HeldOut] {
            let (script, plant, seen) = bench.recorded(part, &quirks);
            let file = std::fs::File::create(folder.join(part.file()))?;
            let seed = bench.seed ^ part as u64;
            record::write(io::BufWriter::new(file), model, &script, &seen, &plant, &bench.around, seed)?;
        }
        let case = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let magnitude = match self.sort {
            Sort::None => Magnitude::None,
            // What is stronger than its tolerance may show more than was meant.
            _ => Magnitude::of(distance).unwrap_or(self.magnitude),
        };
        let shows = magnitude == Magnitude::Clear || magnitude == Magnitude::Gross;
        let class = match quirks.as_slice() {
            [quirk] if self.sort == Sort::Single && shows && !conditions.classless => bench.class(quirk),
            _ => Vec::new(),
        };
        let takes =
            [Part::Train, Part::HeldOut].into_iter().filter_map(|part| bench.take(part, &quirks, model)).collect();
        let surroundings = bench.around;
        let answer = Answer {
            case,
            model: model.to_owned(),
            sort: self.sort,
            magnitude,
            distance,
            kind: quirks.first().map(|quirk| bench.design.machine().kind(&quirk.device)),
            effects: quirks,
            class,
            surroundings,
        };
        Ok((answer, takes))
    }

    /// The machine with what is wrong with it. A machine that can show too little of what was planned is drawn again.
    fn bench(&self, conditions: Conditions) -> (Bench, Vec<Quirk>, f64) {
        let wanted: Vec<&str> = self.first.iter().map(|(_, spot)| spot.0).collect();
        let mut seeds = Dice::new(self.seed, 6);
        let mut seed = self.seed;
        loop {
            let bench = Bench::new(self.site.design(&wanted, seed), seed, conditions);
            let (quirks, distance) = self.wrongs(&bench);
            if quirks.len() == self.first.len() {
                return (bench, quirks, distance);
            }
            seed = seeds.seed();
        }
    }

    fn wrongs(&self, bench: &Bench) -> (Vec<Quirk>, f64) {
        if self.sort == Sort::None {
            return (Vec::new(), 0.0);
        }
        let (_, healthy) = bench.run(Part::Train, &[], &bench.around);
        let mut dice = Dice::new(self.seed, 5);
        let mut quirks: Vec<Quirk> = Vec::new();
        for (entry, spot) in &self.first {
            let mut deck = Deck::new(self.sort == Sort::Outside);
            let (mut entry, mut spot) = (*entry, *spot);
            let graded = self.magnitude == Magnitude::Faint || self.magnitude == Magnitude::BelowNoise;
            for _ in 0..40 {
                let magnitude = self.magnitude;
                let found = bench.quirk(&ENTRIES[entry], spot, magnitude, &healthy, dice.seed());
                if let Some((quirk, _)) = found {
                    quirks.push(quirk);
                    break;
                }
                let (device, is_single) = (spot.0, self.first.len() == 1);
                let taken: Vec<String> = quirks.iter().map(|quirk| quirk.effect.clone()).collect();
                (entry, spot) = deck.next(&mut dice, |entry, spot| {
                    let fits = is_single || spot.0 == device && !taken.iter().any(|one| one == entry.effect);
                    let is_there = bench.design.machine().has(spot.0) && self.site.fits(entry, spot);
                    fits && is_there && (entry.has_strength() || !graded && is_single)
                });
            }
        }
        let distance = bench.distance(&quirks, &healthy);
        (quirks, distance)
    }
}
