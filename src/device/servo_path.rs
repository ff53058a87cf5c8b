//! A servo axis with what stands in its signal path: friction as a set-valued law, loads, limits, and a transmission.
//!
//! Over a stretch the sliding friction is a constant force against the motion, so that the loop's own law stays exact; where
//! the motion comes to rest the stretch is cut. At rest the axis stays as long as what drives it is within the sticking
//! friction: friction there is a set of forces, not a function (the Coulomb law as a differential inclusion; V. Acary,
//! B. Brogliato, Numerical Methods for Nonsmooth Dynamical Systems, Springer 2008, section 1.3).

use super::law::servo::{Loop, Mechanics, Servo};
use super::path::{Bounds, Burden, Friction, Moment, Motion, Stages};

/// How often the place where the motion comes to rest is halved: a millionth of a stretch.
const HALVINGS: u32 = 20;
/// The stretch within which a force that passes stages of its own is held constant, s.
const EFFORT_STRETCH_S: f64 = 1e-4;

/// What the axis is without stages.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nominal {
    pub drive: Loop,
    pub mechanics: Mechanics,
}

/// What the drive may do now, as its stages have it.
pub(super) fn bounds(stages: &mut Stages, nominal: &Nominal, motion: Motion, moment: Moment) -> Bounds {
    let bounds = Bounds {
        velocity: f64::INFINITY,
        acceleration: f64::INFINITY,
        deceleration: f64::INFINITY,
        force: nominal.drive.limit,
    };
    stages.actuator.bounds(bounds, motion, moment)
}

/// Moves `servo` by the stretch that ends at `moment`.
pub(super) fn advance(servo: &mut Servo, nominal: &Nominal, stages: &mut Stages, moment: Moment) {
    let mut rest = moment.span;
    while rest > 0.0 {
        let span = if stages.actuator.shapes_effort() { rest.min(EFFORT_STRETCH_S) } else { rest };
        rest -= span;
        let part = Moment { now: moment.now - rest, span };
        let taken = stretch(servo, nominal, stages, part);
        rest += span - taken;
    }
}

/// Moves by at most `moment.span`, no further than to where the motion comes to rest; returns how long that took.
fn stretch(servo: &mut Servo, nominal: &Nominal, stages: &mut Stages, moment: Moment) -> f64 {
    let motion = Motion { position: servo.position(), velocity: servo.velocity() };
    let Mechanics { inertia, viscous_friction, load, pendulum } = nominal.mechanics;
    let burden = stages.load.burden(Burden { inertia, force: load }, motion, moment);
    let bare = Mechanics { inertia: burden.inertia, viscous_friction, load: burden.force, pendulum };
    servo.burden(bare);
    let effort = servo.force();
    let passed = stages.actuator.effort(effort, moment);
    // What the drive would exert if nothing stood in its way, and what is left of it.
    let driving = servo.driving() - effort + passed;
    let base = Friction { sliding: 0.0, sticking: 0.0, viscous: viscous_friction };
    let friction = stages.mechanics.friction(base, motion, driving);
    if motion.velocity == 0.0 && driving.abs() <= friction.sticking {
        servo.wait(moment.span);
        return moment.span;
    }
    let way = if motion.velocity == 0.0 { driving.signum() } else { motion.velocity.signum() };
    let rubbed = Mechanics { viscous_friction: friction.viscous, load: bare.load + way * friction.sliding, ..bare };
    let mut mover = *servo;
    mover.burden(rubbed);
    if stages.actuator.shapes_effort() {
        mover.open(passed);
        servo.wait(moment.span);
    }
    let taken = until_rest(&mut mover, way, friction.sliding.max(friction.sticking) > 0.0, moment.span);
    if stages.actuator.shapes_effort() {
        servo.follow(&mover);
    } else {
        *servo = mover;
        servo.burden(bare);
    }
    taken
}

/// Moves by `span`, or to the instant at which the motion along `way` comes to rest, if friction may hold it there.
fn until_rest(servo: &mut Servo, way: f64, may_stick: bool, span: f64) -> f64 {
    let start = *servo;
    servo.advance(span);
    if !may_stick || servo.velocity() * way >= 0.0 {
        return span;
    }
    let (mut moving, mut turned) = (0.0, span);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (moving + turned);
        *servo = start;
        servo.advance(middle);
        if servo.velocity() * way > 0.0 { moving = middle } else { turned = middle }
    }
    *servo = start;
    servo.advance(turned);
    servo.hold();
    turned
}
