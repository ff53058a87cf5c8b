//! R008: sent when generated. From a change that a step published to its frame at the automation: register bank, bell, IO
//! thread, WebSocket, one way.

use std::io;
use std::sync::Arc;
use std::sync::mpsc;
use std::time::{Duration, Instant};

use super::blocks;
use super::row::Peer;
use super::web::{Web, establish, listen, receive, runtime};
use crate::adapter::{Adapter as _, Endpoint, NoWitness, Settings, WebSocketConnector};
use crate::bank::{self, SimulationSide};
use crate::pace::{Bell, Exchange, Rates, WallClock, bell, drive};
use crate::signal_map::RegisterId;
use crate::value::Value;

/// A simulation thread that publishes a change whenever it is asked to, and the automation that waits for it.
pub struct Sent {
    web: Web,
    publish: mpsc::Sender<()>,
    published: mpsc::Receiver<Instant>,
}

impl Sent {
    pub fn new() -> io::Result<Sent> {
        let plant = Arc::new(blocks::plant(1));
        let listener = listen()?;
        let address = listener.local_addr()?;
        let (side, io_side) = bank::new(&plant.signal_map);
        let (bell, ears) = bell()?;
        let mut connector = WebSocketConnector::new();
        let settings = Settings::new(Endpoint::new(address.ip().to_string(), address.port()), "bench");
        connector.configure(settings).map_err(io::Error::other)?;
        connector.init(&plant.signal_map);
        connector.connect();
        let rates = Rates { high: Duration::from_secs(10), low: Duration::from_secs(10) };
        let mut exchange = Exchange::new(connector, io_side, NoWitness, rates);
        let speaking = runtime()?;
        std::thread::spawn(move || {
            speaking.block_on(async {
                let ears = ears.listen()?;
                drive(&mut exchange, ears, WallClock::start(), |_, _| {}).await;
                io::Result::Ok(())
            })
        });
        let (publish, asked) = mpsc::channel();
        let (told, published) = mpsc::channel();
        let map = Arc::clone(&plant.signal_map);
        let ready = blocks::registers(&plant, "ready")[0];
        let mut registers = vec![Value::Bool(false); map.signals().len()];
        for (register, signal) in (0u32..).map(RegisterId).zip(map.signals()) {
            registers[register.index()] = Value::from_f64(signal.ty.element, 0.0);
        }
        std::thread::spawn(move || step(side, bell, registers, ready, &asked, &told));
        let mut web = Web::accept(listener)?;
        establish(&mut web, &map)?;
        Ok(Sent { web, publish, published })
    }

    fn once(&mut self) -> io::Result<Duration> {
        let gone = |_| io::Error::from(io::ErrorKind::BrokenPipe);
        self.publish.send(()).map_err(|_| io::Error::from(io::ErrorKind::BrokenPipe))?;
        self.web.runtime.block_on(receive(&mut self.web.socket))?;
        let heard = Instant::now();
        Ok(heard.saturating_duration_since(self.published.recv().map_err(gone)?))
    }
}

fn step(
    mut side: SimulationSide,
    mut bell: Bell,
    mut registers: Vec<Value>,
    ready: RegisterId,
    asked: &mpsc::Receiver<()>,
    told: &mpsc::Sender<Instant>,
) {
    let mut steps = 0;
    loop {
        let now = Instant::now();
        if side.publish(crate::time::Instant::from_nanos(steps), &registers) {
            bell.ring();
        }
        if steps > 0 && told.send(now).is_err() {
            return;
        }
        steps += 1_000_000;
        if asked.recv().is_err() {
            return;
        }
        registers[ready.index()] = Value::Bool(registers[ready.index()] == Value::Bool(false));
    }
}

impl Peer for Sent {
    fn call(&mut self) -> io::Result<()> {
        self.once().map(drop)
    }

    /// From the publication to the frame, not from the wish for one.
    fn calls(&mut self, count: usize, pace: Option<Duration>) -> io::Result<Vec<u64>> {
        let begun = Instant::now();
        (0..count as u32)
            .map(|k| {
                if let Some(pace) = pace {
                    std::thread::sleep((k * pace).saturating_sub(begun.elapsed()));
                }
                self.once().map(|took| took.as_nanos() as u64)
            })
            .collect()
    }
}
