//! The table of `docs/performance.md`, measured now.

use std::sync::Arc;
use std::time::Duration;

use serde::Serialize;

use super::channel::{self, Exchanged};
use super::cores::OneCore;
use super::load::Running;
use super::modbus::Modbus;
use super::mqtt::{Broker, Mqtt};
use super::opcua::OpcUa;
use super::row::{Measured, Peer, Quantity, Row};
use super::sent::Sent;
use super::serde_loop::SerdeLoop;
use super::{BenchError, blocks, echo, lateness};
use crate::pace::{Urgency, prefer};
use crate::plant::Plant;

/// How much is measured.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// How often the rows take turns.
    pub rounds: usize,
    /// How long a row's turn is, back to back.
    pub turn: Duration,
    /// Calls of a paced row in its turn.
    pub paced_calls: usize,
}

impl Effort {
    /// About a minute and a half.
    pub const FULL: Effort = Effort { rounds: 20, turn: Duration::from_millis(80), paced_calls: 20 };
}

/// The pace of requirement R001.
const PACE: Duration = Duration::from_millis(10);
/// A pace that meets a loop of 1 ms at every phase.
const WANDERING: Duration = Duration::from_micros(10_370);

/// The table, and what became of the goals.
#[derive(Debug, Serialize)]
pub struct Table {
    pub rows: Vec<Measured>,
    pub ratios: Ratios,
    pub goals: Vec<Goal>,
    /// Whether both ends of each round trip were kept on one core; those of whole runs never are.
    pub on_one_core: bool,
    /// Peers that are not installed here.
    pub absent: Vec<&'static str>,
}

/// The ratios that the goals are about.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Ratios {
    /// A value through kinetwin to an echo of the same bytes by tokio-tungstenite, median.
    pub channel_p50: f64,
    /// The same, 99th percentile.
    pub channel_p99: f64,
    /// R001's exchange to the same with serde_json, median.
    pub r001_p50: f64,
    /// R001's exchange every 10 ms to an echo of the same bytes by tokio-tungstenite at that pace, median.
    pub r001_paced_p50: f64,
    /// The simulation loop's lateness to a bare thread's, 99.9th percentile.
    pub lateness_p999: f64,
}

/// What is to be reached.
#[derive(Clone, Debug, Serialize)]
pub struct Goal {
    pub what: String,
    pub found: f64,
    pub at_most: f64,
    pub met: bool,
}

mod names {
    pub const RAW_1: &str = "raw TCP echo, 1 value";
    pub const WEB_1: &str = "tokio-tungstenite echo, 1 value";
    pub const CHANNEL: &str = "kinetwin channel, 1 value";
    pub const RAW_200: &str = "raw TCP echo, 200 values";
    pub const WEB_200: &str = "tokio-tungstenite echo, 200 values";
    pub const R001: &str = "kinetwin R001 exchange, 200 blocks";
    pub const SERDE: &str = "tokio-tungstenite and serde_json, 200 blocks";
    pub const MODBUS: &str = "Modbus TCP, 200 blocks";
    pub const RAW_PACED: &str = "every 10 ms: raw TCP echo, 200 values";
    pub const WEB_PACED: &str = "every 10 ms: tokio-tungstenite echo, 200 values";
    pub const R001_PACED: &str = "every 10 ms: kinetwin R001 exchange";
    pub const SERDE_PACED: &str = "every 10 ms: tokio-tungstenite and serde_json";
    pub const SENT: &str = "every 10 ms: from a change in a step to its frame";
    pub const RUN_IDLE: &str = "kinetwin run in 1 ms steps, 1 of 200 blocks";
    pub const RUN_LOAD: &str = "kinetwin run in 1 ms steps, 200 blocks";
    pub const RUN_IDLE_REALTIME: &str = "kinetwin run --realtime in 1 ms steps, 1 of 200 blocks";
    pub const RUN_LOAD_REALTIME: &str = "kinetwin run --realtime in 1 ms steps, 200 blocks";
    pub const RUN_BACK_TO_BACK: &str = "kinetwin run in 1 ms steps, 200 blocks, at once again";
    pub const WEB_1_PACED: &str = "every 10 ms: tokio-tungstenite echo, 1 value";
    pub const CHANNEL_PACED: &str = "every 10 ms: kinetwin channel, 1 value";
}

