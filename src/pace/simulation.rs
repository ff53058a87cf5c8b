//! The simulation thread's loop: one step after the other, on the wall clock or as a caller says.

use std::time::Duration;

use hdrhistogram::Histogram;

use super::bell::Bell;
use super::clock::WallClock;
use crate::bank::SimulationSide;
use crate::engine::{Act, ActError, Engine, Incident, IncidentKind};
use crate::signal_map::RegisterId;
use crate::time::Instant;
use crate::value::Value;

/// Who is told which messages a step took: the recorder.
pub trait Journal: Send {
    /// The step at the simulated time `at` took the messages up to `number`. Must not wait.
    fn taken(&mut self, number: u64, at: Instant);

    /// Before the step at the simulated time `at`, an operator did this: one JSON object. Must not wait.
    fn operated(&mut self, _at: Instant, _deed: String) {}

    /// Something went wrong with a part or a body. Must not wait.
    fn noted(&mut self, _incident: &Incident) {}
}

/// A journal that nobody reads.
pub struct NoJournal;

impl Journal for NoJournal {
    fn taken(&mut self, _number: u64, _at: Instant) {}
}

/// How the steps went.
#[derive(Clone, Debug)]
pub struct Timing {
    /// Steps made.
    pub steps: u64,
    /// Steps whose computation took longer than the step lasts.
    pub overruns: u64,
    /// Steps that began more than a step too late because the operating system woke the thread late, or gave its time to
    /// others; those that an overrun of ours pushed back are not among them.
    pub late_steps: u64,
    /// The computing time of each step, in nanoseconds of processor time.
    pub computing_ns: Histogram<u64>,
    /// How late each step began on the wall clock, in nanoseconds; empty where steps keep to no clock.
    pub lateness_ns: Histogram<u64>,
}

impl Timing {
    fn new() -> Timing {
        // Up to a minute; three digits. What is longer counts as a minute.
        let empty = || Histogram::new_with_bounds(1, LONGEST_STEP_NS, 3).expect("bounds in order, three digits");
        Timing { steps: 0, overruns: 0, late_steps: 0, computing_ns: empty(), lateness_ns: empty() }
    }
}

const LONGEST_STEP_NS: u64 = 60_000_000_000;

/// A running engine with its side of the memory.
pub struct Simulation {
    engine: Engine,
    bank: SimulationSide,
    bell: Option<Bell>,
    journal: Box<dyn Journal>,
    inputs: Vec<(RegisterId, Value)>,
    changed: Vec<RegisterId>,
    timing: Timing,
    /// What went wrong and was not asked for yet.
    incidents: Vec<Incident>,
    /// The first collisions since the start.
    collisions: Vec<Incident>,
}

/// How many incidents wait to be asked for; all are counted.
const WAITING: usize = 256;
/// How many collisions are kept to the end.
const KEPT: usize = 16;

impl Simulation {
    /// `engine` on `bank`. The `bell` wakes the IO thread, where there is one.
    pub fn new(engine: Engine, bank: SimulationSide, bell: Option<Bell>, journal: Box<dyn Journal>) -> Simulation {
        Simulation {
            engine,
            bank,
            bell,
            journal,
            inputs: Vec::new(),
            changed: Vec::new(),
            timing: Timing::new(),
            incidents: Vec::new(),
            collisions: Vec::new(),
        }
    }

    /// The engine.
    pub fn engine(&self) -> &Engine {
        &self.engine
    }

    /// What went wrong with parts and bodies since this was asked last, the first 256 of it.
    pub fn take_incidents(&mut self) -> Vec<Incident> {
        std::mem::take(&mut self.incidents)
    }

    /// The first collisions since the start, at most 16.
    pub fn collisions(&self) -> &[Incident] {
        &self.collisions
    }

    fn note(&mut self) {
        for incident in self.engine.take_incidents() {
            self.journal.noted(&incident);
            let is_collision = matches!(incident.kind, IncidentKind::Collision { .. });
            if is_collision && self.collisions.len() < KEPT {
                self.collisions.push(incident.clone());
            }
            if self.incidents.len() < WAITING {
                self.incidents.push(incident);
            }
        }
    }

    /// Does an operator's `act` before the next step, and has it recorded as `deed`; without an act, something is recorded
    /// that is none on the plant.
    ///
    /// # Errors
    /// It cannot be done: nothing has changed, nothing is recorded.
    pub fn operate(&mut self, act: Option<&Act>, deed: String) -> Result<(), ActError> {
        act.map_or(Ok(()), |act| self.engine.operate(act))?;
        self.journal.operated(self.engine.now(), deed);
        Ok(())
    }

