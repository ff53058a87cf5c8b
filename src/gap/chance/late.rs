//! Commands of which each comes late by a time of its own.
//!
//! A command moves the device when it arrives, and what is reported until the next one says when that was. So the delay of each is looked
//! for by itself: all commands of a port are given a delay, the same for all, and what each then costs until its next says which of the
//! delays is its own; each then comes nearer to its goal by halves. Where the commands so put off leave nothing of the gap, and the
//! delays scatter as nothing else that delays commands lets them (see [`jitter`](super::jitter)), it is the link that jitters. Commands that have not the
//! device for themselves have no say (see [`apart`](super::apart)).

use rayon::prelude::*;

use super::apart::Apart;
use super::jitter::jitter;
use super::known::Known;
use crate::gap::cause::{Bounds, Nuisance};
use crate::gap::overrides::Overrides;
use crate::gap::prediction::{Predicted, Prediction};
use crate::gap::subject::Subject;

/// The longest delay that is looked for, s, and the delays that are tried at first, each by so much longer than the one before: no longer
/// than half the shortest cycle of reports, which are what shows an edge.
pub(super) const MOST_S: f64 = 0.2;
const STEP_S: f64 = 5e-3;
/// How often the step is halved: to 10 µs, which is as well as an instant is known.
const HALVINGS: u32 = 9;
/// By how much a command must cost more with one delay than with another to tell them apart, in deviance: an edge costs 16.6 at most.
const TELLS: f64 = 10.0;
/// Within so much, in deviance, delays are one.
const SAME: f64 = 0.5;
/// By so much more, in deviance, what is found may be as well but for a chance of 5 %: a delay (edges are seen from one report to the next, and cost a little
/// more towards both), and the deviation of delays.
pub(super) const MAY_BE: f64 = 3.84;
/// How well a delay is known at best, s.
pub(super) const SURE_S: f64 = 1e-4;
/// How many commands must tell their delays.
pub(super) const ENOUGH: usize = 10;
/// How much of what the device costs as it is, and with the best delay for all commands, may be left once each has its own for it to be
/// worth a nearer look.
const WORTH_A_LOOK: f64 = 0.7;
/// How often the delays are then looked for anew beside the same nominal parameters.
const LOOKS: usize = 2;
/// By how many standard deviations each nominal parameter is moved with the delays.
const MOVED: [f64; 6] = [2.0, 1.0, 0.5, 0.25, 0.12, 0.06];
/// The longest task of a machine of which none is known, s.
const LONGEST_TASK_S: f64 = 2e-3;
/// How many commands of a port must rise, or fall, to say what their least delay is.
const IN_A_CLASS: usize = 5;

/// A change of a command.
#[derive(Clone, Copy, Debug)]
pub(super) struct Told {
    pub run: usize,
    /// Its place among the run's commands.
    pub index: usize,
    pub port: usize,
    pub at: f64,
    /// By how much it changes.
    pub rise: f64,
    /// How long the one before it had stood, s.
    pub stood: f64,
}

/// The delay of a command.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Delay {
    /// s.
    pub by: f64,
    /// How much longer or shorter it may be as well, in all, s.
    pub width: f64,
    /// Whether it matters to what is reported.
    pub tells: bool,
}

impl Delay {
    /// From when to when it may have been, s.
    pub fn within(&self) -> [f64; 2] {
        let half = 0.5 * self.width.max(SURE_S);
        [(self.by - half).max(0.0), self.by.max(0.0) + half]
    }
}

/// What a device costs, and how much of that is above its floor.
#[derive(Clone, Copy, Debug)]
struct Cost {
    all: f64,
    above: f64,
}

impl Cost {
    fn least(self, other: Cost) -> Cost {
        if other.all < self.all { other } else { self }
    }

    /// Whether so little is left beside what was, `before`: thousands of samples of a level cost what they cost, however late the commands are.
    fn is_worth_a_look(self, before: Cost) -> bool {
        self.all <= WORTH_A_LOOK * before.all || self.above.max(0.0) <= WORTH_A_LOOK * before.above
    }
}

