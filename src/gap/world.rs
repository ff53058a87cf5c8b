//! What surrounds a device that stands alone: the parts that pass it.
//!
//! Nobody recorded where parts are; what was recorded is when they cut a beam. The first barrier that sees a part is an input:
//! from there on the part moves with the belt of the model, behind its end with the belt there as that reported, and its next edges
//! are predicted. Whatever cannot be predicted from these (a box that a robot set down, one that a pusher took away in the middle
//! of a beam) is played back as it was recorded.

use std::sync::Arc;

use super::lane::{Lane, Rider, Step};
use super::prediction::{Passing, Turn};
use super::way::Way;
use crate::device::law::follower::Slider;
use crate::device::path::STRETCH_S;
use crate::device::{Belt, Device, Role, Surroundings};

/// What a run does to a device from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Script {
    /// Of a belt: every cut of a beam, in the order in which they begin to matter.
    pub cuts: Vec<Cut>,
    /// Beams and seals as they were recorded, in the order of time.
    pub told: Vec<Told>,
    /// Of a belt: itself among its neighbours.
    pub(super) lane: Arc<Lane>,
    /// The way by which its cuts were read.
    pub(super) way: Arc<Way>,
    /// Where the beams are that the cuts were read from, m from the belt's start.
    pub beams: [Option<f64>; 2],
    /// The parts that the belt brings back to a beam.
    pub back: Vec<usize>,
    /// Of a belt that a bay alone feeds: when parts are due, s, and how far their fronts are from the belt's start then, m.
    pub put: Vec<f64>,
    pub put_front: Option<f64>,
}

/// By how much a part may seem to have gone past the belt's end that it brings back, m: as far as tolerances put where it is.
pub(super) const PAST_M: f64 = 0.02;

/// Whether two lengths of parts are one.
pub(super) fn is_one_length(one: f64, other: f64) -> bool {
    const SAME_M: f64 = 1e-6;
    (one - other).abs() < SAME_M
}

impl Script {
    /// Whether a bay puts the part of a cut so near to the beam that this sees it at once.
    fn is_put_into_the_beam(&self, cut: &Cut) -> bool {
        const NEAR_M: f64 = 0.03;
        cut.is_known && self.put_front.is_some_and(|front| front > cut.front - NEAR_M)
    }

    /// The same with the parts of one length, m, being of another, and those that a bay put with their middles `at`, m from the
    /// belt's start. What it puts into the beam is seen at once, its front being past it.
    pub(super) fn with_parts_of(&self, declared: f64, made: f64, at: f64) -> Arc<Script> {
        let mut other = self.clone();
        for cut in other.cuts.iter_mut().filter(|cut| is_one_length(cut.length, declared)) {
            cut.length = made;
            let past = if cut.is_known { (at + 0.5 * made - cut.front).max(0.0) } else { 0.0 };
            cut.front += past;
            cut.ahead -= past;
        }
        Arc::new(other)
    }
}

/// A beam or a seal is told to be so from now on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Told {
    pub at: f64,
    pub what: Surrounding,
    pub is_on: bool,
}

/// What can be told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surrounding {
    BarrierA,
    BarrierB,
    Sealed,
    /// So many actuators of others on its supply move.
    Others(u32),
    /// So many parts weigh on it that are not on their way through its beams: what its grippers hold, or what has come onto a belt and not yet
    /// to its first beam.
    Held(u32),
}

/// A part passes a beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// Which part, of all that the belt's barriers saw.
    pub part: usize,
    /// 0: barrier A; 1: barrier B.
    pub beam: usize,
    /// From when on the part moves with the belt, s: its first edge.
    pub from: f64,
    /// How far its front is from the beam then, m of the belt's way.
    pub ahead: f64,
    /// Where its front is then, m from the belt's start.
    pub front: f64,
    /// Which way the belt runs: 1 or -1.
    pub way: f64,
    /// How long it is along the belt, m; infinite where that is not known.
    pub length: f64,
    /// Whether that is told by the bay that put it, and no choice among the plant's parts.
    pub is_known: bool,
    /// When it leaves the beam by other hands than the belt's, s; nothing if the belt carries it out.
    pub taken: Option<f64>,
}

