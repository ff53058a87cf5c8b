//! The same machine in simulated time, by hand, and over a socket.

use std::collections::BTreeMap;

use kinetwin::trace::Sender;
use kinetwin::wire::Message;

use super::take;
use crate::bench::quirk;
use crate::plant::Kind;
use crate::record::{self, Said};
use crate::rig::signals;
use crate::socket::{record, running::Running};

const SCRIPT: [(f64, &str, f64); 12] = [
    (0.1, "Belt.velocityTarget", 0.4),
    (0.1, "Belt.motorDirection", 1.0),
    (0.1, "Motor.enable", 1.0),
    (0.3, "Motor.speedTarget", 6.0),
    (0.4, "Axis.positionTarget", 0.02),
    (0.4, "Gripper.suctionOn", 1.0),
    (0.5, "Pusher.command", 1.0),
    (1.0, "Robot.XTarget", 0.1),
    (1.3, "Gripper.suctionOn", 0.0),
    (2.0, "Pusher.command", 2.0),
    (2.0, "Motor.speedTarget", 0.0),
    (2.0, "Belt.motorDirection", 0.0),
];
const SECONDS: f64 = 3.5;

/// By signal, what was reported, repeats left out.
fn reported(said: &[Said]) -> BTreeMap<String, Vec<f64>> {
    let mut reported: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    for Said { text, .. } in said.iter().filter(|said| said.from == Sender::Plant) {
        let Ok(Message::SendValue(entries)) = Message::decode(text) else { panic!("{text}") };
        for entry in entries {
            let (name, raw) = (entry.name.expect("a name"), entry.value.expect("a value"));
            let number = raw.as_bool().map(f64::from).or_else(|| raw.as_number()?.parse().ok()).expect("a number");
            reported.entry(name.into_owned()).or_default().push(number);
        }
    }
    reported
}

#[test]
fn a_plant_that_runs_while_it_is_told_does_what_one_does_that_knew_before() {
    let quirks = vec![
        quirk("Axis", "backlash", &[("gap", 0.002)]),
        crate::quirk::Quirk { place: "report-link".to_owned(), ..quirk("Belt", "dead-time", &[("time", 0.07)]) },
        crate::quirk::Quirk { place: "command-link".to_owned(), ..quirk("Pusher", "dead-time", &[("time", 0.03)]) },
    ];
    let take = take(quirks, &SCRIPT);
    let seen = record::watch(&mut take.plant(), &take.script, &take.around, SECONDS, take.seed);
    let mut running = Running::new(take.plant(), &take.around, take.seed);
    let mut script = take.script.iter().peekable();
    for (due, expected) in seen.due.iter().zip(&seen.values) {
        let sample = take.around.sample(*due);
        while let Some(command) = script.next_if(|command| command.at < sample) {
            assert!(running.hear(command.at, &command.signal, command.value));
        }
        running.run_until(sample);
        for ((signal, found), expected) in signals().iter().zip(running.values()).zip(expected) {
            // Its steps end at other instants; a quantum is what a report can show.
            let allowed = if signal.kind == Kind::Level { signal.quantum } else { 0.0 };
            assert!((found - expected).abs() <= allowed, "{} at {sample} s: {found}, not {expected}", signal.name);
        }
    }
    assert!(script.next().is_none(), "all commands were heard");
}

#[test]
fn over_a_socket_flags_change_in_the_same_order_and_levels_come_to_the_same() {
    let take = take(Vec::new(), &SCRIPT);
    let seen = record::watch(&mut take.plant(), &take.script, &take.around, SECONDS, take.seed);
    let simulated = reported(&record::reports(&seen, &signals(), &take.around, take.seed));
    let (said, _) = record(&take, SECONDS).expect("a recording");
    let over_socket = reported(&said);

    assert!(said.is_sorted_by(|one, next| one.at <= next.at), "a recorder's time never goes back");
    let commands = said.iter().filter(|said| said.from == Sender::Automation).map(|said| said.text.as_str());
    assert!(
        commands.eq(record::commands(&take.script, &crate::rig::commands()).iter().map(|said| said.text.as_str())),
        "every command, in order"
    );
    for signal in signals() {
        let [one, other] = [&simulated, &over_socket].map(|all| all[&signal.name].as_slice());
        match signal.kind {
            // What it is in motion depends on when a report falls; where it comes to rest does not.
            Kind::Level | Kind::Count => {
                let (one, other) = (one[one.len() - 1], other[other.len() - 1]);
                let allowed = if signal.kind == Kind::Count { 400.0 } else { 2.0 * signal.quantum };
                assert!((one - other).abs() <= allowed, "{}: {other} over a socket, not {one}", signal.name);
            }
            Kind::Flag | Kind::Code => assert_eq!(one, other, "{}", signal.name),
        }
    }
    assert_eq!(over_socket["Pusher.limitExtended"], [0.0, 1.0, 0.0], "the script moves what it should");
}
