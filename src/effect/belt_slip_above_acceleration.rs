//! `belt-slip-above-acceleration`: the drum slips under its belt while it changes its speed more steeply than `acceleration`,
//! which is what friction gives the belt; the belt catches up when it can. The drive itself does not see it.
//!
//! Source: Euler's limit of the force that a drum transmits, F ≤ F0·(e^(μα) − 1) (G. Niemann, H. Winter, Maschinenelemente 3,
//! Springer 1986, section 27), over the mass that the belt moves.

use super::table::{ACCELERATION, BASE, UNLIMITED, parameter};
use crate::device::law::follower::Follower;
use crate::device::path::{Moment, Motion, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, Needs};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "belt-slip-above-acceleration",
    summary: "the drum slips under its belt while it changes its speed too steeply",
    equation: "|dw/dt| ≤ acceleration; w follows v, and does not leave it while |dv/dt| ≤ acceleration",
    source: "Niemann, Winter, Maschinenelemente 3, Springer 1986, 27 (Euler)",
    places: &[EffectPlace::Transmission],
    fits: &[Fit::Drives(&["StraightConveyor", "ConveyorCurve", "CartesianRobot", "ServoAxis", "EncoderMotor"])],
    needs: Needs::Dynamics,
    parameters: &[parameter(
        "acceleration",
        ACCELERATION,
        (1e-3, UNLIMITED),
        UNLIMITED,
        0.5,
        "steepest change of speed that the belt follows",
    )],
    excited_by: "starts and stops steeper than the limit; passages between two light barriers",
    build: Build::Stage(|values, _| Box::new(Slip { limit: values[0], belt: Follower::new(values[0]), last: None })),
    ..BASE
};

#[derive(Clone, Debug)]
struct Slip {
    limit: f64,
    belt: Follower,
    /// The drum's motion at the end of the last stretch, and where the belt stood.
    last: Option<(Motion, f64)>,
}

impl Stage for Slip {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn motion(&mut self, motion: Motion, moment: Moment) -> Motion {
        if self.limit >= UNLIMITED {
            return motion;
        }
        let (before, position) = self.last.unwrap_or_default();
        let way = motion.position - before.position;
        let position = position + self.belt.follow(way, before.velocity, motion.velocity, moment.span);
        self.last = Some((motion, position));
        Motion { position, velocity: self.belt.velocity() }
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        self.belt.state(visit);
        if let Some((motion, position)) = self.last {
            [motion.position, motion.velocity, position].into_iter().for_each(visit);
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn the_belt_loses_what_the_drum_gains_too_fast() {
        // The drum: 0.5 m/s after 0.5 s; the belt after 1 s, and it has lost 1/2·0.5·(1 − 0.5) m.
        let slip = spec("transmission", "belt-slip-above-acceleration", None, &[("acceleration", 0.5)]);
        let mut belt = with("StraightConveyor", &[], std::slice::from_ref(&slip));
        belt.check(&[("velocityTarget", 0.5), ("motorDirection", 1.0)], 2.0, &[("velocityActual", 0.5)]);
        assert!((belt.displacement() - (0.875 - 0.125)).abs() < 1e-12, "{}", belt.displacement());
        let mut gentle = with("StraightConveyor", &[("acceleration", "0.5")], &[slip]);
        gentle.check(&[("velocityTarget", 0.5), ("motorDirection", 1.0)], 2.0, &[("velocityActual", 0.5)]);
        assert!((gentle.displacement() - 0.75).abs() < 1e-12, "{}", gentle.displacement());
    }
}
