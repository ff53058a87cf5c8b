//! A device on its own clock: commands in at their times, reports looked at on their grids, edges found between.

use std::sync::Arc;

use super::looks::Looks;
use super::prediction::{Passing, Predicted, PredictedEdge, Pulse, Turn};
use super::restarts::{Restart, Restarts};
use super::subject::Run;
use super::tape::Tape;
use super::track::Track;
use super::world::{Leg, Script, World};
use crate::device::path::Motion;
use crate::device::{Device, Role};

/// Two instants nearer than this are one, s.
pub(super) const SAME_S: f64 = 1e-9;
/// How well the instant of an edge is known, s: a thousandth of how far a sensor may be off. And how often a span is halved at most.
const EDGE_S: f64 = 1e-7;
const HALVINGS: u32 = 24;

/// How long a device that a recording finds under way is given to settle, s.
const SETTLING_S: f64 = 5.0;

/// A report that is looked at.
pub(super) struct Watch<'a> {
    pub port: usize,
    pub track: Option<&'a Track>,
    /// How far behind the grid's instant the state is looked at, s.
    pub lead: f64,
    /// The beam that it reports, if it is a barrier's.
    pub beam: Option<usize>,
    /// Whether it is of a speed: one that passes 0 may bring a state there and back.
    pub is_speed: bool,
}

impl Watch<'_> {
    /// Whether it is of states, whose changes are looked for.
    pub fn is_edge(&self) -> bool {
        self.track.is_some_and(|track| track.values.is_empty())
    }
}

/// A device with its clock.
#[derive(Clone)]
pub(super) struct Alone {
    device: Box<dyn Device>,
    world: Option<World>,
    now: f64,
    reports: Vec<f64>,
}

impl Alone {
    /// A device at rest at t = 0 with so many ports, and what surrounds it.
    pub fn new(mut device: Box<dyn Device>, ports: usize, script: &Arc<Script>) -> Alone {
        let mut world = World::new(script);
        if let Some(world) = &mut world {
            world.begin(device.as_mut());
        }
        Alone { device, world, now: 0.0, reports: vec![0.0; ports] }
    }

    /// Moves on; whether that was smooth: see [`World::advance`].
    pub fn advance_to(&mut self, at: f64) -> bool {
        let is_smooth = match &mut self.world {
            Some(world) => world.advance(&mut self.device, self.now, at),
            None => {
                self.device.advance(at - self.now);
                true
            }
        };
        self.now = at;
        is_smooth
    }

    /// Until when at least no state changes if nothing is told, s.
    fn quiet_until(&self) -> f64 {
        let world = self.world.as_ref().map_or(f64::INFINITY, |world| world.quiet_until(self.now));
        if world > self.now { world.min(self.now + self.device.unchanged_for()) } else { self.now }
    }

    /// Moves on to `at`, from where it is smooth to where it is smooth.
    fn advance_in_legs(&mut self, at: f64) -> Vec<Leg> {
        let legs = match &mut self.world {
            Some(world) => world.advance_in_legs(&mut self.device, self.now, at),
            None => {
                let leg = Leg { device: self.device.clone(), from: self.now, to: at, until: at };
                self.device.advance(at - self.now);
                vec![leg]
            }
        };
        self.now = at;
        legs
    }

    /// Takes up a command of the run.
    pub fn obey(&mut self, run: &Run, command: usize) {
        let (port, stamped) = run.commands[command];
        self.device.command(port, stamped.value);
    }

    /// Lets the device come to where its first commands of each port lead, and sets the clock back.
    fn settle(&mut self, run: &Run) {
        let mut told = Vec::new();
        for (port, stamped) in &run.commands {
            if !told.contains(port) {
                told.push(*port);
                self.device.command(*port, stamped.value);
            }
        }
        self.device.advance(SETTLING_S);
    }

    /// Takes the device up where its machine was.
    fn take_up(&mut self, restarts: &Restarts, at: usize) {
        self.device.report(&mut self.reports);
        let Restart { position, velocity, .. } = restarts.each[at];
        let by = Motion {
            position: position - self.reports[restarts.position],
            velocity: velocity - self.reports[restarts.velocity],
        };
        self.device.shift(by);
    }

