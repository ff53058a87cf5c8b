//! One automation and several simulations under one virtual clock, joined in memory: real sessions, real frames, no
//! sockets.

use std::collections::BTreeMap;
use std::time::Duration;

use crate::automation::fault::{Delivery, Fault, Faulty};
use crate::automation::{Automation, ConnectionId, Control};
use crate::session::{Client, ClientEvent, ClientSettings, Input, Output};
use crate::signal_map::{Direction, RegisterId};
use crate::time::Instant;
use crate::value::Value;

/// A simulation's end.
pub struct End {
    client: Client,
    connection: Option<ConnectionId>,
    /// What its devices report now.
    reports: BTreeMap<RegisterId, Value>,
    /// The texts of the messages that it received, `SendValue` only.
    pub received: Vec<String>,
    /// When they came.
    pub times: Vec<Instant>,
    /// What its session told.
    pub events: Vec<ClientEvent>,
    /// Binary messages and texts that the session made nothing of.
    pub rubbish: usize,
}

/// The whole of it.
pub struct World {
    pub now: Instant,
    pub automation: Faulty,
    pub ends: Vec<End>,
    connections: u64,
}

impl World {
    /// An automation of the rig, and no simulation yet.
    pub fn new(control: Control, faults: &[Fault]) -> World {
        let automation = Automation::new(super::rig(), control).expect("the rig's program is bound");
        World { now: Instant::ZERO, automation: Faulty::new(automation, faults, 7), ends: Vec::new(), connections: 0 }
    }

    /// A simulation called `id` of the rig at rest begins to connect.
    pub fn join(&mut self, id: &str) -> usize {
        let map = super::rig();
        let rest = super::values(&map, &[("Pusher.limitRetracted", 1.0), ("Robot.cartesianArrived", 1.0)]);
        let initial = map.directed(Direction::Report).map(|(register, signal)| (register, signal.ty.initial()));
        let reports = initial.chain(rest).collect();
        let client = Client::new(ClientSettings::new(id), map);
        self.ends.push(End {
            client,
            connection: None,
            reports,
            received: Vec::new(),
            times: Vec::new(),
            events: Vec::new(),
            rubbish: 0,
        });
        self.settle();
        self.ends.len() - 1
    }

    /// A simulation's devices report.
    pub fn report(&mut self, end: usize, reports: &[(&str, f64)]) {
        let reports = super::values(&super::rig(), reports);
        let end = &mut self.ends[end];
        end.reports.extend(reports.iter().cloned());
        end.client.send(self.now, &reports);
        self.settle();
    }

    /// A simulation ends its session.
    pub fn leave(&mut self, end: usize) {
        self.ends[end].client.disconnect(self.now);
        self.settle();
    }

    /// A simulation's connection breaks off.
    pub fn cut(&mut self, end: usize) {
        if let Some(connection) = self.ends[end].connection.take() {
            self.automation.handle(self.now, connection, Input::Closed);
            self.ends[end].client.handle(self.now, Input::Closed);
        }
        self.settle();
    }

    /// Time passes; whatever falls due on the way happens at its instant.
    pub fn advance(&mut self, span: Duration) {
        let end = self.now + span;
        loop {
            let clients = self.ends.iter().filter_map(|end| end.client.timeout());
            let Some(due) = clients.chain(self.automation.timeout()).min().filter(|due| *due <= end) else { break };
            self.now = self.now.max(due);
            self.automation.wake(self.now);
            for end in &mut self.ends {
                if end.client.timeout().is_some_and(|due| due <= self.now) {
                    end.client.handle(self.now, Input::Timeout);
                }
            }
            self.settle();
        }
        self.now = end;
    }

    /// Hands messages over until nobody has anything to say.
    fn settle(&mut self) {
        let mut quiet = false;
        while !quiet {
            quiet = true;
            for index in 0..self.ends.len() {
                while let Some(output) = self.ends[index].client.poll() {
                    quiet = false;
                    self.obey(index, output);
                }
            }
            while let Some(delivery) = self.automation.poll() {
                quiet = false;
                self.deliver(delivery);
            }
        }
    }

    fn obey(&mut self, index: usize, output: Output<ClientEvent>) {
        let end = &mut self.ends[index];
        match output {
            Output::Transmit(text) => {
                if let Some(connection) = end.connection {
                    self.automation.handle(self.now, connection, Input::Text(&text));
                }
            }
            Output::Close { .. } => {
                if let Some(connection) = end.connection.take() {
                    self.automation.handle(self.now, connection, Input::Closed);
                }
            }
            Output::Event(event) => {
                match &event {
                    ClientEvent::Dial { .. } => {
                        self.connections += 1;
                        let connection = ConnectionId(self.connections);
                        end.connection = Some(connection);
                        self.automation.handle(self.now, connection, Input::Opened);
                        end.client.handle(self.now, Input::Opened);
                    }
                    ClientEvent::Established { .. } => {
                        let reports: Vec<_> = end.reports.iter().map(|(id, value)| (*id, value.clone())).collect();
                        end.client.send(self.now, &reports);
                    }
                    ClientEvent::Rejected { .. } => end.rubbish += 1,
                    _ => {}
                }
                end.events.push(event);
            }
        }
    }

    fn deliver(&mut self, delivery: Delivery) {
        let connection = delivery.connection();
        let Some(end) = self.ends.iter_mut().find(|end| end.connection == Some(connection)) else { return };
        match delivery {
            Delivery::Text { text, .. } => {
                if text.starts_with("{\"SendValue\":[") {
                    end.received.push(text.clone());
                    end.times.push(self.now);
                }
                // As a transport with the usual limit would.
                let limit = 1 << 20;
                let fits = text.len() <= limit;
                end.client.handle(self.now, if fits { Input::Text(&text) } else { Input::TooLong { limit } });
            }
            Delivery::Binary { .. } => {
                end.rubbish += 1;
                end.client.handle(self.now, Input::Binary);
            }
            Delivery::Close { .. } | Delivery::Abort { .. } => {
                end.connection = None;
                end.client.handle(self.now, Input::Closed);
            }
        }
    }
}
