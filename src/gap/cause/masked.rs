//! A belt that slips beyond an acceleration which its drive hardly exceeds: what moves looks as if the drive were no steeper than that, and the
//! nominal parameter has been fitted so. With it there the slip does nothing, and a little below it does too much, so that no slope leads from one to the
//! other: it is begun where the slip is what the drive was taken for, and the drive steeper by less or more of its tolerance.

use rayon::prelude::*;

use super::bench::{Bench, Trial};
use super::candidate::Candidate;
use super::ladder::anew;
use super::starts::UNLIMITED;
use crate::plant::EffectPlace;

/// By how many standard deviations the drive is begun steeper than it was taken for.
const STEEPER: [f64; 6] = [0.01, 0.03, 0.1, 0.3, 1.0, 2.0];
/// Which share of an excess must be gone where it is begun for it to be fitted.
const PROMISING: f64 = 0.3;

/// Of the candidates those that hide a nominal parameter of `below` so, all fitted; none where that begins with little of the `excess` gone.
pub fn masked(bench: &Bench<'_>, below: &Trial, excess: f64, library: &[Candidate]) -> Vec<Trial> {
    let hides = |candidate: &&Candidate| {
        let is_limit = candidate.effect.parameters.iter().any(|parameter| parameter.nominal >= UNLIMITED);
        is_limit && candidate.place == EffectPlace::Transmission && candidate.free.len() == 1
    };
    let hiding: Vec<&Candidate> = library.iter().filter(hides).collect();
    let fit = |candidate: &Candidate| {
        let set = [below.set.as_slice(), std::slice::from_ref(candidate)].concat();
        let starts = starts(bench, below, &set);
        let cheapest =
            starts.iter().filter_map(|at| Some(bench.trial(&set, at.clone())?.cost)).fold(below.cost, f64::min);
        let is_promising = below.cost - cheapest > PROMISING * excess;
        is_promising.then(|| bench.fit(&set, &starts, anew(starts.first()?.len()))).flatten()
    };
    hiding.into_par_iter().with_max_len(1).filter_map(fit).collect()
}

/// Places of all that is free with a set whose last candidate is a limit: that where the drive's own seems to be, and the drive's above it.
fn starts(bench: &Bench<'_>, below: &Trial, set: &[Candidate]) -> Vec<Vec<f64>> {
    let component = set.last().and_then(|candidate| candidate.component.as_deref()).unwrap_or_default();
    let is_own = |name: &str| name.contains("cceleration") && name.ends_with(component);
    let carried = bench.carried(set, &below.overrides);
    let Some((place, nuisance)) = bench.nuisances_beside(set).enumerate().find(|(_, nuisance)| is_own(nuisance.name))
    else {
        return Vec::new();
    };
    let seeming = carried[place];
    let most = nuisance.range().greatest;
    let steeper = STEEPER.iter().map(|by| seeming + by * nuisance.deviation).filter(|drive| *drive <= most);
    let with = |drive: f64| {
        let mut beside = carried.clone();
        beside[place] = drive;
        [&below.at[..below.parameters()], &[seeming], &beside].concat()
    };
    steeper.map(with).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::Overrides;
    use crate::gap::cause::axis_tests::report_as;
    use crate::gap::cause::library::candidates;
    use crate::gap::cause::nuisance::nuisances;
    use crate::gap::recorded_tests::{CROOKED_ROBOT, study};

    /// A robot's axis whose belt slips beyond 1.99 m/s², which its drive exceeds by a per cent.
    #[test]
    fn a_slip_that_the_drive_was_taken_for_is_found() {
        let mut robot = study(CROOKED_ROBOT).subject("Robot").expect("it moves").clone();
        let nominal = robot.predict(&[], &Overrides::none()).expect("a prediction");
        let score = robot.score(&nominal);
        let slips = candidates(&robot, &nominal, &score, &|id| id == "belt-slip-above-acceleration");
        let slip = slips.into_iter().find(|slip| slip.component.as_deref() == Some("X")).expect("a slip");
        let steep = Overrides::one("maxAccelerationX", 2.01);
        let recorded = robot.predict(&[slip.spec(&[1.99])], &steep).expect("a prediction");
        report_as(&mut robot, &recorded);
        let stop = || false;
        let bench = Bench::new(&robot, nuisances(&robot, &nominal), &stop);
        let start = bench.nominal(&[]);
        let bare = bench.fit(&[], std::slice::from_ref(&start), anew(start.len())).expect("a fit");
        let found = masked(&bench, &bare, bare.cost, &[slip]);
        let [found] = found.as_slice() else { panic!("{} found", found.len()) };
        assert!((found.at[0] - 1.99).abs() < 1e-3, "{:?} {} of {}", found.at, found.cost, bare.cost);
        let healthy = study(CROOKED_ROBOT);
        let motor = healthy.subject("Motor").expect("it moves");
        let nominal = motor.predict(&[], &Overrides::none()).expect("a prediction");
        let slips = candidates(motor, &nominal, &motor.score(&nominal), &|id| id == "belt-slip-above-acceleration");
        let bench = Bench::new(motor, nuisances(motor, &nominal), &stop);
        let bare = bench.trial(&[], bench.nominal(&[])).expect("a trial");
        assert!(!slips.is_empty() && masked(&bench, &bare, bare.cost, &slips).is_empty());
    }
}
