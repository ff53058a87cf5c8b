//! What a link does to commands comes before the task that takes them up; and what it does to reports, after parts came.
//!
//! A recording has the stamps of commands, and the task of its machine is known in them: a command acts at the task's next instant. Where
//! its link holds it up it arrives later, and waits for the next instant after that. In the engine a link's effect begins where the
//! command acts; so the command is handed to it early enough to leave the link at the instant at which the task takes it up.
//!
//! What a link filters changes all the time, and the task takes up what has come through at each of its instants: a staircase, half a cycle
//! behind. Such a filter is computed here, from when the commands were given, and the device is told its steps in place of the commands.
//!
//! Where parts come from is read off the barrier that sees them first. Where its link holds reports up, or it sees late itself, they came sooner.

use std::sync::Arc;

use super::recording::Stamped;
use super::subject::Run;
use super::task::Task;
use super::way::Way;
use super::world::{Script, Surrounding};
use crate::effect;
use crate::plant::{EffectPlace, EffectSpec, ParameterValue};
use crate::prototype::kind::{KindDescriptor, PortDescriptor, PortType};

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
        match spec.kind.as_str() {
            "dead-time" => Some(Held::For(number(spec, "time")?)),
            "clock-drift" => Some(Held::More(number(spec, "rate")?)),
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

/// A number of an effect.
fn number(spec: &EffectSpec, name: &str) -> Option<f64> {
    match spec.parameters.get(name) {
        Some(ParameterValue::Number(value)) => Some(*value),
        _ => None,
    }
}

/// What holds up the signals of a link: of all, or of one of this name.
fn held_on<'a>(place: EffectPlace, specs: impl Iterator<Item = &'a EffectSpec>) -> Vec<(Option<&'a str>, Held)> {
    specs
        .filter(|spec| spec.place == place)
        .filter_map(|spec| Some((spec.component.as_deref(), Held::of(spec)?)))
        .collect()
}

/// A run with its commands as they come to its task.
pub(super) struct Handed {
    pub run: Run,
    /// Whether what its links filter is in the commands, so that the device is to be built without those filters.
    pub is_filtered: bool,
}

/// Whether an effect is a filter of commands.
pub(super) fn filters_commands(spec: &EffectSpec) -> bool {
    spec.place == EffectPlace::CommandLink && spec.kind == "input-filter"
}

/// The run with its commands as the effects of `specs` on their links want them; `None` where nothing of that changes when one acts.
pub(super) fn before_the_task<'a>(
    run: &Run,
    kind: &KindDescriptor,
    specs: impl Iterator<Item = &'a EffectSpec> + Clone,
) -> Option<Handed> {
    if run.task.every_s <= 0.0 {
        return None;
    }
    let links = held_on(EffectPlace::CommandLink, specs.clone());
    // A task that is faster than the steps of a filter in the engine adds nothing to it.
    let has_room = run.task.every_s >= LEAST_TASK_S && !run.settles && run.settings.is_empty();
    let filters: Vec<&EffectSpec> = specs.filter(|spec| has_room && filters_commands(spec)).collect();
    if links.is_empty() && filters.is_empty() {
        return None;
    }
    let is_of =
        |component: Option<&str>, port: &PortDescriptor| component.is_none_or(|name| effect::is_of(port.name, name));
    let mut other = run.clone();
    other.commands.clear();
    for (at, port) in kind.ports.iter().enumerate() {
        let own = links.iter().filter(|(component, _)| is_of(*component, port));
        let held: Vec<Held> = own.map(|(_, held)| *held).collect();
        let given = run.commands.iter().filter(|(to, _)| *to == at).map(|(_, stamped)| *stamped);
        let mut arrived: Vec<Stamped> = given.map(|given| Stamped { at: arrives(given.at, &held), ..given }).collect();
        for filter in filters.iter().filter(|filter| is_of(filter.component.as_deref(), port)) {
            let Some(time) = number(filter, "time_constant") else { continue };
            let is_number = port.ty == PortType::Real;
            arrived = if is_number { low_pass(&arrived, time, (run.task, run.ends)) } else { stood(&arrived, time) };
        }
        let handed = arrived.into_iter().map(|stamped| Stamped { at: handed(stamped.at, run.task, &held), ..stamped });
        other.commands.extend(handed.map(|stamped| (at, stamped)));
    }
    other.commands.sort_by(|a, b| a.1.at.total_cmp(&b.1.at));
    other.task.every_s = 0.0;
    Some(Handed { run: other, is_filtered: !filters.is_empty() })
}

