//! The lane that a belt is a part of: what carries a part on where this belt ends, and how far a part moves between them.
//!
//! A part moves with the belt that carries most of it: with this one while its centre is on it, then with the one behind, as far
//! as that reported that it went. While it stands on both, the belt that carries it may lose a share of its way.

use super::way::Way;
use crate::device::law::follower::{Slider, Stretch};

/// A belt's length and what lies at its ends.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Lane {
    /// m.
    pub length: f64,
    /// Whether a part on two belts moves with both by their shares of it.
    pub shares: bool,
    /// At its start, at its end.
    pub ends: [End; 2],
}

/// What lies at an end of a belt.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) enum End {
    /// Nobody knows: a part stays this belt's.
    #[default]
    Unknown,
    /// Nothing: a part leaves when its centre passes.
    Open,
    /// Another belt.
    Belt(Beyond),
}

/// A belt behind an end, by what it reported.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Beyond {
    /// How far it has gone away from this belt.
    pub way: Way,
    /// How far behind the end its first beam is, m.
    pub beam: Option<f64>,
    /// When something came to that beam, s.
    pub arrivals: Vec<f64>,
    /// Whether it has no gap of its own: where it has, a part's way on it is taken from when its first beam saw the part.
    pub is_trusted: bool,
}

/// How far a belt's way by a part's two sightings may be from that by its reports, as a factor.
const FACTORS: std::ops::Range<f64> = 0.7..1.4;

impl Beyond {
    /// By what factor it goes further than it reports, by when its first beam saw the part of which it took over at `from` so that
    /// the part's front was `front` behind the end; 1 where it is trusted, or nothing comes near.
    pub fn factor(&self, from: f64, front: f64) -> f64 {
        let Some(way) = self.beam.map(|beam| beam - front).filter(|way| !self.is_trusted && *way > 0.0) else {
            return 1.0;
        };
        let begins = self.way.at(from);
        let seen = self.arrivals.iter().filter(|at| **at > from).map(|at| way / (self.way.at(*at) - begins));
        let near = seen.filter(|factor| FACTORS.contains(factor));
        near.min_by(|a, b| (a - 1.0).abs().total_cmp(&(b - 1.0).abs())).unwrap_or(1.0)
    }
}

/// A part on a lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rider {
    pub part: usize,
    /// Where its centre is, m from the belt's start.
    pub centre: f64,
    /// Along the belt, m; infinite where it is not known, and the part this belt's wherever it is.
    pub length: f64,
    /// How far it has gone since it was first seen, m along the belt.
    pub gone: f64,
    /// By what factor the belt behind goes further than it reports; 0 until that has taken over.
    pub factor: f64,
    /// How far it went on a belt behind, m.
    pub beyond: f64,
    /// How fast this belt last carried it, m/s.
    pub speed: f64,
    /// How it slides on this belt.
    pub slider: Slider,
    /// By how much its middle may be past the belt's end though it has not left, m: a beam sees it again.
    pub past: f64,
}

/// What a belt does in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Step {
    /// From when to when, s.
    pub from: f64,
    pub to: f64,
    /// How far the belt carries what stands on it, m.
    pub way: f64,
    /// How fast the belt is at both, m/s.
    pub speeds: [f64; 2],
    /// Which share of its way a part loses that stands on another belt, too.
    pub slip: f64,
    /// The steepest change of speed that parts follow, m/s²; infinite where none slides.
    pub grip: f64,
}

impl Step {
    /// At an even speed, on a belt on which nothing slips.
    pub fn even(from: f64, to: f64, way: f64) -> Step {
        let speed = way / (to - from).max(1e-9);
        Step { from, to, way, speeds: [speed; 2], slip: 0.0, grip: f64::INFINITY }
    }

    /// What the belt does.
    pub fn stretch(&self) -> Stretch {
        Stretch { way: self.way, speeds: self.speeds, span: self.to - self.from }
    }
}

/// Into how many parts a step is cut where a part is shared by two belts.
const SHARED: u32 = 8;

