//! The devices that have a say in what is common to all: what of their levels moves, how that goes with the age of reports and with nominal
//! parameters that may be off, and what they say together.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::{EXPLAINED, LEAST_DEVICES, LEAST_SQUARE, MOST_AGE_S, NEARER, Task};
use crate::effect::EffectError;
use crate::gap::cause::{Nuisance, nuisances};
use crate::gap::locate::THRESHOLD;
use crate::gap::overrides::Overrides;
use crate::gap::prediction::{Predicted, Prediction};
use crate::gap::subject::Subject;
use crate::gap::track::Track;
use crate::prototype::kind::PortDescriptor;
use crate::value::Quantity;

/// How often nominal parameters are fitted under a task, and how many standard deviations off they are taken to be at most.
const CENTRINGS: u32 = 6;
const SHORTENINGS: u32 = 3;
const FURTHEST: f64 = 3.0;
/// From which standard deviations a counter's parameter is looked for that was not found, how far from those that lead to what was found, and how
/// many floors' squares are left of it then.
const ELSEWHERE: [f64; 4] = [-2.0, -1.0, 1.0, 2.0];
const NO_NEARER: f64 = 0.25;
const FAR_FROM_COUNTS: f64 = 2.0;
/// How often levels are weighed anew by what is left of them.
const WEIGHINGS: u32 = 3;
/// By how many standard deviations a nominal parameter is moved to see how the samples move with it. What a whole one does is no slope:
/// whether a ramp ends before the next command, and where all that follows is, may turn within it.
const NUDGE: f64 = 0.02;
/// The least age from which slopes are taken, s.
const LEAST_SPAN_S: f64 = 1e-4;
/// How much nearer each of the others must come where they contradict one, in deviance: χ² of one degree of freedom at 0.1 %.
pub(super) const SURELY_NEARER: f64 = 10.83;
/// What is so many times further off than the greatest age could move it, such as metres that are told as millimetres, has no say where
/// anything else of the device has.
const FAR_OFF: f64 = 30.0;
/// Beyond this mean square in floors a level is not near what is recorded.
const NEAR: f64 = 4.0;
/// Steps of the age, s, and into how many the best one's neighbourhood is divided.
const STEP_S: f64 = 2e-5;
const FINER: i32 = 10;

/// A device that has a say: what of its levels moves, and how that goes with nominal parameters that may be off.
#[derive(Clone)]
pub(super) struct Voter {
    pub subject: Subject,
    /// Samples that move, by signal and place in its track.
    pub kept: Vec<(usize, usize)>,
    /// How many independent samples they are.
    pub count: f64,
    /// Nominal parameters with a tolerance, and how many standard deviations each is taken to be off.
    free: Vec<Nuisance>,
    pub strain: DVector<f64>,
    /// How far a standard deviation more of each of them moves the samples, in floors.
    pub columns: DMatrix<f64>,
    /// How far each second of age moves them, in floors.
    pub slopes: DVector<f64>,
    /// What these are to each other; `None` until they are known.
    alike: Option<Alike>,
}

/// The columns' products where all samples weigh the same: hundreds of tasks are tried between two changes of the columns.
#[derive(Clone)]
struct Alike {
    /// Of the nominal parameters, with what is known of them beforehand.
    own: Cholesky<f64, Dyn>,
    /// Of these and the age.
    together: Cholesky<f64, Dyn>,
    /// By how many standard deviations further off each parameter is for each second of age.
    by_age: DVector<f64>,
}

impl Alike {
    fn of(columns: &DMatrix<f64>, slopes: &DVector<f64>) -> Option<Alike> {
        let count = columns.ncols();
        let known = columns.tr_mul(columns) + DMatrix::identity(count, count);
        let beside = columns.tr_mul(slopes);
        let mut all = known.clone().resize(count + 1, count + 1, 0.0);
        for (place, product) in beside.iter().enumerate() {
            all[(place, count)] = -product;
            all[(count, place)] = -product;
        }
        all[(count, count)] = slopes.norm_squared() + MOST_AGE_S.powi(-2);
        let own = known.cholesky()?;
        let by_age = own.solve(&beside);
        Some(Alike { own, together: all.cholesky()?, by_age })
    }
}

