//! Faults, swept by seed: whatever happens to the connection, what is received within a session is what was sent, in
//! order, and the session comes back.

use rayon::prelude::*;

use super::dice::Dice;
use super::pair::{Frame, Log, Pair};
use super::*;
use crate::wire::ResultCode;

const GARBAGE: [&str; 12] = [
    "",
    "{}",
    "hello",
    "{\"SendValue\":[{\"name\":\"Belt.sequence\",\"value\":",
    "{\"SendValue\":[{\"name\":\"Belt.sequence\",\"value\":null},{\"name\":\"Belt.echo\",\"value\":null}]}",
    "{\"SendValue\":[{\"name\":\"Belt.sequence\",\"value\":1e400}],\"QueryAll\":{}}",
    "{\"SendValueReply\":[{\"name\":\"x\",\"result\":404}]}",
    "{\"SendValue\":{}}",
    "{\"ConnectReply\":{\"Id\":\"eA==\",\"enable\":true,\"result\":200}}",
    "{\"ConnectReply\":{\"Id\":\"cnVuIDE=\",\"enable\":false,\"result\":200}}",
    "{\"QueryAllReply\":{}}",
    "{\"Hello\":[[[]]]}",
];

fn misfortune(pair: &mut Pair, dice: &mut Dice) {
    match dice.roll(16) {
        0 => pair.cut(),
        1 => pair.inject(Frame::Binary, dice.roll(2) == 0),
        2 => pair.inject(Frame::InvalidUtf8, dice.roll(2) == 0),
        3 => pair.inject(Frame::TooLong, dice.roll(2) == 0),
        4..=7 => {
            let text = GARBAGE[dice.roll(GARBAGE.len() as u64) as usize];
            pair.inject(Frame::Text(text.to_owned()), dice.roll(2) == 0);
        }
        8 => pair.latency = Duration::from_millis(dice.roll(3000)),
        9 => pair.latency = Duration::from_millis(dice.roll(9000)),
        10 => pair.listening = dice.roll(2) == 0,
        11 => {
            let result = ResultCode(400 + dice.roll(100) as i64);
            pair.settings.refuse = (dice.roll(2) == 0).then(|| (result, "not now".to_owned()));
        }
        _ => {}
    }
}

/// How many scripts of faults are tried.
const SEEDS: u64 = 10_000;

/// What a script came to, counted, so that the sweep cannot have shown nothing.
#[derive(Default)]
struct Tally {
    sessions: usize,
    values: usize,
    /// Connections that broke while values were under way.
    broken: usize,
}

#[test]
fn what_is_received_in_a_session_is_what_was_sent_and_the_session_comes_back() {
    let sum = |a: Tally, b: Tally| Tally {
        sessions: a.sessions + b.sessions,
        values: a.values + b.values,
        broken: a.broken + b.broken,
    };
    let total = (0..SEEDS).into_par_iter().map(live_through).reduce(Tally::default, sum);
    // A sweep that broke nothing, or brought nothing, has shown nothing.
    let Tally { sessions, values, broken } = total;
    assert!(
        sessions > 25_000 && values > 1_250_000 && broken > 7_500,
        "{sessions} sessions, {values} values, {broken} broken"
    );
}

/// Two minutes of faults by `seed`, and a minute without.
fn live_through(seed: u64) -> Tally {
    let mut tally = Tally::default();
    let mut dice = Dice::new(seed);
    let mut pair = Pair::new();
    // What falls due at the same instant happens in any order.
    pair.order = Some(Dice::new(!seed));
    while pair.now < at(120_000) {
        if dice.roll(4) == 0 {
            misfortune(&mut pair, &mut dice);
        }
        (0..dice.roll(4)).for_each(|_| pair.count_up());
        let now = pair.now;
        pair.run_until(now + Duration::from_millis(1 + dice.roll(700)));
    }
    // All is well again. The longest pause and the timeouts before it may still have to pass.
    (pair.listening, pair.settings.refuse, pair.latency) = (true, None, Duration::from_millis(1));
    pair.run_until(at(120_000 + 60_000));
    assert!(pair.client.is_established(), "seed {seed}: no session a minute after the last fault");
    pair.count_up();
    pair.run_until(at(181_000));

    for connection in &pair.connections {
        check(&connection.commands, seed);
        check(&connection.reports, seed);
        tally.sessions += usize::from(!connection.commands.received.is_empty());
        tally.values += connection.commands.received.len() + connection.reports.received.len();
        tally.broken += usize::from(connection.commands.received != connection.commands.sent);
    }
    let last = pair.connections.last().expect("a connection");
    assert_eq!(last.commands.received, last.commands.sent, "seed {seed}");
    assert_eq!(last.reports.received, last.reports.sent, "seed {seed}");
    tally
}

/// That `log` brought what was sent, up to where its connection broke.
#[track_caller]
fn check(log: &Log, seed: u64) {
    assert!(log.sent.starts_with(&log.received), "seed {seed}: {log:#?}");
}