impl Lane {
    /// Whether a part that left an open end is here no more.
    pub fn has_left(&self, rider: &Rider) -> bool {
        let at_end = self.ends[1] == End::Open && rider.centre > self.length + rider.past && rider.gone > 0.0;
        let at_start = self.ends[0] == End::Open && rider.centre < 0.0 && rider.gone < 0.0;
        rider.length.is_finite() && (at_end || at_start)
    }

    /// Whether a part that no beam is to see any more may still stand in the way, or leaves this belt for one that is known.
    pub fn bears(&self, rider: &Rider) -> bool {
        let is_known = self.ends.iter().any(|end| *end != End::Unknown);
        let is_here = self.share_behind(rider.centre, rider.length) < 1.0 && !self.has_left(rider);
        is_known && rider.length.is_finite() && is_here
    }

    /// Whether the centre of a part is on a belt behind.
    pub fn is_beyond(&self, rider: &Rider) -> bool {
        rider.length.is_finite() && [1.0, -1.0].iter().any(|way| self.behind(rider.centre, *way).is_some())
    }

    /// The belt behind on which a place is; one on the border is where `towards` leads.
    fn behind(&self, centre: f64, towards: f64) -> Option<(&Beyond, f64)> {
        let is_past = |past: f64, towards: f64| past > 0.0 || past == 0.0 && towards > 0.0;
        match &self.ends {
            [_, End::Belt(beyond)] if is_past(centre - self.length, towards) => Some((beyond, 1.0)),
            [End::Belt(beyond), _] if is_past(-centre, -towards) => Some((beyond, -1.0)),
            _ => None,
        }
    }

    /// How much of a part stands on the belts behind, as a share.
    fn share_behind(&self, centre: f64, length: f64) -> f64 {
        let (front, rear) = (centre + 0.5 * length, centre - 0.5 * length);
        let at_end = if matches!(self.ends[1], End::Belt(_)) { front - self.length } else { 0.0 };
        let at_start = if matches!(self.ends[0], End::Belt(_)) { -rear } else { 0.0 };
        (at_end.max(at_start) / length).clamp(0.0, 1.0)
    }

    /// Moves a part by itself, as if nothing stood in its way.
    pub fn carry(&self, rider: &mut Rider, step: &Step) {
        let slides = step.grip.is_finite() && !self.is_beyond(rider);
        rider.slider = if slides { rider.slider } else { Slider::default() };
        let way = if slides { rider.slider.ride(step.grip, &step.stretch()) } else { step.way };
        let step = &Step { way, ..*step };
        let far = rider.length.is_finite() && !self.is_amidst(rider, step.way);
        if !self.is_beyond(rider) {
            rider.speed = step.way.abs() / (step.to - step.from).max(1e-9);
        }
        match (far, self.shares) {
            (false, _) => rider.step(step.way),
            (true, false) => self.carry_by_most(rider, step),
            (true, true) => self.carry_by_shares(rider, step),
        }
    }

    /// Whether it is nowhere near an end, whatever the step.
    fn is_amidst(&self, rider: &Rider, way: f64) -> bool {
        let reach = 0.5 * rider.length + way.abs();
        rider.centre > reach && rider.centre < self.length - reach
    }

    fn carry_by_most(&self, rider: &mut Rider, step: &Step) {
        const MOST_PIECES: u32 = 8;
        let half = 0.5 * rider.length;
        let mut now = step.from;
        for _ in 0..MOST_PIECES {
            let left = step.to - now;
            let span = (step.to - step.from).max(1e-12);
            let own = step.way * left / span;
            let behind = self.behind(rider.centre, own);
            let way = match behind {
                Some((beyond, sign)) => {
                    if rider.factor == 0.0 {
                        let front = if sign > 0.0 { rider.centre + half - self.length } else { half - rider.centre };
                        rider.factor = beyond.factor(now, front);
                    }
                    sign * rider.factor * (beyond.way.at(step.to) - beyond.way.at(now))
                }
                None => {
                    let ahead = rider.centre + 1e-9 * own.signum();
                    let bridges = step.slip > 0.0 && self.share_behind(ahead, rider.length) > 0.0;
                    own * if bridges { 1.0 - step.slip } else { 1.0 }
                }
            };
            let borders = [half, 0.0, self.length - half, self.length];
            let within = borders.iter().map(|border| (border - rider.centre) / way).filter(|share| *share > 1e-9);
            let share = within.fold(1.0, f64::min);
            let is_last = share >= 1.0 || !way.is_normal();
            let share = if is_last { 1.0 } else { share };
            rider.step(share * way);
            if behind.is_some() {
                rider.beyond += (share * way).abs();
            }
            if is_last {
                return;
            }
            // On the border to the last bit, so that the next piece begins behind it.
            if let Some(border) = borders.iter().find(|border| (*border - rider.centre).abs() < 1e-12) {
                rider.centre = *border;
            }
            now += share * left;
        }
    }

