//! Sensors that look at parts, in a plant of their own.

use std::collections::BTreeMap;
use std::time::Duration;

use crate::device::KINDS;
use crate::engine::Engine;
use crate::plant::embedded::Embedded;
use crate::plant::{Plant, load};
use crate::prototype::source::{Layered, Memory};
use crate::signal_map::RegisterId;
use crate::value::Value;

const PLANT: &str = r#"<plant name="p">
  <instance name="Belt" prototype="StraightConveyor">
    <property name="length" value="4 m"/><property name="barrierB" value="3 m"/>
    <property name="acceleration" value="100 m/s2"/>
  </instance>
  <instance name="Near" prototype="ProximitySensor">
    <pose x="2" y="-0.4" z="0.1" rz="90deg"/><property name="range" value="0.5 m"/>
  </instance>
  <instance name="Room" prototype="BoxSensor">
    <pose x="3"/><property name="boxPosition" value="0;0;0.3 m"/><property name="boxDimensions" value="0.5;0.6;0.6 m"/>
  </instance>
  <instance name="Camera" prototype="VisionSensor">
    <pose x="1"/><property name="boxPosition" value="0;0;0.1 m"/><property name="boxDimensions" value="0.2;0.4;0.3 m"/>
  </instance>
  <part kind="box" at="Belt" x="1.85" size="0.3;0.2;0.2"/>
  <part kind="pallet" at="Belt" x="0.8" size="0.4;0.4;0.1"/>
  <part kind="box" at="Belt" x="0.85" z="0.1" size="0.2;0.2;0.2"/>
</plant>"#;

struct Bench {
    plant: Plant,
    engine: Engine,
}

impl Bench {
    fn new() -> Bench {
        let source = Layered(Memory(BTreeMap::from([("m/plant.xml".to_owned(), PLANT.to_owned())])), Embedded);
        let plant = load(&source, "m", KINDS).expect("a plant");
        let engine = Engine::new(&plant, Duration::from_millis(1), 0).expect("an engine");
        Bench { plant, engine }
    }

    fn register(&self, name: &str) -> RegisterId {
        let index = self.plant.signal_map.signals().iter().position(|signal| signal.name == name).expect(name);
        RegisterId(index as u32)
    }

    fn run(&mut self, velocity: f32, ticks: usize) {
        let commands = [
            (self.register("Belt.velocityTarget"), Value::Real(velocity)),
            (self.register("Belt.motorDirection"), Value::Dint(1)),
        ];
        self.engine.tick(&commands);
        for _ in 1..ticks {
            self.engine.tick(&[]);
        }
    }

    #[track_caller]
    fn check(&self, name: &str, expected: f64) {
        let found = self.engine.registers()[self.register(name).index()].to_f64().expect("a number");
        assert!((found - expected).abs() < 1e-6, "{name} is {found}, not {expected}");
    }
}

#[test]
fn sensors_see_what_is_before_them() {
    let mut bench = Bench::new();
    bench.run(0.0, 2);
    // The box's front is exactly at the ray, and does not cut it.
    bench.check("Near.detected", 0.0);
    bench.check("Near.distance", 0.5);
    bench.check("Room.count", 0.0);
    // Both the pallet and the box on it are in the camera's window; the box's centre is the nearer one.
    bench.check("Camera.detected", 1.0);
    bench.check("Camera.kind", 1.0);
    bench.check("Camera.colour", f64::from(0x00c4_9a60));
    bench.run(1.0, 100);
    // The box's side is 0.1 m from the belt's middle, 0.3 m from the sensor.
    bench.check("Near.detected", 1.0);
    bench.check("Near.distance", 0.3);
    // By 1.0 m the loose box and no other has come into the room, by 2.2 m the stack of two alone is in it.
    bench.run(1.0, 1000);
    bench.check("Near.detected", 0.0);
    bench.check("Room.count", 1.0);
    bench.check("Camera.kind", 0.0);
    bench.check("Camera.colour", 0.0);
    bench.run(1.0, 1100);
    bench.check("Room.count", 2.0);
    bench.check("Room.detected", 1.0);
}
