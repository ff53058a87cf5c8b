//! Chains of joints: where the last frame is for given joints, and the joints for where it is to be.

use nalgebra::{DMatrix, DVector, Matrix6, Vector6};

use super::{DPose3, DVec3, Joint, JointKind};

/// Joints one behind the other, from a base to a tip.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// Of each joint, where it stands at rest in what the one before it moves.
    links: Vec<(DPose3, Joint)>,
    /// Where the tip is in what the last joint moves.
    tip: DPose3,
}

/// No joints bring the tip to where it is to be.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "the goal is out of reach: the nearest that was found is {:.1} mm and {:.2} deg off",
    distance * 1e3,
    angle.to_degrees()
)]
pub struct OutOfReach {
    /// How far the nearest pose that was found is from the goal, m.
    pub distance: f64,
    /// How far it is turned from it, rad.
    pub angle: f64,
}

/// How near the tip has to come, m and rad.
const NEAR: f64 = 1e-9;
/// Steps from one start, and starts.
const MOST_STEPS: u32 = 200;
const MOST_STARTS: u32 = 40;
/// What keeps a step finite where the chain is singular, beside the error itself.
const DAMPING: f64 = 1e-6;

impl Chain {
    /// A chain of `joints`, each where it stands at rest in what the one before it moves, with `tip` in what the last one moves.
    /// What is fixed counts as part of what it is fixed to.
    pub fn new(joints: impl IntoIterator<Item = (DPose3, Joint)>, tip: DPose3) -> Chain {
        let mut links = Vec::new();
        let mut fixed = DPose3::IDENTITY;
        for (rest, joint) in joints {
            fixed *= rest;
            if joint.kind != JointKind::Fixed {
                links.push((fixed, joint));
                fixed = DPose3::IDENTITY;
            }
        }
        Chain { links, tip: fixed * tip }
    }

    /// The joints, from the base to the tip.
    pub fn joints(&self) -> impl ExactSizeIterator<Item = &Joint> {
        self.links.iter().map(|(_, joint)| joint)
    }

    /// Where the tip is in the base's frame while the joints have these values (m or rad), one for each.
    ///
    /// T = Π rest · motion(value), then the tip: the product of exponentials, joint by joint.
    pub fn forward(&self, values: &[f64]) -> DPose3 {
        let links = self.links.iter().zip(values);
        links.fold(DPose3::IDENTITY, |pose, ((rest, joint), value)| pose * *rest * joint.motion(*value)) * self.tip
    }

    /// How the tip moves with each joint: for each, its velocity (m/s) and its angular velocity (rad/s) in the base's frame for
    /// a joint's speed of 1.
    pub fn jacobian(&self, values: &[f64]) -> Vec<[DVec3; 2]> {
        let tip = self.forward(values).translation;
        let mut pose = DPose3::IDENTITY;
        let mut columns = Vec::with_capacity(self.links.len());
        for ((rest, joint), value) in self.links.iter().zip(values) {
            pose *= *rest;
            let axis = pose.rotation * joint.axis;
            columns.push(match joint.kind {
                JointKind::Revolute => [axis.cross(tip - pose.translation), axis],
                _ => [axis, DVec3::ZERO],
            });
            pose *= joint.motion(*value);
        }
        columns
    }

    /// Joints within their limits that bring the tip to `goal`, those that are found first from `near`, where the search begins.
    ///
    /// Levenberg-Marquardt with a damping that follows the error (Sugihara, "Solvability-unconcerned inverse kinematics by the
    /// Levenberg-Marquardt method", IEEE Transactions on Robotics 27, 2011), from `near` and then from other starts, always
    /// the same ones. It knows any chain: closed forms exist for wrists whose axes meet, and the libraries that have them
    /// know no other.
    ///
    /// # Errors
    /// None was found: the goal is out of reach, or asks for what the chain cannot do.
    pub fn inverse(&self, goal: &DPose3, near: &[f64]) -> Result<Vec<f64>, OutOfReach> {
        let mut best: Option<OutOfReach> = None;
        for start in 0..MOST_STARTS {
            let values = if start == 0 { near.to_vec() } else { self.start(start) };
            match self.search(goal, values) {
                Ok(values) => return Ok(values),
                Err(miss) if best.is_none_or(|best| miss.distance + miss.angle < best.distance + best.angle) => {
                    best = Some(miss);
                }
                Err(_) => {}
            }
        }
        Err(best.unwrap_or(OutOfReach { distance: f64::INFINITY, angle: f64::INFINITY }))
    }

