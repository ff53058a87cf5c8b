//! What a client selected of the automation's signals, and how often it wants each (requirement R007).

use std::time::Duration;

use crate::signal_map::{Direction, RegisterId, SignalMap};
use crate::time::Instant;
use crate::value::Value;
use crate::wire::SignalSelection;

/// The selected signals with what was sent of them and what is held back.
///
/// A signal with an interval of zero is sent at every change. Of one with an interval, the latest value is sent once the
/// interval since the last one is over, unless it is that last one again: who asks for a signal at most every 100 ms
/// asks for its edges to be thinned out, too.
#[derive(Debug)]
pub(super) struct Selection {
    /// A place for every register of the map; `None` for what was not selected.
    slots: Vec<Option<Slot>>,
    /// When the first held value is due.
    due: Option<Instant>,
}

#[derive(Debug)]
struct Slot {
    min_interval: Duration,
    sent: Option<(Instant, Value)>,
    held: Option<Value>,
}

impl Slot {
    /// When a value may be sent; at once if none was yet.
    fn ready(&self) -> Option<Instant> {
        self.sent.as_ref().map(|(at, _)| *at + self.min_interval)
    }
}

impl Selection {
    /// The selection `wanted` of the commands of `map`, and the names in it that are no commands.
    pub(super) fn new(map: &SignalMap, wanted: &[SignalSelection]) -> (Selection, Vec<String>) {
        let mut slots: Vec<Option<Slot>> = map.signals().iter().map(|_| None).collect();
        let mut unknown = Vec::new();
        for selected in wanted {
            let register = map.register(&selected.name);
            match register.filter(|&register| map.signal(register).direction == Direction::Command) {
                None => unknown.push(selected.name.clone()),
                Some(register) => {
                    let min_interval = selected.min_interval;
                    slots[register.index()] = Some(Slot { min_interval, sent: None, held: None });
                }
            }
        }
        (Selection { slots, due: None }, unknown)
    }

    /// Those of `values` that are to be sent now. Others that were selected are held back.
    pub(super) fn offer(&mut self, now: Instant, values: &[(RegisterId, Value)]) -> Vec<(RegisterId, Value)> {
        let mut goes = Vec::with_capacity(values.len());
        for (register, value) in values {
            let Some(slot) = self.slots.get_mut(register.index()).and_then(Option::as_mut) else { continue };
            if slot.min_interval.is_zero() {
                goes.push((*register, value.clone()));
            } else if slot.ready().is_none_or(|ready| ready <= now) {
                slot.held = None;
                slot.sent = Some((now, value.clone()));
                goes.push((*register, value.clone()));
            } else {
                let again = slot.sent.as_ref().is_some_and(|(_, sent)| sent == value);
                slot.held = (!again).then(|| value.clone());
            }
        }
        self.update_due();
        goes
    }

    /// The held values whose interval is over, in the order of their registers.
    pub(super) fn take_due(&mut self, now: Instant) -> Vec<(RegisterId, Value)> {
        let mut goes = Vec::new();
        if self.due.is_none_or(|due| due > now) {
            return goes;
        }
        for (index, slot) in self.slots.iter_mut().enumerate() {
            let Some(slot) = slot else { continue };
            if slot.ready().is_some_and(|ready| ready > now) {
                continue;
            }
            if let Some(value) = slot.held.take() {
                slot.sent = Some((now, value.clone()));
                goes.push((RegisterId(index as u32), value));
            }
        }
        self.update_due();
        goes
    }

    /// When [`take_due`](Selection::take_due) will give something.
    pub(super) fn due(&self) -> Option<Instant> {
        self.due
    }

    fn update_due(&mut self) {
        let held = self.slots.iter().flatten().filter(|slot| slot.held.is_some());
        self.due = held.filter_map(Slot::ready).min();
    }
}
