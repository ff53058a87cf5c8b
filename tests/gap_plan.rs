//! The experiment that tells rivals apart, played on a machine with each rival in turn: the verdict becomes right.
//!
//! The machine is the engine with one of the rivals as its effect, its reports rounded and noisy as a PLC's are.

use std::collections::BTreeMap;
use std::time::Duration;

use kinetwin::device::KINDS;
use kinetwin::engine::Engine;
use kinetwin::gap::Recording;
use kinetwin::gap::diagnosis::{self, Options};
use kinetwin::gap::plan::{Experiment, Line, plan};
use kinetwin::gap::report::{Report, Verdict};
use kinetwin::plant::{EffectPlace, EffectSpec, ParameterValue, Plant, embedded::Embedded, load};
use kinetwin::signal_map::{Direction, Kind, RegisterId};
use kinetwin::value::Value;

fn rig() -> Plant {
    load(&Embedded, "models/rig", KINDS).expect("the rig")
}

fn effect(place: EffectPlace, kind: &str, component: &str, parameter: (&str, f64)) -> EffectSpec {
    EffectSpec {
        place,
        kind: kind.to_owned(),
        component: Some(component.to_owned()),
        parameters: BTreeMap::from([(parameter.0.to_owned(), ParameterValue::Number(parameter.1))]),
    }
}

/// What levels are rounded to, m: a drive's increments.
const STEP: f64 = 1e-4;
/// The machine's own step, s: much shorter than anything that is to be told apart.
const TICK: f64 = 1e-4;
/// The cycle of its reports, in ticks.
const CYCLE: u64 = 100;
/// Where in the cycle it looks, in ticks: a PLC is in step with nobody.
const PHASE: u64 = 37;

/// What a machine with `effect` reports while it is driven by `lines`.
fn machine(effect: &EffectSpec, lines: &[Line], span: f64, seed: u64) -> Recording {
    let mut plant = rig();
    let robot = plant.instances.iter_mut().find(|instance| instance.name == "Robot").expect("a robot");
    robot.effects.push(effect.clone());
    let mut engine = Engine::new(&plant, Duration::from_secs_f64(TICK), seed).expect("the machine is built");
    let mut state = seed;
    let mut noise = || {
        // The sum of twelve even numbers is nearly normal (Irwin and Hall); the generator is Knuth's MMIX.
        let mut even = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        (0..12).map(|_| even()).sum::<f64>() - 6.0
    };
    let mut last: Vec<Option<Value>> = vec![None; plant.signal_map.signals().len()];
    let (mut reports, mut rest) = (Vec::new(), lines.iter().peekable());
    for step in 0..(span / TICK).round() as u64 {
        let now = step as f64 * TICK;
        let mut inputs: Vec<(RegisterId, Value)> = Vec::new();
        while let Some(line) = rest.next_if(|line| line.at <= now + 1e-9) {
            inputs.push((line.register, line.value.clone()));
        }
        let registers = engine.tick(&inputs);
        if step % CYCLE != PHASE {
            continue;
        }
        for (register, signal) in plant.signal_map.directed(Direction::Report) {
            let number = registers[register.index()].to_f64().expect("a number");
            let seen = match signal.kind {
                Kind::Edge => number,
                Kind::Level => ((number + STEP * noise()) / STEP).round() * STEP,
            };
            let value = Value::Lreal(seen);
            if last[register.index()].as_ref() != Some(&value) {
                last[register.index()] = Some(value);
                reports.push((now, register, seen));
            }
        }
    }
    let commands: Vec<_> =
        lines.iter().map(|line| (line.at, line.register, line.value.to_f64().expect("a number"))).collect();
    Recording::of(&plant, "machine", &commands, &reports, span)
}

fn diagnose(train: Recording, held_out: Recording, effects: &[&str]) -> Report {
    let options = Options {
        is_asked: &|id| effects.contains(&id),
        is_meant: &|device| device == "Robot",
        is_stopped: &|| false,
        tell: &|_| {},
    };
    diagnosis::diagnose(&rig(), &[train], &[held_out], &options).expect("a diagnosis").report
}

/// Some moves of Y, there and back: too few corners to tell a lag from a dead time of some milliseconds.
fn careful() -> Vec<Line> {
    let target = rig().signal_map.register("Robot.YTarget").expect("a target");
    let step = |at: f64, value: f32| Line { at, register: target, value: Value::Real(value) };
    (0..4).map(|i| step(1.0 + 2.0 * f64::from(i), if i % 2 == 0 { 0.3 } else { 0.0 })).collect()
}

#[test]
fn the_experiment_makes_the_verdict_right_whichever_rival_it_is() {
    const ASKED: &[&str] = &["first-order-lag", "dead-time"];
    let lag = effect(EffectPlace::Actuator, "first-order-lag", "Y", ("time_constant", 0.0025));
    let dead_time = effect(EffectPlace::CommandLink, "dead-time", "YTarget", ("time", 0.0025));
    let before = machine(&lag, &careful(), 10.0, 1);
    let report = diagnose(before.clone(), machine(&lag, &careful(), 10.0, 11), ASKED);
    assert_eq!(report.verdict, Verdict::Ambiguous, "a move or two tells nothing: {}", report.to_json());
    let experiment: Experiment = plan(&rig(), &report, &[before], &BTreeMap::new()).expect("an experiment");
    assert!(experiment.separations.iter().any(|separation| separation.power > 0.9), "{:?}", experiment.separations);
    for (truth, seed) in [(&lag, 2), (&dead_time, 3)] {
        let played = |seed| machine(truth, &experiment.lines, experiment.span_s, seed);
        let report = diagnose(played(seed), played(seed + 10), ASKED);
        let class: Vec<&str> =
            report.cause.iter().flat_map(|cause| &cause.class).map(|it| it.effect.as_str()).collect();
        assert!(
            class.iter().all(|effect| *effect == truth.kind) && !class.is_empty(),
            "{}: {}",
            truth.kind,
            report.to_json()
        );
    }
}
