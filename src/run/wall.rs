//! A run on the wall clock: a thread that simulates, one that speaks with the automation, and the automation's own.

use std::io;
use std::sync::Arc;
use std::thread::{self, JoinHandle};
use std::time::Duration;

use crossbeam::channel::{Sender, bounded};

use super::control::{self, Desk};
use super::live::{self, ExchangeFrame, Publisher, SimulationFrame};
use super::notice::{Gravity, incident, notice};
use super::recording::{self, Tap};
use super::summary::{Simulated, Spoken};
use super::{
    Connect, Facts, Handle, Notice, Options, Quantiles, RunError, ServerPlace, Steering, Stop, Summary, model,
};
use crate::adapter::{Adapter, Endpoint, WebSocketConnector};
use crate::automation::server::{ListenSettings, Server};
use crate::automation::{Automation, Control, Faulty};
use crate::bank;
use crate::engine::Engine;
use crate::pace::{Exchange, Listener, Next, Simulation, Urgency, WallClock, bell, drive, prefer};
use crate::plant::Plant;
use crate::scene::Scene;

/// Notices that may wait to be read. A server that sends nothing but garbage must not fill the memory with complaints.
pub(super) const NOTICES: usize = 1_024;

/// How often the simulation shows itself.
pub(super) const FRAME_INTERVAL: Duration = Duration::from_millis(50);

/// Starts a run of `plant` at `speed` simulated seconds a second, until `stop`.
pub(super) fn start(
    options: &Options,
    plant: Arc<Plant>,
    (connect, speed): (Connect, f64),
    stop: Stop,
) -> Result<Handle, RunError> {
    let mut engine = model::engine(&plant, options.step, options.seed)?;
    let scene = (options.controlled || options.collisions).then(|| show(&mut engine, &plant));
    if options.collisions {
        engine.watch();
    }
    let (server, endpoint, place) = reach(connect, &plant)?;
    let mut connector = WebSocketConnector::new();
    connector.configure(options.settings(&plant, endpoint))?;
    connector.init(&plant.signal_map);
    connector.connect();
    let facts = Facts::new(options, plant, place);
    let (bell, listener) = bell().map_err(RunError::Thread)?;
    let ((recording, tap, journal), record) = match options.controlled {
        false => (recording::start(options, &facts)?, None),
        true => {
            let (recording, tap, journal, record) = recording::listen(options, &facts)?;
            ((recording, tap, journal), Some(record))
        }
    };
    let (controls, desk) = record.is_some().then(|| control::desk(options.speed)).unzip();

    let (simulation_side, io_side) = bank::new(&facts.plant.signal_map);
    let (say, notices) = bounded(NOTICES);
    let (simulation_frames, simulation_viewer) = live::channel();
    let (exchange_frames, exchange_viewer) = live::channel();
    let io = Io {
        exchange: Exchange::new(connector, io_side, tap, facts.rates),
        frames: exchange_frames,
        say: say.clone(),
        stop: stop.clone(),
        spoken: Spoken::default(),
        realtime: options.realtime,
    };
    let io = spawn("io", move || io.run(listener))?;
    let simulating = Simulating {
        simulation: Simulation::new(engine, simulation_side, Some(bell), journal),
        frames: simulation_frames,
        say,
        stop: stop.clone(),
        steps: options.steps(),
        stop_on_collision: options.stop_on_collision,
        speed,
        desk,
        realtime: options.realtime,
    };
    let simulating = spawn("simulation", move || simulating.run())?;

    let server = Arc::new(server);
    let asked = Arc::clone(&server);
    let round_trip: Arc<dyn Fn() -> Quantiles + Send + Sync> = Arc::new(move || round_trip_of(&asked));
    let paced = Arc::clone(&server);
    let steering = controls.zip(record).zip(scene).map(|((controls, record), scene)| Steering {
        scene,
        controls,
        record,
        tempo: Arc::new(move |rate| paced.as_ref().as_ref().map_or((), |server| server.set_tempo(rate))),
        round_trip: Arc::clone(&round_trip),
    });
    if let Some(steering) = &steering {
        (steering.tempo)(speed);
    }
    let summed = facts.clone();
    let end = move || {
        let simulated = simulating.join().map_err(|_| RunError::Died("simulation"))?;
        let spoken = io.join().map_err(|_| RunError::Died("IO"))?.map_err(RunError::Thread)?;
        let round_trip = round_trip_of(&server);
        let recorded = recording.finish()?;
        Ok(Summary::new(&summed, &simulated, &spoken, round_trip, recorded))
    };
    Ok(Handle {
        facts,
        stop,
        notices,
        simulation: simulation_viewer,
        exchange: exchange_viewer,
        round_trip,
        steering,
        end: Box::new(end),
    })
}

/// Has the scene of `plant` follow `engine`.
pub(super) fn show(engine: &mut Engine, plant: &Plant) -> Arc<Scene> {
    let scene = Arc::new(Scene::of(plant));
    engine.show(plant, Arc::clone(&scene));
    scene
}