    /// The start of this number: spread evenly over the limits, by the additive recurrence of the golden ratio's kin (Roberts
    /// 2018); a joint without limits over a turn, or a metre either way.
    fn start(&self, number: u32) -> Vec<f64> {
        // The root of x^(n+1) = x + 1, whose powers fill n dimensions evenly.
        let count = self.links.len() as i32;
        let root = (0..30).fold(2.0f64, |x, _| (1.0 + x).powf(1.0 / f64::from(count + 1)));
        let joints = self.joints().enumerate();
        joints
            .map(|(index, joint)| {
                let share = (0.5 + f64::from(number) * root.powi(-(index as i32) - 1)).fract();
                let [low, high] = bounds(joint);
                low + share * (high - low)
            })
            .collect()
    }

    fn search(&self, goal: &DPose3, mut values: Vec<f64>) -> Result<Vec<f64>, OutOfReach> {
        self.clamp(&mut values);
        let mut error = self.error(goal, &values);
        for _ in 0..MOST_STEPS {
            if error.norm() < NEAR {
                return Ok(values);
            }
            let columns = self.jacobian(&values);
            let jacobian = DMatrix::from_fn(6, columns.len(), |row, column| columns[column][row / 3][row % 3]);
            let damping = 0.5 * error.norm_squared() * DAMPING.sqrt() + DAMPING * error.norm().min(1.0);
            let normal: Matrix6<f64> =
                (&jacobian * jacobian.transpose()).fixed_view::<6, 6>(0, 0) + Matrix6::identity() * damping;
            let Some(factor) = normal.cholesky() else { break };
            let step: DVector<f64> = jacobian.transpose() * factor.solve(&error);
            let mut next: Vec<f64> = values.iter().zip(step.iter()).map(|(value, step)| value + step).collect();
            self.clamp(&mut next);
            if next == values {
                break;
            }
            values = next;
            error = self.error(goal, &values);
        }
        if error.norm() < NEAR {
            return Ok(values);
        }
        let [distance, angle] = [error.fixed_rows::<3>(0).norm(), error.fixed_rows::<3>(3).norm()];
        Err(OutOfReach { distance, angle })
    }

    /// From where the tip is to the goal: a way, and a turn as its axis times its angle.
    fn error(&self, goal: &DPose3, values: &[f64]) -> Vector6<f64> {
        let now = self.forward(values);
        let way = goal.translation - now.translation;
        let turn = (goal.rotation * now.rotation.inverse()).normalize();
        let turn = if turn.w < 0.0 { -turn } else { turn };
        // By the sine's side: by the cosine a small angle drowns in rounding.
        let sine = turn.xyz();
        let length = sine.length();
        let turn = if length > 0.0 { sine * (2.0 * length.atan2(turn.w) / length) } else { DVec3::ZERO };
        Vector6::new(way.x, way.y, way.z, turn.x, turn.y, turn.z)
    }

    /// Brings values into their limits; a revolute joint by whole turns, if that helps.
    fn clamp(&self, values: &mut [f64]) {
        for (value, joint) in values.iter_mut().zip(self.joints()) {
            let [low, high] = joint.limits;
            if joint.kind == JointKind::Revolute && low.is_finite() && high.is_finite() {
                let turn = std::f64::consts::TAU;
                if *value > high && *value - turn * ((*value - high) / turn).ceil() >= low {
                    *value -= turn * ((*value - high) / turn).ceil();
                } else if *value < low && *value + turn * ((low - *value) / turn).ceil() <= high {
                    *value += turn * ((low - *value) / turn).ceil();
                }
            }
            *value = value.clamp(low, high);
        }
    }
}

