//! What is to be told apart: a report's causes and their rivals, as candidates with their parameters.

use super::PlanError;
use crate::effect::{self, EffectDescriptor};
use crate::gap::TaskId;
use crate::gap::cause::{Candidate, Free};
use crate::gap::fit::Range;
use crate::gap::report::{Cause, FittedParameter, Member, Report, Rival};
use crate::plant::Plant;

/// A set of effects of one device, at its parameters.
#[derive(Clone, Debug)]
pub(super) struct Set {
    pub set: Vec<Candidate>,
    pub at: Vec<f64>,
}

/// A cause, with the other causes of its device, and the same with a rival in its place.
#[derive(Clone, Debug)]
pub(super) struct Pair {
    pub cause: Set,
    pub rival: Set,
    /// What differs between them: the cause, then the rival.
    pub members: [Member; 2],
    subject: String,
}

impl Pair {
    /// The instance's name.
    pub fn device(&self) -> &str {
        &self.members[0].device
    }

    /// The name of the device's task, as a study calls it.
    pub fn subject(&self) -> &str {
        &self.subject
    }

    /// The component that the cause acts on, if it names one.
    pub fn axis(&self) -> Option<&str> {
        self.members[0].component.as_deref()
    }
}

/// The pairs of a report: each rival with the cause in whose place it would stand.
pub(super) fn pairs(plant: &Plant, report: &Report) -> Result<Vec<Pair>, PlanError> {
    let mut pairs = Vec::new();
    for rival in &report.rivals {
        let own: Vec<&Cause> = report.cause.iter().filter(|cause| cause.device == rival.device).collect();
        let Some(place) = replaced(&own, rival) else { continue };
        let ids = TaskId::all(plant);
        let id = ids.into_iter().find(|id| id.instance(plant).name == rival.device);
        let id = id.ok_or_else(|| PlanError::UnknownDevice { found: rival.device.clone() })?;
        let cause = own.iter().map(|cause| of_cause(cause)).collect::<Result<Vec<_>, _>>()?;
        let mut other = cause.clone();
        other[place] = candidate(&member(rival), &rival.parameters, &rival.texts)?;
        pairs.push(Pair {
            cause: set(cause),
            rival: set(other),
            members: [own[place].member(), member(rival)],
            subject: id.name(plant),
        });
    }
    if pairs.is_empty() { Err(PlanError::NoRival) } else { Ok(pairs) }
}

/// The cause in whose place a rival would stand: the one whose class it is in, else one of the same component, else the last.
fn replaced(causes: &[&Cause], rival: &Rival) -> Option<usize> {
    let member = member(rival);
    let in_class = causes.iter().position(|cause| cause.class.contains(&member));
    let beside = || causes.iter().position(|cause| cause.component == rival.component);
    in_class.or_else(beside).or(causes.len().checked_sub(1))
}

fn member(rival: &Rival) -> Member {
    Member {
        device: rival.device.clone(),
        component: rival.component.clone(),
        effect: rival.effect.clone(),
        place: rival.place,
    }
}

fn set(candidates: Vec<(Candidate, Vec<f64>)>) -> Set {
    let (set, at): (Vec<Candidate>, Vec<Vec<f64>>) = candidates.into_iter().unzip();
    Set { set, at: at.concat() }
}

fn of_cause(cause: &Cause) -> Result<(Candidate, Vec<f64>), PlanError> {
    candidate(&cause.member(), &cause.parameters, &cause.texts)
}

/// An effect of a report as a candidate, all of whose numbers may be fitted anew.
fn candidate(
    member: &Member,
    parameters: &[FittedParameter],
    texts: &std::collections::BTreeMap<String, String>,
) -> Result<(Candidate, Vec<f64>), PlanError> {
    let fail = |reason: String| PlanError::Effect { found: format!("{} of {}", member.effect, member.device), reason };
    let effect = effect::named(&member.effect).ok_or_else(|| fail("there is no such effect".to_owned()))?;
    let mut free = Vec::new();
    let mut fixed = Vec::new();
    let mut at = Vec::new();
    for parameter in parameters {
        let (name, range, is_free) =
            described(effect, parameter).ok_or_else(|| fail(format!("it has no parameter {:?}", parameter.name)))?;
        if is_free {
            free.push(Free { name, range, is_time: false });
            at.push(parameter.value.clamp(range.least, range.greatest));
        } else {
            fixed.push((name, parameter.value));
        }
    }
    let (component, place) = (member.component.clone(), member.place);
    Ok((
        Candidate {
            effect,
            place,
            component,
            texts: texts.clone(),
            fixed,
            free,
            starts: vec![at.clone()],
            shown: Vec::new(),
        },
        at,
    ))
}

/// The parameter of an effect, its range, and whether it takes any value in it.
fn described(effect: &'static EffectDescriptor, found: &FittedParameter) -> Option<(&'static str, Range, bool)> {
    let parameter = effect.parameters.iter().find(|parameter| parameter.name == found.name)?;
    let (least, greatest) = parameter.range;
    let scale = (0.1 * found.value.abs()).max(1e-3 * parameter.typical.abs()).max(1e-9);
    Some((parameter.name, Range { least, greatest, scale }, parameter.options.is_empty()))
}
