//! `breakaway-friction`: at rest the axis holds against up to `force` more than what rubs while it moves.
//!
//! Source: static friction (A. Morin 1833; Armstrong-Hélouvry and others, Automatica 30, 1994, section 2.1).

use super::table::{BASE, EFFORT, SERVO, parameter};
use crate::device::path::{Effort, Friction, Motion, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, Needs};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "breakaway-friction",
    summary: "what holds the axis at rest beyond what rubs in motion",
    equation: "v = 0: |F_r| ≤ F_c + force",
    source: "Armstrong-Hélouvry, Dupont, Canudas de Wit, Automatica 30 (1994), 2.1",
    places: &[EffectPlace::Mechanics],
    fits: &[Fit::Drives(SERVO)],
    needs: Needs::Dynamics,
    parameters: &[parameter("force", EFFORT, (0.0, 1e6), 0.0, 10.0, "how much more at rest")],
    excited_by: "starts from rest, slow motion",
    build: Build::Stage(|values, _| Box::new(BreakawayFriction { force: values[0] })),
    ..BASE
};

#[derive(Clone, Debug)]
struct BreakawayFriction {
    force: f64,
}

impl Stage for BreakawayFriction {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        5e-3
    }

    fn friction(&mut self, friction: Friction, _motion: Motion, _effort: Effort) -> Friction {
        Friction { sticking: friction.sticking + self.force, ..friction }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn it_holds_until_it_breaks_away_and_is_gone_then() {
        let friction = spec("mechanics", "breakaway-friction", None, &[("force", 20.0)]);
        let mut axis = with("ServoAxis", &[("mode", "force")], &[friction]);
        axis.check(&[("forceTarget", 19.9)], 1.0, &[("position", 0.0)]);
        let velocity = 20.1 / 50.0 * (1.0 - (-2.5_f64).exp());
        axis.check(&[("forceTarget", 20.1)], 1.0, &[("velocity", velocity)]);
    }
}
