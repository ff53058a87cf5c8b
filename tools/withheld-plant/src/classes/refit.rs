//! One effect refitted to another's output: from a grid of strengths by Levenberg's and Marquardt's steps, then by ever smaller trials of
//! the exact distance, which has no slope at edges and counts.
//!
//! Every step finds the effect's numbers together with the machine's measures and its filter, each of which costs the square of how many
//! standard deviations it is off.

use nalgebra::{DMatrix, DVector};

use super::alone::{Alone, Heard, IsHopeless, Unknowns};
use super::apart::{Measure, at_least};
use super::candidate::Candidate;
use crate::quirk::Quirk;
use crate::recent::Recent;

/// An output that others are fitted to.
pub struct Goal<'a> {
    pub device: &'a Alone<'a>,
    pub measure: &'a Measure,
    pub quirks: &'a [Quirk],
    /// Until when it is listened to, s.
    end: f64,
    truth: Heard,
    /// What the effect does, as [`differences`](Measure::differences) from the truth.
    healthy: Vec<f64>,
    owners: Vec<usize>,
    /// By measure, then the filter and the numbers of others: how the output moves with a standard deviation of each.
    columns: Vec<Vec<f64>>,
    /// By the instants at which a run is looked at, what the unknown can take of what is apart by then.
    parts: Recent<f64, Taken>,
}

/// What the unknown can take of what is apart.
struct Taken {
    columns: Vec<Vec<f64>>,
    known: Option<DMatrix<f64>>,
}

impl Taken {
    fn new(columns: Vec<Vec<f64>>) -> Taken {
        let known = known(&columns);
        Taken { columns, known }
    }

    /// The square of what is left.
    fn leaves(&self, apart: &[f64]) -> f64 {
        left(apart, &self.columns, self.known.as_ref())
    }
}

/// A run is looked at no more often than so.
const PARTS: usize = 4;

/// Where a fit came to.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The effect's numbers in the search's terms, then what is unknown.
    pub at: Vec<f64>,
    /// D².
    pub squared: f64,
}

/// How many Levenberg steps, and trials of the exact distance.
const STEPS: usize = 8;
/// How far a number is moved to see what it does: so far that what is heard changes by that, and by this share of what is left; and how often
/// it is moved further for that.
const SEEN: f64 = 2.0;
const SEEN_OF_REST: f64 = 0.02;
const WIDENINGS: usize = 6;
/// A small part of a standard deviation: what is seen moves along a line with it.
pub const SMALL: f64 = 0.02;
/// How many standard deviations what is unknown may be off.
const MOST_OFF: f64 = 3.0;
/// What moves the recording by no more than this share of the truth moves it by no more when it is weaker, and comes nowhere near the truth.
const NOTHING: f64 = 0.05;
/// Starts from which the search goes on.
const BEST: usize = 2;

