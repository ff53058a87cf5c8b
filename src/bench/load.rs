//! The load of requirement R001 on a run: so many blocks set and answered every cycle, each answer counted.

use std::io::{self, ErrorKind};
use std::net::{TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use hdrhistogram::Histogram;
use serde::Serialize;
use tokio_tungstenite::tungstenite::protocol::Role;
use tokio_tungstenite::tungstenite::{Message, Utf8Bytes, WebSocket, accept};

use super::row::{Measured, Peer};
use super::{BenchError, blocks, channel, cores};
use crate::adapter::Endpoint;
use crate::pace::{Urgency, prefer, sharpen_sleep};
use crate::plant::Plant;
use crate::run::{self, Connect, Handle, Options, Summary};
use crate::session::{Input, Output, Server, ServerEvent, ServerSettings};
use crate::signal_map::RegisterId;
use crate::value::Value;

/// A run on the wall clock whose automation is the measurement's: it sets blocks and hears them answer.
pub struct Running {
    handle: Option<Handle>,
    socket: WebSocket<TcpStream>,
    server: Server,
    registers: Vec<RegisterId>,
    switches: [Utf8Bytes; 2],
    on: bool,
}

impl Running {
    /// A run of `plant` in steps of 1 ms, of which the first `switched` blocks are set at each call; in `realtime` where the
    /// system permits it.
    pub fn start(plant: &Arc<Plant>, switched: usize, realtime: bool) -> Result<Running, BenchError> {
        let listener = TcpListener::bind("127.0.0.1:0")?;
        let address = listener.local_addr()?;
        let options = Options {
            connect: Some(Connect::Server(Endpoint::new(address.ip().to_string(), address.port()))),
            realtime,
            ..Options::new("models/r001")
        };
        let handle = run::start_plant(&options, Arc::clone(plant))?;
        let (stream, _) = listener.accept()?;
        stream.set_nodelay(true)?;
        let mut running = Running {
            handle: Some(handle),
            socket: accept(stream).map_err(io::Error::other)?,
            server: Server::new(ServerSettings::new("bench"), Arc::clone(&plant.signal_map)),
            registers: blocks::registers(plant, "ready").into_iter().take(switched).collect(),
            switches: channel::first_switches(plant, switched).map(Utf8Bytes::from),
            on: false,
        };
        while !running.hear()?.1 {}
        Ok(running)
    }

    /// Reads a message and answers what wants an answer. The reports in it, and whether it brought any.
    fn hear(&mut self) -> io::Result<(Vec<(RegisterId, Value)>, bool)> {
        let text = read(&mut self.socket)?;
        self.server.handle(crate::time::Instant::ZERO, Input::Text(&text));
        let mut values = Vec::new();
        let mut reported = false;
        while let Some(output) = self.server.poll() {
            match output {
                Output::Transmit(text) => self.socket.send(Message::text(text)).map_err(io::Error::other)?,
                Output::Event(ServerEvent::Values(staged)) => {
                    reported = true;
                    values.extend(staged.values);
                }
                _ => {}
            }
        }
        Ok((values, reported))
    }
}

fn read(socket: &mut WebSocket<TcpStream>) -> io::Result<Utf8Bytes> {
    loop {
        match socket.read() {
            Ok(Message::Text(text)) => return Ok(text),
            Ok(_) => {}
            Err(tokio_tungstenite::tungstenite::Error::Io(error)) => return Err(error),
            Err(error) => return Err(io::Error::new(ErrorKind::ConnectionAborted, error)),
        }
    }
}

impl Peer for Running {
    fn call(&mut self) -> io::Result<()> {
        self.on = !self.on;
        let text = self.switches[usize::from(!self.on)].clone();
        self.socket.send(Message::Text(text)).map_err(io::Error::other)?;
        let mut waiting = self.registers.len();
        while waiting > 0 {
            let (values, _) = self.hear()?;
            let answered = |(register, value): &&(RegisterId, Value)| {
                self.registers.binary_search(register).is_ok() && *value == Value::Bool(self.on)
            };
            waiting = waiting.saturating_sub(values.iter().filter(answered).count());
        }
        Ok(())
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        if let Some(handle) = self.handle.take() {
            handle.stopper().stop();
            // The session is not closed in good order: nobody is there to answer.
            let _ = self.socket.get_mut().shutdown(std::net::Shutdown::Both);
            let _ = handle.finish();
        }
    }
}

/// What is asked of the load.
#[derive(Clone, Copy, Debug)]
pub struct Demand {
    pub blocks: usize,
    /// How often every block is set.
    pub cycle: Duration,
    pub duration: Duration,
    /// The engine's step.
    pub step: Duration,
    /// Whether the run's threads and the measurement's own are scheduled in real time, where the system permits it.
    pub realtime: bool,
}

/// What became of it.
#[derive(Clone, Debug, Serialize)]
pub struct Held {
    pub blocks: usize,
    pub signals: usize,
    pub cycle_ms: f64,
    pub duration_s: f64,
    /// Cycles in which every block was set.
    pub cycles: u64,
    /// Cycles not wholly answered before the next one began.
    pub missed: u64,
    /// Of those, cycles about which a bare thread on one of the cores, which does nothing but sleep a millisecond, or a
    /// cycle where that is less, woke late as well, by half a cycle or more: the operating system missed them.
    pub missed_by_system: u64,
    /// Switches that no answer came to, or that were answered twice or out of turn.
    pub lost: u64,
    pub answer: Measured,
    /// How late the automation's own thread woke.
    pub bare_thread: Measured,
    /// The share of one core that the run's IO thread used, and its simulation thread.
    pub io_cpu: Option<f64>,
    pub simulation_cpu: Option<f64>,
    /// The process's memory, and its growth since the session stood, bytes.
    pub memory: Option<u64>,
    pub memory_growth: Option<i64>,
    /// The computing time of a step, µs, without a command and under load.
    pub step_idle_us: run::Quantiles,
    pub step_load_us: run::Quantiles,
    pub late_steps: u64,
    pub overruns: u64,
}

impl Held {
    /// Whether every cycle was answered that the operating system let be answered, and nothing was lost.
    pub fn is_held(&self) -> bool {
        self.missed <= self.missed_by_system && self.lost == 0
    }
}

/// What the reader and the writer of the automation share.
struct Shared {
    /// When each cycle was sent, nanoseconds since `begun`; a ring.
    sent: Vec<AtomicU64>,
    begun: Instant,
    over: AtomicBool,
    /// When a bare thread woke half a cycle late or more, nanoseconds since `begun`.
    late: Mutex<Vec<u64>>,
    realtime: bool,
}

impl Shared {
    /// Has the calling thread, one of the measurement's own, be scheduled as the run's are.
    fn schedule(&self) {
        if self.realtime {
            // Where it is refused, it is refused to the run as well.
            let _ = prefer(Urgency::Exchange);
        }
    }
}

const RING: usize = 4096;

/// Holds the load for as long as `demand` says.
pub fn hold(demand: Demand) -> Result<Held, BenchError> {
    let plant = Arc::new(blocks::plant(demand.blocks));
    // First without the load: the same run, the same session, no command.
    let idle = session(&plant, demand, false)?;
    let load = session(&plant, demand, true)?;
    Ok(Held { step_idle_us: idle.summary.step_us, ..load.held(demand, &plant) })
}

struct Session {
    summary: Summary,
    heard: Heard,
    wrote: Wrote,
    shared: Arc<Shared>,
    io_cpu: Option<f64>,
    simulation_cpu: Option<f64>,
    memory: Option<u64>,
    memory_growth: Option<i64>,
    duration_s: f64,
}

fn session(plant: &Arc<Plant>, demand: Demand, loaded: bool) -> Result<Session, BenchError> {
    let listener = TcpListener::bind("127.0.0.1:0")?;
    let address = listener.local_addr()?;
    let options = Options {
        connect: Some(Connect::Server(Endpoint::new(address.ip().to_string(), address.port()))),
        step: demand.step,
        high: Some(demand.cycle.max(Duration::from_millis(1))),
        realtime: demand.realtime,
        ..Options::new("models/r001")
    };
    let handle = run::start_plant(&options, Arc::clone(plant))?;
    let (stream, _) = listener.accept()?;
    stream.set_nodelay(true)?;
    let writing = stream.try_clone()?;
    let mut reader = Reader::new(plant, accept(stream).map_err(io::Error::other)?);
    reader.establish()?;
    let shared = Arc::new(Shared {
        sent: (0..RING).map(|_| AtomicU64::new(0)).collect(),
        begun: Instant::now(),
        over: AtomicBool::new(false),
        late: Mutex::new(Vec::new()),
        realtime: demand.realtime,
    });
    let before = (memory(), thread_seconds("io"), thread_seconds("simulation"));
    // Without a load only a moment: what a step costs shows soon.
    let duration = if loaded { demand.duration } else { demand.duration.min(Duration::from_secs(5)) };
    let switches = channel::switches(plant).map(Utf8Bytes::from);
    let hearing = {
        let shared = Arc::clone(&shared);
        std::thread::spawn(move || reader.run(&shared, demand.cycle))
    };
    let mut cores: Vec<Option<usize>> = cores::allowed().into_iter().map(Some).collect();
    if cores.is_empty() {
        cores.push(None);
    }
    let watching = cores.into_iter().map(|core| {
        let shared = Arc::clone(&shared);
        std::thread::spawn(move || watch(&shared, core, demand.cycle))
    });
    let watching: Vec<_> = watching.collect();
    let wrote = if loaded {
        let (writing, shared, cycle) = (writing.try_clone()?, Arc::clone(&shared), demand.cycle);
        let wrote = std::thread::spawn(move || write(writing, &switches, &shared, cycle, duration));
        wrote.join().map_err(|_| io::Error::other("the writer died"))??
    } else {
        std::thread::sleep(duration);
        Wrote::default()
    };
    // The last cycle has its time as well.
    std::thread::sleep(demand.cycle.max(Duration::from_millis(50)));
    let took = shared.begun.elapsed().as_secs_f64();
    let after = (memory(), thread_seconds("io"), thread_seconds("simulation"));
    shared.over.store(true, Ordering::Relaxed);
    handle.stopper().stop();
    let heard = hearing.join().map_err(|_| io::Error::other("the reader died"))?;
    watching.into_iter().for_each(|watching| _ = watching.join());
    let _ = writing.shutdown(std::net::Shutdown::Both);
    let summary = handle.finish()?;
    let share = |before: Option<f64>, after: Option<f64>| Some((after? - before?) / took);
    Ok(Session {
        summary,
        heard,
        wrote,
        shared,
        io_cpu: share(before.1, after.1),
        simulation_cpu: share(before.2, after.2),
        memory: after.0,
        memory_growth: after.0.zip(before.0).map(|(after, before)| after as i64 - before as i64),
        duration_s: duration.as_secs_f64(),
    })
}

impl Session {
    fn held(self, demand: Demand, plant: &Plant) -> Held {
        let late = self.shared.late.lock().map(|late| late.clone()).unwrap_or_default();
        let cycle = demand.cycle.as_nanos() as u64;
        let excused = |sent: &&u64| late.iter().any(|at| *at + cycle >= **sent && *at <= **sent + 3 * cycle);
        // What was never answered is missed as well.
        let unanswered = self.wrote.cycles - self.heard.cycles.min(self.wrote.cycles);
        Held {
            blocks: demand.blocks,
            signals: plant.signal_map.signals().len(),
            cycle_ms: demand.cycle.as_secs_f64() * 1e3,
            duration_s: self.duration_s,
            cycles: self.wrote.cycles,
            missed: self.heard.missed.len() as u64 + unanswered,
            missed_by_system: self.heard.missed.iter().filter(excused).count() as u64,
            lost: self.heard.out_of_turn + unanswered * demand.blocks as u64,
            answer: Measured::of("answer", 0, &self.heard.took),
            bare_thread: Measured::of("bare thread", 0, &self.wrote.late),
            io_cpu: self.io_cpu,
            simulation_cpu: self.simulation_cpu,
            memory: self.memory,
            memory_growth: self.memory_growth,
            step_idle_us: run::Quantiles::default(),
            step_load_us: self.summary.step_us,
            late_steps: self.summary.late_steps,
            overruns: self.summary.overruns,
        }
    }
}

/// What the writer did.
struct Wrote {
    cycles: u64,
    late: Histogram<u64>,
}

impl Default for Wrote {
    fn default() -> Wrote {
        Wrote { cycles: 0, late: histogram() }
    }
}

fn histogram() -> Histogram<u64> {
    Histogram::new_with_bounds(1, 60_000_000_000, 3).expect("bounds in order, three digits")
}

/// Sets every block, every cycle.
fn write(
    stream: TcpStream,
    switches: &[Utf8Bytes; 2],
    shared: &Shared,
    cycle: Duration,
    duration: Duration,
) -> io::Result<Wrote> {
    sharpen_sleep();
    shared.schedule();
    let mut socket = WebSocket::from_raw_socket(stream, Role::Server, None);
    let mut wrote = Wrote::default();
    let begun = Instant::now();
    let mut due = Duration::ZERO;
    while due < duration {
        std::thread::sleep(due.saturating_sub(begun.elapsed()));
        wrote.late.saturating_record(begun.elapsed().saturating_sub(due).as_nanos() as u64);
        let sent = shared.begun.elapsed().as_nanos() as u64;
        shared.sent[(wrote.cycles as usize) % RING].store(sent, Ordering::Release);
        socket.send(Message::Text(switches[(wrote.cycles % 2) as usize].clone())).map_err(io::Error::other)?;
        wrote.cycles += 1;
        due += cycle;
    }
    Ok(wrote)
}

/// How often a bare thread looks whether its core runs what is due.
const LOOK: Duration = Duration::from_millis(1);

/// A bare thread beside it all, on one core where it can choose: when it wakes late, nobody there is served in time.
fn watch(shared: &Shared, core: Option<usize>, cycle: Duration) {
    sharpen_sleep();
    shared.schedule();
    if let Some(core) = core {
        cores::stay(&[core]);
    }
    let begun = shared.begun.elapsed();
    let mut due = begun;
    while !shared.over.load(Ordering::Relaxed) {
        std::thread::sleep(due.saturating_sub(shared.begun.elapsed()));
        let now = shared.begun.elapsed();
        if now.saturating_sub(due) >= cycle / 2
            && let Ok(mut late) = shared.late.lock()
        {
            late.push(now.as_nanos() as u64);
        }
        due = (due + cycle.min(LOOK)).max(now);
    }
}

/// What the reader heard.
struct Heard {
    took: Histogram<u64>,
    cycles: u64,
    /// When the cycles were sent that were answered too late.
    missed: Vec<u64>,
    out_of_turn: u64,
}

struct Reader {
    socket: WebSocket<TcpStream>,
    server: Server,
    /// Of each register that is a block's `ready`: how often it was heard.
    answers: Vec<Option<u64>>,
    blocks: u64,
}

impl Reader {
    fn new(plant: &Arc<Plant>, socket: WebSocket<TcpStream>) -> Reader {
        let mut answers = vec![None; plant.signal_map.signals().len()];
        let ready = blocks::registers(plant, "ready");
        ready.iter().for_each(|register| answers[register.index()] = Some(0));
        let server = Server::new(ServerSettings::new("bench"), Arc::clone(&plant.signal_map));
        Reader { socket, server, answers, blocks: ready.len() as u64 }
    }

    fn now(begun: Instant) -> crate::time::Instant {
        crate::time::Instant::ZERO + begun.elapsed()
    }

    /// Reads until the first reports have come.
    fn establish(&mut self) -> io::Result<()> {
        loop {
            let text = read(&mut self.socket)?;
            self.server.handle(crate::time::Instant::ZERO, Input::Text(&text));
            let mut reported = false;
            while let Some(output) = self.server.poll() {
                match output {
                    Output::Transmit(text) => self.socket.send(Message::text(text)).map_err(io::Error::other)?,
                    Output::Event(ServerEvent::Values(_)) => reported = true,
                    _ => {}
                }
            }
            if reported {
                return Ok(());
            }
        }
    }

    /// Reads until the session ends.
    fn run(mut self, shared: &Shared, cycle: Duration) -> Heard {
        shared.schedule();
        let mut heard = Heard { took: histogram(), cycles: 0, missed: Vec::new(), out_of_turn: 0 };
        let mut waiting = self.blocks;
        while let Ok(text) = read(&mut self.socket) {
            self.server.handle(Reader::now(shared.begun), Input::Text(&text));
            while let Some(output) = self.server.poll() {
                match output {
                    Output::Transmit(text) => _ = self.socket.send(Message::text(text)),
                    Output::Event(ServerEvent::Values(staged)) => {
                        let now = shared.begun.elapsed().as_nanos() as u64;
                        for (register, value) in staged.values {
                            let Some(count) = &mut self.answers[register.index()] else { continue };
                            *count += 1;
                            // The first switch is on, the second off, and so on.
                            let turn = *count == heard.cycles + 1 && value == Value::Bool(*count % 2 == 1);
                            heard.out_of_turn += u64::from(!turn);
                            waiting = waiting.saturating_sub(1);
                        }
                        if waiting == 0 {
                            waiting = self.blocks;
                            let sent = shared.sent[(heard.cycles as usize) % RING].load(Ordering::Acquire);
                            let took = now.saturating_sub(sent);
                            heard.took.saturating_record(took);
                            if took > cycle.as_nanos() as u64 {
                                heard.missed.push(sent);
                            }
                            heard.cycles += 1;
                        }
                    }
                    _ => {}
                }
            }
        }
        heard
    }
}

/// How many blocks can be held as `demand` says, whatever number it names: doubled until a cycle is missed that the system
/// did not miss, then halved in.
pub fn limit(demand: Demand, mut progress: impl FnMut(&Held)) -> Result<usize, BenchError> {
    let mut holds = |blocks: usize| -> Result<bool, BenchError> {
        let held = hold(Demand { blocks, ..demand })?;
        progress(&held);
        Ok(held.is_held())
    };
    let (mut good, mut bad) = (0, 100);
    while bad <= MOST_BLOCKS && holds(bad)? {
        (good, bad) = (bad, bad * 2);
    }
    while bad - good > good / 8 + 10 {
        let middle = (good + bad) / 2;
        if holds(middle)? { good = middle } else { bad = middle }
    }
    Ok(good)
}

/// A message of more blocks is longer than the limit of 1 MiB.
const MOST_BLOCKS: usize = 20_000;

/// The memory of this process, bytes; `None` where the system does not tell.
pub fn memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmRSS:"))?;
    line.split_whitespace().nth(1)?.parse::<u64>().ok().map(|kib| kib * 1024)
}

/// The processor time that the threads called `name` have used, seconds; `None` where the system does not tell.
fn thread_seconds(name: &str) -> Option<f64> {
    let mut ticks = 0;
    for task in std::fs::read_dir("/proc/self/task").ok()? {
        let stat = std::fs::read_to_string(task.ok()?.path().join("stat")).ok()?;
        let (head, rest) = stat.rsplit_once(')')?;
        if head.split_once('(').is_some_and(|(_, thread)| thread == name) {
            // The fields after the name: utime and stime are the 12th and 13th (proc(5)), in hundredths of a second.
            let fields: Vec<u64> =
                rest.split_whitespace().skip(11).take(2).filter_map(|field| field.parse().ok()).collect();
            ticks += fields.iter().sum::<u64>();
        }
    }
    Some(ticks as f64 / 100.0)
}
