//! A suction gripper: a plate below the tool with bellows cups, whose rims are where the cups' frame is.

use super::{PAINT, RUBBER, STEEL, at};
use crate::kinematics::Joint;
use crate::kinematics::{DPose3, DQuat, DVec3};
use crate::mesh::primitive::{bar, cuboid, lathe};
use crate::plant::Parameters;
use crate::scene::{Assembly, NodeId};

/// The frame of the cups' rim.
const RIM: &str = "Rim";
/// Height of a cup with its stem, m.
const CUP_M: f64 = 0.055;
/// From cup to cup, m.
const SPREAD: [f64; 2] = [0.11, 0.09];

/// Builds one.
pub(super) fn build(assembly: &mut Assembly, node: NodeId, own: &Parameters) {
    let offset = DVec3::from_array(own.numbers("cupOffset").try_into().unwrap_or_default());
    let rim = assembly.frame(node, RIM, DPose3::from_translation(offset), Joint::FIXED);
    let plate = assembly.mesh("gripper plate", |mesh| {
        cuboid(mesh, DVec3::new(SPREAD[0] + 0.05, SPREAD[1] + 0.05, 0.012), DVec3::new(0.0, 0.0, CUP_M + 0.006));
        cuboid(mesh, DVec3::new(0.05, 0.04, 0.03), DVec3::new(0.0, 0.0, CUP_M + 0.027));
    });
    assembly.solid(rim, plate, DPose3::IDENTITY, PAINT);
    let cup = assembly.mesh("bellows cup", bellows);
    for x in [-SPREAD[0] / 2.0, SPREAD[0] / 2.0] {
        for y in [-SPREAD[1] / 2.0, SPREAD[1] / 2.0] {
            // Cups give: they are no obstacle to what they hold.
            assembly.shown(rim, cup, at(x, y, 0.0), RUBBER);
        }
    }
    let end = offset + DVec3::new(0.0, 0.0, CUP_M + 0.03);
    let knee = DVec3::new(0.0, 0.0, end.z);
    if (end - knee).length() < 1e-3 && end.z > -1e-3 {
        return;
    }
    let arm = assembly.mesh(&format!("arm {:.6} {:.6} {:.6}", offset.x, offset.y, offset.z), |mesh| {
        for (from, to, radius) in [(knee, end, 0.012), (knee, DVec3::ZERO, 0.016)] {
            if (to - from).length() > 1e-3 {
                bar(mesh, from, to, radius, 24);
            }
        }
    });
    assembly.solid(node, arm, DPose3::IDENTITY, STEEL);
}

/// A cup of 40 mm with two and a half folds, its rim at z = 0.
fn bellows(mesh: &mut crate::mesh::Mesh) {
    let (lip, fold, stem) = (0.020, 0.017, 0.012);
    let outside = [
        [lip - 0.001, 0.0],
        [lip, 0.001],
        [stem, 0.010],
        [fold, 0.016],
        [stem, 0.022],
        [fold, 0.028],
        [stem, 0.034],
        [0.008, 0.036],
        [0.008, CUP_M],
    ];
    lathe(mesh, &outside, 48, &DPose3::from_rotation(DQuat::IDENTITY));
}
