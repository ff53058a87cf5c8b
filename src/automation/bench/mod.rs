//! The test bench of blocks and programs: plain signals under a virtual clock.

pub mod world;

use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Duration;

use crate::automation::image::{Binder, Image};
use crate::automation::network::{Block, Context, Counts, Program, Verbatim};
use crate::automation::program::map_of;
use crate::signal_map::{Direction, Kind, RateClass, RegisterId, Signal, SignalMap};
use crate::time::Instant;
use crate::value::{Unit, Value};

/// The signals of one device of the line by the first letters of its name, without their direction.
const LINE: &[(&str, &[&str], &[&str])] = &[
    (
        "C",
        &["velocityTarget REAL m/s", "motorDirection DINT"],
        &[
            "velocityActual REAL m/s",
            "driveEnabled BOOL",
            "driveRunning BOOL",
            "directionalActual DINT",
            "lightBarrierA BOOL",
            "lightBarrierB BOOL",
        ],
    ),
    (
        "P",
        &["command DINT"],
        &["limitExtended BOOL", "limitRetracted BOOL", "isRunning BOOL", "lightbarrierA BOOL", "lightbarrierB BOOL"],
    ),
    (
        "R",
        &["XTarget REAL mm", "YTarget REAL mm", "ZTarget REAL mm", "RTarget REAL rad", "grip BOOL"],
        &[
            "cartesianArrived BOOL",
            "actualPosX REAL mm",
            "actualPosY REAL mm",
            "actualPosZ REAL mm",
            "actualPosR REAL rad",
        ],
    ),
    ("G", &["suctionOn BOOL", "blowOn BOOL"], &["vacuumOn BOOL"]),
];

/// The de-palletization line's map.
pub fn line() -> Arc<SignalMap> {
    let numbered = |name: &str, last: usize| (1..=last).map(|n| format!("{name}{n}")).collect::<Vec<_>>();
    let mut instances = [numbered("Conveyor", 10), numbered("Curve", 2), numbered("Pusher", 3)].concat();
    instances.push("Robot".to_owned());
    instances.extend(numbered("Gripper", 2));
    let mut signals = Vec::new();
    for instance in &instances {
        let (_, commands, reports) = LINE.iter().find(|(first, ..)| instance.starts_with(first)).expect("a device");
        signals.extend(commands.iter().map(|text| (format!("{instance}.{text}"), Direction::Command)));
        signals.extend(reports.iter().map(|text| (format!("{instance}.{text}"), Direction::Report)));
    }
    let signals: Vec<_> = signals.iter().map(|(text, direction)| (text.as_str(), *direction)).collect();
    Arc::new(map(&signals))
}

/// A map of the signals written as `instance.property TYPE [unit]`.
pub fn map(signals: &[(&str, Direction)]) -> SignalMap {
    let signal = |&(text, direction): &(&str, Direction)| {
        let mut words = text.split(' ');
        let name = words.next().expect("a name");
        let ty = words.next().expect("a type").parse().expect("a type");
        let unit = words.next().map_or(Unit::ONE, |unit| Unit::named(unit).expect("a unit"));
        let (instance, property) = name.split_once('.').expect("instance.property");
        Signal {
            name: name.to_owned(),
            ty,
            direction,
            kind: if ty.element.is_real() { Kind::Level } else { Kind::Edge },
            rate: RateClass::HighFrequency,
            unit,
            min: None,
            max: None,
            instance: instance.to_owned(),
            task: "task".to_owned(),
            property: property.to_owned(),
        }
    };
    SignalMap::new("rig", signals.iter().map(signal).collect()).expect("names are unique")
}

/// The rig's map.
pub fn rig() -> Arc<SignalMap> {
    map_of("rig").expect("its map is carried")
}

/// Values by name, as a test writes them.
pub fn values(map: &SignalMap, values: &[(&str, f64)]) -> Vec<(RegisterId, Value)> {
    values
        .iter()
        .map(|&(name, number)| {
            let register = map.register(name).unwrap_or_else(|| panic!("no signal {name}"));
            (register, Value::from_f64(map.signal(register).ty.element, number))
        })
        .collect()
}

/// Values as a test reads them.
pub fn spell(map: &SignalMap, values: &[(RegisterId, Value)]) -> Vec<String> {
    values.iter().map(|(register, value)| format!("{}={value}", map.signal(*register).name)).collect()
}

/// A program with its process image, under a virtual clock.
pub struct Pilot<P> {
    bench: Bench,
    program: P,
}

impl<P: Program> Pilot<P> {
    /// A program bound by `bind` to the signals of `map`, started.
    pub fn new(map: Arc<SignalMap>, bind: impl FnOnce(&mut Binder<'_>) -> P) -> Pilot<P> {
        let mut binder = Binder::new(&map);
        let program = bind(&mut binder);
        let program = binder.finish(program).expect("the plant has all its signals");
        let image = Image::new(map);
        let bench = Bench { now: Instant::ZERO, image, wakes: BTreeSet::new(), verbatim: Vec::new() };
        let mut pilot = Pilot { bench, program };
        pilot.bench.event(|cx| pilot.program.start(cx));
        pilot
    }

    /// The plant reports; gives the commands that changed by it as `name=value`.
    pub fn report(&mut self, reports: &[(&str, f64)]) -> Vec<String> {
        let reports = values(self.bench.image.map(), reports);
        self.bench.image.take(&reports);
        self.bench.event(|cx| self.program.event(cx))
    }

    /// Time passes; gives the commands that changed on the way.
    pub fn advance(&mut self, span: Duration) -> Vec<String> {
        let end = self.bench.now + span;
        let mut changed = Vec::new();
        while let Some(due) = self.bench.wakes.first().copied().filter(|due| *due <= end) {
            self.bench.now = due;
            self.bench.wakes.pop_first();
            changed.extend(self.bench.event(|cx| self.program.event(cx)));
        }
        self.bench.now = end;
        changed
    }

    /// What the program has counted.
    pub fn counts(&self) -> Counts {
        self.program.counts()
    }
}

/// A process image and a clock, with a block under test beside it.
pub struct Bench {
    pub now: Instant,
    pub image: Image,
    pub wakes: BTreeSet<Instant>,
    pub verbatim: Vec<Verbatim>,
}

impl Bench {
    /// A bench of the rig's signals, and what `bind` binds to them.
    pub fn with<B>(bind: impl FnOnce(&mut Binder<'_>) -> B) -> (Bench, B) {
        let map = rig();
        let mut binder = Binder::new(&map);
        let bound = bind(&mut binder);
        let bound = binder.finish(bound).expect("the rig has all its signals");
        let image = Image::new(map.clone());
        (Bench { now: Instant::ZERO, image, wakes: BTreeSet::new(), verbatim: Vec::new() }, bound)
    }

    /// Runs one event, and gives the commands that changed by it as `name=value`.
    pub fn event(&mut self, event: impl FnOnce(&mut Context<'_>)) -> Vec<String> {
        event(&mut Context::new(self.now, &mut self.image, &mut self.wakes, &mut self.verbatim));
        let changed = self.image.take_changed();
        spell(self.image.map(), &changed)
    }

    /// Hands reports to a block.
    pub fn report(&mut self, reports: &[(&str, f64)], block: &mut dyn Block) -> Vec<String> {
        let reports = values(self.image.map(), reports);
        self.image.take(&reports);
        self.event(|cx| block.update(cx))
    }
}
