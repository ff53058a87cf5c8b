//! What is lost, bad or late is an error that says so, and leaves nothing behind.

use std::io;
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::thread;

use kinetwin::wire::{Connect, Message};

use super::take;
use crate::arguments::Pairs;
use crate::exam::ExamError;
use crate::plans::{Sizes, plans};
use crate::site::Sites;
use crate::socket::clock::Lateness;
use crate::socket::end::End;
use crate::socket::{SocketError, automation, client, in_time, pairs};

fn listener() -> (TcpListener, SocketAddr) {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).expect("a free port");
    let address = listener.local_addr().expect("its address");
    (listener, address)
}

/// Says `said`; then hangs up, or waits until the other end does.
fn say(mut end: End, said: &[&str], hangs_up: bool) {
    for text in said {
        end.send((*text).to_owned()).expect("sent");
    }
    while !hangs_up && end.expect().is_ok() {}
}

/// What a plant says of an automation that accepts it and says `said`.
fn plant_hears(said: &[&str], hangs_up: bool) -> String {
    let (listener, address) = listener();
    thread::scope(|scope| {
        scope.spawn(move || {
            let mut end = End::accept(&listener, "plant").expect("a plant");
            let (_, text) = end.expect().expect("a Connect");
            let reply = text.replace("Connect", "ConnectReply");
            end.send(reply.replace("}}", r#","ServerName":"","result":200}}"#)).expect("sent");
            say(end, said, hangs_up);
        });
        let take = take(Vec::new(), &[]);
        let error = client::run(address, take.plant(), &take.around, 30.0, 1).expect_err("no recording");
        error.to_string()
    })
}

/// What an automation says of a plant that says `said`.
fn automation_hears(said: &[&str], hangs_up: bool) -> String {
    let (listener, address) = listener();
    thread::scope(|scope| {
        scope.spawn(move || {
            say(End::connect(address, "automation").expect("an automation"), said, hangs_up);
        });
        automation::run(&listener, &[], 30.0).map(|_| ()).expect_err("no recording").to_string()
    })
}

#[test]
fn a_plant_names_what_its_automation_does_wrong() {
    let zero = r#"{"SendValue":[{"name":"Motor.speedTarget","value":0}]}"#;
    let check = |said: &[&str], expected: &str| {
        let error = plant_hears(said, expected.contains("lost"));
        assert!(error.contains(expected), "{said:?}: {error}");
    };
    check(&[zero], "connection to the automation was lost");
    check(&[zero, "{"], "the automation sent what no recording can hold");
    check(&[r#"{"SendValue":[{"name":"Motor.speedTarget","value":"fast"}]}"#], "neither a number nor a flag");
    check(&[r#"{"SendValue":[{"name":"Motor.sped","value":1}]}"#], "no command called Motor.sped");
    check(&[r#"{"QueryAll":{}}"#], "a QueryAll now");
}

#[test]
fn an_automation_names_what_its_plant_does_wrong() {
    let connect = |enable| Message::Connect(Connect { id: "eA==".into(), enable, signals: None }).encode();
    let check = |said: &[&str], expected: &str| {
        let error = automation_hears(said, expected.contains("lost"));
        assert!(error.contains(expected), "{said:?}: {error}");
    };
    check(&[], "connection to the plant was lost");
    check(&[r#"{"SendValue":[]}"#], "a SendValue before a Connect");
    check(&[&connect(true)], "connection to the plant was lost");
    check(&[&connect(true), "nonsense"], "the plant sent what no recording can hold");
    // It leaves before the recording is over.
    check(&[&connect(true), &connect(false)], "a Connect now");
}

#[test]
fn what_did_not_keep_time_is_refused() {
    let mut lateness = Lateness::default();
    (0..2000).for_each(|_| lateness.note(0.003));
    lateness.note(0.5);
    assert!(in_time(&lateness, 0.01).is_ok(), "one of two thousand");
    let mut unsure = lateness.clone();
    unsure.note_ways(&[1.0, 2.0, 3.0], &[7.0001, 8.0, 9.0001]);
    assert!(in_time(&unsure, 0.01).is_ok(), "two clocks differ by 6 s, and a way by 0.1 ms");
    unsure.note_ways(&[1.0, 2.0, 3.0], &[7.0, 8.0006, 9.0]);
    let error = in_time(&unsure, 0.01).expect_err("a command that was late").to_string();
    assert!(error.contains("took 0.6 ms more or less than that of most"), "{error}");
    (0..2).for_each(|_| lateness.note(0.0041));
    let error = in_time(&lateness, 0.01).expect_err("too late").to_string();
    assert!(error.contains("4.1 ms late, and at most 4.0 ms"), "{error}");
}

#[test]
fn pairs_whose_recording_fails_leave_nothing() {
    let place = tempfile::tempdir().expect("a folder");
    let folder = place.path().join("pairs");
    let asked = Pairs { folder, seed: 1, cases: 1, jobs: None, answers: None };
    let sizes = Sizes { none: 1, single: 0, faint: 0, below: 0, two_on_one: 0, one_on_each: 0, outside: 0 };
    let lost = || SocketError::Lost { peer: "plant", at: 1.0, source: tungstenite::Error::ConnectionClosed };
    let error = pairs::write(&asked, &plans(sizes, Sites::Rig, 1), |_| Err(lost())).expect_err("no recording");
    assert!(matches!(&error, ExamError::Socket { path, .. } if path.ends_with("socket/case-001")), "{error}");
    let left: Vec<_> = place.path().read_dir().expect("a folder").collect::<io::Result<_>>().expect("its entries");
    assert!(left.is_empty(), "{left:?}");
}