/// What the nominal parameters can take of what is left of a device's levels.
struct Taken {
    /// By how many standard deviations further off each is for that.
    by: DVector<f64>,
    /// The same for each second of age.
    by_age: DVector<f64>,
    /// Whether some would have to be further off than anybody builds.
    is_far: bool,
}

impl Voter {
    /// A subject of one run; `None` where nothing moves.
    pub fn new(subject: Subject) -> Result<Option<Voter>, EffectError> {
        let nominal = subject.predict(&[], &Overrides::none())?;
        let mut voter = Voter {
            kept: Vec::new(),
            count: 0.0,
            free: nuisances(&subject, &nominal),
            strain: DVector::zeros(0),
            columns: DMatrix::zeros(0, 0),
            slopes: DVector::zeros(0),
            alike: None,
            subject,
        };
        voter.keep(voter.moving(&nominal));
        if voter.kept.is_empty() {
            return Ok(None);
        }
        voter.strain = DVector::zeros(voter.free.len());
        Ok(Some(voter))
    }

    /// Takes the nominal parameters to be what they are known to be.
    pub fn begin_at(&mut self, known: &Overrides) -> Result<(), EffectError> {
        for (nuisance, strain) in self.free.iter().zip(self.strain.iter_mut()) {
            *strain = known.0.get(nuisance.name).map_or(0.0, |value| nuisance.strain(*value));
        }
        self.linearise(self.subject.runs[0].task)
    }

    /// Takes the nominal parameters to be what they are best under a task: how they move the samples is no straight line. What of a counter
    /// is far off then is looked for from elsewhere, too: whatever a ramp a per cent too steep gains stays in it, and a command that a task takes
    /// up a cycle later makes up for some of it, so that what is best nearby need not be best.
    pub fn centre(&mut self, task: Task) -> Result<(), EffectError> {
        let cost = self.centre_from(task)?;
        if !self.is_a_counter() || cost < FAR_FROM_COUNTS * self.count {
            return Ok(());
        }
        let mut best = (cost, self.clone());
        for strain in ELSEWHERE {
            if (strain - best.1.strain[0]).abs() < NO_NEARER {
                continue;
            }
            self.strain[0] = strain;
            let cost = self.centre_from(task)?;
            if cost < best.0 {
                best = (cost, self.clone());
            }
        }
        *self = best.1;
        Ok(())
    }

    /// The same, and lets what was far off with the nominal parameters as they are declared have its say with those that it is known to have, where it is far off
    /// no more: each ramp of a motor that is two per cent steeper leaves counts, and what they sum up to had made its encoder be heard no more.
    pub fn centre_all(&mut self, task: Task) -> Result<(), EffectError> {
        self.centre(task)?;
        let kept = self.moving(&self.subject.predict(&[], &self.overrides())?);
        if kept.len() > self.kept.len() {
            self.keep(kept);
            self.centre(task)?;
        }
        Ok(())
    }

    fn keep(&mut self, kept: Vec<(usize, usize)>) {
        self.count = kept.iter().map(|(place, _)| self.subject.runs[0].floors[*place].share()).sum();
        self.kept = kept;
    }

    /// Whether it counts, and one nominal parameter alone may be off.
    pub fn is_a_counter(&self) -> bool {
        self.free.len() == 1 && self.kept.iter().any(|(place, _)| self.subject.signals[*place].is_count)
    }

    /// As little as it can cost under any task unless its floors are too high.
    pub fn least_cost(&self) -> f64 {
        self.count * (2.0 * LEAST_SQUARE).ln()
    }

    /// Whether it is a counter of which a task that costs it so much leaves much.
    pub fn is_far_at(&self, cost: f64) -> bool {
        self.is_a_counter() && self.mean_square_at(cost) > FAR_FROM_COUNTS
    }