impl<'a> Goal<'a> {
    /// The output of `quirks` until `end`.
    pub fn new(device: &'a Alone<'a>, measure: &'a Measure, quirks: &'a [Quirk], end: f64) -> Goal<'a> {
        let truth = device.hear(quirks, &Unknowns::default(), end);
        let (measures, count) = (device.measures(), device.unknown());
        let column = |place: usize| -> Vec<f64> {
            // A number that may be twenty times as large moves the output along a line for a small part of that alone.
            let small = if place > measures { SMALL } else { 1.0 };
            let mut off = vec![0.0; count];
            off[place] = small;
            let there = device.hear(quirks, &Unknowns::of(&off, measures), end);
            measure.differences(&truth, &there).into_iter().map(|apart| apart / small).collect()
        };
        let columns = (0..count).map(column).collect();
        let healthy = measure.differences(&truth, &device.hear(&[], &Unknowns::default(), end));
        let owners = measure.owners(&truth);
        let parts = Recent::new(PARTS);
        Goal { device, measure, quirks, end, truth, healthy, owners, columns, parts }
    }

    /// D² of the effect itself on the signals of which `is_meant` is so, but for what the unknown takes.
    pub fn shows(&self, is_meant: &dyn Fn(usize) -> bool) -> f64 {
        let only = |all: &[f64]| -> Vec<f64> {
            all.iter().zip(&self.owners).map(|(value, owner)| if is_meant(*owner) { *value } else { 0.0 }).collect()
        };
        let columns: Vec<Vec<f64>> = self.columns.iter().map(|column| only(column)).collect();
        left(&only(&self.healthy), &columns, known(&columns).as_ref())
    }

    fn healthy_squared(&self) -> f64 {
        product(&self.healthy, &self.healthy)
    }

    /// What is heard of the candidate, unless what is heard until some instant says that it is `at_least` more than `most`.
    fn hear_below(
        &self,
        (candidate, at): (&Candidate, &[f64]),
        most: f64,
        at_least: &dyn Fn(&Heard, f64) -> f64,
    ) -> Option<Heard> {
        let (own, unknown) = at.split_at(candidate.free.len());
        let unknowns = Unknowns::of(unknown, self.device.measures());
        let is_more = |heard: &Heard, until: f64| at_least(heard, until) > most;
        let is_hopeless: Option<&IsHopeless<'_>> = if most.is_finite() { Some(&is_more) } else { None };
        self.device.hear_unless(&[self.device.built.fitted(candidate.at(own))], &unknowns, self.end, is_hopeless)
    }

    /// D² by the rule of the magnitudes, and what the unknown costs; of what is more than `most`, infinitely much.
    fn squared_below(&self, candidate: &Candidate, at: &[f64], most: f64) -> f64 {
        let unknown = unknown_squared(candidate, at);
        let least = |heard: &Heard, _: f64| at_least(self.measure.squared(&self.truth, heard)) + unknown;
        let heard = self.hear_below((candidate, at), most, &least);
        heard.map_or(f64::INFINITY, |heard| finite(self.measure.squared(&self.truth, &heard) + unknown))
    }

    /// What is apart, unless the sum of its squares is more than `most`.
    fn differences_below(&self, candidate: &Candidate, at: &[f64], most: f64) -> Option<DVector<f64>> {
        let unknown = unknown_squared(candidate, at);
        let least = |heard: &Heard, until: f64| {
            let apart = self.measure.differences_until(&self.truth, heard, until);
            at_least(product(&apart, &apart)) + unknown
        };
        let heard = self.hear_below((candidate, at), most, &least)?;
        let mut all = self.measure.differences(&self.truth, &heard);
        all.extend(&at[candidate.free.len()..]);
        Some(DVector::from_vec(all))
    }

    fn differences(&self, candidate: &Candidate, at: &[f64]) -> DVector<f64> {
        self.differences_below(candidate, at, f64::INFINITY).unwrap_or_default()
    }

    /// What is apart where nothing that is unknown is off, and the square of what the unknown leaves of it, unless that is more than `most`.
    fn left_below(&self, candidate: &Candidate, at: &[f64], taken: &Taken, most: f64) -> Option<(Vec<f64>, f64)> {
        let least = |heard: &Heard, until: f64| {
            let taken = self.parts.get(until, || {
                let places = self.measure.places_until(&self.truth, heard.values.len(), until);
                let part = |column: &Vec<f64>| places.iter().map(|place| column[*place]).collect();
                Taken::new(self.columns.iter().map(part).collect())
            });
            at_least(taken.leaves(&self.measure.differences_until(&self.truth, heard, until)))
        };
        let apart = self.measure.differences(&self.truth, &self.hear_below((candidate, at), most, &least)?);
        let squared = taken.leaves(&apart);
        Some((apart, squared))
    }

    /// The square of what the unknown leaves of what is apart.
    #[cfg(test)]
    pub fn left(&self, candidate: &Candidate, at: &[f64]) -> f64 {
        let taken = Taken::new(self.columns.clone());
        self.left_below(candidate, at, &taken, f64::INFINITY).map_or(f64::INFINITY, |(_, squared)| squared)
    }

    /// Whether no part of a run says that it is more than `most`.
    #[cfg(test)]
    pub fn is_left_below(&self, candidate: &Candidate, at: &[f64], most: f64) -> bool {
        // Of a run that is known nothing is left.
        self.device.motions.forget();
        self.left_below(candidate, at, &Taken::new(self.columns.clone()), most).is_some()
    }

    /// Where the search begins, from the grid: the best with what is unknown solved for, of those at most `most` off.
    pub fn starts(&self, candidate: &Candidate, most: f64) -> Vec<Fit> {
        let taken = Taken::new(self.columns.clone());
        let nothing = NOTHING * NOTHING * taken.leaves(&self.healthy);
        let mut starts: Vec<Fit> = Vec::new();
        for side in candidate.grid() {
            for mut at in side.points {
                // Of what is farther off than the best none is asked for.
                let most = starts.get(BEST - 1).map_or(most, |last| last.squared.min(most));
                let Some((apart, squared)) = self.left_below(candidate, &at, &taken, most) else { continue };
                let does: f64 = apart.iter().zip(&self.healthy).map(|(apart, healthy)| (apart - healthy).powi(2)).sum();
                at.extend(vec![0.0; self.columns.len()]);
                if squared < most {
                    let place = starts.partition_point(|start| start.squared <= squared);
                    starts.insert(place, Fit { at, squared });
                    starts.truncate(BEST);
                }
                if side.gets_weaker && does < nothing {
                    break;
                }
            }
        }
        starts
    }

    /// Levenberg's and Marquardt's steps (D. W. Marquardt, J. SIAM 11, 1963) from `start`.
    pub fn descend(&self, candidate: &Candidate, start: Fit) -> Fit {
        let mut at = start.at;
        let mut residual = self.differences(candidate, &at);
        let mut cost = residual.norm_squared();
        let mut damping = 1e-3;
        let first = cost;
        for step in 0..STEPS {
            // Enough of it, or no sign that it leads anywhere.
            if cost < 1.0 || step == 3 && cost > 0.5 * first.min(self.healthy_squared()) {
                break;
            }
            let jacobian = self.jacobian(candidate, &at, &residual);
            let normal = jacobian.transpose() * &jacobian;
            let slope = jacobian.transpose() * &residual;
            let before = cost;
            for _ in 0..5 {
                let mut damped = normal.clone();
                for k in 0..damped.nrows() {
                    damped[(k, k)] += damping * damped[(k, k)].max(1e-9);
                }
                let Some(step) = damped.cholesky().map(|known| known.solve(&slope)) else { break };
                let tried = self.moved(candidate, &at, &step);
                let there = self.differences_below(candidate, &tried, cost);
                if let Some(there) = there.filter(|there| there.norm_squared() < cost) {
                    (at, cost, residual) = (tried, there.norm_squared(), there);
                    damping = (damping * 0.1).max(1e-9);
                    break;
                }
                damping *= 10.0;
            }
            if cost > 0.99 * before {
                break;
            }
        }
        let squared = self.squared_below(candidate, &at, f64::INFINITY);
        Fit { at, squared }
    }

    fn moved(&self, candidate: &Candidate, at: &[f64], step: &DVector<f64>) -> Vec<f64> {
        let mut moved: Vec<f64> = at.iter().zip(step.iter()).map(|(at, step)| at - step).collect();
        for ((value, old), free) in moved.iter_mut().zip(at).zip(&candidate.free) {
            let most = if free.is_log { 1.5 } else { f64::INFINITY };
            *value = value.clamp(old - most, old + most).clamp(free.range.0, free.range.1);
        }
        moved[candidate.free.len()..].iter_mut().for_each(|off| *off = off.clamp(-MOST_OFF, MOST_OFF));
        moved
    }

    fn jacobian(&self, candidate: &Candidate, at: &[f64], residual: &DVector<f64>) -> DMatrix<f64> {
        let (own, unknown) = (candidate.free.len(), self.columns.len());
        let mut jacobian = DMatrix::zeros(residual.len(), own + unknown);
        for (k, free) in candidate.free.iter().enumerate() {
            // Far enough that edges and counts move, and by more than they are rounded to where much is left.
            let least = SEEN.max(SEEN_OF_REST * residual.norm());
            let mut small = free.small;
            for _ in 0..WIDENINGS {
                let mut there = at.to_vec();
                let side = if there[k] + small > free.range.1 { -small } else { small };
                there[k] += side;
                let change = self.differences(candidate, &there) - residual;
                let is_seen = change.norm() > least;
                jacobian.set_column(k, &(change / side));
                if is_seen {
                    break;
                }
                small *= 8.0;
            }
        }
        for (k, column) in self.columns.iter().enumerate() {
            for (row, value) in column.iter().enumerate() {
                jacobian[(row, own + k)] = *value;
            }
            jacobian[(residual.len() - unknown + k, own + k)] = 1.0;
        }
        jacobian
    }

    /// Trials of the exact distance, one coordinate at a time, each as far as it changes D by `far` and ever less, until D² is at most
    /// `enough` or `trials` are used up.
    pub fn polish(&self, candidate: &Candidate, from: Fit, enough: f64, trials: usize) -> Fit {
        let mut best = from;
        let residual = self.differences(candidate, &best.at);
        let jacobian = self.jacobian(candidate, &best.at, &residual);
        let mut steps: Vec<f64> = jacobian.column_iter().map(|column| 1.0 / column.norm().max(1e-9)).collect();
        let far = (best.squared.sqrt()).clamp(1.0, 30.0);
        steps.iter_mut().for_each(|step| *step *= far);
        let mut left = trials;
        while best.squared > enough && left > 0 {
            let before = best.squared;
            for k in 0..steps.len() {
                for side in [1.0, -1.0] {
                    let mut step = DVector::zeros(best.at.len());
                    step[k] = side * steps[k];
                    let at = self.moved(candidate, &best.at, &step);
                    left = left.saturating_sub(1);
                    let squared = self.squared_below(candidate, &at, best.squared);
                    if squared < best.squared {
                        best = Fit { at, squared };
                        steps[k] *= 2.0;
                        break;
                    }
                    if side < 0.0 {
                        steps[k] *= 0.4;
                    }
                }
            }
            if steps.iter().zip(jacobian.column_iter()).all(|(step, column)| step * column.norm() < 0.02)
                && best.squared == before
            {
                break;
            }
        }
        best
    }
}

/// What it costs that what is unknown is so far off.
fn unknown_squared(candidate: &Candidate, at: &[f64]) -> f64 {
    at[candidate.free.len()..].iter().map(|off| off * off).sum()
}

/// (1 + JᵀJ)⁻¹ of what is unknown.
fn known(columns: &[Vec<f64>]) -> Option<DMatrix<f64>> {
    let count = columns.len();
    let own = |a: usize, b: usize| if a == b { 1.0 } else { 0.0 };
    DMatrix::from_fn(count, count, |a, b| own(a, b) + product(&columns[a], &columns[b])).try_inverse()
}

/// The square of what is apart, less what the unknown takes of it.
fn left(apart: &[f64], columns: &[Vec<f64>], known: Option<&DMatrix<f64>>) -> f64 {
    let along = DVector::from_iterator(columns.len(), columns.iter().map(|column| product(column, apart)));
    finite(product(apart, apart) - known.map_or(0.0, |known| along.dot(&(known * &along)))).max(0.0)
}

/// A spring that is stiffer than a step can follow flies away: no number is as far off as can be.
fn finite(squared: f64) -> f64 {
    if squared.is_finite() { squared } else { f64::INFINITY }
}

fn product(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}