/// Tasks of shorter cycles are not asked what they take up of a filter, s.
const LEAST_TASK_S: f64 = 0.5e-3;

/// What has come through a low-pass at each instant of a task until a recording `ends`, s: `y + time·dy/dt = x`, x the command that stands, 0 before the
/// first.
fn low_pass(commands: &[Stamped], time: f64, (task, ends): (Task, f64)) -> Vec<Stamped> {
    const SETTLED: f64 = 1e-12;
    let Some(first) = commands.first().filter(|_| time > 0.0) else { return commands.to_vec() };
    let (mut input, mut output, mut since) = (0.0, 0.0, first.at);
    let through = |input: f64, output: f64, span: f64| input + (output - input) * (-span / time).exp();
    let mut commands = commands.iter().peekable();
    let start = task.taken_up(first.at);
    let count = ((ends - start) / task.every_s).max(0.0) as u32 + 1;
    let mut passed: Vec<Stamped> = Vec::with_capacity(count as usize);
    for k in 0..count {
        let at = start + f64::from(k) * task.every_s;
        while let Some(command) = commands.next_if(|command| command.at <= at) {
            output = through(input, output, command.at - since);
            (input, since) = (command.value, command.at);
        }
        let exit = through(input, output, at - since);
        let value = if (exit - input).abs() < SETTLED { input } else { exit };
        if passed.last().map_or(0.0, |last| last.value) != value {
            passed.push(Stamped { at, value });
        }
    }
    passed
}

/// What stands for a `time`, s, and then comes through.
fn stood(commands: &[Stamped], time: f64) -> Vec<Stamped> {
    let next = |at: usize| commands.get(at + 1).map_or(f64::INFINITY, |next| next.at);
    let stands = |(at, command): (usize, &Stamped)| (next(at) - command.at > time).then_some(*command);
    let long = commands.iter().enumerate().filter_map(stands);
    long.map(|command| Stamped { at: command.at + time, ..command }).collect()
}

/// What a barrier's link, and the barrier itself, do to what comes into its beam.
#[derive(Default)]
struct Late {
    /// What holds its reports up.
    held: Vec<Held>,
    /// How long after it is cut it says so, s: `on-delay`.
    on_delay: f64,
    /// After how much of the belt's way, m: `blind-range`.
    blind: f64,
}

impl Late {
    /// Of the barrier of this name.
    fn of<'a>(barrier: &str, specs: impl Iterator<Item = &'a EffectSpec> + Clone) -> Late {
        let is_own = |component: Option<&str>| component.is_none_or(|component| component == barrier);
        let links = held_on(EffectPlace::ReportLink, specs.clone()).into_iter();
        // A flag passes such a filter once it has stood for its time.
        let filters = specs.clone().filter(|spec| spec.place == EffectPlace::ReportLink && spec.kind == "input-filter");
        let filters =
            filters.filter_map(|spec| Some((spec.component.as_deref(), Held::For(number(spec, "time_constant")?))));
        let of_sensor = |kind: &str, name: &str| -> f64 {
            let own = specs.clone().filter(|spec| spec.place == EffectPlace::Sensor && spec.kind == kind);
            own.filter(|spec| is_own(spec.component.as_deref())).filter_map(|spec| number(spec, name)).sum()
        };
        Late {
            held: links.chain(filters).filter(|(component, _)| is_own(*component)).map(|(_, held)| held).collect(),
            on_delay: of_sensor("on-delay", "time"),
            blind: of_sensor("blind-range", "length"),
        }
    }

    /// Whether it is told as it happens.
    fn is_none(&self) -> bool {
        self.held.is_empty() && self.on_delay <= 0.0 && self.blind <= 0.0
    }

    /// When that left the beam which was reported then, s.
    fn left(&self, seen: f64) -> f64 {
        self.held.iter().rev().fold(seen, |at, held| held.sooner(at)).max(0.0)
    }

    /// When that came which was reported then, s, which way the belt ran: 1 or -1.
    fn came(&self, seen: f64, belt: &Way, way: f64) -> f64 {
        let cut = (self.left(seen) - self.on_delay).max(0.0);
        if self.blind > 0.0 { belt.before(cut, way * self.blind).unwrap_or(cut) } else { cut }
    }
}