    /// The same, from where they are taken to be; what is left then.
    fn centre_from(&mut self, task: Task) -> Result<f64, EffectError> {
        let under = self.under(task);
        self.linearise(task)?;
        let rest_of = |voter: &Voter| -> Result<DVector<f64>, EffectError> {
            Ok(voter.rest(&under.predict(&[], &voter.overrides())?) + &voter.slopes * task.age_s)
        };
        let mut rest = rest_of(self)?;
        let is_far = self.taken(&rest).is_far;
        let cost_of = |voter: &Voter, rest: &DVector<f64>| {
            let by_level = || voter.sums(rest, &voter.slopes).iter().map(|of| of.cost_at(0.0)).sum::<f64>();
            voter.strain.norm_squared() + if is_far { by_level() } else { rest.norm_squared() }
        };
        let left = |voter: &Voter| -> Result<(DVector<f64>, f64), EffectError> {
            let rest = rest_of(voter)?;
            let cost = cost_of(voter, &rest);
            Ok((rest, cost))
        };
        let mut cost = cost_of(self, &rest);
        for _ in 0..CENTRINGS {
            let mut step = self.taken(&rest).by;
            let from = self.strain.clone();
            let before = cost;
            for _ in 0..SHORTENINGS {
                // Further off nobody builds: what asks for it is a gap.
                self.strain = (&from + &step).map(|strain| strain.clamp(-FURTHEST, FURTHEST));
                cost = left(self)?.1;
                if cost <= before {
                    break;
                }
                step *= 0.5;
            }
            self.linearise(task)?;
            if before - cost < NEARER {
                break;
            }
            (rest, cost) = left(self)?;
        }
        Ok(cost)
    }

    /// Finds how the samples move with the nominal parameters, and with their age. The latter is asked of the model: between two reports
    /// of a coarse cycle an axis may speed up and be slow again, and their difference knows nothing of it.
    fn linearise(&mut self, task: Task) -> Result<(), EffectError> {
        let under = self.under(task);
        let base = self.rest(&under.predict(&[], &self.overrides())?);
        let age_s = task.age_s.max(LEAST_SPAN_S);
        let mut older = under.clone();
        older.set_task(0, Task { age_s, filter_s: 0.0, ..task });
        self.slopes = (self.rest(&older.predict(&[], &self.overrides())?) - &base) / age_s;
        self.columns = DMatrix::zeros(base.len(), self.free.len());
        for column in 0..self.free.len() {
            let mut beside = self.overrides();
            beside.0.insert(self.free[column].name.to_owned(), self.free[column].at(self.strain[column] + NUDGE));
            let moved = self.rest(&under.predict(&[], &beside)?);
            self.columns.set_column(column, &((&base - &moved) / NUDGE));
        }
        self.alike = Alike::of(&self.columns, &self.slopes);
        Ok(())
    }

    /// What the nominal parameters can take of `rest` within what they may be off. Where that, whatever the age of the reports, would be further than
    /// anybody builds, each level has a scale of error of its own: of an axis that goes the wrong way they would be strained by thousands,
    /// and that would be all that anybody hears; of one whose position hangs on a play its force says what its mass is.
    fn taken(&self, rest: &DVector<f64>) -> Taken {
        let count = self.free.len();
        let Some(alike) = &self.alike else {
            return Taken { by: DVector::zeros(count), by_age: DVector::zeros(count), is_far: false };
        };
        let strain = self.strain.clone().insert_row(count, 0.0);
        let asked = self.columns.tr_mul(rest) - &self.strain;
        let mut together = alike.together.solve(&asked.clone().insert_row(count, -self.slopes.dot(rest)));
        if (&strain + &together).rows(0, count).amax() <= FURTHEST {
            return Taken { by: alike.own.solve(&asked), by_age: alike.by_age.clone(), is_far: false };
        }
        let mut weights = DVector::from_element(rest.len(), 1.0);
        let mut all = self.columns.clone().insert_column(count, 0.0);
        all.set_column(count, &-&self.slopes);
        let mut known = DVector::from_element(count + 1, 1.0);
        known[count] = MOST_AGE_S.powi(-2);
        for _ in 0..WEIGHINGS {
            let sums = self.sums(&(rest - &all * &together), &self.slopes);
            let weight = |place: usize| {
                let of = sums.iter().find(|of| of.place == place);
                of.map_or(0.0, |of| 1.0 / (of.squares / of.count).max(1.0))
            };
            weights.iter_mut().zip(&self.kept).for_each(|(own, (place, _))| *own = weight(*place));
            together = solved((&all, &weights), &known, rest, &strain);
        }
        let beforehand = DVector::from_element(count, 1.0);
        let columns = (&self.columns, &weights);
        Taken {
            by: solved(columns, &beforehand, rest, &self.strain),
            by_age: solved(columns, &beforehand, &self.slopes, &DVector::zeros(count)),
            is_far: true,
        }
    }

