//! A pusher: a plate on two rods that a cylinder in a housing moves out along x.

use super::conveyor::barriers;
use super::part::leg;
use super::{BRIGHT, DRIVE, PAINT, at};
use crate::kinematics::Joint;
use crate::kinematics::{DPose3, DVec3};
use crate::mesh::primitive::{bar, cuboid};
use crate::plant::Parameters;
use crate::scene::{Assembly, NodeId};

/// The frame that slides, as the reference's example calls it.
const SLIDE: &str = "Spintore";

/// Builds one whose plate stands `height` above the floor.
pub(super) fn build(assembly: &mut Assembly, node: NodeId, own: &Parameters, height: f64) {
    let stroke = own.number("stroke");
    let size = DVec3::from_array(own.numbers("plateSize").try_into().unwrap_or([0.02, 0.5, 0.2]));
    let slide = assembly.frame(node, SLIDE, DPose3::IDENTITY, Joint::prismatic(DVec3::X, [0.0, stroke]));
    let plate = assembly.mesh(&format!("plate {size:?}"), |mesh| {
        cuboid(mesh, size, DVec3::new(-size.x / 2.0, 0.0, size.z / 2.0));
    });
    assembly.bearing(slide, plate, DPose3::IDENTITY, PAINT);
    let (reach, middle) = (stroke + 0.05, size.z * 0.5);
    let spread = size.y * 0.3;
    let rods = assembly.mesh(&format!("rods {stroke:.6} {size:?}"), |mesh| {
        for (y, radius) in [(-spread, 0.008), (0.0, 0.012), (spread, 0.008)] {
            let end = DVec3::new(-size.x, y, middle);
            bar(mesh, end - DVec3::new(reach, 0.0, 0.0), end, radius, 32);
        }
    });
    assembly.solid(slide, rods, DPose3::IDENTITY, BRIGHT);
    let housing = assembly.mesh(&format!("cylinder {stroke:.6} {size:?}"), |mesh| {
        let back = -size.x - reach - 0.03;
        let centre = DVec3::new((back - size.x) / 2.0 - 0.01, 0.0, middle);
        let length = -size.x - back - 0.02;
        cuboid(mesh, DVec3::new(length, 0.06, 0.06), centre);
        for y in [-spread, spread] {
            bar(mesh, DVec3::new(back, y, middle), DVec3::new(-size.x - 0.02, y, middle), 0.018, 32);
        }
        for x in [back + 0.01, -size.x - 0.03] {
            cuboid(mesh, DVec3::new(0.02, 2.0 * spread + 0.06, 0.08), DVec3::new(x, 0.0, middle));
        }
    });
    assembly.solid(node, housing, at(0.0, 0.0, 0.0), DRIVE);
    let under = middle - 0.04;
    for x in [-size.x - 0.06, -size.x - reach] {
        leg(assembly, node, DVec3::new(x, 0.0, under), height + under);
    }
    barriers(assembly, node, own, ["lightbarrierA", "lightbarrierB"], &|x, z| {
        [DVec3::new(x, size.y / 2.0, z), DVec3::new(x, -size.y / 2.0, z)]
    });
}
