//! A published six-axis arm: its URDF against the closed form of its maker's Denavit-Hartenberg parameters, and back from
//! poses to joints.

use std::f64::consts::{FRAC_PI_2, PI};

use kinetwin::kinematics::{Chain, DPose3, DQuat, DVec3, Joint};
use proptest::prelude::*;
use urdf_rs::JointType;

/// The chain of an URDF whose joints stand in order.
fn chain() -> Chain {
    let robot = urdf_rs::read_file("tests/six-axis/ur5e.urdf").expect("an URDF");
    let joints = robot.joints.iter().map(|joint| {
        assert!(matches!(joint.joint_type, JointType::Revolute));
        let [roll, pitch, yaw] = joint.origin.rpy.0;
        let turn = DQuat::from_rotation_z(yaw) * DQuat::from_rotation_y(pitch) * DQuat::from_rotation_x(roll);
        let rest = DPose3::from_parts(DVec3::from_array(joint.origin.xyz.0), turn);
        let axis = DVec3::from_array(joint.axis.xyz.0);
        (rest, Joint::revolute(axis, [joint.limit.lower, joint.limit.upper]))
    });
    Chain::new(joints.collect::<Vec<_>>(), DPose3::IDENTITY)
}

/// T = Π Rz(θ) Tz(d) Tx(a) Rx(α), with the maker's a, d and α.
fn closed_form(joints: &[f64]) -> DPose3 {
    const A: [f64; 6] = [0.0, -0.425, -0.3922, 0.0, 0.0, 0.0];
    const D: [f64; 6] = [0.1625, 0.0, 0.0, 0.1333, 0.0997, 0.0996];
    const ALPHA: [f64; 6] = [FRAC_PI_2, 0.0, 0.0, FRAC_PI_2, -FRAC_PI_2, 0.0];
    (0..6).fold(DPose3::IDENTITY, |pose, i| {
        let turned = DPose3::from_rotation(DQuat::from_rotation_z(joints[i]));
        pose * turned * DPose3::translation(A[i], 0.0, D[i]) * DPose3::from_rotation(DQuat::from_rotation_x(ALPHA[i]))
    })
}

fn off(a: &DPose3, b: &DPose3) -> (f64, f64) {
    // The angle by its sine: by its cosine, small ones drown in rounding.
    let turn = a.rotation.inverse() * b.rotation;
    ((a.translation - b.translation).length(), 2.0 * turn.xyz().length().min(1.0).asin())
}

#[test]
fn at_zero_the_arm_lies_stretched_out() {
    let tip = chain().forward(&[0.0; 6]).translation;
    assert!((tip - DVec3::new(-0.8172, -0.2329, 0.0628)).length() < 1e-12, "{tip}");
}

proptest! {
    #[test]
    fn the_arm_is_where_its_closed_form_has_it(joints in prop::array::uniform6(-PI..PI)) {
        let (distance, angle) = off(&chain().forward(&joints), &closed_form(&joints));
        prop_assert!(distance < 1e-12 && angle < 1e-12, "{} m, {} rad", distance, angle);
    }

    #[test]
    fn joints_are_found_for_where_the_arm_can_be(joints in prop::array::uniform6(-3.0..3.0f64)) {
        let goal = chain().forward(&joints);
        let found = chain().inverse(&goal, &[0.0, -1.2, 1.0, -1.4, -1.5, 0.0]).expect("within reach");
        let (distance, angle) = off(&chain().forward(&found), &goal);
        prop_assert!(distance < 1e-8 && angle < 1e-8, "{} m, {} rad", distance, angle);
        prop_assert!(chain().joints().zip(&found).all(|(joint, value)| joint.reaches(*value)), "{:?}", found);
    }
}

#[test]
fn out_of_reach_is_said() {
    let far = DPose3::translation(1.5, 0.0, 0.3);
    let miss = chain().inverse(&far, &[0.0; 6]).expect_err("its reach is 0.85 m and the flange");
    assert!(miss.distance > 0.3, "{miss}");
}
