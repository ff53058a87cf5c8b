//! The automation as its simulations see it.

use std::time::Duration;

use super::Control;
use super::bench::world::World;
use super::fault::{Fault, HUGE_BYTES};
use super::playback::Lines;
use crate::session::ClientEvent;
use crate::time::Instant;

const MS: Duration = Duration::from_millis(1);
const SECOND: Duration = Duration::from_secs(1);

fn world(faults: &[&str]) -> World {
    let faults: Vec<Fault> = faults.iter().map(|fault| fault.parse().expect("a fault")).collect();
    World::new(Control::ByPlant, &faults)
}

/// Whether the message sets `name` to `value`, as JSON.
fn sets(text: &str, name: &str, value: &str) -> bool {
    text.contains(&format!("{{\"name\":\"{name}\",\"value\":{value}}}"))
}

#[test]
fn a_new_simulation_first_receives_every_command() {
    let mut world = world(&[]);
    let end = world.join("one");
    let first = &world.ends[end].received[0];
    assert_eq!(first.matches("\"name\"").count(), 13, "{first}");
    assert!(sets(first, "Belt.motorDirection", "0") && sets(first, "Robot.XTarget", "0.0"), "{first}");
}

#[test]
fn the_commands_of_one_event_leave_in_one_message() {
    let mut world = world(&[]);
    let end = world.join("one");
    let received = &world.ends[end].received;
    assert_eq!(received.len(), 2, "{received:?}");
    // The first report starts every sequence of the rig.
    for (name, value) in [("Belt.motorDirection", "1"), ("Gripper.suctionOn", "true"), ("Axis.positionTarget", "0.25")]
    {
        assert!(sets(&received[1], name, value), "{name}: {}", received[1]);
    }
}

#[test]
fn every_simulation_receives_the_same_messages_in_the_same_order() {
    let mut world = world(&[]);
    let one = world.join("one");
    world.report(one, &[("Belt.driveEnabled", 1.0), ("Belt.driveRunning", 1.0)]);
    let two = world.join("two");
    let before = world.ends[one].received.len();
    for _ in 0..3 {
        world.report(one, &[("Belt.lightBarrierB", 1.0)]);
        world.report(one, &[("Belt.driveEnabled", 0.0), ("Belt.driveRunning", 0.0), ("Gripper.vacuumOn", 1.0)]);
        world.report(one, &[("Belt.lightBarrierB", 0.0), ("Pusher.limitRetracted", 1.0)]);
        world.advance(SECOND);
        world.report(one, &[("Gripper.vacuumOn", 0.0), ("Axis.position", 0.25)]);
    }
    let (one, two) = (&world.ends[one].received[before..], &world.ends[two].received);
    assert!(one.len() > 10);
    assert_eq!(one, &two[1..]);
    // What the later one received first is what the earlier one had been told by then.
    assert!(sets(&two[0], "Belt.motorDirection", "1"), "{}", two[0]);
}

#[test]
fn the_oldest_session_controls_and_the_next_takes_over() {
    let mut world = world(&[]);
    let one = world.join("one");
    let two = world.join("two");
    for end in [one, two] {
        world.report(end, &[("Belt.driveEnabled", 1.0), ("Belt.driveRunning", 1.0)]);
    }
    let count = world.ends[one].received.len();
    world.report(two, &[("Belt.lightBarrierB", 1.0)]);
    assert_eq!(world.ends[one].received.len(), count, "the second session's inputs do not control");
    world.leave(one);
    let last = world.ends[two].received.last().expect("messages");
    assert!(sets(last, "Belt.motorDirection", "0"), "its barrier is known at the take-over: {last}");
}

#[test]
fn a_simulation_that_returns_goes_on_where_it_was() {
    let mut world = world(&[]);
    let end = world.join("one");
    world.report(end, &[("Belt.driveEnabled", 1.0), ("Belt.driveRunning", 1.0)]);
    world.report(end, &[("Belt.lightBarrierB", 1.0)]);
    world.cut(end);
    let before = world.ends[end].received.len();
    world.advance(SECOND);
    let image = &world.ends[end].received[before];
    assert_eq!(image.matches("\"name\"").count(), 13);
    assert!(sets(image, "Belt.velocityTarget", "0.5") && sets(image, "Belt.motorDirection", "0"), "{image}");
}

#[test]
fn another_simulation_starts_the_program_anew() {
    let mut world = world(&[]);
    let one = world.join("one");
    world.report(one, &[("Belt.driveEnabled", 1.0)]);
    world.leave(one);
    let two = world.join("two");
    let received = &world.ends[two].received;
    assert!(sets(&received[0], "Belt.velocityTarget", "0.0"), "{}", received[0]);
    assert!(sets(&received[1], "Belt.velocityTarget", "0.5"), "{}", received[1]);
}

