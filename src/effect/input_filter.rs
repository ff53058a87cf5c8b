//! `input-filter`: an input is filtered before it is used: a number by a first-order low-pass, a BOOL or a code by taking on a
//! new value only after it has stood for the time.
//!
//! Source: input filters of programmable controllers (IEC 61131-2:2017, clause 6.3; the low-pass as in `first-order-lag`).

use super::first_order_lag::{Course, follow};
use super::line::Mail;
use super::table::{BASE, time};
use crate::device::law::SAME_INSTANT_S;
use crate::device::law::encoder::SAME_COUNT;
use crate::device::path::{Moment, STEPS_STRETCH_S, STRETCH_S, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, SignalClass, Site};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "input-filter",
    summary: "an input is filtered before it is used",
    equation: "number: time_constant·dy/dt + y = x; BOOL or code: y = x once it has stood for time_constant",
    source: "IEC 61131-2:2017, 6.3",
    places: &[EffectPlace::CommandLink, EffectPlace::ReportLink],
    fits: &[Fit::Signals(SignalClass::Any)],
    parameters: &[time("time_constant", 0.02, "time constant of the low-pass, or the time that a BOOL must stand")],
    excited_by: "changes of the signal",
    build: Build::Stage(|values, site| InputFilter::stage(values[0], site)),
    ..BASE
};

#[derive(Clone, Debug)]
struct InputFilter {
    time_constant: f64,
    filter: Filter,
    last: f64,
    /// How long a stretch it bears, s.
    stretch: f64,
}

impl InputFilter {
    fn stage(time_constant: f64, site: &Site) -> Box<dyn Stage> {
        let stretch = match site.is_boolean() {
            _ if site.is_command() => f64::INFINITY,
            true => STEPS_STRETCH_S,
            false => STRETCH_S,
        };
        Box::new(InputFilter { time_constant, filter: Filter::new(site), last: 0.0, stretch })
    }
}

#[derive(Clone, Debug)]
enum Filter {
    /// What stood at the entry and at the exit of a measured quantity last.
    Low { input: Option<f64>, output: Option<f64>, is_whole: bool },
    /// A command that is filtered.
    Steps(Steps),
    /// What is new, and from when on it counts.
    Stand { mail: Mail, stood: Option<(f64, f64)> },
}

impl Filter {
    fn new(site: &Site) -> Filter {
        if site.is_smooth() {
            return Filter::Low { input: None, output: None, is_whole: site.is_whole() };
        }
        if site.is_boolean() || site.is_whole() {
            return Filter::Stand { mail: Mail::default(), stood: None };
        }
        Filter::Steps(Steps { shows: site.has_dynamics(), ..Steps::default() })
    }
}

/// A filtered command: a staircase about the filter's own exit, from the command's instant on, each step as high as the exit is on average over it.
/// Its steps are fine beside the time constant at first and grow as the exit flattens, whatever the spans in which time passes. A servo axis pulls by how far it is
/// off its target, and its force would show every step: at an instant at which one is looked at within a step, it is told the exit itself.
#[derive(Clone, Debug, Default)]
struct Steps {
    /// Whether its device shows at once what it is told.
    shows: bool,
    input: Option<f64>,
    /// The filter's exit, and the step's.
    output: f64,
    exit: f64,
    /// When the command came, and when the present step ends, s.
    since: f64,
    until: f64,
}

/// The longest step, s, and the first, in time constants.
const STEP_S: f64 = 1e-3;
const FIRST_STEP: f64 = 1.0 / 32.0;

impl Steps {
    fn pass(&mut self, value: f64, now: f64, span: f64, time_constant: f64) -> f64 {
        let Some(from) = self.input.replace(value) else {
            (self.output, self.exit) = (value, value);
            return value;
        };
        // A command stands until it changes.
        self.output = follow(self.output, Course::straight(from, from), span, time_constant);
        if value != from {
            self.since = now;
        }
        let has_ended = self.exit != value && now + SAME_INSTANT_S >= self.until;
        if value != from || has_ended {
            let flatter = ((now - self.since) / time_constant).exp();
            let step = STEP_S.min(FIRST_STEP * time_constant * flatter).max(2.0 * SAME_INSTANT_S);
            self.until = now + step;
            let steps = step / time_constant;
            self.exit = value - (self.output - value) * (-steps).exp_m1() / steps;
            if (self.exit - value).abs() < 1e-12 {
                (self.output, self.exit) = (value, value);
            }
        } else if self.shows && self.exit != value && span > 0.0 {
            (self.exit, self.until) = (self.output, now + 2.0 * SAME_INSTANT_S);
        }
        self.exit
    }

    fn next(&self) -> Option<f64> {
        (self.input != Some(self.exit)).then_some(self.until)
    }
}