    fn carry_by_shares(&self, rider: &mut Rider, step: &Step) {
        let span = (step.to - step.from) / f64::from(SHARED);
        for piece in 0..SHARED {
            let now = step.from + f64::from(piece) * span;
            let share = self.share_behind(rider.centre, rider.length);
            let is_at_end = rider.centre > 0.5 * self.length;
            let behind = match &self.ends[usize::from(is_at_end)] {
                End::Belt(beyond) => {
                    (beyond.way.at(now + span) - beyond.way.at(now)) * if is_at_end { 1.0 } else { -1.0 }
                }
                _ => 0.0,
            };
            let slip = if share > 0.0 { step.slip } else { 0.0 };
            let own = step.way / f64::from(SHARED) * (1.0 - slip);
            rider.step((1.0 - share) * own + share * behind);
        }
    }

    /// Moves all parts, none through another. How many of those on this belt were held back.
    pub fn carry_all(&self, riders: &mut [Rider], step: &Step) -> u32 {
        // Only a part on a belt behind can be slower than one that follows it.
        if !riders.iter().any(|rider| self.is_beyond(rider)) {
            riders.iter_mut().for_each(|rider| self.carry(rider, step));
            return 0;
        }
        let way = if step.way < 0.0 { -1.0 } else { 1.0 };
        riders.sort_by(|a, b| (way * b.centre).total_cmp(&(way * a.centre)));
        let before = riders.to_vec();
        let mut queued = 0;
        for at in 0..riders.len() {
            self.carry(&mut riders[at], step);
            let ahead = (0..at).rev().find(|ahead| before[*ahead].length.is_finite());
            let Some(ahead) = ahead.filter(|_| riders[at].length.is_finite()) else { continue };
            let apart =
                |all: &[Rider]| way * (all[ahead].centre - all[at].centre) - 0.5 * (all[ahead].length + all[at].length);
            // Parts that are in one another already, by what was seen of them, stay as they are.
            let over = apart(&before).min(0.0) - apart(riders);
            if over > 1e-9 {
                queued += u32::from(!self.is_beyond(&before[at]));
                riders[at].step(-way * over);
            }
        }
        queued
    }
}

impl Rider {
    /// One that is seen first now.
    pub fn new(part: usize, centre: f64, length: f64) -> Rider {
        let slider = Slider::default();
        Rider { part, centre, length, gone: 0.0, factor: 0.0, beyond: 0.0, speed: 0.0, slider, past: 0.0 }
    }

    fn step(&mut self, way: f64) {
        self.centre += way;
        self.gone += way;
    }

    /// How far it may be from where it is taken to be, because two sightings disagree about the belt behind, m.
    pub fn astray(&self) -> f64 {
        if self.factor > 0.0 { (self.factor - 1.0).abs() * self.beyond } else { 0.0 }
    }
}