    /// The squares of `rest`, by level, and how they go with the age of the reports.
    fn sums(&self, rest: &DVector<f64>, slopes: &DVector<f64>) -> Vec<Sums> {
        let of = |place: usize| Sums { place, ..Sums::default() };
        let mut signals: Vec<Sums> = (0..self.subject.signals.len()).map(of).collect();
        for ((place, _), (rest, slope)) in self.kept.iter().zip(rest.iter().zip(slopes.iter())) {
            let of = &mut signals[*place];
            of.squares += rest * rest;
            of.slopes += slope * slope;
            of.products += rest * slope;
            of.count += self.subject.runs[0].floors[*place].share();
        }
        signals.retain(|of| of.count > 0.0);
        signals
    }

    /// The nominal parameters as they are taken to be.
    pub fn overrides(&self) -> Overrides {
        let each = self.free.iter().zip(&self.strain);
        Overrides(each.map(|(nuisance, strain)| (nuisance.name.to_owned(), nuisance.at(*strain))).collect())
    }

    /// The subject under a task that is told at once.
    fn under(&self, task: Task) -> Subject {
        let mut subject = self.subject.clone();
        subject.set_tick(0, 0.0, 0.0);
        subject.set_task(0, Task { age_s: 0.0, filter_s: 0.0, ..task });
        subject
    }

    fn moving(&self, nominal: &Prediction) -> Vec<(usize, usize)> {
        let run = &self.subject.runs[0];
        let (mut kept, mut far_off) = (Vec::new(), Vec::new());
        for (place, predicted) in nominal.runs[0].iter().enumerate() {
            // A force jumps with its command: a sample beside the jump is off by all of it, or by nothing.
            let port = &self.subject.kind.ports[self.subject.signals[place].port];
            if port.quantities.iter().any(|of| [Quantity::Force, Quantity::Torque].contains(of)) {
                continue;
            }
            if let (Some(track), Predicted::Level(values)) = (&run.tracks[place], predicted) {
                let floor = run.floors[place].rms(0.0);
                let moves = |k: &usize| slope(track, values, *k).abs() * MOST_AGE_S > 0.1 * floor;
                let seen = (1..values.len().saturating_sub(1)).filter(|k| !track.is_blind(track.first + k));
                let moving: Vec<usize> = seen.filter(moves).collect();
                let square = |of: &dyn Fn(usize) -> f64| moving.iter().map(|k| of(*k).powi(2)).sum::<f64>();
                let off = square(&|k| track.values[k] - values[k]);
                let by_age = square(&|k| MOST_AGE_S * slope(track, values, k)) + square(&|_| floor);
                let is_far_off = off > FAR_OFF.powi(2) * by_age;
                let to = if is_far_off { &mut far_off } else { &mut kept };
                to.extend(moving.iter().map(|k| (place, *k)));
            }
        }
        if kept.is_empty() { far_off } else { kept }
    }

    /// What is left of each sample, in floors; where noise remembers, as much less as it tells less.
    fn rest(&self, prediction: &Prediction) -> DVector<f64> {
        let run = &self.subject.runs[0];
        let of = |&(place, k): &(usize, usize)| match (&run.tracks[place], &prediction.runs[0][place]) {
            (Some(track), Predicted::Level(values)) => {
                let half = if self.subject.signals[place].is_count { 0.5 } else { 0.0 };
                let floor = run.floors[place];
                let unit = floor.rms(0.0) / floor.share().sqrt();
                (track.values[k] + half - values[k]) / unit
            }
            _ => 0.0,
        };
        DVector::from_iterator(self.kept.len(), self.kept.iter().map(of))
    }

