//! `first-order-lag`: what the drive does follows what it should do as a first-order lag:
//! time_constant · dy/dt + y = x, applied to position and velocity alike; on a servo axis with forces, to its force. An ideal
//! axis closes on its target by a position loop, which is that lag as long as the drive's limits allow it
//! ([`Closing`](crate::device::law::closing::Closing)). A cylinder's speed lags, and its end stops are where they are: the lag ends
//! there ([`Lagging`](crate::device::law::lagging::Lagging)).
//!
//! Source: the first-order lag of linear control theory (K. J. Åström, T. Hägglund, Advanced PID Control, ISA 2006,
//! section 2.4). Over a stretch the position is taken to be a parabola, velocity and force a straight line; for these the
//! solution is exact.

use super::table::{BASE, time};
use crate::device::path::{Moment, Motion, Stage};
use crate::effect::{Build, EffectDescriptor};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "first-order-lag",
    summary: "the drive follows its law with a first-order lag",
    equation: "time_constant·dy/dt + y = x",
    source: "Åström, Hägglund, Advanced PID Control, ISA 2006, 2.4",
    places: &[EffectPlace::Actuator],
    parameters: &[time("time_constant", 0.05, "time after which 63 % of a step have been followed")],
    excited_by: "changes of speed",
    build: Build::Stage(|values, site| match site.is_ideal() || site.is_stroke() {
        true => Box::new(OfLaw { time_constant: values[0] }),
        false => Box::new(FirstOrderLag { time_constant: values[0], last: None, force: (0.0, 0.0) }),
    }),
    ..BASE
};

/// The lag of a law that knows of it: that of an ideal axis, or of a cylinder.
#[derive(Clone, Debug)]
struct OfLaw {
    time_constant: f64,
}

impl Stage for OfLaw {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn lag(&self) -> f64 {
        self.time_constant
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

/// The lag of any other drive, and where it is.
#[derive(Clone, Debug)]
struct FirstOrderLag {
    time_constant: f64,
    /// The input at the end of the last stretch, and the output.
    last: Option<(Motion, Motion)>,
    /// The same of a force.
    force: (f64, f64),
}

/// How the input of a lag goes over a stretch: from a value to another, with this slope at the end and this second
/// derivative all along.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    pub from: f64,
    pub to: f64,
    pub bend: f64,
}

impl Course {
    /// The course of a position: a parabola, if that is what its velocities say; else a straight line.
    pub fn of(from: Motion, to: Motion, span: f64) -> Course {
        let way = to.position - from.position;
        let even = 0.5 * (from.velocity + to.velocity) * span;
        let is_parabola = (way - even).abs() <= 1e-9 + 1e-3 * (way.abs() + even.abs());
        let bend = if is_parabola { (to.velocity - from.velocity) / span } else { 0.0 };
        Course { from: from.position, to: to.position, bend }
    }

    /// A straight line.
    pub fn straight(from: f64, to: f64) -> Course {
        Course { from, to, bend: 0.0 }
    }

    /// Its slope at the start.
    pub fn slope(&self, span: f64) -> f64 {
        (self.to - self.from) / span - 0.5 * self.bend * span
    }
}

/// The lag's answer after `span`, the output being `output` at first. For x with constant second derivative the particular
/// solution is x − T·x' + T²·x''; the rest decays.
pub(super) fn follow(output: f64, course: Course, span: f64, time_constant: f64) -> f64 {
    if time_constant <= 0.0 {
        return course.to;
    }
    if span <= 0.0 {
        return output;
    }
    let slope = course.slope(span);
    let particular = |x: f64, slope: f64| x - time_constant * slope + time_constant * time_constant * course.bend;
    let rest = output - particular(course.from, slope);
    particular(course.to, slope + course.bend * span) + rest * (-span / time_constant).exp()
}

impl Stage for FirstOrderLag {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn motion(&mut self, motion: Motion, moment: Moment) -> Motion {
        let (input, output) = self.last.unwrap_or_default();
        let lag = |output, course| follow(output, course, moment.span, self.time_constant);
        let next = Motion {
            position: lag(output.position, Course::of(input, motion, moment.span.max(1e-12))),
            velocity: lag(output.velocity, Course::straight(input.velocity, motion.velocity)),
        };
        self.last = Some((motion, next));
        next
    }

    fn effort(&mut self, effort: f64, moment: Moment) -> f64 {
        let (input, output) = self.force;
        if moment.span <= 0.0 {
            self.force = (effort, output);
            return output;
        }
        let next = follow(output, Course::straight(input, effort), moment.span, self.time_constant);
        self.force = (effort, next);
        // T·dy/dt + y = x, integrated over the stretch.
        0.5 * (input + effort) - self.time_constant * (next - output) / moment.span
    }

