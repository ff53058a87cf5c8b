//! `backlash`: the load follows only after the gap between the flanks is crossed: |load − motor| ≤ gap/2, and the load
//! stays where it is while nothing drags it. It stands in the middle of the gap to begin with.
//!
//! On a cylinder, which turns round in no stretch, it bears any.
//!
//! Source: the play operator (M. Nordin, P.-O. Gutman, Controlling mechanical systems with backlash: a survey, Automatica
//! 38, 2002, section 2.1, the friction-driven hysteresis model).

use super::play::Play;
use super::table::{BASE, TRAVEL, parameter};
use crate::device::law::is_there;
use crate::device::path::{Moment, Motion, STRETCH_S, Stage};
use crate::effect::{Build, EffectDescriptor};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "backlash",
    summary: "the load follows only after a gap is crossed",
    equation: "|y − x| ≤ gap/2; y stays while nothing drags it",
    source: "Nordin, Gutman, Automatica 38 (2002), 2.1",
    places: &[EffectPlace::Transmission],
    parameters: &[parameter("gap", TRAVEL, (0.0, 1e3), 0.0, 0.01, "the whole gap, from flank to flank")],
    excited_by: "reversals",
    build: Build::Stage(|values, site| {
        let stretch = if site.is_stroke() { f64::INFINITY } else { STRETCH_S };
        Box::new(Backlash { play: Play::new(values[0]), gap: values[0], met: None, stretch })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct Backlash {
    gap: f64,
    play: Play,
    /// When the flanks meet if the motor goes on at its speed.
    met: Option<f64>,
    /// The longest stretch that it bears, s.
    stretch: f64,
}

impl Stage for Backlash {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        self.stretch
    }

    fn is_even(&self) -> bool {
        true
    }

    fn next_change(&self) -> Option<f64> {
        self.met
    }

    fn motion(&mut self, motion: Motion, moment: Moment) -> Motion {
        if self.gap == 0.0 {
            return motion;
        }
        let position = self.play.pass(motion.position);
        let left = 0.5 * self.gap - (motion.position - position) * motion.velocity.signum();
        let is_dragged = is_there(left, motion.velocity);
        self.met = (!is_dragged && motion.velocity != 0.0).then(|| moment.now + left / motion.velocity.abs());
        Motion { position, velocity: if is_dragged { motion.velocity } else { 0.0 } }
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        self.play.state(visit);
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn the_load_lags_by_half_the_gap_either_way() {
        let gap = spec("transmission", "backlash", Some("X"), &[("gap", 0.02)]);
        let mut robot = with("CartesianRobot", &[], &[gap]);
        for (target, position) in [(0.5, 0.49), (0.485, 0.49), (0.2, 0.21), (0.215, 0.21), (0.3, 0.29)] {
            robot.check(&[("XTarget", target)], 2.0, &[("actualPosX", position), ("cartesianArrived", 1.0)]);
        }
    }

    #[test]
    fn a_rod_stands_from_when_its_piston_turns_round_until_the_gap_is_crossed() {
        let gap = spec("transmission", "backlash", None, &[("gap", 0.02)]);
        let mut pusher = with("Pusher", &[], &[gap]);
        // The first half of the gap at 0.5 m/s; all of it on the way back.
        pusher.check(&[("command", 1.0)], 0.0199, &[("isRunning", 0.0)]);
        pusher.check(&[], 0.4, &[("isRunning", 1.0)]);
        pusher.check(&[("command", 2.0)], 0.0, &[("isRunning", 0.0)]);
        pusher.check(&[], 0.0399, &[("isRunning", 0.0)]);
        pusher.check(&[], 0.0002, &[("isRunning", 1.0)]);
    }

    #[test]
    fn on_a_servo_axis_the_loop_sees_the_motor() {
        let gap = spec("transmission", "backlash", None, &[("gap", 0.002)]);
        let mut axis = with("ServoAxis", &[("forceLimit", "1000000")], &[gap]);
        axis.check(&[("positionTarget", 0.1)], 5.0, &[("force", 0.0), ("velocity", 0.0)]);
        // x'' + 42.5·x' + 1000·x = 1000·0.1: the motor passes its target by e^(−π·σ/ω) of the way, and comes back to short of
        // it by the square of that; from there it leaves the load standing, half the gap ahead.
        let (decay, turn) = (21.25_f64, (1000.0 - 21.25_f64 * 21.25).sqrt());
        let back = 0.1 * (1.0 - (-2.0 * std::f64::consts::PI * decay / turn).exp());
        let load = axis.report("position");
        assert!((load - (back + 0.001)).abs() < 1e-6, "{load} {back}");
    }
}
