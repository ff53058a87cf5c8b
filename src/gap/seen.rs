//! What the barriers of a belt saw: when and for how much of its way each was cut.

use std::sync::Arc;

use super::lane::Lane;
use super::track::Track;

/// What of a belt's geometry its barriers see.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Geometry {
    /// Where the beams are, m along the belt from its start.
    pub beams: [Option<f64>; 2],
    /// How long the parts of this plant cut a beam, m of the belt's way, in any position that they stand in.
    pub lengths: Vec<f64>,
    /// How far its parts' edges may be off, m.
    pub tolerance: f64,
    /// The belt among its neighbours.
    pub lane: Arc<Lane>,
    /// At which beam what comes forwards was put by a bay, and nothing else, and how long the parts of that are, m.
    pub fed: Option<(usize, f64)>,
    /// How far the fronts of those are from the belt's start where they are put, m.
    pub put_front: Option<f64>,
    /// Spans in which other hands may take a part out of a beam, s, by beam.
    pub hands: [Vec<(f64, f64)>; 2],
}

impl Geometry {
    /// Whether a belt that goes on so far, m, must have taken out of a beam whatever cut it.
    fn is_further_than_parts(&self, way: f64) -> bool {
        way.abs() > STAYS * self.longest()
    }

    /// Whether a bay puts parts into this beam, so that any sensor sees them for less of their way.
    pub fn is_put_into(&self, beam: usize) -> bool {
        let is_its = self.fed.is_some_and(|(fed, _)| fed == beam);
        is_its && self.put_front.zip(self.beams[beam]).is_some_and(|(front, at)| front > at)
    }

    /// How long the longest part is, m.
    pub fn longest(&self) -> f64 {
        self.lengths.iter().copied().fold(0.0, f64::max)
    }

    /// That of the rig's belt, on which nothing else is known.
    #[cfg(test)]
    pub(super) fn of_rig() -> Geometry {
        Geometry {
            beams: [Some(0.3), Some(1.7)],
            lengths: vec![0.3],
            tolerance: 0.0,
            lane: Arc::default(),
            fed: None,
            put_front: None,
            hands: Default::default(),
        }
    }
}

/// How far from where it is expected a part may be seen at least, m: less than any part is long.
pub(super) const GATE_M: f64 = 0.08;
/// Which share of the parts of one barrier must reach the other for one that does not to be missed.
pub(super) const RELIABLE: f64 = 0.8;
/// After how many times the longest part's way a barrier that is cut still has been left by what cut it.
const STAYS: f64 = 2.0;
/// In which share of what it saw a barrier must agree with itself for that to be its sensor: what a loose contact lets fall differs from part to part.
pub(super) const NEARLY_ALL: f64 = 0.8;

/// An interval in which a beam was cut, in terms of its track's edges.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    pub beam: usize,
    pub rise: usize,
    pub fall: Option<usize>,
    /// The belt's way at its rise, m.
    pub start: f64,
    /// Instants, s: the middles of the cycles.
    pub from: f64,
    pub to: f64,
    pub way: f64,
    /// Whether it stayed cut though the belt went on by more than any part is long.
    pub stays: bool,
    pub length: Option<f64>,
    pub part: Option<usize>,
    /// The place of the cut that this one goes on with: the belt turned, and brought back what had left the beam.
    pub again: Option<usize>,
    /// Whether it left the beam the way that it came, and did not come again.
    pub is_back: bool,
}

impl Seen {
    /// How far the belt went on, the way that the part came, while it cut the beam, m; where it still does so nothing is known of that.
    fn gone(&self, travel: &dyn Fn(f64) -> f64) -> Option<f64> {
        self.fall.map(|_| self.way * (travel(self.to) - self.start))
    }

    /// Whether the other beam saw nothing of its part.
    pub fn is_alone(&self, seen: &[Seen]) -> bool {
        seen.iter().all(|of| of.beam == self.beam || of.part != self.part)
    }

    /// Whether it left the beam after less than any part is long, and the belt runs on.
    fn runs_on_at_once(&self, travel: &dyn Fn(f64) -> f64) -> bool {
        const JUST_S: f64 = 0.02;
        let runs_on = self.way * (travel(self.to) - travel(self.to - JUST_S)) > 0.0;
        runs_on && self.gone(travel).is_some_and(|gone| gone < GATE_M)
    }
}

