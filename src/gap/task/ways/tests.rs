//! Ways that scatter, of what is told to two devices, and what must not be taken for them.

use super::super::tests::{SIGNALS, recorded};
use super::*;
use crate::gap::{Overrides, Predicted, Study, evidence, recorded_tests};

/// How far ways scatter, s: each is somewhere within three times as much.
const SCATTER_S: f64 = 3e-5;

/// A way that is shorter or longer than most, s, by the instant at which something was told.
fn way(told: f64) -> f64 {
    let turn = (told * 1e3).round() as u64;
    ((turn * 7919 % 1009) as f64 / 504.0 - 1.0) * 3.0_f64.sqrt() * SCATTER_S
}

/// A machine under `task` on which what is told to a device acts as much later as `later` says.
fn study(task: Task, later: impl Fn(&str, f64) -> f64) -> Study {
    let still = recorded(&SIGNALS, |_, _| 0.0);
    let values = |(device, name): (&str, &str)| {
        let mut subject = still.subject(device).expect("it moves").clone();
        subject.set_tick(0, 0.0, 0.0);
        subject.set_task(0, task);
        subject.runs[0].commands.iter_mut().for_each(|(_, told)| told.at += later(device, told.at));
        let place = subject.signals.iter().position(|info| info.property == name).expect("its signal");
        match subject.predict(&[], &Overrides::none()).expect("a prediction").runs[0][place].clone() {
            Predicted::Level(values) => values,
            other => panic!("{other:?}"),
        }
    };
    let each = SIGNALS.map(|signal| (signal, values(signal)));
    recorded(&SIGNALS, |signal, look| {
        let (_, values) = each.iter().find(|(other, _)| *other == signal).expect("one of them");
        values[look.min(values.len() - 1)]
    })
}

/// Whether a device has a gap of its own.
fn is_off(study: &Study, device: &str) -> bool {
    let place = study.subjects.iter().position(|subject| subject.name == device).expect("a device");
    evidence(&study.subjects[place], &study.bare[place].prediction) > THRESHOLD
}

#[test]
fn ways_that_scatter_are_no_gap() {
    let study = study(Task::default(), |_, told| way(told));
    let found = study.tasks[0].scatter_s;
    assert!((0.5 * SCATTER_S..2.0 * SCATTER_S).contains(&found), "{found}");
    assert!(!is_off(&study, "Motor") && !is_off(&study, "Axis"));
}

#[test]
fn what_is_told_in_time_has_ways_that_do_not_scatter() {
    let study = study(Task::default(), |_, _| 0.0);
    assert_eq!(study.tasks[0].scatter_s, 0.0);
}

/// How a robot is wrong whose axes are not square looks a little like ways that scatter, by which a motor would be wrong that is as it should be.
#[test]
fn how_one_device_is_wrong_is_no_way_of_commands() {
    let study = recorded_tests::study(recorded_tests::CROOKED_ROBOT);
    assert_eq!(study.tasks[0].scatter_s, 0.0);
    assert!(is_off(&study, "Robot") && !is_off(&study, "Motor"));
}

/// A command whose way takes it over the border of the task's cycle is taken up a whole cycle sooner or later; each that is is found.
#[test]
fn commands_near_a_border_of_the_task_are_taken_up_a_cycle_later() {
    let task = Task { every_s: 1e-3, phase_s: 4.16e-4, ..Task::default() };
    let study = study(task, |_, told| way(told));
    assert!(study.tasks[0].every_s == 1e-3 && study.tasks[0].scatter_s > 0.0, "{:?}", study.tasks[0]);
    let still = recorded(&SIGNALS, |_, _| 0.0);
    let motor = |study: &Study| study.subject("Motor").expect("it moves").runs[0].commands.clone();
    let (mut before, mut after) = (0, 0);
    for ((_, stamped), (_, found)) in motor(&still).iter().zip(&motor(&study)) {
        let acted = task.taken_up(stamped.at + way(stamped.at));
        let is_wrong = |at: f64| usize::from((task.taken_up(at) - acted).abs() > 0.5 * task.every_s);
        before += is_wrong(stamped.at);
        after += is_wrong(found.at);
    }
    assert!(before >= 2 && after == 0, "{before} {after}");
}

/// Its dead time shows in all of a device's commands alike, however ways scatter.
#[test]
fn a_dead_time_of_a_device_stays_beside_ways_that_scatter() {
    let own = |device: &str| if device == "Motor" { 2e-4 } else { 0.0 };
    let study = study(Task::default(), |device, told| way(told) + own(device));
    assert!(study.tasks[0].scatter_s > 0.0 && is_off(&study, "Motor"), "{:?}", study.tasks[0]);
}

/// Where the axis says that its commands come in time, those of the motor scatter by its own fault.
#[test]
fn ways_of_one_device_alone_are_its_own() {
    let study = study(Task::default(), |device, told| if device == "Motor" { way(told) } else { 0.0 });
    assert!(study.tasks[0].scatter_s == 0.0 && is_off(&study, "Motor"), "{:?}", study.tasks[0]);
}

#[test]
fn what_acts_later_under_a_task_does_so_by_whole_cycles_and_near_a_border() {
    let task = Task { every_s: 1e-3, ..Task::default() };
    let taken_up = |at: f64, later: f64| task.taken_up(acting(task, at, later));
    assert!((taken_up(1.0009, 1e-3) - 1.002).abs() < 1e-9 && (taken_up(1.0011, -1e-3) - 1.001).abs() < 1e-9);
    // Half a cycle from either border, or by less than half of one.
    assert_eq!((acting(task, 1.0005, 1e-3), acting(task, 1.0009, 4e-4)), (1.0005, 1.0009));
    assert_eq!(acting(Task::default(), 1.0, 2e-5), 1.00002);
}