    /// What is left of each sample as the run has it.
    pub fn left(&self) -> Result<DVector<f64>, EffectError> {
        Ok(self.rest(&self.subject.predict(&[], &self.overrides())?))
    }

    /// The mean square that [`Moments::cost`] came from, the geometric mean of its levels.
    pub fn mean_square_at(&self, cost: f64) -> f64 {
        if self.count > 0.0 { (cost / self.count).exp() - LEAST_SQUARE } else { f64::INFINITY }
    }

    /// Whether a task explains one of several signals to its floor that was off by far more without it: another may have a gap of its own.
    pub fn has_explained_signal(&self, task: Task) -> Result<bool, EffectError> {
        let squares = |under: &Subject, age_s: f64| -> Result<Vec<f64>, EffectError> {
            let rest = self.rest(&under.predict(&[], &self.overrides())?) + &self.slopes * age_s;
            let rest = &rest - &self.columns * self.taken(&rest).by;
            let mut sums = vec![0.0; self.subject.signals.len()];
            self.kept.iter().zip(rest.iter()).for_each(|((place, _), rest)| sums[*place] += rest * rest);
            Ok(sums)
        };
        let (before, after) = (squares(&self.subject, 0.0)?, squares(&self.under(task), task.age_s)?);
        let share = |place: usize| self.subject.runs[0].floors[place].share();
        let count = |place: usize| self.kept.iter().filter(|(of, _)| *of == place).count() as f64 * share(place);
        let is_explained = |place: usize| {
            let (count, square) = (count(place), |sum: f64| LEAST_SQUARE + sum / count(place));
            count > 0.0
                && after[place] < EXPLAINED * count
                && count * (square(before[place]) / square(after[place])).ln() > THRESHOLD
        };
        Ok((0..before.len()).any(is_explained))
    }

    /// The same device with those levels alone that are near what is recorded under a task; `None` where none is.
    pub fn near(&self, task: Task) -> Result<Option<Voter>, EffectError> {
        let near = self.moments(Some(task))?.near(task.age_s);
        let is_near = |(place, _): &(usize, usize)| near.signals.iter().any(|of| of.place == *place);
        let kept: Vec<(usize, usize)> = self.kept.iter().copied().filter(is_near).collect();
        let count = near.signals.iter().map(|of| of.count).sum();
        Ok((!kept.is_empty()).then(|| Voter { kept, count, ..self.clone() }))
    }

    /// What is left under a task, or as the run has it.
    pub fn moments(&self, task: Option<Task>) -> Result<Moments, EffectError> {
        let under = task.map_or_else(|| self.subject.clone(), |task| self.under(task));
        let (rest, slopes) = (self.rest(&under.predict(&[], &self.overrides())?), &self.slopes);
        // What the nominal parameters can take of them within their tolerances is taken off.
        let taken = self.taken(&rest);
        let (rest, slopes) = (rest - &self.columns * &taken.by, slopes - &self.columns * &taken.by_age);
        let signals = self.sums(&rest, &slopes);
        // What they are strained by for that.
        let (strain, by_age) = (&self.strain + &taken.by, taken.by_age);
        let strained = Sums {
            squares: strain.norm_squared(),
            slopes: by_age.norm_squared(),
            products: strain.dot(&by_age),
            ..Sums::default()
        };
        Ok(Moments { ports: self.subject.kind.ports, signals, strained })
    }
}

/// What takes the most of `rest`, by columns and how much each sample weighs; `beforehand`: what is known of each, 1/variance, and what it is off by
/// (`strain`).
fn solved(
    (columns, weights): (&DMatrix<f64>, &DVector<f64>),
    beforehand: &DVector<f64>,
    rest: &DVector<f64>,
    strain: &DVector<f64>,
) -> DVector<f64> {
    let mut weighed = columns.clone();
    weighed.row_iter_mut().zip(weights.iter()).for_each(|(mut row, weight)| row *= *weight);
    let known = weighed.transpose() * columns + DMatrix::from_diagonal(beforehand);
    let of = weighed.transpose() * rest - strain.component_mul(beforehand);
    known.cholesky().map_or_else(|| DVector::zeros(beforehand.len()), |known| known.solve(&of))
}

