//! Sensors that look at parts: a housing, a lens, and a frame of thin bars about what a box sensor sees.

use super::{LAMP, STEEL, at};
use crate::kinematics::{DPose3, DVec3};
use crate::mesh::primitive::{along, bar, cuboid, lathe};
use crate::plant::Parameters;
use crate::scene::{Assembly, NodeId};

/// Builds one that looks along x.
pub(super) fn ray(assembly: &mut Assembly, node: NodeId) {
    let housing = assembly.mesh("proximity sensor", |mesh| {
        lathe(mesh, &[[0.009, -0.06], [0.009, -0.002], [0.007, 0.0]], 32, &along(DVec3::ZERO, DVec3::X));
    });
    assembly.shown(node, housing, DPose3::IDENTITY, STEEL);
}

/// Builds one that looks into a box.
pub(super) fn window(assembly: &mut Assembly, node: NodeId, own: &Parameters) {
    let triple = |name: &str| DVec3::from_array(own.numbers(name).try_into().unwrap_or([0.1; 3]));
    let (centre, half) = (triple("boxPosition"), triple("boxDimensions") / 2.0);
    let frame = assembly.mesh(&format!("window {:.6} {:.6} {:.6}", half.x, half.y, half.z), |mesh| {
        for (one, two, axis) in
            [(DVec3::Y, DVec3::Z, DVec3::X), (DVec3::X, DVec3::Z, DVec3::Y), (DVec3::X, DVec3::Y, DVec3::Z)]
        {
            for (a, b) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
                let side = (one * a + two * b) * half;
                bar(mesh, side - axis * half, side + axis * half, 0.001, 6);
            }
        }
    });
    assembly.shown(node, frame, DPose3::from_translation(centre), LAMP);
    let housing = assembly.mesh("vision sensor", |mesh| {
        cuboid(mesh, DVec3::new(0.05, 0.05, 0.03), DVec3::ZERO);
        lathe(mesh, &[[0.012, -0.03], [0.012, -0.015], [0.01, -0.012]], 32, &DPose3::IDENTITY);
    });
    assembly.shown(node, housing, at(centre.x, centre.y, centre.z + half.z + 0.1), STEEL);
}
