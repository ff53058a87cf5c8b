//! A device whose signals do not pass untouched: effects at its command link, its sensors and its report link.
//!
//! These places lie outside the device's law, so they are strung around any device without its knowing. The stages see
//! every change of a command at its instant, and every report at the end of each stretch and whenever it is asked for.
//! Signals may also be swapped: then two of a device's commands, or of its reports, change places before all stages.

use crate::device::law::SAME_INSTANT_S;
use crate::device::path::{Moment, Motion, Path, STEPS_STRETCH_S, Stages};
use crate::device::{Belt, Device, Plate, Role, Surroundings, Tool};

/// Within this a step comes whose instant a device knows, s.
const SOON_S: f64 = 1e-7;

/// What a device knows to stay for as long as this is worth a stretch of its own, s: some know less and less the nearer they come.
const LONG_S: f64 = 1e-3;

/// A device with stages around it.
#[derive(Clone)]
pub struct Affected {
    inner: Box<dyn Device>,
    signals: Vec<Signal>,
    /// The longest stretch that all stages bear but those of reports that step, s.
    longest: f64,
    /// The longest that those bear, s: as long as none of their reports steps, they bear any.
    longest_of_steps: f64,
    /// Whether it is known of all stages of commands and of reports that step when their exits next change by themselves.
    is_foreseen: bool,
    /// Whether any report passes a stage.
    reports_pass: bool,
    /// The ports of the device whose steps pass a stage: it has to see each at its instant.
    watched: Vec<usize>,
    /// Whether the device has moved to where it knew that no step comes before.
    is_near: bool,
    now: f64,
    reports: Vec<f64>,
    /// What the parts see, over all stretches of one `advance`.
    moved: Option<Moved>,
}

/// What stands about one port of the device.
#[derive(Clone, Debug)]
pub struct Signal {
    /// The stages that its signal passes.
    pub path: Path,
    pub is_command: bool,
    /// What it was last commanded to be; at first, what the device takes it for until it is commanded.
    pub commanded: f64,
    /// The port that it leads to or comes from: its own, unless it is swapped with another.
    pub port: usize,
    /// Whether it is a report that moves in steps: a BOOL, a code.
    pub steps: bool,
}

impl Signal {
    /// Whether its stages are told of each change at its instant, a command's by who gives it and a step's of a report by the device, and know when
    /// their exit changes by itself: nothing happens to them in between.
    fn is_told(&self) -> bool {
        (self.is_command || self.steps) && self.path.stretch() >= STEPS_STRETCH_S
    }
}

/// The role of a device that moves in several stretches: displacements are added up.
#[derive(Clone, Debug)]
enum Moved {
    Belt(Belt),
    Plate(Plate),
    Tool(Tool),
}

impl Affected {
    /// A device with its `signals`, one for each port.
    pub fn new(inner: Box<dyn Device>, signals: Vec<Signal>) -> Affected {
        let (told, others): (Vec<&Signal>, Vec<&Signal>) = signals.iter().partition(|signal| signal.is_told());
        let longest = |of: &[&Signal]| of.iter().map(|signal| signal.path.stretch()).fold(f64::INFINITY, f64::min);
        let steps: Vec<&Signal> = told.into_iter().filter(|signal| !signal.is_command).collect();
        let (longest_of_steps, longest) = (longest(&steps), longest(&others));
        let is_foreseen = !others.iter().any(|signal| signal.is_command || signal.steps);
        let reports_pass = signals.iter().any(|signal| !signal.is_command && !signal.path.is_nominal());
        let reports = vec![0.0; signals.len()];
        let watched = signals.iter().filter(|signal| signal.steps && !signal.path.is_nominal());
        let watched = watched.map(|signal| signal.port).collect();
        let mut affected = Affected {
            inner,
            signals,
            longest,
            longest_of_steps,
            is_foreseen,
            reports_pass,
            watched,
            is_near: false,
            now: 0.0,
            reports,
            moved: None,
        };
        affected.first_commands();
        affected
    }

