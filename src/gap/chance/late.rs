//! Commands of which each comes late by a time of its own.
//!
//! A command moves the device when it arrives, and what is reported until the next one says when that was. So the delay of each is looked
//! for by itself: all commands of a port are given a delay, the same for all, and what each then costs until its next says which of the
//! delays is its own; each then comes nearer to its goal by halves. Where the commands so put off leave nothing of the gap, and the
//! delays scatter as nothing else that delays commands lets them, it is the link that jitters: a dead time has one delay for all, a switch
//! one for on and one for off, and what delays the longer the further a way is, the longer the rest before it was, or the longer the
//! machine has run goes with that. Commands that have not the device for themselves have no say (see [`apart`](super::apart)).

use rayon::prelude::*;

use super::apart::{apart, seen};
use super::known::Known;
use crate::gap::cause::Bounds;
use crate::gap::cost::normal;
use crate::gap::prediction::{Predicted, Prediction};
use crate::gap::statistics::rank_correlation;
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
const MAY_BE: f64 = 3.84;
/// How well a delay is known at best, s.
const SURE_S: f64 = 1e-4;
/// How many commands must tell their delays.
const ENOUGH: usize = 10;
/// How much of what the device costs as it is, and with the best delay for all commands, may be left once each has its own for it to be
/// worth a nearer look.
const WORTH_A_LOOK: f64 = 0.7;
/// How often the delays are then looked for anew beside the same nominal parameters.
const LOOKS: usize = 2;
/// How long the delays must be, root mean square, s: longer than a machine's task may make a command wait.
const LONGER_THAN_A_TASK_S: f64 = 2e-3;
/// How far delays must scatter about their mean, as a share of it, and in how many: of the half normal distribution it is 0.76.
const SCATTERED: f64 = 0.25;
const IN_A_CLASS: usize = 5;
/// How far rank correlations of delays may be from none, in standard deviations: 0.1 % each.
const UNRELATED: f64 = 3.3;

/// A change of a command.
#[derive(Clone, Copy, Debug)]
pub(super) struct Told {
    pub run: usize,
    /// Its place among the run's commands.
    index: usize,
    port: usize,
    pub at: f64,
    /// By how much it changes.
    rise: f64,
    /// How long the one before it had stood, s.
    stood: f64,
}

/// The delay of a command.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Delay {
    /// s.
    by: f64,
    /// How much longer or shorter it may be as well, in all, s.
    width: f64,
    /// Whether it matters to what is reported.
    tells: bool,
}

impl Delay {
    /// From when to when it may have been, s.
    fn within(&self) -> [f64; 2] {
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
    apart: Vec<bool>,
    /// Whether the answer is wanted now: then the delays are not looked for any further.
    is_stopped: &'a (dyn Fn() -> bool + Sync),
}

impl<'a> Late<'a> {
    /// The delays of a device's commands as its recordings show them; `None` where one delay does as well, or none does better.
    pub fn of(subject: &Subject, known: Known<'_>, is_stopped: &'a (dyn Fn() -> bool + Sync)) -> Option<Late<'a>> {
        let mut late = Late::in_time(subject, known, is_stopped)?;
        if late.apart.iter().filter(|is_apart| **is_apart).count() < ENOUGH {
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
    pub fn known(subject: &Subject, known: Known<'_>, is_stopped: &'a (dyn Fn() -> bool + Sync)) -> Option<Late<'a>> {
        let mut late = Late::in_time(subject, known, is_stopped)?;
        late.look(subject, known)?;
        late.again(subject, known)?;
        Some(late)
    }

    /// All of a device's commands when they were given.
    fn in_time(subject: &Subject, known: Known<'_>, is_stopped: &'a (dyn Fn() -> bool + Sync)) -> Option<Late<'a>> {
        let told = told(subject);
        let apart = apart(subject, known, &told)?;
        Some(Late { delays: vec![Delay::default(); told.len()], told, apart, is_stopped })
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

