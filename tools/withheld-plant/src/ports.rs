//! What each kind of device takes and reports, in the order in which it reads.

use crate::plant::{Kind, Signal};

/// The commands of a device called `name`.
pub fn commands(name: &str, ports: &[(&str, Kind)]) -> Vec<(String, Kind)> {
    ports.iter().map(|(port, kind)| (format!("{name}.{port}"), *kind)).collect()
}

pub const BELT: &[(&str, Kind)] = &[("velocityTarget", Kind::Level), ("motorDirection", Kind::Code)];
pub const PUSHER: &[(&str, Kind)] = &[("command", Kind::Code)];
pub const ROBOT: &[(&str, Kind)] = &[
    ("XTarget", Kind::Level),
    ("YTarget", Kind::Level),
    ("ZTarget", Kind::Level),
    ("RTarget", Kind::Level),
    ("grip", Kind::Flag),
];
pub const GRIPPER: &[(&str, Kind)] = &[("suctionOn", Kind::Flag), ("blowOn", Kind::Flag)];
pub const SERVO: &[(&str, Kind)] = &[("positionTarget", Kind::Level)];
pub const MOTOR: &[(&str, Kind)] = &[("speedTarget", Kind::Level), ("enable", Kind::Flag)];

fn signal(name: &str, port: &str, kind: Kind, quantum: f64, sigma: f64) -> Signal {
    Signal { name: format!("{name}.{port}"), kind, quantum, sigma }
}

fn flags(name: &str, ports: &[&str]) -> Vec<Signal> {
    ports.iter().map(|port| signal(name, port, Kind::Flag, 0.0, 0.0)).collect()
}

fn level(name: &str, port: &str, quantum: f64, sigma: f64) -> Signal {
    signal(name, port, Kind::Level, quantum, sigma)
}

/// The reports of a belt called `name`.
pub fn belt(name: &str) -> Vec<Signal> {
    let mut all = vec![level(name, "velocityActual", 1e-3, 1e-3)];
    all.extend(flags(name, &["driveEnabled", "driveRunning"]));
    all.push(signal(name, "directionalActual", Kind::Code, 0.0, 0.0));
    all.extend(flags(name, &["lightBarrierA", "lightBarrierB"]));
    all
}

/// The reports of a pusher.
pub fn pusher(name: &str) -> Vec<Signal> {
    flags(name, &["limitExtended", "limitRetracted", "isRunning", "lightbarrierA", "lightbarrierB"])
}

/// The reports of a robot.
pub fn robot(name: &str) -> Vec<Signal> {
    let mut all = flags(name, &["cartesianArrived"]);
    all.extend(["X", "Y", "Z"].map(|axis| level(name, &format!("actualPos{axis}"), 5e-5, 2.5e-5)));
    all.push(level(name, "actualPosR", 5e-5, 3.5e-5));
    all
}

/// The report of a gripper.
pub fn gripper(name: &str) -> Vec<Signal> {
    flags(name, &["vacuumOn"])
}

/// The reports of a servo axis whose force is rounded to `newton`, N.
pub fn servo(name: &str, newton: f64) -> Vec<Signal> {
    vec![
        level(name, "position", 1e-5, 1.5e-5),
        level(name, "velocity", 1e-3, 1.5e-3),
        level(name, "force", newton, 3.0 * newton),
    ]
}

/// The reports of a motor.
pub fn motor(name: &str) -> Vec<Signal> {
    let mut all = vec![signal(name, "encoder", Kind::Count, 1.0, 0.0), level(name, "speedActual", 1e-2, 3e-2)];
    all.extend(flags(name, &["inverterReady"]));
    all
}