    /// The part that changed a beam last, if the port is that beam's.
    fn passing(&self, beam: Option<usize>) -> Option<Passing> {
        self.world.as_ref()?.last[beam?]
    }

    /// Where parts nearly changed a beam.
    fn turns(&self, beam: Option<usize>) -> Vec<Turn> {
        let of_beam = self.world.as_ref().zip(beam).map(|(world, beam)| world.turns(beam));
        of_beam.into_iter().flatten().collect()
    }

    pub fn look(&mut self) -> &[f64] {
        self.device.report(&mut self.reports);
        &self.reports
    }
}

/// The commands of a run with their ports, when its task takes each up.
pub(super) fn taken_up(run: &Run) -> impl Iterator<Item = (usize, f64, f64)> {
    run.commands.iter().map(|(port, told)| (*port, run.task.taken_up(told.at), told.value))
}

/// How far the belt of a device has gone at each of `instants`, which ascend, in a run without parts, m.
pub(super) fn travel(mut device: Box<dyn Device>, run: &Run, instants: &[f64]) -> Vec<f64> {
    let mut commands = taken_up(run);
    let mut next = commands.next();
    let (mut now, mut way) = (0.0, 0.0);
    let mut go = |device: &mut Box<dyn Device>, to: f64| {
        if to > now {
            device.advance(to - now);
            now = to;
            if let Role::Carries(belt) = device.role() {
                way += belt.displacement;
            }
        }
        way
    };
    let mut ways = Vec::with_capacity(instants.len());
    for instant in instants {
        while let Some((port, at, value)) = next.filter(|(_, at, _)| at <= instant) {
            go(&mut device, at);
            device.command(port, value);
            next = commands.next();
        }
        ways.push(go(&mut device, *instant));
    }
    ways
}

/// How finely it is asked when a device moves, s: well below all cycles of reports.
const ASKED_S: f64 = 1e-3;

/// How many actuators of a device move without parts until a run `ends`, s, from each instant on. `commands`: port, instant and value.
pub(super) fn moving(
    mut device: Box<dyn Device>,
    commands: impl Iterator<Item = (usize, f64, f64)>,
    ends: f64,
) -> Vec<(f64, u32)> {
    let mut commands = commands.peekable();
    let mut steps = Vec::new();
    let (mut now, mut before) = (0.0, 0);
    while now < ends {
        while let Some((port, _, value)) = commands.next_if(|(_, at, _)| *at <= now + SAME_S) {
            device.command(port, value);
        }
        let next = commands.peek().map_or(f64::INFINITY, |(_, at, _)| *at);
        let until = (now + ASKED_S).min(next);
        device.advance(until - now);
        let count = device.moving();
        if count != before {
            steps.push((0.5 * (now + until), count));
            before = count;
        }
        now = until;
    }
    steps
}

/// What happens next.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Next {
    Command(usize),
    /// The device is taken up where its machine was.
    TakeUp,
    /// The streams that are due at this instant are sampled.
    Sample,
}