    fn ports(&self) -> Vec<usize> {
        let mut ports: Vec<usize> = self.told.iter().map(|told| told.port).collect();
        ports.sort_unstable();
        ports.dedup();
        ports
    }

    /// The same device with its commands when they came, as far as they say that.
    pub fn put_off(&self, subject: &Subject) -> Subject {
        put_off(&seen(subject, &self.told, &self.apart), &self.told, |at| self.delays[at].by)
    }

    /// A device as far as its commands say when they came.
    pub fn seen(subject: &Subject, known: Known<'_>) -> Option<Subject> {
        let told = told(subject);
        Some(seen(subject, &told, &apart(subject, known, &told)?))
    }

    /// The deviation of the normal distribution whose absolute values the delays are, s, with its interval of 95 %; `None` where they
    /// are few, short, or go with something.
    pub fn sigma(&self) -> Option<Bounds> {
        // Of two that are given at once the later one starts the device, and the other may have come any time before.
        let is_alone =
            |told: &Told| self.told.iter().filter(|other| (other.run, other.at) == (told.run, told.at)).count() == 1;
        let each = self.told.iter().copied().zip(self.delays.iter().copied()).zip(&self.apart);
        let telling: Vec<(Told, Delay)> = each
            .filter(|((told, delay), is_apart)| delay.tells && **is_apart && is_alone(told))
            .map(|(each, _)| each)
            .collect();
        jitter(&telling)
    }