impl Stage for InputFilter {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        self.stretch
    }

    fn next_change(&self) -> Option<f64> {
        match &self.filter {
            Filter::Stand { stood, .. } => stood.map(|(_, due)| due),
            Filter::Steps(steps) => steps.next(),
            Filter::Low { .. } => None,
        }
    }

    fn count_finely(&mut self) {
        if let Filter::Low { is_whole, .. } = &mut self.filter {
            *is_whole = false;
        }
    }

    fn signal(&mut self, value: f64, moment: Moment) -> f64 {
        if self.time_constant == 0.0 {
            return value;
        }
        let span = moment.now - std::mem::replace(&mut self.last, moment.now);
        match &mut self.filter {
            Filter::Low { input, output, is_whole } => {
                // It has moved on a straight line since.
                let course = Course::straight(input.replace(value).unwrap_or(value), value);
                let filtered = *output.insert(follow(output.unwrap_or(value), course, span, self.time_constant));
                if *is_whole { (filtered + SAME_COUNT).floor() } else { filtered }
            }
            Filter::Steps(steps) => steps.pass(value, moment.now, span, self.time_constant),
            Filter::Stand { mail, stood } => {
                if mail.is_new(value) {
                    // What did not stand long enough never was.
                    *stood = Some((value, moment.now + self.time_constant));
                }
                if let Some((value, due)) = *stood
                    && due <= moment.now + SAME_INSTANT_S
                {
                    mail.send(value, due);
                    *stood = None;
                }
                mail.arrived(moment.now)
            }
        }
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.last);
        match &self.filter {
            Filter::Low { input, output, .. } => input.iter().chain(output).for_each(|number| visit(*number)),
            Filter::Steps(Steps { shows: _, input, output, exit, since, until }) => {
                input.iter().chain([output, exit, since, until]).for_each(|number| visit(*number));
            }
            Filter::Stand { mail, stood } => {
                mail.state(visit);
                stood.iter().flat_map(|(value, due)| [*value, *due]).for_each(&mut *visit);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn a_number_comes_by_and_by() {
        // v_target = 0.5·(1 − e^(−t/T)); the last step of the staircase is half a step behind.
        let filter = spec("command-link", "input-filter", Some("velocityTarget"), &[("time_constant", 0.5)]);
        let mut belt = with("StraightConveyor", &[("acceleration", "100")], &[filter]);
        belt.check(&[("motorDirection", 1.0)], 0.1, &[]);
        belt.check(&[("velocityTarget", 0.5)], 1.0, &[]);
        let exact = 0.5 * (1.0 - (-1.999_f64).exp());
        assert!((belt.report("velocityActual") - exact).abs() < 1e-6, "{}", belt.report("velocityActual"));
    }

    /// A motor that follows at once has gone v·(t − T·(1 − e^(−t/T))), however short the filter, and whenever the command comes.
    #[test]
    fn a_number_is_filtered_from_the_instant_of_its_command() {
        for (time, before) in [(2e-3, 0.1004), (1e-4, 0.10093), (0.05, 0.1007)] {
            let filter = spec("command-link", "input-filter", Some("speedTarget"), &[("time_constant", time)]);
            let set = [("acceleration", "1e9"), ("countsPerRevolution", "1000000")];
            let mut motor = with("EncoderMotor", &set, &[filter]);
            motor.check(&[("speedTarget", 0.0), ("enable", 1.0)], before, &[]);
            motor.check(&[("speedTarget", 10.0)], 0.02, &[]);
            let angle = motor.report("encoder") / 1e6 * std::f64::consts::TAU;
            let exact = 10.0 * (0.02 - time * (1.0 - (-0.02 / time).exp()));
            assert!((angle - exact).abs() < 1.5e-5, "{angle}, not {exact}");
        }
    }

    /// The force of a servo axis whose target passes a filter is that of one whose target goes as the filter's exit does, whenever it is looked at.
    #[test]
    fn a_filtered_target_pulls_as_smoothly_as_the_filter_lets_it() {
        const LOOK_S: f64 = 0.0203;
        const FINE_S: f64 = 5e-5;
        let (time, target) = (0.15, 0.3);
        let filter = spec("command-link", "input-filter", Some("positionTarget"), &[("time_constant", time)]);
        let mut filtered = with("ServoAxis", &[], &[filter]);
        let mut told = with("ServoAxis", &[], &[]);
        filtered.check(&[("positionTarget", 0.0)], 0.1, &[]);
        told.check(&[("positionTarget", 0.0)], 0.1, &[]);
        let exit = |at: f64| target * (1.0 - (-at / time).exp());
        for look in 0..20 {
            filtered.check(&[("positionTarget", target)], LOOK_S, &[]);
            let steps = (LOOK_S / FINE_S).round() as usize;
            for step in 0..steps {
                let at = f64::from(look) * LOOK_S + (step as f64 + 0.5) * FINE_S;
                told.check(&[("positionTarget", exit(at))], FINE_S, &[]);
            }
            let (found, exact) = (filtered.report("force"), told.report("force"));
            let pull = 0.5 * FINE_S * target / time;
            assert!((found - exact).abs() < 0.1 + 20_000.0 * pull, "{look}: {found}, not {exact}");
        }
    }

    /// A count is a number, too: at 10 rad/s it is behind by what passes in the time, and a filter of next to no time stops nothing.
    #[test]
    fn a_count_is_behind_by_whole_counts() {
        let counts = |angle: f64| (angle * 4096.0 / std::f64::consts::TAU).floor();
        for (time, behind) in [(0.1, 1.0), (1e-9, 0.0)] {
            let filter = spec("report-link", "input-filter", Some("encoder"), &[("time_constant", time)]);
            let mut motor = with("EncoderMotor", &[], &[filter]);
            // 2.5 rad in the ramp's half second, 20 rad after it.
            motor.check(&[("speedTarget", 10.0), ("enable", 1.0)], 2.5, &[]);
            let (count, whole) = (motor.report("encoder"), counts(22.5 - behind));
            assert!(count.fract() == 0.0 && (count - whole).abs() <= 1.0, "{count} for {whole}");
        }
    }

    #[test]
    fn a_pulse_too_short_never_was() {
        let filter = spec("command-link", "input-filter", Some("motorDirection"), &[("time_constant", 0.02)]);
        let mut belt = with("StraightConveyor", &[], &[filter]);
        belt.check(&[("motorDirection", 1.0)], 0.019, &[("driveEnabled", 0.0)]);
        belt.check(&[("motorDirection", 0.0)], 0.1, &[("driveEnabled", 0.0)]);
        belt.check(&[("motorDirection", 1.0)], 0.02, &[("driveEnabled", 1.0)]);
    }
}
