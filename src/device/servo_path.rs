//! A servo axis with what stands in its signal path: friction as a set-valued law, loads, limits, and a transmission.
//!
//! Over a stretch the sliding friction is a constant force against the motion, so that the loop's own law stays exact; where
//! the motion comes to rest the stretch is cut. A friction that changes with speed, place or effort is that of the stretch's middle,
//! and where it changes much the stretch is shorter (the explicit midpoint rule, of second order; E. Hairer, S. P. Nørsett, G. Wanner,
//! Solving Ordinary Differential Equations I, Springer 1993, section II.1).
//!
//! At rest the axis stays as long as what drives it is within the sticking friction: friction there is a set of forces, not a function
//! (the Coulomb law as a differential inclusion; V. Acary, B. Brogliato, Numerical Methods for Nonsmooth Dynamical Systems, Springer
//! 2008, section 1.3).

use super::law::servo::{Loop, Mechanics, Servo};
use super::law::transition::Transitions;
use super::path::{Bounds, Burden, Effort, Friction, Moment, Motion, Stages};

/// How often the place where the motion comes to rest is halved: a millionth of a stretch.
const HALVINGS: u32 = 20;
/// The stretch within which a force that passes stages of its own is held constant, s.
const EFFORT_STRETCH_S: f64 = 1e-4;
/// By which share of all that its friction may change it may do so in half a stretch.
const UNEVEN: f64 = 0.1;
/// A stretch is not made shorter than this because of that, s.
const SHORTEST_S: f64 = 6e-5;

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

/// An axis with stages: what is bounded about its drive, and what of the drive's force reached the axis last.
#[derive(Clone, Copy, Debug)]
pub(super) struct Exertion {
    pub bounds: Bounds,
    /// N or N·m.
    pub passed: f64,
}

/// An axis on its way: what moves, and what stands in its path.
pub(super) struct Way<'a> {
    pub servo: &'a mut Servo,
    pub nominal: &'a Nominal,
    pub exertion: &'a mut Exertion,
    pub stages: &'a mut Stages,
    pub transitions: &'a mut Transitions,
}

