//! A device under test: candidates in, deviance out.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::candidate::{Candidate, Free};
use super::latest::Latest;
use super::nuisance::Nuisance;
use super::tangent::{orthonormal, take_out};
use crate::gap::fit::{self, Effort, Fitted, Range, Residuals, sum_of_squares};
use crate::gap::statistics::inflation;
use crate::gap::{Overrides, Predicted, Prediction, Run, Score, Subject, WINDOW_S};
use crate::plant::{EffectPlace, EffectSpec};

/// The length of a block of time, s: at least some correlation times of a residual.
pub const BLOCK_S: f64 = 2.0;

/// How often a rugged deviance is computed for each parameter, and for once more.
const TRIALS: u32 = 60;

/// A device, and what all fits of it have in common.
pub struct Bench<'a> {
    pub subject: &'a Subject,
    /// Nominal parameters that are fitted with every candidate, within their tolerances.
    pub nuisances: Vec<Nuisance>,
    /// Whoever waits for the answer wants it now.
    pub stop: &'a (dyn Fn() -> bool + Sync),
    replays: Arc<AtomicUsize>,
    latest: Arc<Latest>,
}

/// A set of candidates with their parameters, and what it costs.
#[derive(Clone, Debug)]
pub struct Trial {
    pub set: Vec<Candidate>,
    /// The free parameters of the set, in its order, then the nuisances.
    pub at: Vec<f64>,
    pub ranges: Vec<Range>,
    /// The deviance, with what the nuisances cost.
    pub cost: f64,
    /// The deviance of each block of time.
    pub blocks: Vec<f64>,
    /// The correlation of neighbouring residuals.
    pub correlation: f64,
    /// The nuisances as they were fitted.
    pub overrides: Overrides,
}

impl Trial {
    /// How many free parameters the candidates have.
    pub fn parameters(&self) -> usize {
        self.set.iter().map(|candidate| candidate.free.len()).sum()
    }

    /// How many times too large the deviance is for its correlation.
    pub fn inflation(&self) -> f64 {
        inflation(self.correlation)
    }

    /// The free parameters of each candidate.
    pub fn values(&self) -> impl Iterator<Item = (&Candidate, &[f64])> {
        let mut rest = self.at.as_slice();
        self.set.iter().map(move |candidate| {
            let (own, others) = rest.split_at(candidate.free.len());
            rest = others;
            (candidate, own)
        })
    }

    /// The same with the last candidate of the set at `place` of it.
    pub fn with_last_at(mut self, place: usize) -> Trial {
        let own = self.parameters();
        let Some(last) = self.set.pop() else { return self };
        let before: usize = self.set[..place].iter().map(|candidate| candidate.free.len()).sum();
        self.at[before..own].rotate_right(last.free.len());
        self.ranges[before..own].rotate_right(last.free.len());
        self.set.insert(place, last);
        self
    }

    /// The same with the candidate at `place` of the set as its last.
    pub fn with_last(mut self, place: usize) -> Trial {
        let own = self.parameters();
        let before: usize = self.set[..place].iter().map(|candidate| candidate.free.len()).sum();
        let candidate = self.set.remove(place);
        self.at[before..own].rotate_left(candidate.free.len());
        self.ranges[before..own].rotate_left(candidate.free.len());
        self.set.push(candidate);
        self
    }

    /// The effects that it adds.
    pub fn specs(&self) -> Vec<EffectSpec> {
        self.values().map(|(candidate, at)| candidate.spec(at)).collect()
    }

    /// As one that a search ended with.
    pub fn fitted(&self) -> Fitted {
        Fitted { at: self.at.clone(), cost: self.cost, curvature: Vec::new(), evaluations: 0 }
    }
}