/// Where starts are spread.
fn bounds(joint: &Joint) -> [f64; 2] {
    let reach = if joint.kind == JointKind::Revolute { std::f64::consts::PI } else { 1.0 };
    let [low, high] = joint.limits;
    [low.max(-reach.max(-high.min(0.0))), high.min(reach.max(low.max(0.0)))]
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use proptest::prelude::*;

    use super::super::DQuat;
    use super::*;

    fn along(x: f64) -> DPose3 {
        DPose3::translation(x, 0.0, 0.0)
    }

    /// Two links of 0.4 and 0.3 m in a plane.
    fn planar() -> Chain {
        let turn = Joint::revolute(DVec3::Z, [-PI, PI]);
        Chain::new([(DPose3::IDENTITY, turn), (along(0.4), turn)], along(0.3))
    }

    /// X, Y, Z and a turn about Z, as the catalogue's cartesian robot has them.
    fn cartesian() -> Chain {
        let slide = |axis: DVec3| (DPose3::IDENTITY, Joint::prismatic(axis, [-2.0, 2.0]));
        let turn = (DPose3::IDENTITY, Joint::endless(DVec3::Z));
        Chain::new([slide(DVec3::X), slide(DVec3::Y), slide(DVec3::Z), turn], DPose3::translation(0.18, 0.0, -0.1))
    }

    proptest! {
        /// x = l1 cos a + l2 cos(a + b), y = l1 sin a + l2 sin(a + b).
        #[test]
        fn two_links_are_where_the_closed_form_has_them(a in -3.0..3.0f64, b in -3.0..3.0f64) {
            let tip = planar().forward(&[a, b]);
            let expected = DVec3::new(0.4 * a.cos() + 0.3 * (a + b).cos(), 0.4 * a.sin() + 0.3 * (a + b).sin(), 0.0);
            prop_assert!((tip.translation - expected).length() < 1e-14);
            prop_assert!(tip.rotation.angle_between(DQuat::from_rotation_z(a + b)) < 1e-7);
        }

        #[test]
        fn a_cartesian_robot_s_joints_are_the_place_of_its_tool(
            x in -1.5..1.5f64, y in -1.5..1.5f64, z in -1.5..1.5f64, r in -3.1..3.1f64,
        ) {
            let tool = DVec3::new(x + 0.18 * r.cos(), y + 0.18 * r.sin(), z - 0.1);
            let goal = DPose3::from_parts(tool, DQuat::from_rotation_z(r));
            prop_assert!((cartesian().forward(&[x, y, z, r]).translation - tool).length() < 1e-14);
            let found = cartesian().inverse(&goal, &[0.0; 4]).expect("within reach");
            let expected = [x, y, z, r];
            prop_assert!((0..4).all(|i| (found[i] - expected[i]).abs() < 1e-8), "{found:?} is not {expected:?}");
        }

        #[test]
        fn the_jacobian_is_the_slope_of_the_way(a in -3.0..3.0f64, b in -3.0..3.0f64) {
            const SMALL: f64 = 1e-7;
            let columns = planar().jacobian(&[a, b]);
            for (index, column) in columns.iter().enumerate() {
                let mut there = [a, b];
                there[index] += SMALL;
                let slope = (planar().forward(&there).translation - planar().forward(&[a, b]).translation) / SMALL;
                prop_assert!((slope - column[0]).length() < 1e-6);
                prop_assert!((column[1] - DVec3::Z).length() < 1e-12);
            }
        }
    }

    #[test]
    fn what_is_out_of_reach_is_told_with_how_far() {
        let far = DPose3::translation(1.0, 0.0, 0.0);
        let miss = planar().inverse(&far, &[0.1, 0.1]).expect_err("0.7 m is its reach");
        assert!((miss.distance - 0.3).abs() < 0.01, "{miss}");
        let tilted = DPose3::from_rotation(DQuat::from_rotation_x(FRAC_PI_2));
        let miss = cartesian().inverse(&tilted, &[0.0; 4]).expect_err("it only turns about z");
        assert!(miss.angle > 1.0, "{miss}");
        let beyond = DPose3::translation(2.5, 0.0, 0.0);
        assert!((cartesian().inverse(&beyond, &[0.0; 4]).expect_err("its rail ends").distance - 0.32).abs() < 0.05);
    }
}
