//! The line's controller: it takes loose boxes from the packing stations to the four ends.
//!
//! A small program of its own, by the rules of `models/depalletizer/README.md`, in cycles of 20 ms. It sees the machine's sensors as they
//! are: what a link or a switch adds to their reports stands behind it. Beyond the rules it lets the box line run at several speeds
//! and rest now and then, so that its drives show what they can.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

use super::{EXITS, FLOW};
use crate::chance::Dice;
use crate::plant::{Command, Plant, STEP};
use crate::robot::AXES;
use crate::script::Part;

/// The controller's cycle, s.
const CYCLE: f64 = 0.02;
/// The speeds of the stations' belt, and of the others at first, m/s.
const LOOSE: f64 = 0.4;
const LINE: f64 = 0.6;
/// Of so many boxes that come by each pusher takes the first.
const ONE_OF: [u32; 3] = [3, 2, 1];
/// After so many boxes an exit carries the other way, when the last was pushed so long ago, s.
const TURN_AFTER: u32 = 3;
const GONE: f64 = 4.0;
/// X, Y, Z and R above the columns of a pallet and above the set-down place, as high as it travels or a little lower.
const WAYPOINTS: [[f64; 4]; 4] =
    [[-0.4, 0.0, -0.4, FRAC_PI_2], [0.0, 0.0, -0.6, FRAC_PI_2], [0.4, 0.0, -0.4, FRAC_PI_2], [0.0, 1.2, -0.4, 0.0]];

/// Runs `plant` under the controller for `part`; gives what it was told.
pub fn take_through(plant: &mut Plant, part: Part, dice: &mut Dice) -> Vec<Command> {
    let mut controller = Controller::new(plant);
    let mut now = 0.0;
    for cycle in 1..=(part.seconds() / CYCLE) as usize {
        let late = (1.2e-3 * dice.normal()).abs().min(8e-3);
        // A recorder stamps to the microsecond.
        let at = ((cycle as f64 * CYCLE + late) * 1e6).round() / 1e6;
        while now < at {
            let next = (now + STEP).min(at);
            plant.advance(next, next - now);
            now = next;
        }
        if at >= part.seconds() {
            break;
        }
        let from = controller.said.len();
        controller.decide(plant, at, dice);
        for command in &controller.said[from..] {
            plant.tell(at, command);
        }
    }
    controller.said
}

struct Controller {
    /// Where each signal stands in what the plant reads.
    places: BTreeMap<String, usize>,
    values: Vec<f64>,
    before: Vec<f64>,
    told: BTreeMap<String, f64>,
    said: Vec<Command>,
    /// When the line's speed changes next, and until when it rests.
    changes: f64,
    rests_until: f64,
    speed: f64,
    lets_in: bool,
    /// Whether the set-down place holds a box.
    is_taken: bool,
    sorters: [Sorter; 3],
    waypoint: usize,
    leaves: f64,
}

#[derive(Clone, Copy, Default)]
struct Sorter {
    seen: u32,
    pushed: u32,
    pushed_at: f64,
    is_busy: bool,
    backwards: bool,
}

impl Controller {
    fn new(plant: &Plant) -> Controller {
        let places = plant.signals.iter().enumerate().map(|(at, signal)| (signal.name.clone(), at)).collect();
        Controller {
            places,
            values: Vec::new(),
            before: Vec::new(),
            told: BTreeMap::new(),
            said: Vec::new(),
            changes: 0.3,
            rests_until: 0.0,
            speed: LINE,
            lets_in: false,
            is_taken: false,
            sorters: [Sorter::default(); 3],
            waypoint: 0,
            leaves: 0.5,
        }
    }

    fn is(&self, device: &str, port: &str) -> bool {
        self.places.get(&format!("{device}.{port}")).is_some_and(|at| self.values[*at] != 0.0)
    }

    fn was(&self, device: &str, port: &str) -> bool {
        self.places
            .get(&format!("{device}.{port}"))
            .is_some_and(|at| self.before.get(*at).is_some_and(|value| *value != 0.0))
    }

    fn rises(&self, device: &str, port: &str) -> bool {
        self.is(device, port) && !self.was(device, port)
    }

    fn say(&mut self, at: f64, signal: String, value: f64) {
        if self.told.get(&signal).copied().unwrap_or(0.0) != value {
            self.told.insert(signal.clone(), value);
            self.said.push(Command { at, signal, value });
        }
    }