/// The delays of all commands of a device.
#[derive(Clone)]
pub(super) struct Late<'a> {
    told: Vec<Told>,
    delays: Vec<Delay>,
    /// Which of them say when they came.
    apart: Apart,
    /// The delays that are tried of each, s.
    tried: Vec<f64>,
    /// Longer than this are delays that no task makes, s.
    task_s: f64,
    /// Whether the answer is wanted now: then the delays are not looked for any further.
    is_stopped: &'a (dyn Fn() -> bool + Sync),
}

impl<'a> Late<'a> {
    /// The delays of a device's commands, up to `most_s`, as its recordings show them; `None` where one delay does as well, or none does better.
    pub fn of(
        (subject, most_s): (&Subject, f64),
        known: Known<'_>,
        is_stopped: &'a (dyn Fn() -> bool + Sync),
    ) -> Option<Late<'a>> {
        let mut late = Late::in_time((subject, most_s), known, is_stopped)?;
        if (0..late.told.len()).filter(|at| late.apart.says(*at)).count() < ENOUGH {
            return None;
        }
        let mut same = late.clone();
        let none = late.clone();
        late.look(subject, known)?;
        late.ports().iter().try_for_each(|port| same.try_same(subject, known, *port))?;
        let [own, same, none] = [&late, &same, &none].map(|late| late.cost(subject, known));
        let (own, least) = (own?, none?.least(same?));
        if !own.is_worth_a_look(least) {
            return None;
        }
        late.again(subject, known)?;
        Some(late)
    }

    /// The same of a device whose commands are known to come late.
    pub fn known(
        (subject, most_s): (&Subject, f64),
        known: Known<'_>,
        is_stopped: &'a (dyn Fn() -> bool + Sync),
    ) -> Option<Late<'a>> {
        let mut late = Late::in_time((subject, most_s), known, is_stopped)?;
        late.look(subject, known)?;
        late.again(subject, known)?;
        Some(late)
    }

    /// All of a device's commands when they were given.
    fn in_time(
        (subject, most_s): (&Subject, f64),
        known: Known<'_>,
        is_stopped: &'a (dyn Fn() -> bool + Sync),
    ) -> Option<Late<'a>> {
        let told = told(subject);
        let apart = Apart::of(subject, known, &told, most_s)?;
        let steps = (most_s / STEP_S).round() as u32;
        let tried = (0..=steps).map(|k| f64::from(k) * STEP_S).collect();
        let known = subject.runs.iter().map(|run| run.task.every_s).fold(0.0, f64::max);
        let task_s = if known > 0.0 { known } else { LONGEST_TASK_S };
        Some(Late { delays: vec![Delay::default(); told.len()], told, apart, tried, task_s, is_stopped })
    }

    /// Looks for the delay of each command.
    fn look(&mut self, subject: &Subject, known: Known<'_>) -> Option<()> {
        let ports = self.ports();
        // What a port's commands have nothing to do with costs the same with all delays.
        ports.iter().try_for_each(|port| self.try_all(subject, known, *port))?;
        self.nearer(subject, known)
    }

    /// Looks for the delays anew from where they are, beside these nominal parameters.
    pub fn again(&mut self, subject: &Subject, known: Known<'_>) -> Option<()> {
        let ports = self.ports();
        let mut looks = ports.iter().cycle().take(LOOKS * ports.len());
        looks.try_for_each(|port| self.look_again(subject, known, *port))?;
        self.nearer(subject, known)
    }

    /// Moves the delays on from where they are, beside these nominal parameters.
    fn nearer(&mut self, subject: &Subject, known: Known<'_>) -> Option<()> {
        self.ports().iter().try_for_each(|port| self.come_nearer(subject, known, *port))
    }

    /// Finds those of the nominal parameters that may be off as well, each moved by less and less with the delays following: what one that is off makes of the way to
    /// each next speed the delays make good, so that neither is found beside the other as it stands. As far as there is time.
    pub fn with_nominal(&mut self, subject: &Subject, known: Known<'_>, nuisances: &[Nuisance]) -> Overrides {
        let strain = |overrides: &Overrides| {
            let of = |nuisance: &Nuisance| Some(nuisance.strain(*overrides.0.get(nuisance.name)?).powi(2));
            nuisances.iter().filter_map(of).sum::<f64>()
        };
        let cost = |late: &Late<'_>, overrides: &Overrides| {
            Some(late.cost(subject, Known { overrides, ..known })?.all + strain(overrides))
        };
        let moved = |overrides: &Overrides, nuisance: &Nuisance, strain: f64| {
            let mut there = overrides.clone();
            let value = there.0.entry(nuisance.name.to_owned()).or_insert(nuisance.nominal);
            *value = nuisance.range().clamp(*value + strain * nuisance.deviation);
            there
        };
        let mut best = known.overrides.clone();
        let Some(mut least) = cost(self, &best) else { return best };
        let ports_of = |nuisance: &Nuisance| {
            let predict = |strain: f64| {
                let overrides = &moved(known.overrides, nuisance, strain);
                Known { overrides, ..known }.predict(subject)
            };
            Some(self.apart.ports_between(subject, [&predict(-1.0)?, &predict(1.0)?]))
        };
        let each: Vec<(&Nuisance, Vec<usize>)> =
            nuisances.iter().filter_map(|nuisance| Some((nuisance, ports_of(nuisance)?))).collect();
        for (by, (nuisance, ports)) in MOVED.iter().flat_map(|by| each.iter().map(move |each| (by, each))) {
            let tried = |side: &f64| {
                let there = moved(&best, nuisance, side * by);
                let mut late = self.clone();
                let beside = Known { overrides: &there, ..known };
                ports.iter().try_for_each(|port| late.come_nearer(subject, beside, *port))?;
                Some((cost(&late, &there)?, late, there))
            };
            let tried: Vec<_> = [-1.0, 1.0].par_iter().filter_map(tried).collect();
            let lower = tried.into_iter().filter(|tried| tried.0 < least).min_by(|a, b| a.0.total_cmp(&b.0));
            if let Some((cost, late, there)) = lower {
                (least, *self, best) = (cost, late, there);
            }
        }
        best
    }

    fn ports(&self) -> Vec<usize> {
        ports(&self.told)
    }

    /// The same device with its commands when they came, as far as they say that.
    pub fn put_off(&self, subject: &Subject) -> Subject {
        put_off(&self.apart.seen(subject, &self.told), &self.told, |at| self.delays[at].by)
    }

    /// A device as far as its commands say when they came.
    pub fn seen((subject, most_s): (&Subject, f64), known: Known<'_>) -> Option<Subject> {
        let told = told(subject);
        Some(Apart::of(subject, known, &told, most_s)?.seen(subject, &told))
    }

    /// The deviation of the normal distribution whose absolute values the delays are, s, with its interval of 95 %; `None` where they
    /// are few, short, or go with something.
    pub fn sigma(&self) -> Option<Bounds> {
        let each = self.told.iter().copied().zip(self.delays.iter().copied()).enumerate();
        let telling: Vec<(Told, Delay)> = each
            .filter(|(at, (_, delay))| delay.tells && self.apart.says_alone(&self.told, *at))
            .map(|(_, each)| each)
            .collect();
        jitter(&telling, self.task_s)
    }

    /// Leaves to a switch by how much the least delay of the commands that raise a port, or lower it, is longer than that of others: what scatters begins at
    /// none. `None` where less than two such classes have enough commands to say what their least delay is.
    pub fn leave_to_a_switch(&mut self) -> Option<()> {
        let class = |told: &Told| (told.port, told.rise > 0.0);
        let mut classes: Vec<((usize, bool), Vec<f64>)> = Vec::new();
        for (at, (told, delay)) in self.told.iter().zip(&self.delays).enumerate() {
            if !delay.tells || !self.apart.says(at) {
                continue;
            }
            match classes.iter_mut().find(|(of, _)| *of == class(told)) {
                Some((_, delays)) => delays.push(delay.by),
                None => classes.push((class(told), vec![delay.by])),
            }
        }
        classes.retain(|(_, delays)| delays.len() >= IN_A_CLASS);
        if classes.len() < 2 {
            return None;
        }
        let least = |delays: &[f64]| delays.iter().copied().fold(f64::INFINITY, f64::min);
        let of_all = classes.iter().map(|(_, delays)| least(delays)).fold(f64::INFINITY, f64::min);
        for (told, delay) in self.told.iter().zip(&mut self.delays) {
            if let Some((_, delays)) = classes.iter().find(|(of, _)| *of == class(told)) {
                delay.by = (delay.by - (least(delays) - of_all)).max(0.0);
            }
        }
        Some(())
    }

    /// Gives each command of a port the best of all delays that are tried.
    fn try_all(&mut self, subject: &Subject, known: Known<'_>, port: usize) -> Option<()> {
        let cost = |by: &f64| self.costs(subject, known, port, |_| *by);
        let costs: Vec<Vec<f64>> = self.tried.par_iter().map(cost).collect::<Option<_>>()?;
        for (place, at) in self.of_port(port).collect::<Vec<_>>().into_iter().enumerate() {
            let along: Vec<f64> = costs.iter().map(|costs| costs[place]).collect();
            self.delays[at] = best(&self.tried, &along).0;
        }
        Some(())
    }

    /// Gives all commands of a port the delay that is the best for all of them.
    fn try_same(&mut self, subject: &Subject, known: Known<'_>, port: usize) -> Option<()> {
        let cost = |by: f64| Some(self.costs(subject, known, port, |_| by)?.iter().sum::<f64>());
        let costs: Vec<f64> = self.tried.par_iter().map(|by| cost(*by)).collect::<Option<_>>()?;
        let (Delay { mut by, .. }, mut least) = best(&self.tried, &costs);
        let mut step = STEP_S;
        for _ in 0..HALVINGS {
            step *= 0.5;
            for there in [by - step, by + step].map(|there| there.max(0.0)) {
                let cost = cost(there)?;
                if cost < least {
                    (by, least) = (there, cost);
                }
            }
        }
        for at in self.of_port(port).collect::<Vec<_>>() {
            self.delays[at].by = by;
        }
        Some(())
    }

    /// Tries all delays anew of each second command of a port, and then of the others, by what it and its next cost: where a command
    /// comes shows in how far the next has to go.
    fn look_again(&mut self, subject: &Subject, known: Known<'_>, port: usize) -> Option<()> {
        let own: Vec<usize> = self.of_port(port).collect();
        for turn in 0..2 {
            let is_meant = |place: usize| place % 2 == turn;
            let moved: Vec<bool> =
                (0..self.told.len()).map(|at| own.iter().position(|of| *of == at).is_some_and(is_meant)).collect();
            let cost =
                |by: &f64| self.costs(subject, known, port, |at| if moved[at] { *by } else { self.delays[at].by });
            let costs: Vec<Vec<f64>> = self.tried.par_iter().map(cost).collect::<Option<_>>()?;
            let now = self.costs(subject, known, port, |at| self.delays[at].by)?;
            let both = |costs: &[f64], place: usize| costs[place] + costs.get(place + 1).unwrap_or(&0.0);
            for place in (0..own.len()).filter(|place| is_meant(*place)) {
                let along: Vec<f64> = costs.iter().map(|costs| both(costs, place)).collect();
                let (delay, least) = best(&self.tried, &along);
                if least < both(&now, place) - SAME {
                    self.delays[own[place]] = delay;
                }
            }
        }
        Some(())
    }

    /// Moves the delays of a port's commands by halves to where each costs the least.
    fn come_nearer(&mut self, subject: &Subject, known: Known<'_>, port: usize) -> Option<()> {
        let mut step = STEP_S;
        for _ in 0..HALVINGS {
            step *= 0.5;
            let moved = |by: f64| self.costs(subject, known, port, |at| (self.delays[at].by + by).max(0.0));
            let [here, sooner, later] = [moved(0.0)?, moved(-step)?, moved(step)?];
            for (place, at) in self.of_port(port).collect::<Vec<_>>().into_iter().enumerate() {
                let by = match here[place].min(sooner[place]).min(later[place]) {
                    // What costs the same stays where it is, in the middle.
                    least if here[place] <= least + 0.02 * SAME => 0.0,
                    least if sooner[place] <= least => -step,
                    _ => step,
                };
                self.delays[at].by = (self.delays[at].by + by).max(0.0);
            }
        }
        Some(())
    }

    /// Which commands are a port's.
    fn of_port(&self, port: usize) -> impl Iterator<Item = usize> + use<'_> {
        self.told.iter().enumerate().filter(move |(_, told)| told.port == port).map(|(at, _)| at)
    }

    /// What the device costs with these delays, counters begun anew at each command.
    fn cost(&self, subject: &Subject, known: Known<'_>) -> Option<Cost> {
        let late = self.put_off(subject);
        let mut prediction = known.predict(&late)?;
        let starts: Vec<(usize, f64)> = self.told.iter().map(|told| (told.run, told.at)).collect();
        count_anew(&late, &mut prediction, &starts);
        let score = late.score(&prediction);
        let floor = score.signals.iter().map(|signal| signal.floor_cost.0).sum::<f64>();
        Some(Cost { all: score.total, above: score.total - floor })
    }

    /// What each command of a port costs until its next, those of the port coming late by `by`, all others as they do.
    fn costs(&self, subject: &Subject, known: Known<'_>, port: usize, by: impl Fn(usize) -> f64) -> Option<Vec<f64>> {
        if (self.is_stopped)() {
            return None;
        }
        let by = |at: usize| if self.told[at].port == port { by(at) } else { self.delays[at].by };
        let late = put_off(subject, &self.told, by);
        let mut prediction = known.predict(&late)?;
        let starts: Vec<(usize, f64)> = self.of_port(port).map(|at| (self.told[at].run, self.told[at].at)).collect();
        count_anew(&late, &mut prediction, &starts);
        let mut costs = vec![0.0; starts.len()];
        for (run, at, cost) in late.score(&prediction).costs() {
            let after = starts.partition_point(|start| *start <= (run, at));
            if let Some(place) = after.checked_sub(1).filter(|place| starts[*place].0 == run) {
                costs[place] += cost;
            }
        }
        Some(costs)
    }
}