/// Which beams see so little of nearly all parts.
pub(super) fn see_little(seen: &[Seen], travel: &dyn Fn(f64) -> f64) -> [bool; 2] {
    [0, 1].map(|beam| {
        let of_beam = || seen.iter().filter(|cut| cut.beam == beam);
        let little = of_beam().filter(|cut| cut.runs_on_at_once(travel)).count();
        little > 0 && little as f64 >= NEARLY_ALL * of_beam().count() as f64
    })
}

/// Whether a part left a beam the way that it came: the belt went on by less than any part is long, and that is not how the beam sees nearly all.
pub(super) fn goes_back(cut: &Seen, see_little: [bool; 2], travel: &dyn Fn(f64) -> f64) -> bool {
    let passes = see_little[cut.beam] && cut.runs_on_at_once(travel);
    !passes && cut.gone(travel).is_some_and(|gone| gone < GATE_M)
}

/// The middle of the cycle in which an edge came, s.
pub(super) fn middle(track: &Track, index: usize) -> f64 {
    let (before, seen) = super::edges::interval(track, index);
    0.5 * (before + seen)
}

/// When and by how far of the belt's way a beam was cut.
pub(super) fn cuts(geometry: &Geometry, beam: usize, track: &Track, travel: &dyn Fn(f64) -> f64) -> Vec<Seen> {
    let mut cuts = Vec::new();
    let last = track.grid.instants.last().copied().unwrap_or(0.0);
    for (rise, edge) in track.edges.iter().enumerate().filter(|(_, edge)| edge.to != 0.0) {
        let fall = track.edges.get(rise + 1).map(|_| rise + 1);
        let from = middle(track, edge.index);
        let to = fall.map_or(f64::INFINITY, |fall| middle(track, track.edges[fall].index));
        let start = travel(from);
        let end = if fall.is_some() { travel(to) } else { start };
        // At the instant of the rise the belt may stand already: which way it came from counts.
        let before = travel(from - 2.0 * track.grid.cycle.max(0.01));
        let way = if end - before < 0.0 { -1.0 } else { 1.0 };
        let is_seen = geometry.beams[beam].is_some();
        if is_seen {
            let stays = fall.is_none() && geometry.is_further_than_parts(travel(last) - start);
            cuts.push(Seen {
                beam,
                rise,
                fall,
                start,
                from,
                to,
                way,
                stays,
                length: None,
                part: None,
                again: None,
                is_back: false,
            });
        }
    }
    cuts
}

/// Whether a beam is cut while the belt goes on by more than any part is long.
pub(super) fn is_cut_for_too_long(geometry: &Geometry, track: &Track, travel: &dyn Fn(f64) -> f64) -> bool {
    let ends = track.grid.instants.last().copied().unwrap_or(0.0);
    let edges = track.edges.iter().map(|edge| (middle(track, edge.index), edge.to));
    let states: Vec<(f64, f64)> = [(0.0, track.initial)].into_iter().chain(edges).chain([(ends, 0.0)]).collect();
    states.windows(2).any(|of| of[0].1 != 0.0 && geometry.is_further_than_parts(travel(of[1].0) - travel(of[0].0)))
}

/// How far it is from one beam to the other, the way the belt runs.
pub(super) fn distance(geometry: &Geometry, beam: usize, way: f64) -> Option<f64> {
    let [Some(a), Some(b)] = geometry.beams else { return None };
    Some(if beam == 0 { way * (b - a) } else { way * (a - b) })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Five cuts of 40 mm on a belt that goes 0.5 m/s are how a beam sees parts; where two of five are longer, what is so short went back.
    #[test]
    fn what_is_short_went_back_but_where_nearly_all_is_so() {
        let travel = |at: f64| 0.5 * at;
        let goes_back = |falls: [f64; 5], which: usize| {
            let edges = falls.iter().enumerate().map(|(k, fall)| (1.0 + 6.0 * k as f64, 1.0 + 6.0 * k as f64 + fall));
            let track = Track::of_cuts(&edges.collect::<Vec<_>>());
            let seen = cuts(&Geometry::of_rig(), 0, &track, &travel);
            goes_back(&seen[which], see_little(&seen, &travel), &travel)
        };
        assert!(!goes_back([0.08; 5], 0) && !goes_back([0.08; 5], 4));
        assert!(goes_back([0.08, 0.6, 0.08, 0.6, 0.08], 0) && !goes_back([0.08, 0.6, 0.08, 0.6, 0.08], 1));
    }
}
