//! The line of `models/depalletizer`, sorting loose boxes.
//!
//! All belts, curves, pushers and exits with the boxes that they hand on, and the robot's ways without boxes. Its pallet lane rests with
//! the pallet that stands there at first, and its grippers take nothing up.

mod controller;
mod devices;
mod floor;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use crate::belt::BeltParameters;
use crate::chance::Dice;
use crate::drawn::{Figures, Unit, fitted, measures};
use crate::gripper::GripperParameters;
use crate::machine::Machine;
use crate::plant::{Command, Device, Kind, Plant};
use crate::pusher::{Pusher, PusherParameters};
use crate::quirk::{Quirk, Quirks};
use crate::robot::RobotParameters;
use crate::script::Part;
use crate::sensor::Along;
use devices::{LineBelt, LinePusher, Parts, Shared};
use floor::{Bed, Floor, Plate, quarter};

/// The belts: name, length, acceleration, barriers A and B; a length of 0 is that of a curve.
const BELTS: [(&str, f64, f64, f64, f64); 12] = [
    ("Conveyor1", 3.2, 0.6, 1.4, 3.0),
    ("Conveyor2", 1.6, 0.6, 1.15, 1.387),
    ("Conveyor3", 6.0, 1.0, 3.0, 5.85),
    ("Conveyor4", 2.4, 1.0, 0.25, 1.65),
    ("Curve1", 0.0, 1.0, 0.2, 1.05),
    ("Conveyor5", 3.0, 1.0, 0.3, 1.8),
    ("Conveyor6", 3.0, 1.0, 0.3, 1.8),
    ("Curve2", 0.0, 1.0, 0.2, 1.05),
    ("Conveyor7", 4.0, 1.0, 0.3, 1.6),
    ("Conveyor8", 2.4, 2.0, 0.4, 2.0),
    ("Conveyor9", 2.4, 2.0, 0.4, 2.0),
    ("Conveyor10", 2.4, 2.0, 0.4, 2.0),
];
/// The centre line of both curves, m.
const RADIUS: f64 = 0.8;
/// The belts that hand boxes on, each to the next, by their places above.
const HANDS_ON: std::ops::Range<usize> = 2..8;
/// Those of the box line, which run at one speed.
pub const FLOW: [&str; 6] = ["Conveyor4", "Curve1", "Conveyor5", "Conveyor6", "Curve2", "Conveyor7"];
/// Each pusher, the belt that it clears, and the exit that it pushes to.
pub const EXITS: [(&str, &str, &str); 3] = [
    ("Pusher1", "Conveyor5", "Conveyor8"),
    ("Pusher2", "Conveyor6", "Conveyor9"),
    ("Pusher3", "Conveyor7", "Conveyor10"),
];
/// Of each plate: its belt, its middle along it, its exit, and how much further the belt is there than the exit.
const PLATES: [(usize, f64, usize, f64); 3] = [(5, 1.8, 9, 0.6), (6, 1.8, 10, 0.6), (8, 1.6, 11, 0.4)];
/// What lies there at first: loose boxes, by belt and place.
const AT_FIRST: [(usize, f64); 9] =
    [(2, 5.3), (2, 3.9), (2, 2.5), (5, 0.5), (6, 0.5), (8, 2.6), (9, 1.2), (10, 1.2), (11, 1.2)];
/// Half a loose box, and half a pallet, m.
const HALF_BOX: f64 = 0.15;
const HALF_PALLET: f64 = 0.6;

/// The line as it is designed, or as one was built.
#[derive(Clone, Debug)]
pub struct Line {
    units: Vec<Unit>,
    /// Half the boxes of each station, and of those that lie there at first.
    halves: [f64; 9],
    /// For each of the rig's devices the one that stands for it.
    hosts: BTreeMap<&'static str, String>,
}

impl Line {
    /// As its model has it; which of its belts and pushers stand for the rig's is drawn.
    pub fn designed(dice: &mut Dice) -> Line {
        let mut units: Vec<Unit> = BELTS.iter().map(belt).collect();
        let pusher = || {
            let parameters =
                PusherParameters { stroke: 0.75, extend_speed: 2.0, retract_speed: 2.0, limit_tolerance: 0.002 };
            Figures::Pusher(parameters)
        };
        units.extend(EXITS.map(|(name, ..)| Unit { name: name.to_owned(), figures: pusher() }));
        let robot =
            RobotParameters { fastest: [2.0, 2.0, 1.5, 3.0], steepest: [4.0, 4.0, 5.0, 12.0], tolerance: [5e-4; 4] };
        let robot = Figures::Robot { parameters: robot, reach: [0.4, 0.6, 0.3, 0.8] };
        units.push(Unit { name: "Robot".to_owned(), figures: robot });
        let gripper = || Figures::Gripper(GripperParameters { build_up: 0.15, release: 0.08 });
        units.extend(["Gripper1", "Gripper2"].map(|name| Unit { name: name.to_owned(), figures: gripper() }));
        // The pallet lane rests.
        let belt = BELTS[2 + dice.below(BELTS.len() - 2)].0;
        let hosts = [("Belt", belt), ("Pusher", EXITS[dice.below(EXITS.len())].0), ("Robot", "Robot")];
        let hosts = hosts.map(|(kind, name)| (kind, name.to_owned())).into();
        Line { units, halves: [HALF_BOX; 9], hosts }
    }

    /// As one is built: every measure anywhere within its `tolerance`, a share of itself.
    pub fn built(&self, tolerance: f64, dice: &mut Dice) -> Line {
        let mut built = self.clone();
        let measures = built.units.iter_mut().flat_map(|unit| unit.figures.measures());
        for measure in measures.chain(&mut built.halves) {
            *measure *= 1.0 + dice.between(-tolerance, tolerance);
        }
        built
    }