#[cfg(test)]
impl Beyond {
    /// A belt that runs at a speed, m/s, until an instant, s.
    pub fn always_at(speed: f64, until: f64) -> Beyond {
        let instants: Vec<f64> = (0..=(until / 0.02) as u32).map(|k| 0.02 * f64::from(k)).collect();
        let way = Way { metres: instants.iter().map(|at| speed * at).collect(), instants };
        Beyond { way, is_trusted: true, ..Beyond::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A belt 2 m long with another behind its end that always runs at `speed`, its beam 0.5 m on.
    fn lane(speed: f64, arrivals: &[f64]) -> Lane {
        let beyond = Beyond {
            beam: Some(0.5),
            arrivals: arrivals.to_vec(),
            is_trusted: arrivals.is_empty(),
            ..Beyond::always_at(speed, 40.0)
        };
        Lane { length: 2.0, shares: false, ends: [End::Unknown, End::Belt(beyond)] }
    }

    fn rider(part: usize, centre: f64) -> Rider {
        Rider::new(part, centre, 0.4)
    }

    /// Where a part is that began at `centre` after so many seconds on a belt at 0.5 m/s, in steps of 20 ms.
    fn after(lane: &Lane, centre: f64, slip: f64, seconds: f64) -> Rider {
        let mut rider = rider(0, centre);
        for step in 0..(seconds / 0.02).round() as u32 {
            let from = 0.02 * f64::from(step);
            lane.carry(&mut rider, &Step { slip, ..Step::even(from, from + 0.02, 0.01) });
        }
        rider
    }

    #[test]
    fn behind_the_end_a_part_goes_with_the_belt_there() {
        // 1.413 s to the end, the rest at 0.2 m/s.
        let found = after(&lane(0.2, &[]), 2.0 - 0.7065, 0.0, 2.0);
        assert!((found.centre - (2.0 + 0.2 * (2.0 - 1.413))).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn on_two_belts_it_loses_a_share_of_its_way() {
        // 0.097 m at 0.5 m/s; from 1.8 m on its front is on the belt behind: 0.2 m at 0.4 m/s; the rest of 0.8 s at 1 m/s.
        let found = after(&lane(1.0, &[]), 1.703, 0.2, 0.8);
        assert!((found.centre - (2.0 + 0.8 - 0.194 - 0.5)).abs() < 1e-9, "{found:?}");
    }

    #[test]
    fn a_belt_behind_that_is_not_trusted_is_as_fast_as_its_beam_saw() {
        // Its centre comes to the end at 0.2 s, its front to the beam 0.3 m on: at 0.2 m/s at 1.7 s. It came at 1.8 s.
        let found = after(&lane(0.2, &[0.1, 1.8, 9.0]), 1.9, 0.0, 1.8);
        assert!((found.centre - 2.3).abs() < 1e-9, "{found:?}");
        assert!((found.astray() - 0.3 * (1.0 - 1.5 / 1.6)).abs() < 1e-9, "{found:?}");
        // What comes much later is another part.
        assert_eq!(after(&lane(0.2, &[0.1, 9.0]), 1.9, 0.0, 1.8).astray(), 0.0);
    }

    #[test]
    fn parts_queue_behind_one_that_stands() {
        let lane = lane(0.0, &[]);
        let mut riders = [rider(0, 0.8), rider(1, 1.9), rider(2, 1.3)];
        let mut queued = 0;
        for step in 0..200 {
            let from = 0.02 * f64::from(step);
            queued = lane.carry_all(&mut riders, &Step::even(from, from + 0.02, 0.01));
        }
        let places = riders.map(|rider| (rider.part, (rider.centre * 1e6).round() / 1e6));
        assert_eq!((places, queued), ([(1, 2.0), (2, 1.6), (0, 1.2)], 2));
    }

    #[test]
    fn a_part_that_two_belts_share_goes_at_a_speed_between() {
        let lane = Lane { shares: true, ..lane(0.2, &[]) };
        let mut found = rider(0, 2.0);
        lane.carry(&mut found, &Step::even(0.0, 1e-3, 5e-4));
        assert!((found.gone - 3.5e-4).abs() < 1e-6, "{found:?}");
    }

    #[test]
    fn who_passes_an_open_end_has_left() {
        let lane = Lane { length: 2.0, shares: false, ends: [End::Unknown, End::Open] };
        let gone = |centre: f64| Rider { gone: 0.5, ..rider(0, centre) };
        assert!(lane.has_left(&gone(2.001)) && !lane.has_left(&gone(1.999)));
        assert!(!lane.has_left(&Rider { length: f64::INFINITY, ..gone(2.5) }));
        let back = |centre: f64| Rider { past: 0.02, ..gone(centre) };
        assert!(lane.has_left(&back(2.021)) && !lane.has_left(&back(2.019)));
    }
}
