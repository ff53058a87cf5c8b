//! The scenes of our plants: that their frames are where the engine has its bodies, and that only what moves is computed.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;
use std::time::Duration;

use super::{Act, Engine, IncidentKind, Insertion, PartState};
use crate::device::KINDS;
use crate::kinematics::DVec3;
use crate::plant::embedded::Embedded;
use crate::plant::{PartKind, Plant, load};
use crate::scene::{Poses, Scene};
use crate::signal_map::RegisterId;
use crate::value::Value;

fn plant(model: &str) -> Plant {
    load(&Embedded, model, KINDS).expect("a model of ours")
}

struct Shown {
    plant: Plant,
    engine: Engine,
}

impl Shown {
    fn new(model: &str) -> Shown {
        let plant = plant(model);
        let mut engine = Engine::new(&plant, Duration::from_millis(10), 1).expect("an engine");
        engine.show(&plant, Arc::new(Scene::of(&plant)));
        Shown { plant, engine }
    }

    fn run(&mut self, commands: &[(&str, f64)], ticks: usize) {
        let signals = self.plant.signal_map.signals();
        let command = |(name, value): &(&str, f64)| {
            let index = signals.iter().position(|signal| signal.name == *name).expect("a signal");
            (RegisterId(index as u32), Value::from_f64(signals[index].ty.element, *value))
        };
        let commands: Vec<_> = commands.iter().map(command).collect();
        self.engine.tick(&commands);
        for _ in 1..ticks {
            self.engine.tick(&[]);
        }
    }

    fn poses(&self) -> &Poses {
        self.engine.poses().expect("it is shown")
    }

    fn place(&self, name: &str) -> DVec3 {
        self.poses().world(self.poses().scene().find(name).expect(name)).translation
    }

    fn moved(&self) -> Vec<&str> {
        let scene = self.poses().scene();
        self.poses().moved().iter().map(|id| scene.node(*id).name.as_str()).collect()
    }
}

#[test]
fn the_joint_of_the_references_example_resolves() {
    let scene = Scene::of(&plant("models/depalletizer"));
    let name = crate::prototype::substitute("$.Spintore.T", "Pusher1", |_| None).expect("a name");
    let id = scene.find_joint(&name).expect("the joint");
    assert_eq!((scene.node(id).name.as_str(), scene.node(id).joint.limits), ("Pusher1.Spintore", [0.0, 0.75]));
    assert_eq!(scene.find_joint("Pusher1.Spintore.R"), None);
    assert_eq!(scene.find_joint("Pusher1.Spindel.T"), None);
}

#[test]
fn frames_follow_the_devices_and_only_what_moves_is_computed() {
    let mut shown = Shown::new("models/depalletizer");
    shown.run(&[], 1);
    assert_eq!(shown.moved(), [] as [&str; 0]);
    shown.run(&[("Pusher1.command", 1.0)], 10);
    assert_eq!(shown.moved(), ["Pusher1.Spintore"]);
    assert!((shown.place("Pusher1.Spintore") - DVec3::new(5.85, 3.8, 0.77)).length() < 1e-9);
    shown.run(&[("Robot.RTarget", FRAC_PI_2), ("Robot.YTarget", 1.2)], 400);
    // At R = π/2 the gripper that hangs at +x of the tool stands to its left.
    assert!(
        (shown.place("Gripper1.Rim") - DVec3::new(4.0, 1.38, 1.7)).length() < 1e-4,
        "{}",
        shown.place("Gripper1.Rim")
    );
    assert_eq!(shown.moved(), [] as [&str; 0]);
    shown.run(&[("Robot.ZTarget", -0.4)], 2);
    let hanging = ["Robot.Z", "Robot.R", "Gripper1", "Gripper1.Rim", "Gripper2", "Gripper2.Rim"];
    assert_eq!(shown.moved(), hanging);
}

