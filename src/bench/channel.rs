//! kinetwin itself: a message comes in over a WebSocket, is staged, a step that its arrival starts answers it, and the
//! answer goes out.

use std::io;
use std::net::SocketAddr;
use std::sync::Arc;

use futures_util::SinkExt as _;
use tokio_tungstenite::tungstenite::{Message, Utf8Bytes};

use super::blocks;
use super::row::Peer;
use super::web::{Texts, Web, establish, listen, receive, runtime};
use crate::adapter::{Adapter as _, Endpoint, NoWitness, Settings, WebSocketConnector};
use crate::bank;
use crate::pace::{Exchange, NoJournal, Rates, Simulation, WallClock, answer};
use crate::plant::Plant;
use crate::run::model;
use crate::session::{Input, Output, Server, ServerEvent};
use crate::signal_map::RegisterId;
use crate::time::Instant;
use crate::value::Value;
use crate::wire::SendValueText;

/// The two messages that switch every block of `plant` on, and off.
pub fn switches(plant: &Plant) -> [String; 2] {
    first_switches(plant, plant.instances.len())
}

/// The two messages that switch the first few blocks of `plant` on, and off.
pub fn first_switches(plant: &Plant, switched: usize) -> [String; 2] {
    [true, false].map(|value| {
        let mut text = SendValueText::with_capacity(switched);
        for register in blocks::registers(plant, "enable").into_iter().take(switched) {
            text.push(&plant.signal_map.signal(register).name, &Value::Bool(value)).expect("a BOOL has a JSON form");
        }
        text.finish().expect("at least one block")
    })
}

/// kinetwin answers the two messages; the caller neither writes nor reads JSON.
pub fn texts(plant: &Arc<Plant>) -> io::Result<Texts> {
    let (web, _) = connect(plant)?;
    Ok(Texts::new(web, switches(plant).map(Utf8Bytes::from).to_vec()))
}

/// kinetwin answers, and the caller is an automation: it writes every value and reads every answer.
pub struct Exchanged {
    web: Web,
    server: Server,
    commands: Vec<(RegisterId, Value)>,
    reports: Vec<Option<Value>>,
}

impl Exchanged {
    pub fn new(plant: &Arc<Plant>) -> io::Result<Exchanged> {
        let (web, server) = connect(plant)?;
        let commands = blocks::registers(plant, "enable").into_iter().map(|register| (register, Value::Bool(false)));
        let reports = vec![None; plant.signal_map.signals().len()];
        Ok(Exchanged { web, server, commands: commands.collect(), reports })
    }
}

impl Peer for Exchanged {
    fn call(&mut self) -> io::Result<()> {
        let Exchanged { web, server, commands, reports } = self;
        for (_, value) in commands.iter_mut() {
            *value = Value::Bool(*value == Value::Bool(false));
        }
        server.send(Instant::ZERO, commands);
        web.runtime.block_on(async {
            while let Some(output) = server.poll() {
                if let Output::Transmit(text) = output {
                    web.socket.send(Message::text(text)).await.map_err(io::Error::other)?;
                }
            }
            let mut wanted = commands.len();
            while wanted > 0 {
                let text = receive(&mut web.socket).await?;
                server.handle(Instant::ZERO, Input::Text(&text));
                while let Some(output) = server.poll() {
                    let staged = match output {
                        Output::Event(ServerEvent::Values(staged)) => staged,
                        // Nobody would answer any more.
                        Output::Close { reason, .. } => return Err(io::Error::other(reason)),
                        _ => continue,
                    };
                    wanted = wanted.saturating_sub(staged.values.len());
                    for (register, value) in staged.values {
                        reports[register.index()] = Some(value);
                    }
                }
            }
            Ok(())
        })
    }
}

/// Starts kinetwin on a thread of its own, and gives the automation's end.
fn connect(plant: &Arc<Plant>) -> io::Result<(Web, Server)> {
    let listener = listen()?;
    let address = listener.local_addr()?;
    let simulated = Arc::clone(plant);
    std::thread::Builder::new().name("plant".to_owned()).spawn(move || simulate(&simulated, address))?;
    let mut web = Web::accept(listener)?;
    let server = establish(&mut web, &plant.signal_map)?;
    Ok((web, server))
}

fn simulate(plant: &Arc<Plant>, address: SocketAddr) -> io::Result<()> {
    let engine = model::engine(plant, crate::run::Options::STEP, 0).map_err(io::Error::other)?;
    let (simulation_side, io_side) = bank::new(&plant.signal_map);
    let mut connector = WebSocketConnector::new();
    let settings = Settings::new(Endpoint::new(address.ip().to_string(), address.port()), "bench");
    connector.configure(settings).map_err(io::Error::other)?;
    connector.init(&plant.signal_map);
    connector.connect();
    let rates = Rates { high: plant.adapter.high_frequency, low: plant.adapter.low_frequency };
    let mut exchange = Exchange::new(connector, io_side, NoWitness, rates);
    let mut simulation = Simulation::new(engine, simulation_side, None, Box::new(NoJournal));
    let mut stood = false;
    runtime()?.block_on(answer(&mut exchange, &mut simulation, WallClock::start(), |exchange| {
        let stands = exchange.adapter().is_connected();
        // The caller hung up: it has measured enough.
        let over = stood && !stands;
        stood |= stands;
        over
    }));
    Ok(())
}
