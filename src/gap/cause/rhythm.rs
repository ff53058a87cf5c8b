//! How often a link is refreshed, as the edges of its states show it.
//!
//! An edge on such a link comes at a multiple of the period, the first one after the state has changed, and is seen in the first report after that. A
//! period that is a little off is a whole one off some periods later, so that no slope leads to it; among the periods as far apart as the recording
//! can tell it is the one by which the most edges come when they do (as periods of pulsars are folded: D. R. Lorimer, M. Kramer, Handbook of Pulsar
//! Astronomy, Cambridge 2005, section 6.1).

use super::starts::Clues;
use crate::gap::Predicted;
use crate::gap::statistics::quantile;

/// Between which multiples of how late edges are in the middle it is looked for, and within which times, s.
const OF_LATENESS: [f64; 2] = [1.0, 8.0];
const WITHIN_S: [f64; 2] = [4e-3, 3.0];
/// By which part of itself over all its turns one period differs from the next that is tried.
pub const PART: f64 = 0.12;
/// How well a change is foreseen, s: as well as a cylinder's speed is known within a stroke.
const FORESEEN_S: f64 = 5e-3;
/// How well a report's instant is known in the machine's time, s.
const SAME_S: f64 = 5e-4;
/// Of how many edges a period can be told, and which share of them it must explain.
const FEWEST: usize = 12;
const LEAST_SHARE: f64 = 0.8;

/// An edge that was recorded: between which two reports, and when the state that it shows may have changed, all in the machine's own time, s.
#[derive(Clone, Debug, PartialEq)]
struct Shown {
    within: (f64, f64),
    /// When states changed to that, ascending, as far back as a period may be long.
    changes: Vec<f64>,
}

/// The period of the candidate's signal, or of all where it is the whole link's; `None` where edges show none.
pub fn period(clues: &Clues<'_>) -> Option<f64> {
    let subject = clues.subject;
    let (run, predicted) = subject.runs.iter().zip(&clues.nominal.runs).next()?;
    let mut shown = Vec::new();
    for (signal, info) in subject.signals.iter().enumerate() {
        let is_meant = clues.component.is_none_or(|name| info.property == name);
        let (Some(track), Predicted::Edges { edges, .. }) = (&run.tracks[signal], &predicted[signal]) else { continue };
        if !is_meant {
            continue;
        }
        let lead = subject.lead(info, run);
        for edge in track.edges.iter().filter(|edge| edge.index > 0) {
            let within = (track.grid.instants[edge.index - 1] + lead, track.grid.instants[edge.index] + lead);
            let is_it = |at: &f64| (within.0 - WITHIN_S[1]..within.1 + FORESEEN_S).contains(at);
            let changes = edges.iter().filter(|other| other.to == edge.to).map(|other| other.at + lead).filter(is_it);
            shown.push(Shown { within, changes: changes.collect() });
        }
    }
    period_of(&shown)
}

fn period_of(shown: &[Shown]) -> Option<f64> {
    let late = |edge: &Shown| Some(0.5 * (edge.within.0 + edge.within.1) - edge.changes.last()?);
    let late: Vec<f64> = shown.iter().filter_map(late).collect();
    if late.len() < FEWEST {
        return None;
    }
    let [shortest, longest] = OF_LATENESS.map(|times| times * quantile(&late, 0.5));
    let (shortest, longest) = (shortest.max(WITHIN_S[0]), longest.min(WITHIN_S[1]));
    let end = shown.iter().map(|edge| edge.within.1).fold(0.0, f64::max);
    if shortest >= longest || end <= 0.0 {
        return None;
    }
    // By the end a period that lies between two that are tried is off by no more than a report shows.
    let seen = shown.iter().map(|edge| edge.within.1 - edge.within.0).fold(f64::INFINITY, f64::min);
    let next = |rate: &f64| Some(rate + PART.min(0.5 * seen * rate) / end);
    let rates = std::iter::successors(Some(1.0 / longest), next).take_while(|rate| rate * shortest <= 1.0);
    let rates: Vec<f64> = rates.collect();
    let explained = |rate: &f64| shown.iter().filter(|edge| is_shown(edge, 1.0 / rate)).count();
    let each: Vec<usize> = rates.iter().map(explained).collect();
    let most = *each.iter().max()?;
    // The middle of those that explain as many, as a period is in between.
    let first = each.iter().position(|count| *count == most)?;
    let last = first + each[first..].iter().take_while(|count| **count == most).count() - 1;
    let is_told = most as f64 >= LEAST_SHARE * shown.len() as f64;
    is_told.then(|| 2.0 / (rates[first] + rates[last]))
}

/// Whether a link that is refreshed so often shows an edge when it was seen.
fn is_shown(edge: &Shown, period: f64) -> bool {
    let (before, seen) = (edge.within.0 - SAME_S, edge.within.1 + SAME_S);
    let (first, last) = ((before / period).ceil() as i64, (seen / period).floor() as i64);
    let is_refreshed = |turn: i64| {
        let at = turn as f64 * period;
        edge.changes.iter().any(|change| (at - period - FORESEEN_S..=at + FORESEEN_S).contains(change))
    };
    (first..=last).any(is_refreshed)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Changes at any times, each reported every 10 ms of what it was at the last of its refreshes.
    fn shown(period: Option<f64>) -> Vec<Shown> {
        let changed = |k: u32| 0.3 + 0.77 * f64::from(k) + 0.31 * (f64::from(k * k * 37 % 101) / 101.0);
        let of = |k: u32| {
            let change = changed(k);
            let refreshed = period.map_or(change + 0.012, |period| (change / period).ceil() * period);
            let seen = (refreshed / 0.01).ceil() * 0.01;
            // What is foreseen is off by some milliseconds.
            let foreseen = change + 3e-3 * (f64::from(k * 7 % 11) / 5.0 - 1.0);
            Shown { within: (seen - 0.01, seen), changes: vec![foreseen] }
        };
        (0..70).map(of).collect()
    }

    #[test]
    fn a_period_is_found_by_when_edges_come() {
        for period in [0.029_995_7, 0.064_3, 0.168_678] {
            let found = period_of(&shown(Some(period))).unwrap_or_else(|| panic!("none for {period}"));
            assert!((found - period).abs() * 54.0 / period < 0.3 * period.max(0.01), "{found} for {period}");
        }
    }

    #[test]
    fn what_is_late_by_the_same_each_time_shows_no_period_of_its_own() {
        // But one that goes with that of its reports: two turns of it are whole cycles.
        if let Some(found) = period_of(&shown(None)) {
            let turns = 2.0 * found / 0.01;
            assert!((turns - turns.round()).abs() < 0.02, "{found}");
        }
        assert_eq!(period_of(&shown(Some(0.03))[..8]), None);
    }
}
