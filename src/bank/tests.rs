//! The bank against a model of it: plain collections, one thread. Then two threads, to see it at its real work.

use std::collections::VecDeque;

use proptest::prelude::*;

use super::sides::{Changes, Full, Overrun, with_capacity};
use super::words::{decode, encode};
use super::*;
use crate::signal_map::{Direction, Kind, RateClass, RegisterId, Signal, SignalMap};
use crate::time::Instant;
use crate::value::{ElementaryType, SignalType, Unit, Value};

fn signal(name: &str, ty: &str, direction: Direction, kind: Kind, rate: RateClass) -> Signal {
    Signal {
        name: name.to_owned(),
        ty: ty.parse().expect("a type"),
        direction,
        kind,
        rate,
        unit: Unit::ONE,
        min: None,
        max: None,
        instance: String::new(),
        task: String::new(),
        property: String::new(),
    }
}

/// Commands 0 and 1, edge reports 2, 3 and 4, level reports 5 (fast), 6 (slow) and 7 (slow).
fn map() -> SignalMap {
    use {Direction::*, Kind::*, RateClass::*};
    let signals = vec![
        signal("go", "BOOL", Command, Edge, HighFrequency),
        signal("speed", "REAL", Command, Level, HighFrequency),
        signal("barrier", "BOOL", Report, Edge, HighFrequency),
        signal("state", "DINT", Report, Edge, LowFrequency),
        signal("label", "STRING", Report, Edge, LowFrequency),
        signal("actual", "REAL", Report, Level, HighFrequency),
        signal("count", "UDINT", Report, Level, LowFrequency),
        signal("loads", "LREAL[3]", Report, Level, LowFrequency),
    ];
    SignalMap::new("test", signals).expect("names are unique")
}

const fn id(index: u32) -> RegisterId {
    RegisterId(index)
}

/// Register values in which everything follows from `n`.
fn registers(n: u32) -> Vec<Value> {
    vec![
        Value::Bool(false),
        Value::Real(0.0),
        Value::Bool(n % 2 == 1),
        Value::Dint((n / 2) as i32),
        Value::String(format!("box {}", n / 3).into_bytes().into()),
        Value::Real(n as f32),
        Value::Udint(n / 4),
        Value::Array((0..3).map(|i| Value::Lreal(f64::from(n / 5 + i))).collect()),
    ]
}

fn instant(step: u32) -> Instant {
    Instant::from_nanos(i64::from(step) * 1_000_000)
}

#[test]
fn a_flash_between_two_looks_is_seen_as_two_changes() {
    let (mut simulation, mut io) = new(&map());
    let mut state = registers(0);
    assert!(simulation.publish(instant(0), &state), "the first cycle is news");
    assert_eq!(io.all_outputs(&mut Vec::new()), Some(instant(0)));
    for (step, cut) in [(1, true), (2, false)] {
        state[2] = Value::Bool(cut);
        assert!(simulation.publish(instant(step), &state));
    }
    assert!(!simulation.publish(instant(3), &state), "nothing changed");
    let mut seen = Vec::new();
    assert_eq!(io.changed(&mut seen), Ok(Some(instant(3))));
    let flash = |step, cut| Changes { at: instant(step), values: vec![(id(2), Value::Bool(cut))] };
    assert_eq!(seen, [flash(1, true), flash(2, false)]);
}

#[test]
fn a_message_that_sets_a_signal_again_waits_and_so_do_all_after_it() {
    let (mut simulation, mut io) = new(&map());
    let go = |on| (id(0), Value::Bool(on));
    let speed = |v| (id(1), Value::Real(v));
    for message in [vec![go(true)], vec![], vec![speed(0.5), go(false)], vec![speed(1.0)], vec![go(true), go(false)]] {
        io.stage(&message).expect("room");
    }
    let mut inputs = Vec::new();
    let mut check = |last: Option<u64>, expect: &[(RegisterId, Value)]| {
        assert_eq!(simulation.take(&mut inputs), last);
        assert_eq!(inputs, expect);
    };
    check(Some(2), &[go(true)]);
    check(Some(3), &[speed(0.5), go(false)]);
    check(Some(5), &[speed(1.0), go(false)]);
    check(None, &[]);
}