#[test]
fn round_trips_are_measured_and_messages_counted() {
    let mut world = world(&[]);
    let end = world.join("one");
    world.advance(3 * MS);
    world.report(end, &[("Belt.driveEnabled", 1.0)]);
    let statistics = world.automation.automation().statistics();
    assert_eq!((statistics.sessions, statistics.sessions_ever), (1, 1));
    assert_eq!((statistics.messages_in, statistics.messages_out), (2, 2));
    assert_eq!(statistics.values_in, 24);
    assert_eq!(statistics.round_trip_ns.len(), 1);
    assert!(statistics.round_trip_ns.equivalent(statistics.round_trip_ns.max(), 3_000_000));
}

#[test]
fn late_delays_everything_and_keeps_its_order() {
    let mut world = world(&["late:200"]);
    let end = world.join("one");
    assert!(world.ends[end].events.iter().all(|event| !matches!(event, ClientEvent::Established { .. })));
    world.advance(199 * MS);
    assert_eq!(world.ends[end].received.len(), 0);
    world.advance(SECOND);
    let End { times, received } = End::of(&world, end);
    assert_eq!(times[0], Instant::from_seconds(0.2), "the reply, and with it all commands");
    assert_eq!(times[1], Instant::from_seconds(0.4), "the answer to the first report");
    assert!(sets(&received[1], "Belt.motorDirection", "1"));
}

/// What one end received.
struct End {
    times: Vec<Instant>,
    received: Vec<String>,
}

impl End {
    fn of(world: &World, end: usize) -> End {
        End { times: world.ends[end].times.clone(), received: world.ends[end].received.clone() }
    }
}

#[test]
fn slow_handles_one_message_after_the_other() {
    let mut world = world(&["slow:50"]);
    let end = world.join("one");
    // Opened and Connect take 50 ms each, then the first report.
    world.advance(SECOND);
    assert_eq!(world.ends[end].times[0], Instant::from_seconds(0.1));
    assert_eq!(world.ends[end].times[1], Instant::from_seconds(0.15));
    let before = world.ends[end].received.len();
    world.report(end, &[("Axis.position", 0.25)]);
    world.report(end, &[("Belt.driveEnabled", 1.0), ("Belt.driveRunning", 1.0), ("Belt.lightBarrierB", 1.0)]);
    let start = world.now;
    world.advance(101 * MS);
    let place = world.ends[end].received[before..].iter().position(|text| sets(text, "Belt.motorDirection", "0"));
    assert_eq!(world.ends[end].times[before + place.expect("the belt stops")], start + 100 * MS);
}

#[test]
fn wrong_types_stand_beside_good_values() {
    let mut world = world(&["wrong-type"]);
    let end = world.join("one");
    let received = &world.ends[end].received;
    assert_eq!(received[0].matches("\"name\"").count(), 14, "{}", received[0]);
    assert!(sets(&received[1], "Belt.motorDirection", "1"), "good values still act: {}", received[1]);
    let faults = world.ends[end].events.iter().filter_map(|event| match event {
        ClientEvent::Values(staged) => Some(staged.faults.len()),
        _ => None,
    });
    assert_eq!(faults.collect::<Vec<_>>(), [1, 1]);
    assert_eq!(world.automation.automation().statistics().refused, 2);
}

#[test]
fn unknown_names_stand_beside_good_values() {
    let mut world = world(&["unknown-name"]);
    let end = world.join("one");
    let received = &world.ends[end].received;
    assert!(received.iter().all(|text| sets(text, "NoSuchInstance.noSuchSignal", "true")), "{received:?}");
    assert_eq!(world.automation.automation().statistics().refused, received.len() as u64);
}

#[test]
fn drop_breaks_every_connection_off_and_the_simulation_returns() {
    let mut world = world(&["drop:2"]);
    let end = world.join("one");
    world.advance(10 * SECOND);
    let lost = |event: &&ClientEvent| matches!(event, ClientEvent::Lost { was_established: true, .. });
    assert_eq!(world.ends[end].events.iter().filter(lost).count(), 4, "{:?}", world.ends[end].events);
}

#[test]
fn refuse_answers_every_connect_with_the_code() {
    let mut world = world(&["refuse:409"]);
    let end = world.join("one");
    world.advance(20 * SECOND);
    let codes = world.ends[end].events.iter().filter_map(|event| match event {
        ClientEvent::Refused { result, .. } => Some(result.0),
        _ => None,
    });
    let codes: Vec<i64> = codes.collect();
    assert!(codes.len() > 2 && codes.iter().all(|code| *code == 409), "{codes:?}");
    assert_eq!(world.ends[end].received.len(), 0);
}