#[test]
fn a_viewer_that_looks_seldom_misses_nothing() {
    let mut shown = Shown::new("models/rig");
    shown.run(&[("Axis.positionTarget", 0.2), ("Motor.speedTarget", 5.0), ("Motor.enable", 1.0)], 50);
    let seen = shown.poses().version();
    shown.run(&[("Motor.enable", 0.0), ("Robot.XTarget", 0.1)], 300);
    let names: Vec<&str> =
        shown.poses().moved_since(seen).map(|(id, _)| shown.poses().scene().node(id).name.as_str()).collect();
    assert!(names.contains(&"Motor.Shaft") && names.contains(&"Robot.X") && names.contains(&"Robot.Z"), "{names:?}");
    assert!(!names.contains(&"Pusher.Spintore") && !names.contains(&"Belt"), "{names:?}");
    assert_eq!(shown.poses().moved_since(shown.poses().version()).count(), 0);
}

#[test]
fn what_is_shown_changes_nothing_that_is_computed() {
    let mut shown = Shown::new("models/rig");
    let mut bare = Engine::new(&shown.plant, Duration::from_millis(10), 1).expect("an engine");
    for _ in 0..300 {
        shown.engine.tick(&[]);
        bare.tick(&[]);
    }
    assert_eq!(shown.engine.state_hash(), bare.state_hash());
}

#[test]
fn beams_are_where_parts_cut_them() {
    let mut shown = Shown::new("models/depalletizer");
    let scene = Arc::clone(shown.poses().scene());
    assert_eq!(scene.beams().len(), 30);
    shown.run(&[], 1);
    for (beam, is_cut) in scene.beams().iter().zip(shown.engine.cut_beams()) {
        let signal = shown.plant.signal_map.signals().iter().position(|signal| signal.name == beam.name).expect("it");
        assert_eq!(shown.engine.registers()[signal], Value::Bool(is_cut), "{}", beam.name);
    }
    let cut: Vec<&str> = scene
        .beams()
        .iter()
        .zip(shown.engine.cut_beams())
        .filter(|(_, cut)| *cut)
        .map(|(b, _)| b.name.as_str())
        .collect();
    assert!(cut.contains(&"Conveyor2.lightBarrierA") && cut.contains(&"Conveyor2.lightBarrierB"), "{cut:?}");
    // The centre of a beam of a curve lies over its centre line.
    let beam = scene.beams().iter().find(|beam| beam.name == "Curve1.lightBarrierA").expect("it");
    let pose = Poses::new(Arc::clone(&scene));
    let [a, b] = beam.ends.map(|end| pose.world(beam.node).transform_point(end));
    let middle = (a + b) / 2.0 - DVec3::new(5.2, 2.0, 0.0);
    assert!((middle.truncate().length() - 0.8).abs() < 1e-9, "{middle}");
}

#[test]
fn a_machines_reports_put_its_joints_and_what_hangs_from_them() {
    let mut shown = Shown::new("models/depalletizer");
    let part = Insertion {
        kind: PartKind::Box,
        size: [0.3; 3],
        belt: "Conveyor4".to_owned(),
        station: 1.38,
        offset: 0.0,
        turn: 0.0,
    };
    shown.engine.operate(&Act::Insert(part)).expect("room");
    shown.run(&[("Robot.YTarget", 1.2), ("Robot.ZTarget", -0.65)], 300);
    shown.run(&[("Gripper1.suctionOn", 1.0)], 50);
    shown.run(&[("Robot.ZTarget", 0.0), ("Pusher1.command", 1.0)], 300);
    let model: Vec<PartState> = shown.engine.parts().collect();
    let held = model.iter().position(|part| part.place[2] > 1.3).expect("a part that hangs");
    let map = Arc::clone(&shown.plant.signal_map);
    let said = |pairs: &[(&str, Value)]| -> Vec<Option<Value>> {
        let of = |name: &str| pairs.iter().find(|(said, _)| *said == name).map(|(_, value)| value.clone());
        map.signals().iter().map(|signal| of(&signal.name)).collect()
    };
    let nothing = said(&[]);
    assert_eq!(shown.engine.show_reported(|register| nothing[register.index()].as_ref()), model);
    let before = shown.place("Gripper1.Rim");
    let plate = shown.place("Pusher1.Spintore");

    // X 100 mm further and turned by a quarter, Y beyond all sense; and the pusher has never left its start.
    let machine = said(&[
        ("Robot.actualPosX", Value::Real(0.1)),
        ("Robot.actualPosR", Value::Real(std::f32::consts::FRAC_PI_2)),
        ("Robot.actualPosY", Value::Real(f32::INFINITY)),
        ("Pusher1.limitRetracted", Value::Bool(true)),
        ("Pusher1.limitExtended", Value::Bool(false)),
    ]);
    let parts = shown.engine.show_reported(|register| machine[register.index()].as_ref());
    let moved = shown.place("Gripper1.Rim") - before;
    assert!((moved - DVec3::new(0.1 - 0.18, 0.18, 0.0)).length() < 1e-6, "{moved}");
    let carried = DVec3::from_array(parts[held].place) - DVec3::from_array(model[held].place);
    assert!((carried - moved).length() < 1e-6, "it hangs beneath the rim: {carried}");
    assert!((parts[held].yaw - model[held].yaw - FRAC_PI_2).abs() < 1e-6);
    let retracted = plate - shown.place("Pusher1.Spintore");
    assert!((retracted.length() - 0.748).abs() < 1e-9, "within its switch's 2 mm: {retracted}");
    for (index, part) in parts.iter().enumerate().filter(|(index, _)| *index != held) {
        assert_eq!(*part, model[index], "no report tells of it");
    }
    // The model goes on as if nothing had been shown.
    assert_eq!(shown.engine.parts().collect::<Vec<_>>(), model);
    shown.engine.show_reported(|_| None);
    assert!((shown.place("Gripper1.Rim") - before).length() < 1e-12);
}

