//! A curved belt conveyor: a flat belt in a ring sector, tapered in its bend, on rollers, between two arcs of plate.

use std::f64::consts::PI;

use super::conveyor::{PITCH_M, PLATE_M, SPAN_M, THICKNESS_M, barriers};
use super::part::{ROLLER_M, geared_motor, leg, roller};
use super::{BELT, FRAME};
use crate::kinematics::{DPose3, DQuat, DVec2};
use crate::mesh::primitive::sector;
use crate::plant::Parameters;
use crate::scene::{Assembly, NodeId};

/// Corners per radian of an arc: its outer edge is off by less than a millimetre at 1.5 m.
const FINENESS: f64 = 40.0;

/// Builds one whose surface is `height` above the floor.
pub(super) fn build(assembly: &mut Assembly, node: NodeId, own: &Parameters, height: f64) {
    let (radius, angle, width) = (own.number("radius"), own.number("angle"), own.number("width"));
    let turn = angle.signum();
    let pivot = DVec2::new(0.0, radius * turn);
    let start = -turn * PI / 2.0;
    let count = (angle.abs() * FINENESS).ceil().max(2.0) as usize;
    let key = format!("{radius:.6} x {angle:.6} x {width:.6}");
    let (inner, outer) = (radius - width / 2.0, radius + width / 2.0);
    let belt = assembly.mesh(&format!("curved belt {key}"), |mesh| {
        for top in [0.0, -2.0 * ROLLER_M - THICKNESS_M] {
            sector(mesh, pivot, [inner, outer], [top - THICKNESS_M, top], [start, angle], count);
        }
    });
    assembly.bearing(node, belt, DPose3::IDENTITY, BELT);
    let plates = assembly.mesh(&format!("curved plates {key}"), |mesh| {
        for from in [inner - 0.015, outer + 0.012] {
            sector(mesh, pivot, [from, from + 0.003], [-0.006 - PLATE_M, -0.006], [start, angle], count);
        }
    });
    assembly.solid(node, plates, DPose3::IDENTITY, FRAME);

    // A place at `part` of the arc, `offset` to the left of its centre line.
    let place = |part: f64, offset: f64, z: f64| {
        let direction = DVec2::from_angle(start + angle * part);
        (pivot + direction * (radius - offset * turn)).extend(z)
    };
    let heading = |part: f64| DQuat::from_rotation_z(angle * part);
    let rollers = (radius * angle.abs() / PITCH_M).floor().max(1.0) as usize;
    for index in 0..rollers {
        let part = (index as f64 + 0.5) / rollers as f64;
        let pose = DPose3::from_parts(place(part, 0.0, -THICKNESS_M - ROLLER_M), heading(part));
        roller(assembly, node, width, pose);
    }
    let pairs = (outer * angle.abs() / SPAN_M).ceil().max(1.0) as usize + 1;
    for index in 0..pairs {
        let part = 0.08 + 0.84 * index as f64 / (pairs - 1) as f64;
        for offset in [width / 2.0 + 0.034, -width / 2.0 - 0.034] {
            leg(assembly, node, place(part, offset, -0.006 - PLATE_M), height - 0.006 - PLATE_M);
        }
    }
    let drive = DPose3::from_parts(place(0.5, -turn * (width / 2.0 + 0.05), -0.09), heading(0.5));
    let outwards = if turn > 0.0 { DQuat::IDENTITY } else { DQuat::from_rotation_z(PI) };
    geared_motor(assembly, node, drive * DPose3::from_rotation(outwards));
    barriers(assembly, node, own, ["lightBarrierA", "lightBarrierB"], &|station, z| {
        let part = station / (radius * angle.abs());
        [place(part, width / 2.0, z), place(part, -width / 2.0, z)]
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_turn_as_their_surfaces_do() {
        use crate::kinematics::{Shape, Surface};
        for angle in [1.2, -0.7] {
            let surface = Surface::new(Shape::Curve { radius: 0.8, angle, width: 0.6 }, &DPose3::IDENTITY);
            let [left, right] = surface.beam(0.5, 0.05).ends();
            let turn = f64::signum(angle);
            let direction = DVec2::from_angle(-turn * PI / 2.0 + 0.5 / 0.8 * turn);
            let place = |offset: f64| (DVec2::new(0.0, 0.8 * turn) + direction * (0.8 - offset * turn)).extend(0.05);
            assert!((place(0.3) - left).length() < 1e-12 && (place(-0.3) - right).length() < 1e-12);
        }
    }
}
