//! What a link does to commands comes before the task that takes them up; and what it does to reports, after parts came.
//!
//! A recording has the stamps of commands, and the task of its machine is known in them: a command acts at the task's next instant. Where
//! its link holds it up it arrives later, and waits for the next instant after that. In the engine a link's effect begins where the
//! command acts; so the command is handed to it early enough to leave the link at the instant at which the task takes it up.
//!
//! Where parts come from is read off the barrier that sees them first. Where its link holds reports up, they came sooner.

use std::sync::Arc;

use super::subject::Run;
use super::task::Task;
use super::world::{Script, Surrounding};
use crate::plant::{EffectPlace, EffectSpec, ParameterValue};
use crate::prototype::kind::KindDescriptor;

/// How a link holds commands up.
#[derive(Clone, Copy, Debug)]
enum Held {
    /// `dead-time`: by so long, s.
    For(f64),
    /// `clock-drift`: by such a share of the time since the recording's start.
    More(f64),
}

impl Held {
    fn of(spec: &EffectSpec) -> Option<Held> {
        let number = |name: &str| match spec.parameters.get(name) {
            Some(ParameterValue::Number(value)) => Some(*value),
            _ => None,
        };
        match spec.kind.as_str() {
            "dead-time" => Some(Held::For(number("time")?)),
            "clock-drift" => Some(Held::More(number("rate")?)),
            _ => None,
        }
    }

    fn later(self, at: f64) -> f64 {
        match self {
            Held::For(time) => at + time,
            Held::More(rate) => at * (1.0 + rate),
        }
    }

    fn sooner(self, at: f64) -> f64 {
        match self {
            Held::For(time) => at - time,
            Held::More(rate) => at / (1.0 + rate),
        }
    }
}

/// What holds up the signals of a link: of all, or of one of this name.
fn held_on<'a>(place: EffectPlace, specs: impl Iterator<Item = &'a EffectSpec>) -> Vec<(Option<&'a str>, Held)> {
    specs
        .filter(|spec| spec.place == place)
        .filter_map(|spec| Some((spec.component.as_deref(), Held::of(spec)?)))
        .collect()
}

/// The run with its commands as the effects of `specs` on their links want them; `None` where nothing of that changes when one acts.
pub(super) fn before_the_task<'a>(
    run: &Run,
    kind: &KindDescriptor,
    specs: impl Iterator<Item = &'a EffectSpec>,
) -> Option<Run> {
    if run.task.every_s <= 0.0 {
        return None;
    }
    let links = held_on(EffectPlace::CommandLink, specs);
    if links.is_empty() {
        return None;
    }
    let mut other = run.clone();
    for (port, stamped) in &mut other.commands {
        let name = kind.ports[*port].name;
        let own = links.iter().filter(|(component, _)| component.is_none_or(|component| component == name));
        let held: Vec<Held> = own.map(|(_, held)| *held).collect();
        stamped.at = handed(stamped.at, run.task, &held);
    }
    other.commands.sort_by(|a, b| a.1.at.total_cmp(&b.1.at));
    other.task.every_s = 0.0;
    Some(other)
}

