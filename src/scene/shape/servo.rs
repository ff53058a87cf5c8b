//! A servo axis: a carriage on a rail along x where it is linear, an arm that hangs from a motor where it is rotary.

use super::part::motor;
use super::{BRIGHT, DRIVE, FRAME, PAINT};
use crate::kinematics::Joint;
use crate::kinematics::{DPose3, DVec3};
use crate::mesh::primitive::{along, bar, cuboid, lathe};
use crate::plant::Parameters;
use crate::scene::{Assembly, NodeId};

/// Builds one.
pub(super) fn build(assembly: &mut Assembly, node: NodeId, own: &Parameters) {
    if own.text("motion") == "rotary" { rotary(assembly, node, own) } else { linear(assembly, node) }
}

/// The frame is `Slide`.
fn linear(assembly: &mut Assembly, node: NodeId) {
    let rail = assembly.mesh("servo rail", |mesh| {
        cuboid(mesh, DVec3::new(1.4, 0.12, 0.06), DVec3::new(0.5, 0.0, -0.03));
        for y in [-0.04, 0.04] {
            cuboid(mesh, DVec3::new(1.36, 0.02, 0.02), DVec3::new(0.5, y, 0.01));
        }
        motor(mesh, &along(DVec3::new(-0.2, 0.0, 0.01), DVec3::new(-1.0, 0.0, 0.01)), 0.045, 0.2);
        bar(mesh, DVec3::new(-0.2, 0.0, 0.012), DVec3::new(1.18, 0.0, 0.012), 0.008, 24);
    });
    assembly.solid(node, rail, DPose3::IDENTITY, FRAME);
    let endless = Joint::prismatic(DVec3::X, [f64::NEG_INFINITY, f64::INFINITY]);
    let slide = assembly.frame(node, "Slide", DPose3::IDENTITY, endless);
    let carriage = assembly.mesh("servo carriage", |mesh| {
        cuboid(mesh, DVec3::new(0.14, 0.14, 0.03), DVec3::new(0.0, 0.0, 0.045));
    });
    assembly.solid(slide, carriage, DPose3::IDENTITY, PAINT);
}

/// The frame is `Shaft`: it turns about y, its arm hangs straight down at 0 and rises towards x.
fn rotary(assembly: &mut Assembly, node: NodeId, own: &Parameters) {
    let housing = assembly.mesh("servo motor", |mesh| {
        motor(mesh, &along(DVec3::new(0.0, 0.02, 0.0), DVec3::new(0.0, 1.0, 0.0)), 0.045, 0.2);
        cuboid(mesh, DVec3::new(0.11, 0.02, 0.11), DVec3::new(0.0, 0.012, 0.0));
    });
    assembly.solid(node, housing, DPose3::IDENTITY, DRIVE);
    let shaft = assembly.frame(node, "Shaft", DPose3::IDENTITY, Joint::endless(DVec3::NEG_Y));
    let length = if own.number("pendulumMass") > 0.0 { own.number("pendulumLength") } else { 0.15 };
    let arm = assembly.mesh(&format!("servo arm {length:.6}"), |mesh| {
        let out = along(DVec3::ZERO, DVec3::NEG_Y);
        lathe(mesh, &[[0.02, -0.005], [0.02, 0.02]], 40, &out);
        let end = DVec3::new(0.0, -0.012, -length);
        bar(mesh, DVec3::new(0.0, -0.012, 0.0), end, 0.006, 20);
        let weight = along(end + DVec3::new(0.0, 0.012, 0.0), end - DVec3::Y);
        lathe(mesh, &[[0.022, 0.0], [0.022, 0.024]], 40, &weight);
    });
    assembly.solid(shaft, arm, DPose3::IDENTITY, BRIGHT);
}
