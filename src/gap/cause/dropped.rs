//! What goes from a ladder's best set again: what is no longer worth having beside the others, of what the recordings hold no number, and what stands beside
//! a friction that lets go at once.

use super::bench::{Bench, Trial};
use super::candidate::Candidate;
use super::intervals::{intervals, of_each};
use super::ladder::{Ladder, TO_STAY, anew, is_worth, is_worth_having};
use super::remainder::remainder;

/// Takes out what is no longer worth having once the others stand beside it; whether there was something. Of two of which neither
/// is worth having without the other, both stay if they are together.
pub fn drop_idle(bench: &Bench<'_>, ladder: &mut Ladder) -> bool {
    let subject = ladder.subject.clone();
    let weighed = bench.with(&subject);
    let whole = ladder.best.clone();
    let (mut place, mut is_dropped) = (0, false);
    while ladder.best.set.len() > 1 && place < ladder.best.set.len() && !bench.is_stopped() {
        match fitted_without(&weighed, &ladder.best, place) {
            Some(without) if !is_worth(&weighed, (&without, &ladder.best), ladder, TO_STAY) => {
                (ladder.best, is_dropped) = (without, true);
            }
            _ => place += 1,
        }
    }
    if whole.set.len() > ladder.best.set.len() + 1 && is_worth_having(&weighed, &ladder.best, &whole, ladder) {
        (ladder.best, is_dropped) = (whole, false);
    }
    is_dropped
}

/// Takes out one of several effects of which the recordings hold no number, or one that may be none, where the others leave nothing without it;
/// whether there was one. What a law leaves of a gross gap some other effect takes up a part of, at the end of what it may be or within a `tick`
/// of the machine, s: that is no second cause.
pub fn drop_unknown(bench: &Bench<'_>, ladder: &mut Ladder, tick: f64) -> bool {
    if ladder.best.set.len() < 2 || bench.is_stopped() {
        return false;
    }
    let weighed = bench.with(&ladder.subject);
    let bounds = intervals(&weighed, &ladder.best, None, tick);
    let mut found: Option<Ladder> = None;
    for (place, (candidate, own)) in of_each(&ladder.best.set, &bounds).enumerate() {
        let is_known = own.iter().any(|bounds| bounds.is_identifiable) && !candidate.may_do_nothing(own);
        if own.is_empty() || is_known {
            continue;
        }
        let Some(best) = fitted_without(&weighed, &ladder.best, place) else { continue };
        let is_better = found.as_ref().is_none_or(|found| best.cost < found.best.cost);
        let without = Ladder { best, ..ladder.clone() };
        let leaves_nothing = || remainder(bench, &without).is_some_and(|left| !left.is_large && !left.is_significant);
        if is_better && leaves_nothing() {
            found = Some(without);
        }
    }
    found.map(|found| *ladder = found).is_some()
}

/// Whether an effect with these values is a friction that falls within a hundredth of the axis's speeds: one that lets go at once, told with a
/// number more.
pub fn lets_go_at_once(candidate: &Candidate, at: &[f64]) -> bool {
    /// Of a velocity's scale, which is two hundredths of the highest speed.
    const AT_ONCE: f64 = 0.5;
    let velocity = candidate.free.iter().zip(at).find(|(free, _)| free.name == "velocity");
    candidate.effect.id == "stribeck-friction"
        && velocity.is_some_and(|(free, velocity)| *velocity < AT_ONCE * free.range.scale)
}

/// Takes out what stands beside a friction that lets go at once where that alone leaves no more than friction may: a joint bends by some
/// micrometres before it slides, which a stiff spring beside it would tell.
pub fn leave_alone_what_lets_go(bench: &Bench<'_>, ladder: &mut Ladder) {
    let best = &ladder.best;
    let Some((friction, own)) = best.values().find(|(candidate, own)| lets_go_at_once(candidate, own)) else { return };
    if best.set.len() < 2 || bench.is_stopped() {
        return;
    }
    let weighed = bench.with(&ladder.subject);
    let set = [friction.clone()];
    let start = [own, &weighed.carried(&set, &best.overrides)].concat();
    let Some(alone) = weighed.fit(&set, std::slice::from_ref(&start), anew(start.len())) else { return };
    let alone = Ladder { best: alone, ends: None, ..ladder.clone() };
    if remainder(bench, &alone).is_some_and(|left| !left.is_large && !left.is_significant) {
        *ladder = alone;
    }
}

/// The best set without one of its effects, fitted anew.
fn fitted_without(bench: &Bench<'_>, best: &Trial, place: usize) -> Option<Trial> {
    let (set, at) = bench.without(best, place);
    bench.fit(&set, &[at], anew(bench.ranges(&set).len()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::cause::axis_tests::{ending_at, report_as, rubbing_axis};
    use crate::gap::cause::library::candidates;

    /// Friction explains an axis to the last step; a lag beside it, as short as one may be, is none.
    #[test]
    fn an_effect_at_the_end_of_what_it_may_be_goes_where_the_others_leave_nothing() {
        let (mut subject, nominal, rubs) = rubbing_axis();
        let lags = candidates(&subject, &nominal, &subject.score(&nominal), &|id| id == "first-order-lag");
        let lag = lags.into_iter().next().expect("a lag");
        let stop = || false;
        let recorded = Bench::new(&subject, Vec::new(), &stop).predict(&rubs, &[30.0]).expect("a prediction");
        report_as(&mut subject, &recorded);
        let bench = Bench::new(&subject, Vec::new(), &stop);
        let shortest = lag.free[0].range.least;
        let set = vec![rubs[0].clone(), lag];
        let at = vec![30.0, shortest];
        let mut ladder = ending_at(&bench, &nominal, bench.trial(&set, at).expect("a trial"));
        assert!(drop_unknown(&bench, &mut ladder, 0.0));
        let left: Vec<&str> = ladder.best.set.iter().map(|candidate| candidate.effect.id).collect();
        assert_eq!(left, ["coulomb-friction"]);
        assert!(!drop_unknown(&bench, &mut ladder, 0.0));
    }

    /// A spring beside a joint that lets go at once, as stiff as bristles are, is how the joint bends.
    #[test]
    fn what_lets_go_at_once_stands_alone() {
        let (mut subject, nominal, _) = rubbing_axis();
        let one = |id: &str| {
            let found = candidates(&subject, &nominal, &subject.score(&nominal), &|of| of == id);
            found.into_iter().next().expect("a candidate")
        };
        let (falls, spring) = (one("stribeck-friction"), one("compliance"));
        let stop = || false;
        let own = [30.0, 1e-3];
        assert!(lets_go_at_once(&falls, &own) && !lets_go_at_once(&falls, &[30.0, 1.0]));
        let recorded =
            Bench::new(&subject, Vec::new(), &stop).predict(std::slice::from_ref(&falls), &own).expect("a prediction");
        report_as(&mut subject, &recorded);
        let bench = Bench::new(&subject, Vec::new(), &stop);
        let stiff = spring.free.iter().map(|free| free.range.greatest);
        let at: Vec<f64> = own.into_iter().chain(stiff).collect();
        let mut ladder = ending_at(&bench, &nominal, bench.trial(&[falls, spring], at).expect("a trial"));
        leave_alone_what_lets_go(&bench, &mut ladder);
        let left: Vec<&str> = ladder.best.set.iter().map(|candidate| candidate.effect.id).collect();
        assert_eq!(left, ["stribeck-friction"]);
    }
}
