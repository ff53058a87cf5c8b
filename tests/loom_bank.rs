//! The register bank under loom: its own files, compiled against loom's atomics, and every interleaving of small models
//! that the memory model allows, with up to four preemptions.
//!
//!     cargo nextest run --test loom_bank
//!
//! No `--cfg loom` is needed, and none would do: it takes `tokio::net` away from the crates that the rest builds on.
//! Each `Acquire` and each `Release` of the bank was weakened in turn: at least two of these tests failed each time.

use kinetwin::{signal_map, time, value};

#[allow(dead_code)]
#[path = "../src/bank"]
mod bank {
    mod sync {
        pub(super) use loom::sync::Arc;
        pub(super) use loom::sync::atomic::{AtomicU64, Ordering};

        /// Where the bank has a `Relaxed` atomic, plain memory that loom watches: two accesses, one of them a write, that
        /// nothing orders end the model. (With an atomic, loom would miss a load that a later store may overtake.)
        pub(super) struct Cell(loom::cell::UnsafeCell<u64>);

        // Safety: loom runs one thread at a time, and ends the model at the first unordered access.
        unsafe impl Sync for Cell {}

        impl Cell {
            pub(super) fn new() -> Cell {
                Cell(loom::cell::UnsafeCell::new(0))
            }

            pub(super) fn read(&self) -> u64 {
                // Safety: as above.
                self.0.with(|word| unsafe { *word })
            }

            pub(super) fn write(&self, word: u64) {
                // Safety: as above.
                self.0.with_mut(|place| unsafe { *place = word });
            }
        }
    }
    mod ring;
    pub mod sides;
    mod triple;
    mod words;
}

use bank::sides::{Changes, IoSide, Overrun, SimulationSide, with_capacity};
use signal_map::{Direction, Kind, RateClass, RegisterId, Signal, SignalMap};
use time::Instant;
use value::{Unit, Value};

const COMMAND: RegisterId = RegisterId(0);
const OTHER_COMMAND: RegisterId = RegisterId(1);
const EDGE: RegisterId = RegisterId(2);
const LEVEL: RegisterId = RegisterId(3);

fn signal(name: &str, ty: &str, direction: Direction, kind: Kind) -> Signal {
    Signal {
        name: name.to_owned(),
        ty: ty.parse().expect("a type"),
        direction,
        kind,
        rate: RateClass::HighFrequency,
        unit: Unit::ONE,
        min: None,
        max: None,
        instance: String::new(),
        task: String::new(),
        property: String::new(),
    }
}

/// Two commands, an edge and a level; a queue and a log of `capacity` entries.
fn small_bank(capacity: usize) -> (SimulationSide, IoSide) {
    let signals = vec![
        signal("command", "DINT", Direction::Command, Kind::Edge),
        signal("other command", "DINT", Direction::Command, Kind::Edge),
        signal("edge", "DINT", Direction::Report, Kind::Edge),
        signal("level", "DINT", Direction::Report, Kind::Level),
    ];
    with_capacity(&SignalMap::new("small", signals).expect("names are unique"), capacity, 64)
}

/// Every register holds `n`.
fn publish(simulation: &mut SimulationSide, n: i32) {
    let registers = [0, 0, n, n].map(Value::Dint);
    let (now, changed) = (Instant::from_nanos(n.into()), [EDGE, LEVEL]);
    match n % 2 {
        0 => simulation.publish_changed(now, &registers, &changed),
        _ => simulation.publish(now, &registers),
    };
}

fn group(n: i32) -> Changes {
    Changes { at: Instant::from_nanos(n.into()), values: vec![(EDGE, Value::Dint(n))] }
}

fn check(model: impl Fn() + Send + Sync + 'static) {
    let mut builder = loom::model::Builder::new();
    builder.preemption_bound = Some(4);
    builder.max_branches = 10_000;
    builder.check(model);
}

/// The number that every register of the cycle in hand holds.
fn whole_cycle(io: &IoSide) -> Option<i64> {
    let cycle = io.snapshot()?;
    let n = cycle.at().nanos();
    let all = Value::Dint(n as i32);
    assert_eq!(cycle.iter().collect::<Vec<_>>(), [(EDGE, all.clone()), (LEVEL, all)], "a torn cycle");
    Some(n)
}

#[test]
fn a_cycle_is_seen_whole_and_never_an_older_one_after_a_newer() {
    check(|| {
        let (mut simulation, mut io) = small_bank(8);
        let worker = loom::thread::spawn(move || (1..=3).for_each(|n| publish(&mut simulation, n)));
        let mut last = None;
        for _ in 0..2 {
            io.changed(&mut Vec::new()).expect("the log has room for all");
            let seen = whole_cycle(&io);
            assert!(seen >= last);
            last = seen;
        }
        worker.join().expect("the simulation's thread");
        io.changed(&mut Vec::new()).expect("the log has room for all");
        assert_eq!(whole_cycle(&io), Some(3), "the newest is there to see");
    });
}