/// Lets a device live through a run.
pub(super) fn run(mut alone: Alone, run: &Run, watches: &[Watch<'_>]) -> Vec<Predicted> {
    let mut looks = Looks::new(run, watches);
    if run.settles {
        alone.settle(run);
    }
    let mut views: Vec<View> = watches.iter().map(|watch| View::new(watch, &alone)).collect();
    let has_edges = views.iter().any(|view| view.is_edge);
    // Where nothing is looked for between two steps, nothing needs to be kept.
    let keeps = has_edges || alone.world.is_some();
    let mut tape = keeps.then(|| Tape::new(&alone, has_edges));
    let (mut command, mut taken_up_again) = (0, 0);
    let restarts = run.restarts.as_deref();
    let due_at = |command: usize| run.commands.get(command).map(|(_, stamped)| run.task.taken_up(stamped.at));
    let mut due = due_at(command);
    loop {
        let restart = restarts.and_then(|restarts| restarts.each.get(taken_up_again)).map(|restart| restart.at);
        let quiet = if looks.are_of_states() { alone.quiet_until() } else { alone.now };
        let looked = looks.next(due.into_iter().chain(restart).min_by(f64::total_cmp), quiet);
        let is_next = |restart: f64, looked: f64| restart <= looked && due.is_none_or(|due| restart <= due);
        let (at, next) = match (due, looked) {
            (_, None) => break,
            (_, Some(looked)) if restart.is_some_and(|restart| is_next(restart, looked)) => {
                (restart.unwrap_or(looked).max(alone.now), Next::TakeUp)
            }
            (Some(due), Some(looked)) if is_first(due, looked, run.commands_first) => (due, Next::Command(command)),
            (_, Some(looked)) => (looked, Next::Sample),
        };
        if at > alone.now {
            // A speed that passes 0 may bring a state there and back.
            let before = looks.signs(&alone.reports);
            let is_smooth = alone.advance_to(at);
            if has_edges {
                alone.look();
            }
            let is_still = is_smooth && views.iter().all(|view| view.is_as_in(&alone));
            if let Some(tape) = &mut tape {
                if is_still && (!has_edges || before == looks.signs(&alone.reports)) {
                    tape.advanced(at, &alone);
                } else {
                    alone = tape.rewound(run);
                    if looks.leaps() {
                        looks.go_slowly_until(at);
                        continue;
                    }
                    let legs = alone.advance_in_legs(at);
                    note_edges(&mut views, &legs, &mut alone);
                    tape.begin(&alone);
                }
            }
        }
        match next {
            Next::Command(index) => {
                alone.obey(run, index);
                if let Some(tape) = &mut tape {
                    tape.obeyed(index);
                }
                command += 1;
                due = due_at(command);
                if has_edges {
                    note_at_once(&mut views, &mut alone);
                }
            }
            Next::TakeUp => {
                restarts.into_iter().for_each(|restarts| alone.take_up(restarts, taken_up_again));
                taken_up_again += 1;
                if has_edges {
                    note_at_once(&mut views, &mut alone);
                }
                if let Some(tape) = &mut tape {
                    tape.begin(&alone);
                }
            }
            Next::Sample => {
                alone.look();
                if let Some(tape) = &mut tape {
                    tape.looked();
                }
                looks.taken(at, |signal, index| {
                    views[signal].sample(index, alone.reports[watches[signal].port]);
                });
            }
        }
    }
    for view in &mut views {
        if let Predicted::Edges { turns, .. } = &mut view.predicted {
            *turns = alone.turns(view.beam);
        }
    }
    views.into_iter().map(|view| view.predicted).collect()
}

/// Whether a command that is due comes before a look: at equal times a machine has looked already.
fn is_first(due: f64, looked: f64, commands_first: bool) -> bool {
    if commands_first { due <= looked + SAME_S } else { due < looked - SAME_S }
}

/// What is seen of one signal so far.
struct View {
    port: usize,
    is_edge: bool,
    is_speed: bool,
    /// What it is now, and since when.
    state: f64,
    since: f64,
    beam: Option<usize>,
    passing: Option<Passing>,
    /// What was last shown.
    shown: Option<f64>,
    predicted: Predicted,
}

impl View {
    fn new(watch: &Watch<'_>, alone: &Alone) -> View {
        let is_edge = watch.is_edge();
        let predicted = match watch.track {
            None => Predicted::Nothing,
            Some(_) if is_edge => {
                Predicted::Edges { initial: 0.0, edges: Vec::new(), unseen: Vec::new(), turns: Vec::new() }
            }
            Some(track) => Predicted::Level(Vec::with_capacity(track.values.len())),
        };
        let mut alone = alone.clone();
        let state = alone.look()[watch.port];
        let (port, is_speed, beam) = (watch.port, watch.is_speed, watch.beam);
        View { port, is_edge, is_speed, state, since: 0.0, beam, passing: None, shown: None, predicted }
    }

    /// Whether a look at the device finds the signal as it was.
    fn is_as_in(&self, alone: &Alone) -> bool {
        !self.is_edge || alone.reports[self.port] == self.state
    }

    fn becomes(&mut self, state: f64, at: f64, passing: Option<Passing>) {
        if let Predicted::Edges { unseen, .. } = &mut self.predicted
            && self.shown == Some(state)
        {
            unseen.push(Pulse { from: self.since, until: at, to: self.state });
        }
        (self.state, self.since, self.passing) = (state, at, passing);
    }

    /// It is looked at, at the grid's instant `index`.
    fn sample(&mut self, index: usize, value: f64) {
        match &mut self.predicted {
            Predicted::Nothing => {}
            Predicted::Level(values) => values.push(value),
            Predicted::Edges { initial, edges, .. } => {
                match self.shown {
                    None => *initial = value,
                    Some(shown) if shown != value => {
                        edges.push(PredictedEdge { at: self.since, index, to: value, part: self.passing });
                    }
                    Some(_) => {}
                }
                self.shown = Some(value);
            }
        }
    }
}

/// Finds when, in the legs that end now, states became what they are, and which were another in between.
fn note_edges(views: &mut [View], legs: &[Leg], alone: &mut Alone) {
    alone.look();
    legs.iter().for_each(|leg| note_pulses(views, leg, alone));
    for view in views.iter_mut().filter(|view| !view.is_as_in(alone)) {
        let state = alone.reports[view.port];
        let mut reports = vec![0.0; alone.reports.len()];
        let mut is_there = |device: &mut Box<dyn Device>| {
            device.report(&mut reports);
            reports[view.port] == state
        };
        let at = legs.iter().zip(legs.iter().skip(1).map(Some).chain([None]));
        let at = at.filter_map(|(leg, next)| becomes_in(leg, next, What::State, &mut is_there)).next();
        view.becomes(state, at.unwrap_or(alone.now), alone.passing(view.beam));
    }
}

/// Finds the states that are as they were, and were not where a speed passes 0 in a leg.
fn note_pulses(views: &mut [View], leg: &Leg, alone: &Alone) {
    let speeds: Vec<usize> = views.iter().filter(|view| view.is_speed).map(|view| view.port).collect();
    if speeds.is_empty() {
        return;
    }
    let mut look = vec![0.0; alone.reports.len()];
    let mut reports = |device: &mut Box<dyn Device>| {
        device.report(&mut look);
        look.clone()
    };
    let mut end = leg.device.clone();
    end.advance(leg.to - leg.from);
    let (first, last) = (reports(&mut leg.device.clone()), reports(&mut end));
    let passing: Vec<usize> = speeds.into_iter().filter(|port| first[*port] * last[*port] < 0.0).collect();
    for speed in passing {
        let mut is_beyond = |device: &mut Box<dyn Device>| reports(device)[speed] * last[speed] > 0.0;
        let Some(at) = becomes_in(leg, None, What::Speed, &mut is_beyond) else { continue };
        let mut there = leg.device.clone();
        there.advance(at - leg.from);
        let passed = reports(&mut there);
        for view in views.iter_mut().filter(|view| view.is_edge && view.is_as_in(alone)) {
            let (port, to) = (view.port, passed[view.port]);
            let Predicted::Edges { unseen, .. } = &mut view.predicted else { continue };
            if to == view.state || view.shown != Some(view.state) {
                continue;
            }
            let before = Leg { device: leg.device.clone(), from: leg.from, to: at, until: at };
            let after = Leg { device: there.clone(), from: at, to: leg.to, until: leg.to };
            let from = becomes_in(&before, None, What::State, &mut |device| reports(device)[port] == to);
            let until = becomes_in(&after, None, What::State, &mut |device| reports(device)[port] != to);
            unseen.extend(from.zip(until).map(|(from, until)| Pulse { from, until, to }));
        }
    }
}

/// What comes to be so of a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum What {
    /// A report that steps is another.
    State,
    /// A speed is beyond 0.
    Speed,
}