    fn floor(&self, quirks: &[Quirk], seed: u64) -> Floor {
        let belts = self.units.iter().zip(BELTS).enumerate();
        let beds = belts.filter_map(|(at, (unit, (_, length, ..)))| match &unit.figures {
            Figures::Belt { parameters, .. } => Some(bed(at, &unit.name, length, parameters, quirks)),
            _ => None,
        });
        let plate = |(belt, middle, exit, ahead)| Plate { belt, middle, exit, ahead, out: 0.0, cut: [false; 2] };
        let mut floor = Floor::new(beds.collect(), PLATES.map(plate).into(), seed);
        for (belt, at) in AT_FIRST {
            floor.put(belt, at, self.halves[8]);
        }
        // The pallet was stopped when barrier B saw it.
        let past = floor.beds[1].barriers[1] + 0.005 - (0.8 + HALF_PALLET);
        floor.put(1, 0.8 + past.max(0.0), HALF_PALLET);
        for (station, half) in self.halves[..8].iter().enumerate() {
            let k = station as f64;
            floor.feed(2, 0.4 + 0.7 * k, *half, [2.0 + 2.5 * k, 20.0, 10.0]);
        }
        floor.settle();
        floor
    }

    fn device(&self, at: usize, quirks: &[Quirk], shared: &Shared) -> Box<dyn Device> {
        let unit = &self.units[at];
        match &unit.figures {
            Figures::Belt { parameters, .. } => {
                Box::new(LineBelt::new(parameters, Quirks::of(quirks, &unit.name), at, shared.clone()))
            }
            Figures::Pusher(parameters) => {
                let pusher = Pusher::new(parameters, quirks, &unit.name);
                Box::new(LinePusher::new(pusher, at - BELTS.len(), shared.clone()))
            }
            _ => unit.device(quirks, 0),
        }
    }
}

fn belt(of: &(&str, f64, f64, f64, f64)) -> Unit {
    let (name, length, acceleration, a, b) = *of;
    let parameters = BeltParameters {
        length,
        acceleration,
        barriers: [a, b],
        box_length: 2.0 * HALF_BOX,
        box_at: 0.0,
        first: 0.0,
        interval: 3.0,
    };
    Unit { name: name.to_owned(), figures: Figures::Belt { parameters, feed: String::new(), top: 0.6 } }
}

fn bed(at: usize, name: &str, length: f64, parameters: &BeltParameters, quirks: &[Quirk]) -> Bed {
    let all = Quirks::of(quirks, name);
    let radius = (length == 0.0).then_some(RADIUS);
    let [a, b] = parameters.barriers;
    let beams = ["lightBarrierA", "lightBarrierB"];
    Bed {
        length: radius.map_or(length, quarter),
        radius,
        barriers: [all.parameter("barrierA", a), all.parameter("barrierB", b)],
        next: HANDS_ON.contains(&at).then_some(at + 1),
        beams: beams.map(|beam| Along::new(all, beam, false)),
        hidden: beams.map(|beam| all.on(beam).value("x-is-half-hidden", "length").unwrap_or(0.0)),
        way: 0.0,
        travel: 0.0,
    }
}

impl Machine for Line {
    fn plant(&self, quirks: &[Quirk], seed: u64) -> Plant {
        let shared: Shared = Arc::new(Mutex::new(self.floor(quirks, seed)));
        let device = |at: usize| (self.units[at].name.clone(), self.device(at, quirks, &shared));
        let mut devices: Vec<_> = (0..self.units.len()).map(device).collect();
        devices.push((String::new(), Box::new(Parts(shared.clone()))));
        Plant::new(devices, self.commands(), self.units.iter().flat_map(Unit::signals).collect(), quirks)
    }

    fn commands(&self) -> Vec<(String, Kind)> {
        self.units.iter().flat_map(Unit::commands).collect()
    }

    fn program(&self, part: Part, quirks: &[Quirk], seed: u64, _dice: &mut Dice) -> Vec<Command> {
        controller::take_through(&mut self.plant(quirks, seed), part, &mut Dice::new(seed, 8))
    }

    fn boxed(&self) -> Box<dyn Machine> {
        Box::new(self.clone())
    }

    fn measures(&mut self, device: &str) -> Vec<&mut f64> {
        measures(&mut self.units, device)
    }

    fn has(&self, device: &str) -> bool {
        self.hosts.contains_key(device)
    }

    /// A belt hands on to the next, whose speed says how long a box stays in a beam at its end; where a plate clears it, all three of
    /// pusher, belt and exit. What moves the boxes has no name.
    fn about(&self, device: &str) -> Vec<String> {
        let of = |name: &str| BELTS.iter().position(|belt| belt.0 == name);
        let mut about = vec![device.to_owned()];
        for exit in EXITS.iter().filter(|(pusher, belt, exit)| [*pusher, *belt, *exit].contains(&device)) {
            about.extend([exit.0, exit.1, exit.2].map(str::to_owned));
        }
        about.extend(of(device).filter(|at| HANDS_ON.contains(at)).map(|at| BELTS[at + 1].0.to_owned()));
        about.extend((about.len() > 1 || of(device).is_some()).then(String::new));
        about
    }

    fn kind(&self, device: &str) -> String {
        let unit = self.units.iter().find(|unit| unit.name == device);
        unit.map_or("", |unit| unit.figures.kind()).to_owned()
    }

    fn fitted(&self, quirk: Quirk) -> Quirk {
        let host = self.hosts.get(quirk.device.as_str());
        let Some(unit) = host.and_then(|name| self.units.iter().find(|unit| unit.name == *name)) else { return quirk };
        Quirk { device: unit.name.clone(), ..fitted(quirk, &unit.figures) }
    }
}
