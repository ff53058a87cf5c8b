//! A drawn plant's file: what whoever diagnoses a case is told of the machine.

use std::fmt::Write;

use super::unit::{Figures, Unit};

/// The plant `name` of these devices, each parameter of which may be off by `tolerance`, a share of itself.
///
/// Every parameter that counts is written out, the default or not, so that no change of a default changes a case.
pub fn plant(name: &str, units: &[Unit], tolerance: f64) -> String {
    let mut xml = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    let percent = 100.0 * tolerance;
    let _ = writeln!(xml, "<plant name=\"{name}\" tolerance=\"{percent} %\">");
    xml.push_str("  <adapter host=\"embedded\" timeout=\"5s\" hf=\"20ms\" lf=\"500ms\"/>\n");
    for (at, unit) in units.iter().enumerate() {
        // Far from each other: nothing touches another.
        let [x, y] = [6.0 * (at % 3) as f64, 5.0 * (at / 3) as f64];
        let _ = write!(xml, "\n{}", instance(unit, x, y));
    }
    xml.push_str("</plant>\n");
    xml
}

fn instance(unit: &Unit, x: f64, y: f64) -> String {
    let pose = format!("<pose x=\"{x}\" y=\"{y}\" z=\"{}\"/>", if unit.figures.kind() == "Robot" { 1.5 } else { 0.8 });
    let mut xml = element(&unit.name, prototype(&unit.figures), &pose, &properties(&unit.figures));
    if let Figures::Belt { parameters, feed, .. } = &unit.figures {
        let pose = format!("<pose x=\"{x}\" y=\"{}\" z=\"0.8\"/>", y + 0.6);
        let metres = |value: f64| format!("{value} m");
        let properties = [
            ("belt", unit.name.clone()),
            ("at", metres(parameters.box_at)),
            ("size", format!("{};0.2;0.2 m", parameters.box_length)),
            ("firstTime", format!("{} s", parameters.first)),
            ("interval", format!("{} s", parameters.interval)),
        ];
        xml.push_str(&element(feed, "LoadingBay", &pose, &properties));
    }
    xml
}

fn element(name: &str, prototype: &str, pose: &str, properties: &[(&str, String)]) -> String {
    let mut xml = format!("  <instance name=\"{name}\" prototype=\"{prototype}\">\n    {pose}\n");
    for (property, value) in properties {
        let _ = writeln!(xml, "    <property name=\"{property}\" value=\"{value}\"/>");
    }
    xml.push_str("  </instance>\n");
    xml
}

fn prototype(figures: &Figures) -> &'static str {
    match figures {
        Figures::Belt { .. } => "StraightConveyor",
        Figures::Pusher(_) => "Pusher",
        Figures::Robot { .. } => "CartesianRobot",
        Figures::Gripper(_) => "SuctionCapGripper",
        Figures::Servo { .. } => "ServoAxis",
        Figures::Motor { .. } => "EncoderMotor",
    }
}

fn properties(figures: &Figures) -> Vec<(&'static str, String)> {
    match figures {
        Figures::Belt { parameters: belt, .. } => vec![
            ("length", format!("{} m", belt.length)),
            ("acceleration", format!("{} m/s2", belt.acceleration)),
            ("barrierA", format!("{} m", belt.barriers[0])),
            ("barrierB", format!("{} m", belt.barriers[1])),
        ],
        Figures::Pusher(pusher) => vec![
            ("stroke", format!("{} m", pusher.stroke)),
            ("extendSpeed", format!("{} m/s", pusher.extend_speed)),
            ("retractSpeed", format!("{} m/s", pusher.retract_speed)),
            ("limitTolerance", format!("{} m", pusher.limit_tolerance)),
        ],
        Figures::Robot { parameters: robot, .. } => vec![
            ("maxVelocityX", format!("{} m/s", robot.fastest[0])),
            ("maxVelocityY", format!("{} m/s", robot.fastest[1])),
            ("maxVelocityZ", format!("{} m/s", robot.fastest[2])),
            ("maxVelocityR", format!("{} rad/s", robot.fastest[3])),
            ("maxAccelerationX", format!("{} m/s2", robot.steepest[0])),
            ("maxAccelerationY", format!("{} m/s2", robot.steepest[1])),
            ("maxAccelerationZ", format!("{} m/s2", robot.steepest[2])),
            ("maxAccelerationR", format!("{} rad/s2", robot.steepest[3])),
            ("arrivedTolerance", format!("{} m", robot.tolerance[0])),
            ("arrivedToleranceR", format!("{} rad", robot.tolerance[3])),
        ],
        Figures::Gripper(gripper) => vec![
            ("buildUpTime", format!("{} s", gripper.build_up)),
            ("releaseTime", format!("{} s", gripper.release)),
            ("alwaysSealed", "true".to_owned()),
        ],
        Figures::Servo { parameters: servo, .. } => vec![
            ("motion", "linear".to_owned()),
            ("mode", "position".to_owned()),
            ("M", format!("{} kg", servo.mass)),
            ("Fv", format!("{} N.s/m", servo.viscous)),
            ("positionGain", format!("{} 1/s", servo.position_gain)),
            ("velocityGain", format!("{} N.s/m", servo.velocity_gain)),
            ("forceLimit", format!("{} N", servo.force_limit)),
            ("load", "0 N".to_owned()),
        ],
        Figures::Motor { parameters: motor, .. } => vec![
            ("acceleration", format!("{} rad/s2", motor.acceleration)),
            ("countsPerRevolution", format!("{}", motor.counts)),
        ],
    }
}