    fn run(&mut self, at: f64, belt: &str, speed: f64, direction: f64) {
        if direction != 0.0 {
            self.say(at, format!("{belt}.velocityTarget"), speed);
        }
        self.say(at, format!("{belt}.motorDirection"), direction);
    }

    fn decide(&mut self, plant: &Plant, at: f64, dice: &mut Dice) {
        self.before = std::mem::take(&mut self.values);
        for (_, device) in &plant.devices {
            device.read(at, &mut self.values);
        }
        self.box_line(at, dice);
        self.loose_boxes(at);
        for lane in 0..3 {
            self.sort(at, lane);
        }
        self.robot(at, dice);
    }

    /// Conveyor4 to Conveyor7, all at one speed.
    fn box_line(&mut self, at: f64, dice: &mut Dice) {
        if at < self.changes {
            return;
        }
        if at >= self.rests_until && self.rests_until > 0.0 || !dice.is_so(0.3) {
            self.speed = (dice.between(0.35, 0.7) * 1e3).round() / 1e3;
            self.rests_until = 0.0;
            self.changes = at + dice.between(3.0, 7.0);
        } else {
            self.rests_until = at + dice.between(1.0, 2.5);
            self.changes = self.rests_until;
        }
        let direction = if self.rests_until > 0.0 { 0.0 } else { 1.0 };
        for belt in FLOW {
            self.run(at, belt, self.speed, direction);
        }
    }

    /// Conveyor3 gathers boxes, and lets one onto the set-down place when that is free.
    fn loose_boxes(&mut self, at: f64) {
        if self.was("Conveyor4", "lightBarrierB") && !self.is("Conveyor4", "lightBarrierB") {
            self.is_taken = false;
        }
        let waits = self.is("Conveyor3", "lightBarrierB");
        if self.lets_in && self.rises("Conveyor4", "lightBarrierA") {
            self.lets_in = false;
        } else if waits && !self.is_taken && !self.lets_in && self.rests_until == 0.0 {
            (self.lets_in, self.is_taken) = (true, true);
        }
        // While the line rests it takes no box over.
        let runs = if self.lets_in { self.rests_until == 0.0 } else { !waits };
        self.run(at, "Conveyor3", LOOSE, f64::from(runs));
    }

    fn sort(&mut self, at: f64, lane: usize) {
        let (pusher, belt, exit) = EXITS[lane];
        let mut sorter = self.sorters[lane];
        let command = format!("{pusher}.command");
        if self.rises(belt, "lightBarrierB") {
            let chosen = sorter.seen.is_multiple_of(ONE_OF[lane]);
            sorter.seen += 1;
            let is_ready = !self.is(pusher, "lightbarrierB") && self.is(pusher, "limitRetracted");
            if chosen && is_ready && !sorter.is_busy {
                self.say(at, command.clone(), 1.0);
                (sorter.is_busy, sorter.pushed_at) = (true, at);
                sorter.pushed += 1;
            }
        } else if sorter.is_busy && self.rises(pusher, "limitExtended") {
            self.say(at, command.clone(), 2.0);
        } else if sorter.is_busy && self.rises(pusher, "limitRetracted") {
            self.say(at, command, 0.0);
            sorter.is_busy = false;
        }
        if sorter.pushed >= TURN_AFTER && at > sorter.pushed_at + GONE {
            (sorter.pushed, sorter.backwards) = (0, !sorter.backwards);
        }
        if at >= 0.3 {
            self.run(at, exit, LINE, if sorter.backwards { -1.0 } else { 1.0 });
        }
        self.sorters[lane] = sorter;
    }

    /// The robot goes its ways without boxes: no pallet is taken off.
    fn robot(&mut self, at: f64, dice: &mut Dice) {
        if at < self.leaves || !self.is("Robot", "cartesianArrived") {
            return;
        }
        self.leaves = at + dice.between(0.3, 1.0);
        self.waypoint = (self.waypoint + 1 + dice.below(WAYPOINTS.len() - 1)) % WAYPOINTS.len();
        for (axis, target) in AXES.iter().zip(WAYPOINTS[self.waypoint]) {
            self.say(at, format!("Robot.{axis}Target"), target);
        }
    }
}
