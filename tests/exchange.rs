//! What travels between simulations and an automation, of the requirements of the reference's section 5.2.1.

mod lockstep;

use std::time::Duration;

use kinetwin::time::Instant;
use kinetwin::value::Value;
use lockstep::Lockstep;

const MS: Duration = Duration::from_millis(1);

/// R005: several simulations, one automation.
#[test]
fn two_simulations_receive_the_same_messages_in_the_same_order() {
    let mut both = Lockstep::new("models/rig", &[]);
    both.join(1);
    both.run_to(2.0);
    // The second comes later, and its boxes come at other times: it is told, and does not control.
    both.join(2);
    let before = both.simulations[0].received().len();
    both.run_to(30.0);
    let (first, second) = (both.simulations[0].received(), both.simulations[1].received());
    assert!(first.len() - before > 100, "{}", first.len());
    assert_eq!(second[0].matches("\"name\"").count(), 13, "it begins with the present value of every command");
    assert_eq!(first[before..], second[1..]);
}

/// R003, R004: a light barrier that is cut for a millisecond, and an IO cycle of twenty.
#[test]
fn a_flash_of_a_light_barrier_is_seen_as_two_values_in_order() {
    let mut rig = Lockstep::new("models/rig", &[]);
    rig.join(1);
    let hub = rig.hub.clone();
    let simulation = &mut rig.simulations[0];
    let barrier = simulation.plant.signal_map.register("Belt.lightBarrierB").expect("the rig's");
    let mut registers = simulation.engine.registers().to_vec();
    for step in 0..100u32 {
        let now = Instant::ZERO + step * MS;
        registers[barrier.index()] = Value::Bool(step == 47);
        simulation.publish(now, &registers);
        if step % 20 == 0 {
            simulation.exchange(now);
        }
    }
    let heard = &hub.borrow().heard;
    let seen: Vec<(Instant, bool)> = heard
        .iter()
        .skip(2)
        .filter(|(_, text)| text.contains("Belt.lightBarrierB"))
        .map(|(at, text)| (*at, text.contains(r#"{"name":"Belt.lightBarrierB","value":true}"#)))
        .collect();
    let cycle = Instant::ZERO + 60 * MS;
    assert_eq!(seen, [(cycle, true), (cycle, false)], "{heard:#?}");
    // The function blocks took both: at the first the belt stops and backs off, at the second it stops.
    let decided: Vec<String> = simulation.received().split_off(2);
    assert!(decided[0].contains(r#"{"name":"Belt.motorDirection","value":-1}"#), "{decided:#?}");
    assert!(decided[1].contains(r#"{"name":"Belt.motorDirection","value":0}"#), "{decided:#?}");
}