/// How steeply a level is predicted to change about a sample.
fn slope(track: &Track, predicted: &[f64], k: usize) -> f64 {
    let instants = &track.grid.instants[track.first..];
    (predicted[k + 1] - predicted[k - 1]) / (instants[k + 1] - instants[k - 1]).max(1e-9)
}

/// Of a level: squares of what is left, of the slopes, and their products, in units of its floors, and how many samples they are.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    /// Which of the signals it is.
    place: usize,
    squares: f64,
    slopes: f64,
    products: f64,
    count: f64,
}

impl Sums {
    /// The squares of what is left of reports that are so old.
    fn at(&self, age: f64) -> f64 {
        (self.squares + 2.0 * age * self.products + age * age * self.slopes).max(0.0)
    }

    /// −2 ln of the likelihood of what is left of reports that are so old, but for a constant, its scale being its own.
    fn cost_at(&self, age: f64) -> f64 {
        self.count * (LEAST_SQUARE + self.at(age) / self.count).ln()
    }
}

/// What is left of each level of a device, and how far its nominal parameters are strained for that. Each level has a scale of its own: one axis
/// of a robot may be far off, and its others know how old reports are.
pub(super) struct Moments {
    /// The ports of the device's kind.
    ports: &'static [PortDescriptor],
    signals: Vec<Sums>,
    strained: Sums,
}

impl Moments {
    /// Those of its levels that are near what is recorded where reports are so old.
    fn near(&self, age: f64) -> Moments {
        let is_near = |of: &&Sums| of.at(age) < NEAR * of.count;
        Moments { signals: self.signals.iter().filter(is_near).copied().collect(), ..*self }
    }

    /// Whether both are of one law: a belt on a curve is the same as a straight one.
    fn has_law_of(&self, other: &Moments) -> bool {
        self.ports.iter().map(|port| port.name).eq(other.ports.iter().map(|port| port.name))
    }

    /// The mean square of what is left of reports that are so old.
    pub fn mean_square(&self, age: f64) -> f64 {
        let count: f64 = self.signals.iter().map(|of| of.count).sum();
        let sum: f64 = self.signals.iter().map(|of| of.at(age)).sum();
        if count > 0.0 { (sum + self.strained.at(age)) / count } else { 0.0 }
    }

    /// −2 ln of the likelihood of what is left of reports that are so old, but for a constant, with scales of their own.
    pub fn cost(&self, age: f64) -> f64 {
        self.signals.iter().map(|of| of.cost_at(age)).sum::<f64>() + self.strained.at(age)
    }
}

/// The age that all devices but one agree on where that one alone speaks for `found`, s; else `found`. A motor's encoder knows an instant a
/// hundred times better than what else there is, and would have its own delay taken for everybody's.
pub(super) fn age_of_most(each: &[Moments], found: f64) -> f64 {
    let mut most = (THRESHOLD, found);
    for left_out in 0..each.len() {
        let others: Vec<&Moments> =
            each.iter().enumerate().filter(|(at, _)| *at != left_out).map(|(_, moments)| moments).collect();
        let (_, age_s) = likeliest_age(&others);
        let nearer = |moments: &&Moments| moments.cost(found) - moments.cost(age_s);
        // What has a gap of its own may mean that by another age; belts that were told the same and are rounded alike are one witness.
        let agrees = |moments: &&Moments| nearer(moments) > SURELY_NEARER && moments.mean_square(age_s) < EXPLAINED;
        let mut agreeing: Vec<&Moments> = others.iter().copied().filter(agrees).collect();
        agreeing.sort_by(|a, b| nearer(a).total_cmp(&nearer(b)));
        agreeing.dedup_by(|a, b| nearer(a) == nearer(b));
        // What the law of a kind leaves is the same in all of it: those that are explained by what was found as well are one witness.
        let (explained, mut witnesses): (Vec<&Moments>, Vec<&Moments>) =
            agreeing.into_iter().partition(|moments| moments.mean_square(found) < EXPLAINED);
        for moments in explained {
            if !witnesses.iter().any(|other| other.has_law_of(moments)) {
                witnesses.push(moments);
            }
        }
        let sum = others.iter().map(nearer).sum::<f64>();
        if sum > most.0 && witnesses.len() >= LEAST_DEVICES {
            most = (sum, age_s);
        }
    }
    most.1
}