    fn shapes_effort(&self) -> bool {
        self.time_constant > 0.0
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        if let Some((input, output)) = self.last {
            for number in [input.position, input.velocity, output.position, output.velocity] {
                visit(number);
            }
        }
        visit(self.force.0);
        visit(self.force.1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effect::bench::{spec, with};

    fn lag(time_constant: f64) -> FirstOrderLag {
        FirstOrderLag { time_constant, last: None, force: (0.0, 0.0) }
    }

    #[test]
    fn a_ramp_and_a_parabola_are_followed_as_the_closed_forms_say() {
        // x = t: y = t − T·(1 − e^(−t/T)); x = t²: y = t² − 2T·t + 2T²·(1 − e^(−t/T)).
        let (mut ramp, mut parabola) = (lag(0.05), lag(0.05));
        ramp.motion(Motion { position: 0.0, velocity: 1.0 }, Moment::default());
        for step in 1..=100 {
            let now = f64::from(step) * 1e-2;
            let rest = 1.0 - (-now / 0.05_f64).exp();
            let moment = Moment { now, span: 1e-2 };
            let output = ramp.motion(Motion { position: now, velocity: 1.0 }, moment);
            assert!((output.position - (now - 0.05 * rest)).abs() < 1e-12, "at {now}");
            let output = parabola.motion(Motion { position: now * now, velocity: 2.0 * now }, moment);
            assert!((output.position - (now * now - 0.1 * now + 0.005 * rest)).abs() < 1e-12, "at {now}");
            assert!((output.velocity - (2.0 * now - 0.1 * rest)).abs() < 1e-12, "at {now}");
        }
    }

    #[test]
    fn an_ideal_axis_lags_within_its_limits() {
        let ideal = [("mode", "ideal")];
        let lag = spec("actuator", "first-order-lag", None, &[("time_constant", 0.1)]);
        let mut axis = with("ServoAxis", &ideal, std::slice::from_ref(&lag));
        axis.check(&[("positionTarget", 1.0)], 0.1, &[("position", 1.0 - (-1.0_f64).exp())]);
        // 0.8 m at 2 m/s, then what is left decays; a filter of what the limit leaves would be at 0.86 m.
        let limit = spec("actuator", "velocity-limit", None, &[("limit", 2.0)]);
        let mut axis = with("ServoAxis", &ideal, &[lag, limit]);
        axis.check(&[("positionTarget", 1.0)], 0.5, &[("position", 1.0 - 0.2 * (-1.0_f64).exp())]);
    }

    #[test]
    fn a_lagging_force_moves_a_free_mass_as_the_closed_form_says() {
        // F = 100 N through T on 20 kg: v = F/M·(t − T·(1 − e^(−t/T))).
        let lag = spec("actuator", "first-order-lag", None, &[("time_constant", 0.05)]);
        let mut axis = with("ServoAxis", &[("mode", "force"), ("Fv", "0")], &[lag]);
        axis.check(&[("forceTarget", 100.0)], 0.2, &[("force", 100.0)]);
        let exact = 5.0 * (0.2 - 0.05 * (1.0 - (-4.0_f64).exp()));
        assert!((axis.report("velocity") - exact).abs() < 3e-4, "{}", axis.report("velocity"));
    }

    /// 0.498 m at 0.5 m/s, of which the lag takes 0.05 s: at the switch the speed is all but whole, and the end stop is hard.
    #[test]
    fn a_cylinders_speed_lags_and_its_end_stop_is_where_it_is() {
        let set = [("stroke", "0.5"), ("extendSpeed", "0.5"), ("retractSpeed", "0.5"), ("limitTolerance", "0.002")];
        let mut pusher = with("Pusher", &set, &[spec("actuator", "first-order-lag", None, &[("time_constant", 0.05)])]);
        pusher.check(&[("command", 1.0)], 1.0459, &[("limitExtended", 0.0), ("isRunning", 1.0)]);
        pusher.check(&[], 2e-4, &[("limitExtended", 1.0), ("isRunning", 1.0)]);
        // 2 mm further it stands, and turns round at once.
        pusher.check(&[], 0.0041, &[("limitExtended", 1.0), ("isRunning", 0.0)]);
        // 2 mm from rest: 0.5·(t − T·(1 − e^(−t/T))) = 0.002 after 21.43 ms.
        pusher.check(&[("command", 2.0)], 0.0213, &[("limitExtended", 1.0)]);
        pusher.check(&[], 3e-4, &[("limitExtended", 0.0)]);
        // Held on its way it comes to rest there, and stays.
        pusher.check(&[], 0.3, &[("isRunning", 1.0)]);
        pusher.check(&[("command", 0.0)], 2.0, &[("isRunning", 0.0), ("limitRetracted", 0.0), ("limitExtended", 0.0)]);
        pusher.check(&[("command", 1.0)], 0.001, &[("limitRetracted", 0.0), ("limitExtended", 0.0)]);
    }
}
