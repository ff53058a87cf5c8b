//! What happens to a signal on its way, while it happens.
//!
//! [`Stream`](crate::stream::Stream) is told a whole recording and answers afterwards; a link is told one point after the
//! other and answers at once. Both have the same laws; a test compares them, effect by effect.

use std::collections::VecDeque;

use crate::chance::Dice;
use crate::plant::Kind;
use crate::quirk::Quirk;
use crate::switch::Delay;

/// One effect between a signal's sender and its receiver.
#[derive(Debug)]
pub struct Link {
    law: Law,
    is_edge: bool,
    /// What came in last, and when.
    before: Option<(f64, f64)>,
    dice: Dice,
}

#[derive(Debug)]
enum Law {
    /// `factor·x + offset + rate·t`
    Linear {
        factor: f64,
        offset: f64,
        rate: f64,
    },
    /// A flag that is the other.
    Opposite,
    Rounded {
        step: f64,
    },
    Blind {
        length: f64,
    },
    Noisy {
        sigma: f64,
    },
    Sticky {
        half: f64,
        y: f64,
    },
    Stuck {
        value: f64,
        from: f64,
    },
    /// What came in at `t/stretch − time`.
    Late {
        time: f64,
        stretch: f64,
        past: Past,
    },
    /// Refreshed every so often, when that is not lost.
    Held {
        every: f64,
        phase: f64,
        loss: Option<f64>,
        next: u32,
        y: f64,
        past: Past,
    },
    /// Zero for whole windows.
    Away {
        every: f64,
        probability: f64,
        windows: u32,
        is_away: bool,
    },
    Filtered {
        time: f64,
        y: f64,
    },
    /// A step counts once it has stood for the time; since when the last one stands, and what counts.
    Stands {
        time: f64,
        since: f64,
        y: f64,
    },
    Switched {
        on: f64,
        off: f64,
        delay: Delay,
    },
    Jittered {
        sigma: f64,
        coming: VecDeque<(f64, f64)>,
        last: f64,
        y: f64,
    },
}

impl Link {
    /// The link that does what `quirk` says to a signal of this `kind`, which perhaps jumps (`is_edge`). `None` where it does nothing to it.
    pub fn of(quirk: &Quirk, kind: Kind, is_edge: bool, seed: u64) -> Option<Link> {
        let is_flag = kind == Kind::Flag;
        let value = |name: &str| quirk.value(name);
        let late = |time, stretch| Law::Late { time, stretch, past: Past::new(is_edge) };
        let phase = value("phase");
        let held = |every, loss| Law::Held { every, phase, loss, next: 0, y: 0.0, past: Past::new(is_edge) };
        let linear = |factor, offset, rate| Law::Linear { factor, offset, rate };
        let switched = |on, off| Law::Switched { on, off, delay: Delay::new(on, off) };
        let law = match quirk.effect.as_str() {
            "dead-time" => late(value("time"), 1.0),
            "clock-drift" => late(0.0, 1.0 + value("rate")),
            "inverted" if is_flag => Law::Opposite,
            "inverted" => linear(-1.0, 0.0, 0.0),
            "wrong-unit" => linear(value("factor"), 0.0, 0.0),
            "gain" => linear(value("gain"), 0.0, 0.0),
            "offset" => linear(1.0, value("offset"), 0.0),
            "drift" => linear(1.0, 0.0, value("rate")),
            "quantisation" => Law::Rounded { step: value("step") },
            "blind-range" if !is_flag => Law::Blind { length: value("length") },
            "noise" => Law::Noisy { sigma: value("sigma") },
            "hysteresis" if !is_flag => Law::Sticky { half: 0.5 * value("width"), y: 0.0 },
            "stuck" => Law::Stuck { value: value("value"), from: value("from") },
            "stale-hold" => held(value("time"), None),
            "lost-messages" if value("cycle") > 0.0 => held(value("cycle"), Some(value("probability"))),
            "intermittent" => {
                Law::Away { every: value("time"), probability: value("probability"), windows: 0, is_away: false }
            }
            "input-filter" if kind.is_edge() => {
                Law::Stands { time: value("time_constant"), since: f64::NEG_INFINITY, y: 0.0 }
            }
            "input-filter" => Law::Filtered { time: value("time_constant"), y: 0.0 },
            "on-delay" => switched(value("time"), 0.0),
            "off-delay" => switched(0.0, value("time")),
            "sampling-jitter" => Law::Jittered { sigma: value("sigma"), coming: VecDeque::new(), last: 0.0, y: 0.0 },
            _ => return None,
        };
        Some(Link { law, is_edge, before: None, dice: Dice::new(seed, 0) })
    }

