//! How a run is controlled while it goes on: orders in, pictures of it out.
//!
//! Both ends meet in lock-free queues of fixed room. The simulation's end looks into them between two steps, does
//! what stands there, and goes on; nobody who orders or looks can keep it waiting. A picture is made only when somebody has
//! asked for one, into the room that they brought: without a viewer a run costs one look into two empty queues a step.

use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};
use std::time::Duration;

use crossbeam::queue::ArrayQueue;

use super::live::SimulationFrame;
use super::options::Speed;
use crate::engine::{Act, ActError, Held};
use crate::kinematics::DPose3;
use crate::pace::{Next, Simulation};
use crate::time::Instant;

/// Orders that may wait for the simulation's next step.
const ORDERS: usize = 256;
/// How long a paused simulation sleeps between two looks at its orders.
const DOZE: Duration = Duration::from_millis(2);

/// What a run is told to do.
#[derive(Clone, Debug, PartialEq)]
pub enum Order {
    /// Do this to the plant; `deed` is what the trace says of it.
    Operate { act: Act, deed: String },
    /// Simulated time stands still from the next step on.
    Pause,
    /// It goes by again.
    Resume,
    /// Makes so many steps and pauses; answered when they are made.
    Steps(u64),
    /// From the next step on simulated time goes by like this.
    Speed(Speed),
}

/// What became of an order: the simulated time from which on it counts.
pub type Outcome = Result<Instant, ActError>;

/// The answer to an order, when it is there.
#[derive(Clone, Debug)]
pub struct Receipt(Arc<OnceLock<Outcome>>);

impl Receipt {
    /// The answer; `None` while the simulation has not come to the order.
    pub fn outcome(&self) -> Option<&Outcome> {
        self.0.get()
    }
}

/// Too many orders wait.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{ORDERS} orders wait for the simulation already; try again")]
pub struct Busy;

struct Slip {
    order: Order,
    receipt: Arc<OnceLock<Outcome>>,
}

/// A picture of a run, as a viewer needs it.
#[derive(Clone, Debug, Default)]
pub struct Picture {
    pub frame: SimulationFrame,
    /// Signals that are forced or stick.
    pub held: Vec<Held>,
    /// Instances whose drives have no power.
    pub dead: Vec<String>,
    /// The automation's next message will be lost.
    pub loses: bool,
    pub paused: bool,
    pub speed: Speed,
    /// Where the frames of the scene are, by their places in it.
    pub poses: Vec<DPose3>,
    /// Whether something cuts them, of the beams of the scene.
    pub beams: Vec<bool>,
    /// How long each device that handles parts had some, s of simulated time, as seen from picture to picture.
    pub occupancy: BTreeMap<String, f64>,
}

/// The end of whoever controls and looks. Clones give orders to the same run.
#[derive(Clone)]
pub struct Controls {
    slips: Arc<ArrayQueue<Slip>>,
    wanted: Arc<ArrayQueue<Picture>>,
    made: Arc<ArrayQueue<Picture>>,
}

impl Controls {
    /// Hands an order to the simulation.
    pub fn order(&self, order: Order) -> Result<Receipt, Busy> {
        let receipt = Arc::new(OnceLock::new());
        self.slips.push(Slip { order, receipt: Arc::clone(&receipt) }).map_err(|_| Busy)?;
        Ok(Receipt(receipt))
    }

    /// Asks for a picture, to be made after the present step in the room of an old one. Asked twice before it is made, it is
    /// made once.
    pub fn ask(&self, room: Picture) {
        // One that waits already will be as new.
        let _ = self.wanted.push(room);
    }

    /// The newest picture, if one was made since the last was taken.
    pub fn picture(&self) -> Option<Picture> {
        self.made.pop()
    }
}

/// The simulation's end.
pub(super) struct Desk {
    slips: Arc<ArrayQueue<Slip>>,
    wanted: Arc<ArrayQueue<Picture>>,
    made: Arc<ArrayQueue<Picture>>,
    paused: bool,
    /// Steps to make before the next pause, and who waits for it.
    stepping: Option<(u64, Arc<OnceLock<Outcome>>)>,
    speed: Speed,
    /// How long each device had parts, until when.
    busy: BTreeMap<String, f64>,
    counted: Instant,
}