/// Measures the rows whose name contains `only`, which is all of them where it is empty.
pub fn measure(effort: Effort, only: &str, mut progress: impl FnMut(&str)) -> Result<Table, BenchError> {
    let mut absent = Vec::new();
    let one_core = OneCore::take();
    let on_one_core = one_core.is_some();
    let broker = Broker::start();
    progress("connecting");
    let mut rows = back_to_back(broker.as_ref(), &mut absent)?;
    rows.extend(paced(broker.as_ref())?);
    rows.retain(|row| row.name.contains(only));
    for row in &mut rows {
        row.warm_up(if row.pace.is_some() { 20 } else { 5 }).map_err(|source| failed(row, source))?;
    }
    for round in 0..effort.rounds {
        progress(&format!("round {} of {}", round + 1, effort.rounds));
        for row in &mut rows {
            let calls = if row.pace.is_some() { effort.paced_calls } else { calls_in(effort.turn, row)? };
            row.measure(calls).map_err(|source| failed(row, source))?;
        }
    }
    let mut measured: Vec<Measured> = rows.iter().map(Row::measured).collect();
    drop(rows);
    // A run has three threads, and whoever waits for it a fourth.
    drop(one_core);
    let permitted = lateness::is_permitted()?;
    for run in RUNS.iter().filter(|run| run.name.contains(only) && (permitted || !run.realtime)) {
        progress(run.name);
        measured.push(lateness::thread(move || run.measure(effort))??);
    }
    if lateness::SHARED.looped.contains(only) {
        measured.extend(lateness::measure(2 * effort.rounds, progress)?);
    }
    if measured.is_empty() {
        return Err(BenchError::NoRow { only: only.to_owned() });
    }
    Ok(Table::new(measured, on_one_core, absent))
}

fn failed(row: &Row, source: std::io::Error) -> BenchError {
    BenchError::Row { row: row.name.clone(), source }
}

/// So many calls as fit into `turn`, by a first few.
fn calls_in(turn: Duration, row: &mut Row) -> Result<usize, BenchError> {
    let few = row.peer.calls(3, None).map_err(|source| failed(row, source))?;
    let each = few.iter().min().copied().unwrap_or(1).max(1_000);
    Ok(((turn.as_nanos() as u64 / each) as usize).clamp(3, 2_000))
}

fn back_to_back(broker: Option<&Broker>, absent: &mut Vec<&'static str>) -> Result<Vec<Row>, BenchError> {
    let (one, many) = (Arc::new(blocks::plant(1)), Arc::new(blocks::plant(blocks::R001)));
    let (small, large) = (message(&one), message(&many));
    let row = |name: &str, bytes, peer| Row::new(name, bytes, None, peer);
    let mut rows = vec![
        row(names::RAW_1, small.len(), Box::new(echo::Raw::new(small.len())?) as Box<dyn Peer>),
        row(names::WEB_1, small.len(), Box::new(echo::web(&small)?)),
        row(names::CHANNEL, small.len(), Box::new(channel::texts(&one)?)),
        row(names::RAW_200, large.len(), Box::new(echo::Raw::new(large.len())?)),
        row(names::WEB_200, large.len(), Box::new(echo::web(&large)?)),
        row(names::R001, large.len(), Box::new(Exchanged::new(&many)?)),
        row(names::SERDE, large.len(), Box::new(SerdeLoop::new(blocks::R001)?)),
        row(names::MODBUS, Modbus::bytes(), Box::new(Modbus::new()?)),
    ];
    match broker {
        None => absent.push("mosquitto"),
        Some(broker) => {
            for qos in [0, 1] {
                let name = |what: &str| format!("MQTT QoS {qos} through mosquitto, {what}");
                rows.push(row(&name("1 value"), small.len(), Box::new(Mqtt::echo(broker, qos, "one", small.len())?)));
                let peer = Mqtt::blocks(broker, qos, "blocks", blocks::R001)?;
                rows.push(row(&name("200 blocks"), large.len(), Box::new(peer)));
            }
        }
    }
    for nodes in [1, blocks::R001] {
        match OpcUa::start(nodes) {
            None => absent.push("asyncua"),
            Some(peer) => {
                let nodes = if nodes == 1 { "1 node".to_owned() } else { format!("{nodes} nodes") };
                rows.push(row(&format!("OPC UA by asyncua, write {nodes} and read"), 0, Box::new(peer)));
            }
        }
    }
    absent.dedup();
    Ok(rows)
}

