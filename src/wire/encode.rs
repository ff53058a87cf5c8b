//! Message → text.

use std::fmt::Write as _;
use std::time::Duration;

use super::message::{Connect, ConnectReply, Entry, Fault, Interface, InterfaceSignal, Message, SignalSelection};
use super::value::{NotFinite, TextForm, write_string, write_value};
use crate::value::Value;

/// A `SendValue` in the making: one buffer, one pass.
#[derive(Debug)]
pub struct SendValueText {
    text: String,
    entries: usize,
}

impl SendValueText {
    /// What every one begins with.
    pub(crate) const HEAD: &'static str = "{\"SendValue\":[";

    /// An empty message with room for `entries` values of common length.
    pub fn with_capacity(entries: usize) -> SendValueText {
        // `{"name":"Conveyor12.velocityActual","value":0.123456}` and a comma.
        let mut text = String::with_capacity(SendValueText::HEAD.len() + entries * 56 + 2);
        text.push_str(SendValueText::HEAD);
        SendValueText { text, entries: 0 }
    }

    /// Adds the value of the signal `name`. A value without a JSON form is refused, and the message stays as it was.
    pub fn push(&mut self, name: &str, value: &Value) -> Result<(), NotFinite> {
        self.push_entry(|text| write_head(text, name), value)
    }

    /// The beginning of the entry of the signal `name`, for [`push_begun`](Self::push_begun): what is written again and
    /// again need be escaped only once.
    pub fn begin(name: &str) -> Box<str> {
        let mut text = String::new();
        write_head(&mut text, name);
        text.into()
    }

    /// As [`push`](Self::push), of a signal whose entry [`begin`](Self::begin) has begun.
    pub fn push_begun(&mut self, begun: &str, value: &Value) -> Result<(), NotFinite> {
        self.push_entry(|text| text.push_str(begun), value)
    }

    fn push_entry(&mut self, head: impl FnOnce(&mut String), value: &Value) -> Result<(), NotFinite> {
        let start = self.text.len();
        if self.entries > 0 {
            self.text.push(',');
        }
        head(&mut self.text);
        if let Err(error) = write_value(&mut self.text, value, TextForm::Base64) {
            self.text.truncate(start);
            return Err(error);
        }
        self.text.push('}');
        self.entries += 1;
        Ok(())
    }

    /// How many values it holds.
    pub fn entries(&self) -> usize {
        self.entries
    }

    /// The message's text; `None` if it holds no value, because there is nothing to say then.
    pub fn finish(mut self) -> Option<String> {
        self.text.push_str("]}");
        (self.entries > 0).then_some(self.text)
    }
}

/// An entry up to its value.
fn write_head(out: &mut String, name: &str) {
    out.push_str("{\"name\":");
    write_string(out, name);
    out.push_str(",\"value\":");
}

impl Message<'_> {
    /// The text of the message, without a blank.
    pub fn encode(&self) -> String {
        let mut out = String::with_capacity(128);
        write!(out, "{{\"{}\":", self.name()).expect("a String takes everything");
        match self {
            Message::Connect(body) => write_connect(&mut out, body),
            Message::ConnectReply(body) => write_connect_reply(&mut out, body),
            Message::SendValue(entries) => write_list(&mut out, entries, write_entry),
            Message::SendValueReply(faults) => write_list(&mut out, faults, write_fault),
            Message::QueryAll => out.push_str("{}"),
            Message::QueryAllReply(interface) => write_interface(&mut out, interface),
        }
        out.push('}');
        out
    }
}

fn write_connect(out: &mut String, body: &Connect<'_>) {
    out.push_str("{\"Id\":");
    write_string(out, &body.id);
    push(out, format_args!(",\"enable\":{}", body.enable));
    if let Some(signals) = &body.signals {
        out.push_str(",\"Signals\":");
        write_list(out, signals, write_selection);
    }
    out.push('}');
}

fn write_selection(out: &mut String, selection: &SignalSelection) {
    out.push_str("{\"name\":");
    write_string(out, &selection.name);
    push(out, format_args!(",\"minInterval\":{}}}", Milliseconds(selection.min_interval)));
}

/// A span in milliseconds, to the last nanosecond.
struct Milliseconds(Duration);

impl std::fmt::Display for Milliseconds {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (whole, rest) = (self.0.as_millis(), self.0.subsec_nanos() % 1_000_000);
        match rest {
            0 => write!(f, "{whole}"),
            rest => f.write_str(format!("{whole}.{rest:06}").trim_end_matches('0')),
        }
    }
}

fn write_connect_reply(out: &mut String, body: &ConnectReply<'_>) {
    out.push_str("{\"Id\":");
    write_string(out, &body.id);
    push(out, format_args!(",\"enable\":{},\"ServerName\":", body.enable));
    write_string(out, &body.server_name);
    push(out, format_args!(",\"result\":{}", body.result));
    if let Some(message) = &body.message {
        out.push_str(",\"message\":");
        write_string(out, message);
    }
    out.push('}');
}

fn write_entry(out: &mut String, entry: &Entry<'_>) {
    out.push('{');
    if let Some(name) = &entry.name {
        out.push_str("\"name\":");
        write_string(out, name);
    }
    if let Some(value) = entry.value {
        if entry.name.is_some() {
            out.push(',');
        }
        out.push_str("\"value\":");
        out.push_str(value.text());
    }
    out.push('}');
}

fn write_fault(out: &mut String, fault: &Fault) {
    out.push_str("{\"name\":");
    write_string(out, &fault.name);
    push(out, format_args!(",\"result\":{},\"message\":", fault.result));
    write_string(out, &fault.message);
    out.push('}');
}

fn write_interface(out: &mut String, interface: &Interface) {
    out.push_str("{\"ServerName\":");
    write_string(out, &interface.server_name);
    push(out, format_args!(",\"result\":{},\"inputs\":", interface.result));
    write_list(out, &interface.inputs, write_interface_signal);
    out.push_str(",\"outputs\":");
    write_list(out, &interface.outputs, write_interface_signal);
    out.push('}');
}

fn write_interface_signal(out: &mut String, signal: &InterfaceSignal) {
    out.push_str("{\"name\":");
    write_string(out, &signal.name);
    out.push_str(",\"type\":");
    write_string(out, &signal.ty);
    out.push('}');
}

fn write_list<T>(out: &mut String, items: &[T], write_item: impl Fn(&mut String, &T)) {
    out.push('[');
    for (index, item) in items.iter().enumerate() {
        if index > 0 {
            out.push(',');
        }
        write_item(out, item);
    }
    out.push(']');
}

fn push(out: &mut String, text: std::fmt::Arguments<'_>) {
    out.write_fmt(text).expect("a String takes everything");
}
