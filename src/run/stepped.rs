//! A run in lock-step: simulation, session and automation take turns on one thread, and time is the simulation's.
//!
//! The two ends still speak the protocol, text for text, through the same sessions and the same bank as over a WebSocket;
//! only the way between them is memory. After each step the exchange turns at that step's instant: the automation hears
//! what the step published, its timers that are due run, and all that it has to say is staged for the next step. Nothing
//! is ever under way, so the run does not depend on how fast the computer is: the same model and seed give the same state,
//! bit for bit.

use std::sync::Arc;
use std::task::{Context, Waker};
use std::thread;

use crossbeam::channel::bounded;

use super::control::{self, Desk};
use super::live::{self, ExchangeFrame, SimulationFrame};
use super::notice::{incident, notice};
use super::recording::{self, RecordControl, Recording, Tap};
use super::summary::{Simulated, Spoken};
use super::wall::{NOTICES, show};
use super::{Facts, Handle, Notice, Options, Quantiles, RunError, ServerPlace, Speed, Steering, Stop, Summary, model};
use crate::adapter::{Adapter, Endpoint, FromPeer, InProcess, Peer};
use crate::automation::{Automation, ConnectionId, Control, Output};
use crate::bank;
use crate::engine::Engine;
use crate::pace::{Exchange, Next, Simulation, WallClock};
use crate::plant::Plant;
use crate::scene::Scene;
use crate::session::Input;
use crate::time::Instant;

/// A run that its caller steps.
pub struct Stepper {
    facts: Facts,
    simulation: Simulation,
    exchange: Exchange<InProcess<Embedded>, Tap>,
    recording: Recording,
    record: Option<RecordControl>,
    scene: Option<Arc<Scene>>,
    clock: WallClock,
    spoken: Spoken,
    notices: Vec<Notice>,
}

impl Stepper {
    /// A run of the options' model with the embedded automation, before its first step; the session stands. `speed`,
    /// `duration` and what concerns the connection are not looked at.
    pub fn new(options: &Options) -> Result<Stepper, RunError> {
        let plant = Arc::new(model::load(&options.model)?);
        options.validate()?;
        Stepper::of(options, plant)
    }

    pub(super) fn of(options: &Options, plant: Arc<Plant>) -> Result<Stepper, RunError> {
        let mut engine = model::engine(&plant, options.step, options.seed)?;
        let scene = (options.controlled || options.collisions).then(|| show(&mut engine, &plant));
        if options.collisions {
            engine.watch();
        }
        let automation = Automation::new(plant.signal_map.clone(), Control::ByPlant)?;
        let mut connector = InProcess::to(Embedded { automation, connection: ConnectionId(0) });
        connector.configure(options.settings(&plant, Endpoint::new("localhost", 1)))?;
        connector.init(&plant.signal_map);
        connector.connect();
        let facts = Facts::new(options, plant, ServerPlace::Memory);
        let ((recording, tap, journal), record) = match options.controlled {
            false => (recording::start(options, &facts)?, None),
            true => {
                let (recording, tap, journal, record) = recording::listen(options, &facts)?;
                ((recording, tap, journal), Some(record))
            }
        };
        let (simulation_side, io_side) = bank::new(&facts.plant.signal_map);
        let mut stepper = Stepper {
            simulation: Simulation::new(engine, simulation_side, None, journal),
            exchange: Exchange::new(connector, io_side, tap, facts.rates),
            facts,
            recording,
            record,
            scene,
            clock: WallClock::start(),
            spoken: Spoken::default(),
            notices: Vec::new(),
        };
        stepper.turn(Instant::ZERO);
        Ok(stepper)
    }

    /// What does not change.
    pub fn facts(&self) -> &Facts {
        &self.facts
    }

    /// The engine.
    pub fn engine(&self) -> &Engine {
        self.simulation.engine()
    }

    /// One step, and all that the automation has to say to it.
    pub fn step(&mut self) {
        let now = self.simulation.engine().now();
        self.simulation.step();
        self.notices.extend(self.simulation.take_incidents().iter().map(|what| incident(what, now)));
        self.turn(now);
    }

    fn turn(&mut self, now: Instant) {
        self.exchange.turn(&mut Context::from_waker(Waker::noop()), now);
        let connector = self.exchange.adapter();
        while let Some(event) = connector.poll_event() {
            self.spoken.take(&event);
            self.notices.extend(notice(&event, now));
        }
        self.spoken.traffic = connector.traffic();
    }

    /// Ends the session, and sums up.
    pub fn finish(mut self) -> Result<Summary, RunError> {
        let now = self.simulation.engine().now();
        self.exchange.adapter().disconnect(now);
        self.turn(now);
        let simulated = Simulated::of(&self.simulation, self.clock.now());
        // The recorder ends when its tap is gone.
        drop(self.exchange.dispose());
        let recorded = self.recording.finish()?;
        // In lock-step the way there and back takes no time: there is nothing to measure.
        Ok(Summary::new(&self.facts, &simulated, &self.spoken, Quantiles::default(), recorded))
    }
}

