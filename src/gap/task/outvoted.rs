//! Where what is likeliest is what one device says against all others.
//!
//! Each device has a scale of error of its own, so that one that is far off has a small say. But what halves a gap of a hundred floors gains as much as what
//! explains another's six to its noise, and of a motor that reports a millisecond late alone the encoder, which knows an instant a hundred times better than
//! what else there is, has its delay taken for everybody's. So where that leaves others off, each of those that speak against them is left out in turn, and the task
//! by which the most devices are explained is taken.

use rayon::prelude::*;

use super::voter::{SURELY_NEARER, Voter};
use super::{Best, EXPLAINED, LEAST_DEVICES, Task};
use crate::effect::EffectError;

/// What the others agree on where one device speaks against them: it is off whatever the task, so that a gap that is made smaller outweighs another's few
/// floors, or it is explained by what makes others worse than they were `before`. `None` where that explains no more devices, and makes as many worse;
/// with all voters as they are under it.
pub(super) fn outvoted(
    voters: &[Voter],
    (before, best): (&[f64], &Best),
    cycle: f64,
) -> Result<Option<(Best, Vec<Voter>)>, EffectError> {
    if voters.len() <= LEAST_DEVICES {
        return Ok(None);
    }
    let squares = |costs: &[f64]| -> Vec<f64> {
        voters.iter().zip(costs).map(|(voter, cost)| voter.mean_square_at(*cost)).collect()
    };
    let is_worse = |costs: &[f64], place: usize| costs[place] - before[place] > SURELY_NEARER;
    // How many are explained, and how many were not made worse.
    let merit = |costs: &[f64]| {
        let explained = squares(costs).into_iter().filter(|square| *square < EXPLAINED).count();
        (explained, (0..voters.len()).filter(|place| !is_worse(costs, *place)).count())
    };
    let now = squares(&best.costs);
    let speaks_against = |place: &usize| {
        let mut others = (0..voters.len()).filter(|other| other != place);
        let are_worse = others.clone().any(|other| is_worse(&best.costs, other));
        let is_another_off = others.any(|other| now[other] >= EXPLAINED);
        is_another_off && (are_worse || now[*place] >= EXPLAINED)
    };
    let mut chosen: Option<(Best, Vec<Voter>)> = None;
    for place in (0..voters.len()).filter(speaks_against) {
        let mut others = voters.to_vec();
        let mut alone = others.remove(place);
        others.par_iter_mut().try_for_each(|voter| voter.centre(Task::default()))?;
        let Best { cost, task, mut costs } = Best::of(&mut others, cycle)?;
        alone.centre(task)?;
        let own = alone.moments(Some(task))?.cost(task.age_s);
        others.insert(place, alone);
        costs.insert(place, own);
        let least = chosen.as_ref().map_or(best, |(best, _)| best);
        if merit(&costs) > merit(&least.costs) {
            chosen = Some((Best { cost: cost + own, task, costs }, others));
        }
    }
    Ok(chosen)
}

#[cfg(test)]
mod tests {
    use crate::gap::recorded_tests::study_of_folder;

    /// Of three devices a motor reports 1.125 ms late; the others' reports are 11 µs old.
    #[test]
    fn a_motor_alone_does_not_say_how_old_all_reports_are() {
        let found = study_of_folder("tests/data/motor-that-reports-late").tasks[0];
        assert!(found.age_s < 5e-5, "{found:?}");
    }
}