#[test]
fn every_mesh_of_ours_is_closed_and_faces_outwards() {
    let mut names = std::collections::BTreeSet::new();
    for model in ["models/depalletizer", "models/rig", "models/curve", "models/servo-arm", "models/servo-pendulum"] {
        let scene = Scene::of(&plant(model));
        for mesh in scene.meshes() {
            assert_eq!(mesh.open_edges(), 0, "{}", mesh.name);
            assert!(mesh.volume() > 0.0, "{} {}", mesh.name, mesh.volume());
            names.insert(mesh.name.clone());
        }
    }
    assert!(names.contains("bellows cup") && names.len() > 40, "{names:?}");
}

#[test]
fn the_line_has_about_as_many_triangles_as_the_references() {
    let scene = Scene::of(&plant("models/depalletizer"));
    let (seen, stored) = (scene.triangles(), scene.stored_triangles());
    assert!((200_000..300_000).contains(&seen), "{seen} seen, {stored} stored");
    assert!(stored < seen / 4, "{stored} stored of {seen}");
}

#[test]
fn a_gripper_driven_into_a_conveyor_is_told_with_the_robots_signals() {
    let mut shown = Shown::new("models/depalletizer");
    shown.engine.watch();
    assert_eq!(shown.engine.watched().expect("it").pairs_left_out().count(), 0);
    shown.run(&[("Robot.YTarget", 1.2)], 300);
    assert_eq!((shown.engine.collisions(), shown.engine.take_incidents().len()), (0, 0));
    // The rim is at 1.70 + Z, the gripper's plate 55 mm above it, the belt at 0.75.
    shown.run(&[("Robot.ZTarget", -0.99)], 300);
    assert_eq!(shown.engine.take_incidents(), []);
    shown.run(&[("Robot.ZTarget", -1.02)], 1);
    let mut told = Vec::new();
    for _ in 0..100 {
        shown.engine.tick(&[]);
        told.extend(shown.engine.take_incidents());
    }
    let [incident] = told.as_slice() else { panic!("{told:?}") };
    let IncidentKind::Collision { between, depth, instances, .. } = &incident.kind else { panic!("{incident:?}") };
    assert_eq!(between, &["Robot.R", "Conveyor4"].map(str::to_owned));
    assert_eq!(instances, &["Robot".to_owned(), "Conveyor4".to_owned()]);
    assert!((1e-4..0.011).contains(depth), "{depth}");
    let signal = |name: &str| {
        let of = |(register, _): &&(RegisterId, Value)| shown.plant.signal_map.signal(*register).name == name;
        incident.signals.iter().find(of).and_then(|(_, value)| value.to_f64()).expect(name)
    };
    assert!(signal("Robot.actualPosZ") < -0.99 && signal("Robot.ZTarget") == f64::from(-1.02f32));
    assert_eq!(signal("Conveyor4.velocityActual"), 0.0);
    assert_eq!(shown.engine.collisions(), 1);
}