/// The delay that costs the least of those that are tried, in the middle of all that cost no more; and what it costs.
fn best(tried: &[f64], along: &[f64]) -> (Delay, f64) {
    let least = along.iter().copied().fold(f64::INFINITY, f64::min);
    let best = along.iter().position(|cost| *cost <= least).unwrap_or(0);
    let last_within = |off: f64| (best..tried.len()).take_while(|k| along[*k] <= least + off).last().unwrap_or(best);
    let first_within = |off: f64| (0..=best).rev().take_while(|k| along[*k] <= least + off).last().unwrap_or(best);
    let most = along.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let by = 0.5 * (tried[best] + tried[last_within(SAME)]);
    let width = tried[last_within(MAY_BE)] - tried[first_within(MAY_BE)];
    (Delay { by, width, tells: most - least > TELLS }, least)
}

/// The ports that commands are of.
pub(super) fn ports(told: &[Told]) -> Vec<usize> {
    let mut ports: Vec<usize> = told.iter().map(|told| told.port).collect();
    ports.sort_unstable();
    ports.dedup();
    ports
}

/// The changes of all commands.
pub(super) fn told(subject: &Subject) -> Vec<Told> {
    let mut all = Vec::new();
    for (run, of) in subject.runs.iter().enumerate() {
        let mut last: Vec<(usize, f64, f64)> = Vec::new();
        for (index, (port, told)) in of.commands.iter().enumerate() {
            let known = last.iter().position(|(of, ..)| of == port);
            let place = known.unwrap_or_else(|| {
                last.push((*port, 0.0, 0.0));
                last.len() - 1
            });
            let (_, value, since) = last[place];
            if told.value != value {
                let (rise, stood) = (told.value - value, told.at - since);
                all.push(Told { run, index, port: *port, at: told.at, rise, stood });
                last[place] = (*port, told.value, told.at);
            }
        }
    }
    all
}

