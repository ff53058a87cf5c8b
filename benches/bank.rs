//! A cycle of 1 000 registers through the bank, beside the same values behind a mutex and copied as plain memory.
//!
//!     cargo bench --bench bank
//!
//! Criterion prints the times; the last lines are the ratios of one run, which is what can be compared between machines.

use std::hint::black_box;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant as Clock};

use criterion::{Criterion, criterion_group};
use kinetwin::bank::{self, IoSide, SimulationSide};
use kinetwin::signal_map::{Direction, Kind, RateClass, RegisterId, Signal, SignalMap};
use kinetwin::time::Instant;
use kinetwin::value::{Unit, Value};

const REGISTERS: u32 = 1_000;
/// How many of the levels change from one cycle to the next.
const CHANGING: u32 = 200;

/// Half of the registers BOOL edges that never change, half REAL levels of which some do.
fn map() -> SignalMap {
    let signal = |i: u32| Signal {
        name: format!("signal {i}"),
        ty: if i.is_multiple_of(2) { "BOOL" } else { "REAL" }.parse().expect("a type"),
        direction: Direction::Report,
        kind: if i.is_multiple_of(2) { Kind::Edge } else { Kind::Level },
        rate: RateClass::HighFrequency,
        unit: Unit::ONE,
        min: None,
        max: None,
        instance: String::new(),
        task: String::new(),
        property: String::new(),
    };
    SignalMap::new("bench", (0..REGISTERS).map(signal).collect()).expect("names are unique")
}

fn values(cycle: u32) -> Vec<Value> {
    let value = |i: u32| match i % 2 {
        0 => Value::Bool(i.is_multiple_of(4)),
        _ if i < 2 * CHANGING => Value::Real((i + cycle) as f32),
        _ => Value::Real(i as f32),
    };
    (0..REGISTERS).map(value).collect()
}

/// Three ways to hand a cycle over.
struct Ways {
    simulation: SimulationSide,
    io: IoSide,
    mutex: Arc<Mutex<Vec<Value>>>,
    plain: Vec<u64>,
    changing: Vec<RegisterId>,
    cycles: [Vec<Value>; 2],
    at: usize,
}

impl Ways {
    fn new() -> Ways {
        let (mut simulation, mut io) = bank::new(&map());
        simulation.publish(Instant::ZERO, &values(0));
        io.all_outputs(&mut Vec::new());
        Ways {
            simulation,
            io,
            mutex: Arc::new(Mutex::new(values(0))),
            plain: vec![0; REGISTERS as usize],
            changing: (0..2 * CHANGING).filter(|i| i % 2 == 1).map(RegisterId).collect(),
            cycles: [values(0), values(1)],
            at: 0,
        }
    }

    fn next(&mut self) -> usize {
        self.at = 1 - self.at;
        self.at
    }

    fn bank_write(&mut self) {
        let at = self.next();
        black_box(self.simulation.publish(Instant::from_nanos(at as i64), &self.cycles[at]));
    }

    /// As the engine does it, which knows what it set.
    fn bank_write_changed(&mut self) {
        let (at, now) = (self.next(), Instant::from_nanos(self.at as i64));
        black_box(self.simulation.publish_changed(now, &self.cycles[at], &self.changing));
    }

    fn bank_read(&mut self, levels: &mut Vec<(RegisterId, Value)>) {
        levels.clear();
        black_box(self.io.changed(&mut Vec::new()).expect("no edge changes"));
        self.io.levels(RateClass::HighFrequency, levels);
        black_box(levels);
    }

    fn mutex_write(&mut self) {
        let at = self.next();
        self.mutex.lock().expect("one thread").clone_from_slice(&self.cycles[at]);
    }

    fn mutex_read(&mut self, copy: &mut [Value]) {
        copy.clone_from_slice(&self.mutex.lock().expect("one thread"));
        black_box(copy);
    }

    fn plain_write(&mut self, from: &[u64]) {
        self.plain.copy_from_slice(black_box(from));
        black_box(&self.plain);
    }
}

fn times(criterion: &mut Criterion) {
    let mut ways = Ways::new();
    let mut levels = Vec::new();
    let mut copy = values(0);
    let words = vec![1; REGISTERS as usize];
    let mut group = criterion.benchmark_group("1 000 registers");
    group.bench_function("bank: publish", |b| b.iter(|| ways.bank_write()));
    group.bench_function("bank: publish, changed and levels", |b| {
        b.iter(|| {
            ways.bank_write();
            ways.bank_read(&mut levels);
        })
    });
    group.bench_function("mutex: write", |b| b.iter(|| ways.mutex_write()));
    group.bench_function("mutex: write and read", |b| {
        b.iter(|| {
            ways.mutex_write();
            ways.mutex_read(&mut copy);
        })
    });
    group.bench_function("plain memory: copy", |b| b.iter(|| ways.plain_write(&words)));
    group.finish();
}

