//! Plants built by hand, for the engine's tests: instances of device kinds with their defaults but for what is set, every
//! port mapped to a signal of SI units.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use super::Engine;
use crate::device::KINDS;
use crate::plant::{
    AdapterSettings, InitialPart, Instance, Parameter, ParameterValue, Parameters, PartKind, Places, Plant, Pose, Task,
};
use crate::prototype::kind::{KindDescriptor, ParameterType, PortType};
use crate::signal_map::{RateClass, RegisterId, Signal, SignalMap};
use crate::value::{ElementaryType, SignalType, Unit, Value};

/// A plant that grows.
#[derive(Default)]
pub struct Bench {
    instances: Vec<Instance>,
    parts: Vec<InitialPart>,
    signals: Vec<Signal>,
}

impl Bench {
    /// Adds an instance that stands at x, y, z, turned by rz.
    pub fn add(mut self, name: &str, kind: &str, at: [f64; 4], set: &[(&str, &str)]) -> Bench {
        let found = KINDS.iter().find(|descriptor| descriptor.name.ends_with(kind));
        let kind: &'static KindDescriptor = found.expect(kind);
        let first = self.signals.len() as u32;
        let ports = (first..).take(kind.ports.len()).map(|id| Some(RegisterId(id))).collect();
        for port in kind.ports {
            let ty = match port.ty {
                PortType::Boolean => ElementaryType::Bool,
                PortType::Integer => ElementaryType::Dint,
                PortType::Real => ElementaryType::Real,
            };
            self.signals.push(Signal {
                name: format!("{name}.{}", port.name),
                ty: SignalType::scalar(ty),
                direction: port.direction,
                kind: port.kind,
                rate: RateClass::HighFrequency,
                unit: Unit::ONE,
                min: None,
                max: None,
                instance: name.to_owned(),
                task: "Law".to_owned(),
                property: port.name.to_owned(),
            });
        }
        let [x, y, z, rz] = at;
        self.instances.push(Instance {
            shape: Default::default(),
            structure: None,
            name: name.to_owned(),
            prototype: kind.name.to_owned(),
            pose: Pose { x, y, z, rz, ..Pose::default() },
            tasks: vec![Task { name: "Law".to_owned(), kind, parameters: parameters(kind, set), ports }],
            effects: Vec::new(),
        });
        self
    }

    /// Adds a box that stands on a conveyor.
    pub fn part(mut self, on: &str, x: f64) -> Bench {
        let pose = Pose { x, ..Pose::default() };
        self.parts.push(InitialPart { kind: PartKind::Box, size: [0.3, 0.3, 0.2], pose, on: Some(on.to_owned()) });
        self
    }

    /// The plant.
    pub fn plant(self) -> Plant {
        Plant {
            name: "bench".to_owned(),
            adapter: AdapterSettings {
                host: "127.0.0.1".to_owned(),
                port: 61_499,
                timeout: Duration::from_secs(5),
                signals_map: None,
                high_frequency: Duration::from_millis(20),
                low_frequency: Duration::from_millis(500),
            },
            instances: self.instances,
            parts: self.parts,
            signal_map: Arc::new(SignalMap::new("bench", self.signals).expect("names that differ")),
            places: Places::default(),
        }
    }

    /// Its engine with a step of `step_us` microseconds.
    pub fn engine(self, step_us: u64) -> Driven {
        Driven::new(&self.plant(), step_us, 1)
    }
}

fn parameters(kind: &'static KindDescriptor, set: &[(&str, &str)]) -> Parameters {
    for (name, _) in set {
        assert!(kind.parameter(name).is_some(), "{} has no parameter {name}", kind.name);
    }
    let set: BTreeMap<&str, &str> = set.iter().copied().collect();
    let mut parameters = Parameters::default();
    for parameter in kind.parameters {
        let text = set.get(parameter.name).copied().unwrap_or(parameter.default);
        let value = match parameter.ty {
            ParameterType::Number { .. } => ParameterValue::Number(text.parse().expect(text)),
            ParameterType::Integer { .. } => ParameterValue::Integer(text.parse().expect(text)),
            ParameterType::Boolean => ParameterValue::Boolean(text.parse().expect(text)),
            ParameterType::Numbers { .. } => {
                let numbers = text.split(';').map(|number| number.parse().expect(text));
                ParameterValue::Numbers(numbers.collect())
            }
            _ => ParameterValue::Text(text.to_owned()),
        };
        parameters.0.insert(parameter.name, Parameter { value, tolerance: 0.0 });
    }
    parameters
}

/// An engine that is driven by names.
pub struct Driven {
    pub engine: Engine,
    map: Arc<SignalMap>,
    inputs: Vec<(RegisterId, Value)>,
}

impl Driven {
    pub fn new(plant: &Plant, step_us: u64, seed: u64) -> Driven {
        let engine = Engine::new(plant, Duration::from_micros(step_us), seed).expect("a plant that runs");
        Driven { engine, map: plant.signal_map.clone(), inputs: Vec::new() }
    }

    pub fn register(&self, name: &str) -> RegisterId {
        self.map.register(name).unwrap_or_else(|| panic!("no signal {name}"))
    }

    /// Sets a command for the next tick.
    pub fn set(&mut self, name: &str, value: f64) {
        let register = self.register(name);
        let element = self.map.signal(register).ty.element;
        self.inputs.push((register, Value::from_f64(element, value)));
    }

    /// What is reported, as of the last tick.
    pub fn get(&self, name: &str) -> f64 {
        self.engine.registers()[self.register(name).index()].to_f64().expect("a number")
    }

    pub fn is(&self, name: &str) -> bool {
        self.get(name) != 0.0
    }

    pub fn tick(&mut self) {
        self.engine.tick(&self.inputs);
        self.inputs.clear();
    }

    /// Ticks until the report of the instant `seconds` has been made.
    pub fn run_to(&mut self, seconds: f64) {
        while self.engine.now().seconds() < seconds + 1e-9 {
            self.tick();
        }
    }

    /// Ticks until the report is true; the instant of that report.
    pub fn wait_for(&mut self, name: &str, value: bool, limit: f64) -> f64 {
        loop {
            let now = self.engine.now().seconds();
            assert!(now < limit, "{name} did not become {value} before {limit} s");
            self.tick();
            if self.is(name) == value {
                return now;
            }
        }
    }
}
