//! A servo that eases into its target and accelerates no faster than it can, behind a dead time: all three are found, with their figures,
//! on a chirp that is computed here, by equations of the test's own.

use std::f64::consts::TAU;
use std::fmt::Write;
use std::io::Cursor;

use kinetwin::gap::Recording;
use kinetwin::gap::diagnosis::{Options, diagnose};
use kinetwin::run::model;
use kinetwin::trace::Reader;

const SECONDS: f64 = 20.0;
const CYCLE_S: f64 = 0.02;
const STEP_S: f64 = 2e-4;
const DEAD_TIME_S: f64 = 0.03;
const TIME_CONSTANT_S: f64 = 0.05;
/// rad/s²: a third of what the fastest swings would take.
const STEEPEST: f64 = 20.0;

/// From 0.15 Hz to 4.8 Hz, evenly in the logarithm.
fn target(t: f64, amplitude: f64) -> f64 {
    const OCTAVES: f64 = 5.0;
    const SLOWEST_HZ: f64 = 0.15;
    let turns = (OCTAVES * t.max(0.0) / SECONDS).exp2() - 1.0;
    amplitude * (TAU * SLOWEST_HZ * SECONDS / (OCTAVES * 2.0_f64.ln()) * turns).sin()
}

/// The servo: x' = v, v → (u(t − dead time) − x)/T, |v'| limited; read in steps of 1.5 mrad.
fn recorded(amplitude: f64) -> String {
    let mut text = "{\"trace\":\"kinetwin/1\",\"source\":\"plant\",\"commands\":\"sampled\"}\n".to_owned();
    let (mut x, mut v) = (0.0_f64, 0.0_f64);
    let steps = (CYCLE_S / STEP_S).round() as u32;
    for sample in 0..(SECONDS / CYCLE_S) as u32 {
        let t = f64::from(sample) * CYCLE_S;
        let message = |from: &str, name: &str, value: f64| {
            format!("{{\"t\":{t:.6},\"from\":\"{from}\",\"SendValue\":[{{\"name\":\"{name}\",\"value\":{value:.6}}}]}}")
        };
        let reported = (x / 1.5e-3).round() * 1.5e-3;
        writeln!(text, "{}", message("automation", "Rotation.positionTarget", target(t, amplitude))).expect("a text");
        writeln!(text, "{}", message("plant", "Rotation.position", reported)).expect("a text");
        for step in 0..steps {
            let asked = (target(t + f64::from(step) * STEP_S - DEAD_TIME_S, amplitude) - x) / TIME_CONSTANT_S;
            v = asked.clamp(v - STEEPEST * STEP_S, v + STEEPEST * STEP_S);
            x += v * STEP_S;
        }
    }
    text
}

#[test]
fn a_lag_within_a_limit_behind_a_dead_time() {
    let plant = model::load("models/servo-arm").expect("the arm");
    let [train, held_out] = [0.15, 0.12].map(|amplitude| {
        let reader = Reader::new("chirp", Cursor::new(recorded(amplitude))).expect("a trace");
        [Recording::read(&plant, "chirp", reader, &[]).expect("a recording")]
    });
    let options = Options {
        is_asked: &|id| ["dead-time", "first-order-lag", "acceleration-limit"].contains(&id),
        is_meant: &|name| name == "Rotation",
        is_stopped: &|| false,
        tell: &|_| {},
    };
    let report = diagnose(&plant, &train, &held_out, &options).expect("a diagnosis").report;
    let true_ones =
        [("dead-time", DEAD_TIME_S), ("first-order-lag", TIME_CONSTANT_S), ("acceleration-limit", STEEPEST)];
    for (effect, value) in true_ones {
        let cause = report.cause.iter().find(|cause| cause.effect == effect);
        let found = cause.unwrap_or_else(|| panic!("no {effect}: {}", report.to_json())).parameters[0].value;
        assert!((found / value - 1.0).abs() < 0.1, "{effect}: {found} of {value}\n{}", report.to_json());
    }
    assert_eq!(report.cause.len(), 3, "{}", report.to_json());
}
