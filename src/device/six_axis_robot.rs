//! `kinetwin.SixAxisRobot`: an arm of six revolute joints, each on its own trapezoidal profile, driven by joint targets or to
//! places that it was taught.
//!
//! Its kinematics are those of its [`DenavitHartenberg`] parameters. The tool is the
//! flange turned by half a turn about its x axis, so that it points up while the flange looks down. Of the places it was
//! taught, the joints are found once, when it is built, by [`Chain::inverse`], each from the one before it.

use std::f64::consts::PI;

use crate::device::axis::{self, Axis};
use crate::device::law::profile::Limits;
use crate::device::path::Stages;
use crate::device::table::{
    ANGLE, ANGULAR_ACCELERATION, ANGULAR_VELOCITY, FASTEST, LEAST, LENGTH, LONGEST_M, STEEPEST, code, indicator,
    measure, number, numbers, switch, target,
};
use crate::device::{BuildError, Device, Role, Surroundings, Tool, joints_where_reported, misfit, triple};
use crate::kinematics::{Chain, DPose3, DQuat, DVec3, DenavitHartenberg, Upright};
use crate::plant::Parameters;
use crate::prototype::kind::KindDescriptor;

const TARGET_LINE: &str = "where the joint is to turn, while place is 0";
const ACTUAL_LINE: &str = "angle of the joint";

/// The kind's table.
pub static KIND: KindDescriptor = KindDescriptor {
    name: "kinetwin.SixAxisRobot",
    summary: "an arm of six revolute joints, each on a trapezoidal profile, to joint targets or to places it was taught",
    ports: &[
        target("J1Target", ANGLE, TARGET_LINE),
        target("J2Target", ANGLE, TARGET_LINE),
        target("J3Target", ANGLE, TARGET_LINE),
        target("J4Target", ANGLE, TARGET_LINE),
        target("J5Target", ANGLE, TARGET_LINE),
        target("J6Target", ANGLE, TARGET_LINE),
        code("place", 0.0, MOST_PLACES, "the place it is to go to, counted from 1; 0: its joints follow their targets"),
        switch("grip", "closes the mounted gripper"),
        indicator("arrived", "every joint is within its tolerance of where it is to be, and at rest"),
        measure("actualJ1", ANGLE, ACTUAL_LINE),
        measure("actualJ2", ANGLE, ACTUAL_LINE),
        measure("actualJ3", ANGLE, ACTUAL_LINE),
        measure("actualJ4", ANGLE, ACTUAL_LINE),
        measure("actualJ5", ANGLE, ACTUAL_LINE),
        measure("actualJ6", ANGLE, ACTUAL_LINE),
        measure("toolX", LENGTH, "where the tool is in the frame of its base"),
        measure("toolY", LENGTH, "where the tool is in the frame of its base"),
        measure("toolZ", LENGTH, "where the tool is in the frame of its base"),
    ],
    parameters: &[
        numbers("d", LENGTH, 6, SIDES, "0.1625;0;0;0.1333;0.0997;0.0996", "of each joint the way along its axis"),
        numbers("a", LENGTH, 6, SIDES, "0;-0.425;-0.3922;0;0;0", "of each joint the way along the next x axis"),
        numbers("alpha", ANGLE, 6, TURNS, HALF_TURNS, "of each joint the turn about the next x axis"),
        numbers("jointLow", ANGLE, 6, TURNS, "-6.283;-6.283;-3.141;-6.283;-6.283;-6.283", "least angle of each joint"),
        numbers("jointHigh", ANGLE, 6, TURNS, "6.283;6.283;3.141;6.283;6.283;6.283", "greatest angle of each joint"),
        numbers("home", ANGLE, 6, TURNS, "0;-1.5708;1.5708;-1.5708;-1.5708;0", "angle of each joint at the start"),
        numbers("basePlace", LENGTH, 3, SIDES, "0;0;0", "where its base is in the frame of its instance"),
        number("maxVelocity", ANGULAR_VELOCITY, (LEAST, FASTEST), "3.14", "highest speed of each joint"),
        number("maxAcceleration", ANGULAR_ACCELERATION, (LEAST, STEEPEST), "10", "highest acceleration of each joint"),
        number("arrivedTolerance", ANGLE, (0.0, 1.0), "0.0005", "how far each joint may be from its target"),
        numbers("places", LENGTH, 0, SIDES, "0.5;0;0.3", "x;y;z of the tool at each place, in the frame of its base"),
        numbers("placeTurns", ANGLE, 0, TURNS, "0", "how far the tool is turned about the vertical at each place"),
    ],
};

