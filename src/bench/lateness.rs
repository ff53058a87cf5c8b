//! How late a bare thread wakes that sleeps from millisecond to millisecond, and how late the simulation's steps begin that
//! sleep in the same way; in turns, and once more under real-time scheduling where the system permits it.

use std::io;
use std::time::Duration;

use hdrhistogram::Histogram;

use super::row::Measured;
use super::{BenchError, blocks};
use crate::bank;
use crate::engine::Engine;
use crate::pace::{Next, NoJournal, Simulation, Urgency, WallClock, prefer, sharpen_sleep};
use crate::plant::Plant;
use crate::run::{Options, model};
use crate::time::Instant;

/// The rows of a bare thread and of the simulation's loop.
#[derive(Clone, Copy)]
pub struct Pair {
    pub bare: &'static str,
    pub looped: &'static str,
}

/// Scheduled as every thread is.
pub const SHARED: Pair = Pair { bare: "lateness at 1 ms: bare thread", looped: "lateness at 1 ms: simulation loop" };
/// Under real-time scheduling.
pub const REALTIME: Pair =
    Pair { bare: "lateness at 1 ms, real-time: bare thread", looped: "lateness at 1 ms, real-time: simulation loop" };

/// Steps in a turn.
const TURN: u64 = 250;

/// Two rows, or four where real-time scheduling is permitted; `turns` turns each.
pub fn measure(turns: usize, mut progress: impl FnMut(&str)) -> Result<Vec<Measured>, BenchError> {
    let permitted = is_permitted()?;
    let pairs = [(SHARED, false), (REALTIME, true)];
    let mut rows = Vec::new();
    for (pair, realtime) in pairs.into_iter().filter(|(_, realtime)| permitted || !realtime) {
        progress(pair.looped);
        let [bare, looped] = in_turns(turns, realtime)?;
        rows.extend([Measured::of(pair.bare, 0, &bare), Measured::of(pair.looped, 0, &looped)]);
    }
    Ok(rows)
}

/// Whether the system permits real-time scheduling.
pub fn is_permitted() -> io::Result<bool> {
    thread(|| prefer(Urgency::Simulation).is_ok())
}

fn in_turns(turns: usize, realtime: bool) -> Result<[Histogram<u64>; 2], BenchError> {
    let plant = blocks::plant(1);
    let mut sums = [empty(), empty()];
    for _ in 0..turns {
        let engine = model::engine(&plant, Options::STEP, 0)?;
        let bare = thread(move || scheduled(realtime, sleep_through))?;
        let side = simulation(&plant, engine);
        let looped = thread(move || scheduled(realtime, || pace_through(side)))?;
        for (sum, turn) in sums.iter_mut().zip([bare, looped]) {
            sum.add(turn).expect("the same bounds");
        }
    }
    Ok(sums)
}

/// What `work` gives on a thread of its own, which is scheduled as it asks.
pub fn thread<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> io::Result<T> {
    std::thread::spawn(work).join().map_err(|_| io::Error::other("a thread that was measured died"))
}

fn scheduled<T>(realtime: bool, work: impl FnOnce() -> T) -> T {
    if realtime {
        // It was permitted a moment ago.
        let _ = prefer(Urgency::Simulation);
    }
    work()
}

fn empty() -> Histogram<u64> {
    Histogram::new_with_bounds(1, 60_000_000_000, 3).expect("bounds in order, three digits")
}

fn simulation(plant: &Plant, engine: Engine) -> Simulation {
    let (side, _io) = bank::new(&plant.signal_map);
    Simulation::new(engine, side, None, Box::new(NoJournal))
}

fn pace_through(mut simulation: Simulation) -> Histogram<u64> {
    simulation.pace(1.0, |simulation| match simulation.timing().steps >= TURN {
        true => Next::End,
        false => Next::Step,
    });
    simulation.timing().lateness_ns.clone()
}

fn sleep_through() -> Histogram<u64> {
    sharpen_sleep();
    let mut late = empty();
    let clock = WallClock::start();
    for k in 0..TURN {
        let due = Instant::ZERO + Duration::from_millis(k);
        let ahead = due.since(clock.now());
        if !ahead.is_zero() {
            std::thread::sleep(ahead);
        }
        late.saturating_record(clock.now().since(due).as_nanos() as u64);
    }
    late
}