/// A device whose commands came later; of one port in the order in which they were given.
pub(super) fn put_off(subject: &Subject, told: &[Told], by: impl Fn(usize) -> f64) -> Subject {
    let mut late = subject.clone();
    for (at, command) in told.iter().enumerate() {
        let (_, stamped) = &mut late.runs[command.run].commands[command.index];
        stamped.at += by(at);
    }
    for run in &mut late.runs {
        let mut last: Vec<(usize, f64)> = Vec::new();
        for (port, stamped) in &mut run.commands {
            match last.iter_mut().find(|(of, _)| of == port) {
                Some((_, at)) => {
                    stamped.at = stamped.at.max(*at);
                    *at = stamped.at;
                }
                None => last.push((*port, stamped.at)),
            }
        }
        run.commands.sort_by(|a, b| a.1.at.total_cmp(&b.1.at));
    }
    late
}

/// Lets counters go on at each of `starts` from where they were found: what one command made of a count stays for ever after.
pub(super) fn count_anew(subject: &Subject, prediction: &mut Prediction, starts: &[(usize, f64)]) {
    for (at, (run, predicted)) in subject.runs.iter().zip(&mut prediction.runs).enumerate() {
        for (signal, _) in subject.signals.iter().enumerate().filter(|(_, info)| info.is_count) {
            let (Some(track), Predicted::Level(values)) = (&run.tracks[signal], &mut predicted[signal]) else {
                continue;
            };
            let instants = &track.grid.instants[track.first..];
            let starts = starts.iter().filter(|start| start.0 == at);
            let places: Vec<usize> =
                starts.map(|(_, start)| instants.partition_point(|instant| instant < start)).collect();
            track.count_on_at(&places, values);
        }
    }
}