#[test]
fn the_queue_holds_65_536_entries_and_not_one_more() {
    let (mut simulation, mut io) = new(&map());
    for _ in 0..CAPACITY {
        io.stage(&[(id(0), Value::Bool(true))]).expect("room");
    }
    assert_eq!(io.stage(&[(id(1), Value::Real(1.0))]), Err(Full { entries: 1 }));
    assert_eq!(simulation.take(&mut Vec::new()), Some(1), "one of them each step: they all set one signal");
    assert_eq!(io.stage(&[(id(1), Value::Real(1.0))]), Ok(CAPACITY as u64 + 1));
}

#[test]
fn an_overflow_is_told_once_with_its_loss_and_a_new_connection_starts_clean() {
    let (mut simulation, mut io) = new(&map());
    let mut state = registers(0);
    let mut now = 0;
    let mut toggle = |times: usize| {
        for _ in 0..times {
            now += 1;
            state[2] = Value::Bool(now % 2 == 1);
            simulation.publish(instant(now), &state);
        }
    };
    toggle(1);
    io.all_outputs(&mut Vec::new());
    toggle(CAPACITY + 10);
    let mut seen = Vec::new();
    assert_eq!(io.changed(&mut seen), Err(Overrun { lost: 10 }));
    assert_eq!(seen.len(), CAPACITY, "those before the hole are all there");
    assert_eq!(io.changed(&mut seen), Ok(Some(instant(CAPACITY as u32 + 11))), "told once");
    assert!(seen.is_empty());
    // Nobody listened: what overflowed then is owed to nobody.
    toggle(CAPACITY + 10);
    let mut all = Vec::new();
    io.all_outputs(&mut all);
    assert_eq!(all.len(), 6);
    toggle(1);
    assert!(io.changed(&mut seen).is_ok());
    assert_eq!(seen.len(), 1);
}

fn any_value(element: ElementaryType) -> BoxedStrategy<Value> {
    match element {
        ElementaryType::String => {
            prop::collection::vec(any::<u8>(), 0..=254).prop_map(|v| Value::String(v.into())).boxed()
        }
        ElementaryType::Wstring => {
            prop::collection::vec(any::<u16>(), 0..=254).prop_map(|v| Value::Wstring(v.into())).boxed()
        }
        ElementaryType::Lreal => any::<f64>().prop_map(Value::Lreal).boxed(),
        ElementaryType::Lint => any::<i64>().prop_map(Value::Lint).boxed(),
        ElementaryType::Ulint => any::<u64>().prop_map(Value::Ulint).boxed(),
        ElementaryType::Lword => any::<u64>().prop_map(Value::Lword).boxed(),
        ElementaryType::Time => any::<i64>().prop_map(Value::Time).boxed(),
        _ => any::<f32>().prop_map(move |number| Value::from_f64(element, f64::from(number))).boxed(),
    }
}

proptest! {
    #[test]
    fn a_value_reads_back_from_its_words(
        (ty, value, old) in (0..18usize, prop::option::of(1..4u16)).prop_flat_map(|(element, length)| {
            let element = ElementaryType::ALL[element];
            let one = move || match length {
                None => any_value(element),
                Some(n) => prop::collection::vec(any_value(element), usize::from(n))
                    .prop_map(|values| Value::Array(values.into())).boxed(),
            };
            (Just(SignalType { element, length }), one(), one())
        })
    ) {
        let mut words = vec![0; 3 * 65];
        encode(ty, &old, &mut words);
        let changed = encode(ty, &value, &mut words);
        let read = decode(ty, |i| words[i]);
        prop_assert_eq!(&read, &value);
        prop_assert_eq!(changed, old != value || format!("{old:?}") != format!("{value:?}"));
        prop_assert!(!encode(ty, &value, &mut words), "written twice, changed once");
    }

    #[test]
    fn the_bank_does_what_its_model_does(operations in prop::collection::vec(operation(), 1..200)) {
        let mut pair = Pair::new();
        for operation in operations {
            pair.run(&operation);
        }
    }
}

#[derive(Clone, Debug)]
enum Operation {
    Stage(Vec<(bool, u8)>),
    Take,
    /// Publish what follows from a number this much higher.
    Publish(u32),
    Changed,
    Levels(RateClass),
    AllOutputs,
}

fn operation() -> impl Strategy<Value = Operation> {
    prop_oneof![
        3 => prop::collection::vec(any::<(bool, u8)>(), 0..4).prop_map(Operation::Stage),
        2 => Just(Operation::Take),
        6 => (0..4u32).prop_map(Operation::Publish),
        2 => Just(Operation::Changed),
        1 => Just(Operation::Levels(RateClass::HighFrequency)),
        1 => Just(Operation::Levels(RateClass::LowFrequency)),
        1 => Just(Operation::AllOutputs),
    ]
}