/// A span in which nothing about a device jumps, and the instant behind it at which something may.
pub(super) struct Leg {
    /// The device as it was at `from`.
    pub device: Box<dyn Device>,
    pub from: f64,
    /// Until here its surroundings stayed as they were at `from`.
    pub to: f64,
    /// Here they may be others: `to`, or next to it.
    pub until: f64,
}

/// How far behind a beam a part is forgotten, m.
const GONE_M: f64 = 0.05;
/// How near to a beam an edge of a part is that only just does not come to it, m.
const NEARLY_M: f64 = 0.02;
/// How often the instant of a crossing is halved.
const HALVINGS: u32 = 30;

/// A script being played.
#[derive(Clone, Debug)]
pub(super) struct World {
    script: Arc<Script>,
    next_cut: usize,
    next_told: usize,
    /// The cuts that matter now.
    active: Vec<Cut>,
    /// The parts that are there.
    riders: Vec<Rider>,
    /// How what came last and no beam has seen slides on its way to the first.
    unseen: Slider,
    next_put: usize,
    /// Which way the belt went last: 1 or -1, 0 before it has.
    towards: f64,
    /// Where it turned with an edge of a part next to a beam.
    turns: [Vec<Turn>; 2],
    /// How many of them are held back.
    queued: u32,
    told: Surroundings,
    /// How many of them the device was told of.
    shown_queue: u32,
    /// How many weigh on the device, as it was told.
    shown_here: u32,
    /// How much further from each other than the script has them the beams of this device are, m.
    apart: f64,
    beams: [bool; 2],
    /// The part that changed each beam last.
    pub last: [Option<Passing>; 2],
}

impl World {
    /// The world at t = 0; `None` where nothing passes.
    pub fn new(script: &Arc<Script>) -> Option<World> {
        let is_empty = script.cuts.is_empty() && script.told.is_empty();
        (!is_empty).then(|| World {
            script: script.clone(),
            next_cut: 0,
            next_told: 0,
            active: Vec::new(),
            riders: Vec::new(),
            unseen: Slider::default(),
            next_put: 0,
            towards: 0.0,
            turns: Default::default(),
            queued: 0,
            shown_queue: 0,
            shown_here: 0,
            told: Surroundings::default(),
            apart: 0.0,
            beams: [false; 2],
            last: [None; 2],
        })
    }

    /// Shows the device what is so at t = 0.
    pub fn begin(&mut self, device: &mut dyn Device) {
        let between = |[first, second]: [Option<f64>; 2]| Some(second? - first?);
        if matches!(device.role(), Role::Carries(_)) {
            // A belt says what it gives its parts once it has moved.
            device.advance(0.0);
        }
        if let Role::Carries(belt) = device.role() {
            let both = between(belt.barriers).zip(between(self.script.beams));
            self.apart = both.map_or(0.0, |(here, there)| here - there);
        }
        self.read(device, 0.0);
    }

    /// When the script goes on by itself.
    fn next(&self) -> Option<f64> {
        let cut = self.script.cuts.get(self.next_cut).map(|cut| cut.from);
        let told = self.script.told.get(self.next_told).map(|told| told.at);
        let taken = self.active.iter().filter_map(|cut| cut.taken).min_by(f64::total_cmp);
        [cut, told, taken].into_iter().flatten().min_by(f64::total_cmp)
    }

    /// Until when at least the device is shown nothing new: with a part on it, that is not known.
    pub fn quiet_until(&self, now: f64) -> f64 {
        let is_empty = self.active.is_empty() && self.riders.is_empty();
        if is_empty { self.next().unwrap_or(f64::INFINITY) } else { now }
    }

    /// Moves a device and the parts on it to `until`, from `now`. Whether no part came to a beam or left it, or the belt, on the way: if one
    /// did, device and world are spoilt, and have to be moved from their state before once more, in legs.
    pub fn advance(&mut self, device: &mut Box<dyn Device>, mut now: f64, until: f64) -> bool {
        while now < until {
            let stop = self.stop(now, until);
            self.carry(device.as_mut(), now, stop);
            if !self.is_as_shown() {
                return false;
            }
            now = stop;
            self.read(device.as_mut(), now);
        }
        true
    }

