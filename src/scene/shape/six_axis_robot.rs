//! An arm: a column, two long tubes, three short ones, each joint a housing about its axis.

use std::f64::consts::PI;

use super::{BRIGHT, DRIVE, STEEL, at};
use crate::kinematics::{DPose3, DQuat, DVec3, DenavitHartenberg};
use crate::mesh::Mesh;
use crate::mesh::primitive::{along, bar, lathe};
use crate::plant::Parameters;
use crate::scene::{Assembly, NodeId};

/// The frame that a tool hangs on: the flange, turned so that it points up while that looks down.
pub(super) const TOOL: &str = "Tool";

const NAMES: [&str; 6] = ["J1", "J2", "J3", "J4", "J5", "J6"];
/// Radius of each joint's housing in an arm that reaches 1 m, m.
const RADII: [f64; 6] = [0.075, 0.075, 0.06, 0.045, 0.045, 0.04];

/// Builds one.
pub(super) fn build(assembly: &mut Assembly, node: NodeId, own: &Parameters) {
    let [a, d, alpha] = ["a", "d", "alpha"].map(|name| own.numbers(name));
    let limits = ["jointLow", "jointHigh"].map(|name| own.numbers(name));
    let (links, flange) = DenavitHartenberg { a, d, alpha, limits }.links();
    let reach: f64 = a.iter().chain(d).map(|side| side.abs()).sum();
    let base = DVec3::from_slice(own.numbers("basePlace"));
    let foot = assembly.mesh(&format!("arm foot {reach:.6}"), |mesh| {
        let radius = RADII[0] * reach;
        lathe(mesh, &[[1.2 * radius, 0.0], [1.2 * radius, 0.02], [radius, 0.03]], 64, &DPose3::IDENTITY);
    });
    let mut parent = assembly.frame(node, "Base", DPose3::from_translation(base), crate::kinematics::Joint::FIXED);
    assembly.solid(parent, foot, DPose3::IDENTITY, STEEL);
    let mut next = links.iter().skip(1).map(|(rest, _)| *rest).chain([flange]);
    for (joint, (rest, law)) in links.iter().enumerate() {
        parent = assembly.frame(parent, NAMES[joint], *rest, *law);
        let end = next.next().unwrap_or_default().translation;
        let radius = RADII[joint] * reach;
        let mesh = assembly.mesh(&format!("arm {reach:.6} {joint} {end:.6}"), |mesh| link(mesh, radius, end));
        assembly.solid(parent, mesh, DPose3::IDENTITY, if joint % 2 == 0 { DRIVE } else { BRIGHT });
    }
    let turned = flange * DPose3::from_rotation(DQuat::from_rotation_x(PI));
    assembly.frame(parent, TOOL, turned, crate::kinematics::Joint::FIXED);
}

/// A housing about the joint's z axis, and the tube to where the next joint is.
fn link(mesh: &mut Mesh, radius: f64, end: DVec3) {
    let rounded = [[0.8, -0.9], [0.95, -0.8], [1.0, -0.6], [1.0, 0.6], [0.95, 0.8], [0.8, 0.9]];
    let housing = rounded.map(|[r, z]| [r * radius, z * radius]);
    lathe(mesh, &housing, 64, &DPose3::IDENTITY);
    if end.length() > 2.0 * radius {
        bar(mesh, DVec3::ZERO, end, 0.7 * radius, 48);
    } else if end.length() > 1e-6 {
        let collar = [[0.75 * radius, 0.0], [0.75 * radius, end.length()]];
        lathe(mesh, &collar, 48, &(at(0.0, 0.0, 0.0) * along(DVec3::ZERO, end)));
    }
}
