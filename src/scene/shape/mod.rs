//! The shapes of the catalogue's device kinds, built from their parameters: one file each.
//!
//! Each builds into the frame of its instance, as its prototype describes it. What is in many machines alike (a roller, a
//! caster, a bolt) is one mesh that hangs in many places.

mod bay;
mod cartesian_robot;
mod conveyor;
mod conveyor_curve;
mod gripper;
mod motor;
mod part;
mod pusher;
mod sensor;
mod servo;
mod six_axis_robot;

use super::{Assembly, Colour, NodeId, Scene};
use crate::kinematics::{DPose3, DQuat, DVec3};
use crate::plant::{Instance, ParameterValue, Plant, Pose, Task};
use crate::prototype::structure::Structure;

const STEEL: Colour = [150, 156, 162];
const BRIGHT: Colour = [205, 209, 213];
const FRAME: Colour = [176, 184, 190];
const BELT: Colour = [44, 48, 52];
const PAINT: Colour = [228, 121, 36];
const DRIVE: Colour = [45, 92, 140];
const RUBBER: Colour = [60, 60, 64];
const LAMP: Colour = [230, 190, 40];

/// A pose of the plant's file: turned about the fixed x, y and z axes, in this order.
pub(super) fn frame_of(pose: &Pose) -> DPose3 {
    let about = DQuat::from_rotation_z(pose.rz) * DQuat::from_rotation_y(pose.ry) * DQuat::from_rotation_x(pose.rx);
    DPose3::from_parts(DVec3::new(pose.x, pose.y, pose.z), about)
}

impl Scene {
    /// The scene of `plant`.
    pub fn of(plant: &Plant) -> Scene {
        let mut assembly = Assembly::default();
        let carrier = |instance: &Instance| {
            let carriers = instance.tasks.iter().filter_map(carrier_of);
            carriers.filter(|name| *name != instance.name).map(str::to_owned).next()
        };
        // What hangs on another instance comes after it.
        for (index, instance) in plant.instances.iter().enumerate() {
            if carrier(instance).is_none() {
                let node = assembly.instance(index, &instance.name, None, frame_of(&instance.pose));
                build(&mut assembly, node, instance);
            }
        }
        for (index, instance) in plant.instances.iter().enumerate() {
            let Some(carrier) = carrier(instance) else { continue };
            let tool = tool_of(&assembly, &carrier);
            // A name that leads nowhere is refused when the engine is built.
            let rest = if tool.is_some() { DPose3::IDENTITY } else { frame_of(&instance.pose) };
            let node = assembly.instance(index, &instance.name, tool, rest);
            build(&mut assembly, node, instance);
        }
        assembly.finish()
    }
}

/// The frame of a robot that tools hang on.
fn tool_of(assembly: &Assembly, robot: &str) -> Option<NodeId> {
    let tools = [cartesian_robot::TOOL, six_axis_robot::TOOL];
    tools.iter().find_map(|tool| assembly.find(&format!("{robot}.{tool}")))
}

/// The robot that an instance hangs on.
fn carrier_of(task: &Task) -> Option<&str> {
    task.kind.parameter("robot")?;
    Some(task.parameters.text("robot")).filter(|name| !name.is_empty())
}

fn build(assembly: &mut Assembly, node: NodeId, instance: &Instance) {
    if let Some(structure) = &instance.structure {
        return hang(assembly, node, structure);
    }
    for task in &instance.tasks {
        let own = &task.parameters;
        match task.kind.name {
            "kinetwin.StraightConveyor" | "kinetwin.InverterConveyor" => {
                conveyor::build(assembly, node, own, instance.pose.z)
            }
            "kinetwin.ConveyorCurve" => conveyor_curve::build(assembly, node, own, instance.pose.z),
            "kinetwin.Pusher" => pusher::build(assembly, node, own, instance.pose.z),
            "kinetwin.CartesianRobot" => cartesian_robot::build(assembly, node, instance),
            "kinetwin.SuctionCapGripper" => {
                // It may be one instance with its robot.
                let own_tool = carrier_of(task).filter(|robot| *robot == instance.name);
                let tool = own_tool.and_then(|robot| tool_of(assembly, robot));
                gripper::build(assembly, tool.unwrap_or(node), own);
            }
            "kinetwin.SixAxisRobot" => six_axis_robot::build(assembly, node, own),
            "kinetwin.LoadingBay" => bay::build(assembly, node, bay::Way::In),
            "kinetwin.UnloadingBay" => bay::build(assembly, node, bay::Way::Out),
            "kinetwin.EncoderMotor" => motor::build(assembly, node),
            "kinetwin.ProximitySensor" => sensor::ray(assembly, node),
            "kinetwin.BoxSensor" | "kinetwin.VisionSensor" => sensor::window(assembly, node, own),
            "kinetwin.ServoAxis" => servo::build(assembly, node, own),
            // A kind without a shape of its own: its frame is all there is.
            _ => {}
        }
    }
}

/// Adds the shape that a prototype's files give.
fn hang(assembly: &mut Assembly, node: NodeId, structure: &Structure) {
    let mut frames: Vec<NodeId> = Vec::with_capacity(structure.frames.len());
    for frame in &structure.frames {
        let parent = frame.parent.map_or(node, |parent| frames[parent]);
        frames.push(assembly.frame(parent, &frame.name, frame.rest, frame.joint));
    }
    for body in &structure.bodies {
        let frame = body.frame.map_or(node, |frame| frames[frame]);
        let mesh = assembly.shared(&body.mesh);
        if body.is_solid {
            assembly.solid(frame, mesh, body.place, body.colour);
        } else {
            assembly.shown(frame, mesh, body.place, body.colour);
        }
    }
}

/// The value of an instance's parameter of three numbers, such as a corner of its working space.
fn vector(instance: &Instance, name: &str) -> Option<DVec3> {
    match instance.shape.get(name)? {
        ParameterValue::Numbers(numbers) => Some(DVec3::from_array(numbers.as_slice().try_into().ok()?)),
        _ => None,
    }
}

/// A pose shifted only.
fn at(x: f64, y: f64, z: f64) -> DPose3 {
    DPose3::translation(x, y, z)
}
