//! A bay, the world outside: a portal that parts come in by or go out by, with an arrow on its bar.

use super::{FRAME, PAINT, at};
use crate::kinematics::{DPose3, DQuat, DVec2, DVec3};
use crate::mesh::primitive::{cuboid, extrude};
use crate::scene::{Assembly, Colour, NodeId};

/// Which way parts go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    In,
    Out,
}

const IN: Colour = [70, 150, 90];

/// Builds one. It is no obstacle: what stands in the world outside is not modelled.
pub(super) fn build(assembly: &mut Assembly, node: NodeId, way: Way) {
    let portal = assembly.mesh("bay portal", |mesh| {
        for y in [-0.62, 0.62] {
            cuboid(mesh, DVec3::new(0.04, 0.04, 1.0), DVec3::new(0.0, y, 0.4));
        }
        cuboid(mesh, DVec3::new(0.04, 1.28, 0.04), DVec3::new(0.0, 0.0, 0.92));
    });
    assembly.shown(node, portal, DPose3::IDENTITY, FRAME);
    let arrow = assembly.mesh("bay arrow", |mesh| {
        let outline =
            [(-0.12, -0.05), (0.02, -0.05), (0.02, -0.12), (0.16, 0.0), (0.02, 0.12), (0.02, 0.05), (-0.12, 0.05)];
        extrude(mesh, &outline.map(|(x, y)| DVec2::new(x, y)), 0.012, &DPose3::IDENTITY);
    });
    let (down, colour) = match way {
        Way::In => (DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2), IN),
        Way::Out => (DQuat::from_rotation_y(-std::f64::consts::FRAC_PI_2), PAINT),
    };
    assembly.shown(node, arrow, at(0.0, 0.0, 1.1) * DPose3::from_rotation(down), colour);
}
