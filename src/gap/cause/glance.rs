//! What a candidate's starts promise, at a glance, and where a few steps downhill from them lead: the looks that a rung takes.

use super::bench::{Bench, Trial};
use super::blur;
use super::candidate::Candidate;
use super::ladder::anew;
use super::starts::UNLIMITED;
use super::tangent::{Beside, Tangent, product};
use crate::gap::Subject;
use crate::gap::fit::{Effort, least_squares, search, sum_of_squares};

/// What a candidate must explain to be looked at closely, of all that there is to explain.
const PROMISING: f64 = 0.02;
/// What a glance must promise of that: several parameters together may do more than each start says.
const AT_A_GLANCE: [f64; 2] = [0.5, 0.2];
/// Squared, how far a start must move the residuals, in what is worth having, and how far it may, in all there is to explain.
const LEAST_MOVED: f64 = 0.05;
const MOST_MOVED: f64 = 4.0;

/// What there is to explain.
#[derive(Clone, Copy, Debug)]
pub struct Sought {
    /// In deviance.
    pub excess: f64,
    /// Which share of it a candidate must explain to be looked at closely.
    pub share: f64,
}

impl Sought {
    /// Of which one effect may be the cause of a part.
    pub fn in_parts(excess: f64) -> Sought {
        Sought { excess, share: PROMISING }
    }

    /// Of which one effect must be the cause of the `share`.
    pub fn of_one(excess: f64, share: f64) -> Sought {
        Sought { excess, share }
    }

    /// Whether what explains less is no answer at all.
    pub fn is_of_one(&self) -> bool {
        self.share > PROMISING
    }

    /// What a candidate must explain of it.
    pub fn least(&self) -> f64 {
        self.share * self.excess
    }
}

/// What all candidates of a rung have in common.
pub struct Looks<'a> {
    pub bench: &'a Bench<'a>,
    pub below: &'a Trial,
    pub tangent: Tangent,
    pub blurred: &'a [Subject],
    /// The device with its edges least well known, and its residuals without the candidate: where the gap lies in edges, those that are
    /// known to the millisecond move with nothing.
    pub afar: Option<(&'a Subject, Vec<f64>)>,
    pub sought: Sought,
    /// Whether the gap lies in levels, which move with a parameter from its first trace on.
    pub is_smooth: bool,
}

/// A candidate, and what is known of it so far.
pub struct Glance {
    pub candidate: Candidate,
    pub set: Vec<Candidate>,
    beside: Beside,
    /// Where it stands.
    pub at: Vec<f64>,
    /// Other places to begin at, the best first.
    others: Vec<Vec<f64>>,
    /// Where a search among edges that are seen from afar begins, the best first; empty where it need not.
    afar: Vec<Vec<f64>>,
    /// By how much it costs less there than nothing.
    pub gain: f64,
    /// By how much it might.
    pub promise: f64,
    pub is_promising: bool,
}

impl Glance {
    /// The same that is looked at no further.
    pub fn left(self) -> Glance {
        Glance { is_promising: false, ..self }
    }

    /// The same, standing where `looks` cost least.
    fn at_the_best_of(mut self, mut looks: Vec<Look>) -> Option<Glance> {
        looks.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        let mut looks = looks.into_iter();
        let first = looks.next()?;
        (self.at, self.gain) = (first.at, sum_of_squares(&self.beside.here) - first.cost);
        self.others = looks.take(2).map(|look| look.at).collect();
        Some(self)
    }
}

/// The device as it is looked at: its residuals without the candidate, and how much there is to explain.
struct Sight<'a> {
    bench: &'a Bench<'a>,
    here: &'a [f64],
    sought: Sought,
}

/// What a candidate's starts promise together.
struct Promise {
    most: f64,
    is_kept: bool,
}

