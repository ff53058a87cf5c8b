//! The rig's program: a demonstration that moves every device of `models/rig` in every way it can move, for ever.
//!
//! The devices do not touch each other, so each has a sequence of its own.

use std::f64::consts::FRAC_PI_2;
use std::time::Duration;

use crate::automation::block::{
    CartesianRobotFb, ConveyorFb, EncoderMotorFb, PusherFb, ServoAxisFb, SuctionCapGripperFb, Target, Travel,
};
use crate::automation::image::Binder;
use crate::automation::network::{Block, Context, Counts, Delay, Devices, Network, Sequence};

/// The rig's devices.
pub struct Rig {
    belt: ConveyorFb,
    pusher: PusherFb,
    robot: CartesianRobotFb,
    gripper: SuctionCapGripperFb,
    axis: ServoAxisFb,
    motor: EncoderMotorFb,
}

impl Devices for Rig {
    fn each(&mut self, visit: &mut dyn FnMut(&mut dyn Block)) {
        visit(&mut self.belt);
        visit(&mut self.pusher);
        visit(&mut self.robot);
        visit(&mut self.gripper);
        visit(&mut self.axis);
        visit(&mut self.motor);
    }
}

/// The robot's round.
const PLACES: [Target; 5] = [
    Target { x: 0.6, y: 0.0, z: 0.0, r: 0.0 },
    Target { x: 0.6, y: 0.4, z: 0.3, r: FRAC_PI_2 },
    Target { x: 0.6, y: 0.4, z: 0.1, r: FRAC_PI_2 },
    Target { x: -0.2, y: 0.1, z: 0.3, r: -0.5 },
    Target { x: 0.0, y: 0.0, z: 0.0, r: 0.0 },
];

/// The axis's round: steps of several sizes in both directions.
const POSITIONS_M: [f64; 5] = [0.25, 0.30, -0.10, 0.40, 0.0];

/// The motor's round; 0 switches it off.
const SPEEDS_RAD_S: [f64; 5] = [10.0, 25.0, -15.0, 5.0, 0.0];

/// How long devices rest between two moves.
const REST: Duration = Duration::from_millis(300);

/// The program, bound to the rig's signals.
pub fn program(binder: &mut Binder<'_>) -> Network<Rig> {
    let rig = Rig {
        belt: ConveyorFb::bind(binder, "Belt"),
        pusher: PusherFb::bind(binder, "Pusher"),
        robot: CartesianRobotFb::bind(binder, "Robot"),
        gripper: SuctionCapGripperFb::bind(binder, "Gripper"),
        axis: ServoAxisFb::bind(binder, "Axis"),
        motor: EncoderMotorFb::bind(binder, "Motor"),
    };
    Network::new(
        rig,
        vec![
            Box::new(Transport::default()),
            Box::new(Stroke::default()),
            Box::new(Round::new("Robot.Tour", &PLACES, |rig| rig.robot.arrived(), to_place)),
            Box::new(Grip::default()),
            Box::new(Round::new("Axis.Steps", &POSITIONS_M, |rig| rig.axis.arrived(), to_position)),
            Box::new(Round::new("Motor.Profile", &SPEEDS_RAD_S, |rig| rig.motor.at_speed(), to_speed)),
        ],
    )
}

/// A device goes from stop to stop, rests at each, and begins again after the last.
struct Round<T: 'static> {
    name: &'static str,
    stops: &'static [T],
    /// How many stops it has set out for.
    departures: usize,
    rest: Delay,
    there: fn(&Rig) -> bool,
    go: fn(&mut Rig, &mut Context<'_>, T) -> String,
}