/// When in a leg, or at its end, something comes to be so of its device.
fn becomes_in(
    leg: &Leg,
    next: Option<&Leg>,
    what: What,
    is_so: &mut dyn FnMut(&mut Box<dyn Device>) -> bool,
) -> Option<f64> {
    let mut end = leg.device.clone();
    end.advance(leg.to - leg.from);
    if !is_so(&mut end) {
        let is_after = next.is_none_or(|next| is_so(&mut next.device.clone()));
        return is_after.then_some(leg.until);
    }
    let (mut device, mut low, mut high) = (leg.device.clone(), leg.from, leg.to);
    for _ in 0..HALVINGS {
        if high - low < EDGE_S {
            break;
        }
        // Where the device knows until when a state stays, that is mostly when it changes; some know less and less the nearer they come, so that
        // what is sought has to be halved at least.
        let stays = if what == What::State { device.unchanged_for().min(high - low) } else { 0.0 };
        let at = match stays > EDGE_S && stays >= 0.5 * (high - low) {
            true => {
                device.advance(stays);
                low += stays;
                (low + 0.5 * EDGE_S).min(high)
            }
            false => 0.5 * (low + high),
        };
        let mut middle = device.clone();
        middle.advance(at - low);
        if is_so(&mut middle) { high = at } else { (device, low) = (middle, at) }
    }
    Some(high)
}

