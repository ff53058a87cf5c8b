//! One device alone, for the tests of the kinds: commands and reports by the names of its ports.

use std::collections::BTreeMap;

use proptest::collection::vec;
use proptest::prelude::*;

use super::{Device, KINDS, Role, Surroundings, build};
use crate::plant::{Parameter, ParameterValue, Parameters};
use crate::prototype::kind::{KindDescriptor, ParameterDescriptor, ParameterType, PortDescriptor, PortType};
use crate::signal_map::Direction::{Command, Report};
use crate::signal_map::Kind::Edge;

/// A device alone.
pub struct Bench {
    pub kind: &'static KindDescriptor,
    pub parameters: Parameters,
    pub device: Box<dyn Device>,
}

fn find(kind: &str) -> &'static KindDescriptor {
    KINDS.iter().find(|descriptor| descriptor.name == kind).expect(kind)
}

/// The defaults of a kind, but for what is set.
fn parameters(kind: &'static KindDescriptor, set: &[(&str, &str)]) -> Parameters {
    let value = |parameter: &ParameterDescriptor, text: &str| match parameter.ty {
        ParameterType::Number { .. } => ParameterValue::Number(text.parse().expect(text)),
        ParameterType::Integer { .. } => ParameterValue::Integer(text.parse().expect(text)),
        ParameterType::Boolean => ParameterValue::Boolean(text.parse().expect(text)),
        ParameterType::Numbers { .. } => {
            ParameterValue::Numbers(text.split(';').map(|number| number.parse().expect(text)).collect())
        }
        ParameterType::Choice(_) | ParameterType::Text | ParameterType::Instance => {
            ParameterValue::Text(text.to_owned())
        }
    };
    for (name, _) in set {
        assert!(kind.parameter(name).is_some(), "{} has no parameter {name}", kind.name);
    }
    let set: BTreeMap<_, _> = set.iter().copied().collect();
    let one = |parameter: &'static ParameterDescriptor| {
        let text = set.get(parameter.name).copied().unwrap_or(parameter.default);
        (parameter.name, Parameter { value: value(parameter, text), tolerance: 0.0 })
    };
    Parameters(kind.parameters.iter().map(one).collect())
}

impl Bench {
    /// A device of `kind`, its defaults but for what is set.
    pub fn new(kind: &str, set: &[(&str, &str)]) -> Bench {
        let kind = find(kind);
        let parameters = parameters(kind, set);
        let device = build(kind, &parameters, "Device1", 1).expect(kind.name);
        Bench { kind, parameters, device }
    }

    /// What is said of parameters that do not fit together.
    pub fn error(kind: &str, set: &[(&str, &str)]) -> String {
        let kind = find(kind);
        match build(kind, &parameters(kind, set), "Device1", 1) {
            Ok(_) => panic!("{set:?} was taken"),
            Err(error) => error.to_string(),
        }
    }

    /// Gives the commands, moves by `seconds`, and compares reports.
    pub fn check(&mut self, commands: &[(&str, f64)], seconds: f64, expected: &[(&str, f64)]) {
        for (port, value) in commands {
            self.device.command(self.kind.port(port).expect(port), *value);
        }
        self.device.advance(seconds);
        for (port, value) in expected {
            let found = self.report(port);
            assert!((found - value).abs() < 1e-9, "{port} is {found}, not {value}");
        }
    }

    /// What the device reports there now.
    pub fn report(&mut self, port: &str) -> f64 {
        let mut reports = vec![f64::NAN; self.kind.ports.len()];
        self.device.report(&mut reports);
        reports[self.kind.port(port).expect(port)]
    }

    /// Parts cut the beams, or do not.
    pub fn cut(&mut self, barrier_a: bool, barrier_b: bool) {
        self.device.sense(&Surroundings { barrier_a, barrier_b, ..Surroundings::default() });
    }

    /// A part is sealed at the cups, or is not.
    pub fn seal(&mut self, sealed: bool) {
        self.device.sense(&Surroundings { sealed, ..Surroundings::default() });
    }

    /// It carries or pushes so many parts, so many of them held back.
    pub fn load(&mut self, parts: u32, queued: u32) {
        self.device.sense(&Surroundings { parts, queued, ..Surroundings::default() });
    }

    /// How far its belt moved in the last span.
    pub fn displacement(&self) -> f64 {
        match self.device.role() {
            Role::Carries(belt) => belt.displacement,
            other => panic!("not a belt, but {other:?}"),
        }
    }
}

#[test]
fn every_kind_stands_still_and_reports_every_port_it_has() {
    for kind in KINDS {
        let set: &[_] = if kind.parameter("belt").is_some() { &[("belt", "Belt")] } else { &[] };
        let mut bench = Bench::new(kind.name, set);
        let all = |bench: &mut Bench| kind.ports.iter().map(|port| bench.report(port.name)).collect::<Vec<_>>();
        let before = all(&mut bench);
        bench.device.advance(3.0);
        bench.device.sense(&Surroundings::default());
        for (port, (before, after)) in kind.ports.iter().zip(before.iter().zip(all(&mut bench))) {
            let reported = port.direction == Report;
            assert_eq!(reported, before.is_finite(), "{} {}", kind.name, port.name);
            assert!(!reported || *before == after, "{} {} moves by itself", kind.name, port.name);
        }
    }
}

/// A command of each kind's own: a share of its port's range, or of about what its defaults move by.
fn drawn(port: &PortDescriptor, share: f64) -> f64 {
    let (least, most) = port.range.unwrap_or((-1.5, 1.5));
    match port.ty {
        PortType::Real => (least + share * (most - least)).clamp(-1.5, 1.5),
        PortType::Boolean => share.round(),
        PortType::Integer => (least + share * (most - least)).clamp(-2.0, 3.0).round(),
    }
}

proptest! {
    /// What is told at random moments, and then at some instants before it may change.
    #[test]
    fn reports_that_step_stay_as_long_as_a_device_says(
        kind in 0..KINDS.len(),
        told in vec((any::<prop::sample::Index>(), 0.0..1.0, 0.0..0.7), 1..24),
        sealed: bool,
    ) {
        let kind = KINDS[kind];
        let set: &[_] = if kind.parameter("belt").is_some() { &[("belt", "Belt")] } else { &[] };
        let mut bench = Bench::new(kind.name, set);
        bench.seal(sealed);
        let commands: Vec<_> = kind.ports.iter().enumerate().filter(|(_, port)| port.direction == Command).collect();
        let steps: Vec<_> = kind.ports.iter().filter(|port| port.direction == Report && (port.kind == Edge || port.ty == PortType::Boolean)).collect();
        for (which, share, seconds) in told {
            if let Some((at, port)) = commands.get(which.index(commands.len().max(1))) {
                bench.device.command(*at, drawn(port, share));
            }
            let all = |bench: &mut Bench| steps.iter().map(|port| bench.report(port.name)).collect::<Vec<_>>();
            let before = all(&mut bench);
            let least = bench.device.unchanged_for().min(3.0);
            let there = bench.device.clone();
            for part in [0.3, 0.9, 1.0 - 1e-9] {
                bench.device = there.clone();
                bench.device.advance(part * least);
                prop_assert_eq!(&before, &all(&mut bench), "{} {} s after {} s", kind.name, part * least, least);
            }
            bench.device = there;
            bench.device.advance(seconds);
        }
    }
}
