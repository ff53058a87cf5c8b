//! Where belts and plates stand: which belt follows which, and whose plate reaches over which beam.

use std::sync::Arc;

use super::alone;
use super::bay;
use super::lane::{Beyond, End, Lane};
use super::overrides::Overrides;
use super::recording::TaskId;
use super::seen::middle;
use super::subject::{Subject, beam_of};
use super::track::Track;
use super::way::Way;
use crate::device::{Belt, Device, Place, Plate, Role, Surface as DeviceSurface, Transfer};
use crate::effect::{self, EffectError};
use crate::kinematics::{Along, DPose3, DVec2, DVec3, Shape, Surface, Upright};
use crate::plant::{Instance, ParameterValue, Plant, Pose};

/// What lies about a belt in one run.
#[derive(Clone, Debug, Default)]
pub(super) struct Beside {
    pub lane: Arc<Lane>,
    /// Spans in which a plate may take a part out of a beam, s, by beam.
    pub hands: [Vec<(f64, f64)>; 2],
    /// The one bay that puts parts on it.
    pub fed: Option<Fed>,
    /// When its parts are due, s; none where that is random.
    pub due: Vec<f64>,
    /// Where the parts that stand on it at the start by the plant's word have their middles, m from its start.
    pub stand: Vec<f64>,
    /// How far it went by its own report, or, where it has none, by its commands.
    pub way: Option<Way>,
}

impl Beside {
    /// At which of the belt's beams what comes forwards was put by its bay, and how long those parts are along the belt, m: the first
    /// ahead of the bay, where no belt leads to the start and no plate reaches.
    pub fn fed_alone(&self, beams: &[Option<f64>; 2]) -> Option<(usize, f64)> {
        let fed = self.fed.filter(|fed| fed.is_along && !matches!(self.lane.ends[0], End::Belt(_)))?;
        let ahead = beams.iter().enumerate().filter_map(|(beam, at)| Some((beam, (*at).filter(|at| *at > fed.at)?)));
        let (beam, _) = ahead.min_by(|a, b| a.1.total_cmp(&b.1))?;
        self.hands[beam].is_empty().then_some((beam, fed.length))
    }
}

/// A bay that puts parts on a belt.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fed {
    /// The bay.
    pub bay: TaskId,
    /// Where it puts their middles, m from the belt's start.
    pub at: f64,
    /// How long they are along the belt, m.
    pub length: f64,
    /// Whether they lie along the belt.
    pub is_along: bool,
    /// How many there are at the most.
    pub limit: Option<usize>,
}

/// A bay that feeds a belt.
struct Feeder {
    /// The belt's instance.
    belt: String,
    fed: Fed,
    /// What says when its parts are due; `None` where that is random.
    bay: Option<Box<dyn Device>>,
}

/// The belts and plates of a plant, by their subjects.
pub(super) struct Layout {
    belts: Vec<(usize, Standing)>,
    plates: Vec<(usize, DPose3, Plate, f64)>,
    /// Belts by their instances' names, and at which end a bay takes what comes.
    taken: Vec<(String, bool)>,
    feeders: Vec<Feeder>,
    /// Belts by their instances' names, and where a part stands on them at the start.
    stand: Vec<(String, f64)>,
}

/// A belt where it stands.
struct Standing {
    name: String,
    surface: Surface,
    belt: Belt,
}

/// How far behind an end another belt begins at the most, m.
const GAPS_M: [f64; 4] = [0.01, 0.05, 0.10, 0.15];

impl Layout {
    /// That of a plant.
    pub fn new(plant: &Plant, subjects: &[Subject]) -> Result<Layout, EffectError> {
        let stand = plant.parts.iter().filter_map(|part| Some((part.on.clone()?, part.pose.x))).collect();
        let mut layout =
            Layout { belts: Vec::new(), plates: Vec::new(), taken: bays(plant), feeders: feeders(plant)?, stand };
        for (at, subject) in subjects.iter().enumerate() {
            let device = subject.device(&[], &Overrides::none())?;
            let instance = subject.id.instance(plant);
            let Pose { x, y, z, rz, .. } = instance.pose;
            // Conveyors and pushers stand level.
            let pose = Upright::new(x, y, z, rz).pose();
            match device.role() {
                Role::Carries(belt) => {
                    let surface = Surface::new(shape(&belt.surface), &pose);
                    layout.belts.push((at, Standing { name: instance.name.clone(), surface, belt: *belt }));
                }
                Role::Pushes(plate) => {
                    layout.plates.push((at, pose, *plate, subject.parameters.number("stroke")));
                }
                _ => {}
            }
        }
        Ok(layout)
    }

