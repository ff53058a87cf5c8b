//! The plant: the client. It connects, runs in real time, takes commands when they arrive and reports in its cycle.

use std::net::SocketAddr;

use kinetwin::wire::{Connect, Entry, Message, to_base64};

use super::clock::Lateness;
use super::end::End;
use super::error::SocketError;
use super::running::Running;
use crate::plant::Plant;
use crate::record::{Reporter, Surroundings};

const AUTOMATION: &str = "automation";

/// How long before it is looked at the plant is brought up to date, s: what is left to do then is little.
const LEAD: f64 = 1e-3;

/// How far the plant may lag behind the time meanwhile, s: what it has to catch up with keeps others from their work.
const SLICE: f64 = 4e-3;

/// Runs `plant` for `seconds` under the automation at `address`, then leaves. Gives the instants of its clock at which messages
/// arrived as well.
pub fn run(
    address: SocketAddr,
    plant: Plant,
    around: &Surroundings,
    seconds: f64,
    seed: u64,
) -> Result<(Vec<f64>, Lateness), SocketError> {
    let mut end = End::connect(address, AUTOMATION)?;
    let id = to_base64(&format!("withheld-plant {seed:016x}"));
    introduce(&mut end, &id, true)?;
    let signals = plant.signals.clone();
    let running = Running::new(plant, around, seed);
    let mut client = Client { end, running, arrived: Vec::new(), lateness: Lateness::default() };
    client.begin()?;
    let mut reporter = Reporter::new(&signals, around, seed);
    for due in around.due(seconds) {
        let sample = around.sample(due);
        client.live_until(sample - LEAD)?;
        client.live_until(sample)?;
        let (text, late) = reporter.report(client.running.values());
        client.live_until(due + late)?;
        if let Some(text) = text {
            client.end.send(text)?;
        }
    }
    client.live_until(seconds)?;
    introduce(&mut client.end, &id, false)?;
    Ok((client.arrived, client.lateness))
}

/// Says `Connect` and waits until that is accepted.
fn introduce(end: &mut End, id: &str, enable: bool) -> Result<(), SocketError> {
    end.send(Message::Connect(Connect { id: id.into(), enable, signals: None }).encode())?;
    let (_, text) = end.expect()?;
    match Message::decode(&text) {
        Ok(Message::ConnectReply(reply)) if reply.result.is_accepted() && reply.id == id && reply.enable == enable => {
            Ok(())
        }
        Ok(_) => Err(end.bad(&text, "no ConnectReply that accepts this plant")),
        Err(error) => Err(end.bad(&text, &error.to_string())),
    }
}

struct Client {
    end: End,
    running: Running,
    arrived: Vec<f64>,
    lateness: Lateness,
}

impl Client {
    /// Its time begins with the automation's first message.
    fn begin(&mut self) -> Result<(), SocketError> {
        let (_, text) = self.end.expect()?;
        self.end.start_with_last();
        self.hear(0.0, &text)
    }

    /// Runs until `until` and takes what arrives meanwhile.
    fn live_until(&mut self, until: f64) -> Result<(), SocketError> {
        loop {
            let next = until.min(self.running.now() + SLICE);
            match self.end.next(next)? {
                Some((at, text)) => self.hear(at, &text)?,
                None if next < until => self.running.run_until(next),
                None => break,
            }
        }
        self.lateness.note((self.end.now() - until.max(0.0)).max(0.0));
        self.running.run_until(until);
        Ok(())
    }

    fn hear(&mut self, at: f64, text: &str) -> Result<(), SocketError> {
        self.arrived.push(at);
        let entries = match Message::decode(text) {
            Ok(Message::SendValue(entries)) => entries,
            Ok(other) => return Err(self.end.bad(text, &format!("a {} now", other.name()))),
            Err(error) => return Err(self.end.bad(text, &error.to_string())),
        };
        for entry in &entries {
            let Some((name, value)) = command(entry) else {
                return Err(self.end.bad(text, "a value without a name, or that is neither a number nor a flag"));
            };
            if !self.running.hear(at, name, value) {
                return Err(self.end.bad(text, &format!("this plant takes no command called {name}")));
            }
        }
        Ok(())
    }
}

/// A command's name and its value in SI units, a flag as 0 or 1.
fn command<'a>(entry: &'a Entry<'_>) -> Option<(&'a str, f64)> {
    let (name, raw) = (entry.name.as_deref()?, entry.value?);
    let number = || raw.as_number()?.parse::<f32>().ok().filter(|number| number.is_finite()).map(f64::from);
    raw.as_bool().map(f64::from).or_else(number).map(|value| (name, value))
}
