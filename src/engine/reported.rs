//! Where a machine's reports put what is shown. Of a machine's recording the scene is the machine's and not the model's, as far as its
//! reports go.

use super::{Engine, PartState, UnitBody};
use crate::kinematics::{DPose3, DQuat, Upright};
use crate::scene::NodeId;
use crate::signal_map::RegisterId;
use crate::value::Value;

/// Beyond this a reported joint, m or rad, is no place but a fault of whoever reported it.
const FARTHEST: f64 = 1e9;

impl Engine {
    /// Puts the joints of the scene where `reports` have them, each register's last value so far, and gives the parts with those
    /// that hang from a gripper where it then is. What no report tells of is the model's: other parts, and joints without a
    /// sensor. Nothing that is computed depends on it. Where nothing is shown, the parts are the model's.
    pub fn show_reported<'a>(&mut self, reports: impl Fn(RegisterId) -> Option<&'a Value>) -> Vec<PartState> {
        let mut parts: Vec<PartState> = self.parts().collect();
        let Some(stage) = &mut self.stage else { return parts };
        let all: Vec<u32> = (0..self.units.len() as u32).collect();
        stage.follow(&self.units, &all);
        let hanging: Vec<(usize, NodeId, DPose3)> = self
            .units
            .iter()
            .filter_map(|unit| match unit.body {
                UnitBody::Cups(index, _) => {
                    let frame = stage.poses().scene().find(&unit.instance)?;
                    Some((index, frame, *stage.poses().world(frame)))
                }
                _ => None,
            })
            .collect();
        let mut said: Vec<Option<f64>> = Vec::new();
        for (index, unit) in self.units.iter().enumerate() {
            said.clear();
            said.resize(unit.ports, None);
            for port in &unit.reports {
                let number = reports(port.register).and_then(|value| port.number(value));
                said[port.port] = number.filter(|number| number.abs() < FARTHEST);
            }
            stage.pose(index, |visit| unit.device.reported_joints(&said, visit));
        }
        stage.resolve();
        for (cups, frame, before) in hanging {
            let shift = *stage.poses().world(frame) * before.inverse();
            let Some((slot, _)) = self.floor.cups[cups].held else { continue };
            self.floor.parts.visit_group(slot, &mut |_, held| {
                let Some(part) = parts.iter_mut().find(|part| part.number == held.number) else { return };
                let upright = held.block.upright();
                let pose = DPose3::from_parts(upright.place, DQuat::from_rotation_z(upright.yaw));
                let shifted = Upright::from_pose(&(shift * pose));
                (part.place, part.yaw) = (shifted.place.to_array(), shifted.yaw);
            });
        }
        parts
    }
}
