//! The line: boxes go where belts, pushers and the controller take them.

use super::*;
use crate::catalogue::ENTRIES;
use crate::plant::STEP;
use crate::site::Site;

fn line() -> Line {
    Line::designed(&mut Dice::new(1, 7))
}

/// The instants at which a flag of the line rises while these belts run at 0.5 m/s from 0 on, for so many seconds.
fn rises(signal: &str, belts: &[&str], seconds: f64) -> Vec<f64> {
    let mut plant = line().plant(&[], 1);
    let at = plant.signals.iter().position(|one| one.name == signal).expect("a signal");
    for belt in belts {
        for (port, value) in [("velocityTarget", 0.5), ("motorDirection", 1.0)] {
            plant.tell(0.0, &Command { at: 0.0, signal: format!("{belt}.{port}"), value });
        }
    }
    let (mut now, mut was, mut found) = (0.0, true, Vec::new());
    while now < seconds {
        plant.advance(now + STEP, STEP);
        now += STEP;
        let mut values = Vec::new();
        plant.devices.iter().for_each(|(_, device)| device.read(now, &mut values));
        if values[at] != 0.0 && !was {
            found.push(now);
        }
        was = values[at] != 0.0;
    }
    found
}

#[test]
fn it_reads_as_many_values_as_it_has_signals() {
    let plant = line().plant(&[], 1);
    let mut values = Vec::new();
    plant.devices.iter().for_each(|(_, device)| device.read(0.0, &mut values));
    assert_eq!((values.len(), plant.signals.len(), plant.commands.len()), (94, 94, 36));
    let at_start: Vec<&str> =
        plant.signals.iter().zip(&values).filter(|(_, value)| **value != 0.0).map(|(s, _)| s.name.as_str()).collect();
    // A pallet stands at the picking place, a box before each exit's middle, and nothing moves.
    let expected = [
        "Conveyor2.lightBarrierA",
        "Conveyor2.lightBarrierB",
        "Pusher1.limitRetracted",
        "Pusher1.lightbarrierB",
        "Pusher2.limitRetracted",
        "Pusher2.lightbarrierB",
        "Pusher3.limitRetracted",
        "Pusher3.lightbarrierB",
        "Robot.cartesianArrived",
    ];
    assert_eq!(at_start, expected);
}

#[test]
fn a_belt_hands_its_boxes_on() {
    // The box at 0.5 m of Conveyor5 has its front at barrier A of Conveyor6 after 2.5 + 0.15 m; the ramp to 0.5 m/s costs 0.25 s.
    let found = rises("Conveyor6.lightBarrierA", &["Conveyor5", "Conveyor6"], 7.0);
    let expected = (3.0 - 0.5 + 0.3 - 0.15) / 0.5 + 0.25;
    assert!(found.len() == 1 && (found[0] - expected).abs() < 3e-4, "{found:?} {expected}");
    // On a curve the inner corner comes first: 0.8 m times atan(0.15/0.65) before the centre.
    let found = rises("Curve2.lightBarrierA", &["Conveyor6", "Curve2"], 7.0);
    let expected = (3.0 - 0.5 + 0.2 - 0.8 * (0.15_f64 / 0.65).atan()) / 0.5 + 0.25;
    assert!(found.len() == 1 && (found[0] - expected).abs() < 3e-4, "{found:?} {expected}");
}

#[test]
fn the_controller_takes_boxes_to_every_exit() {
    let line = line();
    let program = line.program(Part::Train, &[], 3, &mut Dice::new(1, 2));
    let pushes = |pusher: &str| {
        let command = format!("{pusher}.command");
        program.iter().filter(|told| told.signal == command && told.value == 1.0).count()
    };
    for (pusher, ..) in EXITS {
        assert!(pushes(pusher) >= 1, "{pusher} pushed nothing");
    }
    // A box that was pushed is seen to leave its exit.
    let mut plant = line.plant(&[], 3);
    let samples: Vec<f64> = (0..1080).map(|k| 0.05 * f64::from(k)).collect();
    let streams = plant.run(&program, &samples, &vec![false; plant.signals.len()], 54.0);
    for (.., exit) in EXITS {
        let leaves = ["lightBarrierA", "lightBarrierB"].map(|beam| {
            let at = plant.signals.iter().position(|signal| signal.name == format!("{exit}.{beam}")).expect("a beam");
            streams[at].points().iter().filter(|(_, cut)| *cut != 0.0).count()
        });
        // The one that lay there at first is one of them.
        assert!(leaves.iter().sum::<usize>() >= 2, "{exit}: {leaves:?}");
    }
    let again = line.program(Part::Train, &[], 3, &mut Dice::new(7, 2));
    assert_eq!(program, again, "the controller goes by the plant and its seed alone");
}

#[test]
fn effects_are_put_on_devices_that_the_line_has() {
    for entry in ENTRIES {
        for spot in entry.spots.iter().filter(|spot| Site::Line.fits(entry, **spot)) {
            assert!(line().has(spot.0), "{} at {}", entry.effect, spot.0);
            let quirk = line().fitted(entry.quirk(*spot, 0.5, &mut Dice::new(1, 3)));
            assert!(line().units.iter().any(|unit| unit.name == quirk.device), "{quirk:?}");
            assert_eq!(line().kind(&quirk.device), spot.0);
        }
    }
}