    /// Moves a device and the parts on it to `until`, from `now`; it sees every change of a beam at its instant.
    pub fn advance_in_legs(&mut self, device: &mut Box<dyn Device>, mut now: f64, until: f64) -> Vec<Leg> {
        let mut legs = Vec::new();
        while now < until {
            let leg = self.leg(device, now, self.stop(now, until));
            now = leg.until;
            legs.push(leg);
            self.read(device.as_mut(), now);
        }
        legs
    }

    /// How far a device may be moved from `now` until the script goes on.
    fn stop(&self, now: f64, until: f64) -> f64 {
        self.next().filter(|at| *at > now).map_or(until, |at| at.min(until))
    }

    /// Moves the device, and the parts on it with it.
    fn carry(&mut self, device: &mut dyn Device, now: f64, until: f64) {
        let mut from = now;
        while from < until {
            // How parts slide is only known from one instant to the next.
            let slides = matches!(device.role(), Role::Carries(belt) if belt.grip.is_finite());
            let to = if slides { until.min(from + STRETCH_S) } else { until };
            device.advance(to - from);
            let Role::Carries(belt) = device.role() else { return };
            let Belt { displacement: way, speeds, transfer_slip: slip, grip, .. } = *belt;
            let step = Step { from, to, way, speeds, slip, grip };
            if slides {
                self.slide_unseen(&step);
            }
            if !self.riders.is_empty() {
                self.queued = self.script.lane.carry_all(&mut self.riders, &step);
            }
            self.note_turns(&step);
            from = to;
        }
    }

    /// Notes where the belt turned with an edge of a part next to a beam.
    fn note_turns(&mut self, step: &Step) {
        let (before, now) = (self.towards, if step.way == 0.0 { self.towards } else { step.way.signum() });
        self.towards = now;
        if before * now >= 0.0 {
            return;
        }
        let slope = (step.speeds[1] - step.speeds[0]).abs() / (step.to - step.from).max(1e-9);
        let near = |(cut, rider): (&Cut, &Rider)| {
            let (progress, came) = (cut.way * rider.gone - cut.ahead, cut.way * before);
            let is_in = progress > 0.0 && progress < cut.length;
            // To the edge that comes next, as it went before it turned.
            let short = if is_in == (came > 0.0) { cut.length - progress } else { progress };
            let short = if is_in { short } else { -short };
            let turn = Turn { at: step.to, part: cut.part, to: f64::from(u8::from(!is_in)), short, slope, way: came };
            ((0.0..NEARLY_M).contains(&short) && !self.script.lane.has_left(rider)).then_some((cut.beam, turn))
        };
        let turned: Vec<(usize, Turn)> = self.passing().filter_map(near).collect();
        turned.into_iter().for_each(|(beam, turn)| self.turns[beam].push(turn));
    }

    /// Where the belt turned with an edge of a part next to a beam.
    pub fn turns(&self, beam: usize) -> Vec<Turn> {
        self.turns[beam].clone()
    }

    /// Lets what no beam has seen slide, as one that is put there takes the belt's speed.
    fn slide_unseen(&mut self, step: &Step) {
        while self.script.put.get(self.next_put).is_some_and(|at| *at <= step.from) {
            self.next_put += 1;
            self.unseen = Slider::default();
        }
        self.unseen.ride(step.grip, &step.stretch());
    }