    /// What lies about each subject in each run; `is_trusted` says of a subject whether it has no gap of its own.
    pub fn beside(
        &self,
        subjects: &[Subject],
        is_trusted: &dyn Fn(usize) -> bool,
    ) -> Result<Vec<Vec<Beside>>, EffectError> {
        let runs = subjects.first().map_or(0, |subject| subject.runs.len());
        let mut beside = vec![vec![Beside::default(); runs]; subjects.len()];
        for (at, standing) in &self.belts {
            for (run, beside) in beside[*at].iter_mut().enumerate() {
                let end = |forwards| self.end(subjects, standing, forwards, run, is_trusted);
                let feeder = self.feeder(standing);
                let bay = feeder.and_then(|feeder| feeder.bay.as_ref());
                let lane = Lane {
                    length: standing.surface.length(),
                    shares: standing.belt.transfer == Transfer::Share,
                    ends: [end(false)?, end(true)?],
                };
                *beside = Beside {
                    lane: Arc::new(lane),
                    hands: self.hands(subjects, standing, run),
                    fed: feeder.map(|feeder| feeder.fed),
                    due: bay.map_or_else(Vec::new, |bay| bay::due(bay.boxed(), subjects[*at].runs[run].ends)),
                    stand: self.stand.iter().filter(|(on, _)| *on == standing.name).map(|(_, at)| *at).collect(),
                    way: way_of(&subjects[*at], run, 1.0)?,
                };
            }
        }
        Ok(beside)
    }

    /// The belts that follow a belt, by their subjects.
    pub fn follow(&self, subject: usize) -> Vec<usize> {
        let standing = self.belts.iter().find(|(at, _)| *at == subject).map(|(_, standing)| standing);
        let both = |standing: &Standing| [false, true].map(|forwards| self.behind(standing, forwards));
        let found = standing.map(both).into_iter().flatten().flatten();
        found.map(|behind| behind.0).collect()
    }

    fn end(
        &self,
        subjects: &[Subject],
        standing: &Standing,
        forwards: bool,
        run: usize,
        is_trusted: &dyn Fn(usize) -> bool,
    ) -> Result<End, EffectError> {
        if self.taken.contains(&(standing.name.clone(), forwards)) {
            return Ok(End::Open);
        }
        let Some((other, sign)) = self.behind(standing, forwards) else {
            let is_alone = !self.is_anything_behind(standing, forwards);
            return Ok(if is_alone { End::Open } else { End::Unknown });
        };
        let subject = &subjects[other];
        let Some(way) = way_of(subject, run, sign)? else { return Ok(End::Unknown) };
        let belt = &self.belts.iter().find(|(at, _)| *at == other).map(|(_, standing)| standing.belt);
        let beams = belt.map_or([None; 2], |belt| belt.barriers);
        let length = belt.map_or(0.0, |belt| belt.surface.length());
        let places = beams.map(|beam| beam.map(|beam| if sign > 0.0 { beam } else { length - beam }));
        let first = places.iter().enumerate().filter_map(|(beam, place)| Some((beam, (*place)?)));
        let first = first.min_by(|a, b| a.1.total_cmp(&b.1));
        let late = subject.runs[run].task.age_s + subject.runs[run].task.filter_s;
        let arrivals = first.and_then(|(beam, _)| barrier(subject, run, beam)).map_or_else(Vec::new, |track| {
            let rises = track.edges.iter().filter(|edge| edge.to != 0.0);
            rises.map(|edge| middle(track, edge.index) - late).collect()
        });
        let beam = first.map(|(_, place)| place);
        Ok(End::Belt(Beyond { way, beam, arrivals, is_trusted: is_trusted(other) }))
    }

