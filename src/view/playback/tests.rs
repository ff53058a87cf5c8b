//! A machine's recording, made by hand, and what is seen of it.

use std::sync::Arc;
use std::time::Duration;

use super::Baked;
use crate::device::KINDS;
use crate::engine::Engine;
use crate::kinematics::DVec3;
use crate::plant::embedded::Embedded;
use crate::plant::{Plant, load};
use crate::replay::Seen;
use crate::scene::{Poses, Scene};
use crate::time::Instant;
use crate::trace::Reader;
use crate::value::Value;

/// The robot is sent to X = 0.2 m; the machine's is there late, and its belt's barrier sees what no model has put there.
const MACHINE: &str = concat!(
    r#"{"trace":"kinetwin/1","source":"plant","step_ns":10000000}"#,
    "\n",
    r#"{"t":0.0,"from":"automation","SendValue":[{"name":"Robot.XTarget","value":0.2}]}"#,
    "\n",
    r#"{"t":0.1,"from":"plant","SendValue":[{"name":"Robot.actualPosX","value":0.01}]}"#,
    "\n",
    r#"{"t":2.0,"from":"plant","SendValue":[{"name":"Robot.actualPosX","value":0.15},{"name":"Belt.lightBarrierB","value":true}]}"#,
    "\n",
    r#"{"t":3.0,"from":"automation","SendValue":[{"name":"Robot.XTarget","value":0.2}]}"#,
    "\n",
);

struct Played {
    plant: Plant,
    scene: Arc<Scene>,
    baked: Baked,
}

impl Played {
    fn new(seen: Seen) -> Played {
        let plant = load(&Embedded, "models/rig", KINDS).expect("a model of ours");
        let scene = Arc::new(Scene::of(&plant));
        let mut engine = Engine::new(&plant, Duration::from_millis(10), 1).expect("an engine");
        engine.show(&plant, Arc::clone(&scene));
        let open = || Reader::new("machine.cps.jsonl", MACHINE.as_bytes());
        let baked = Baked::of("machine.cps.jsonl", seen, &mut engine, (&plant, &scene), open).expect("it plays");
        Played { plant, scene, baked }
    }

    /// How far the robot's X axis is from where it stands at 0, m.
    fn x(&self, at_s: f64) -> f64 {
        let node = self.scene.find("Robot.X").expect("it");
        let at = Instant::from_nanos((at_s * 1e9).round() as i64);
        let place = self.baked.movie.picture(at).poses[node.index()].translation;
        DVec3::length(place - Poses::new(Arc::clone(&self.scene)).world(node).translation)
    }

    fn value(&self, signal: &str, at_s: f64) -> Value {
        let register = self.plant.signal_map.register(signal).expect("a signal");
        let picture = self.baked.movie.picture(Instant::from_nanos((at_s * 1e9) as i64));
        picture.frame.registers[register.index()].clone()
    }

    fn beam(&self, signal: &str, at_s: f64) -> bool {
        let index = self.scene.beams().iter().position(|beam| beam.name == signal).expect("a beam");
        self.baked.movie.picture(Instant::from_nanos((at_s * 1e9) as i64)).beams[index]
    }
}

#[test]
fn a_machine_is_seen_where_it_reported_itself() {
    let machine = Played::new(Seen::Recorded);
    for (at, expected) in [(0.5, 0.01), (1.9, 0.01), (2.5, 0.15)] {
        assert!((machine.x(at) - expected).abs() < 1e-6, "{} at {at} s", machine.x(at));
        assert_eq!(machine.value("Robot.actualPosX", at), Value::Real(expected as f32));
    }
    assert!(!machine.beam("Belt.lightBarrierB", 1.0) && machine.beam("Belt.lightBarrierB", 2.5));
    let register = machine.plant.signal_map.register("Robot.actualPosX").expect("it");
    let history = machine.baked.movie.history(register);
    assert_eq!(history, [(0.1, f64::from(0.01_f32)), (2.0, f64::from(0.15_f32))], "nothing of the model's");
    // Of what the machine does not report, the model tells: its Y axis, and that the belt stands.
    assert_eq!(machine.value("Belt.velocityActual", 2.5), Value::Real(0.0));
}

#[test]
fn the_model_under_the_same_commands_is_elsewhere() {
    let model = Played::new(Seen::Model);
    assert!((model.x(2.5) - 0.2).abs() < 1e-6, "{}", model.x(2.5));
    assert!(!model.beam("Belt.lightBarrierB", 2.5));
    let register = model.plant.signal_map.register("Robot.actualPosX").expect("it");
    assert!(model.baked.movie.history(register).len() > 10);
}
