//! Faults, swept by seed: whatever happens to the connection, what is received within a session is what was sent, in
//! order, and the session comes back.

use super::pair::{Frame, Log, Pair};
use super::*;
use crate::wire::ResultCode;

/// SplitMix64 (Steele, Lea, Flood 2014): enough randomness for a script of faults, and the same everywhere.
struct Dice(u64);

impl Dice {
    /// A number from 0 to `sides` - 1.
    fn roll(&mut self, sides: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) % sides
    }
}

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

/// That `log` brought what was sent, up to where its connection broke.
#[track_caller]
fn check(log: &Log, seed: u64) {
    assert!(log.sent.starts_with(&log.received), "seed {seed}: {log:#?}");
}

#[test]
fn what_is_received_in_a_session_is_what_was_sent_and_the_session_comes_back() {
    let (mut sessions, mut values, mut broken) = (0, 0, 0);
    for seed in 0..400 {
        let mut dice = Dice(seed);
        let mut pair = Pair::new();
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
            sessions += usize::from(!connection.commands.received.is_empty());
            values += connection.commands.received.len() + connection.reports.received.len();
            broken += usize::from(connection.commands.received != connection.commands.sent);
        }
        let last = pair.connections.last().expect("a connection");
        assert_eq!(last.commands.received, last.commands.sent, "seed {seed}");
        assert_eq!(last.reports.received, last.reports.sent, "seed {seed}");
    }
    // A sweep that broke nothing, or brought nothing, has shown nothing.
    assert!(
        sessions > 1000 && values > 50_000 && broken > 300,
        "{sessions} sessions, {values} values, {broken} broken"
    );
}