    /// The belt that goes on where another ends (begins, if not `forwards`), and whether it runs away from there.
    fn behind(&self, standing: &Standing, forwards: bool) -> Option<(usize, f64)> {
        GAPS_M.iter().find_map(|gap| {
            let (place, heading) = standing.probe(*gap, forwards);
            let here = |(at, other): &(usize, Standing)| {
                let Along { station, offset } = other.surface.locate(place);
                let is_level = other.surface.bears(standing.surface.height());
                let is_on = station > -1e-6 && station < other.surface.length() + 1e-6;
                let turned = (other.surface.at(Along { station, offset: 0.0 }).1 - heading).cos();
                let is_in_line = turned.abs() > 0.9 && offset.abs() < 0.25 * other.surface.width();
                (is_level && is_on && is_in_line && other.name != standing.name).then_some((*at, turned.signum()))
            };
            self.belts.iter().find_map(here)
        })
    }

    /// Whether any belt is there, in line or across.
    fn is_anything_behind(&self, standing: &Standing, forwards: bool) -> bool {
        GAPS_M.iter().any(|gap| {
            let (place, _) = standing.probe(*gap, forwards);
            self.belts.iter().filter(|(_, other)| other.name != standing.name).any(|(_, other)| {
                let Along { station, offset } = other.surface.locate(place);
                let is_on = (0.0..=other.surface.length()).contains(&station);
                is_on && offset.abs() <= 0.5 * other.surface.width() && other.surface.bears(standing.surface.height())
            })
        })
    }

    /// The bay that feeds a belt, if it is one alone.
    fn feeder(&self, standing: &Standing) -> Option<&Feeder> {
        let mut here = self.feeders.iter().filter(|feeder| feeder.belt == standing.name);
        here.next().filter(|_| here.next().is_none())
    }

    /// When plates were out that reach over the beams of a belt, by beam.
    fn hands(&self, subjects: &[Subject], standing: &Standing, run: usize) -> [Vec<(f64, f64)>; 2] {
        standing.belt.barriers.map(|beam| {
            let Some(beam) = beam else { return Vec::new() };
            let near = self.plates.iter().filter(|(_, pose, plate, stroke)| {
                standing.is_swept(pose, plate, *stroke).is_some_and(|(from, to)| (from..=to).contains(&beam))
            });
            near.flat_map(|(at, ..)| out(&subjects[*at], run)).collect()
        })
    }
}

impl Standing {
    /// A place so far behind an end, and the running direction there.
    fn probe(&self, gap: f64, forwards: bool) -> (DVec2, f64) {
        let station = if forwards { self.surface.length() + gap } else { -gap };
        let (place, heading) = self.surface.at(Along { station, offset: 0.0 });
        (place, if forwards { heading } else { heading + std::f64::consts::PI })
    }

    /// From where to where on the belt parts stand that a plate may meet.
    fn is_swept(&self, pose: &DPose3, plate: &Plate, stroke: f64) -> Option<(f64, f64)> {
        const LOOKS: u32 = 20;
        /// Half of the longest part that a plate moves, m.
        const HALF_PART_M: f64 = 0.3;
        let looks = (0..=LOOKS).map(|look| stroke * f64::from(look) / f64::from(LOOKS));
        let stations = looks.filter_map(|x| {
            let place = pose.transform_point(DVec3::new(x, 0.0, 0.0));
            let Along { station, offset } = self.surface.locate(place.truncate());
            let is_on =
                offset.abs() <= 0.5 * self.surface.width() && station >= 0.0 && station <= self.surface.length();
            let is_above = (place.z - self.surface.height()).abs() < 0.5;
            (is_on && is_above).then_some(station)
        });
        let (least, most) = stations.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), at| (a.min(at), b.max(at)));
        let reach = 0.5 * plate.size[1] + HALF_PART_M;
        (least <= most).then_some((least - reach, most + reach))
    }
}

/// The ends of belts at which an unloading bay takes all at once.
fn bays(plant: &Plant) -> Vec<(String, bool)> {
    let tasks = plant.instances.iter().flat_map(|instance| instance.tasks.iter().map(move |task| (instance, task)));
    let sinks = tasks.filter(|(_, task)| task.kind.name == "kinetwin.UnloadingBay");
    let taken = sinks.filter_map(|(instance, task)| {
        let device = crate::device::build(task.kind, &task.parameters, &instance.name, 0).ok()?;
        let Role::Takes(sink) = device.role() else { return None };
        let forwards = match sink.place {
            Place::End => true,
            Place::Start => false,
            Place::At(_) => return None,
        };
        (sink.delay == 0.0).then(|| (task.parameters.text("belt").to_owned(), forwards))
    });
    taken.collect()
}