fn paced(broker: Option<&Broker>) -> Result<Vec<Row>, BenchError> {
    let (one, many) = (Arc::new(blocks::plant(1)), Arc::new(blocks::plant(blocks::R001)));
    let (small, large) = (message(&one), message(&many));
    let row = |name: &str, bytes, peer| Row::new(name, bytes, Some(PACE), peer);
    let mut rows = vec![
        row(names::WEB_1_PACED, small.len(), Box::new(echo::web(&small)?) as Box<dyn Peer>),
        row(names::CHANNEL_PACED, small.len(), Box::new(channel::texts(&one)?)),
        row(names::RAW_PACED, large.len(), Box::new(echo::Raw::new(large.len())?)),
        row(names::WEB_PACED, large.len(), Box::new(echo::web(&large)?)),
        row(names::R001_PACED, large.len(), Box::new(Exchanged::new(&many)?)),
        row(names::SERDE_PACED, large.len(), Box::new(SerdeLoop::new(blocks::R001)?)),
        row("every 10 ms: Modbus TCP, 200 blocks", Modbus::bytes(), Box::new(Modbus::new()?)),
    ];
    if let Some(broker) = broker {
        for qos in [0, 1] {
            let peer = Mqtt::blocks(broker, qos, "paced", blocks::R001)?;
            rows.push(row(&format!("every 10 ms: MQTT QoS {qos}, 200 blocks"), large.len(), Box::new(peer)));
        }
    }
    if let Some(peer) = OpcUa::start(1) {
        rows.push(row("every 10 ms: OPC UA by asyncua, 1 node", 0, Box::new(peer)));
    }
    rows.push(row(names::SENT, small_report(), Box::new(Sent::new()?)));
    Ok(rows)
}

/// A whole run on the wall clock, in steps of 1 ms. Each is measured by itself: the others would step on beside it.
struct RunRow {
    name: &'static str,
    /// How many of 200 blocks are set: one is idle, all are R001's load.
    switched: usize,
    pace: Option<Duration>,
    /// Whether the run and the automation that waits for it go before what shares the processors by turns.
    realtime: bool,
}

const RUNS: [RunRow; 5] = [
    RunRow { name: names::RUN_BACK_TO_BACK, switched: blocks::R001, pace: None, realtime: false },
    RunRow { name: names::RUN_IDLE, switched: 1, pace: Some(WANDERING), realtime: false },
    RunRow { name: names::RUN_LOAD, switched: blocks::R001, pace: Some(WANDERING), realtime: false },
    RunRow { name: names::RUN_IDLE_REALTIME, switched: 1, pace: Some(WANDERING), realtime: true },
    RunRow { name: names::RUN_LOAD_REALTIME, switched: blocks::R001, pace: Some(WANDERING), realtime: true },
];

impl RunRow {
    fn measure(&self, effort: Effort) -> Result<Measured, BenchError> {
        let plant = Arc::new(blocks::plant(blocks::R001));
        let [on, _] = channel::first_switches(&plant, self.switched);
        if self.realtime {
            // It was permitted a moment ago.
            let _ = prefer(Urgency::Exchange);
        }
        let running = Running::start(&plant, self.switched, self.realtime)?;
        let mut row = Row::new(self.name, on.len(), self.pace, Box::new(running));
        let measured = row.warm_up(20).and_then(|()| row.measure(effort.rounds * effort.paced_calls));
        measured.map_err(|source| failed(&row, source))?;
        Ok(row.measured())
    }
}

