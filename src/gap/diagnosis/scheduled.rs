//! What a bay's schedule tells apart that its belt's reports do not.
//!
//! Where parts were is read off when the first beam saw them, so that a belt whose reports are late does as one whose commands are, and one whose first
//! beam stands elsewhere as one whose second does. When a bay put its parts is known where the recording follows its schedule, and by that the two are
//! told apart.

use super::Finding;
use crate::gap::Subject;
use crate::gap::cause::{Answer, Trial};
use crate::gap::schedule::{Told, told};
use crate::gap::statistics::SAME_CLASS;

/// Of effects that a belt's reports cannot tell apart those that its bay's schedule cannot either; the one that it fits best is named where the one that
/// was named does not. Nothing changes where the recording follows no schedule, whichever of them it is.
pub(super) fn tell_by_schedule(belt: &Subject, finding: &mut Finding) {
    let ([_], [answer]) = (finding.ladder.best.set.as_slice(), finding.answers.as_mut_slice()) else { return };
    if belt.bay.is_none() || !answer.alternatives.iter().any(|other| other.is_same) {
        return;
    }
    let of = |trial: &Trial| told(belt, (&trial.specs(), &trial.overrides)).ok().flatten();
    let mut named = of(&finding.ladder.best);
    let mut others: Vec<Option<Told>> =
        answer.alternatives.iter().map(|other| if other.is_same { of(&other.trial) } else { None }).collect();
    let followed = others.iter().chain([&named]).flatten().filter(|told| told.is_followed);
    let Some(least) = followed.map(|told| told.cost).min_by(f64::total_cmp) else { return };
    let is_out = |told: &Option<Told>| told.is_some_and(|told| told.cost > least + SAME_CLASS);
    if is_out(&named)
        && let Some(at) = others.iter().position(|told| told.is_some_and(|told| told.cost == least))
    {
        std::mem::swap(&mut finding.ladder.best, &mut answer.alternatives[at].trial);
        std::mem::swap(&mut named, &mut others[at]);
        finding.ladder.ends = None;
    }
    keep(answer, others.iter().map(is_out));
}

/// Leaves out what is out; what is left shares its weight.
fn keep(answer: &mut Answer, mut are_out: impl Iterator<Item = bool>) {
    let members = |answer: &Answer| 1 + answer.alternatives.iter().filter(|other| other.is_same).count();
    let before = members(answer);
    answer.alternatives.retain(|_| are_out.next() != Some(true));
    let share = before as f64 / members(answer) as f64;
    answer.weight *= share;
    answer.alternatives.iter_mut().filter(|other| other.is_same).for_each(|other| other.weight *= share);
}