    /// Shows the stages of the command links what stands at their entry at the start, and the device what comes out of it.
    fn first_commands(&mut self) {
        for Signal { path, is_command, commanded, port, .. } in &mut self.signals {
            if *is_command && !path.is_nominal() {
                let exit = path.signal(*commanded, Moment::default());
                if exit != *commanded {
                    self.inner.command(*port, exit);
                }
            }
        }
    }

    fn moment(&self, span: f64) -> Moment {
        Moment { now: self.now, span }
    }

    /// Gives the inner device what stands at the exit of its command links now.
    fn pass_commands(&mut self, span: f64) {
        let moment = self.moment(span);
        for Signal { path, is_command, commanded, port, .. } in &mut self.signals {
            if *is_command && !path.is_nominal() {
                let exit = path.signal(*commanded, moment);
                self.inner.command(*port, exit);
            }
        }
    }

    /// Lets the reports pass their stages, and keeps what comes out.
    fn pass_reports(&mut self, span: f64, reports: &mut [f64]) {
        self.inner.report(&mut self.reports);
        let moment = self.moment(span);
        for (own, Signal { path, is_command, port, .. }) in self.signals.iter_mut().enumerate() {
            if *is_command {
                continue;
            }
            let mut value = self.reports[*port];
            if !path.is_nominal() {
                if let Some(travel) = self.inner.travel(*port) {
                    path.travelled(travel);
                }
                value = path.signal(value, moment);
            }
            if let Some(report) = reports.get_mut(own) {
                *report = value;
            }
        }
    }

    /// Shows the stages what has changed at this very instant.
    fn see_reports(&mut self) {
        if self.reports_pass {
            self.pass_reports(0.0, &mut []);
        }
    }

    /// How long it is until the exit of a stage changes by itself, s.
    fn until_a_change(&self) -> f64 {
        let change = self.signals.iter().filter_map(|signal| signal.path.next_change()).min_by(f64::total_cmp);
        change.map_or(f64::INFINITY, |at| at - self.now)
    }

    /// The longest stretch from now on, of at most `rest`: a stage's next change ends it.
    fn stretch(&self, rest: f64) -> f64 {
        let until = self.until_a_change();
        // A change that is due, or so near that time would not move, does not hold time up.
        let until = if until > SAME_INSTANT_S { until } else { f64::INFINITY };
        let mut span = rest.min(self.longest).min(until);
        if span > self.longest_of_steps {
            span = span.min(self.longest_of_steps.max(self.inner.unchanged_for()));
        }
        // What rounding leaves of the whole is no stretch of its own.
        if rest - span < SAME_INSTANT_S { rest } else { span }
    }

    /// Moves by `span`, or to the first step of a report that is watched; returns how long that took.
    fn move_by(&mut self, span: f64) -> f64 {
        let is_near = std::mem::take(&mut self.is_near);
        // A copy of a device takes as long as many steps of it.
        let stays = if self.watched.is_empty() { f64::INFINITY } else { self.inner.unchanged_for() };
        if stays > span.min(LONG_S) {
            self.is_near = stays <= span;
            self.inner.advance(span.min(stays));
            return span.min(stays);
        }
        let (start, before) = (self.inner.clone(), self.steps());
        let mut still = 0.0;
        // Where a device knew until when nothing changes, that is mostly when something does.
        if is_near && span > SOON_S {
            self.inner.advance(SOON_S);
            if self.steps() == before {
                still = SOON_S;
                self.inner = start.clone();
            }
        }
        let mut stepped = if is_near && span > SOON_S && still == 0.0 { SOON_S } else { span };
        if stepped == span {
            self.inner.advance(span);
            if self.steps() == before {
                return span;
            }
        }
        while stepped - still > SAME_INSTANT_S {
            let middle = 0.5 * (still + stepped);
            self.inner = start.clone();
            self.inner.advance(middle);
            if self.steps() == before { still = middle } else { stepped = middle }
        }
        self.inner = start;
        self.inner.advance(stepped);
        stepped
    }

