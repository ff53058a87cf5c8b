//! A device whose signals do not pass untouched: effects at its command link, its sensors and its report link.
//!
//! These places lie outside the device's law, so they are strung around any device without its knowing. The stages see
//! every change of a command at its instant, and every report at the end of each stretch and whenever it is asked for.

use crate::device::path::{Moment, Path, STRETCH_S, Stages};
use crate::device::{Belt, Device, Plate, Role, Surroundings, Tool};

/// A device with stages around it.
#[derive(Clone)]
pub struct Affected {
    inner: Box<dyn Device>,
    /// For each port: the stages its signal passes.
    paths: Vec<Path>,
    /// For each port: whether it is a command.
    is_command: Vec<bool>,
    /// For each command port: what was commanded.
    commanded: Vec<f64>,
    now: f64,
    reports: Vec<f64>,
    /// What the parts see, over all stretches of one `advance`.
    moved: Option<Moved>,
}

/// The role of a device that moves in several stretches: displacements are added up.
#[derive(Clone, Debug)]
enum Moved {
    Belt(Belt),
    Plate(Plate),
    Tool(Tool),
}

impl Affected {
    /// A device whose `paths`, one for each port, are passed by its signals.
    pub fn new(inner: Box<dyn Device>, paths: Vec<Path>, is_command: Vec<bool>) -> Affected {
        let ports = paths.len();
        let mut affected = Affected {
            inner,
            paths,
            is_command,
            commanded: vec![0.0; ports],
            now: 0.0,
            reports: vec![0.0; ports],
            moved: None,
        };
        affected.pass_commands(0.0);
        affected
    }

    fn moment(&self, span: f64) -> Moment {
        Moment { now: self.now, span }
    }

    /// Gives the inner device what stands at the exit of its command links now.
    fn pass_commands(&mut self, span: f64) {
        let moment = self.moment(span);
        for port in 0..self.paths.len() {
            if self.is_command[port] && !self.paths[port].is_nominal() {
                let exit = self.paths[port].signal(self.commanded[port], moment);
                self.inner.command(port, exit);
            }
        }
    }

    /// Lets the reports pass their stages, and keeps what comes out.
    fn pass_reports(&mut self, span: f64) {
        self.inner.report(&mut self.reports);
        let moment = self.moment(span);
        for port in 0..self.paths.len() {
            if !self.is_command[port] && !self.paths[port].is_nominal() {
                self.reports[port] = self.paths[port].signal(self.reports[port], moment);
            }
        }
    }

    /// The longest stretch from now on, of at most `rest`: a stage's next change ends it.
    fn stretch(&self, rest: f64) -> f64 {
        let change = self.paths.iter().filter_map(Path::next_change).min_by(f64::total_cmp);
        let until = change.map_or(f64::INFINITY, |at| at - self.now);
        // A change that is due already does not hold up time.
        let until = if until > 0.0 { until } else { f64::INFINITY };
        rest.min(STRETCH_S).min(until)
    }

    fn add_up(&mut self) {
        let before = self.moved.take();
        self.moved = match (self.inner.role(), before) {
            (Role::Carries(belt), Some(Moved::Belt(sum))) => {
                Some(Moved::Belt(Belt { displacement: sum.displacement + belt.displacement, ..*belt }))
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
        if self.paths[port].is_nominal() {
            return self.inner.command(port, value);
        }
        self.commanded[port] = value;
        let moment = self.moment(0.0);
        let exit = self.paths[port].signal(value, moment);
        self.inner.command(port, exit);
    }

    fn sense(&mut self, surroundings: &Surroundings) {
        self.inner.sense(surroundings);
    }

    fn advance(&mut self, seconds: f64) {
        let end = self.now + seconds;
        let mut rest = seconds;
        self.moved = None;
        while rest > 0.0 {
            let stretch = self.stretch(rest);
            self.inner.advance(stretch);
            self.add_up();
            rest -= stretch;
            self.now = if rest > 0.0 { self.now + stretch } else { end };
            self.pass_commands(stretch);
            self.pass_reports(stretch);
        }
    }

    fn report(&mut self, reports: &mut [f64]) {
        self.pass_reports(0.0);
        for (port, report) in reports.iter_mut().enumerate() {
            if !self.is_command[port] {
                *report = self.reports[port];
            }
        }
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        self.inner.state(visit);
        for path in &self.paths {
            path.state(visit);
        }
        for value in &self.commanded {
            visit(*value);
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
