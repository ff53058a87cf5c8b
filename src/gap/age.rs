//! How old all reports are, once more where several devices are a little off: as all but one of them have it.
//!
//! The age of reports is the machine's (`task.rs`), and the devices that report levels say it together. One whose own reports are late by some ten
//! microseconds has a say in it too: what is found then lies between what it says and what the others do, so that it seems to be less late than it is, and
//! another that knows the age well seems to be off. So where more than one is a little off, each of them is taken for one that is in order in turn:
//! with those that are it says how old reports are, all nominal parameters fitted beside it. The age by which the fewest are off then is taken, where
//! those in order bear no other as well.

use rayon::prelude::*;

use super::cause::Bare;
use super::locate::{THRESHOLD, are_levels_off, evidence};
use super::overrides::Overrides;
use super::prediction::Prediction;
use super::subject::Subject;
use super::task::MOST_AGE_S;

/// Ages that differ by no more are one, s.
const SAME_S: f64 = 1e-6;
/// Between which ages the deviance is taken for a parabola, s either way, and how many times as far its vertex may lie.
const APART_S: f64 = 3e-5;
const FURTHEST: f64 = 3.0;
/// By how much less those in order must cost, in deviance, than at another age by which as few are off: three standard deviations of it.
const PLAINLY: f64 = 9.0;
/// What is further off than this is so by something else.
const A_LITTLE_OFF: f64 = 2000.0;

/// A device whose reports are older by some, as its tolerances then let it stand.
struct Older {
    subject: Subject,
    nominal: Prediction,
    bare: Bare,
}

impl Older {
    fn new(subject: &Subject, bare: &Bare, by_s: f64) -> Option<Older> {
        let (subject, nominal) = older(subject, by_s)?;
        let bare = if subject.has_levels() { bare.again(&subject, &nominal) } else { bare.beside(&subject, &nominal) };
        Some(Older { subject, nominal, bare })
    }

    fn cost(&self) -> f64 {
        self.subject.score(&self.bare.prediction).total
    }

    fn is_off(&self) -> bool {
        evidence(&self.subject, &self.bare.prediction) > THRESHOLD
    }
}

/// A device whose reports are older by so much, s, and what it predicts nominally.
pub(super) fn older(subject: &Subject, by_s: f64) -> Option<(Subject, Prediction)> {
    let mut subject = subject.clone();
    subject.let_reports_be_older(by_s);
    let nominal = subject.predict(&[], &Overrides::none()).ok()?;
    Some((subject, nominal))
}

/// By how much longer all reports are old, s, which is set in all subjects; `None` where it is as it was found.
pub(super) fn find_beside_parameters(
    subjects: &mut [Subject],
    nominal: &mut [Prediction],
    bare: &mut [Bare],
) -> Option<f64> {
    let is_off = |at: usize| are_levels_off(&subjects[at], &bare[at].prediction);
    let is_a_little_off = |at: usize| is_off(at) && evidence(&subjects[at], &bare[at].prediction) < A_LITTLE_OFF;
    let reporting = || (0..subjects.len()).filter(|at| subjects[*at].has_levels());
    let in_order: Vec<usize> = reporting().filter(|at| !is_off(*at)).collect();
    let off: Vec<usize> = reporting().filter(|at| is_a_little_off(*at)).collect();
    if off.len() < 2 || in_order.is_empty() {
        return None;
    }
    let with = |at: usize, by_s: f64| Older::new(&subjects[at], &bare[at], by_s);
    // What each costs at three ages.
    let costs = |at: usize| -> Option<[f64; 3]> {
        let costs = [-APART_S, 0.0, APART_S].map(|by_s| with(at, by_s).map(|older| older.cost()));
        Some([costs[0]?, costs[1]?, costs[2]?])
    };
    let all = |places: &[usize]| -> Option<Vec<[f64; 3]>> {
        places.par_iter().with_max_len(1).map(|at| costs(*at)).collect()
    };
    let of_all: [f64; 3] = all(&in_order)?.into_iter().fold([0.0; 3], sum);
    let ages: Vec<f64> = all(&off)?.into_iter().filter_map(|costs| vertex(sum(of_all, costs))).collect();
    let of_machine: Vec<f64> = subjects.iter().flat_map(|subject| &subject.runs).map(|run| run.task.age_s).collect();
    let may_be = |by_s: &f64| of_machine.iter().all(|age_s| (0.0..=MOST_AGE_S).contains(&(age_s + by_s)));
    let mut tried: Vec<(usize, f64, f64, Vec<Older>)> = Vec::new();
    for by_s in ages.into_iter().filter(may_be) {
        let all = (0..subjects.len()).into_par_iter().with_max_len(1).map(|at| with(at, by_s));
        let all = all.collect::<Option<Vec<Older>>>()?;
        let cost = in_order.iter().map(|at| all[*at].cost()).sum();
        tried.push((all.iter().filter(|older| older.is_off()).count(), cost, by_s, all));
    }
    tried.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut tried = tried.into_iter();
    let (count, cost, by_s, all) = tried.next()?;
    let before = subjects.iter().zip(bare.iter());
    let before = before.filter(|(subject, bare)| evidence(subject, &bare.prediction) > THRESHOLD).count();
    let is_as_good = |other: (usize, f64, f64, Vec<Older>)| {
        other.0 == count && other.1 < cost + PLAINLY && (other.2 - by_s).abs() > SAME_S
    };
    if count >= before || tried.any(is_as_good) {
        return None;
    }
    for (at, older) in all.into_iter().enumerate() {
        (subjects[at], nominal[at], bare[at]) = (older.subject, older.nominal, older.bare);
    }
    Some(by_s)
}

fn sum(one: [f64; 3], other: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|at| one[at] + other[at])
}

/// Where a deviance is least that is so much at three ages, s from the middle one; `None` where that is not near.
fn vertex([sooner, here, later]: [f64; 3]) -> Option<f64> {
    let (slope, bend) = (0.5 * (later - sooner), later - 2.0 * here + sooner);
    let steps = -slope / bend;
    (bend > 0.0 && steps.abs() <= FURTHEST).then_some(steps * APART_S)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::recorded_tests::{LATE_ROBOT, study};

    /// The robot had its say in the age, 27 µs of it, and the motor was off by that.
    #[test]
    fn a_robot_that_is_late_makes_no_motor_late() {
        let study = study(LATE_ROBOT);
        assert!((study.tasks[0].age_s - 5.32e-4).abs() < 1.5e-5, "{:?}", study.tasks);
        let off = study.subjects.iter().zip(&study.bare);
        let off = off.filter(|(subject, bare)| evidence(subject, &bare.prediction) > THRESHOLD);
        assert_eq!(off.map(|(subject, _)| subject.name.as_str()).collect::<Vec<_>>(), ["Robot"]);
    }

    /// 20·(x − middle)² + 7, x in steps of 30 µs.
    #[test]
    fn the_vertex_of_a_parabola_is_an_age() {
        let at = |steps: f64, middle: f64| 20.0 * (steps - middle).powi(2) + 7.0;
        let three = |middle: f64| [-1.0, 0.0, 1.0].map(|steps| at(steps, middle));
        assert!(vertex(three(-0.9)).is_some_and(|by_s| (by_s + 2.7e-5).abs() < 1e-12));
        assert_eq!(vertex(three(4.0)), None, "too far");
        assert_eq!(vertex([1.0, 100.0, 1.0]), None, "no least");
    }
}
