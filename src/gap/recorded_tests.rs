//! Recordings as the tests of this module read them.

use std::fs::File;
use std::io::{BufRead, BufReader};

use super::{Recording, Study};
use crate::device::KINDS;
use crate::plant::{self, Plant, embedded::Embedded};
use crate::prototype::source::{Layered, Memory};
use crate::trace::Reader;

/// A pusher that is a per cent slow beside a motor and a gripper that are as they should be.
pub const SLOW_PUSHER: &str = "tests/data/pusher-a-per-cent-slow.cps.jsonl.zst";
/// A pusher with nothing wrong, beside a motor and a gripper.
pub const ORDERLY_PUSHER: &str = "tests/data/pusher-in-order.cps.jsonl.zst";
/// A pusher whose clock is slow, beside a motor and a gripper.
pub const LATE_PUSHER: &str = "tests/data/pusher-whose-clock-is-slow.cps.jsonl.zst";
/// A robot whose axes are not square, beside a motor that is as it should be.
pub const CROOKED_ROBOT: &str = "tests/data/robot-that-is-not-square.cps.jsonl.zst";
/// A belt with nothing wrong whose parts are put 3 mm before a beam, which it should be at; beside it a motor.
pub const PUT_AT_A_BEAM: &str = "tests/data/belt-whose-parts-are-put-at-a-beam.cps.jsonl.zst";
/// A gripper that is switched on 4.1 ms late, and reported every 50 ms, beside a robot that is as it should be.
pub const LATE_GRIPPER: &str = "tests/data/gripper-that-is-switched-on-late.cps.jsonl.zst";
/// An axis that rubs a little.
pub const RUBBING_AXIS: &str = "tests/data/axis-that-rubs-a-little.cps.jsonl.zst";
/// An axis that breaks away at 3.53 N, beside a motor.
pub const STICKING_AXIS: &str = "tests/data/axis-that-breaks-away.cps.jsonl.zst";
/// An axis that rubs by 32.5 N·s/m and is pulled by 0.099 N, beside a motor.
pub const PULLED_AXIS: &str = "tests/data/axis-that-is-pulled-a-little.cps.jsonl.zst";
/// A pusher whose switch goes off 55 ms late, beside a motor and a gripper.
pub const OFF_LATE: &str = "tests/data/pusher-whose-switch-goes-off-late.cps.jsonl.zst";
/// A gripper that leaks, and whose commands jitter by 21 ms, beside a robot.
pub const LEAKING_GRIPPER: &str = "tests/data/gripper-that-leaks-and-jitters.cps.jsonl.zst";
/// A gripper that leaks, beside a robot whose arrivals are seen once they have stood for 1 ms.
pub const LEAK_BEHIND_A_FILTER: &str = "tests/data/gripper-that-leaks-behind-a-filter.cps.jsonl.zst";
/// A robot whose reports are 68 µs late, beside a motor and an axis whose are 532 µs old.
pub const LATE_ROBOT: &str = "tests/data/robot-whose-reports-are-late.cps.jsonl.zst";
/// A pusher whose switch at the retracted end is blind over 100 mm and so never comes again, beside a motor and a gripper.
pub const BLIND_SWITCH: &str = "tests/data/pusher-whose-switch-is-blind.cps.jsonl.zst";
/// A belt whose barrier A is blind over 100 mm of what parts go, and sees each for 0.2 m of its 0.3, beside a motor.
pub const BLIND_BARRIER: &str = "tests/data/belt-whose-barrier-is-blind.cps.jsonl.zst";
/// A robot whose gripping axis turns with a lag of 0.23 ms, which its nominal limits nearly make up for, beside a gripper.
pub const LAGGING_ROBOT: &str = "tests/data/robot-whose-axis-lags-a-little.cps.jsonl.zst";
/// A belt whose parts slip on it beyond 0.2 m/s², beside a motor.
pub const SLIPPING_PARTS: &str = "tests/data/belt-whose-parts-slip.cps.jsonl.zst";
/// A belt that starts 111 ms late and whose speed is reported 1.195 times too high, beside a motor.
pub const STARTS_LATE: &str = "tests/data/belt-that-starts-late.cps.jsonl.zst";
/// A motor that is told all 99 ms late and speeds up by 26.6 rad/s² instead of 20, beside a gripper.
pub const TOLD_LATE: &str = "tests/data/motor-that-is-told-late.cps.jsonl.zst";

/// What a recording in a folder of `tests/data` says of the plant beside it.
pub fn study_of_folder(folder: &str) -> Study {
    let (plant, recording) = of_folder(folder);
    Study::new(&plant, &[recording]).expect("a study")
}

/// Such a plant, and its recording.
pub fn of_folder(folder: &str) -> (Plant, Recording) {
    let (path, trace) = (format!("{folder}/plant.xml"), format!("{folder}/train.cps.jsonl.zst"));
    let text = std::fs::read_to_string(&path).expect("the plant's file");
    let plant =
        plant::load(&Layered(Memory([(path.clone(), text)].into()), Embedded), &path, KINDS).expect("the plant");
    let reader = Reader::new(&trace, BufReader::new(File::open(&trace).expect("the recording"))).expect("a trace");
    let recording = Recording::read(&plant, &trace, reader, &[]).expect("a recording");
    (plant, recording)
}

/// The rig that was recorded.
pub fn rig() -> Plant {
    plant::load(&Embedded, "models/rig-toleranced", KINDS).expect("the rig")
}

/// What a recording of it says of its devices.
pub fn study(path: &str) -> Study {
    study_of(path, BufReader::new(File::open(path).expect("the recording")))
}

/// The same of a trace by this name.
pub fn study_of(name: &str, trace: impl BufRead) -> Study {
    Study::new(&rig(), &[recording_of(name, trace)]).expect("a study")
}

/// A recording of the rig.
pub fn recording(path: &str) -> Recording {
    recording_of(path, BufReader::new(File::open(path).expect("the recording")))
}

fn recording_of(name: &str, trace: impl BufRead) -> Recording {
    let reader = Reader::new(name, trace).expect("a trace");
    Recording::read(&rig(), name, reader, &[]).expect("a recording")
}

/// The lines of a recording.
pub fn text_of(path: &str) -> String {
    let lines = zstd::decode_all(File::open(path).expect("the recording")).expect("a stream");
    String::from_utf8(lines).expect("text")
}
