//! What many machines have in common: legs, rollers, lamps, geared motors.

use super::{BRIGHT, DRIVE, FRAME, LAMP, RUBBER, STEEL, at};
use crate::kinematics::{DPose3, DQuat, DVec2, DVec3};
use crate::mesh::outline::slotted;
use crate::mesh::primitive::{along, bar, cuboid, extrude, lathe};
use crate::scene::{Assembly, NodeId};

/// Side of the profiles that machine frames are made of, m.
pub(super) const PROFILE_M: f64 = 0.04;

/// A profile bar from `from` to `to`.
pub(super) fn profile(assembly: &mut Assembly, node: NodeId, from: DVec3, to: DVec3) {
    let length = (to - from).length();
    if length < 1e-3 {
        return;
    }
    let key = format!("profile {PROFILE_M} x {length:.6}");
    let mesh = assembly.mesh(&key, |mesh| extrude(mesh, &slotted(PROFILE_M, 0.008, 0.011), length, &DPose3::IDENTITY));
    assembly.solid(node, mesh, along(from, to), FRAME);
}

/// A leg with its levelling foot, from `top` down to the floor, which is `height` below it.
pub(super) fn leg(assembly: &mut Assembly, node: NodeId, top: DVec3, height: f64) {
    const FOOT_M: f64 = 0.07;
    if height <= FOOT_M {
        return;
    }
    let foot = top - DVec3::new(0.0, 0.0, height - FOOT_M);
    profile(assembly, node, foot, top);
    let mesh = assembly.mesh("levelling foot", |mesh| {
        let spindle = [[0.035, 0.0], [0.035, 0.008], [0.018, 0.02], [0.008, 0.022], [0.008, FOOT_M]];
        lathe(mesh, &spindle, 24, &DPose3::IDENTITY);
    });
    assembly.solid(node, mesh, DPose3::from_translation(foot - DVec3::new(0.0, 0.0, FOOT_M)), RUBBER);
}

/// Radius of the rollers that bear a belt, m.
pub(super) const ROLLER_M: f64 = 0.024;

/// A roller of `width` about the y axis of `place`: shell, end caps, shaft with its flats for the frame.
pub(super) fn roller(assembly: &mut Assembly, node: NodeId, width: f64, place: DPose3) {
    let mesh = assembly.mesh(&format!("roller {width:.6}"), |mesh| {
        let (half, shaft) = (width / 2.0, 0.006);
        let end = half + 0.012;
        let profile = [
            [shaft, -end],
            [shaft, -half - 0.002],
            [ROLLER_M * 0.55, -half - 0.002],
            [ROLLER_M * 0.55, -half],
            [ROLLER_M * 0.9, -half],
            [ROLLER_M, -half + 0.003],
            [ROLLER_M, half - 0.003],
            [ROLLER_M * 0.9, half],
            [ROLLER_M * 0.55, half],
            [ROLLER_M * 0.55, half + 0.002],
            [shaft, half + 0.002],
            [shaft, end],
        ];
        lathe(mesh, &profile, 28, &lying());
    });
    assembly.shown(node, mesh, place, BRIGHT);
}

/// A pulley of `radius` and `width` about the y axis of `place`.
pub(super) fn pulley(assembly: &mut Assembly, node: NodeId, radius: f64, width: f64, place: DPose3) {
    let mesh = assembly.mesh(&format!("pulley {radius:.6} x {width:.6}"), |mesh| {
        let (half, shaft) = (width / 2.0, radius * 0.3);
        let rim = radius * 0.98;
        let profile = [
            [shaft, -half - 0.03],
            [shaft, -half],
            [rim, -half],
            // Crowned, so that the belt stays in its middle.
            [radius, -half / 3.0],
            [radius, half / 3.0],
            [rim, half],
            [shaft, half],
            [shaft, half + 0.03],
        ];
        lathe(mesh, &profile, 48, &lying());
    });
    assembly.shown(node, mesh, place, STEEL);
}

/// A lathe's axis along y.
fn lying() -> DPose3 {
    DPose3::from_rotation(DQuat::from_rotation_x(-std::f64::consts::FRAC_PI_2))
}

/// A geared motor whose output shaft points along y of `place`.
pub(super) fn geared_motor(assembly: &mut Assembly, node: NodeId, place: DPose3) {
    let mesh = assembly.mesh("geared motor", |mesh| {
        cuboid(mesh, DVec3::new(0.11, 0.10, 0.13), DVec3::new(0.0, -0.05, 0.0));
        bar(mesh, DVec3::ZERO, DVec3::new(0.0, 0.03, 0.0), 0.012, 24);
        motor(mesh, &along(DVec3::new(0.055, -0.05, 0.0), DVec3::new(1.0, -0.05, 0.0)), 0.055, 0.20);
    });
    assembly.solid(node, mesh, place, DRIVE);
}

/// Adds a motor with cooling ribs of `radius` and `length` along the z of `base`.
pub(super) fn motor(mesh: &mut crate::mesh::Mesh, base: &DPose3, radius: f64, length: f64) {
    const RIBS: usize = 36;
    let outline: Vec<DVec2> = (0..RIBS * 4)
        .map(|index| {
            let reach = if index % 4 < 2 { radius } else { radius * 0.9 };
            DVec2::from_angle(std::f64::consts::TAU * index as f64 / (RIBS * 4) as f64) * reach
        })
        .collect();
    extrude(mesh, &outline, length * 0.75, base);
    let cowl = *base * at(0.0, 0.0, length * 0.75);
    lathe(mesh, &[[radius, 0.0], [radius, length * 0.2], [radius * 0.8, length * 0.25]], 48, &cowl);
}

/// The lamp and the receiver of a light barrier at the `ends` of its beam, on brackets from `below` the beam.
pub(super) fn barrier(assembly: &mut Assembly, node: NodeId, ends: [DVec3; 2], below: f64) {
    let [lamp, receiver] = ends;
    for (end, other) in [(lamp, receiver), (receiver, lamp)] {
        let out = (end - other).normalize_or(DVec3::Y);
        let housing = assembly.mesh("barrier housing", |mesh| {
            cuboid(mesh, DVec3::new(0.02, 0.034, 0.012), DVec3::new(0.0, 0.0, -0.006));
            lathe(mesh, &[[0.006, 0.0], [0.0045, 0.002]], 20, &DPose3::IDENTITY);
        });
        // Its lens looks along the beam.
        assembly.shown(node, housing, along(end + out * 0.022, other), LAMP);
        let foot = DVec3::new(end.x, end.y, end.z - below) + out * 0.028;
        let bracket = assembly.mesh(&format!("bracket {below:.6}"), |mesh| {
            cuboid(mesh, DVec3::new(0.012, 0.003, below), DVec3::new(0.0, 0.0, below / 2.0));
        });
        let heading = DQuat::from_rotation_arc(DVec3::Y, out);
        assembly.shown(node, bracket, DPose3::from_parts(foot, heading), STEEL);
    }
}