/// What surrounds a belt as it was, where its `barriers`, or their link, report late what `specs` say; `None` where they do not.
pub(super) fn before_the_report<'a>(
    script: &Script,
    barriers: [Option<&str>; 2],
    specs: impl Iterator<Item = &'a EffectSpec> + Clone,
) -> Option<Arc<Script>> {
    let late = barriers.map(|barrier| barrier.map_or_else(Late::default, |barrier| Late::of(barrier, specs.clone())));
    if late.iter().all(Late::is_none) {
        return None;
    }
    let mut other = script.clone();
    for (place, cut) in other.cuts.iter_mut().enumerate() {
        // The barrier that saw a part first says when it came to the other, too.
        let first = script.cuts[..place].iter().find(|before| before.part == cut.part);
        cut.from = late[first.map_or(cut.beam, |first| first.beam)].came(cut.from, &script.way, cut.way);
        cut.taken = cut.taken.map(|taken| late[cut.beam].left(taken));
    }
    other.cuts.sort_by(|a, b| a.from.total_cmp(&b.from));
    for told in &mut other.told {
        match told.what {
            Surrounding::BarrierA => told.at = late[0].left(told.at),
            Surrounding::BarrierB => told.at = late[1].left(told.at),
            _ => {}
        }
    }
    other.told.sort_by(|a, b| a.at.total_cmp(&b.at));
    Some(Arc::new(other))
}

/// When a command that is stamped `at` has passed a link that holds it up so, s.
fn arrives(at: f64, held: &[Held]) -> f64 {
    held.iter().fold(at, |at, held| held.later(at))
}