impl Sight<'_> {
    /// What looks promise, and whether that is worth a fit.
    fn promise(&self, glance: &Glance, looks: &[Look]) -> Promise {
        let worth = self.sought.least() * AT_A_GLANCE[usize::from(glance.candidate.free.len() > 1)];
        let most = looks.iter().map(|look| look.promise).fold(0.0, f64::max);
        Promise { most, is_kept: most > worth }
    }
}

/// A start that was looked at.
struct Look {
    at: Vec<f64>,
    cost: f64,
    /// How far it moves the residuals, squared.
    moved: f64,
    /// What it could take away along the way that it moves them, and by which multiple of that.
    promise: f64,
    multiple: f64,
}

impl Looks<'_> {
    /// A candidate of which nothing is known yet.
    fn begun(&self, candidate: Candidate) -> Glance {
        let set: Vec<Candidate> = self.below.set.iter().chain([&candidate]).cloned().collect();
        let beside = self.tangent.beside(self.bench, &set);
        Glance {
            candidate,
            set,
            beside,
            at: Vec::new(),
            others: Vec::new(),
            afar: Vec::new(),
            gain: 0.0,
            promise: 0.0,
            is_promising: false,
        }
    }

    /// What a candidate's starts promise.
    pub fn glance(&self, candidate: Candidate) -> Option<Glance> {
        let mut glance = self.begun(candidate);
        if glance.candidate.free.is_empty() {
            glance.gain = sum_of_squares(&glance.beside.here) - sum_of_squares(&self.residuals(&glance, &[])?);
            return Some(glance);
        }
        let near = Sight { bench: self.bench, here: &glance.beside.here, sought: self.sought };
        let mut promise = None;
        let looks = match (&self.afar, self.is_smooth) {
            (_, true) => self.look_about(&near, &glance),
            (None, false) => self.look_at_all(&near, &glance),
            (Some((subject, residuals)), false) => {
                let strain =
                    self.bench.strain(&glance.set, &self.all(&glance, &vec![0.0; glance.candidate.free.len()]));
                let here = glance.beside.left_of([residuals.as_slice(), &strain].concat());
                let sought = Sought { excess: sum_of_squares(&here), ..self.sought };
                let sight = Sight { bench: &self.bench.with(subject), sought, here: &here };
                let mut looks = self.look_about(&sight, &glance);
                looks.sort_by(|a, b| a.cost.total_cmp(&b.cost));
                promise = Some(sight.promise(&glance, &looks));
                if promise.as_ref().is_some_and(|promise| promise.is_kept) {
                    glance.afar = looks.iter().map(|look| look.at.clone()).collect();
                }
                let nearest = looks.first().map(|look| &look.at).into_iter().chain(&glance.candidate.shown);
                nearest.filter_map(|at| self.look(&near, &glance, at)).collect()
            }
        };
        let promise = promise.unwrap_or_else(|| match self.is_smooth {
            true => near.promise(&glance, &looks),
            // What costs the same wherever it is begun has nothing to act on in these recordings.
            false => Promise { most: 0.0, is_kept: looks.iter().any(|look| look.moved > 1e-9) },
        });
        Glance { is_promising: promise.is_kept, promise: promise.most, ..glance }.at_the_best_of(looks)
    }

    /// All parameters of a candidate at `at`, the nuisances where they are held.
    pub fn all(&self, glance: &Glance, at: &[f64]) -> Vec<f64> {
        [&self.below.at[..self.below.parameters()], at, &glance.beside.carried].concat()
    }

    fn residuals(&self, glance: &Glance, at: &[f64]) -> Option<Vec<f64>> {
        Some(glance.beside.left_of(self.bench.residuals(&glance.set, &self.all(glance, at))?))
    }

    fn look(&self, sight: &Sight<'_>, glance: &Glance, at: &[f64]) -> Option<Look> {
        let there = glance.beside.left_of(sight.bench.residuals(&glance.set, &self.all(glance, at))?);
        let here = sight.here;
        let cost = sum_of_squares(&there);
        if there.len() != here.len() {
            return Some(Look { at: at.to_vec(), cost, moved: f64::INFINITY, promise: 0.0, multiple: 1.0 });
        }
        let moved: Vec<f64> = there.iter().zip(here).map(|(there, here)| there - here).collect();
        let squared = sum_of_squares(&moved);
        let along = product(&moved, here);
        let multiple = if squared > 0.0 { -along / squared } else { 0.0 };
        Some(Look { at: at.to_vec(), cost, moved: squared, promise: multiple * multiple * squared, multiple })
    }

    /// Of a single parameter the starts that move the residuals by more than nothing and by less than the whole gap, either way from
    /// where it does nothing; of several, all.
    fn look_about(&self, sight: &Sight<'_>, glance: &Glance) -> Vec<Look> {
        let candidate = &glance.candidate;
        let [free] = candidate.free.as_slice() else {
            let mut looks: Vec<Look> =
                candidate.starts.iter().filter_map(|start| self.look(sight, glance, start)).collect();
            looks.extend(self.look_ahead_of_several(sight, glance, &looks));
            return looks;
        };
        let parameter = candidate.effect.parameters.iter().find(|of| of.name == free.name);
        let nominal = match (candidate.is_parameter_error(), parameter) {
            (false, Some(parameter)) => parameter.nominal,
            _ => return candidate.starts.iter().filter_map(|start| self.look(sight, glance, start)).collect(),
        };
        let mut looks = Vec::new();
        for side in [1.0, -1.0] {
            let mut starts: Vec<f64> =
                candidate.starts.iter().map(|start| start[0]).filter(|at| side * (at - nominal) > 0.0).collect();
            starts.sort_by(|a, b| (a - nominal).abs().total_cmp(&(b - nominal).abs()));
            self.look_outward(sight, glance, &starts, &mut looks);
        }
        looks.extend(self.look_ahead(sight, glance, nominal, &looks));
        looks
    }

    /// Looks where the most promising look says that the least cost is, if the effect is a multiple of its parameter; from there again as
    /// long as that costs more than no effect: of a start that is a hundred times too far such a step is off by more than what there is.
    fn look_ahead(&self, sight: &Sight<'_>, glance: &Glance, nominal: f64, looks: &[Look]) -> Vec<Look> {
        const STEPS: usize = 3;
        let range = glance.candidate.free[0].range;
        let without = sum_of_squares(sight.here);
        let mut ahead: Vec<Look> = Vec::new();
        // What is nominally without limit is no multiple of anything.
        let most = if nominal.abs() < UNLIMITED { STEPS } else { 0 };
        while ahead.len() < most {
            let of_starts =
                || looks.iter().filter(|look| look.moved > 0.0).max_by(|a, b| a.promise.total_cmp(&b.promise));
            let Some(from) = ahead.last().or_else(of_starts) else { break };
            let at = nominal + from.multiple * (from.at[0] - nominal);
            if !from.multiple.is_finite() || !(range.least..=range.greatest).contains(&at) {
                break;
            }
            let Some(look) = self.look(sight, glance, &[at]) else { break };
            let is_there = look.cost < without;
            ahead.push(look);
            if is_there {
                break;
            }
        }
        ahead
    }

    /// The same of several parameters, the first of which says how much there is of an effect, such as the force of a friction that falls
    /// with speed: for the others as they are where a look promises the most.
    fn look_ahead_of_several(&self, sight: &Sight<'_>, glance: &Glance, looks: &[Look]) -> Vec<Look> {
        const MOST: usize = 3;
        let candidate = &glance.candidate;
        let Some(amount) = candidate.free.first() else { return Vec::new() };
        let parameter = candidate.effect.parameters.iter().find(|of| of.name == amount.name);
        if parameter.is_none_or(|parameter| parameter.nominal != 0.0) {
            return Vec::new();
        }
        let mut best: Vec<&Look> = looks.iter().filter(|look| look.moved > 0.0 && look.multiple > 0.0).collect();
        best.sort_by(|a, b| b.promise.total_cmp(&a.promise));
        let ahead = best.into_iter().take(MOST).filter_map(|look| {
            let mut at = look.at.clone();
            at[0] = (look.multiple * at[0]).clamp(amount.range.least, amount.range.greatest);
            self.look(sight, glance, &at)
        });
        ahead.collect()
    }

    /// Looks at starts that move the residuals the more the later they come.
    fn look_outward(&self, sight: &Sight<'_>, glance: &Glance, starts: &[f64], looks: &mut Vec<Look>) {
        let (least, most) = (LEAST_MOVED * sight.sought.least(), MOST_MOVED * sight.sought.excess);
        let (mut low, mut high) = (0, starts.len());
        let mut seen: Vec<Option<Look>> = starts.iter().map(|_| None).collect();
        while low < high {
            let middle = (low + high) / 2;
            let Some(look) = self.look(sight, glance, &[starts[middle]]) else { return };
            if look.moved < least {
                low = middle + 1
            } else {
                high = middle
            }
            seen[middle] = Some(look);
        }
        for (place, start) in starts.iter().enumerate().skip(low) {
            if seen[place].is_none() {
                seen[place] = self.look(sight, glance, &[*start]);
            }
            if seen[place].as_ref().is_none_or(|look| look.moved > most) {
                break;
            }
        }
        looks.extend(seen.into_iter().flatten());
    }

    /// All starts. Those of a single parameter go from small effects to large ones: once some in a row cost far more than no effect at
    /// all, the larger ones are not tried.
    fn look_at_all(&self, sight: &Sight<'_>, glance: &Glance) -> Vec<Look> {
        const HOPELESS: f64 = 2.0;
        const IN_A_ROW: usize = 3;
        let without = sum_of_squares(sight.here);
        let mut looks: Vec<Look> = Vec::with_capacity(glance.candidate.starts.len());
        let mut hopeless = 0;
        for look in glance.candidate.starts.iter().filter_map(|start| self.look(sight, glance, start)) {
            hopeless = if look.cost > HOPELESS * without { hopeless + 1 } else { 0 };
            looks.push(look);
            if glance.candidate.free.len() == 1 && hopeless == IN_A_ROW {
                break;
            }
        }
        looks
    }

    /// A candidate where edges that are seen from afar, and then nearer and nearer, lead it.
    fn sharpened(&self, glance: Glance) -> Option<Glance> {
        if glance.afar.is_empty() {
            return Some(glance);
        }
        let all = |at: &[f64]| self.all(&glance, at);
        let of = (glance.set.as_slice(), &glance.candidate);
        let starts = blur::sharpened(self.bench, self.blurred, of, &glance.afar, &all);
        let near = Sight { bench: self.bench, here: &glance.beside.here, sought: self.sought };
        let starts = starts.unwrap_or_else(|| vec![glance.at.clone()]);
        let starts = starts.iter().chain(&glance.candidate.shown);
        let looks = starts.filter_map(|start| self.look(&near, &glance, start)).collect();
        glance.at_the_best_of(looks)
    }

    /// A candidate of which no slope leads from one number to the next where it costs least about its best starts: each time that a joint lets go is an event of
    /// its own, and a force that is a twentieth too great or too small costs more than none.
    fn about(&self, glance: Glance) -> Option<Glance> {
        const STEP: f64 = 1.03;
        const STEPS: i32 = 6;
        if glance.candidate.effect.id != "breakaway-friction" {
            return Some(glance);
        }
        let near = Sight { bench: self.bench, here: &glance.beside.here, sought: self.sought };
        let starts = [&glance.at].into_iter().chain(&glance.others).map(|start| start[0]);
        let each = starts.flat_map(|start| (-STEPS..=STEPS).map(move |step| start * STEP.powi(step)));
        let looks = each.filter_map(|at| self.look(&near, &glance, &[at])).collect();
        glance.at_the_best_of(looks)
    }

    /// A few steps downhill, and whether that is worth a closer look.
    pub fn fit(&self, glance: Glance) -> Option<Glance> {
        let glance = self.downhill(self.sharpened(self.about(glance)?)?)?;
        Some(Glance { is_promising: glance.gain > self.sought.least(), ..glance })
    }

    /// Where it costs least of what is found from its best starts.
    pub fn closely(&self, glance: Glance) -> Option<Glance> {
        let ranges: Vec<_> = glance.candidate.ranges().collect();
        let residuals = |at: &[f64]| self.residuals(&glance, at);
        let starts: Vec<Vec<f64>> = [&glance.at].into_iter().chain(&glance.others).cloned().collect();
        let effort = Effort { starts: 2, budget: 20 + 12 * ranges.len() as u32 };
        let at = search(&residuals, &starts, &ranges, effort)?.at;
        Some(Glance { at, ..glance })
    }

    /// What was found on a part of the recordings, as these are looked at.
    pub fn again(&self, glance: Glance) -> Glance {
        Glance { beside: self.tangent.beside(self.bench, &glance.set), ..glance }
    }

    /// The same with what it promises there, standing where it does.
    pub fn promised(&self, glance: Glance) -> Option<Glance> {
        let glance = self.again(glance);
        let near = Sight { bench: self.bench, here: &glance.beside.here, sought: self.sought };
        let promise = self.look(&near, &glance, &glance.at)?.promise;
        Some(Glance { promise, ..glance })
    }

    /// The candidate with the nuisances beside it; `is_near`: a part of the recordings has led it to where a few steps are enough.
    pub fn fit_closely(&self, glance: Glance, is_near: bool) -> Option<Trial> {
        if self.bench.is_rugged() {
            let start = self.all(&glance, &glance.at);
            return self.bench.fit(&glance.set, &[start], anew(self.bench.ranges(&glance.set).len()));
        }
        let glance = if is_near { self.downhill(glance)? } else { self.closely(glance)? };
        self.trial_at(&glance, &glance.at)
    }

    /// A few steps downhill from where it stands.
    fn downhill(&self, glance: Glance) -> Option<Glance> {
        let ranges: Vec<_> = glance.candidate.ranges().collect();
        let residuals = |at: &[f64]| self.residuals(&glance, at);
        let fitted = least_squares(&residuals, &glance.at, &ranges, 4 + 4 * ranges.len() as u32)?;
        let gain = sum_of_squares(&glance.beside.here) - fitted.cost;
        Some(Glance { at: fitted.at, gain, ..glance })
    }

    /// With the nuisances at their nominal values: of an effect without a parameter, which leaves next to nothing or nearly everything, so
    /// that nuisances fitted to the machine without it say nothing.
    fn afresh(&self, glance: &Glance) -> Option<Vec<f64>> {
        let is_first = glance.candidate.free.is_empty() && self.below.set.is_empty();
        is_first.then(|| self.bench.nominal(&glance.set))
    }

    fn cheapest(&self, places: impl Iterator<Item = Vec<f64>>, glance: &Glance) -> Option<Trial> {
        let trials = places.filter_map(|at| self.bench.trial(&glance.set, at));
        trials.min_by(|a, b| a.cost.total_cmp(&b.cost))
    }

    /// With the nuisances as they follow, or where they are held, whichever costs less.
    pub fn trial_at(&self, glance: &Glance, at: &[f64]) -> Option<Trial> {
        let held = self.all(glance, at);
        let there = self.cheapest([held.clone()].into_iter().chain(self.afresh(glance)), glance)?;
        let followed = glance.beside.follow(&self.bench.residuals(&glance.set, &held)?);
        if followed == glance.beside.carried {
            return Some(there);
        }
        let own = held.len() - followed.len();
        let other = self.bench.trial(&glance.set, [&held[..own], &followed].concat());
        Some(match other {
            Some(other) if other.cost < there.cost => other,
            _ => there,
        })
    }
}