impl Way<'_> {
    /// Moves the axis by the stretch that ends at `moment`.
    pub fn advance(&mut self, moment: Moment) {
        let mut rest = moment.span;
        while rest > 0.0 {
            let span = if self.stages.shapes_effort() { rest.min(EFFORT_STRETCH_S) } else { rest };
            rest -= span;
            let taken = self.stretch(Moment { now: moment.now - rest, span });
            rest += span - taken;
        }
    }

    /// Moves the axis together with the spring that hangs on it by the whole stretch that ends at `moment`. Returns false where a limit is
    /// met on the way, where friction holds it or changes, and where what reaches the axis is not what the drive exerts: where both are
    /// then is nowhere, and they are to be put back.
    pub fn leap(&mut self, moment: Moment) -> bool {
        let Way { servo, nominal, exertion, stages, .. } = self;
        if stages.shapes_effort() || exertion.bounds.acceleration.is_finite() {
            return false;
        }
        let motion = Motion { position: servo.position(), velocity: servo.velocity() };
        let Mechanics { inertia, viscous_friction, load, pendulum } = nominal.mechanics;
        let burden = stages.load.burden(Burden { inertia, force: load }, motion, moment);
        let Some(spring) = stages.transmission.spring() else { return false };
        let bare = Mechanics { inertia: burden.inertia - spring.mass, viscous_friction, load: burden.force, pendulum };
        let pulled = Mechanics { load: bare.load - spring.pull(), ..bare };
        servo.burden(pulled);
        servo.limit(exertion.bounds.force);
        let effort = effort_of(servo, servo.force(), 1.0);
        let base = Friction { sliding: 0.0, sticking: 0.0, viscous: viscous_friction };
        let friction = stages.mechanics.friction(base, motion, effort);
        let is_even = stages.mechanics.uneven(effort) == 0.0 && stages.actuator.strength(servo.force()) == 1.0;
        let may_stick = friction.sliding.max(friction.sticking) > 0.0;
        let way = motion.velocity.signum();
        if !is_even || may_stick && motion.velocity == 0.0 {
            return false;
        }
        let load = bare.load + if may_stick { way * friction.sliding } else { 0.0 };
        servo.burden(Mechanics { viscous_friction: friction.viscous, load, ..bare });
        let moves = stages.transmission.spring().is_some_and(|spring| servo.leap_with(spring, moment.span));
        servo.burden(pulled);
        moves && (!may_stick || servo.velocity() * way > 0.0)
    }

    /// Moves by at most `moment.span`, no further than to where the motion comes to rest; returns how long that took.
    ///
    /// A drive of which only a share s reaches the axis moves it as a whole drive would move 1/s of everything that resists:
    /// s·F = M·dv/dt + R is F = (M/s)·dv/dt + R/s. So the loop's own law stays exact.
    fn stretch(&mut self, moment: Moment) -> f64 {
        let Way { servo, nominal, exertion, stages, transitions } = self;
        let motion = Motion { position: servo.position(), velocity: servo.velocity() };
        let Mechanics { inertia, viscous_friction, load, pendulum } = nominal.mechanics;
        let burden = stages.load.burden(Burden { inertia, force: load }, motion, moment);
        let burden = stages.transmission.burden(burden, motion, moment);
        let bare = Mechanics { inertia: burden.inertia, viscous_friction, load: burden.force, pendulum };
        servo.burden(bare);
        let share = stages.actuator.strength(servo.force());
        bound(servo, exertion.bounds, share, moment.span);
        let effort = servo.force();
        let passed = if stages.shapes_effort() {
            let acceleration = (share * exertion.passed - servo.resistance()) / burden.inertia;
            // What was commanded since then jumped.
            stages.actuator.effort(effort, Moment { now: moment.now - moment.span, span: 0.0 });
            let ahead = servo.force_after(moment.span, if motion.velocity == 0.0 { 0.0 } else { acceleration });
            stages.actuator.effort(ahead, moment)
        } else {
            effort
        };
        exertion.passed = passed;
        let base = Friction { sliding: 0.0, sticking: 0.0, viscous: viscous_friction };
        let at_first = effort_of(servo, passed, share);
        let mut friction = stages.mechanics.friction(base, motion, at_first);
        if motion.velocity == 0.0 && at_first.net.abs() <= friction.sticking {
            servo.wait(moment.span);
            return moment.span;
        }
        let way = if motion.velocity == 0.0 { at_first.net.signum() } else { motion.velocity.signum() };
        let is_open = stages.shapes_effort();
        let start = **servo;
        let moved_against = |friction: Friction| {
            let mut mover = start;
            mover.burden(Mechanics {
                inertia: bare.inertia / share,
                viscous_friction: friction.viscous / share,
                load: (bare.load + way * friction.sliding) / share,
                pendulum: pendulum / share,
            });
            if is_open {
                mover.open(passed);
            }
            mover
        };
        let mut span = moment.span;
        let uneven = stages.mechanics.uneven(at_first);
        if uneven > 0.0 {
            (friction, span) = loop {
                let mut halfway = moved_against(friction);
                halfway.advance_again(0.5 * span, transitions);
                // Where it comes to rest on the way, what rubs at first is nearer to what brakes it than what rubs beyond.
                if halfway.velocity() * way <= 0.0 {
                    break (friction, span);
                }
                let motion = Motion { position: halfway.position(), velocity: halfway.velocity() };
                let passed = if is_open { passed } else { halfway.force() };
                halfway.burden(bare);
                let there = stages.mechanics.friction(base, motion, effort_of(&halfway, passed, share));
                let is_even = (there.sliding - friction.sliding).abs() <= UNEVEN * uneven;
                // A force that passed stages of its own was asked for as it is at the end of the whole stretch, which is short already.
                if is_even || is_open || span < 2.0 * SHORTEST_S {
                    break (there, span);
                }
                span *= 0.5;
            };
        }
        let mut mover = moved_against(friction);
        if is_open {
            servo.wait(span);
        }
        let may_stick = friction.sliding.max(friction.sticking) > 0.0;
        let taken = until_rest(&mut mover, transitions, way, may_stick, span);
        if is_open {
            servo.follow(&mover);
        } else {
            **servo = mover;
            servo.burden(bare);
        }
        taken
    }
}

/// What goes through the gears of an axis that bears its bare burden, its drive exerting `passed`, of which `share` reaches it.
fn effort_of(servo: &Servo, passed: f64, share: f64) -> Effort {
    // What the motor's own voltage takes never reaches the gears.
    let lost = servo.back_emf() * servo.velocity();
    let opposing = servo.resistance() - servo.moved().viscous_friction * servo.velocity() - lost;
    Effort {
        // What is left of the drive's force against the load.
        net: share * (passed - lost) - opposing,
        transmitted: (share * (passed - lost)).abs() + opposing.abs(),
    }
}

/// Limits the drive's force, also so that it accelerates the axis no more than it may: F ≤ M·a + R in the way it drives,
/// with R as it will be in the middle of the stretch.
fn bound(servo: &mut Servo, bounds: Bounds, share: f64, span: f64) {
    servo.limit(bounds.force);
    if bounds.acceleration.is_finite() {
        let Mechanics { inertia, viscous_friction, .. } = servo.moved();
        let viscous_friction = viscous_friction + servo.back_emf();
        let gained = 0.5 * bounds.acceleration * span;
        let resisting = servo.resistance() * servo.force().signum() + viscous_friction * gained;
        let most = (inertia * bounds.acceleration + resisting) / share;
        servo.limit(bounds.force.min(most.max(0.0)));
    }
}

/// Moves by `span`, or to the instant at which the motion along `way` comes to rest, if friction may hold it there.
fn until_rest(servo: &mut Servo, transitions: &mut Transitions, way: f64, may_stick: bool, span: f64) -> f64 {
    let start = *servo;
    servo.advance_again(span, transitions);
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
