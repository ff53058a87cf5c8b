//! A straight belt conveyor: an endless belt about two pulleys, rollers that bear it, side plates, legs, a geared motor.

use super::part::{PROFILE_M, ROLLER_M, barrier, geared_motor, leg, profile, pulley, roller};
use super::{BELT, FRAME, at};
use crate::kinematics::{DPose3, DQuat, DVec3};
use crate::mesh::outline::stadium;
use crate::mesh::primitive::{cuboid, tube};
use crate::plant::Parameters;
use crate::scene::{Assembly, NodeId};

/// Thickness of a belt, m.
pub(super) const THICKNESS_M: f64 = 0.003;
/// Radius of the belt's path about its pulleys, m.
const TURN_M: f64 = 0.05;
/// Room between the belt and the plates beside it, m.
const BESIDE_M: f64 = 0.012;
/// How far below the belt's surface the frame begins: what is pushed across a belt passes over it, m.
const BELOW_M: f64 = 0.006;
/// Height of the side plates, m.
pub(super) const PLATE_M: f64 = 0.10;
/// From roller to roller, m.
pub(super) const PITCH_M: f64 = 0.10;
/// From leg to leg, at most, m.
pub(super) const SPAN_M: f64 = 1.5;

/// Builds one whose surface is `height` above the floor.
pub(super) fn build(assembly: &mut Assembly, node: NodeId, own: &Parameters, height: f64) {
    let (length, width) = (own.number("length"), own.number("width"));
    let turn = TURN_M.min(length / 4.0);
    belt(assembly, node, length, width, turn);
    for x in [turn, length - turn] {
        pulley(assembly, node, turn - THICKNESS_M, width, at(x, 0.0, -turn));
    }
    let rollers = ((length - 4.0 * turn) / PITCH_M).floor().max(0.0) as usize;
    for index in 0..rollers {
        let x = 2.0 * turn + (index as f64 + 0.5) * (length - 4.0 * turn) / rollers as f64;
        roller(assembly, node, width, at(x, 0.0, -THICKNESS_M - ROLLER_M));
    }
    let side = width / 2.0 + BESIDE_M;
    let plate = assembly.mesh(&format!("side plate {length:.6}"), |mesh| {
        let web = DVec3::new(length, 0.003, PLATE_M);
        cuboid(mesh, web, DVec3::new(length / 2.0, 0.0015, -PLATE_M / 2.0));
        for z in [-0.0015, -PLATE_M + 0.0015] {
            cuboid(mesh, DVec3::new(length, 0.022, 0.003), DVec3::new(length / 2.0, 0.014, z));
        }
    });
    let turned = DQuat::from_rotation_z(std::f64::consts::PI);
    assembly.solid(node, plate, at(0.0, side, -BELOW_M), FRAME);
    assembly.solid(node, plate, DPose3::from_parts(DVec3::new(length, -side, -BELOW_M), turned), FRAME);
    stand(assembly, node, length, side, height);
    geared_motor(assembly, node, at(length - turn, -side - 0.03, -turn - BELOW_M - 0.04));
    barriers(assembly, node, own, ["lightBarrierA", "lightBarrierB"], &|station, z| {
        [DVec3::new(station, width / 2.0, z), DVec3::new(station, -width / 2.0, z)]
    });
}

fn belt(assembly: &mut Assembly, node: NodeId, length: f64, width: f64, turn: f64) {
    let reach = length - 2.0 * turn;
    let mesh = assembly.mesh(&format!("belt {length:.6} x {width:.6}"), |mesh| {
        let across = DPose3::from_parts(
            DVec3::new(length / 2.0, width / 2.0, -turn),
            DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2),
        );
        tube(mesh, &stadium(reach, turn, 24), &stadium(reach, turn - THICKNESS_M, 24), width, &across);
    });
    assembly.bearing(node, mesh, DPose3::IDENTITY, BELT);
}

/// Legs in pairs, joined across and along.
fn stand(assembly: &mut Assembly, node: NodeId, length: f64, side: f64, height: f64) {
    let top = BELOW_M + PLATE_M;
    let pairs = (length / SPAN_M).ceil().max(1.0) as usize + 1;
    let inset = 0.12_f64.min(length / 4.0);
    let reach = side - PROFILE_M / 2.0;
    let low = -(height - 0.15);
    for index in 0..pairs {
        let x = inset + (length - 2.0 * inset) * index as f64 / (pairs - 1) as f64;
        for y in [reach, -reach] {
            leg(assembly, node, DVec3::new(x, y, -top), height - top);
        }
        let inner = reach - PROFILE_M / 2.0;
        profile(assembly, node, DVec3::new(x, -inner, -top - PROFILE_M), DVec3::new(x, inner, -top - PROFILE_M));
        if low < -top - 2.0 * PROFILE_M {
            profile(assembly, node, DVec3::new(x, -inner, low), DVec3::new(x, inner, low));
        }
    }
}

/// Two light barriers with the parameters `barrierA`, `barrierB` and `beamHeight`; `ends` says where the beam at a station and
/// a height ends.
pub(super) fn barriers(
    assembly: &mut Assembly,
    node: NodeId,
    own: &Parameters,
    reports: [&str; 2],
    ends: &dyn Fn(f64, f64) -> [DVec3; 2],
) {
    let height = own.number("beamHeight");
    for (parameter, report) in ["barrierA", "barrierB"].into_iter().zip(reports) {
        let station = own.number(parameter);
        if station >= 0.0 {
            let ends = ends(station, height);
            barrier(assembly, node, ends, height + 0.03);
            assembly.beam(node, report, ends);
        }
    }
}