/// How much the model's bank holds.
const SMALL: usize = 12;

/// A bank, and what it should hold.
struct Pair {
    map: SignalMap,
    simulation: SimulationSide,
    io: IoSide,
    queue: VecDeque<(u64, Vec<(RegisterId, Value)>)>,
    staged: u64,
    step: u32,
    n: u32,
    /// As published last.
    image: Option<Vec<Value>>,
    log: VecDeque<Changes>,
    /// Lost behind the log's last group.
    hole: u64,
    in_hand: Option<(Instant, Vec<Value>)>,
    sent: Vec<Value>,
}

impl Pair {
    fn new() -> Pair {
        let map = map();
        let (simulation, io) = with_capacity(&map, SMALL, 1 << 16);
        let sent = map.signals().iter().map(|signal| signal.ty.initial()).collect();
        Pair {
            map,
            simulation,
            io,
            queue: VecDeque::new(),
            staged: 0,
            step: 0,
            n: 0,
            image: None,
            log: VecDeque::new(),
            hole: 0,
            in_hand: None,
            sent,
        }
    }

    fn run(&mut self, operation: &Operation) {
        match operation {
            Operation::Stage(message) => self.stage(message),
            Operation::Take => self.take(),
            Operation::Publish(more) => self.publish(*more),
            Operation::Changed => self.changed(),
            Operation::Levels(rate) => self.levels(*rate),
            Operation::AllOutputs => self.all_outputs(),
        }
    }

    fn stage(&mut self, message: &[(bool, u8)]) {
        let value = |(go, number): &(bool, u8)| match go {
            true => (id(0), Value::Bool(number % 2 == 1)),
            false => (id(1), Value::Real(f32::from(*number))),
        };
        let message: Vec<_> = message.iter().map(value).collect();
        let entries: usize = self.queue.iter().map(|(_, message)| message.len()).sum();
        match self.io.stage(&message) {
            Ok(number) => {
                self.staged += 1;
                assert_eq!(number, self.staged);
                self.queue.push_back((number, message));
                assert!(entries <= SMALL);
            }
            // Empty messages fill words, not entries.
            Err(full) => assert!(entries + full.entries > SMALL || self.queue.len() > SMALL),
        }
    }

    fn take(&mut self) {
        let mut inputs = Vec::new();
        let last = self.simulation.take(&mut inputs);
        let (mut expect_last, mut expect): (_, Vec<(RegisterId, Value)>) = (None, Vec::new());
        while let Some((number, message)) = self.queue.front() {
            if message.iter().any(|(id, _)| expect.iter().any(|(set, _)| set == id)) {
                break;
            }
            let mut own: Vec<(RegisterId, Value)> = Vec::new();
            for (id, value) in message {
                match own.iter_mut().find(|(set, _)| set == id) {
                    Some(place) => place.1 = value.clone(),
                    None => own.push((*id, value.clone())),
                }
            }
            expect.extend(own);
            expect_last = Some(*number);
            self.queue.pop_front();
        }
        assert_eq!((last, inputs), (expect_last, expect));
    }

    fn publish(&mut self, more: u32) {
        self.step += 1;
        self.n += more;
        let now = registers(self.n);
        // The one looks at all registers, the other at those that it is told of; nobody can tell which was called.
        let news = match &self.image {
            Some(old) if !self.step.is_multiple_of(3) => {
                let all = (0..now.len() as u32).map(id);
                let changed: Vec<_> = all.filter(|id| old[id.index()] != now[id.index()]).collect();
                self.simulation.publish_changed(instant(self.step), &now, &changed)
            }
            _ => self.simulation.publish(instant(self.step), &now),
        };
        let changes: Vec<_> = match &self.image {
            None => Vec::new(),
            Some(old) => (2..5u32)
                .filter(|i| old[*i as usize] != now[*i as usize])
                .map(|i| (id(i), now[i as usize].clone()))
                .collect(),
        };
        assert_eq!(news, !changes.is_empty() || self.image.is_none());
        if !changes.is_empty() {
            let entries: usize = self.log.iter().map(|group| group.values.len()).sum();
            // Once there is a hole, all behind it is lost, whether the log found room for it or not.
            if self.hole > 0 || entries + changes.len() > SMALL {
                self.hole += changes.len() as u64;
            } else {
                self.log.push_back(Changes { at: instant(self.step), values: changes });
            }
        }
        self.image = Some(now);
    }

    fn look(&mut self) {
        self.in_hand = self.image.clone().map(|image| (instant(self.step), image));
    }

