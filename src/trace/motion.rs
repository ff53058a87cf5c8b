//! What a trace excites: how its signals move. A second reading, because what counts as motion follows from the ranges
//! that the first one finds.

use std::collections::BTreeMap;
use std::io::BufRead;

use serde::Serialize;

use crate::time::Instant;
use crate::wire::Message;

use super::info::Info;
use super::reader::{Body, Reader, TraceError};

/// A move is more than this part of a signal's range: less may be noise.
const BAND: f64 = 0.01;
/// Who has not moved for so long rests.
const REST_S: f64 = 0.3;
/// Speeds are measured over spans of at least this, and of at least so many intervals: shorter ones show the noise.
const SPAN_S: f64 = 0.05;
const SPAN_INTERVALS: f64 = 4.0;

/// How a number moves over a trace. Speeds and accelerations are in its unit per second and per second².
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Motion {
    /// The highest speed, measured over 50 ms at least.
    pub top_speed: f64,
    /// The greatest change of that speed.
    pub top_acceleration: f64,
    /// How often it turned back by more than 1 % of its range.
    pub reversals: u64,
    /// How often it began to move from rest, and came to rest again: at rest, it has not moved by more than 1 % of its
    /// range for 0.3 s.
    pub starts: u64,
    pub stops: u64,
    /// The time it rested, in seconds.
    pub rest_s: f64,
}

/// Reads a trace again, of which `info` was found, and measures how its numbers move.
pub fn motions<R: BufRead>(mut reader: Reader<R>, info: &Info) -> Result<BTreeMap<String, Motion>, TraceError> {
    let moving = info.signals.iter().filter_map(|(name, signal)| {
        let [least, greatest] = signal.range?;
        (greatest > least).then(|| (name.clone(), Moving::new(greatest - least, signal.interval_s.unwrap_or(SPAN_S))))
    });
    let mut moving: BTreeMap<String, Moving> = moving.collect();
    while let Some(line) = reader.next_line()? {
        let Body::Message(Message::SendValue(entries)) = &line.body else { continue };
        for entry in entries {
            let number = entry.value.and_then(|value| value.as_number()?.parse::<f64>().ok());
            let (Some(name), Some(number)) = (entry.name.as_deref(), number) else { continue };
            if let Some(signal) = moving.get_mut(name) {
                signal.take(line.at, number);
            }
        }
    }
    Ok(moving.into_iter().map(|(name, signal)| (name, signal.end(info.ends))).collect())
}

/// A signal as it moves.
struct Moving {
    motion: Motion,
    band: f64,
    span_s: f64,
    /// Where it stood when it moved last, and when that was.
    anchor: Option<(Instant, f64)>,
    /// The way it moved last.
    sign: f64,
    is_resting: bool,
    /// The begin of the span over which its speed is measured, and the span's before.
    from: Option<(Instant, f64)>,
    speed: Option<f64>,
}

impl Moving {
    fn new(range: f64, interval_s: f64) -> Moving {
        Moving {
            motion: Motion::default(),
            band: range * BAND,
            span_s: SPAN_S.max(interval_s * SPAN_INTERVALS),
            anchor: None,
            sign: 0.0,
            is_resting: true,
            from: None,
            speed: None,
        }
    }

    fn take(&mut self, at: Instant, value: f64) {
        self.measure(at, value);
        let Some((moved, anchor)) = self.anchor else {
            self.anchor = Some((at, value));
            return;
        };
        self.rest(at, moved);
        if (value - anchor).abs() <= self.band {
            return;
        }
        let sign = (value - anchor).signum();
        self.motion.reversals += u64::from(sign == -self.sign);
        self.motion.starts += u64::from(self.is_resting);
        if self.is_resting {
            self.motion.rest_s += at.since(moved).as_secs_f64();
        }
        (self.sign, self.is_resting, self.anchor) = (sign, false, Some((at, value)));
    }

    /// Whether it has come to rest since it moved.
    fn rest(&mut self, at: Instant, moved: Instant) {
        if !self.is_resting && at.since(moved).as_secs_f64() > REST_S {
            self.is_resting = true;
            self.motion.stops += 1;
        }
    }

    fn measure(&mut self, at: Instant, value: f64) {
        let Some((from, before)) = self.from else {
            self.from = Some((at, value));
            return;
        };
        let span_s = at.since(from).as_secs_f64();
        if span_s < self.span_s {
            return;
        }
        let speed = (value - before) / span_s;
        self.motion.top_speed = self.motion.top_speed.max(speed.abs());
        if let Some(last) = self.speed {
            self.motion.top_acceleration = self.motion.top_acceleration.max((speed - last).abs() / span_s);
        }
        (self.from, self.speed) = (Some((at, value)), Some(speed));
    }

    fn end(mut self, ends: Instant) -> Motion {
        if let Some((moved, _)) = self.anchor {
            self.rest(ends, moved);
            if self.is_resting {
                self.motion.rest_s += ends.since(moved).as_secs_f64();
            }
        }
        self.motion
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::{Compression, Header, Sender, Writer, info};

    /// The motion of a signal whose value at `t` is `value(t)`, every 20 ms for `for_s`.
    fn motion(for_s: f64, value: impl Fn(f64) -> f64) -> Motion {
        let mut writer = Writer::new(Vec::new(), Compression::None, &Header::default()).expect("a writer");
        for k in 0..=(for_s * 50.0) as i64 {
            let text = format!(r#"{{"SendValue":[{{"name":"A.x","value":{}}}]}}"#, value(k as f64 * 0.02));
            writer.message(Instant::from_nanos(k * 20_000_000), Sender::Plant, &text).expect("a line");
        }
        let trace = writer.finish().expect("a trace");
        let reader = || Reader::new("t", &trace[..]).expect("a trace");
        let found = motions(reader(), &info(reader()).expect("an info")).expect("motions");
        found.get("A.x").copied().unwrap_or_default()
    }

    #[test]
    fn a_sine_reverses_twice_a_period_and_never_rests() {
        let found = motion(10.0, |t| 0.1 * (std::f64::consts::TAU * 0.5 * t).sin());
        assert_eq!((found.reversals, found.starts, found.stops), (10, 1, 0));
        let (top, highest) = (0.1 * std::f64::consts::PI, 0.1 * std::f64::consts::PI.powi(2));
        assert!((found.top_speed / top - 1.0).abs() < 0.02, "{found:?}");
        assert!((found.top_acceleration / highest - 1.0).abs() < 0.05, "{found:?}");
    }

    #[test]
    fn a_move_there_and_back_starts_and_stops_twice() {
        // 1 s of rest, 1 s up, 2 s of rest, 1 s down, 1 s of rest; a ripple of 0.2 % all along.
        let up_and_down = |t: f64| (t - 1.0).clamp(0.0, 1.0) - (t - 4.0).clamp(0.0, 1.0);
        let found = motion(6.0, |t| up_and_down(t) + 0.002 * (t * 40.0).sin());
        assert_eq!((found.reversals, found.starts, found.stops), (1, 2, 2));
        assert!((found.rest_s - 4.0).abs() < 0.15 && (found.top_speed - 1.0).abs() < 0.1, "{found:?}");
    }

    #[test]
    fn what_never_changes_does_not_move() {
        assert_eq!(motion(1.0, |_| 0.5), Motion::default());
    }
}
