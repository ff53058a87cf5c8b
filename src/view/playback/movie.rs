//! What a replay looked like, picture by picture.

use crate::engine::{Engine, Held, PartCounts, PartState};
use crate::kinematics::DPose3;
use crate::replay::Reported;
use crate::run::control::Picture;
use crate::scene::Scene;
use crate::signal_map::{RegisterId, SignalMap};
use crate::time::Instant;
use crate::value::Value;

/// Pictures a simulated second.
const RATE: i64 = 60;
/// After how many pictures there is a whole one.
const WHOLE: usize = 120;
/// The most incidents that are kept.
const INCIDENTS: usize = 500;

/// All pictures of a replay.
#[derive(Default)]
pub struct Movie {
    /// Every [`WHOLE`]th picture.
    wholes: Vec<Still>,
    /// What the others have that the one before has not.
    changes: Vec<Change>,
    ends: Instant,
    next: i64,
    last: Still,
    /// Of each register: when it became what.
    histories: Vec<Vec<(Instant, f64)>>,
    incidents: Vec<(Instant, String)>,
    busy: Vec<(String, f64)>,
    /// What stands in the place of what the model did.
    reported: Option<Reported>,
    /// Of each beam of the scene the register of its light barrier, where that is reported.
    barriers: Vec<Option<RegisterId>>,
}

/// A picture.
#[derive(Clone, Debug, Default)]
struct Still {
    at: Instant,
    poses: Vec<[f32; 7]>,
    parts: Vec<PartState>,
    registers: Vec<Value>,
    beams: Vec<bool>,
    held: Vec<Held>,
    dead: Vec<String>,
    counts: PartCounts,
    occupancy: Vec<(String, f64)>,
}

/// What changed from one picture to the next.
#[derive(Debug, Default)]
struct Change {
    at: Instant,
    poses: Vec<(u32, [f32; 7])>,
    /// All, where any moved.
    parts: Option<Vec<PartState>>,
    registers: Vec<(u32, Value)>,
    beams: Option<Vec<bool>>,
    held: Option<Vec<Held>>,
    dead: Option<Vec<String>>,
    counts: PartCounts,
    occupancy: Option<Vec<(String, f64)>>,
}

impl Movie {
    /// One in which the machine is seen that `reported` as it did, and the model where nothing was reported.
    pub fn of_machine(reported: Reported, map: &SignalMap, scene: &Scene) -> Movie {
        let barriers = scene.beams().iter().map(|beam| map.register(&beam.name)).collect();
        Movie { reported: Some(reported), barriers, ..Movie::default() }
    }

    /// When it ends.
    pub fn ends(&self) -> Instant {
        self.ends
    }

    /// What went wrong with parts.
    pub fn incidents(&self) -> &[(Instant, String)] {
        &self.incidents
    }

    /// When a register became what, s.
    pub fn history(&self, register: RegisterId) -> Vec<(f64, f64)> {
        let history = self.histories.get(register.index()).map(Vec::as_slice).unwrap_or_default();
        history.iter().map(|(at, value)| (at.seconds(), *value)).collect()
    }

    /// Takes what the engine is like after a tick.
    pub fn take(&mut self, engine: &mut Engine) {
        let now = engine.now();
        let room = INCIDENTS.saturating_sub(self.incidents.len());
        self.incidents.extend(engine.take_incidents().iter().take(room).map(|what| (what.at, what.to_string())));
        self.note_registers(now, engine.registers());
        let span = now.since(self.ends).as_secs_f64();
        self.ends = now;
        self.busy.resize_with(engine.loads().count(), Default::default);
        for ((name, busy), (device, parts)) in self.busy.iter_mut().zip(engine.loads()) {
            if name.is_empty() {
                device.clone_into(name);
            }
            *busy += if parts > 0 { span } else { 0.0 };
        }
        if now.nanos() >= self.next {
            self.next = (now.nanos() * RATE / 1_000_000_000 + 1) * 1_000_000_000 / RATE;
            let still = self.still(engine);
            self.push(still);
        }
    }

    fn note_registers(&mut self, now: Instant, registers: &[Value]) {
        if self.histories.is_empty() {
            self.histories = (0..registers.len()).map(|index| self.told(index)).collect();
        }
        for (index, (history, value)) in self.histories.iter_mut().zip(registers).enumerate() {
            let is_told = self.reported.as_ref().is_some_and(|it| it.tells_of(RegisterId(index as u32)));
            let Some(value) = value.to_f64().filter(|_| !is_told) else { continue };
            if history.last().is_none_or(|(_, last)| *last != value) {
                history.push((now, value));
            }
        }
    }