/// The bytes of one block's report.
fn small_report() -> usize {
    r#"{"SendValue":[{"name":"Block001.ready","value":true}]}"#.len()
}

/// The message that switches every block of `plant` on.
fn message(plant: &Plant) -> String {
    let [on, _] = channel::switches(plant);
    on
}

impl Table {
    fn new(rows: Vec<Measured>, on_one_core: bool, absent: Vec<&'static str>) -> Table {
        let get = |name: &str, quantity| {
            rows.iter().find(|row| row.name == name).map_or(f64::NAN, |row: &Measured| row.get(quantity))
        };
        let ratio =
            |ours: &str, theirs: &str, quantity| (get(ours, quantity) / get(theirs, quantity) * 1e3).round() / 1e3;
        let ratios = Ratios {
            channel_p50: ratio(names::CHANNEL, names::WEB_1, Quantity::P50),
            channel_p99: ratio(names::CHANNEL, names::WEB_1, Quantity::P99),
            r001_p50: ratio(names::R001, names::SERDE, Quantity::P50),
            r001_paced_p50: ratio(names::R001_PACED, names::WEB_PACED, Quantity::P50),
            lateness_p999: ratio(lateness::SHARED.looped, lateness::SHARED.bare, Quantity::P999),
        };
        let mut goals = vec![
            Goal::new("channel to a tokio-tungstenite echo, p50", ratios.channel_p50, 1.5),
            Goal::new("channel to a tokio-tungstenite echo, p99", ratios.channel_p99, 2.0),
            Goal::new("R001's exchange to serde_json's, p50", ratios.r001_p50, 0.8),
            Goal::new("R001's exchange every 10 ms to an echo at that pace, p50", ratios.r001_paced_p50, 1.2),
            Goal::new("an idle run's round trip in 1 ms steps, p99, µs", get(names::RUN_IDLE, Quantity::P99), 1_300.0),
            Goal::new("a loaded run's round trip in 1 ms steps, p99, µs", get(names::RUN_LOAD, Quantity::P99), 1_300.0),
            Goal::new("the loop's lateness to a bare thread's, p99.9", ratios.lateness_p999, 1.2),
        ];
        let realtime = ratio(lateness::REALTIME.looped, lateness::REALTIME.bare, Quantity::P999);
        goals.push(Goal::new("the same under real-time scheduling, p99.9", realtime, 1.2));
        for row in rows.iter().filter(|row| is_rival(&row.name)) {
            let ours = contender(&row.name);
            let found = ratio(ours, &row.name, Quantity::P50);
            goals.push(Goal::new(&format!("{ours} to {}, p50", row.name), found, 1.0));
        }
        // What was not measured is neither met nor missed.
        goals.retain(|goal| !goal.found.is_nan());
        Table { rows, ratios, goals, on_one_core, absent }
    }

    /// Whether every goal is met.
    pub fn meets_all(&self) -> bool {
        self.goals.iter().all(|goal| goal.met)
    }
}

impl Goal {
    fn new(what: &str, found: f64, at_most: f64) -> Goal {
        Goal { what: what.to_owned(), found, at_most, met: found <= at_most }
    }
}

/// Whether a row is what a user would take instead.
fn is_rival(name: &str) -> bool {
    ["MQTT", "OPC UA", "Modbus"].iter().any(|peer| name.contains(peer))
}

/// Ours that does the same work at the same pace as the rival `name`: what moves one value competes with what moves one.
fn contender(name: &str) -> &'static str {
    let is_small = name.contains("1 value") || name.contains("1 node");
    match (name.starts_with("every 10 ms"), is_small) {
        (false, true) => names::CHANNEL,
        (false, false) => names::R001,
        (true, true) => names::CHANNEL_PACED,
        (true, false) => names::R001_PACED,
    }
}
