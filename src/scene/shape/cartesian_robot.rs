//! A gantry: two rails on portals, a bridge that runs along them (X), a carriage on it (Y), a mast in the carriage (Z), and a
//! flange that turns (R).

use super::part::{leg, motor, profile};
use super::{BRIGHT, DRIVE, FRAME, PAINT, at, vector};
use crate::kinematics::Joint;
use crate::kinematics::{DPose3, DQuat, DVec3};
use crate::mesh::primitive::{cuboid, lathe};
use crate::plant::Instance;
use crate::scene::{Assembly, NodeId};

/// The frame that a tool hangs on.
pub(super) const TOOL: &str = "R";

/// Of the rails' upper side above the zero of the axes, m.
const RAIL_M: f64 = 0.30;

/// Builds one. Its working space, from `workspaceLow` to `workspaceHigh`, is where its rails end.
pub(super) fn build(assembly: &mut Assembly, node: NodeId, instance: &Instance) {
    let low = vector(instance, "workspaceLow").unwrap_or(DVec3::new(-0.8, -0.5, -1.2));
    let high = vector(instance, "workspaceHigh").unwrap_or(DVec3::new(0.8, 1.7, 0.1));
    let slide = |axis: DVec3| {
        let limits = [axis.dot(low), axis.dot(high)];
        Joint::prismatic(axis, limits)
    };
    let x = assembly.frame(node, "X", DPose3::IDENTITY, slide(DVec3::X));
    let y = assembly.frame(x, "Y", DPose3::IDENTITY, slide(DVec3::Y));
    let z = assembly.frame(y, "Z", DPose3::IDENTITY, slide(DVec3::Z));
    let tool = assembly.frame(z, TOOL, DPose3::IDENTITY, Joint::endless(DVec3::Z));
    portals(assembly, node, low, high, instance.pose.z);
    bridge(assembly, x, low, high);
    carriage(assembly, y);
    mast(assembly, z, high.z - low.z);
    let flange = assembly.mesh("flange", |mesh| {
        lathe(
            mesh,
            &[[0.03, -0.05], [0.045, -0.05], [0.045, -0.035], [0.03, -0.03], [0.03, 0.0]],
            40,
            &at(0.0, 0.0, 0.05),
        );
    });
    assembly.solid(tool, flange, DPose3::IDENTITY, BRIGHT);
}

/// How far beyond the working space the rails reach, m.
const BEYOND_M: f64 = 0.15;

fn portals(assembly: &mut Assembly, node: NodeId, low: DVec3, high: DVec3, height: f64) {
    let length = high.x - low.x + 2.0 * BEYOND_M;
    let rail = assembly.mesh(&format!("rail {length:.6}"), |mesh| {
        cuboid(mesh, DVec3::new(length, 0.08, 0.12), DVec3::new(length / 2.0, 0.0, -0.06));
        cuboid(mesh, DVec3::new(length, 0.02, 0.015), DVec3::new(length / 2.0, 0.0, 0.0075));
    });
    for y in [low.y - BEYOND_M, high.y + BEYOND_M] {
        assembly.solid(node, rail, at(low.x - BEYOND_M, y, RAIL_M - 0.015), FRAME);
        for x in [low.x - BEYOND_M + 0.05, high.x + BEYOND_M - 0.05] {
            leg(assembly, node, DVec3::new(x, y, RAIL_M - 0.135), height + RAIL_M - 0.135);
        }
    }
    for x in [low.x - BEYOND_M + 0.05, high.x + BEYOND_M - 0.05] {
        let end = |y: f64| DVec3::new(x, y, RAIL_M - 0.155);
        profile(assembly, node, end(low.y - BEYOND_M + 0.04), end(high.y + BEYOND_M - 0.04));
    }
}

fn bridge(assembly: &mut Assembly, x: NodeId, low: DVec3, high: DVec3) {
    let length = high.y - low.y + 2.0 * BEYOND_M;
    let bridge = assembly.mesh(&format!("bridge {length:.6}"), |mesh| {
        let centre = DVec3::new(0.0, length / 2.0, 0.10);
        for side in [-0.11, 0.11] {
            cuboid(mesh, DVec3::new(0.08, length, 0.12), centre + DVec3::new(side, 0.0, 0.0));
            cuboid(mesh, DVec3::new(0.02, length, 0.015), centre + DVec3::new(side, 0.0, 0.0675));
        }
        for y in [0.0, length] {
            cuboid(mesh, DVec3::new(0.34, 0.12, 0.04), DVec3::new(0.0, y, 0.02));
        }
        motor(mesh, &DPose3::from_parts(DVec3::new(0.0, 0.0, 0.04), DQuat::IDENTITY), 0.05, 0.22);
    });
    assembly.solid(x, bridge, at(0.0, low.y - BEYOND_M, RAIL_M), PAINT);
}

fn carriage(assembly: &mut Assembly, y: NodeId) {
    let carriage = assembly.mesh("carriage", |mesh| {
        // A frame about the mast, which passes between the bridge's two beams.
        for side in [-0.11, 0.11] {
            cuboid(mesh, DVec3::new(0.10, 0.24, 0.03), DVec3::new(side, 0.0, 0.195));
        }
        for side in [-0.085, 0.085] {
            cuboid(mesh, DVec3::new(0.32, 0.06, 0.05), DVec3::new(0.0, side, 0.235));
        }
        motor(mesh, &at(-0.11, 0.06, 0.26), 0.04, 0.18);
        motor(mesh, &at(0.11, -0.06, 0.26), 0.04, 0.18);
    });
    assembly.solid(y, carriage, at(0.0, 0.0, RAIL_M), DRIVE);
}

fn mast(assembly: &mut Assembly, z: NodeId, travel: f64) {
    let length = travel + 0.65;
    let mast = assembly.mesh(&format!("mast {length:.6}"), |mesh| {
        cuboid(mesh, DVec3::new(0.09, 0.09, length), DVec3::new(0.0, 0.0, 0.05 + length / 2.0));
        for side in [-0.05, 0.05] {
            cuboid(mesh, DVec3::new(0.01, 0.02, length), DVec3::new(side, 0.0, 0.05 + length / 2.0));
        }
    });
    assembly.solid(z, mast, DPose3::IDENTITY, BRIGHT);
}