    /// How the steps went so far.
    pub fn timing(&self) -> &Timing {
        &self.timing
    }

    /// One step: takes the commands that arrived, computes, publishes the reports.
    pub fn step(&mut self) {
        let begun = processor_time();
        let now = self.engine.now();
        if let Some(number) = self.bank.take(&mut self.inputs) {
            self.journal.taken(number, now);
        }
        self.engine.tick(&self.inputs);
        self.note();
        self.engine.take_changed(&mut self.changed);
        let edge = self.bank.publish_changed(now, self.engine.registers(), &self.changed);
        // The first step's reports are what a session begins with, edge or not.
        if let Some(bell) = self.bell.as_mut().filter(|_| edge || self.timing.steps == 0) {
            bell.ring();
        }
        let spent = processor_time().saturating_sub(begun);
        self.timing.steps += 1;
        self.timing.computing_ns.saturating_record(spent.as_nanos() as u64);
        self.timing.overruns += u64::from(spent > self.engine.step());
    }

    /// Steps on the wall clock, `speed` simulated seconds to a second, until `after`, which sees the simulation before the
    /// first step, after each step, and after each wait that it asked for, says that it is the end. Sleeps between steps, and
    /// never spins.
    ///
    /// Where a step began late, those after it follow at once until the schedule is kept again: simulated time is never
    /// let go of. After a wait, and with another speed, the schedule begins anew.
    pub fn pace(&mut self, speed: f64, mut after: impl FnMut(&mut Simulation) -> Next) {
        sharpen_sleep();
        let clock = WallClock::start();
        let step = self.engine.step();
        let mut schedule = Schedule { from: clock.now(), steps: 0, period: step.div_f64(speed) };
        let mut owed_by_us = false;
        loop {
            match after(self) {
                Next::Step => {}
                Next::At(speed) => {
                    schedule = Schedule { from: clock.now(), steps: 0, period: step.div_f64(speed) };
                    owed_by_us = false;
                }
                Next::Wait(span) => {
                    std::thread::sleep(span);
                    schedule = Schedule { from: clock.now(), steps: 0, ..schedule };
                    owed_by_us = false;
                    continue;
                }
                Next::End => return,
            }
            let due = schedule.due();
            let ahead = due.since(clock.now());
            if !ahead.is_zero() {
                std::thread::sleep(ahead);
            }
            let late = clock.now().since(due);
            self.timing.lateness_ns.saturating_record(late.as_nanos() as u64);
            if late < schedule.period {
                owed_by_us = false;
            } else if !owed_by_us {
                self.timing.late_steps += 1;
            }
            let overruns = self.timing.overruns;
            self.step();
            schedule.steps += 1;
            owed_by_us |= self.timing.overruns > overruns;
        }
    }
}

/// What comes after a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Next {
    /// The next one, when it is due.
    Step,
    /// The next one, and from here on so many simulated seconds to a second.
    At(f64),
    /// Nothing for so long; then `after` is asked again.
    Wait(Duration),
    /// Nothing.
    End,
}

/// When steps are due.
struct Schedule {
    from: Instant,
    /// Steps made since.
    steps: u64,
    period: Duration,
}

impl Schedule {
    fn due(&self) -> Instant {
        self.from + Duration::from_secs_f64(self.steps as f64 * self.period.as_secs_f64())
    }
}

/// The processor time that the calling thread has used. What others used while it waited for its turn is not in it.
#[cfg(unix)]
fn processor_time() -> Duration {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::new(time.tv_sec as u64, time.tv_nsec as u32)
}

/// The time that goes by: where a thread's own cannot be asked for, what others use counts as ours.
#[cfg(not(unix))]
fn processor_time() -> Duration {
    use std::sync::LazyLock;
    static ORIGIN: LazyLock<std::time::Instant> = LazyLock::new(std::time::Instant::now);
    ORIGIN.elapsed()
}

/// Asks Linux not to delay this thread's timers in order to save wake-ups: by default it adds up to 50 µs to a sleep.
pub fn sharpen_sleep() {
    #[cfg(target_os = "linux")]
    {
        // Where it is refused, steps begin a little later than they might: no reason to stop.
        let _ = rustix::thread::set_current_timer_slack(std::num::NonZeroU64::new(1));
    }
}