/// When it is handed to that link, for it to leave it when the task takes up what arrives `at`, s.
fn handed(at: f64, task: Task, held: &[Held]) -> f64 {
    held.iter().rev().fold(task.taken_up(at), |at, held| held.sooner(at))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::Overrides;
    use crate::gap::recorded_tests::{BLIND_BARRIER, study};
    use crate::gap::subject::beam_of;
    use crate::gap::world::{Cut, Told};
    use crate::plant::EffectPlace::ReportLink;
    use crate::plant::ParameterValue::Number;

    /// Barrier A with an effect of one number.
    fn late(kind: &str, name: &str, value: f64) -> EffectSpec {
        EffectSpec {
            place: EffectPlace::Sensor,
            kind: kind.to_owned(),
            component: Some("lightBarrierA".to_owned()),
            parameters: [(name.to_owned(), Number(value))].into(),
        }
    }

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
        let filter = EffectSpec {
            kind: "input-filter".to_owned(),
            parameters: [("time_constant".to_owned(), Number(0.5))].into(),
            ..dead_time(Some("lightBarrierA"))
        };
        assert_eq!(came(&filter), came(&dead_time(Some("lightBarrierA"))));
        assert_eq!(came(&dead_time(Some("encoder"))), None);
    }

    /// A barrier that is blind over 0.1 m of a belt that goes 0.5 m/s is cut 0.2 s before it says so, as one is that is late by 0.2 s; what leaves it is
    /// seen at once.
    #[test]
    fn parts_came_before_their_barrier_saw_them() {
        let cut = |part: usize, from: f64| Cut {
            part,
            beam: 0,
            from,
            ahead: 0.0,
            front: 0.7,
            way: 1.0,
            length: 0.3,
            is_known: false,
            taken: Some(from + 0.3),
        };
        let way = Arc::new(Way { instants: vec![0.0, 1.5, 9.5], metres: vec![0.0, 0.0, 4.0] });
        let script = Script { cuts: vec![cut(0, 2.0), cut(1, 4.0)], way, ..Script::default() };
        let came = |spec: &EffectSpec| {
            let other = before_the_report(&script, [Some("lightBarrierA"), None], std::iter::once(spec))?;
            assert!(other.cuts.iter().zip(&script.cuts).all(|(other, cut)| other.taken == cut.taken));
            Some(other.cuts.iter().map(|cut| (1e6 * cut.from).round() / 1e6).collect::<Vec<f64>>())
        };
        assert_eq!(came(&late("blind-range", "length", 0.1)), Some(vec![1.8, 3.8]));
        assert_eq!(came(&late("on-delay", "time", 0.2)), Some(vec![1.8, 3.8]));
        // It did not go so far before.
        assert_eq!(came(&late("blind-range", "length", 0.3)), Some(vec![2.0, 3.4]));
        assert_eq!(came(&late("off-delay", "time", 0.2)), None);
    }

    /// What parts do that a barrier sees 0.1 m late is explained by that, and less so by a delay of about the same mean.
    #[test]
    fn a_barrier_that_sees_late_leaves_nothing_where_its_parts_are() {
        let study = study(BLIND_BARRIER);
        let belt = study.subject("Belt").expect("it moves");
        let left = |kind: &str, name: &str, value: f64| {
            // Its second barrier is 11 mm sooner than declared, within its tolerance.
            let predicted =
                belt.predict(&[late(kind, name, value)], &Overrides::one("barrierB", 1.6889)).expect("a prediction");
            let score = belt.score(&predicted);
            let of_barriers = score.signals.iter().filter(|score| beam_of(&belt.signals[score.signal]).is_some());
            of_barriers.map(|score| score.cost).sum::<f64>()
        };
        let (gap, blind, late) =
            (left("blind-range", "length", 0.0), left("blind-range", "length", 0.104), left("on-delay", "time", 0.22));
        assert!(blind < 0.2 * gap && late > 2.0 * blind && late < gap, "{blind} {late} of {gap}");
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
            let left = (handed(arrives(at, &held), task, &held) + 2.34e-2) * 1.001;
            assert!((left - task.taken_up(arrived)).abs() < 1e-9, "{at}: {left}");
            assert!(left >= arrived - 1e-9 && left < arrived + 1e-3, "{at}: {left}");
            assert!((handed(at, task, &[]) - task.taken_up(at)).abs() < 1e-12);
        }
    }

    /// A command of 1 at 0.2004 s and of 0 at 0.2031 s, behind a filter of 10 ms, is what has come through by each next whole millisecond; a flag that
    /// stands for less than its filter's time does not come through.
    #[test]
    fn a_task_takes_up_what_has_come_through_a_filter() {
        let task = Task { every_s: 1e-3, phase_s: 0.0, ..Task::default() };
        let given = [Stamped { at: 0.2004, value: 1.0 }, Stamped { at: 0.2031, value: 0.0 }];
        let passed = low_pass(&given, 0.01, (task, 1.0));
        let at = |k: usize| 1.0 - (-(0.2 + 1e-3 * k as f64 - 0.2004) / 0.01).exp();
        for (k, stamped) in passed.iter().take(3).enumerate() {
            assert!((stamped.at - 0.201 - 1e-3 * k as f64).abs() < 1e-9, "{stamped:?}");
            assert!((stamped.value - at(k + 1)).abs() < 1e-9, "{stamped:?}");
        }
        let most = 1.0 - (-(0.2031 - 0.2004) / 0.01_f64).exp();
        assert!((passed[3].value - most * (-0.0009 / 0.01_f64).exp()).abs() < 1e-9, "{:?}", passed[3]);
        assert_eq!(passed.last().map(|last| last.value), Some(0.0));
        assert_eq!(stood(&given, 0.002).iter().map(|stamped| stamped.value).collect::<Vec<_>>(), [1.0, 0.0]);
        let late = stood(&given, 0.003);
        assert!(late.len() == 1 && late[0].value == 0.0 && (late[0].at - 0.2061).abs() < 1e-9, "{late:?}");
    }
}