    /// Moves on to `until`, or to the first crossing of a beam or an end.
    fn leg(&mut self, device: &mut Box<dyn Device>, now: f64, until: f64) -> Leg {
        let (start, before) = (device.clone(), self.clone());
        self.carry(device.as_mut(), now, until);
        if self.is_as_shown() {
            return Leg { device: start, from: now, to: until, until };
        }
        let (mut low, mut high) = (0.0, until - now);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            self.be_again(&before);
            self.carry(start.clone().as_mut(), now, now + middle);
            if self.is_as_shown() { low = middle } else { high = middle }
        }
        *device = start.clone();
        self.be_again(&before);
        self.carry(device.as_mut(), now, now + high);
        self.crossed(device.as_mut());
        Leg { device: start, from: now, to: now + low, until: now + high }
    }

    /// Takes back what [`World::carry`] has done since `before`.
    fn be_again(&mut self, before: &World) {
        self.riders.clone_from(&before.riders);
        (self.unseen, self.next_put, self.queued) = (before.unseen, before.next_put, before.queued);
        self.towards = before.towards;
        self.turns.iter_mut().zip(&before.turns).for_each(|(turns, before)| turns.truncate(before.len()));
    }

    /// Reads on in the script up to `now`, and shows the device what has changed.
    fn read(&mut self, device: &mut dyn Device, now: f64) {
        let mut news = false;
        while let Some(cut) = self.script.cuts.get(self.next_cut).filter(|cut| cut.from <= now) {
            self.active.push(self.moved(cut));
            let past = if self.script.back.contains(&cut.part) { PAST_M } else { 0.0 };
            let slider = if self.script.is_put_into_the_beam(cut) { Slider::default() } else { self.unseen };
            put_on(&mut self.riders, cut, past, slider);
            self.next_cut += 1;
            news = true;
        }
        while let Some(told) = self.script.told.get(self.next_told).filter(|told| told.at <= now) {
            match told.what {
                Surrounding::BarrierA => self.told.barrier_a = told.is_on,
                Surrounding::BarrierB => self.told.barrier_b = told.is_on,
                Surrounding::Sealed => self.told.sealed = told.is_on,
                Surrounding::Others(count) => device.share(count),
                Surrounding::Held(count) => self.told.parts = count,
            }
            self.next_told += 1;
            news = true;
        }
        let before = (self.active.len(), self.riders.len());
        self.forget(now);
        if news || before != (self.active.len(), self.riders.len()) || self.queued != self.shown_queue {
            self.crossed(device);
        }
    }

    /// Forgets what is over by `now`: cuts that are past, and parts of which nothing is to come.
    fn forget(&mut self, now: f64) {
        let (riders, lane) = (&mut self.riders, &self.script.lane);
        let is_taken = |cut: &&Cut| cut.taken.is_some_and(|taken| taken <= now);
        let taken: Vec<usize> = self.active.iter().filter(is_taken).map(|cut| cut.part).collect();
        riders.retain(|rider| !taken.contains(&rider.part));
        self.active.retain(|cut| {
            let rider = riders.iter().find(|rider| rider.part == cut.part);
            // A belt that turns brings back what is on it still.
            let is_behind = |rider: &Rider| cut.way * rider.gone >= cut.ahead + cut.length + GONE_M;
            let is_past = |rider: &Rider| is_behind(rider) && !lane.bears(rider) || lane.has_left(rider);
            cut.taken.is_none_or(|taken| taken > now) && rider.is_some_and(|rider| !is_past(rider))
        });
        let active = &self.active;
        riders.retain(|rider| active.iter().any(|cut| cut.part == rider.part) || lane.bears(rider));
    }

    /// A cut as this device's beams have it: a part is first seen by one, and comes to the other so much later or sooner.
    fn moved(&self, cut: &Cut) -> Cut {
        let of_part = self.script.cuts.iter().filter(|other| other.part == cut.part);
        let first = of_part.min_by(|a, b| a.ahead.abs().total_cmp(&b.ahead.abs())).map_or(cut.beam, |first| first.beam);
        let further = self.apart * (cut.beam as f64 - first as f64);
        Cut { ahead: cut.ahead + cut.way * further, ..*cut }
    }

    /// Whether beams are, and as many parts weigh on the device, as it was told last.
    fn is_as_shown(&self) -> bool {
        (self.active.is_empty() || self.cut() == self.beams) && self.here() == self.shown_here
    }

    /// How many parts weigh on the device: those on their way to another no more once their middles are there.
    fn here(&self) -> u32 {
        let lane = &self.script.lane;
        self.riders.iter().filter(|rider| !lane.is_beyond(rider) && !lane.has_left(rider)).count() as u32
    }

    /// The beams as they are now.
    fn cut(&self) -> [bool; 2] {
        let mut beams = [self.told.barrier_a, self.told.barrier_b];
        for (cut, rider) in self.passing() {
            let progress = cut.way * rider.gone - cut.ahead;
            beams[cut.beam] |= progress > 0.0 && progress < cut.length && !self.script.lane.has_left(rider);
        }
        beams
    }

    /// The cuts that matter now, each with its part.
    fn passing(&self) -> impl Iterator<Item = (&Cut, &Rider)> {
        self.active.iter().filter_map(|cut| Some((cut, self.riders.iter().find(|rider| rider.part == cut.part)?)))
    }

    fn crossed(&mut self, device: &mut dyn Device) {
        let beams = self.cut();
        let speed = match device.role() {
            Role::Carries(belt) => belt.speeds[1],
            _ => 0.0,
        };
        for (beam, is_cut) in beams.into_iter().enumerate() {
            if is_cut != self.beams[beam] {
                // The part that is nearest to an edge of its own at that beam.
                let near = |(cut, rider): (&Cut, &Rider)| {
                    let progress = cut.way * rider.gone - cut.ahead;
                    let leaves = if self.script.lane.has_left(rider) { 0.0 } else { f64::INFINITY };
                    // Sooner at the end of this belt is sooner behind it.
                    let was_here = rider.speed > 0.0 && self.script.lane.is_beyond(rider);
                    let own = rider.slider.velocity().unwrap_or(speed);
                    let speed = if was_here { rider.speed } else { cut.way * own };
                    let passing = Passing { part: cut.part, speed, astray: rider.astray() };
                    (progress.abs().min((progress - cut.length).abs()).min(leaves), passing)
                };
                let here = self.passing().filter(|(cut, _)| cut.beam == beam).map(near);
                let nearest = here.min_by(|a, b| a.0.total_cmp(&b.0));
                self.last[beam] = nearest.map(|(_, passing)| passing);
            }
        }
        self.beams = beams;
        self.shown_queue = self.queued;
        let [barrier_a, barrier_b] = beams;
        let Surroundings { sealed, parts: held, .. } = self.told;
        self.shown_here = self.here();
        device.sense(&Surroundings {
            barrier_a,
            barrier_b,
            sealed,
            parts: held + self.shown_here,
            queued: self.queued,
            ..Surroundings::default()
        });
    }
}