/// The two ends for a run that begins at `speed`.
pub(super) fn desk(speed: Speed) -> (Controls, Desk) {
    let (slips, wanted, made) =
        (Arc::new(ArrayQueue::new(ORDERS)), Arc::new(ArrayQueue::new(1)), Arc::new(ArrayQueue::new(1)));
    let controls = Controls { slips: Arc::clone(&slips), wanted: Arc::clone(&wanted), made: Arc::clone(&made) };
    let (busy, counted) = (BTreeMap::new(), Instant::ZERO);
    (controls, Desk { slips, wanted, made, paused: false, stepping: None, speed, busy, counted })
}

impl Desk {
    /// Does what was ordered, makes the picture that was asked for, and says what comes next: never the end.
    pub fn attend(&mut self, simulation: &mut Simulation) -> Next {
        let speed = self.speed;
        while let Some(slip) = self.slips.pop() {
            self.take(slip, simulation);
        }
        if let Some(mut picture) = self.wanted.pop() {
            self.count(simulation);
            self.fill(&mut picture, simulation);
            // What nobody has taken is older.
            self.made.force_push(picture);
        }
        if self.is_held(simulation.engine().now()) {
            return Next::Wait(DOZE);
        }
        match self.speed {
            Speed::Wall(factor) if self.speed != speed => Next::At(factor),
            _ => Next::Step,
        }
    }

    /// How simulated time goes by at present.
    pub fn speed(&self) -> Speed {
        self.speed
    }

    /// Whether no step is to be made now; else one is made, and counted.
    fn is_held(&mut self, now: Instant) -> bool {
        match &mut self.stepping {
            Some((0, waiting)) => {
                // Nobody else answers this one.
                let _ = waiting.set(Ok(now));
                self.stepping = None;
                self.paused = true;
            }
            Some((left, _)) => *left -= 1,
            None => {}
        }
        self.paused && self.stepping.is_none()
    }

    fn take(&mut self, Slip { order, receipt }: Slip, simulation: &mut Simulation) {
        let now = simulation.engine().now();
        let outcome = match order {
            Order::Operate { act, deed } => simulation.operate(Some(&act), deed),
            Order::Pause | Order::Resume => {
                self.paused = order == Order::Pause;
                self.end_stepping(now);
                simulation.operate(None, format!("{{\"pause\":{}}}", self.paused))
            }
            Order::Steps(steps) => {
                self.end_stepping(now);
                self.stepping = Some((steps, receipt));
                return;
            }
            Order::Speed(speed) => {
                self.speed = speed;
                let factor = if let Speed::Wall(factor) = speed { factor } else { 0.0 };
                simulation.operate(None, format!("{{\"speed\":{factor}}}"))
            }
        };
        // Nobody else answers this one.
        let _ = receipt.set(outcome.map(|()| now));
    }

    fn end_stepping(&mut self, now: Instant) {
        if let Some((_, waiting)) = self.stepping.take() {
            // Nobody else answers this one.
            let _ = waiting.set(Ok(now));
        }
    }

    /// Counts the time since the last picture for the devices that have parts now.
    fn count(&mut self, simulation: &Simulation) {
        let now = simulation.engine().now();
        let span = now.since(self.counted).as_secs_f64();
        self.counted = now;
        for (device, parts) in simulation.engine().loads() {
            let busy = if parts > 0 { span } else { 0.0 };
            match self.busy.get_mut(device) {
                Some(so_far) => *so_far += busy,
                None => drop(self.busy.insert(device.to_owned(), busy)),
            }
        }
    }

    fn fill(&self, picture: &mut Picture, simulation: &Simulation) {
        let engine = simulation.engine();
        picture.frame.fill(simulation);
        picture.held.clear();
        picture.held.extend_from_slice(engine.held());
        picture.dead.clear();
        picture.dead.extend(engine.dead_drives().map(str::to_owned));
        picture.loses = engine.loses_next();
        picture.paused = self.paused && self.stepping.is_none();
        picture.speed = self.speed;
        picture.poses.clear();
        picture.poses.extend_from_slice(engine.poses().map_or(&[], |poses| poses.all()));
        picture.beams.clear();
        picture.beams.extend(engine.cut_beams());
        picture.occupancy.clone_from(&self.busy);
    }
}