/// Takes up what follows a command at once.
fn note_at_once(views: &mut [View], alone: &mut Alone) {
    alone.look();
    for view in views.iter_mut().filter(|view| view.is_edge) {
        let state = alone.reports[view.port];
        if state != view.state {
            view.becomes(state, alone.now, alone.passing(view.beam));
        }
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use crate::device::KINDS;
    use crate::gap::{Overrides, Predicted, Recording, Study};
    use crate::plant::{self, embedded::Embedded};
    use crate::trace::Reader;

    /// When the rig's robot is predicted to leave and to arrive, its reports being looked at every `cycle` s.
    fn arrivals(cycle: f64) -> Vec<(f64, f64)> {
        let plant = plant::load(&Embedded, "models/rig", KINDS).expect("the rig");
        let mut lines: Vec<(f64, String)> = Vec::new();
        for (at, x, y) in [(0.3, 0.31, 0.0), (1.9, 0.05, 0.17), (3.4, 0.3, -0.2)] {
            let told = [("XTarget", x), ("YTarget", y)];
            let told = told.map(|(name, value)| format!(r#"{{"name":"Robot.{name}","value":{value}}}"#)).join(",");
            lines.push((at, format!(r#""automation","SendValue":[{told}]"#)));
        }
        for look in 1..(5.0 / cycle) as u32 {
            let moves = look % 2;
            let report = [("actualPosX", format!("0.{moves}")), ("cartesianArrived", "true".to_owned())];
            let report = report.map(|(name, value)| format!(r#"{{"name":"Robot.{name}","value":{value}}}"#)).join(",");
            lines.push((cycle * f64::from(look), format!(r#""plant","SendValue":[{report}]"#)));
        }
        lines.sort_by(|a, b| a.0.total_cmp(&b.0));
        let each = lines.iter().map(|(at, line)| format!("{{\"t\":{at:.6},\"from\":{line}}}\n"));
        let header = r#"{"trace":"kinetwin/1","source":"plant"}"#;
        let text = format!("{header}\n{}", each.collect::<String>());
        let reader = Reader::new("robot", Cursor::new(text.into_bytes())).expect("a trace");
        let recording = Recording::read(&plant, "robot", reader, &[]).expect("a recording");
        let study = Study::new(&plant, &[recording]).expect("a study");
        let robot = study.subject("Robot").expect("the robot");
        let arrived = robot.signals.iter().position(|info| info.property == "cartesianArrived").expect("its flag");
        let runs = robot.predict(&[], &Overrides::none()).expect("a robot").runs;
        let Predicted::Edges { edges, .. } = &runs[0][arrived] else { panic!("{runs:?}") };
        edges.iter().map(|edge| (edge.at, edge.to)).collect()
    }

    /// A robot knows the less how long it stays away the nearer it comes.
    #[test]
    fn when_a_robot_arrives_does_not_depend_on_when_it_is_looked_at() {
        let [fine, coarse] = [0.002, 0.05].map(arrivals);
        assert_eq!((fine.len(), coarse.len()), (6, 6), "{fine:?} {coarse:?}");
        for (fine, coarse) in fine.iter().zip(&coarse) {
            assert!((fine.0 - coarse.0).abs() < 1e-6 && fine.1 == coarse.1, "{fine:?} {coarse:?}");
        }
    }
}