    /// At `now`, never before the last call's, `x` comes in; gives what comes out.
    pub fn pass(&mut self, now: f64, x: f64) -> f64 {
        let before = self.before.replace((now, x));
        let x_before = before.map_or(x, |(_, x)| x);
        let Link { law, is_edge, dice, .. } = self;
        match law {
            Law::Linear { factor, offset, rate } => *factor * x + *offset + *rate * now,
            Law::Opposite => 1.0 - x,
            Law::Rounded { step } => *step * (x / *step).round(),
            Law::Blind { length } => {
                if x.abs() < *length {
                    0.0
                } else {
                    x
                }
            }
            Law::Noisy { sigma } => x + *sigma * dice.normal(),
            Law::Sticky { half, y } => {
                *y = if before.is_none() { x } else { *y };
                *y += (x - *y) - (x - *y).clamp(-*half, *half);
                *y
            }
            Law::Stuck { value, from } => {
                if now < *from {
                    x
                } else {
                    *value
                }
            }
            Law::Late { time, stretch, past } => {
                past.push(now, x);
                past.take(now / *stretch - *time)
            }
            Law::Held { every, phase, loss, next, y, past } => {
                past.push(now, x);
                *y = if before.is_none() { x } else { *y };
                loop {
                    let at = *phase + f64::from(*next) * *every;
                    if at > now {
                        return *y;
                    }
                    let is_fresh = at > 0.0 && !loss.is_some_and(|loss| dice.is_so(loss));
                    let seen = past.take(at);
                    *y = if is_fresh { seen } else { *y };
                    *next += 1;
                }
            }
            Law::Away { every, probability, windows, is_away } => {
                while f64::from(*windows) * *every <= now {
                    *is_away = dice.is_so(*probability);
                    *windows += 1;
                }
                if *is_away { 0.0 } else { x }
            }
            Law::Filtered { time, y } => {
                let Some((then, _)) = before else {
                    *y = x;
                    return x;
                };
                let goal = if *is_edge { x_before } else { 0.5 * (x_before + x) };
                *y = goal + (*y - goal) * (-(now - then) / *time).exp();
                *y
            }
            Law::Stands { time, since, y } => {
                if before.is_none() {
                    *y = x;
                } else if x != x_before {
                    // What stood until now may have come to count in between.
                    *y = if now - *since > *time { x_before } else { *y };
                    *since = now;
                } else if now - *since >= *time - 1e-9 {
                    *y = x;
                }
                *y
            }
            Law::Switched { on, off, delay } => {
                if before.is_none() {
                    // What it is at first it has been for ever.
                    *delay = Delay::new(*on, *off);
                    delay.set(f64::NEG_INFINITY, x != 0.0);
                }
                delay.set(now, x != 0.0);
                f64::from(delay.at(now))
            }
            Law::Jittered { sigma, coming, last, y } => {
                if before.is_none() {
                    *y = x;
                } else if x != x_before {
                    *last = (now + (*sigma * dice.normal()).abs()).max(*last);
                    coming.push_back((*last, x));
                }
                while let Some((_, value)) = coming.pop_front_if(|(at, _)| *at <= now) {
                    *y = value;
                }
                *y
            }
        }
    }
}

/// What came in, as far back as somebody may ask.
#[derive(Debug)]
struct Past {
    is_edge: bool,
    points: VecDeque<(f64, f64)>,
}

impl Past {
    fn new(is_edge: bool) -> Past {
        Past { is_edge, points: VecDeque::new() }
    }

    /// The next point.
    fn push(&mut self, at: f64, value: f64) {
        self.points.push_back((at, value));
    }

    /// What came in at `at`, and the first value before the first point; nobody will ask for anything older.
    fn take(&mut self, at: f64) -> f64 {
        while self.points.get(1).is_some_and(|(next, _)| *next <= at) {
            self.points.pop_front();
        }
        let (from, value) = self.points.front().copied().unwrap_or_default();
        match self.points.get(1) {
            Some((to, next)) if !self.is_edge && at > from => value + (next - value) * (at - from) / (to - from),
            _ => value,
        }
    }
}
