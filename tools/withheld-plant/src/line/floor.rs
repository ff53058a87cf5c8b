//! What lies on the belts of the line: parts that ride, are handed on, pushed out, and cut beams.
//!
//! A part is carried by the belt under its centre; between two belts side by side by the one that has more of it. On a curve it stands
//! along the tangent at its centre, so that a beam, which is a ray from the curve's middle, first meets its inner corner: at the
//! angle atan(h/(R − w)) before its centre, with half its length h and width w.

use std::f64::consts::FRAC_PI_2;

use crate::chance::Dice;
use crate::plant::Entry;
use crate::sensor::Along;

/// A belt's place in the line.
#[derive(Clone, Debug)]
pub struct Bed {
    pub length: f64,
    /// Of the centre line, where it is a curve.
    pub radius: Option<f64>,
    pub barriers: [f64; 2],
    /// The belt that follows it.
    pub next: Option<usize>,
    /// What its sensors add, and how much of a part they miss at either end.
    pub beams: [Along; 2],
    pub hidden: [f64; 2],
    /// How far it went in this step, and altogether.
    pub way: f64,
    pub travel: f64,
}

/// A pusher's plate beside a belt, and the exit on the other side.
#[derive(Clone, Debug)]
pub struct Plate {
    pub belt: usize,
    /// Its middle, from the belt's start.
    pub middle: f64,
    pub exit: usize,
    /// How much further from its start the same place is on the belt than on the exit.
    pub ahead: f64,
    /// How far it is out.
    pub out: f64,
    /// Whether its two beams are cut.
    pub cut: [bool; 2],
}

/// Half a plate's width; where a plate meets a box in the middle of the belt, and where its two beams cross its way, seen from that
/// belt's centre line; from where on more of a box is over the exit; the exit's centre line. All in m.
const HALF_PLATE: f64 = 0.2;
const FACE: f64 = -0.35;
const BEAMS: [f64; 2] = [0.0, 0.65];
const CHANGES_OVER: f64 = 0.325;
const EXIT: f64 = 0.65;
/// Half the width of a loose box.
const HALF_WIDTH: f64 = 0.15;

/// Something that lies on a belt.
#[derive(Clone, Debug)]
struct Part {
    belt: usize,
    /// Its centre along the belt, and from the centre line of the belt before the pushers to the left.
    at: f64,
    across: f64,
    half: f64,
}

/// A station that puts boxes on a belt.
#[derive(Clone, Debug)]
struct Bay {
    belt: usize,
    at: f64,
    half: f64,
    due: f64,
    next: f64,
    interval: f64,
    spread: f64,
}

/// Belts, plates and everything that lies on the belts.
#[derive(Clone, Debug)]
pub struct Floor {
    pub beds: Vec<Bed>,
    pub plates: Vec<Plate>,
    parts: Vec<Part>,
    bays: Vec<Bay>,
    dice: Dice,
    /// What the belts have handed on so far.
    handed_on: Vec<Entry>,
    /// What belts that are not there are still to hand on to those that are, the last first.
    coming: Vec<Entry>,
    /// Whether a belt is there; what comes onto another is gone.
    is_kept: Vec<bool>,
}

impl Floor {
    /// With nothing on it.
    pub fn new(beds: Vec<Bed>, plates: Vec<Plate>, seed: u64) -> Floor {
        let is_kept = vec![true; beds.len()];
        let (handed_on, coming) = (Vec::new(), Vec::new());
        let dice = Dice::new(seed, 12);
        Floor { beds, plates, parts: Vec::new(), bays: Vec::new(), dice, handed_on, coming, is_kept }
    }

    /// What the belts have handed on so far, in order.
    pub fn handed_on(&self) -> &[Entry] {
        &self.handed_on
    }

    /// With these belts alone: what others hand on to them comes as in `entries`.
    pub fn confine(&mut self, is_kept: Vec<bool>, entries: &[Entry]) {
        self.parts.retain(|part| is_kept[part.belt]);
        self.bays.retain(|bay| is_kept[bay.belt]);
        let hands_on = |belt: usize| (0..is_kept.len()).any(|from| is_kept[from] && self.beds[from].next == Some(belt));
        self.coming =
            entries.iter().rev().filter(|entry| is_kept[entry.belt] && !hands_on(entry.belt)).copied().collect();
        self.is_kept = is_kept;
    }

    /// Puts a part of so much half length on a belt, m.
    pub fn put(&mut self, belt: usize, at: f64, half: f64) {
        let across = if self.plates.iter().any(|plate| plate.exit == belt) { EXIT } else { 0.0 };
        self.parts.push(Part { belt, at, across, half });
    }

    /// A station that puts a box at `at` when one is due and the place is free: first at `first`, then each `interval`, each later by
    /// up to `spread`, s.
    pub fn feed(&mut self, belt: usize, at: f64, half: f64, [first, interval, spread]: [f64; 3]) {
        let due = first + self.dice.between(0.0, spread);
        self.bays.push(Bay { belt, at, half, due, next: first + interval, interval, spread });
    }

    /// What the beams see before anything has moved.
    pub fn settle(&mut self) {
        self.push();
        self.look();
    }