#[test]
fn after_all_outputs_every_edge_follows_once_and_in_order() {
    check(|| {
        let (mut simulation, mut io) = small_bank(8);
        publish(&mut simulation, 1);
        let worker = loom::thread::spawn(move || (2..=4).for_each(|n| publish(&mut simulation, n)));
        let mut all = Vec::new();
        let first = io.all_outputs(&mut all).expect("a cycle was published").nanos() as i32;
        assert_eq!(all, [(EDGE, Value::Dint(first)), (LEVEL, Value::Dint(first))]);
        let mut seen = Vec::new();
        let mut groups = Vec::new();
        let cycle = io.changed(&mut groups).expect("the log has room for all").expect("a cycle");
        assert!(groups.iter().all(|group| group.at <= cycle), "an edge of a later cycle than that in hand");
        seen.append(&mut groups);
        let mut levels = Vec::new();
        io.levels(RateClass::HighFrequency, &mut levels);
        assert_eq!(levels.is_empty(), cycle.nanos() == i64::from(first), "a level is given when it changed");
        worker.join().expect("the simulation's thread");
        io.changed(&mut groups).expect("the log has room for all");
        seen.append(&mut groups);
        assert_eq!(seen, (first + 1..=4).map(group).collect::<Vec<_>>());
    });
}

#[test]
fn what_overflows_the_log_is_counted_and_nothing_else_is() {
    check(|| {
        let (mut simulation, mut io) = small_bank(1);
        publish(&mut simulation, 0);
        io.all_outputs(&mut Vec::new());
        let worker = loom::thread::spawn(move || (1..=3).for_each(|n| publish(&mut simulation, n)));
        let (mut seen, mut lost, mut groups) = (Vec::new(), 0, Vec::new());
        let mut look = |io: &mut IoSide| {
            let result = io.changed(&mut groups);
            seen.append(&mut groups);
            if let Err(Overrun { lost: more }) = result {
                assert!(more > 0);
                lost += more;
            }
        };
        look(&mut io);
        look(&mut io);
        worker.join().expect("the simulation's thread");
        look(&mut io);
        look(&mut io);
        assert_eq!(seen.len() as u64 + lost, 3);
        let order: Vec<_> = seen.iter().map(|group| group.at).collect();
        assert!(order.is_sorted(), "{order:?}");
        assert!(seen.iter().all(|seen| *seen == group(seen.at.nanos() as i32)), "{seen:?}");
    });
}

#[test]
fn messages_are_taken_whole_and_in_order() {
    check(|| {
        let (mut simulation, mut io) = small_bank(8);
        let worker = loom::thread::spawn(move || {
            for n in 1..=2 {
                let message = [(COMMAND, Value::Dint(n)), (OTHER_COMMAND, Value::Dint(n))];
                assert_eq!(io.stage(&message), Ok(n as u64));
            }
            assert_eq!(io.stage(&[(OTHER_COMMAND, Value::Dint(3))]), Ok(3));
        });
        let mut inputs = Vec::new();
        let mut taken = 0;
        let mut take = |simulation: &mut SimulationSide| {
            if let Some(number) = simulation.take(&mut inputs) {
                taken += 1;
                assert_eq!(number, taken, "each sets what the one before set: one a step");
                let n = Value::Dint(number as i32);
                let expect = [(COMMAND, n.clone()), (OTHER_COMMAND, n)];
                assert_eq!(inputs, expect[if number < 3 { 0 } else { 1 }..], "a torn message");
            }
        };
        take(&mut simulation);
        take(&mut simulation);
        worker.join().expect("the IO thread");
        (0..3).for_each(|_| take(&mut simulation));
        assert_eq!(taken, 3);
    });
}

#[test]
fn a_full_queue_refuses_and_overwrites_nothing() {
    check(|| {
        let (mut simulation, mut io) = small_bank(1);
        let worker = loom::thread::spawn(move || {
            let stage = |n| io.stage(&[(COMMAND, Value::Dint(n))]).is_ok().then_some(n);
            (1..=3).filter_map(stage).collect::<Vec<_>>()
        });
        let (mut inputs, mut taken) = (Vec::new(), Vec::new());
        for _ in 0..2 {
            simulation.take(&mut inputs);
            taken.append(&mut inputs);
        }
        let staged = worker.join().expect("the IO thread");
        simulation.take(&mut inputs);
        taken.append(&mut inputs);
        let expect: Vec<_> = staged.into_iter().map(|n| (COMMAND, Value::Dint(n))).collect();
        assert_eq!(taken, expect);
    });
}
