//! What straight and curved conveyors have in common: their signals, their drive, their light barriers.

use crate::device::driven::Driven;
use crate::device::law::drive::DriveSettings;
use crate::device::law::ramp::Slopes;
use crate::device::law::{STANDSTILL, direction, moves};
use crate::device::path::Stages;
use crate::device::table::{
    ACCELERATION, LEAST, LENGTH, LONGEST_M, LONGEST_S, STEEPEST, TIME, VELOCITY, choice, code, indicator, measure,
    number, option, state, target,
};
use crate::device::{Belt, BuildError, Device, Role, Surface, Surroundings, Transfer, misfit};
use crate::plant::Parameters;
use crate::prototype::kind::{ParameterDescriptor, PortDescriptor};

const VELOCITY_TARGET: usize = 0;
const MOTOR_DIRECTION: usize = 1;
const VELOCITY_ACTUAL: usize = 2;
const DRIVE_ENABLED: usize = 3;
const DRIVE_RUNNING: usize = 4;
const DIRECTIONAL_ACTUAL: usize = 5;
const LIGHT_BARRIER_A: usize = 6;
const LIGHT_BARRIER_B: usize = 7;

/// The ports of both kinds, in the order of the constants above.
pub(super) const PORTS: &[PortDescriptor] = &[
    target("velocityTarget", VELOCITY, "speed the belt is to run at, its sign counts"),
    code("motorDirection", -1.0, 1.0, "-1 backwards, 0 off, 1 forwards; multiplies the target"),
    measure("velocityActual", VELOCITY, "speed of the belt on its centre line"),
    indicator("driveEnabled", "motorDirection is not 0"),
    indicator("driveRunning", "the belt moves faster than 1 mm/s, either way"),
    state("directionalActual", -1.0, 1.0, "which way the belt moves: 0 within 1 mm/s of standstill"),
    indicator("lightBarrierA", "a part cuts the beam of barrier A"),
    indicator("lightBarrierB", "a part cuts the beam of barrier B"),
];

/// Width of the belt.
pub(super) const WIDTH: ParameterDescriptor =
    number("width", LENGTH, (0.01, LONGEST_M), "0.6", "width of the belt across its running direction");
/// How steeply the drive changes its speed.
pub(super) const DRIVE_ACCELERATION: ParameterDescriptor =
    number("acceleration", ACCELERATION, (LEAST, STEEPEST), "1.0", "slope of the speed towards its target");
/// How steeply it slows down, if that differs.
pub(super) const DRIVE_DECELERATION: ParameterDescriptor = number(
    "deceleration",
    ACCELERATION,
    (0.0, STEEPEST),
    "0",
    "slope while the speed falls towards 0; 0 means as acceleration",
);
/// Whether it coasts.
pub(super) const COAST: ParameterDescriptor =
    option("coast", "with motorDirection 0 the belt coasts instead of following the ramp");
/// How fast a coasting belt slows down.
pub(super) const COAST_DECELERATION: ParameterDescriptor =
    number("coastDeceleration", ACCELERATION, (LEAST, STEEPEST), "0.5", "slope at which a coasting belt slows down");
/// How long the drive takes to be ready.
pub(super) const READY_DELAY: ParameterDescriptor = number(
    "readyDelay",
    TIME,
    (0.0, LONGEST_S),
    "0",
    "time from motorDirection leaving 0 until the drive is enabled and moves",
);
/// Height of the beams.
pub(super) const BEAM_HEIGHT: ParameterDescriptor =
    number("beamHeight", LENGTH, (0.0, LONGEST_M), "0.05", "height of both beams above the belt");
/// How a part on two belts is carried.
pub(super) const TRANSFER: ParameterDescriptor = choice(
    "transfer",
    &["most", "share"],
    "most",
    "a part on two belts moves with the one that carries most of its footprint, or with both by their shares",
);

/// The place of a light barrier; `name` is `barrierA` or `barrierB`.
pub(super) const fn barrier(name: &'static str, default: &'static str) -> ParameterDescriptor {
    number(
        name,
        LENGTH,
        (-1.0, LONGEST_M),
        default,
        "where the barrier's beam crosses the centre line, from the start of the belt; negative: there is none",
    )
}

/// A conveyor with its drive and its belt.
#[derive(Clone, Debug)]
pub(super) struct Conveyor {
    velocity_target: f64,
    motor_direction: f64,
    drive: Driven,
    belt: Belt,
    beams: [bool; 2],
}

impl Conveyor {
    /// A conveyor with this surface, at rest and switched off.
    pub(super) fn new(surface: Surface, parameters: &Parameters, instance: &str) -> Result<Conveyor, BuildError> {
        Ok(Conveyor {
            velocity_target: 0.0,
            motor_direction: 0.0,
            drive: Driven::new(drive_settings(parameters)),
            belt: belt(surface, parameters, instance)?,
            beams: [false; 2],
        })
    }
}