    fn changed(&mut self) {
        self.look();
        let mut groups = Vec::new();
        let result = self.io.changed(&mut groups);
        match std::mem::take(&mut self.hole) {
            0 => assert_eq!(result, Ok(self.in_hand.as_ref().map(|(at, _)| *at))),
            lost => assert_eq!(result, Err(Overrun { lost })),
        }
        assert_eq!(groups, Vec::from(std::mem::take(&mut self.log)));
        self.check_snapshot();
    }

    fn check_snapshot(&self) {
        let seen = self.io.snapshot().map(|snapshot| {
            let values: Vec<_> = snapshot.iter().map(|(_, value)| value).collect();
            assert_eq!(snapshot.value(id(0)), None, "a command is no report");
            assert_eq!(snapshot.value(id(7)).as_ref(), values.last());
            (snapshot.at(), values)
        });
        assert_eq!(seen, self.in_hand.clone().map(|(at, values)| (at, values[2..].to_vec())));
    }

    fn levels(&mut self, rate: RateClass) {
        let mut out = Vec::new();
        let at = self.io.levels(rate, &mut out);
        let mut expect = Vec::new();
        if let Some((_, values)) = &self.in_hand {
            for (register, signal) in self.map.directed(Direction::Report) {
                let (sent, value) = (&mut self.sent[register.index()], &values[register.index()]);
                if signal.kind == Kind::Level && signal.rate == rate && sent != value {
                    sent.clone_from(value);
                    expect.push((register, value.clone()));
                }
            }
        }
        assert_eq!((at, out), (self.in_hand.as_ref().map(|(at, _)| *at), expect));
    }

    fn all_outputs(&mut self) {
        self.look();
        (self.hole, self.log) = (0, VecDeque::new());
        let mut out = Vec::new();
        let at = self.io.all_outputs(&mut out);
        if let Some((_, values)) = &self.in_hand {
            self.sent = values.clone();
        }
        let expect = self.in_hand.iter().flat_map(|(_, values)| (2..8).map(|i| (id(i), values[i as usize].clone())));
        assert_eq!(out, expect.collect::<Vec<_>>());
        assert_eq!(at, self.in_hand.as_ref().map(|(at, _)| *at));
        self.check_snapshot();
    }
}

#[test]
fn two_threads_lose_nothing_and_see_whole_cycles() {
    // Fewer edges than the log holds: however the threads are scheduled, it cannot overflow.
    const STEPS: u32 = 30_000;
    let (mut simulation, mut io) = new(&map());
    simulation.publish(instant(0), &registers(0));
    let worker = std::thread::spawn(move || {
        let (mut inputs, mut taken) = (Vec::new(), Vec::new());
        for step in 1..=STEPS {
            simulation.take(&mut inputs);
            taken.extend(inputs.drain(..).map(|(_, value)| value.to_f64().expect("a number")));
            simulation.publish(instant(step), &registers(step));
        }
        while simulation.take(&mut inputs).is_some() {
            taken.extend(inputs.drain(..).map(|(_, value)| value.to_f64().expect("a number")));
        }
        taken
    });
    io.all_outputs(&mut Vec::new());
    let first = io.snapshot().expect("a cycle").at();
    let (mut groups, mut barrier, mut staged) = (Vec::new(), Vec::new(), 0u32);
    let mut last = first;
    while last < instant(STEPS) {
        if staged < 20_000 && io.stage(&[(id(1), Value::Real(staged as f32))]).is_ok() {
            staged += 1;
        }
        last = io.changed(&mut groups).expect("the log is read fast enough").expect("a cycle");
        for group in &groups {
            assert!(group.at <= last, "no edge is newer than the cycle");
            barrier.extend(group.values.iter().filter(|(register, _)| *register == id(2)).map(|_| group.at));
        }
        let n = (last.nanos() / 1_000_000) as u32;
        let seen: Vec<_> = io.snapshot().expect("a cycle").iter().map(|(_, value)| value).collect();
        assert_eq!(seen, registers(n)[2..], "a torn cycle");
    }
    let first = (first.nanos() / 1_000_000) as u32;
    assert_eq!(barrier, (first + 1..=STEPS).map(instant).collect::<Vec<_>>(), "the barrier changed at every step");
    // What was staged after the worker's last look stays behind; all before it came through in order.
    let taken = worker.join().expect("the simulation's thread");
    assert_eq!(taken, (0..taken.len()).map(|i| i as f64).collect::<Vec<_>>());
}
