//! Simulations and one automation in lock-step, in memory: engines, banks, connectors, sessions and programs are the real
//! ones, frame for frame; there is no socket, and the clock is the simulations'.
#![allow(dead_code, reason = "every test takes what it needs")]

use std::cell::RefCell;
use std::collections::{BTreeMap, VecDeque};
use std::rc::Rc;
use std::task::{Context, Waker};
use std::time::Duration;

use kinetwin::adapter::{Adapter, Endpoint, FromPeer, InProcess, NoWitness, Peer, Settings};
use kinetwin::automation::fault::Delivery;
use kinetwin::automation::{Automation, ConnectionId, Control, Fault, Faulty};
use kinetwin::bank::{self, SimulationSide};
use kinetwin::device::KINDS;
use kinetwin::engine::Engine;
use kinetwin::pace::{Exchange, Rates};
use kinetwin::plant::embedded::Embedded;
use kinetwin::plant::{Plant, load};
use kinetwin::session::Input;
use kinetwin::signal_map::RegisterId;
use kinetwin::time::Instant;
use kinetwin::value::Value;

/// The automation, and what it has for each connection.
pub struct Hub {
    pub automation: Faulty,
    connections: u64,
    mail: BTreeMap<ConnectionId, VecDeque<FromPeer>>,
    /// Every text that reached the automation, and when.
    pub heard: Vec<(Instant, String)>,
}

impl Hub {
    fn collect(&mut self, now: Instant) {
        if self.automation.timeout().is_some_and(|due| due <= now) {
            self.automation.wake(now);
        }
        while let Some(delivery) = self.automation.poll() {
            let Some(mail) = self.mail.get_mut(&delivery.connection()) else { continue };
            mail.push_back(match delivery {
                Delivery::Text { text, .. } => FromPeer::Text(text),
                Delivery::Binary { .. } => FromPeer::Binary,
                Delivery::Close { reason, .. } => FromPeer::Closed(reason),
                Delivery::Abort { .. } => FromPeer::Closed("broken off".to_owned()),
            });
        }
    }
}

/// A simulation's connection to the automation.
pub struct End {
    hub: Rc<RefCell<Hub>>,
    connection: ConnectionId,
    /// The `SendValue` messages that came to the simulation.
    received: Rc<RefCell<Vec<String>>>,
}

impl Peer for End {
    fn open(&mut self, now: Instant) {
        let mut hub = self.hub.borrow_mut();
        hub.connections += 1;
        self.connection = ConnectionId(hub.connections);
        hub.mail.insert(self.connection, VecDeque::new());
        hub.automation.handle(now, self.connection, Input::Opened);
    }

    fn take(&mut self, now: Instant, text: &str) {
        let mut hub = self.hub.borrow_mut();
        hub.heard.push((now, text.to_owned()));
        hub.automation.handle(now, self.connection, Input::Text(text));
    }

    fn give(&mut self, now: Instant) -> Option<FromPeer> {
        let mut hub = self.hub.borrow_mut();
        hub.collect(now);
        let mail = hub.mail.get_mut(&self.connection)?.pop_front()?;
        match &mail {
            FromPeer::Text(text) if text.starts_with("{\"SendValue\"") => {
                self.received.borrow_mut().push(text.clone());
            }
            FromPeer::Closed(_) => drop(hub.mail.remove(&self.connection)),
            _ => {}
        }
        Some(mail)
    }

    fn close(&mut self, now: Instant) {
        let mut hub = self.hub.borrow_mut();
        hub.mail.remove(&self.connection);
        hub.automation.handle(now, self.connection, Input::Closed);
    }
}

/// A simulation with its end of the connection.
pub struct Simulation {
    pub engine: Engine,
    pub plant: Plant,
    bank: SimulationSide,
    exchange: Exchange<InProcess<End>, NoWitness>,
    inputs: Vec<(RegisterId, Value)>,
    received: Rc<RefCell<Vec<String>>>,
}

impl Simulation {
    /// The `SendValue` messages that it received so far.
    pub fn received(&self) -> Vec<String> {
        self.received.borrow().clone()
    }

    /// The engine's half of a step.
    fn compute(&mut self) {
        self.bank.take(&mut self.inputs);
        let now = self.engine.now();
        let registers = self.engine.tick(&self.inputs);
        self.bank.publish(now, registers);
    }

    /// Publishes registers that no engine made.
    pub fn publish(&mut self, now: Instant, registers: &[Value]) {
        self.bank.publish(now, registers);
    }

    /// The IO's half of a step.
    pub fn exchange(&mut self, now: Instant) {
        self.exchange.turn(&mut Context::from_waker(Waker::noop()), now);
    }
}

/// All of it.
pub struct Lockstep {
    pub hub: Rc<RefCell<Hub>>,
    pub simulations: Vec<Simulation>,
    model: &'static str,
}

impl Lockstep {
    /// The automation of a plant, and no simulation yet.
    pub fn new(model: &'static str, faults: &[&str]) -> Lockstep {
        let faults: Vec<Fault> = faults.iter().map(|fault| fault.parse().expect("a fault")).collect();
        let map = plant(model).signal_map;
        let automation = Automation::new(map, Control::ByPlant).expect("the plant's program");
        let automation = Faulty::new(automation, &faults, 1);
        let hub = Hub { automation, connections: 0, mail: BTreeMap::new(), heard: Vec::new() };
        Lockstep { hub: Rc::new(RefCell::new(hub)), simulations: Vec::new(), model }
    }

    /// One more simulation, in steps of 1 ms.
    pub fn join(&mut self, seed: u64) -> usize {
        let plant = plant(self.model);
        let engine = Engine::new(&plant, Duration::from_millis(1), seed).expect("a plant that runs");
        let received = Rc::default();
        let end = End { hub: Rc::clone(&self.hub), connection: ConnectionId(0), received: Rc::clone(&received) };
        let mut connector = InProcess::to(end);
        let id = format!("simulation {}", self.simulations.len());
        connector.configure(Settings::new(Endpoint::new("localhost", 1), id)).expect("good settings");
        connector.init(&plant.signal_map);
        connector.connect();
        let (bank, io) = bank::new(&plant.signal_map);
        let rates = Rates { high: plant.adapter.high_frequency, low: plant.adapter.low_frequency };
        let exchange = Exchange::new(connector, io, NoWitness, rates);
        self.simulations.push(Simulation { engine, plant, bank, exchange, inputs: Vec::new(), received });
        self.simulations.len() - 1
    }

    /// One step of every simulation, and all that the automation has to say to it.
    pub fn step(&mut self) {
        for simulation in &mut self.simulations {
            let now = simulation.engine.now();
            simulation.compute();
            simulation.exchange(now);
        }
    }

    /// Steps until the first simulation has come to `seconds`.
    pub fn run_to(&mut self, seconds: f64) {
        while self.simulations[0].engine.now() < Instant::from_seconds(seconds) {
            self.step();
        }
    }
}

/// A plant of the project.
pub fn plant(model: &str) -> Plant {
    load(&Embedded, model, KINDS).unwrap_or_else(|error| panic!("{error}"))
}