const SIDES: (f64, f64) = (-LONGEST_M, LONGEST_M);
const TURNS: (f64, f64) = (-7.0, 7.0);
const HALF_TURNS: &str = "1.5707963267948966;0;0;1.5707963267948966;-1.5707963267948966;0";
const MOST_PLACES: f64 = 64.0;

const JOINTS: usize = 6;
const PLACE: usize = 6;
const GRIP: usize = 7;
const ARRIVED: usize = 8;
/// The first of the six angles, and of the tool's three coordinates.
const ANGLES: usize = 9;
const TOOL: usize = 15;

/// The joints' names in the scene.
const NAMES: [&str; JOINTS] = ["J1.R", "J2.R", "J3.R", "J4.R", "J5.R", "J6.R"];

/// An arm.
#[derive(Clone, Debug)]
struct SixAxisRobot {
    chain: Chain,
    /// Where its base is in the frame of its instance.
    base: DVec3,
    axes: [Axis; JOINTS],
    targets: [f64; JOINTS],
    /// Of each place, the joints.
    taught: Vec<[f64; JOINTS]>,
    place: usize,
    tool: Tool,
}

/// Its joints, and the tool.
fn chain(parameters: &Parameters) -> Chain {
    let [a, d, alpha] = ["a", "d", "alpha"].map(|name| parameters.numbers(name));
    let limits = ["jointLow", "jointHigh"].map(|name| parameters.numbers(name));
    let (links, flange) = DenavitHartenberg { a, d, alpha, limits }.links();
    Chain::new(links, flange * DPose3::from_rotation(DQuat::from_rotation_x(PI)))
}

/// Builds one.
pub(super) fn build(parameters: &Parameters, instance: &str) -> Result<Box<dyn Device>, BuildError> {
    let chain = chain(parameters);
    let home = six(parameters.numbers("home"));
    for (index, (joint, value)) in chain.joints().zip(home).enumerate() {
        let [low, high] = joint.limits;
        if !(low..=high).contains(&value) {
            let problem = format!("has joint {} at {value} rad, which goes from {low} to {high}", index + 1);
            return Err(misfit(instance, "home", problem));
        }
    }
    let taught = taught(&chain, home, parameters, instance)?;
    let limits =
        Limits { velocity: parameters.number("maxVelocity"), acceleration: parameters.number("maxAcceleration") };
    let tolerance = parameters.number("arrivedTolerance");
    let mut robot = SixAxisRobot {
        chain,
        base: DVec3::from_array(triple(parameters, "basePlace", instance)?),
        axes: home.map(|angle| Axis::at(angle, limits, tolerance)),
        targets: [0.0; JOINTS],
        taught,
        place: 0,
        tool: Tool::default(),
    };
    robot.follow();
    Ok(Box::new(robot))
}

fn six(numbers: &[f64]) -> [f64; JOINTS] {
    std::array::from_fn(|joint| numbers[joint])
}