/// The belt of a conveyor with this surface, at rest.
pub(super) fn belt(surface: Surface, parameters: &Parameters, instance: &str) -> Result<Belt, BuildError> {
    let length = surface.length();
    let barrier = |name: &'static str| {
        let place = parameters.number(name);
        match place {
            p if p < 0.0 => Ok(None),
            p if p <= length => Ok(Some(p)),
            p => Err(misfit(instance, name, format!("stands at {p} m of a belt that is {length} m long"))),
        }
    };
    Ok(Belt {
        surface,
        speeds: [0.0; 2],
        displacement: 0.0,
        barriers: [barrier("barrierA")?, barrier("barrierB")?],
        beam_height: parameters.number("beamHeight"),
        transfer: if parameters.text("transfer") == "share" { Transfer::Share } else { Transfer::Most },
        transfer_slip: 0.0,
        grip: f64::INFINITY,
    })
}

/// What a belt is after its drive moved what goes with it by `way`, m or rad; `reach` is how far it goes for one of the drive's.
pub(super) fn moved(belt: &mut Belt, drive: &Driven, way: f64, reach: f64) {
    belt.displacement = way * reach;
    belt.speeds = [belt.speeds[1], drive.load().velocity * reach];
    if !drive.stages.is_nominal() {
        belt.transfer_slip = drive.stages.process.transfer_slip();
        belt.grip = drive.stages.process.grip();
    }
}

/// A ramped drive's parameters: those of both conveyors and of the motor.
pub(super) fn drive_settings(parameters: &Parameters) -> DriveSettings {
    let rising = parameters.number("acceleration");
    let falling = match parameters.number("deceleration") {
        0.0 => rising,
        slope => slope,
    };
    DriveSettings {
        slopes: Slopes { rising, falling },
        coasting: parameters.boolean("coast").then(|| parameters.number("coastDeceleration")),
        ready_delay: parameters.number("readyDelay"),
    }
}

impl Device for Conveyor {
    fn command(&mut self, port: usize, value: f64) {
        match port {
            VELOCITY_TARGET => self.velocity_target = value,
            MOTOR_DIRECTION => self.motor_direction = value,
            _ => return,
        }
        self.drive.command(self.motor_direction != 0.0, self.motor_direction * self.velocity_target);
    }

    fn sense(&mut self, surroundings: &Surroundings) {
        self.beams = [surroundings.barrier_a, surroundings.barrier_b];
        self.drive.loaded(surroundings.parts, surroundings.queued);
    }

    fn advance(&mut self, seconds: f64) {
        // Actuator, mechanics and transmission: the belt follows the drum. Process: the parts follow the belt.
        let way = self.drive.advance(seconds);
        moved(&mut self.belt, &self.drive, way, 1.0);
    }

    fn report(&mut self, reports: &mut [f64]) {
        let velocity = self.drive.velocity();
        reports[VELOCITY_ACTUAL] = velocity;
        reports[DRIVE_ENABLED] = f64::from(self.drive.ready());
        reports[DRIVE_RUNNING] = f64::from(moves(velocity));
        reports[DIRECTIONAL_ACTUAL] = direction(velocity);
        reports[LIGHT_BARRIER_A] = f64::from(self.beams[0] && self.belt.barriers[0].is_some());
        reports[LIGHT_BARRIER_B] = f64::from(self.beams[1] && self.belt.barriers[1].is_some());
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.velocity_target);
        visit(self.motor_direction);
        self.drive.state(visit);
        visit(self.belt.displacement);
        self.beams.iter().for_each(|cut| visit(f64::from(*cut)));
    }

    fn rests(&self) -> bool {
        self.drive.rests()
    }

    fn unchanged_for(&self) -> f64 {
        self.drive.unchanged_for(STANDSTILL)
    }

    fn boxed(&self) -> Box<dyn Device> {
        Box::new(self.clone())
    }

    fn stages(&mut self, _component: Option<&str>) -> Option<&mut Stages> {
        Some(&mut self.drive.stages)
    }

    /// Both beams look along the belt.
    fn travel(&self, port: usize) -> Option<f64> {
        matches!(port, LIGHT_BARRIER_A | LIGHT_BARRIER_B).then(|| self.drive.carried())
    }

    fn moving(&self) -> u32 {
        u32::from(moves(self.drive.velocity()))
    }

    fn share(&mut self, others: u32) {
        self.drive.shared(others);
    }

    fn role(&self) -> Role<'_> {
        Role::Carries(&self.belt)
    }
}