/// The bays that put parts on belts.
fn feeders(plant: &Plant) -> Result<Vec<Feeder>, EffectError> {
    /// The cosine of how far a part that lies along a belt is turned at the most.
    const ALONG: f64 = 0.995;
    let of = |(instance, of): (usize, &Instance)| {
        (0..of.tasks.len()).map(move |task| TaskId { instance, task }).collect::<Vec<_>>()
    };
    let bays = plant.instances.iter().enumerate().flat_map(of);
    let mut feeders = Vec::new();
    for bay in bays.filter(|bay| bay.task(plant).kind.name == "kinetwin.LoadingBay") {
        let (instance, task) = (bay.instance(plant), bay.task(plant));
        let tasks: Vec<&str> = instance.tasks.iter().map(|task| task.name.as_str()).collect();
        let effects = effect::of_task(&instance.effects, &task.name, &tasks);
        let device = effect::build(task.kind, &task.parameters, &instance.name, &effects, 0)?;
        let Role::Makes(source) = device.role() else { continue };
        let size = task.parameters.0.get("size").map(|size| &size.value);
        let Some(ParameterValue::Numbers(size)) = size else { continue };
        let is_along = source.turn.cos().abs() > ALONG;
        let limit = source.limit.map(|limit| limit as usize);
        let fed = Fed { bay, at: source.at[0], length: size[0], is_along, limit };
        let is_regular = task.parameters.number("spread") == 0.0;
        let belt = task.parameters.text("belt").to_owned();
        feeders.push(Feeder { belt, fed, bay: is_regular.then_some(device) });
    }
    Ok(feeders)
}

fn shape(surface: &DeviceSurface) -> Shape {
    match *surface {
        DeviceSurface::Straight { length, width } => Shape::Straight { length, width },
        DeviceSurface::Curve { radius, angle, width } => Shape::Curve { radius, angle, width },
    }
}

fn barrier(subject: &Subject, run: usize, beam: usize) -> Option<&Track> {
    let place = subject.signals.iter().position(|info| beam_of(info) == Some(beam))?;
    subject.runs[run].tracks[place].as_ref()
}

/// How far a belt went by its own report of its speed, or, where it has none, by its commands; times `sign`.
fn way_of(subject: &Subject, run: usize, sign: f64) -> Result<Option<Way>, EffectError> {
    let of = &subject.runs[run];
    let speed = subject.signals.iter().position(|info| info.property == "velocityActual");
    if let Some(track) = speed.and_then(|place| of.tracks[place].as_ref()) {
        let instants: Vec<f64> = track.grid.instants[track.first..].iter().map(|at| at - of.task.age_s).collect();
        let values: Vec<f64> = track.values.iter().map(|speed| sign * speed).collect();
        return Ok(Some(Way::of_reports(&instants, &values, track.grid.cycle)));
    }
    if of.commands.is_empty() {
        return Ok(None);
    }
    let Some(track) = of.tracks.iter().flatten().next() else { return Ok(None) };
    let device = subject.device(&[], &Overrides::none())?;
    let instants = track.grid.instants.clone();
    let metres = alone::travel(device, of, &instants).into_iter().map(|way| sign * way).collect();
    Ok(Some(Way { instants, metres }))
}

/// When a pusher's plate was not where it does nothing.
fn out(subject: &Subject, run: usize) -> Vec<(f64, f64)> {
    let place = subject.signals.iter().position(|info| info.property == "limitRetracted");
    let Some(track) = place.and_then(|place| subject.runs[run].tracks[place].as_ref()) else { return Vec::new() };
    let instants = &track.grid.instants;
    let mut spans = Vec::new();
    let mut since = (track.initial == 0.0).then_some(0.0);
    for edge in &track.edges {
        let before = edge.index.checked_sub(1).map_or(0.0, |before| instants[before]);
        match (edge.to == 0.0, since) {
            (true, None) => since = Some(before),
            (false, Some(from)) => {
                spans.push((from, instants[edge.index]));
                since = None;
            }
            _ => {}
        }
    }
    spans.extend(since.map(|from| (from, f64::INFINITY)));
    spans
}