/// A device whose commands are late by delays of a deviation, s.
#[cfg(test)]
pub(super) fn jittered(subject: &Subject, sigma: f64) -> Subject {
    put_off(subject, &told(subject), |at| sigma * super::jitter::scattered(at))
}

#[cfg(test)]
mod tests {
    use super::super::jitter::{delayed, drawn};
    use super::*;

    /// What scatters by 10 ms, and is 50 ms later each time it is switched off.
    #[test]
    fn delays_that_scatter_beside_a_switch_are_told_from_it() {
        let switched = delayed(|k, told| drawn(k) + if told.rise > 0.0 { 0.0 } else { 0.05 });
        let (told, delays): (Vec<Told>, Vec<Delay>) = switched.into_iter().unzip();
        let apart = Apart::of_one_port(vec![true; told.len()]);
        let mut late = Late { apart, told, delays, tried: Vec::new(), task_s: LONGEST_TASK_S, is_stopped: &|| false };
        assert!(late.sigma().is_none());
        late.leave_to_a_switch().expect("enough of both");
        let Bounds { value, .. } = late.sigma().expect("jitter");
        assert!((value / 0.01 - 1.0).abs() < 0.1, "{value}");
        let first = (0..late.told.len()).map(|k| k < 8).collect();
        let mut few = Late { apart: Apart::of_one_port(first), ..late };
        assert!(few.leave_to_a_switch().is_none());
    }

    /// Edges are seen within 20 ms, and cost a little more towards both ends of that.
    #[test]
    fn a_delay_is_known_to_within_what_costs_no_more_than_chance() {
        let tried: Vec<f64> = (0..=40).map(|k| f64::from(k) * STEP_S).collect();
        let best = |cost: &dyn Fn(f64) -> f64| best(&tried, &tried.iter().map(|by| cost(*by)).collect::<Vec<_>>());
        let (delay, least) = best(&|by| 20.0 * ((by - 0.05).abs() - 0.007).max(0.0) / 0.005);
        assert!((delay.by - 0.05).abs() < 3e-3 && delay.tells && least == 0.0, "{delay:?}");
        let (delay, _) = best(&|by| (1e3 * (by - 0.05).abs() / 6.0).powi(2));
        assert!((delay.by - 0.05).abs() < 1e-9 && (delay.width - 0.02).abs() < 1e-9, "{delay:?}");
    }
}