/// The time of one call, the least of several rounds.
fn least(mut call: impl FnMut()) -> Duration {
    const CALLS: u32 = 2_000;
    let round = |_| {
        let start = Clock::now();
        (0..CALLS).for_each(|_| call());
        start.elapsed() / CALLS
    };
    (0..20).map(round).min().unwrap_or_default()
}

fn ratios() {
    let mut ways = Ways::new();
    let (mut levels, mut copy, words) = (Vec::new(), values(0), vec![1; REGISTERS as usize]);
    let plain = least(|| ways.plain_write(&words));
    let print = |name: &str, time: Duration| {
        println!(
            "{name:<48} {:>8.3} µs  {:>6.1} x plain copy",
            time.as_secs_f64() * 1e6,
            time.as_secs_f64() / plain.as_secs_f64()
        );
    };
    println!("\none thread, {REGISTERS} registers, {CHANGING} of them changing, least of 20 rounds");
    print("plain memory: copy", plain);
    print("mutex: write", least(|| ways.mutex_write()));
    print("mutex: read", least(|| ways.mutex_read(&mut copy)));
    print("bank: publish, all looked at", least(|| ways.bank_write()));
    let write = least(|| ways.bank_write_changed());
    print("bank: publish what changed", write);
    let both = least(|| {
        ways.bank_write_changed();
        ways.bank_read(&mut levels);
    });
    print("bank: publish what changed, changed and levels", both);
    saturated();
}

/// Writes as fast as it goes while another thread reads as fast as it goes: what the worst write cost.
fn saturated() {
    println!("\ntwo threads, both saturated: the simulation's write, µs");
    let mut ways = Ways::new();
    let (mutex, cycles) = (ways.mutex.clone(), ways.cycles.clone());
    let stop = Arc::new(std::sync::atomic::AtomicBool::new(false));
    let reading = |read: Box<dyn FnMut() + Send>, stop: &Arc<std::sync::atomic::AtomicBool>| {
        let (stop, mut read) = (stop.clone(), read);
        std::thread::spawn(move || {
            while !stop.load(std::sync::atomic::Ordering::Relaxed) {
                read();
            }
        })
    };
    let report = |name: &str, mut times: Vec<Duration>| {
        times.sort();
        let at = |share: f64| times[((times.len() - 1) as f64 * share) as usize].as_secs_f64() * 1e6;
        println!(
            "{name:<10} p50 {:>8.3}  p99 {:>8.3}  p99.9 {:>8.3}  max {:>8.3}",
            at(0.5),
            at(0.99),
            at(0.999),
            at(1.0)
        );
    };
    let timed = |write: &mut dyn FnMut(usize)| -> Vec<Duration> {
        let one = |i: usize| {
            let start = Clock::now();
            write(i % 2);
            start.elapsed()
        };
        (0..200_000).map(one).collect()
    };

    let mut io = ways.io;
    let mut levels = Vec::new();
    let read = Box::new(move || {
        levels.clear();
        black_box(io.changed(&mut Vec::new()).is_ok());
        io.levels(RateClass::HighFrequency, &mut levels);
    });
    let reader = reading(read, &stop);
    let simulation = &mut ways.simulation;
    report("bank", timed(&mut |i| _ = black_box(simulation.publish(Instant::from_nanos(i as i64), &cycles[i]))));
    stop.store(true, std::sync::atomic::Ordering::Relaxed);
    reader.join().expect("the reader ends");

    stop.store(false, std::sync::atomic::Ordering::Relaxed);
    let (shared, mut copy) = (mutex.clone(), values(0));
    let read = Box::new(move || copy.clone_from_slice(&shared.lock().expect("no panic inside")));
    let reader = reading(read, &stop);
    report("mutex", timed(&mut |i| mutex.lock().expect("no panic inside").clone_from_slice(&cycles[i])));
    stop.store(true, std::sync::atomic::Ordering::Relaxed);
    reader.join().expect("the reader ends");
}

criterion_group!(benches, times);

fn main() {
    benches();
    ratios();
}