/// The joints of each place, the first found from `home`, every other from the one before it.
fn taught(
    chain: &Chain,
    home: [f64; JOINTS],
    parameters: &Parameters,
    instance: &str,
) -> Result<Vec<[f64; JOINTS]>, BuildError> {
    let (places, turns) = (parameters.numbers("places"), parameters.numbers("placeTurns"));
    if places.len() != 3 * turns.len() {
        let problem = format!("has {} numbers for {} places: expected x;y;z of each", places.len(), turns.len());
        return Err(misfit(instance, "places", problem));
    }
    if turns.len() > MOST_PLACES as usize {
        return Err(misfit(instance, "placeTurns", format!("has {} places: expected at most 64", turns.len())));
    }
    let mut near = home;
    let mut taught = Vec::with_capacity(turns.len());
    for (index, turn) in turns.iter().enumerate() {
        let place = DVec3::from_slice(&places[3 * index..]);
        let goal = DPose3::from_parts(place, DQuat::from_rotation_z(*turn));
        let found = chain.inverse(&goal, &near);
        let found = found.map_err(|miss| misfit(instance, "places", format!("has place {}: {miss}", index + 1)))?;
        near = six(&found);
        taught.push(near);
    }
    Ok(taught)
}

impl SixAxisRobot {
    /// Sends the joints to where they are to be now.
    fn retarget(&mut self) {
        let goals = match self.place {
            0 => self.targets,
            place => self.taught.get(place - 1).copied().unwrap_or(self.targets),
        };
        for (axis, goal) in self.axes.iter_mut().zip(goals) {
            axis.retarget(goal);
        }
    }

    /// Where the tool is now.
    fn reach(&self) -> DPose3 {
        self.chain.forward(&self.axes.each_ref().map(|axis| axis.load().position))
    }

    fn follow(&mut self) {
        let pose = self.reach();
        let position = (self.base + pose.translation).to_array();
        self.tool = Tool { position, rotation: Upright::from_pose(&pose).yaw, grip: self.tool.grip };
    }
}

impl Device for SixAxisRobot {
    /// A place that it was not taught is refused by nobody before it: the arm stays where it is.
    fn command(&mut self, port: usize, value: f64) {
        match port {
            0..JOINTS => self.targets[port] = value,
            PLACE if value >= 0.0 && value as usize <= self.taught.len() => self.place = value as usize,
            GRIP => return self.tool.grip = value != 0.0,
            _ => return,
        }
        self.retarget();
    }

    fn sense(&mut self, surroundings: &Surroundings) {
        for axis in &mut self.axes {
            axis.loaded(surroundings.parts);
        }
    }

    fn advance(&mut self, seconds: f64) {
        // Actuator and mechanics: the joints are not synchronised.
        for axis in &mut self.axes {
            axis.advance(seconds);
        }
        self.follow();
    }

    fn report(&mut self, reports: &mut [f64]) {
        // Every joint is asked, whatever the others say: an answer may move what stands in its path.
        let arrived = self.axes.each_mut().map(|axis| axis.arrived());
        reports[ARRIVED] = f64::from(arrived.iter().all(|arrived| *arrived));
        for (report, axis) in reports[ANGLES..].iter_mut().zip(&self.axes) {
            *report = axis.load().position;
        }
        let place = DVec3::from_array(self.tool.position) - self.base;
        reports[TOOL..TOOL + 3].copy_from_slice(&place.to_array());
    }

    fn rests(&self) -> bool {
        self.axes.iter().all(Axis::rests)
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        for axis in &self.axes {
            axis.state(visit);
        }
        visit(self.place as f64);
        visit(f64::from(self.tool.grip));
    }

    fn unchanged_for(&self) -> f64 {
        axis::unchanged_for(&self.axes)
    }

    fn boxed(&self) -> Box<dyn Device> {
        Box::new(self.clone())
    }

    /// The components are the joints J1 to J6, also by the names of their signals.
    fn stages(&mut self, component: Option<&str>) -> Option<&mut Stages> {
        let name = component?;
        let joint = (0..JOINTS).find(|joint| {
            let own = &NAMES[*joint][..2];
            name == own || name.strip_suffix("Target") == Some(own) || name.strip_prefix("actual") == Some(own)
        })?;
        Some(&mut self.axes[joint].stages)
    }

    fn moving(&self) -> u32 {
        axis::moving(&self.axes)
    }

    /// The joints are on one supply, too.
    fn share(&mut self, others: u32) {
        axis::share(&mut self.axes, others);
    }