/// The age at which those levels cost least together that are near what is recorded at `found`, s; `found` where all are or none is. What is far
/// off at every age, as an axis that carries half as much again is, has its own reasons for the one that it likes.
pub(super) fn age_of_near(each: &[Moments], found: f64) -> f64 {
    let near: Vec<Moments> = each.iter().map(|moments| moments.near(found)).collect();
    let near: Vec<&Moments> = near.iter().filter(|moments| !moments.signals.is_empty()).collect();
    let count = |each: &[&Moments]| each.iter().map(|moments| moments.signals.len()).sum::<usize>();
    let is_all = count(&near) == count(&each.iter().collect::<Vec<_>>());
    if near.is_empty() || is_all { found } else { likeliest_age(&near).1 }
}

/// What devices cost together at the age at which they cost least, and that age, s.
pub(super) fn likeliest_age(each: &[&Moments]) -> (f64, f64) {
    let total = |age_s: f64| each.iter().map(|moments| moments.cost(age_s)).sum::<f64>();
    let least = |ages: &mut dyn Iterator<Item = f64>| {
        let costs = ages.filter(|age| (0.0..=MOST_AGE_S).contains(age)).map(|age| (total(age), age));
        costs.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::INFINITY, 0.0))
    };
    let (_, near) = least(&mut (0..=(MOST_AGE_S / STEP_S) as i32).map(|step| f64::from(step) * STEP_S));
    least(&mut (-FINER..=FINER).map(|step| near + f64::from(step) * STEP_S / f64::from(FINER)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::device::KINDS;

    /// What the columns are to each other, and all of it computed anew from samples that weigh the same, say the same.
    #[test]
    fn columns_that_weigh_the_same_are_solved_at_once() {
        let columns = DMatrix::from_fn(40, 3, |row, column| ((row * (column + 2)) as f64 * 0.37).sin());
        let slopes = DVector::from_fn(40, |row, _| 300.0 * (row as f64 * 0.21).cos());
        let rest = DVector::from_fn(40, |row, _| (row as f64 * 0.9).sin() + 0.4);
        let strain = DVector::from_vec(vec![0.2, -0.1, 0.5]);
        let alike = Alike::of(&columns, &slopes).expect("columns that are no multiples of each other");
        let (weights, known) = (DVector::from_element(40, 1.0), DVector::from_element(3, 1.0));
        let near = |one: &DVector<f64>, other: &DVector<f64>| (one - other).amax() < 1e-9 * (1.0 + other.amax());
        let asked = columns.tr_mul(&rest) - &strain;
        assert!(near(&alike.own.solve(&asked), &solved((&columns, &weights), &known, &rest, &strain)));
        assert!(near(&alike.by_age, &solved((&columns, &weights), &known, &slopes, &DVector::zeros(3))));
        let mut all = columns.clone().insert_column(3, 0.0);
        all.set_column(3, &-&slopes);
        let together = alike.together.solve(&asked.insert_row(3, -slopes.dot(&rest)));
        let known = DVector::from_vec(vec![1.0, 1.0, 1.0, MOST_AGE_S.powi(-2)]);
        assert!(near(&together, &solved((&all, &weights), &known, &rest, &strain.insert_row(3, 0.0))));
    }

    fn only(level: Sums) -> Moments {
        Moments { ports: &[], signals: vec![level], strained: Sums::default() }
    }

    fn ports_of(kind: &str) -> &'static [PortDescriptor] {
        KINDS.iter().find(|of| of.name == kind).expect("one of the library's").ports
    }

    #[test]
    fn an_age_shows_in_what_moves() {
        let moments =
            only(Sums { squares: 100.0 * 4.0, slopes: 100.0 * 4e6, products: -100.0 * 4e3, count: 100.0, place: 0 });
        // Off by twice the floor at 2000 floors a second: 1 ms.
        assert!(moments.mean_square(1e-3) < 1e-9 && moments.mean_square(0.0) == 4.0);
    }

    /// Of reports that are as old as `age_s`, of a device that knows an instant to a few of `exact_s`.
    fn speaking_for(age_s: f64, exact_s: f64) -> Moments {
        let (count, slopes) = (1000.0, 1.0 / (exact_s * exact_s));
        only(Sums { squares: count + age_s * age_s * slopes, slopes, products: -age_s * slopes, count, place: 0 })
    }

    /// A motor that is 60 µs late knows that a hundred times better than a robot and an axis know that they are not.
    #[test]
    fn one_device_is_not_heard_against_two() {
        let [motor, robot, axis] = [
            ("kinetwin.EncoderMotor", 6e-5, 1e-7),
            ("kinetwin.CartesianRobot", 0.0, 8e-6),
            ("kinetwin.ServoAxis", 0.0, 9e-6),
        ]
        .map(|(kind, age, exact)| Moments { ports: ports_of(kind), ..speaking_for(age, exact) });
        let (_, found) = likeliest_age(&[&motor, &robot, &axis]);
        assert!(found > 5e-5, "{found}");
        assert!(age_of_most(&[motor, robot, axis], found) < 1e-5);
        // Two belts that say the same to the last digit are one.
        let [motor, belt, twin] = [(6e-5, 1e-7), (0.0, 8e-6), (0.0, 8e-6)].map(|(age, exact)| speaking_for(age, exact));
        assert_eq!(age_of_most(&[motor, belt, twin], found), found);
        // Of two nobody knows which is late.
        let two = [(6e-5, 1e-7), (0.0, 8e-6)].map(|(age, exact)| speaking_for(age, exact));
        assert_eq!(age_of_most(&two, found), found);
    }

    /// A robot knows that reports are 0.9 ms old to a few µs. Belts, each of which is explained by that, all ease off as their law does not, by which they seem
    /// older: with none of another kind they are one witness; those that are off by it are as many as they are.
    #[test]
    fn what_the_law_of_a_kind_leaves_does_not_say_how_old_reports_are() {
        let belts = |exact: f64| {
            let of = |kind: &str, age: f64| Moments { ports: ports_of(kind), ..speaking_for(age, exact) };
            let [straight, curve] = ["kinetwin.StraightConveyor", "kinetwin.ConveyorCurve"];
            [of(straight, 1.05e-3), of(curve, 1.06e-3), of(straight, 1.07e-3)]
        };
        let age = |exact: f64| {
            let [a, b, c] = belts(exact);
            let robot = Moments { ports: ports_of("kinetwin.CartesianRobot"), ..speaking_for(9e-4, 1e-6) };
            age_of_most(&[robot, a, b, c], 9e-4)
        };
        assert_eq!(age(2e-5), 9e-4);
        assert!(age(5e-6) > 1e-3);
    }

    /// An axis knows that reports are 0.4 ms old; another, twenty floors off whatever their age, costs least where they are not.
    #[test]
    fn what_is_far_off_does_not_say_how_old_reports_are() {
        let axis = speaking_for(4e-4, 8e-5);
        let carrying = only(Sums { squares: 400.0 * 3000.0, slopes: 3e12, products: 3e8, count: 3000.0, place: 0 });
        let (_, found) = likeliest_age(&[&axis, &carrying]);
        assert!(found < 3e-4, "{found}");
        let age = age_of_near(&[axis, carrying], found);
        assert!((age - 4e-4).abs() < 1e-5, "{age}");
        // Of several that are all near, or all far off, what they say together stands.
        assert_eq!(age_of_near(&[speaking_for(4e-4, 8e-5), speaking_for(2e-4, 8e-5)], 3e-4), 3e-4);
    }
}
