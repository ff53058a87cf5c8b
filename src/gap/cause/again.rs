//! A second look about where a search ended: where the best single effect leaves much, a better place for it may lie behind a ridge.
//!
//! An axis that just comes to rest within its dead band, or just lets go, does another thing a hair beyond: the deviance has ridges, and nominal
//! parameters that were fitted on the wrong side of one hold the effect there. So the effect's strength is tried at parts and multiples of what
//! was found, beside nominal parameters as they are declared and as they were found, and what is best is fitted anew from there.

use rayon::prelude::*;

use super::bench::{Bench, Trial};
use super::ladder::{Ladder, anew, settle};
use super::remainder::{Left, left_by};
use super::starts::UNLIMITED;
use crate::gap::fit::Effort;

/// Parts and multiples of what was found.
const MULTIPLES: [f64; 16] = [0.5, 0.65, 0.75, 0.8, 0.85, 0.9, 0.95, 0.98, 1.0, 1.02, 1.05, 1.1, 1.2, 1.3, 1.5, 2.0];
/// How many of them are fitted.
const FITTED: usize = 4;
/// What is left must fall to this part of what was, in deviance: a little is what a fit gains anyhow.
const WORTH: f64 = 0.8;

/// Takes the one effect of the ladder, if it leaves something, to where it leaves less.
pub fn seek_again(bench: &Bench<'_>, ladder: &mut Ladder) {
    let [candidate] = ladder.best.set.as_slice() else { return };
    let Some(free) = candidate.free.first() else { return };
    let is_apt = !bench.is_rugged() && !candidate.is_parameter_error();
    if !is_apt || left_by(bench, &ladder.best, &ladder.bare.at) == Left::Nothing {
        return;
    }
    let parameter = candidate.effect.parameters.iter().find(|of| of.name == free.name);
    let nominal = parameter.map_or(0.0, |of| of.nominal);
    let from = if nominal.abs() < UNLIMITED { nominal } else { 0.0 };
    let (set, at) = (&ladder.best.set, &ladder.best.at);
    let own = ladder.best.parameters();
    let nuisances = [at[own..].to_vec(), bench.nominal(set)];
    let place = |multiple: f64, nuisances: &Vec<f64>| {
        let mut all = [&at[..own], nuisances].concat();
        all[0] = (from + multiple * (at[0] - from)).clamp(free.range.least, free.range.greatest);
        all
    };
    let places: Vec<Vec<f64>> = MULTIPLES
        .iter()
        .flat_map(|multiple| nuisances.each_ref().map(|nuisances| place(*multiple, nuisances)))
        .collect();
    // By noise alone: weighed by what is left of the place that was found, all others cost about the same.
    let tried = places.into_par_iter().with_max_len(1).filter_map(|place| bench.trial(set, place));
    let mut tried: Vec<Trial> = tried.collect();
    tried.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    tried.truncate(FITTED);
    let fitted = tried
        .into_par_iter()
        .with_max_len(1)
        .filter_map(|trial| bench.fit(&trial.set, std::slice::from_ref(&trial.at), anew(trial.at.len())));
    let Some(nearest) = fitted.min_by(|a, b| a.cost.total_cmp(&b.cost)) else { return };
    take_if_worth(bench, ladder, &nearest);
}

/// Takes `other` for the best set, refitted, if what it leaves is so much less.
fn take_if_worth(bench: &Bench<'_>, ladder: &mut Ladder, other: &Trial) {
    let Some(before) = bench.trial(&ladder.best.set, ladder.best.at.clone()) else { return };
    if other.cost - ladder.floor.0 > WORTH * (before.cost - ladder.floor.0) {
        return;
    }
    let is_first = other.set.len() == 1;
    if let Some((trial, subject)) =
        bench.tolerant(other).and_then(|there| settle(bench, &bench.with(&there), other, is_first))
    {
        (ladder.best, ladder.subject) = (trial, subject);
    }
}

