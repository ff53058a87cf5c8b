//! What a level would have been without what was drawn, by the recording itself: what something else is wrong with has no prediction to be read
//! beside.
//!
//! Of a loose contact the level is at 0 and back again by leaps that no motion of it makes otherwise. Of lost reports it stands still while it moves before
//! and behind, and then has made up for all of them at once: what rests and starts anew has not.

use super::read::{APART, Law, gate};
use crate::gap::prediction::{Predicted, Prediction};
use crate::gap::subject::Subject;
use crate::gap::{Floor, Track};

/// How many times the longest step of a level a leap is.
const LEAP: f64 = 3.0;
/// By which share of a step what is made up for may differ.
const MADE_UP: f64 = 0.5;

/// What `bare` predicts, its levels as they were recorded but for what `law` drew; the places of those levels.
pub(super) fn of(subject: &Subject, bare: &Prediction, law: Law) -> (Prediction, Vec<usize>) {
    let mut itself = bare.clone();
    let mut levels = Vec::new();
    for (run, predicted) in subject.runs.iter().zip(&mut itself.runs) {
        for (signal, predicted) in predicted.iter_mut().enumerate() {
            let (Some(track), Predicted::Level(values)) = (&run.tracks[signal], predicted) else { continue };
            let half = if subject.signals[signal].is_count { 0.5 } else { 0.0 };
            let without = match law {
                Law::Away => back(&track.values, gate(&run.floors[signal], 0.0)),
                Law::Lost => made_up(track, &run.floors[signal]),
            };
            *values = without.into_iter().map(|value| value + half).collect();
            if !levels.contains(&signal) {
                levels.push(signal);
            }
        }
    }
    (itself, levels)
}

/// The values on the line between those at `from` and `to`.
fn bridge(values: &mut [f64], from: usize, to: usize) {
    let (first, step) = (values[from], (values[to] - values[from]) / (to - from) as f64);
    (from + 1..to).for_each(|k| values[k] = first + step * (k - from) as f64);
}

/// A level without what was away: within `gate` of 0.
fn back(recorded: &[f64], gate: f64) -> Vec<f64> {
    let is_away = |value: &f64| value.abs() <= gate;
    let steps = recorded.windows(2).filter(|pair| !is_away(&pair[0]) && !is_away(&pair[1]));
    let longest = steps.map(|pair| (pair[1] - pair[0]).abs()).fold(gate, f64::max);
    let mut values = recorded.to_vec();
    let mut next = 0;
    while let Some(from) = (next..values.len()).find(|k| is_away(&recorded[*k])) {
        let Some(to) = (from..values.len()).find(|k| !is_away(&recorded[*k])) else { break };
        let leaps = |at: usize| recorded[at].abs() > LEAP * longest;
        if from > 0 && leaps(from - 1) && leaps(to) {
            bridge(&mut values, from - 1, to);
        }
        next = to;
    }
    values
}

/// A level without what stood still and was made up for.
fn made_up(track: &Track, floor: &Floor) -> Vec<f64> {
    let mut values = track.values.clone();
    let instants = &track.grid.instants;
    // Where something new was reported, by a step that noise does not make.
    let mut news = vec![0];
    for k in 1..values.len() {
        let span = (instants[track.first + k] - instants[track.first + k - 1]).max(1e-9);
        let step = (values[k] - values[k - 1]).abs();
        if step > gate(floor, step / span) {
            news.push(k);
        }
    }
    for at in 1..news.len().saturating_sub(2) {
        let [before, last, next, behind] = [news[at - 1], news[at], news[at + 1], news[at + 2]];
        let each = |from: usize, to: usize| (track.values[to] - track.values[from]) / (to - from) as f64;
        let (slower, faster) = (each(before, last), each(next, behind));
        let step = track.values[next] - track.values[last];
        let stood = (next - last) as f64;
        let [least, most] = [slower.abs().min(faster.abs()), slower.abs().max(faster.abs())];
        let is_one_way = slower * faster > 0.0 && slower * step > 0.0;
        let span = instants[track.first + next] - instants[track.first + last];
        let tells = least > APART * gate(floor, step.abs() / span.max(1e-9));
        let is_made_up = (stood - MADE_UP) * least <= step.abs() && step.abs() <= (stood + MADE_UP) * most;
        if stood > 1.0 && tells && is_one_way && is_made_up {
            bridge(&mut values, last, next);
        }
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps of 1 mm with noise of a tenth of one.
    fn floor() -> Floor {
        Floor { noise: 1e-4, step: 1e-5, ..Floor::default() }
    }

    #[test]
    fn a_leap_to_nothing_and_back_is_no_motion() {
        // A ramp to 1 and back to rest at 0, away for five samples on its way up.
        let way = |k: usize| if k < 100 { 0.01 * k as f64 } else { (2.0 - 0.01 * k as f64).max(0.0) };
        let whole: Vec<f64> = (0..300).map(way).collect();
        let away: Vec<f64> =
            whole.iter().enumerate().map(|(k, x)| if (60..65).contains(&k) { 0.0 } else { *x }).collect();
        let found = back(&away, 1e-4);
        assert!(found.iter().zip(&whole).all(|(found, whole)| (found - whole).abs() < 1e-12));
        assert_eq!(back(&whole, 1e-4), whole);
    }

    #[test]
    fn what_stands_and_is_made_up_for_was_lost() {
        let whole: Vec<f64> = (0..200).map(|k| 0.01 * f64::from(k)).collect();
        let mut lost = whole.clone();
        for (from, to) in [(20, 21), (50, 52), (80, 81)] {
            lost[from..to].fill(whole[from - 1]);
        }
        let found = made_up(&Track::of_values(lost), &floor());
        assert!(found.iter().zip(&whole).all(|(found, whole)| (found - whole).abs() < 1e-12));
        // What stops for three samples and goes on from there was not.
        let stops: Vec<f64> =
            (0..200_i32).map(|k| 0.01 * f64::from(if k < 100 { k } else { (k - 3).max(99) })).collect();
        assert_eq!(made_up(&Track::of_values(stops.clone()), &floor()), stops);
    }
}
