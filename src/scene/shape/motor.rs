//! A motor on a foot, its shaft along x, with a disc that shows how it turns.

use super::part::motor;
use super::{BRIGHT, DRIVE, RUBBER};
use crate::kinematics::Joint;
use crate::kinematics::{DPose3, DVec3};
use crate::mesh::primitive::{along, bar, cuboid, lathe};
use crate::scene::{Assembly, NodeId};

/// The frame that turns.
const SHAFT: &str = "Shaft";

/// Builds one.
pub(super) fn build(assembly: &mut Assembly, node: NodeId) {
    let housing = assembly.mesh("motor", |mesh| {
        motor(mesh, &along(DVec3::ZERO, DVec3::new(-1.0, 0.0, 0.0)), 0.07, 0.28);
        cuboid(mesh, DVec3::new(0.16, 0.16, 0.012), DVec3::new(-0.11, 0.0, -0.09));
        for y in [-0.05, 0.05] {
            cuboid(mesh, DVec3::new(0.14, 0.012, 0.04), DVec3::new(-0.11, y, -0.066));
        }
        cuboid(mesh, DVec3::new(0.10, 0.08, 0.05), DVec3::new(-0.10, 0.0, 0.09));
    });
    assembly.solid(node, housing, DPose3::IDENTITY, DRIVE);
    let shaft = assembly.frame(node, SHAFT, DPose3::IDENTITY, Joint::endless(DVec3::X));
    let turning = assembly.mesh("motor shaft", |mesh| {
        let out = along(DVec3::ZERO, DVec3::X);
        lathe(mesh, &[[0.014, 0.0], [0.014, 0.06], [0.012, 0.062]], 40, &out);
        lathe(mesh, &[[0.03, 0.02], [0.05, 0.02], [0.05, 0.032], [0.03, 0.032]], 64, &out);
    });
    assembly.solid(shaft, turning, DPose3::IDENTITY, BRIGHT);
    let mark = assembly.mesh("motor mark", |mesh| {
        bar(mesh, DVec3::new(0.02, 0.0, 0.042), DVec3::new(0.034, 0.0, 0.042), 0.005, 16);
    });
    assembly.shown(shaft, mark, DPose3::IDENTITY, RUBBER);
}