/// Puts the part of a cut on the belt, if it is not there.
fn put_on(riders: &mut Vec<Rider>, cut: &Cut, past: f64, slider: Slider) {
    let centre = |length: f64| if length.is_finite() { cut.front - 0.5 * cut.way * length } else { cut.front };
    match riders.iter_mut().find(|rider| rider.part == cut.part) {
        // One of its cuts may say how long it is where the other does not.
        Some(rider) if rider.length.is_infinite() && cut.length.is_finite() => {
            rider.centre = centre(cut.length) + rider.gone;
            rider.length = cut.length;
        }
        Some(_) => {}
        None => {
            let (part, length) = (cut.part, cut.length);
            let centre = centre(length);
            riders.push(Rider { past, slider, ..Rider::new(part, centre, length) });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effect;
    use crate::gap::lane::{Beyond, End};
    use crate::plant::{EffectPlace, EffectSpec, ParameterValue};

    /// A part that a bay put at 0.15 m with its front at the beam at 0.3 m: 40 mm longer it is 20 mm past it, and reaches the next so much
    /// sooner; 40 mm shorter it is seen when its front comes there.
    #[test]
    fn what_a_bay_puts_into_a_beam_is_past_it() {
        let cut = Cut {
            part: 0,
            beam: 1,
            from: 1.0,
            ahead: 1.4,
            front: 0.3,
            way: 1.0,
            length: 0.3,
            is_known: true,
            taken: None,
        };
        let script = Script { cuts: vec![cut, Cut { length: 0.2, ..cut }], ..Script::default() };
        let longer = script.with_parts_of(0.3, 0.34, 0.15).cuts[0];
        assert!((longer.front - 0.32).abs() < 1e-12 && (longer.ahead - 1.38).abs() < 1e-12, "{longer:?}");
        let other = script.with_parts_of(0.3, 0.26, 0.15);
        assert_eq!(other.cuts, [Cut { length: 0.26, ..cut }, Cut { length: 0.2, ..cut }]);
    }

    /// A part that another hand takes at 2 s is on the belt no longer; one that the belt is to carry stays, also while it stands.
    #[test]
    fn what_was_taken_weighs_no_more() {
        let cut = |part: usize, taken: Option<f64>| Cut {
            part,
            beam: 0,
            from: 1.0,
            ahead: 0.0,
            front: 0.3,
            way: 1.0,
            length: 0.3,
            is_known: false,
            taken,
        };
        let lane = Arc::new(Lane { length: 2.0, shares: false, ends: Default::default() });
        let script = Script { cuts: vec![cut(0, Some(2.0)), cut(1, None)], lane, ..Script::default() };
        let mut world = World::new(&Arc::new(script)).expect("something passes");
        let mut device = crate::device::bench::Bench::new("kinetwin.StraightConveyor", &[]).device;
        world.begin(device.as_mut());
        let parts = |world: &World| world.riders.iter().map(|rider| rider.part).collect::<Vec<_>>();
        assert!(parts(&world).is_empty());
        assert!(world.advance(&mut device, 0.0, 1.0));
        assert_eq!(parts(&world), [0, 1]);
        world.advance(&mut device, 1.0, 1.9);
        assert_eq!(parts(&world), [0, 1]);
        world.advance(&mut device, 1.9, 2.1);
        assert_eq!(parts(&world), [1]);
    }

    /// A belt at 0.5 m/s that takes 0.5 s to stop, where friction gives parts 0.25 m/s². One that is in the beam from 1 s on goes on for 2 s and 0.5 m after
    /// the belt was told to stop, the belt for 0.125 m; one that is put into the beam when that stands stays where it is. Where the first has left the beam
    /// meanwhile, and when that was is sought by halving, the others go as far.
    #[test]
    fn parts_slide_on_where_their_belt_stops() {
        let cut = |part: usize, from: f64, length: f64, is_known: bool| Cut {
            part,
            beam: 0,
            from,
            ahead: 0.0,
            front: 0.3,
            way: 1.0,
            length,
            is_known,
            taken: None,
        };
        let bench = crate::device::bench::Bench::new("kinetwin.StraightConveyor", &[("acceleration", "1")]);
        let slip = EffectSpec {
            place: EffectPlace::Process,
            kind: "part-slip".to_owned(),
            component: None,
            parameters: [("acceleration".to_owned(), ParameterValue::Number(0.25))].into(),
        };
        for length in [5.0, 0.6] {
            let cuts = vec![cut(0, 1.0, length, false), cut(1, 2.6, 5.0, true), cut(2, 2.6, 5.0, false)];
            let script = Script { cuts, put_front: Some(0.3), ..Script::default() };
            let mut world = World::new(&Arc::new(script)).expect("something passes");
            let mut device =
                effect::build(bench.kind, &bench.parameters, "Belt", std::slice::from_ref(&slip), 1).expect("a belt");
            world.begin(device.as_mut());
            let mut go = |device: &mut Box<dyn Device>, from: f64, to: f64| {
                world.advance_in_legs(device, from, to);
                let gone = |part: usize| world.riders.iter().find(|rider| rider.part == part).map(|rider| rider.gone);
                [gone(0), gone(1), gone(2)]
            };
            device.command(0, 0.5);
            device.command(1, 1.0);
            // It does not slip while the belt takes longer than friction for its speed.
            go(&mut device, -2.0, 1.0);
            let started = go(&mut device, 1.0, 2.0);
            device.command(1, 0.0);
            let [first, still, sliding] = go(&mut device, 2.0, 5.0);
            assert!(started[0].is_some_and(|gone| (gone - 0.5).abs() < 1e-9), "{started:?}");
            assert!(first.map_or(length < 1.0, |gone| (gone - 1.0).abs() < 1e-4), "{first:?}");
            // The last came at 2.6 s as one that slid with the first: 1.4 s at 0.35 m/s and falling.
            assert!(
                still == Some(0.0) && sliding.is_some_and(|gone| (gone - 0.245).abs() < 1e-4),
                "{length} {sliding:?}"
            );
        }
    }

    /// A belt at 0.5 m/s that changes its speed by 1 m/s² is told at 2 s to go back: a part that came at 1 s turns at 2.5 s after 0.625 m.
    #[test]
    fn a_part_that_turns_next_to_a_beam_is_told_of() {
        let turns = |length: f64, ahead: f64| {
            let cut =
                Cut { part: 3, beam: 1, from: 1.0, ahead, front: 0.3, way: 1.0, length, is_known: false, taken: None };
            let script = Script { cuts: vec![cut], ..Script::default() };
            let mut world = World::new(&Arc::new(script)).expect("something passes");
            let bench = crate::device::bench::Bench::new("kinetwin.StraightConveyor", &[("acceleration", "1")]);
            let mut device = bench.device;
            world.begin(device.as_mut());
            device.command(0, 0.5);
            device.command(1, 1.0);
            let mut until = |device: &mut Box<dyn Device>, from: f64, to: f64| {
                for step in 0..((to - from) / 0.01).round() as u32 {
                    let now = from + 0.01 * f64::from(step);
                    world.advance_in_legs(device, now, now + 0.01);
                }
            };
            until(&mut device, 0.0, 2.0);
            device.command(1, -1.0);
            until(&mut device, 2.0, 3.0);
            (world.turns(0), world.turns(1))
        };
        let one = |(none, found): (Vec<Turn>, Vec<Turn>)| {
            let [turn] = found[..] else { panic!("{found:?}") };
            let is_so = none.is_empty() && turn.part == 3 && turn.way == 1.0 && (turn.slope - 1.0).abs() < 1e-6;
            assert!(is_so && (turn.at - 2.51).abs() < 0.011, "{turn:?}");
            ((1e3 * turn.short).round(), turn.to)
        };
        // 5 mm before it has left the beam, or comes to it; and 15 mm past either, where it came and goes.
        assert_eq!(one(turns(0.63, 0.0)), (5.0, 0.0));
        assert_eq!(one(turns(0.3, 0.63)), (5.0, 1.0));
        assert!(turns(0.61, 0.0).1.is_empty() && turns(0.3, 0.61).1.is_empty());
    }

    /// Its front goes onto the belt behind at 1.2 s, its middle at 1.5 s, its rear at 1.8 s.
    #[test]
    fn a_part_weighs_until_its_middle_is_on_the_belt_behind() {
        let lane = Lane { length: 2.0, shares: false, ends: [End::Unknown, End::Belt(Beyond::always_at(0.5, 4.0))] };
        let cut = Cut {
            part: 0,
            beam: 1,
            from: 1.0,
            ahead: 0.0,
            front: 1.9,
            way: 1.0,
            length: 0.3,
            is_known: false,
            taken: None,
        };
        let script = Script { cuts: vec![cut], lane: Arc::new(lane), ..Script::default() };
        let mut world = World::new(&Arc::new(script)).expect("something passes");
        let mut belt = crate::device::bench::Bench::new("kinetwin.StraightConveyor", &[("acceleration", "100")]);
        belt.check(&[("velocityTarget", 0.5), ("motorDirection", 1.0)], 1.0, &[]);
        let mut device = belt.device;
        world.begin(device.as_mut());
        world.advance_in_legs(&mut device, 0.0, 1.1);
        assert_eq!((world.shown_here, world.riders.len()), (1, 1));
        assert!(!world.clone().advance(&mut device.clone(), 1.1, 1.7));
        let legs = world.advance_in_legs(&mut device, 1.1, 1.7);
        assert!(legs.iter().any(|leg| (leg.until - 1.5).abs() < 1e-6));
        assert_eq!((world.shown_here, world.riders.len()), (0, 1));
    }

    /// A beam 10 mm further on is reached 10 mm later, whichever way the belt runs; that by which a part was first seen is where it is.
    #[test]
    fn beams_that_are_further_apart_are_reached_later() {
        let cut = |beam: usize, ahead: f64, way: f64| Cut {
            part: 0,
            beam,
            from: 1.0,
            ahead,
            front: 0.0,
            way,
            length: 0.25,
            is_known: false,
            taken: None,
        };
        for (way, cuts) in [(1.0, [cut(0, 0.0, 1.0), cut(1, 1.4, 1.0)]), (-1.0, [cut(1, 0.0, -1.0), cut(0, 1.4, -1.0)])]
        {
            let script = Arc::new(Script { cuts: cuts.to_vec(), ..Script::default() });
            let mut world = World::new(&script).expect("something passes");
            world.apart = 0.01;
            let ahead = cuts.map(|cut| world.moved(&cut).ahead);
            assert!(ahead[0] == 0.0 && (ahead[1] - 1.41).abs() < 1e-12, "{ahead:?} {way}");
        }
    }
}
