//! How function blocks run: what they see of the world, their timers, and the network that composes them.
//!
//! An event is one message from the plant, or one timer that is due. It runs the network to completion: every block looks
//! at its inputs, then every sequence takes transitions until none can, and only then the commands that changed leave,
//! together. So a plant never sees half of a decision.

use std::collections::BTreeSet;
use std::fmt;
use std::time::Duration;

use crate::automation::image::{Datum, Image, Input, Output};
use crate::signal_map::RegisterId;
use crate::time::Instant;
use crate::value::Value;

/// What a block sees and does while an event is handled.
pub struct Context<'a> {
    /// When the event happened, on the automation's clock.
    pub now: Instant,
    image: &'a mut Image,
    wakes: &'a mut BTreeSet<Instant>,
    verbatim: &'a mut Vec<Verbatim>,
}

impl<'a> Context<'a> {
    /// The context of an event at `now`. Instants at which the program wants to be woken go to `wakes`, messages that
    /// are to leave as they are to `verbatim`.
    pub fn new(
        now: Instant,
        image: &'a mut Image,
        wakes: &'a mut BTreeSet<Instant>,
        verbatim: &'a mut Vec<Verbatim>,
    ) -> Context<'a> {
        Context { now, image, wakes, verbatim }
    }

    /// Reads what the plant last reported.
    pub fn get<T: Datum>(&self, input: Input<T>) -> T {
        self.image.get(input)
    }

    /// What a command was last set to.
    pub fn last<T: Datum>(&self, output: Output<T>) -> T {
        self.image.last(output)
    }

    /// Sets a command; it leaves when the event is over.
    pub fn set<T: Datum>(&mut self, output: Output<T>, datum: T) {
        self.image.set(output, datum);
    }

    /// Sets a command by its register; it leaves when the event is over.
    pub fn set_value(&mut self, register: RegisterId, value: Value) {
        self.image.set_value(register, value);
    }

    /// Sends a message's text as it is; `sets` is what it sets.
    pub fn send_verbatim(&mut self, text: String, sets: Vec<(RegisterId, Value)>) {
        // What left is no change any more: it must not leave a second time.
        self.image.take(&sets);
        self.verbatim.push(Verbatim { text, sets });
    }

    /// The process image.
    pub fn image(&self) -> &Image {
        self.image
    }

    /// Asks to be woken at `due`.
    pub fn wake_at(&mut self, due: Instant) {
        self.wakes.insert(due);
    }

    /// Writes what a sequence decided to the log: when, who, upon what, what.
    pub fn decided(&self, block: &str, event: &str, decision: impl fmt::Display) {
        tracing::info!(target: "automation", "{:>11} {block:<14} {event:<16} {decision}", self.now);
    }

    /// Writes what a device's block saw to the log.
    pub fn noted(&self, block: &str, event: &str, what: impl fmt::Display) {
        tracing::debug!(target: "automation", "{:>11} {block:<14} {event:<16} {what}", self.now);
    }

    /// Writes to the log that a device does not do what it should.
    pub fn warned(&self, block: &str, event: &str, what: impl fmt::Display) {
        tracing::warn!(target: "automation", "{:>11} {block:<14} {event:<16} {what}", self.now);
    }
}

/// A message that leaves as it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Verbatim {
    /// Its text.
    pub text: String,
    /// What it sets.
    pub sets: Vec<(RegisterId, Value)>,
}

/// A delay, as IEC 61499's E_DELAY: started, it elapses once, unless it is stopped before.
#[derive(Clone, Copy, Debug, Default)]
pub struct Delay {
    due: Option<Instant>,
}

impl Delay {
    /// Starts it anew; it elapses `span` from now.
    pub fn start(&mut self, cx: &mut Context<'_>, span: Duration) {
        let due = cx.now + span;
        self.due = Some(due);
        cx.wake_at(due);
    }

    /// Stops it.
    pub fn stop(&mut self) {
        self.due = None;
    }

    /// Whether it runs.
    pub fn running(&self) -> bool {
        self.due.is_some()
    }

    /// True once, when the time is over.
    pub fn elapsed(&mut self, cx: &Context<'_>) -> bool {
        let over = self.due.is_some_and(|due| due <= cx.now);
        if over {
            self.due = None;
        }
        over
    }
}

/// What a program has counted of its own.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Parts that it saw come in.
    pub parts_in: u64,
    /// Parts that it saw leave.
    pub parts_out: u64,
}

/// What controls a plant.
pub trait Program: Send {
    /// A plant is there: all commands are 0, and of its state nothing is known yet.
    fn start(&mut self, cx: &mut Context<'_>);

    /// The plant reported, or an instant asked for has come.
    fn event(&mut self, cx: &mut Context<'_>);

    /// What it has counted since it started.
    fn counts(&self) -> Counts {
        Counts::default()
    }
}

/// A function block that stands for one device: it knows the device's signals, and offers its services as methods.
pub trait Block: Send {
    /// The device's name.
    fn name(&self) -> &str;

    /// The plant reported, or time has passed: looks at its inputs and its timers.
    fn update(&mut self, cx: &mut Context<'_>);
}

/// All blocks of a program's devices.
pub trait Devices: Send {
    /// Calls `visit` with each of them, in an order that never changes.
    fn each(&mut self, visit: &mut dyn FnMut(&mut dyn Block));
}

/// A sequential function chart: one step is active, and a transition to another is taken when its condition holds.
pub trait Sequence<D>: Send {
    /// Takes at most one transition, and tells whether it took one.
    fn advance(&mut self, devices: &mut D, cx: &mut Context<'_>) -> bool;

    /// Counts what it has counted into `counts`.
    fn count(&self, _counts: &mut Counts) {}
}

/// A network of function blocks: devices, and the sequences that use them.
pub struct Network<D> {
    devices: D,
    sequences: Vec<Box<dyn Sequence<D>>>,
    /// Whether the plant has reported: a network that knows nothing of the plant's state does not act.
    informed: bool,
}

/// How many rounds of transitions one event may cause before the network is taken to run in circles.
const MOST_ROUNDS: usize = 100;

impl<D: Devices> Network<D> {
    /// A network that advances `sequences` in this order.
    pub fn new(devices: D, sequences: Vec<Box<dyn Sequence<D>>>) -> Network<D> {
        Network { devices, sequences, informed: false }
    }
}

impl<D: Devices> Program for Network<D> {
    fn start(&mut self, cx: &mut Context<'_>) {
        cx.decided("network", "COLD", "waiting for the plant's first report");
    }

    fn event(&mut self, cx: &mut Context<'_>) {
        if !self.informed {
            self.informed = true;
            cx.decided("network", "INIT", "the plant's state is known, sequences start");
        }
        self.devices.each(&mut |block| block.update(cx));
        for _ in 0..MOST_ROUNDS {
            let mut moved = false;
            for sequence in &mut self.sequences {
                moved |= sequence.advance(&mut self.devices, cx);
            }
            if !moved {
                return;
            }
        }
        cx.warned(
            "network",
            "CYCLE",
            format_args!("{MOST_ROUNDS} rounds of transitions in one event; going on at the next"),
        );
    }

    fn counts(&self) -> Counts {
        let mut counts = Counts::default();
        for sequence in &self.sequences {
            sequence.count(&mut counts);
        }
        counts
    }
}