    fn joints(&self, visit: &mut dyn FnMut(&'static str, f64)) {
        for (name, axis) in NAMES.iter().zip(&self.axes) {
            visit(name, axis.load().position);
        }
    }

    fn reported_joints(&self, reports: &[Option<f64>], visit: &mut dyn FnMut(&'static str, f64)) {
        joints_where_reported(self, &reports[ANGLES..], visit);
    }

    fn role(&self) -> Role<'_> {
        Role::Moves(&self.tool)
    }
}

#[cfg(test)]
mod tests {
    use crate::device::bench::Bench;

    /// As the kind's table writes it.
    const HOME_J2: f64 = -15_708.0 / 10_000.0;

    fn robot(set: &[(&str, &str)]) -> Bench {
        Bench::new("kinetwin.SixAxisRobot", set)
    }

    #[test]
    fn it_stays_at_home_until_it_is_told() {
        robot(&[]).check(&[], 1.0, &[("arrived", 1.0), ("actualJ2", HOME_J2), ("actualJ6", 0.0)]);
    }

    #[test]
    fn stretched_out_it_is_where_its_maker_has_it() {
        let stretched = [("J1Target", 0.0), ("J2Target", 0.0), ("J3Target", 0.0), ("J4Target", 0.0), ("J5Target", 0.0)];
        let there = [("toolX", -0.8172), ("toolY", -0.2329), ("toolZ", 0.0628), ("arrived", 1.0)];
        robot(&[]).check(&stretched, 5.0, &there);
    }

    #[test]
    fn each_joint_runs_its_own_trapezoid() {
        let mut robot = robot(&[("home", "0;0;0;0;0;0"), ("maxVelocity", "2"), ("maxAcceleration", "4")]);
        // Up to 2 rad/s in 0.5 s over 0.5 rad, then on; the other is there after 2·sqrt(0.25/4) = 0.5 s.
        let targets = [("J1Target", 3.0), ("J3Target", 0.25)];
        robot.check(&targets, 1.0, &[("actualJ1", 1.5), ("actualJ3", 0.25), ("arrived", 0.0)]);
        robot.check(&[], 1.0, &[("actualJ1", 3.0), ("arrived", 1.0)]);
    }

    #[test]
    fn it_goes_to_the_places_it_was_taught() {
        let taught = [("places", "0.5;0.2;0.3;0.3;-0.4;0.1"), ("placeTurns", "0.5;-1")];
        let mut robot = robot(&taught);
        robot.check(&[("place", 1.0)], 3.0, &[("arrived", 1.0), ("toolX", 0.5), ("toolY", 0.2), ("toolZ", 0.3)]);
        let turn = |bench: &Bench| match bench.device.role() {
            crate::device::Role::Moves(tool) => tool.rotation,
            other => panic!("an arm is {other:?}"),
        };
        assert!((turn(&robot) - 0.5).abs() < 1e-6, "{}", turn(&robot));
        robot.check(&[("place", 2.0)], 3.0, &[("arrived", 1.0), ("toolX", 0.3), ("toolY", -0.4), ("toolZ", 0.1)]);
        assert!((turn(&robot) + 1.0).abs() < 1e-6, "{}", turn(&robot));
        // A place that it was not taught changes nothing.
        robot.check(&[("place", 3.0)], 1.0, &[("arrived", 1.0), ("toolX", 0.3)]);
        assert!(robot.device.rests());
    }

    #[test]
    fn what_it_cannot_reach_is_refused() {
        let error = |set: &[(&str, &str)]| Bench::error("kinetwin.SixAxisRobot", set);
        let far = error(&[("places", "2;0;0.3")]);
        assert!(far.starts_with("Device1: places has place 1: the goal is out of reach"), "{far}");
        let odd = error(&[("places", "0.5;0;0.3;1")]);
        assert_eq!(odd, "Device1: places has 4 numbers for 1 places: expected x;y;z of each");
        let wrung = error(&[("home", "0;0;4;0;0;0")]);
        assert_eq!(wrung, "Device1: home has joint 3 at 4 rad, which goes from -3.141 to 3.141");
    }
}