    /// What was reported of a register.
    fn told(&self, index: usize) -> Vec<(Instant, f64)> {
        self.reported.as_ref().map(|it| it.history(RegisterId(index as u32))).unwrap_or_default()
    }

    fn still(&self, engine: &mut Engine) -> Still {
        let now = engine.now();
        let mut registers = engine.registers().to_vec();
        let mut beams: Vec<bool> = engine.cut_beams().collect();
        let parts = match &self.reported {
            Some(reported) => {
                for (index, register) in registers.iter_mut().enumerate() {
                    if let Some(told) = reported.at(RegisterId(index as u32), now) {
                        register.clone_from(told);
                    }
                }
                for (beam, register) in beams.iter_mut().zip(&self.barriers) {
                    let told = register.and_then(|register| reported.at(register, now)?.to_f64());
                    *beam = told.map_or(*beam, |number| number != 0.0);
                }
                reported.show(engine)
            }
            None => engine.parts().collect(),
        };
        let poses = engine.poses().map(|poses| poses.all().iter().map(packed).collect());
        Still {
            at: now,
            poses: poses.unwrap_or_default(),
            parts,
            registers,
            beams,
            held: engine.held().to_vec(),
            dead: engine.dead_drives().map(str::to_owned).collect(),
            counts: engine.counts(),
            occupancy: self.busy.clone(),
        }
    }

    fn push(&mut self, still: Still) {
        if self.changes.len().is_multiple_of(WHOLE) {
            self.wholes.push(still.clone());
        }
        self.changes.push(Change::between(&self.last, &still));
        self.last = still;
    }

    /// What it looked like at `at`; at the nearer end beyond its ends.
    pub fn picture(&self, at: Instant) -> Picture {
        let index = self.changes.partition_point(|change| change.at <= at).saturating_sub(1);
        let Some(whole) = self.wholes.get(index / WHOLE) else { return Picture::default() };
        let mut still = whole.clone();
        let first = index / WHOLE * WHOLE + 1;
        self.changes.get(first..=index).unwrap_or_default().iter().for_each(|change| change.apply(&mut still));
        let mut picture = Picture {
            poses: still.poses.iter().map(unpacked).collect(),
            beams: still.beams,
            held: still.held,
            dead: still.dead,
            occupancy: still.occupancy.into_iter().collect(),
            ..Picture::default()
        };
        picture.frame.now = at.min(self.ends);
        picture.frame.parts = still.parts;
        picture.frame.registers = still.registers;
        picture.frame.counts = still.counts;
        picture
    }
}

impl Change {
    fn between(before: &Still, after: &Still) -> Change {
        let changed = |index: &usize| before.poses.get(*index) != after.poses.get(*index);
        let poses = (0..after.poses.len()).filter(changed).map(|index| (index as u32, after.poses[index]));
        let new = |index: &usize| before.registers.get(*index) != after.registers.get(*index);
        let registers = (0..after.registers.len()).filter(new);
        Change {
            at: after.at,
            poses: poses.collect(),
            parts: (before.parts != after.parts).then(|| after.parts.clone()),
            registers: registers.map(|index| (index as u32, after.registers[index].clone())).collect(),
            beams: (before.beams != after.beams).then(|| after.beams.clone()),
            held: (before.held != after.held).then(|| after.held.clone()),
            dead: (before.dead != after.dead).then(|| after.dead.clone()),
            counts: after.counts,
            occupancy: (before.occupancy != after.occupancy).then(|| after.occupancy.clone()),
        }
    }

    fn apply(&self, still: &mut Still) {
        still.at = self.at;
        self.poses.iter().for_each(|(index, pose)| still.poses[*index as usize] = *pose);
        self.registers.iter().for_each(|(index, value)| still.registers[*index as usize].clone_from(value));
        replace(&mut still.parts, &self.parts);
        replace(&mut still.beams, &self.beams);
        replace(&mut still.held, &self.held);
        replace(&mut still.dead, &self.dead);
        replace(&mut still.occupancy, &self.occupancy);
        still.counts = self.counts;
    }
}

fn replace<T: Clone>(now: &mut T, new: &Option<T>) {
    if let Some(new) = new {
        now.clone_from(new);
    }
}

fn packed(pose: &DPose3) -> [f32; 7] {
    let (place, turn) = (pose.translation, pose.rotation);
    [place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w].map(|number| number as f32)
}

fn unpacked(numbers: &[f32; 7]) -> DPose3 {
    use crate::kinematics::{DQuat, DVec3};
    let [x, y, z, qx, qy, qz, qw] = numbers.map(f64::from);
    DPose3::from_parts(DVec3::new(x, y, z), DQuat::from_xyzw(qx, qy, qz, qw))
}