/// Where the automation is; starts it where it is embedded: on a free port, on the loopback interface alone.
pub(super) fn reach(connect: Connect, plant: &Plant) -> Result<(Option<Server>, Endpoint, ServerPlace), RunError> {
    match connect {
        Connect::Server(endpoint) => Ok((None, endpoint.clone(), ServerPlace::Foreign(endpoint))),
        Connect::Embedded => {
            let automation = Automation::new(plant.signal_map.clone(), Control::ByPlant)?;
            let server = Server::start(ListenSettings::loopback(), Faulty::new(automation, &[], 0))?;
            let address = server.address();
            let endpoint = Endpoint::new(address.ip().to_string(), address.port());
            Ok((Some(server), endpoint, ServerPlace::Embedded(address)))
        }
    }
}

fn round_trip_of(server: &Option<Server>) -> Quantiles {
    let statistics = server.as_ref().and_then(Server::statistics);
    statistics.map(|statistics| Quantiles::of_ns(&statistics.round_trip_ns)).unwrap_or_default()
}

fn spawn<T: Send + 'static>(name: &str, work: impl FnOnce() -> T + Send + 'static) -> Result<JoinHandle<T>, RunError> {
    thread::Builder::new().name(name.to_owned()).spawn(work).map_err(RunError::Thread)
}

/// The simulation's thread.
struct Simulating {
    simulation: Simulation,
    frames: Publisher<SimulationFrame>,
    say: Sender<Notice>,
    stop: Stop,
    steps: Option<u64>,
    stop_on_collision: bool,
    speed: f64,
    /// Where it can be controlled.
    desk: Option<Desk>,
    realtime: bool,
}

impl Simulating {
    /// Simulates until the last step or until it is stopped. When it is done the bell is gone: that ends the IO thread.
    fn run(self) -> Simulated {
        let Simulating { mut simulation, frames, say, stop, steps, stop_on_collision, speed, mut desk, realtime } =
            self;
        let clock = WallClock::start();
        if realtime && let Err(refused) = prefer(Urgency::Simulation) {
            let text = refused.to_string();
            let _ = say.try_send(Notice { at: clock.now(), gravity: Gravity::Warning, text, place: None });
        }
        let frame_steps = |speed: f64| {
            ((FRAME_INTERVAL.as_secs_f64() * speed / simulation.engine().step().as_secs_f64()) as u64).max(1)
        };
        let frame_steps = frame_steps(speed);
        let mut spare = SimulationFrame::default();
        simulation.pace(speed, |simulation| {
            // Where nobody reads them fast enough, the newest are left out: a step waits for nobody.
            simulation.take_incidents().iter().for_each(|what| drop(say.try_send(incident(what, clock.now()))));
            let made = simulation.timing().steps;
            if made.is_multiple_of(frame_steps) {
                spare.fill(simulation);
                spare = frames.publish(std::mem::take(&mut spare)).unwrap_or_default();
            }
            let has_collided = stop_on_collision && simulation.engine().collisions() > 0;
            if has_collided || stop.is_asked() || steps.is_some_and(|steps| made >= steps) {
                return Next::End;
            }
            desk.as_mut().map_or(Next::Step, |desk| desk.attend(simulation))
        });
        Simulated::of(&simulation, clock.now())
    }
}

/// The IO thread.
struct Io {
    exchange: Exchange<WebSocketConnector, Tap>,
    frames: Publisher<ExchangeFrame>,
    say: Sender<Notice>,
    stop: Stop,
    spoken: Spoken,
    realtime: bool,
}

impl Io {
    /// Speaks with the automation until the simulation is over and the session is closed.
    fn run(mut self, listener: Listener) -> io::Result<Spoken> {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
        let clock = WallClock::start();
        if self.realtime {
            // Where it is refused, the simulation's thread was refused as well, and says so.
            let _ = prefer(Urgency::Exchange);
        }
        let Io { exchange, frames, say, stop, spoken, .. } = &mut self;
        runtime.block_on(async {
            let ears = listener.listen()?;
            drive(exchange, ears, clock, |exchange, now| {
                let connector = exchange.adapter();
                while let Some(event) = connector.poll_event() {
                    spoken.take(&event);
                    // Where nobody reads them fast enough, the newest are left out.
                    notice(&event, now).map(|notice| say.try_send(notice));
                    if event.is_final_refusal() || spoken.is_denied() {
                        stop.stop();
                    }
                }
                spoken.traffic = connector.traffic();
                frames.publish(ExchangeFrame { connected: connector.is_connected(), traffic: spoken.traffic });
            })
            .await;
            io::Result::Ok(())
        })?;
        let Io { exchange, spoken, .. } = self;
        // The recorder ends when its tap is gone.
        drop(exchange.dispose());
        Ok(spoken)
    }
}