impl<T> Round<T> {
    fn new(
        name: &'static str,
        stops: &'static [T],
        there: fn(&Rig) -> bool,
        go: fn(&mut Rig, &mut Context<'_>, T) -> String,
    ) -> Round<T> {
        Round { name, stops, departures: 0, rest: Delay::default(), there, go }
    }
}

impl<T: Copy + Sync> Sequence<Rig> for Round<T> {
    fn advance(&mut self, rig: &mut Rig, cx: &mut Context<'_>) -> bool {
        let event = if self.departures == 0 {
            "INIT"
        } else if self.rest.elapsed(cx) {
            "rested"
        } else if (self.there)(rig) && !self.rest.running() {
            self.rest.start(cx, REST);
            cx.decided(self.name, "there", "rest");
            return true;
        } else {
            return false;
        };
        let stop = self.stops[self.departures % self.stops.len()];
        self.departures += 1;
        let decision = (self.go)(rig, cx, stop);
        cx.decided(self.name, event, decision);
        true
    }
}

fn to_place(rig: &mut Rig, cx: &mut Context<'_>, place: Target) -> String {
    // The hand closes high up, so that every round has both.
    let close = place.z > 0.2;
    rig.robot.grip(cx, close);
    rig.robot.move_to(cx, place);
    let hand = if close { "closed" } else { "open" };
    format!("to x {} y {} z {} m, r {:.2} rad, hand {hand}", place.x, place.y, place.z, place.r)
}

fn to_position(rig: &mut Rig, cx: &mut Context<'_>, position: f64) -> String {
    rig.axis.move_to(cx, position);
    format!("to {position} m")
}

fn to_speed(rig: &mut Rig, cx: &mut Context<'_>, speed: f64) -> String {
    let counts = rig.motor.counts();
    if speed == 0.0 {
        rig.motor.stop(cx);
        return format!("inverter off; {counts} counts so far");
    }
    rig.motor.run(cx, speed);
    format!("to {speed} rad/s; {counts} counts so far")
}

/// Belt: brings a box to barrier B, backs off until the beam is free again, lets it go past.
#[derive(Default)]
struct Transport {
    step: TransportStep,
    rest: Delay,
    seen: u64,
    gone: u64,
}

#[derive(Clone, Copy, Default)]
enum TransportStep {
    #[default]
    Start,
    Bringing,
    Stopping,
    BackingOff,
    Resting,
    LettingGo,
}

impl Sequence<Rig> for Transport {
    fn advance(&mut self, rig: &mut Rig, cx: &mut Context<'_>) -> bool {
        use TransportStep::*;
        const NAME: &str = "Belt.Transport";
        let belt = &mut rig.belt;
        if belt.a.take_rise() {
            self.seen += 1;
            cx.decided(NAME, "A cut", format_args!("box {} comes", self.seen));
        }
        self.step = match self.step {
            Start => {
                cx.decided(NAME, "INIT", "forwards at 0.5 m/s");
                belt.run(cx, 0.5, Travel::Forward);
                Bringing
            }
            Bringing if belt.b.cut() => {
                cx.decided(NAME, "B cut", "stop");
                belt.stop(cx);
                Stopping
            }
            Stopping if belt.settled() => {
                cx.decided(NAME, "at rest", "backwards at 0.2 m/s until B is free");
                belt.run(cx, 0.2, Travel::Backward);
                BackingOff
            }
            BackingOff if !belt.b.cut() => {
                cx.decided(NAME, "B free", "stop");
                belt.stop(cx);
                self.rest.start(cx, REST);
                Resting
            }
            Resting if self.rest.elapsed(cx) => {
                cx.decided(NAME, "rested", "forwards at 0.8 m/s, past B");
                belt.b.forget();
                belt.run(cx, 0.8, Travel::Forward);
                LettingGo
            }
            LettingGo if belt.b.take_fall() => {
                self.gone += 1;
                cx.decided(NAME, "B free", format_args!("box {} is gone; 0.5 m/s for the next", self.gone));
                belt.run(cx, 0.5, Travel::Forward);
                Bringing
            }
            _ => return false,
        };
        true
    }

    fn count(&self, counts: &mut Counts) {
        counts.parts_in += self.seen;
        counts.parts_out += self.gone;
    }
}

/// Pusher: out, with a stop on the way, and back.
#[derive(Default)]
struct Stroke {
    step: StrokeStep,
    delay: Delay,
}

#[derive(Clone, Copy, Default)]
enum StrokeStep {
    #[default]
    Start,
    Retracting,
    Resting,
    HalfWay,
    Holding,
    Extending,
    RestingOut,
}

impl Sequence<Rig> for Stroke {
    fn advance(&mut self, rig: &mut Rig, cx: &mut Context<'_>) -> bool {
        use StrokeStep::*;
        const NAME: &str = "Pusher.Stroke";
        let pusher = &mut rig.pusher;
        self.step = match self.step {
            Start => {
                cx.decided(NAME, "INIT", "retract");
                pusher.retract(cx);
                Retracting
            }
            Retracting if pusher.retracted() => {
                cx.decided(NAME, "retracted", "rest");
                self.delay.start(cx, REST);
                Resting
            }
            Resting if self.delay.elapsed(cx) => {
                cx.decided(NAME, "rested", "extend for 0.4 s");
                pusher.extend(cx);
                self.delay.start(cx, Duration::from_millis(400));
                HalfWay
            }
            HalfWay if self.delay.elapsed(cx) => {
                cx.decided(NAME, "0.4 s over", "hold");
                pusher.hold(cx);
                self.delay.start(cx, REST);
                Holding
            }
            Holding if self.delay.elapsed(cx) => {
                cx.decided(NAME, "rested", "extend to the end");
                pusher.extend(cx);
                Extending
            }
            Extending if pusher.extended() => {
                cx.decided(NAME, "extended", "rest");
                self.delay.start(cx, REST);
                RestingOut
            }
            RestingOut if self.delay.elapsed(cx) => {
                cx.decided(NAME, "rested", "retract");
                pusher.retract(cx);
                Retracting
            }
            _ => return false,
        };
        true
    }
}

/// Gripper: holds for a while, lets go for a while.
#[derive(Default)]
struct Grip {
    step: GripStep,
    rest: Delay,
}

#[derive(Clone, Copy, Default)]
enum GripStep {
    #[default]
    Start,
    Gripping,
    Holding,
    Releasing,
    Resting,
}

impl Sequence<Rig> for Grip {
    fn advance(&mut self, rig: &mut Rig, cx: &mut Context<'_>) -> bool {
        use GripStep::*;
        const NAME: &str = "Gripper.Grip";
        let gripper = &mut rig.gripper;
        self.step = match self.step {
            Start => {
                cx.decided(NAME, "INIT", "suction on");
                gripper.grip(cx);
                Gripping
            }
            Gripping if gripper.holds() => {
                cx.decided(NAME, "vacuum", "hold");
                self.rest.start(cx, REST * 2);
                Holding
            }
            Holding if self.rest.elapsed(cx) => {
                cx.decided(NAME, "held", "blow off");
                gripper.release(cx);
                Releasing
            }
            Releasing if gripper.free() => {
                cx.decided(NAME, "no vacuum", "rest");
                gripper.rest(cx);
                self.rest.start(cx, REST);
                Resting
            }
            Resting if self.rest.elapsed(cx) => {
                cx.decided(NAME, "rested", "suction on");
                gripper.grip(cx);
                Gripping
            }
            _ => return false,
        };
        true
    }
}
