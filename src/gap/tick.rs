//! The machine's own tick: it looks at its state and takes commands up at whole multiples of it.
//!
//! A drive that takes a command up at its next tick moves by up to that much later; an integrating signal adds that up to a
//! random walk, which looks like a real gap. The tick is one discrete number for each recording, voted for by the devices:
//! there is no continuous freedom in it in which a dead time could hide. A device that no tick explains has a gap of its own
//! and no vote.

use super::overrides::Overrides;
use super::score::Score;
use super::subject::{Subject, Timing};
use crate::effect::EffectError;

/// The ticks that are tried, s; 0: none.
const TICKS_S: [f64; 6] = [0.0, 1e-4, 2e-4, 5e-4, 1e-3, 2e-3];
/// What part of a cycle a tick may be at most.
const OF_CYCLE: f64 = 1.0 / 20.0;
/// Above this cost per sample a device has no vote.
const EXPLAINED: f64 = 1.5;

/// How a device goes with a tick: its cost per sample where it takes commands up at once, and where at the next tick.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vote {
    at_once: f64,
    ticked: f64,
}

/// The ticks that may be in a recording whose cycle is `cycle`, s.
pub(super) fn candidates(cycle: f64) -> Vec<f64> {
    TICKS_S.into_iter().filter(|tick| *tick <= OF_CYCLE * cycle + 1e-12).collect()
}

/// Whether a device of this kind takes commands up at a tick where its own cost does not say: drives do.
fn is_ticked(kind: &str) -> bool {
    let short = kind.rsplit('.').next().unwrap_or(kind);
    matches!(short, "StraightConveyor" | "ConveyorCurve" | "ServoAxis" | "EncoderMotor")
}

/// What a subject costs in its run `at` with a tick. `None`: it has no levels, in which a tick could be seen.
pub(super) fn vote(subject: &Subject, at: usize, tick: f64) -> Result<Option<Vote>, EffectError> {
    let cost = |command_tick: f64| -> Result<Option<f64>, EffectError> {
        let mut alone = subject.only(at);
        alone.set_tick(0, tick, command_tick);
        let nominal = alone.predict(&[], &Overrides::none())?;
        alone.find_floors(&nominal, Timing::Exact);
        Ok(worst_level(&alone.score(&nominal)))
    };
    let Some(at_once) = cost(0.0)? else { return Ok(None) };
    let ticked = if tick > 0.0 { cost(tick)?.unwrap_or(at_once) } else { at_once };
    Ok(Some(Vote { at_once, ticked }))
}

/// The mean cost of the level that fares worst; of levels that were sampled often enough.
fn worst_level(score: &Score) -> Option<f64> {
    let means = score.signals.iter().filter_map(|signal| {
        let level = signal.level.as_ref().filter(|level| level.at.len() >= 50)?;
        Some(signal.cost / level.at.len() as f64)
    });
    means.max_by(f64::total_cmp)
}

/// The tick that the devices vote for. `votes` are by device and candidate; of a device without a vote an empty list.
pub(super) fn elect(ticks: &[f64], votes: &[Vec<Vote>]) -> f64 {
    let best = |vote: &Vote| vote.at_once.min(vote.ticked);
    let with_a_vote = |device: &&Vec<Vote>| {
        device.len() == ticks.len() && device.iter().map(best).fold(f64::INFINITY, f64::min) <= EXPLAINED
    };
    let voters: Vec<&Vec<Vote>> = votes.iter().filter(with_a_vote).collect();
    let total = |at: usize| voters.iter().map(|device| best(&device[at])).sum::<f64>();
    // The first of equals: no tick where nothing speaks for one.
    let chosen = (0..ticks.len()).min_by(|a, b| total(*a).total_cmp(&total(*b)));
    chosen.map_or(0.0, |at| ticks[at])
}

/// The tick at which a device takes commands up: by its own cost where that is explained, else by its kind.
pub(super) fn taken_up(kind: &str, tick: f64, vote: Option<Vote>) -> f64 {
    let by_kind = is_ticked(kind);
    let is_ticked = match vote {
        Some(vote) if vote.at_once.min(vote.ticked) <= EXPLAINED && (vote.at_once - vote.ticked).abs() > 0.05 => {
            vote.ticked < vote.at_once
        }
        _ => by_kind,
    };
    if is_ticked { tick } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn votes(costs: &[f64]) -> Vec<Vote> {
        costs.iter().map(|cost| Vote { at_once: 2.0 * cost, ticked: *cost }).collect()
    }

    #[test]
    fn a_device_with_a_gap_has_no_vote() {
        let ticks = candidates(0.004);
        assert_eq!(ticks, [0.0, 1e-4, 2e-4]);
        let fine = votes(&[10.0, 0.3, 3.2]);
        let broken = votes(&[90.0, 40.0, 12.0]);
        assert_eq!(elect(&ticks, &[fine, broken.clone(), Vec::new()]), 1e-4);
        assert_eq!(elect(&ticks, &[broken]), 0.0);
    }

    #[test]
    fn whether_a_device_is_ticked_it_says_itself_if_it_can() {
        let robot = "kinetwin.CartesianRobot";
        assert_eq!(taken_up(robot, 1e-4, Some(Vote { at_once: 0.2, ticked: 1.1 })), 0.0);
        assert_eq!(taken_up(robot, 1e-4, Some(Vote { at_once: 1.1, ticked: 0.2 })), 1e-4);
        assert_eq!(taken_up("kinetwin.ServoAxis", 1e-4, Some(Vote { at_once: 9.0, ticked: 8.0 })), 1e-4);
        assert_eq!(taken_up("kinetwin.Pusher", 1e-4, None), 0.0);
    }
}
