//! A servo that eases into its target and accelerates no faster than it can, behind a dead time and with play: a lag beside that dead
//! time says nothing more, nor does a limit without the lag. Its chirp is computed here, by equations of the test's own.

use std::f64::consts::TAU;
use std::fmt::Write;
use std::io::Cursor;

use kinetwin::gap::Recording;
use kinetwin::gap::diagnosis::{Options, diagnose};
use kinetwin::run::model;
use kinetwin::trace::Reader;

const SECONDS: f64 = 60.0;
const CYCLE_S: f64 = 0.02;
const STEP_S: f64 = 2e-4;

/// Twelve samples in a hundred are faster than the drive can follow.
fn target(t: f64, amplitude: f64) -> f64 {
    let octaves = 5.0_f64;
    let (slow, t) = (0.15, t.max(0.0));
    // From 0.15 Hz to 4.8 Hz, evenly in the logarithm.
    let phase = slow * SECONDS / (octaves * 2.0_f64.ln()) * (2.0_f64.powf(octaves * t / SECONDS) - 1.0);
    amplitude * (TAU * phase).sin()
}

/// The servo: x' = v, v → (u(t − 50 ms) − x)/50 ms, |v'| ≤ 30 rad/s², then a play of 15 mrad, read in steps of 1.5 mrad.
fn recorded(amplitude: f64) -> String {
    let mut text = "{\"trace\":\"kinetwin/1\",\"source\":\"plant\",\"commands\":\"sampled\"}\n".to_owned();
    let (mut x, mut v, mut y) = (0.0_f64, 0.0_f64, 0.0_f64);
    let steps = (CYCLE_S / STEP_S).round() as u32;
    for sample in 0..(SECONDS / CYCLE_S) as u32 {
        let t = f64::from(sample) * CYCLE_S;
        let reported = (y / 1.5e-3).round() * 1.5e-3;
        let message = |from: &str, name: &str, value: f64| {
            format!("{{\"t\":{t:.6},\"from\":\"{from}\",\"SendValue\":[{{\"name\":\"{name}\",\"value\":{value:.6}}}]}}")
        };
        writeln!(text, "{}", message("automation", "Rotation.positionTarget", target(t, amplitude))).expect("a text");
        writeln!(text, "{}", message("plant", "Rotation.position", reported)).expect("a text");
        for step in 0..steps {
            let asked = (target(t + f64::from(step) * STEP_S - 0.05, amplitude) - x) / 0.05;
            v = asked.clamp(v - 30.0 * STEP_S, v + 30.0 * STEP_S);
            x += v * STEP_S;
            y = y.clamp(x - 7.5e-3, x + 7.5e-3);
        }
    }
    text
}

#[test]
fn a_lag_and_a_limit_are_found_that_show_only_together() {
    let plant = model::load("models/servo-arm").expect("the arm");
    let [train, held_out] = [0.15, 0.12].map(|amplitude| {
        let reader = Reader::new("chirp", Cursor::new(recorded(amplitude))).expect("a trace");
        [Recording::read(&plant, "chirp", reader, &[]).expect("a recording")]
    });
    let looked_for = ["dead-time", "backlash", "first-order-lag", "acceleration-limit", "velocity-limit"];
    let options = Options {
        is_asked: &|id| looked_for.contains(&id),
        is_meant: &|name| name == "Rotation",
        is_stopped: &|| false,
        tell: &|_| {},
    };
    let report = diagnose(&plant, &train, &held_out, &options).expect("a diagnosis").report;
    for (effect, value) in
        [("dead-time", 0.05), ("first-order-lag", 0.05), ("acceleration-limit", 30.0), ("backlash", 0.015)]
    {
        let cause = report.cause.iter().find(|cause| cause.effect == effect);
        let found = cause.unwrap_or_else(|| panic!("no {effect}: {}", report.to_json())).parameters[0].value;
        assert!((found / value - 1.0).abs() < 0.1, "{effect}: {found} of {value}\n{}", report.to_json());
    }
    assert_eq!(report.cause.len(), 4, "{}", report.to_json());
}