/// Steps between two looks at the wall clock, for the live view.
const STEPS_A_LOOK: u64 = 64;

/// Starts a run of `plant` as fast as possible, on a thread of its own, until `stop`.
pub(super) fn start(options: &Options, plant: Arc<Plant>, stop: Stop) -> Result<Handle, RunError> {
    let stepper = Stepper::of(options, plant)?;
    let (controls, desk) = stepper.record.is_some().then(|| control::desk(options.speed)).unzip();
    let ends = controls.zip(stepper.record.clone()).zip(stepper.scene.clone());
    let steering = ends.map(|((controls, record), scene)| Steering {
        scene,
        controls,
        record,
        tempo: Arc::new(|_| {}),
        round_trip: Arc::new(Quantiles::default),
    });
    let facts = stepper.facts.clone();
    let (say, notices) = bounded(NOTICES);
    let (simulation_frames, simulation_viewer) = live::channel();
    let (exchange_frames, exchange_viewer) = live::channel();
    let (steps, asked, to_first) = (options.steps(), stop.clone(), options.stop_on_collision);
    let work = move || {
        let mut stepper = stepper;
        let mut shown = Instant::ZERO;
        let mut frame = SimulationFrame::default();
        let mut tempo = Tempo { desk, kept: None };
        while steps.is_none_or(|steps| stepper.simulation.timing().steps < steps)
            && !asked.is_asked()
            && !(to_first && stepper.engine().collisions() > 0)
        {
            if !tempo.keep(&mut stepper) {
                continue;
            }
            stepper.step();
            stepper.notices.drain(..).for_each(|notice| drop(say.try_send(notice)));
            if tempo.kept.is_none() && !stepper.simulation.timing().steps.is_multiple_of(STEPS_A_LOOK) {
                continue;
            }
            let now = stepper.clock.now();
            if now.since(shown) >= super::wall::FRAME_INTERVAL {
                shown = now;
                frame.fill(&stepper.simulation);
                frame = simulation_frames.publish(std::mem::take(&mut frame)).unwrap_or_default();
                let connected = stepper.exchange.adapter().is_connected();
                exchange_frames.publish(ExchangeFrame { connected, traffic: stepper.spoken.traffic });
            }
        }
        stepper.finish()
    };
    let thread = thread::Builder::new().name("simulation".to_owned()).spawn(work).map_err(RunError::Thread)?;
    Ok(Handle {
        facts,
        stop,
        notices,
        simulation: simulation_viewer,
        exchange: exchange_viewer,
        round_trip: Arc::new(Quantiles::default),
        steering,
        end: Box::new(move || thread.join().unwrap_or(Err(RunError::Died("simulation")))),
    })
}

/// How a controlled run in lock-step keeps to the wall clock where it was given a speed.
struct Tempo {
    desk: Option<Desk>,
    /// The speed, and where it was begun to be kept: on the wall clock, and in simulated time.
    kept: Option<(f64, Instant, Instant)>,
}

impl Tempo {
    /// Does what was ordered, and waits until the next step is due. Whether it is to be made.
    fn keep(&mut self, stepper: &mut Stepper) -> bool {
        let Some(desk) = &mut self.desk else { return true };
        let (simulation, clock) = (&mut stepper.simulation, stepper.clock);
        if let Next::Wait(span) = desk.attend(simulation) {
            thread::sleep(span);
            self.kept = None;
            return false;
        }
        let Speed::Wall(speed) = desk.speed() else {
            self.kept = None;
            return true;
        };
        let now = simulation.engine().now();
        let kept = self.kept.filter(|(kept, ..)| *kept == speed);
        let (_, wall, simulated) = *self.kept.insert(kept.unwrap_or((speed, clock.now(), now)));
        thread::sleep((wall + now.since(simulated).div_f64(speed)).since(clock.now()));
        true
    }
}

/// The automation as a peer in memory.
struct Embedded {
    automation: Automation,
    connection: ConnectionId,
}

impl Peer for Embedded {
    fn open(&mut self, now: Instant) {
        self.connection.0 += 1;
        self.automation.handle(now, self.connection, Input::Opened);
    }

    fn take(&mut self, now: Instant, text: &str) {
        self.automation.handle(now, self.connection, Input::Text(text));
    }

    fn give(&mut self, now: Instant) -> Option<FromPeer> {
        loop {
            match self.automation.poll() {
                Some(Output::Transmit { connection, text }) if connection == self.connection => {
                    return Some(FromPeer::Text(text));
                }
                Some(Output::Close { connection, reason, .. }) if connection == self.connection => {
                    return Some(FromPeer::Closed(reason));
                }
                // Of a connection that is no more.
                Some(_) => {}
                None if self.automation.timeout().is_some_and(|due| due <= now) => self.automation.wake(now),
                None => return None,
            }
        }
    }

    fn close(&mut self, now: Instant) {
        self.automation.handle(now, self.connection, Input::Closed);
    }
}