    /// How many parts lie on a belt.
    pub fn load(&self, belt: usize) -> usize {
        self.parts.iter().filter(|part| part.belt == belt).count()
    }

    /// Whether a barrier of a belt reports to be cut.
    pub fn is_cut(&self, belt: usize, barrier: usize) -> bool {
        self.beds[belt].beams[barrier].is_on()
    }

    /// Moves everything on until `now`, the belts having moved.
    pub fn advance(&mut self, now: f64, span: f64) {
        self.supply(now);
        self.carry(now);
        self.receive(now, span);
        self.push();
        self.look();
    }

    fn supply(&mut self, now: f64) {
        for bay in &mut self.bays {
            if now < bay.due {
                continue;
            }
            bay.due = bay.next + self.dice.between(0.0, bay.spread);
            bay.next += bay.interval;
            let is_free = |part: &Part| part.belt != bay.belt || (part.at - bay.at).abs() >= part.half + bay.half;
            if self.parts.iter().all(is_free) {
                self.parts.push(Part { belt: bay.belt, at: bay.at, across: 0.0, half: bay.half });
            }
        }
    }

    fn carry(&mut self, now: f64) {
        let Floor { beds, plates, handed_on, is_kept, .. } = self;
        for part in &mut self.parts {
            let bed = &beds[part.belt];
            let before = part.at;
            part.at += bed.way;
            // A plate that is out holds what comes up beside it.
            let holds = |plate: &&Plate| {
                let side = plate.middle - HALF_PLATE - part.half;
                plate.belt == part.belt && part.across == 0.0 && plate.out > 0.2 && before <= side && part.at > side
            };
            if plates.iter().any(|plate| holds(&plate)) {
                part.at = before;
            }
            if part.at > bed.length
                && let Some(next) = bed.next
            {
                part.at -= bed.length;
                part.belt = next;
                let Part { belt, at: place, across, half } = *part;
                handed_on.push(Entry { at: now, belt, place, across, half });
            }
        }
        self.parts.retain(|part| is_kept[part.belt] && (0.0..=beds[part.belt].length).contains(&part.at));
    }

    /// What comes from belts that are not there. What came within the step has gone on since.
    fn receive(&mut self, now: f64, span: f64) {
        while let Some(&Entry { at, belt, place, across, half }) = self.coming.last().filter(|entry| entry.at <= now) {
            self.coming.pop();
            let since = ((now - at) / span).min(1.0);
            self.parts.push(Part { belt, at: place + since * self.beds[belt].way, across, half });
        }
    }

    fn push(&mut self) {
        for plate in &mut self.plates {
            let face = FACE + plate.out;
            for part in &mut self.parts {
                let from_middle = match part.belt {
                    belt if belt == plate.belt => part.at - plate.middle,
                    belt if belt == plate.exit => part.at + plate.ahead - plate.middle,
                    _ => continue,
                };
                if from_middle.abs() >= HALF_PLATE + part.half {
                    continue;
                }
                part.across = part.across.max(face + HALF_WIDTH);
                if part.belt == plate.belt && part.across > CHANGES_OVER {
                    part.belt = plate.exit;
                    part.at -= plate.ahead;
                }
            }
            plate.cut = BEAMS.map(|beam| {
                self.parts.iter().any(|part| {
                    let from_middle = match part.belt {
                        belt if belt == plate.belt => part.at - plate.middle,
                        belt if belt == plate.exit => part.at + plate.ahead - plate.middle,
                        _ => return false,
                    };
                    from_middle.abs() < HALF_PLATE + part.half && (part.across - beam).abs() < HALF_WIDTH
                })
            });
        }
    }

    fn look(&mut self) {
        let mut cut = vec![[false; 2]; self.beds.len()];
        for part in &self.parts {
            let bed = &self.beds[part.belt];
            let reach = match bed.radius {
                Some(radius) => radius * (part.half / (radius - HALF_WIDTH)).atan(),
                None => part.half,
            };
            sees(&mut cut[part.belt], bed, part.at, reach);
            // With its centre already on this belt it may still lie in a beam of the one before.
            let before = part.belt.checked_sub(1).filter(|before| self.beds[*before].next == Some(part.belt));
            let Some(before) = before.filter(|_| part.at < part.half) else { continue };
            let bed = &self.beds[before];
            sees(&mut cut[before], bed, bed.length + part.at, part.half);
        }
        for (bed, cut) in self.beds.iter_mut().zip(cut) {
            bed.beams.iter_mut().zip(cut).for_each(|(beam, cut)| beam.see(cut, bed.travel));
        }
    }
}

/// Marks the barriers of a bed that are cut by what reaches so far either way from `at`.
fn sees(cut: &mut [bool; 2], bed: &Bed, at: f64, reach: f64) {
    for ((cut, barrier), hidden) in cut.iter_mut().zip(bed.barriers).zip(bed.hidden) {
        *cut |= (at - barrier).abs() < reach - hidden;
    }
}

/// The length of the centre line of a quarter of a circle.
pub fn quarter(radius: f64) -> f64 {
    radius * FRAC_PI_2
}