    /// What the reports that are watched show now.
    fn steps(&mut self) -> Vec<f64> {
        self.inner.report(&mut self.reports);
        self.watched.iter().map(|port| self.reports[*port]).collect()
    }

    fn add_up(&mut self) {
        let before = self.moved.take();
        self.moved = match (self.inner.role(), before) {
            (Role::Carries(belt), Some(Moved::Belt(sum))) => {
                let displacement = sum.displacement + belt.displacement;
                Some(Moved::Belt(Belt { displacement, speeds: [sum.speeds[0], belt.speeds[1]], ..*belt }))
            }
            (Role::Carries(belt), _) => Some(Moved::Belt(*belt)),
            (Role::Pushes(plate), Some(Moved::Plate(sum))) => {
                Some(Moved::Plate(Plate { displacement: sum.displacement + plate.displacement, ..*plate }))
            }
            (Role::Pushes(plate), _) => Some(Moved::Plate(*plate)),
            (Role::Moves(tool), _) => Some(Moved::Tool(*tool)),
            _ => None,
        };
    }
}

impl Device for Affected {
    fn command(&mut self, port: usize, value: f64) {
        let moment = self.moment(0.0);
        let signal = &mut self.signals[port];
        signal.commanded = value;
        let exit = if signal.path.is_nominal() { value } else { signal.path.signal(value, moment) };
        self.inner.command(signal.port, exit);
        self.see_reports();
    }

    fn sense(&mut self, surroundings: &Surroundings) {
        self.inner.sense(surroundings);
        self.see_reports();
    }

    fn travel(&self, port: usize) -> Option<f64> {
        self.inner.travel(port)
    }

    fn moving(&self) -> u32 {
        self.inner.moving()
    }

    fn joints(&self, visit: &mut dyn FnMut(&'static str, f64)) {
        self.inner.joints(visit);
    }

    fn shift(&mut self, by: Motion) -> bool {
        let is_shifted = self.inner.shift(by);
        self.see_reports();
        is_shifted
    }

    fn share(&mut self, others: u32) {
        self.inner.share(others);
    }

    fn advance(&mut self, seconds: f64) {
        if self.now == 0.0 {
            // What stands there at the start.
            self.see_reports();
        }
        let end = self.now + seconds;
        let mut rest = seconds;
        self.moved = None;
        while rest > 0.0 {
            let stretch = self.stretch(rest);
            let stretch = self.move_by(stretch);
            self.add_up();
            rest -= stretch;
            self.now = if rest > 0.0 { self.now + stretch } else { end };
            self.pass_commands(stretch);
            if self.reports_pass {
                self.pass_reports(stretch, &mut []);
            }
        }
    }

    fn report(&mut self, reports: &mut [f64]) {
        self.pass_reports(0.0, reports);
    }

    fn unchanged_for(&self) -> f64 {
        match self.is_foreseen {
            true => self.inner.unchanged_for().min(self.until_a_change() - 2.0 * SAME_INSTANT_S).max(0.0),
            false => 0.0,
        }
    }

    fn count_finely(&mut self) {
        self.inner.count_finely();
        self.signals.iter_mut().for_each(|signal| signal.path.count_finely());
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        self.inner.state(visit);
        visit(self.now);
        for signal in &self.signals {
            signal.path.state(visit);
            visit(signal.commanded);
        }
    }

    fn boxed(&self) -> Box<dyn Device> {
        Box::new(self.clone())
    }

    fn stages(&mut self, component: Option<&str>) -> Option<&mut Stages> {
        self.inner.stages(component)
    }

    fn role(&self) -> Role<'_> {
        match &self.moved {
            Some(Moved::Belt(belt)) => Role::Carries(belt),
            Some(Moved::Plate(plate)) => Role::Pushes(plate),
            Some(Moved::Tool(tool)) => Role::Moves(tool),
            None => self.inner.role(),
        }
    }
}