/// How many singles are tried in the place of the first of two effects, and how many of them are fitted to the end.
const IN_ITS_PLACE: usize = 8;
const FITTED_IN_ITS_PLACE: usize = 2;
/// From how many starts of the second effect, and how many steps downhill each goes.
const SECONDS: usize = 5;
const FEW: u32 = 6;

/// Puts another single effect in the place of the first of two, where the two leave much and with that one they leave less: what explained the most alone may
/// have stood for both, as a filter stands for a dead time of a drive that starts more slowly than it should.
pub fn exchange_first(bench: &Bench<'_>, ladder: &mut Ladder) {
    let [first, second] = ladder.best.set.as_slice() else { return };
    // What is not evident says too little of two for that.
    let is_apt = !bench.is_rugged() && ladder.beneath == 0.0;
    if !is_apt || left_by(bench, &ladder.best, &ladder.bare.at) != Left::Much {
        return;
    }
    let best = &ladder.best;
    let of_second = &best.at[first.free.len()..best.parameters()];
    let others = ladder
        .singles
        .iter()
        .filter(|single| single.set.last().is_some_and(|other| !other.is_same(first) && !other.is_same(second)));
    let each = second.starts.len().div_ceil(SECONDS).max(1);
    let seconds = second.starts.iter().skip(each / 2).step_by(each).map(Vec::as_slice);
    let seconds: Vec<&[f64]> = seconds.chain([of_second]).collect();
    let fit = |trial: &Trial, effort| bench.fit(&trial.set, std::slice::from_ref(&trial.at), effort);
    let others: Vec<&Trial> = others.take(IN_ITS_PLACE).collect();
    let begun = others.into_par_iter().with_max_len(1).filter_map(|single| {
        let candidate = single.set.last()?;
        let set = vec![candidate.clone(), second.clone()];
        let carried = bench.carried(&set, &best.overrides);
        // Where each explained the most without the other may be a false minimum of the two.
        let alone = single.at[..single.parameters()].to_vec();
        let is_grid = candidate.free.len() == 1 && second.free.len() == 1;
        let seconds = if is_grid { seconds.as_slice() } else { &[of_second] };
        let starts = candidate.starts.iter().chain([&alone]);
        let starts = starts.flat_map(|own| seconds.iter().map(|second| [own, *second, &carried].concat()));
        let begun = starts.filter_map(|at| if bench.is_stopped() { None } else { bench.trial(&set, at) });
        let begun = begun.min_by(|a, b| a.cost.total_cmp(&b.cost))?;
        fit(&begun, Effort { starts: 1, budget: FEW * (begun.at.len() as u32 + 1) })
    });
    let mut begun: Vec<Trial> = begun.collect();
    begun.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    begun.truncate(FITTED_IN_ITS_PLACE);
    let fitted = begun.into_par_iter().with_max_len(1).filter_map(|trial| fit(&trial, anew(trial.at.len())));
    let Some(other) = fitted.min_by(|a, b| a.cost.total_cmp(&b.cost)) else { return };
    take_if_worth(bench, ladder, &other);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::cause::axis_tests::{ending_at, report_as, rubbing_axis};

    /// Friction of 80 N that a search left at half of it and at twice; where it is found there is nothing to be moved.
    #[test]
    fn what_was_found_on_the_wrong_side_is_found_again() {
        let (mut subject, nominal, rubs) = rubbing_axis();
        let stop = || false;
        let recorded = Bench::new(&subject, Vec::new(), &stop).predict(&rubs, &[80.0]).expect("a prediction");
        report_as(&mut subject, &recorded);
        let bench = Bench::new(&subject, Vec::new(), &stop);
        let ended = |at: f64| {
            let mut ladder = ending_at(&bench, &nominal, bench.trial(&rubs, vec![at]).expect("a trial"));
            seek_again(&bench, &mut ladder);
            ladder.best.at[0]
        };
        for at in [40.0, 65.0, 160.0] {
            assert!((ended(at) - 80.0).abs() < 0.1, "{at}: {}", ended(at));
        }
        assert_eq!(ended(80.0), 80.0);
    }
}