/// What surrounds a belt as it was, where the link of its `barriers` holds their reports up as `specs` say; `None` where it does not.
pub(super) fn before_the_report<'a>(
    script: &Script,
    barriers: [Option<&str>; 2],
    specs: impl Iterator<Item = &'a EffectSpec>,
) -> Option<Arc<Script>> {
    let links = held_on(EffectPlace::ReportLink, specs);
    let held = barriers.map(|barrier| {
        let own = |component: &Option<&str>| barrier.is_some() && (component.is_none() || *component == barrier);
        links.iter().filter(|(component, _)| own(component)).map(|(_, held)| *held).collect::<Vec<Held>>()
    });
    if held.iter().all(Vec::is_empty) {
        return None;
    }
    let came = |beam: usize, seen: f64| held[beam].iter().rev().fold(seen, |at, held| held.sooner(at)).max(0.0);
    let mut other = script.clone();
    for (place, cut) in other.cuts.iter_mut().enumerate() {
        // The barrier that saw a part first says when it came to the other, too.
        let first = script.cuts[..place].iter().find(|before| before.part == cut.part);
        cut.from = came(first.map_or(cut.beam, |first| first.beam), cut.from);
        cut.taken = cut.taken.map(|taken| came(cut.beam, taken));
    }
    other.cuts.sort_by(|a, b| a.from.total_cmp(&b.from));
    for told in &mut other.told {
        match told.what {
            Surrounding::BarrierA => told.at = came(0, told.at),
            Surrounding::BarrierB => told.at = came(1, told.at),
            _ => {}
        }
    }
    other.told.sort_by(|a, b| a.at.total_cmp(&b.at));
    Some(Arc::new(other))
}

/// When a command that is stamped `at` is handed to a link that holds it up so, s.
fn handed(at: f64, task: Task, held: &[Held]) -> f64 {
    let arrived = held.iter().fold(at, |at, held| held.later(at));
    held.iter().rev().fold(task.taken_up(arrived), |at, held| held.sooner(at))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::world::{Cut, Told};
    use crate::plant::EffectPlace::ReportLink;
    use crate::plant::ParameterValue::Number;

    /// A part that barrier A saw at 2 s, and B's cut of it; one that B saw first, at 3 s; and a beam that is played back.
    #[test]
    fn parts_came_before_their_report() {
        let cut = |part: usize, beam: usize, from: f64| Cut {
            part,
            beam,
            from,
            ahead: 0.0,
            front: 0.7,
            way: 1.0,
            length: 0.3,
            is_known: false,
            taken: None,
        };
        let told = vec![Told { at: 5.0, what: Surrounding::BarrierB, is_on: true }];
        let script = Script { cuts: vec![cut(0, 0, 2.0), cut(0, 1, 2.0), cut(1, 1, 3.0)], told, ..Script::default() };
        let barriers = [Some("lightBarrierA"), Some("lightBarrierB")];
        let dead_time = |component: Option<&str>| EffectSpec {
            place: ReportLink,
            kind: "dead-time".to_owned(),
            component: component.map(str::to_owned),
            parameters: [("time".to_owned(), Number(0.5))].into(),
        };
        let came = |spec: &EffectSpec| {
            let other = before_the_report(&script, barriers, std::iter::once(spec))?;
            Some((other.cuts.iter().map(|cut| cut.from).collect::<Vec<f64>>(), other.told[0].at))
        };
        assert_eq!(came(&dead_time(None)), Some((vec![1.5, 1.5, 2.5], 4.5)));
        assert_eq!(came(&dead_time(Some("lightBarrierA"))), Some((vec![1.5, 1.5, 3.0], 5.0)));
        assert_eq!(came(&dead_time(Some("encoder"))), None);
    }

    /// Of commands anywhere in the cycle of a task, each leaves its link when the task takes it up next after it has arrived; one that
    /// nothing holds up is as it was.
    #[test]
    fn a_command_leaves_its_link_when_the_task_takes_it_up() {
        let task = Task { every_s: 1e-3, phase_s: 3e-4, ..Task::default() };
        let held = [Held::For(2.34e-2), Held::More(1e-3)];
        for k in 0..40 {
            let at = 5.0 + 1.7e-4 * f64::from(k);
            let arrived = (at + 2.34e-2) * 1.001;
            let left = (handed(at, task, &held) + 2.34e-2) * 1.001;
            assert!((left - task.taken_up(arrived)).abs() < 1e-9, "{at}: {left}");
            assert!(left >= arrived - 1e-9 && left < arrived + 1e-3, "{at}: {left}");
            assert!((handed(at, task, &[]) - task.taken_up(at)).abs() < 1e-12);
        }
    }
}