    /// Leaves to a switch by how much the least delay of the commands that raise a port, or lower it, is longer than that of others: what scatters begins at
    /// none. `None` where less than two such classes have enough commands to say what their least delay is.
    pub fn leave_to_a_switch(&mut self) -> Option<()> {
        let class = |told: &Told| (told.port, told.rise > 0.0);
        let mut classes: Vec<((usize, bool), Vec<f64>)> = Vec::new();
        for ((told, delay), is_apart) in self.told.iter().zip(&self.delays).zip(&self.apart) {
            if !delay.tells || !is_apart {
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
        let costs: Vec<Vec<f64>> = tried().par_iter().map(cost).collect::<Option<_>>()?;
        for (place, at) in self.of_port(port).collect::<Vec<_>>().into_iter().enumerate() {
            let along: Vec<f64> = costs.iter().map(|costs| costs[place]).collect();
            self.delays[at] = best(&along).0;
        }
        Some(())
    }

    /// Gives all commands of a port the delay that is the best for all of them.
    fn try_same(&mut self, subject: &Subject, known: Known<'_>, port: usize) -> Option<()> {
        let cost = |by: f64| Some(self.costs(subject, known, port, |_| by)?.iter().sum::<f64>());
        let costs: Vec<f64> = tried().par_iter().map(|by| cost(*by)).collect::<Option<_>>()?;
        let (Delay { mut by, .. }, mut least) = best(&costs);
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
            let costs: Vec<Vec<f64>> = tried().par_iter().map(cost).collect::<Option<_>>()?;
            let now = self.costs(subject, known, port, |at| self.delays[at].by)?;
            let both = |costs: &[f64], place: usize| costs[place] + costs.get(place + 1).unwrap_or(&0.0);
            for place in (0..own.len()).filter(|place| is_meant(*place)) {
                let along: Vec<f64> = costs.iter().map(|costs| both(costs, place)).collect();
                let (delay, least) = best(&along);
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

/// The delays that are tried, s.
fn tried() -> Vec<f64> {
    (0..=(MOST_S / STEP_S) as u32).map(|k| f64::from(k) * STEP_S).collect()
}

/// The delay that costs the least of those that are tried, in the middle of all that cost no more; and what it costs.
fn best(along: &[f64]) -> (Delay, f64) {
    let tried = tried();
    let least = along.iter().copied().fold(f64::INFINITY, f64::min);
    let best = along.iter().position(|cost| *cost <= least).unwrap_or(0);
    let last_within = |off: f64| (best..tried.len()).take_while(|k| along[*k] <= least + off).last().unwrap_or(best);
    let first_within = |off: f64| (0..=best).rev().take_while(|k| along[*k] <= least + off).last().unwrap_or(best);
    let most = along.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let by = 0.5 * (tried[best] + tried[last_within(SAME)]);
    let width = tried[last_within(MAY_BE)] - tried[first_within(MAY_BE)];
    (Delay { by, width, tells: most - least > TELLS }, least)
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

/// Lets counters begin at each of `starts` with what was recorded: what one command made of a count stays for ever after.
pub(super) fn count_anew(subject: &Subject, prediction: &mut Prediction, starts: &[(usize, f64)]) {
    for (at, (run, predicted)) in subject.runs.iter().zip(&mut prediction.runs).enumerate() {
        for (signal, _) in subject.signals.iter().enumerate().filter(|(_, info)| info.is_count) {
            let (Some(track), Predicted::Level(values)) = (&run.tracks[signal], &mut predicted[signal]) else {
                continue;
            };
            let instants = &track.grid.instants[track.first..];
            let starts = starts.iter().filter(|start| start.0 == at);
            let mut firsts: Vec<usize> =
                starts.map(|(_, start)| instants.partition_point(|instant| instant < start)).collect();
            let count = values.len();
            firsts.push(count);
            for span in firsts.windows(2).filter(|span| span[0] < span[1] && span[1] <= count) {
                let off = track.values[span[0]] + 0.5 - values[span[0]];
                values[span[0]..span[1]].iter_mut().for_each(|value| *value += off);
            }
        }
    }
}

/// The deviation of delays that scatter by themselves, s.
fn jitter(telling: &[(Told, Delay)]) -> Option<Bounds> {
    let n = telling.len() as f64;
    if telling.len() < ENOUGH {
        return None;
    }
    let within: Vec<[f64; 2]> = telling.iter().map(|(_, delay)| delay.within()).collect();
    let bounds = likeliest(&within);
    if bounds.value <= LONGER_THAN_A_TASK_S {
        return None;
    }
    let rising = |told: &Told| told.rise > 0.0;
    let is_scattered = |rises: bool| {
        let class: Vec<f64> =
            telling.iter().filter(|(told, _)| rising(told) == rises).map(|(_, delay)| delay.by).collect();
        let mean = class.iter().sum::<f64>() / class.len().max(1) as f64;
        let variance = class.iter().map(|by| (by - mean).powi(2)).sum::<f64>() / class.len().max(1) as f64;
        class.len() < IN_A_CLASS || variance.sqrt() > SCATTERED * mean
    };
    let delays: Vec<f64> = telling.iter().map(|(_, delay)| delay.by).collect();
    let goes_with = |of: &dyn Fn(&Told) -> f64| {
        let others: Vec<f64> = telling.iter().map(|(told, _)| of(told)).collect();
        rank_correlation(&delays, &others).abs() * (n - 1.0).sqrt() > UNRELATED
    };
    let is_bound = goes_with(&|told| told.rise.abs())
        || goes_with(&|told| f64::from(u8::from(rising(told))))
        || goes_with(&|told| told.stood)
        || goes_with(&|told| told.at);
    if is_bound || !is_scattered(true) || !is_scattered(false) || !is_drawn(&within, bounds.value) {
        return None;
    }
    Some(bounds)
}

/// The deviation of the normal distribution among whose absolute values intervals are the likeliest, s, with what is as likely but for what a
/// chance of 5 % makes.
///
/// Source: the likelihood of observations that are known to within intervals, and its ratio (J. F. Lawless, Statistical Models and Methods for Lifetime
/// Data, Wiley 2003, section 2.2).
fn likeliest(within: &[[f64; 2]]) -> Bounds {
    const UNLIKELY: f64 = 1e-12;
    let below = |at: f64, sigma: f64| 2.0 * normal(at / sigma) - 1.0;
    let deviance = |log: f64| -> f64 {
        let of = |[from, to]: &[f64; 2]| below(*to, log.exp()) - below(*from, log.exp());
        within.iter().map(|within| -2.0 * of(within).max(UNLIKELY).ln()).sum()
    };
    let [mut low, mut high] = [SURE_S, 1.0].map(f64::ln);
    let ends = [low, high];
    for _ in 0..100 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        (low, high) = if deviance(a) < deviance(b) { (low, b) } else { (a, high) };
    }
    let best = 0.5 * (low + high);
    let least = deviance(best);
    let end = |mut far: f64| {
        let mut near = best;
        for _ in 0..60 {
            let middle = 0.5 * (near + far);
            if deviance(middle) < least + MAY_BE { near = middle } else { far = middle }
        }
        near.exp()
    };
    Bounds { value: best.exp(), interval: ends.map(end), is_identifiable: true }
}

/// Whether delays may be the absolute values of a normal distribution of `sigma`, and not one delay for some commands and none for others. One
/// that is known to within an interval is anywhere in it, the next elsewhere.
///
/// Source: the test of Kolmogorov and Smirnov with its limit at 1 % error for many (N. V. Smirnov, Ann. Math. Statist. 19, 1948); that the
/// deviation is found of the same delays makes it err less often.
fn is_drawn(within: &[[f64; 2]], sigma: f64) -> bool {
    const LIMIT: f64 = 1.63;
    const GOLDEN: f64 = 0.618_033_988_749_895;
    let below = |at: f64| 2.0 * normal(at / sigma) - 1.0;
    let share = |(k, [from, to]): (usize, &[f64; 2])| {
        let there = (GOLDEN * k as f64).fract();
        below(*from) + there * (below(*to) - below(*from))
    };
    let mut shares: Vec<f64> = within.iter().enumerate().map(share).collect();
    shares.sort_by(f64::total_cmp);
    let n = shares.len() as f64;
    let off = |(k, share): (usize, &f64)| (share - k as f64 / n).abs().max((share - (k + 1) as f64 / n).abs());
    shares.iter().enumerate().map(off).fold(0.0, f64::max) * n.sqrt() <= LIMIT
}

/// The quantiles of the half normal distribution, 40 in no order.
#[cfg(test)]
fn scattered(k: usize) -> f64 {
    let share = (((k * 17) % 40) as f64 + 0.5) / 40.0;
    let (mut low, mut high) = (0.0, 8.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let below = 2.0 * normal(middle) - 1.0;
        (low, high) = if below < share { (middle, high) } else { (low, middle) };
    }
    low
}

/// A device whose commands are late by delays of a deviation, s.
#[cfg(test)]
pub(super) fn jittered(subject: &Subject, sigma: f64) -> Subject {
    put_off(subject, &told(subject), |at| sigma * scattered(at))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Forty changes to and fro, each as late as `by` says.
    fn delayed(by: impl Fn(usize, &Told) -> f64) -> Vec<(Told, Delay)> {
        let of = |k: usize| {
            let rise = if k.is_multiple_of(2) { 1.0 } else { -1.0 } * (1.0 + ((k * 5) % 7) as f64);
            let stood = 0.5 + 0.1 * ((k * 11) % 13) as f64;
            let told = Told { run: 0, index: k, port: 0, at: k as f64, rise, stood };
            (told, Delay { by: by(k, &told), width: 0.0, tells: true })
        };
        (0..40).map(of).collect()
    }

    /// Delays of a deviation of 10 ms.
    fn drawn(k: usize) -> f64 {
        0.01 * scattered(k)
    }

    #[test]
    fn delays_that_scatter_tell_their_deviation() {
        let Bounds { value, interval: [least, most], .. } = jitter(&delayed(|k, _| drawn(k))).expect("jitter");
        assert!((value / 0.01 - 1.0).abs() < 0.05, "{value}");
        // The deviance of 40 absolute values of a normal distribution whose deviation is r times theirs.
        let rise = |r: f64| 40.0 * (2.0 * r.ln() + 1.0 / (r * r) - 1.0);
        assert!(
            (rise(least / value) - 3.84).abs() < 0.05 && (rise(most / value) - 3.84).abs() < 0.05,
            "{least} {most}"
        );
    }

    /// What scatters by 10 ms, and is 50 ms later each time it is switched off.
    #[test]
    fn delays_that_scatter_beside_a_switch_are_told_from_it() {
        let switched = delayed(|k, told| drawn(k) + if told.rise > 0.0 { 0.0 } else { 0.05 });
        let (told, delays): (Vec<Told>, Vec<Delay>) = switched.into_iter().unzip();
        let mut late = Late { apart: vec![true; told.len()], told, delays, is_stopped: &|| false };
        assert!(late.sigma().is_none());
        late.leave_to_a_switch().expect("enough of both");
        let Bounds { value, .. } = late.sigma().expect("jitter");
        assert!((value / 0.01 - 1.0).abs() < 0.1, "{value}");
        let mut few = late.clone();
        few.apart.iter_mut().skip(8).for_each(|apart| *apart = false);
        assert!(few.leave_to_a_switch().is_none());
    }

    /// Edges are seen within 20 ms, and cost a little more towards both ends of that.
    #[test]
    fn a_delay_is_known_to_within_what_costs_no_more_than_chance() {
        let cost = |by: f64| 20.0 * ((by - 0.05).abs() - 0.007).max(0.0) / 0.005;
        let (delay, least) = best(&tried().into_iter().map(cost).collect::<Vec<_>>());
        assert!((delay.by - 0.05).abs() < 3e-3 && delay.tells && least == 0.0, "{delay:?}");
        let soft = |by: f64| (1e3 * (by - 0.05).abs() / 6.0).powi(2);
        let (delay, _) = best(&tried().into_iter().map(soft).collect::<Vec<_>>());
        assert!((delay.by - 0.05).abs() < 1e-9 && (delay.width - 0.02).abs() < 1e-9, "{delay:?}");
    }

    /// A flag that is looked at every 20 ms.
    #[test]
    fn delays_that_are_known_to_within_a_cycle_tell_their_deviation() {
        let seen = |k: usize| 0.02 * ((drawn(k) + 5e-4 * (k % 40) as f64) / 0.02).floor();
        let mut delays = delayed(|k, _| (seen(k) + 0.01 - 5e-4 * (k % 40) as f64).max(0.0));
        delays.iter_mut().for_each(|(_, delay)| delay.width = 0.02);
        let Bounds { value, interval: [least, most], .. } = jitter(&delays).expect("jitter");
        assert!((value / 0.01 - 1.0).abs() < 0.3 && least < 0.01 && 0.01 < most, "{value} {least} {most}");
    }

    #[test]
    fn delays_that_go_with_something_are_no_jitter() {
        assert!(jitter(&delayed(|k, _| 0.01 + 1e-2 * drawn(k))).is_none(), "a dead time");
        assert!(jitter(&delayed(|k, told| if told.rise > 0.0 { 0.02 } else { 1e-2 * drawn(k) })).is_none(), "a switch");
        assert!(jitter(&delayed(|_, told| 0.01 * told.rise.abs())).is_none(), "a slow drive");
        assert!(jitter(&delayed(|_, told| 0.01 * (told.stood - 0.5))).is_none(), "what sticks after a rest");
        assert!(jitter(&delayed(|_, told| 1e-3 * told.at)).is_none(), "what warms up");
        assert!(jitter(&delayed(|k, _| 0.05 * drawn(k))).is_none(), "a task");
        let some = |k: usize, _: &Told| if (k * 17) % 40 < 12 { 0.09 } else { 1e-4 };
        assert!(jitter(&delayed(some)).is_none(), "a delay of some commands");
    }
}