#[test]
fn silent_says_nothing_at_all() {
    let mut world = world(&["silent"]);
    let end = world.join("one");
    world.advance(20 * SECOND);
    let lost = |event: &ClientEvent| matches!(event, ClientEvent::Lost { was_established: false, .. });
    assert!(world.ends[end].events.iter().any(lost));
    assert_eq!(world.ends[end].received.len(), 0);
}

#[test]
fn garbage_follows_every_message_and_ends_no_session() {
    let mut world = world(&["garbage"]);
    let end = world.join("one");
    for _ in 0..40 {
        world.advance(SECOND);
        world.report(end, &[("Gripper.vacuumOn", 1.0)]);
        world.advance(SECOND);
        world.report(end, &[("Gripper.vacuumOn", 0.0)]);
    }
    let events = &world.ends[end].events;
    assert!(world.ends[end].rubbish > 40, "{}", world.ends[end].rubbish);
    assert!(!events.iter().any(|event| matches!(event, ClientEvent::Lost { .. })), "{events:?}");
}

#[test]
fn huge_comes_once_and_the_simulation_returns() {
    let mut world = world(&["huge"]);
    let end = world.join("one");
    world.advance(10 * SECOND);
    let lengths: Vec<usize> = world.ends[end].received.iter().map(String::len).collect();
    assert_eq!(lengths.iter().filter(|length| **length > HUGE_BYTES).count(), 1, "{lengths:?}");
    assert!(lengths[1] > HUGE_BYTES && lengths.len() > 2, "{lengths:?}");
    let stood = |event: &&ClientEvent| matches!(event, ClientEvent::Established { .. });
    assert_eq!(world.ends[end].events.iter().filter(stood).count(), 2);
}

#[test]
fn several_faults_at_once() {
    let mut world = world(&["late:100", "unknown-name", "wrong-type"]);
    let end = world.join("one");
    world.advance(SECOND);
    assert_eq!(world.ends[end].received[0].matches("\"name\"").count(), 15);
    assert_eq!(world.ends[end].times[0], Instant::from_seconds(0.1));
}

#[test]
fn what_follows_from_the_seed_is_the_same_every_time() {
    let run = || {
        let mut world = world(&["garbage", "wrong-type"]);
        let end = world.join("one");
        world.advance(10 * SECOND);
        world.ends[end].received.clone()
    };
    assert_eq!(run(), run());
}

fn trace(lines: &'static [(f64, &'static str)]) -> Control {
    Control::Playback(Box::new(move || {
        let line = |(at, text): &(f64, &str)| Ok((Instant::from_seconds(*at), (*text).to_owned()));
        Ok(Box::new(lines.iter().map(line)) as Lines)
    }))
}

#[test]
fn a_trace_is_played_word_by_word_at_its_times() {
    let lines = &[
        (0.0, r#"{"SendValue":[{"name":"Belt.velocityTarget","value":0.5}]}"#),
        (0.25, r#"{"SendValue":[{"name":"Belt.motorDirection","value":1.0},{"name":"No.such","value":1}]}"#),
        (0.25, r#"{"SendValue":[{"name":"Belt.motorDirection","value":0}]}"#),
        (1.5, r#"{"SendValue":[{"name":"Belt.velocityTarget","value":"T0s="}]}"#),
    ];
    let mut world = World::new(trace(lines), &[]);
    world.advance(SECOND);
    let end = world.join("one");
    world.advance(2 * SECOND);
    let End { times, received } = End::of(&world, end);
    assert!(sets(&received[0], "Belt.velocityTarget", "0.5"), "{}", received[0]);
    assert_eq!(received[1..], lines[1..].iter().map(|(_, text)| text.to_string()).collect::<Vec<_>>());
    assert_eq!(times[1..].iter().map(|at| at.seconds()).collect::<Vec<_>>(), [1.25, 1.25, 2.5]);
    // Who comes later receives what stands by then.
    let two = world.join("two");
    assert!(sets(&world.ends[two].received[0], "Belt.motorDirection", "0"));
    assert!(sets(&world.ends[two].received[0], "Belt.velocityTarget", "0.5"));
}

#[test]
fn a_torn_trace_is_played_as_far_as_it_goes() {
    let control = Control::Playback(Box::new(|| {
        let text = r#"{"SendValue":[{"name":"Belt.velocityTarget","value":0.5}]}"#.to_owned();
        let lines = vec![Ok((Instant::from_seconds(0.5), text)), Err("line 3, column 7: no JSON".to_owned())];
        Ok(Box::new(lines.into_iter()) as Lines)
    }));
    let mut world = World::new(control, &[]);
    let end = world.join("one");
    world.advance(10 * SECOND);
    assert_eq!(world.ends[end].received.len(), 2);
    assert_eq!(world.automation.timeout(), None);
}