impl<'a> Bench<'a> {
    /// A device with the nominal parameters that are free with every candidate.
    pub fn new(subject: &'a Subject, nuisances: Vec<Nuisance>, stop: &'a (dyn Fn() -> bool + Sync)) -> Bench<'a> {
        Bench { subject, nuisances, stop, replays: Arc::default(), latest: Arc::default() }
    }

    /// The same with the device as `subject` weighs it: what it predicts stays what it is.
    pub fn with<'b>(&'b self, subject: &'b Subject) -> Bench<'b> {
        Bench { latest: self.latest.clone(), ..self.of_part(subject) }
    }

    /// The same with a part of the device's recordings.
    pub fn of_part<'b>(&'b self, subject: &'b Subject) -> Bench<'b> {
        let (nuisances, replays) = (self.nuisances.clone(), self.replays.clone());
        Bench { subject, nuisances, stop: self.stop, replays, latest: Arc::default() }
    }

    /// The device, weighed by what `trial` leaves of it.
    pub fn tolerant(&self, trial: &Trial) -> Option<Subject> {
        Some(self.subject.tolerant(&*self.predict(&trial.set, &trial.at)?))
    }

    /// How often the device was replayed so far.
    pub fn replays(&self) -> usize {
        self.replays.load(Ordering::Relaxed)
    }

    /// Whether the answer is wanted now.
    pub fn is_stopped(&self) -> bool {
        (self.stop)()
    }

    /// Whether slopes of the deviance lead nowhere: of a device whose errors decide what comes later.
    pub fn is_rugged(&self) -> bool {
        self.subject.is_taken_up_again()
    }

    /// The nuisances that a set leaves free: not those that it sets itself.
    pub fn nuisances_beside<'b>(&'b self, set: &'b [Candidate]) -> impl Iterator<Item = &'b Nuisance> {
        let is_set = |nuisance: &&Nuisance| {
            let sets = |candidate: &Candidate| {
                candidate.is_parameter_error() && candidate.component.as_deref() == Some(nuisance.name)
            };
            !set.iter().any(sets)
        };
        self.nuisances.iter().filter(is_set)
    }

    /// What the device reports with `set` at `at`; nuisances for which `at` holds no value are nominal.
    pub fn predict(&self, set: &[Candidate], at: &[f64]) -> Option<Arc<Prediction>> {
        let mut rest = at;
        let mut specs = Vec::with_capacity(set.len());
        for candidate in set {
            let (own, others) = rest.split_at_checked(candidate.free.len())?;
            specs.push(candidate.spec(own));
            rest = others;
        }
        self.latest.or_replay(specs, self.overrides(set, at), |specs, overrides| {
            self.replays.fetch_add(1, Ordering::Relaxed);
            self.subject.predict(specs, overrides).ok()
        })
    }

    /// The nuisances beside `set` that `at` holds a value for.
    fn overrides(&self, set: &[Candidate], at: &[f64]) -> Overrides {
        let own: usize = set.iter().map(|candidate| candidate.free.len()).sum();
        let values = at.iter().skip(own);
        let nuisances = self.nuisances_beside(set).zip(values);
        Overrides(nuisances.map(|(nuisance, value)| (nuisance.name.to_owned(), *value)).collect())
    }

    /// The residuals of a set, those of the nuisances' tolerances behind.
    pub fn residuals(&self, set: &[Candidate], at: &[f64]) -> Option<Vec<f64>> {
        if self.is_stopped() {
            return None;
        }
        let mut residuals = self.subject.residuals(&*self.predict(set, at)?);
        residuals.extend(self.strain(set, at));
        Some(residuals)
    }

    /// How far the nuisances lie from nominal, each in its standard deviation.
    pub fn strain(&self, set: &[Candidate], at: &[f64]) -> Vec<f64> {
        let own: usize = set.iter().map(|candidate| candidate.free.len()).sum();
        let values = at.iter().skip(own);
        self.nuisances_beside(set).zip(values).map(|(nuisance, value)| nuisance.strain(*value)).collect()
    }

    /// The ranges of all that is free with `set`.
    pub fn ranges(&self, set: &[Candidate]) -> Vec<Range> {
        let own = set.iter().flat_map(Candidate::ranges);
        own.chain(self.nuisances_beside(set).map(Nuisance::range)).collect()
    }

    /// The nominal values of the nuisances beside `set`.
    pub fn nominal(&self, set: &[Candidate]) -> Vec<f64> {
        self.nuisances_beside(set).map(|nuisance| nuisance.nominal).collect()
    }

    /// The nuisances beside `set` as `fitted` has them, else nominal.
    pub fn carried(&self, set: &[Candidate], fitted: &Overrides) -> Vec<f64> {
        let of = |nuisance: &Nuisance| fitted.0.get(nuisance.name).copied().unwrap_or(nuisance.nominal);
        self.nuisances_beside(set).map(of).collect()
    }

    /// The nuisances beside `set` by name, and how far each may be off.
    pub fn names_beside<'b>(&'b self, set: &'b [Candidate]) -> impl Iterator<Item = &'static str> + 'b {
        self.nuisances_beside(set).map(|nuisance| nuisance.name)
    }

    /// The standard deviations of the nuisances beside `set`.
    pub fn deviations_beside(&self, set: &[Candidate]) -> Vec<f64> {
        self.nuisances_beside(set).map(|nuisance| nuisance.deviation).collect()
    }

    /// The set of a trial without one of its effects: what the others are at, the nuisances nominal.
    pub fn without(&self, trial: &Trial, place: usize) -> (Vec<Candidate>, Vec<f64>) {
        let mut set = trial.set.clone();
        let before: usize = set[..place].iter().map(|candidate| candidate.free.len()).sum();
        let removed = set.remove(place);
        let mut at = trial.at[..trial.parameters()].to_vec();
        at.drain(before..before + removed.free.len());
        at.extend(self.nominal(&set));
        (set, at)
    }

    /// Fits a set from the best of `starts`, which hold a value for each of its ranges.
    pub fn fit(&self, set: &[Candidate], starts: &[Vec<f64>], effort: Effort) -> Option<Trial> {
        let ranges = self.ranges(set);
        let residuals = |at: &[f64]| self.residuals(set, at);
        let residuals: &Residuals<'_> = &residuals;
        let found = match self.is_rugged() {
            true => fit::rugged(residuals, starts, &ranges, TRIALS * (1 + ranges.len() as u32))?,
            false => fit::search(residuals, starts, &ranges, effort)?,
        };
        self.trial(set, found.at)
    }

    /// Where the times of a set are that commands are late by, if the machine takes them up in cycles of a task; empty else.
    pub fn times_of_commands(&self, set: &[Candidate]) -> Vec<usize> {
        let all = set.iter().flat_map(|candidate| candidate.free.iter().map(|free| (candidate.place, free)));
        let is_meant = |place: EffectPlace, free: &Free| free.is_time && place == EffectPlace::CommandLink;
        let times = all.enumerate().filter(|(_, (place, free))| is_meant(*place, free)).map(|(at, _)| at);
        if self.longest_task() > 0.0 { times.collect() } else { Vec::new() }
    }

    fn longest_task(&self) -> f64 {
        self.subject.runs.iter().map(Run::command_tick).fold(0.0, f64::max)
    }

    /// The same with each time that commands are late by where that costs less, up to two cycles of the machine's task away, all else following it.
    /// What is taken up in cycles comes a whole one later or not, command by command, so that no slope leads from one to the other.
    pub fn across_cycles(&self, trial: &Trial) -> Option<Trial> {
        const FURTHEST: f64 = 2.0;
        const NEAREST: f64 = 1.0 / 64.0;
        let times = self.times_of_commands(&trial.set);
        if times.is_empty() {
            return None;
        }
        let residuals = |at: &[f64]| self.residuals(&trial.set, at);
        let known = fit::Slopes::of(&residuals, &trial.at, &trial.ranges)?;
        let others: Vec<usize> = (0..trial.at.len()).filter(|place| !times.contains(place)).collect();
        let basis = orthonormal(&others.iter().map(|place| known.column(*place)).collect::<Vec<_>>());
        let left = |mut residuals: Vec<f64>| {
            take_out(&mut residuals, &basis);
            sum_of_squares(&residuals)
        };
        let (mut at, mut least) = (trial.at.clone(), left(known.here().to_vec()));
        let (cycle, mut steps) = (self.longest_task(), FURTHEST);
        while steps >= NEAREST {
            let mut is_nearer = false;
            for place in &times {
                let range = trial.ranges[*place];
                for time in [steps, -steps].map(|steps| at[*place] + steps * cycle) {
                    let mut there = at.clone();
                    there[*place] = time;
                    let is_within = (range.least..=range.greatest).contains(&time);
                    let Some(cost) = residuals(&there).filter(|_| is_within).map(left) else { continue };
                    if cost < least {
                        (at, least, is_nearer) = (there, cost, true);
                    }
                }
            }
            if !is_nearer {
                steps *= 0.5;
            }
        }
        let there = self.trial(&trial.set, at)?;
        let found = self.following(&there, &times).unwrap_or(there);
        (found.cost < trial.cost).then_some(found)
    }

    /// The same with all but these places fitted a little: where no slope leads along a number, none that is taken along with it does.
    pub fn following(&self, trial: &Trial, held: &[usize]) -> Option<Trial> {
        const STEPS: u32 = 3;
        let others: Vec<usize> = (0..trial.at.len()).filter(|place| !held.contains(place)).collect();
        let with = |own: &[f64]| {
            let mut all = trial.at.clone();
            others.iter().zip(own).for_each(|(place, value)| all[*place] = *value);
            all
        };
        let own: Vec<f64> = others.iter().map(|place| trial.at[*place]).collect();
        if own.is_empty() {
            return None;
        }
        let ranges: Vec<Range> = others.iter().map(|place| trial.ranges[*place]).collect();
        let residuals = |own: &[f64]| self.residuals(&trial.set, &with(own));
        let found = fit::least_squares(&residuals, &own, &ranges, STEPS * (own.len() as u32 + 2))?;
        self.trial(&trial.set, with(&found.at)).filter(|found| found.cost < trial.cost)
    }

    /// Where the periods of a set are that are known to a part of themselves over the recording.
    pub fn periods(&self, set: &[Candidate]) -> Vec<usize> {
        let all =
            set.iter().flat_map(|candidate| candidate.free.iter().map(|free| (candidate.effect.id, free.is_time)));
        all.enumerate().filter(|(_, (id, is_time))| *id == "stale-hold" && *is_time).map(|(place, _)| place).collect()
    }

    /// What a set costs at `at`.
    pub fn trial(&self, set: &[Candidate], at: Vec<f64>) -> Option<Trial> {
        let score = self.subject.score(&*self.predict(set, &at)?);
        let strain = fit::sum_of_squares(&self.strain(set, &at));
        Some(Trial {
            ranges: self.ranges(set),
            cost: score.total + strain,
            blocks: self.blocks(&score),
            correlation: self.correlation(&score).min(self.most_correlated()),
            overrides: self.overrides(set, &at),
            set: set.to_vec(),
            at,
        })
    }

    /// The correlation of each residual with the next of its signal, all levels together, beyond that of the noise, which each
    /// sample's weight knows of.
    fn correlation(&self, score: &Score) -> f64 {
        let (mut products, mut squares) = (0.0, 0.0);
        for (signal, level) in score.signals.iter().filter_map(|signal| Some((signal, signal.level.as_ref()?))) {
            let floor = &self.subject.runs[signal.run].floors[signal.signal];
            let memory = if floor.misfit > 0.0 { 0.0 } else { floor.memory };
            let own = sum_of_squares(&level.residual);
            products += level.residual.windows(2).map(|pair| pair[0] * pair[1]).sum::<f64>() - memory * own;
            squares += own;
        }
        if squares > 0.0 { products / squares } else { 0.0 }
    }

    /// How far residuals may remember: those of a window know nothing of those of another, so that there are at least as many
    /// independent ones as windows.
    fn most_correlated(&self) -> f64 {
        if !self.is_rugged() {
            return 1.0;
        }
        let cycles = self.subject.runs.iter().flat_map(|run| run.tracks.iter().flatten()).map(|track| track.grid.cycle);
        let within = WINDOW_S / cycles.fold(f64::INFINITY, f64::min).max(1e-6);
        ((within - 1.0) / (within + 1.0)).clamp(0.0, 1.0)
    }

    /// How far `set`, with all that is free beside it, stays from `output` when it is fitted to it: whitened and squared.
    /// `at` is where the fit begins.
    pub fn distance(&self, output: &Prediction, set: &[Candidate], at: &[f64]) -> Option<f64> {
        let apart = |at: &[f64]| self.apart(output, set, at);
        let ranges = self.ranges(set);
        if ranges.is_empty() {
            return Some(fit::sum_of_squares(&apart(at)?));
        }
        Some(fit::least_squares(&apart, at, &ranges, 10 + 8 * ranges.len() as u32)?.cost)
    }

    /// How `set` at `at` differs from `output`, whitened, those of the nuisances' tolerances behind.
    pub fn apart(&self, output: &Prediction, set: &[Candidate], at: &[f64]) -> Option<Vec<f64>> {
        let mut residuals = self.subject.apart(output, &*self.predict(set, at)?);
        residuals.extend(self.strain(set, at));
        (!self.is_stopped()).then_some(residuals)
    }

    /// How many blocks a run has.
    pub fn blocks_of(&self, run: &Run) -> usize {
        (run.ends / BLOCK_S).ceil().max(1.0) as usize
    }

    /// In how many blocks of time of all runs something is predicted to change: a level by more than a step, or a flag.
    pub fn moving_blocks(&self, prediction: &Prediction) -> usize {
        let block = |at: f64| (at.max(0.0) / BLOCK_S) as usize;
        let of = |(run, predicted): (&Run, &Vec<Predicted>)| {
            let mut moving = BTreeSet::new();
            for (signal, predicted) in predicted.iter().enumerate() {
                let Some(track) = &run.tracks[signal] else { continue };
                match predicted {
                    Predicted::Level(values) => {
                        let pairs = track.grid.instants[track.first..].iter().zip(values.windows(2));
                        let moved = pairs.filter(|(_, pair)| (pair[1] - pair[0]).abs() > run.floors[signal].step);
                        moving.extend(moved.map(|(at, _)| block(*at)));
                    }
                    Predicted::Edges { edges, .. } => moving.extend(edges.iter().map(|edge| block(edge.at))),
                    Predicted::Nothing => {}
                }
            }
            moving.len()
        };
        self.subject.runs.iter().zip(&prediction.runs).map(of).sum()
    }

    /// The deviance of each block of time of all runs.
    pub fn blocks(&self, score: &Score) -> Vec<f64> {
        let counts = self.subject.runs.iter().map(|run| self.blocks_of(run));
        let mut firsts = vec![0];
        firsts.extend(counts.scan(0, |sum, count| {
            *sum += count;
            Some(*sum)
        }));
        let mut blocks = vec![0.0; *firsts.last().unwrap_or(&0)];
        for (run, at, cost) in score.costs() {
            let inside = (at.max(0.0) / BLOCK_S) as usize;
            blocks[(firsts[run] + inside).min(firsts[run + 1] - 1)] += cost;
        }
        blocks
    }

    /// Whether two predictions differ by more than a tenth of a step, RMS, in any signal, or in an edge.
    pub fn differ(&self, one: &Prediction, other: &Prediction) -> bool {
        let runs = self.subject.runs.iter().zip(one.runs.iter().zip(&other.runs));
        runs.into_iter().any(|(run, (one, other))| {
            let pairs = one.iter().zip(other).zip(&run.floors);
            pairs.into_iter().any(|((one, other), floor)| one.differs(other, 0.1 * floor.step))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::cause::axis_tests::{report_as, rubbing_axis};
    use crate::gap::cause::library::candidates;

    /// A candidate goes from one place of a set to another with its own numbers.
    #[test]
    fn a_candidate_takes_its_numbers_along() {
        let (subject, nominal, rubs) = rubbing_axis();
        let one = |id: &str| candidates(&subject, &nominal, &subject.score(&nominal), &|of| of == id).swap_remove(0);
        let set = [rubs[0].clone(), one("stribeck-friction"), one("constant-force")];
        let stop = || false;
        let bench = Bench::new(&subject, Vec::new(), &stop);
        let trial = bench.trial(&set, vec![1.0, 2.0, 0.3, 4.0]).expect("a trial");
        let ids = |trial: &Trial| trial.set.iter().map(|candidate| candidate.effect.id).collect::<Vec<_>>();
        let first = trial.clone().with_last_at(0);
        assert_eq!(ids(&first), ["constant-force", "coulomb-friction", "stribeck-friction"]);
        assert_eq!(first.at, [4.0, 1.0, 2.0, 0.3]);
        assert_eq!(first.ranges, [trial.ranges[3], trial.ranges[0], trial.ranges[1], trial.ranges[2]]);
        let last = trial.clone().with_last(1);
        assert_eq!(ids(&last), ["coulomb-friction", "constant-force", "stribeck-friction"]);
        assert_eq!(last.at, [1.0, 4.0, 2.0, 0.3]);
        let back = last.with_last_at(1);
        assert_eq!((ids(&back), back.at), (ids(&trial), trial.at));
    }

    /// An axis whose task takes its commands up every 2 ms, and that gets them 12.3 ms late: 11.6 ms late it would take some up one cycle too soon, and
    /// 10.3 ms late all.
    #[test]
    fn a_time_is_found_across_the_cycles_of_a_task() {
        let (mut subject, nominal, _) = rubbing_axis();
        let delays = candidates(&subject, &nominal, &subject.score(&nominal), &|id| id == "dead-time");
        let is_meant = |of: &Candidate| of.place == EffectPlace::CommandLink;
        let set = [delays.into_iter().find(is_meant).expect("a delay of all commands")];
        subject.runs[0].task.every_s = 2e-3;
        let stop = || false;
        let recorded = Bench::new(&subject, Vec::new(), &stop).predict(&set, &[0.0123]).expect("a prediction");
        report_as(&mut subject, &recorded);
        let bench = Bench::new(&subject, Vec::new(), &stop);
        let trial = |late: f64| bench.trial(&set, vec![late]).expect("a trial");
        for from in [0.0103, 0.0116, 0.0149] {
            let found = bench.across_cycles(&trial(from)).expect("one that costs less");
            // To a 64th of a cycle, within which some command comes a cycle late or not.
            let is_near = (found.at[0] - 0.0123).abs() < 4e-5 && found.cost < 0.1 * trial(from).cost;
            assert!(is_near, "{:?} {} {}", found.at, found.cost, trial(from).cost);
        }
        assert!(bench.across_cycles(&trial(0.0123)).is_none());
        // A gain that is off moves an axis much as a delay does: it follows, wherever the delay goes.
        let gain = Nuisance { name: "positionGain", nominal: 25.0, deviation: 0.125, reach: 2.1 };
        let bench = Bench::new(&subject, vec![gain], &stop);
        let beside = bench.trial(&set, vec![0.0108, 24.8]).expect("a trial");
        let found = bench.across_cycles(&beside).expect("one that costs less");
        assert!(found.cost < 0.05 * beside.cost, "{:?} {} {}", found.at, found.cost, beside.cost);
        let mut at_once = subject.clone();
        at_once.runs[0].task.every_s = 0.0;
        let early = Bench::new(&subject, Vec::new(), &stop).trial(&set, vec![0.0103]).expect("a trial");
        assert!(Bench::new(&at_once, Vec::new(), &stop).across_cycles(&early).is_none());
    }
}
