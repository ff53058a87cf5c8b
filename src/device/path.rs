//! A device's signal path, and what may stand in it beyond the nominal law.
//!
//! ```text
//! command link → actuator → mechanics → transmission → load → sensor → report link        (and the process: the parts)
//! ```
//!
//! A [`Stage`] is something a real device adds at one place of that path: a dead time, a friction, a backlash. Every
//! method of it is the identity unless it says otherwise, so that a device strings its stages along its law without
//! knowing them. A device whose path holds no stage computes its nominal law by the same instructions as ever: bit by bit
//! the same result. With stages it moves in stretches no longer than the most particular of them bears
//! ([`Stage::stretch`]): a stage whose law is exact over any span bears any, one that is only known from one instant to the
//! next asks for at most [`STRETCH_S`].

use std::fmt;

use super::law::SAME_INSTANT_S;
use super::law::servo::Spring;
use super::law::sum::Sum;
use crate::plant::EffectPlace;

/// The longest stretch of a stage that does not say otherwise, s.
pub const STRETCH_S: f64 = 1e-3;

/// The longest stretch of a stage that a report passes which moves in steps: each step comes at its instant whatever the
/// stretch, and what is there and gone again within one is not seen, s.
pub const STEPS_STRETCH_S: f64 = 5e-3;

/// Where something is and how fast it moves: m and m/s, or rad and rad/s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Motion {
    pub position: f64,
    pub velocity: f64,
}

/// The instant a stage is asked about, and how long ago it was asked before.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moment {
    /// Since the device was built, s.
    pub now: f64,
    /// The stretch that ends now, s; 0 when only a value changed.
    pub span: f64,
}

/// What a drive may do; each at or above 0, infinite where nothing limits it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Highest speed, m/s or rad/s.
    pub velocity: f64,
    /// Steepest rise of the speed's magnitude, m/s² or rad/s².
    pub acceleration: f64,
    /// Steepest fall of it.
    pub deceleration: f64,
    /// Greatest force or torque either way, N or N·m.
    pub force: f64,
}

/// Friction as a set-valued law: while the axis moves it opposes with `sliding + viscous·|v|`, at rest with any force up to
/// `sticking`. Nominally only `viscous` is not 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Friction {
    /// At the present speed, N or N·m.
    pub sliding: f64,
    /// At rest, at least as much as `sliding`, N or N·m.
    pub sticking: f64,
    /// N·s/m or N·m·s/rad.
    pub viscous: f64,
}

/// What goes through an axis's gears.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Effort {
    /// Drive less load: what would accelerate the axis without friction, N or N·m.
    pub net: f64,
    /// Drive and load together, as both press on the gears whichever way they do, N or N·m.
    pub transmitted: f64,
}

/// What a drive has to move beside friction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Burden {
    /// kg or kg·m².
    pub inertia: f64,
    /// Opposes positive motion if positive, N or N·m.
    pub force: f64,
}

/// How long a gripper takes, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VacuumTimes {
    pub build_up: f64,
    pub release: f64,
    /// How long vacuum holds before it leaks away, infinite if it does not.
    pub hold: f64,
}

/// Something at one place of a signal path. Units are SI; `moment.now` never falls.
pub trait Stage: Send + Sync + fmt::Debug {
    /// A copy with its state.
    fn boxed(&self) -> Box<dyn Stage>;

    /// A signal passes (command link, sensor, report link): `value` stands at the entry now, what stands at the exit?
    /// Called at every change of the entry, and at the end of every stretch.
    fn signal(&mut self, value: f64, _moment: Moment) -> f64 {
        value
    }

    /// From now on counters pass as the numbers that they are rounded from: see
    /// [`Device::count_finely`](crate::device::Device::count_finely).
    fn count_finely(&mut self) {}

    /// The longest stretch that the stage bears, s: what it computes over a longer one would be off.
    fn stretch(&self) -> f64 {
        STRETCH_S
    }

    /// Whether a motion of constant speed leaves the stage with a constant speed, until a change that it foresees.
    fn is_even(&self) -> bool {
        false
    }

    /// The longest stretch that the stage bears on an axis that is moved together with the spring that hangs on it, s.
    fn leap(&self) -> f64 {
        self.stretch()
    }

    /// The spring on which what the axis moves hangs behind it, if the axis feels it.
    fn spring(&mut self) -> Option<&mut Spring> {
        None
    }

    /// The same as [`motion`](Stage::motion), after a stretch in which the axis was moved together with its [`spring`](Stage::spring).
    fn leapt(&mut self, motion: Motion, moment: Moment) -> Motion {
        self.motion(motion, moment)
    }

    /// What a boolean sensor looks along has moved to `travel` (m or rad), for the [`signal`](Stage::signal) that follows.
    fn travelled(&mut self, _travel: f64) {}

    /// How many parts the device carries or pushes now, and how many of them are held back by what stands in their way.
    fn loaded(&mut self, _parts: f64, _queued: f64) {}

    /// How many other actuators on the same supply move now.
    fn shared(&mut self, _others: f64) {}

    /// When the exit will next change by itself, if that is known: the device ends a stretch there.
    fn next_change(&self) -> Option<f64> {
        None
    }

    /// The reference of a drive passes: the speed (ramps, strokes), the target (profiles), or the control error (servo
    /// loops) that the law is to follow.
    fn reference(&mut self, reference: f64, _motion: Motion, _moment: Moment) -> f64 {
        reference
    }

    /// What the drive may do now.
    fn bounds(&mut self, bounds: Bounds, _motion: Motion, _moment: Moment) -> Bounds {
        bounds
    }

    /// The time constant with which an ideal axis closes on its target, s; 0: at once.
    fn lag(&self) -> f64 {
        0.0
    }

    /// Which share of the force that a drive exerts reaches the axis, the force being `effort` now; above 0.
    fn strength(&self, _effort: f64) -> f64 {
        1.0
    }

    /// The force of a drive passes on its way to the axis, N or N·m: `effort` is what it will be at the end of the stretch,
    /// the result what it is in the stretch's mean; over a span of 0 it jumped to `effort`. Only where [`shapes_effort`](Stage::shapes_effort).
    fn effort(&mut self, effort: f64, _moment: Moment) -> f64 {
        effort
    }

    /// Whether [`effort`](Stage::effort) is not the identity.
    fn shapes_effort(&self) -> bool {
        false
    }

    /// Whether the drive is switched on: `on` is what it was told.
    fn switched(&mut self, on: bool, _moment: Moment) -> bool {
        on
    }

    /// What the law moved passes to the next part of the path: a lag, a slip, a backlash.
    fn motion(&mut self, motion: Motion, _moment: Moment) -> Motion {
        motion
    }

    /// The friction about a motion under an effort.
    fn friction(&mut self, friction: Friction, _motion: Motion, _effort: Effort) -> Friction {
        friction
    }

    /// How much its sliding [`friction`](Stage::friction) may change with the motion, or with an effort such as this, N or N·m: 0
    /// where it does not.
    fn uneven(&self, _effort: Effort) -> f64 {
        0.0
    }

    /// The burden at a motion.
    fn burden(&mut self, burden: Burden, _motion: Motion, _moment: Moment) -> Burden {
        burden
    }

    /// A gripper's times.
    fn vacuum(&mut self, times: VacuumTimes, _moment: Moment) -> VacuumTimes {
        times
    }

    /// How far a belt takes what goes with it when it moved by `displacement` in the stretch, m.
    fn carried(&mut self, displacement: f64) -> f64 {
        displacement
    }

    /// The steepest change of its belt's speed that a part follows, m/s²; infinite where none slips.
    fn grip(&self) -> f64 {
        f64::INFINITY
    }

    /// Which share of its way a part loses while it stands on this belt and on another.
    fn transfer_slip(&self) -> f64 {
        0.0
    }

    /// Whether an axis counts as arrived that is at rest at its target, or is not.
    fn arrived(&mut self, is_there: bool, _moment: Moment) -> bool {
        is_there
    }

    /// Gives every number of its state to `visit`, in an order that never changes.
    fn state(&self, visit: &mut dyn FnMut(f64));
}

impl Clone for Box<dyn Stage> {
    fn clone(&self) -> Self {
        self.boxed()
    }
}

/// The stages of one component, in the order of the path.
#[derive(Debug, Default)]
pub struct Path {
    stages: Vec<Box<dyn Stage>>,
}

impl Clone for Path {
    /// Devices are copied far more often than they have stages.
    #[inline]
    fn clone(&self) -> Path {
        if self.stages.is_empty() { Path::default() } else { Path { stages: self.stages.clone() } }
    }
}

impl Path {
    /// Adds a stage behind those that are there.
    pub fn push(&mut self, stage: Box<dyn Stage>) {
        self.stages.push(stage);
    }

    /// Whether nothing stands in the path: the nominal law alone holds.
    pub fn is_nominal(&self) -> bool {
        self.stages.is_empty()
    }

    /// See [`Stage::signal`].
    pub fn signal(&mut self, value: f64, moment: Moment) -> f64 {
        self.stages.iter_mut().fold(value, |value, stage| stage.signal(value, moment))
    }

    /// See [`Stage::count_finely`].
    pub fn count_finely(&mut self) {
        self.stages.iter_mut().for_each(|stage| stage.count_finely());
    }

    /// The first change that any stage foresees.
    pub fn next_change(&self) -> Option<f64> {
        self.stages.iter().filter_map(|stage| stage.next_change()).min_by(f64::total_cmp)
    }

    /// See [`Stage::reference`].
    pub fn reference(&mut self, reference: f64, motion: Motion, moment: Moment) -> f64 {
        self.stages.iter_mut().fold(reference, |reference, stage| stage.reference(reference, motion, moment))
    }

    /// See [`Stage::bounds`].
    pub fn bounds(&mut self, bounds: Bounds, motion: Motion, moment: Moment) -> Bounds {
        self.stages.iter_mut().fold(bounds, |bounds, stage| stage.bounds(bounds, motion, moment))
    }

    /// See [`Stage::lag`].
    pub fn lag(&self) -> f64 {
        self.stages.iter().map(|stage| stage.lag()).sum()
    }

    /// See [`Stage::strength`].
    pub fn strength(&self, effort: f64) -> f64 {
        self.stages.iter().map(|stage| stage.strength(effort)).product()
    }

    /// See [`Stage::effort`].
    pub fn effort(&mut self, effort: f64, moment: Moment) -> f64 {
        self.stages.iter_mut().fold(effort, |effort, stage| stage.effort(effort, moment))
    }

    /// See [`Stage::shapes_effort`].
    pub fn shapes_effort(&self) -> bool {
        self.stages.iter().any(|stage| stage.shapes_effort())
    }

    /// See [`Stage::switched`].
    pub fn switched(&mut self, on: bool, moment: Moment) -> bool {
        self.stages.iter_mut().fold(on, |on, stage| stage.switched(on, moment))
    }

    /// See [`Stage::motion`].
    pub fn motion(&mut self, motion: Motion, moment: Moment) -> Motion {
        self.stages.iter_mut().fold(motion, |motion, stage| stage.motion(motion, moment))
    }

    /// See [`Stage::friction`].
    pub fn friction(&mut self, friction: Friction, motion: Motion, effort: Effort) -> Friction {
        self.stages.iter_mut().fold(friction, |friction, stage| stage.friction(friction, motion, effort))
    }

    /// See [`Stage::uneven`]; of all stages together.
    pub fn uneven(&self, effort: Effort) -> f64 {
        self.stages.iter().map(|stage| stage.uneven(effort)).sum()
    }

    /// See [`Stage::burden`].
    pub fn burden(&mut self, burden: Burden, motion: Motion, moment: Moment) -> Burden {
        self.stages.iter_mut().fold(burden, |burden, stage| stage.burden(burden, motion, moment))
    }

    /// See [`Stage::vacuum`].
    pub fn vacuum(&mut self, times: VacuumTimes, moment: Moment) -> VacuumTimes {
        self.stages.iter_mut().fold(times, |times, stage| stage.vacuum(times, moment))
    }

    /// See [`Stage::carried`].
    pub fn carried(&mut self, displacement: f64) -> f64 {
        self.stages.iter_mut().fold(displacement, |way, stage| stage.carried(way))
    }

    /// See [`Stage::grip`]; the least of all.
    pub fn grip(&self) -> f64 {
        self.stages.iter().map(|stage| stage.grip()).fold(f64::INFINITY, f64::min)
    }

    /// The longest stretch that all stages bear, s; infinite without one.
    pub fn stretch(&self) -> f64 {
        self.stages.iter().map(|stage| stage.stretch()).fold(f64::INFINITY, f64::min)
    }

    /// See [`Stage::is_even`]; of all.
    pub fn is_even(&self) -> bool {
        self.stages.iter().all(|stage| stage.is_even())
    }

    /// See [`Stage::leap`]; the same of all.
    fn leap(&self) -> f64 {
        self.stages.iter().map(|stage| stage.leap()).fold(f64::INFINITY, f64::min)
    }

    /// See [`Stage::spring`]: that of the first stage, which has the axis's own motion.
    pub fn spring(&mut self) -> Option<&mut Spring> {
        self.stages.first_mut()?.spring()
    }

    /// See [`Stage::leapt`]; the stages behind the first have what it passes on.
    pub fn leapt(&mut self, motion: Motion, moment: Moment) -> Motion {
        let Some((first, others)) = self.stages.split_first_mut() else { return motion };
        others.iter_mut().fold(first.leapt(motion, moment), |motion, stage| stage.motion(motion, moment))
    }

    /// See [`Stage::travelled`].
    pub fn travelled(&mut self, travel: f64) {
        self.stages.iter_mut().for_each(|stage| stage.travelled(travel));
    }

    /// See [`Stage::transfer_slip`]; what is left after one is what the next takes its share of.
    pub fn transfer_slip(&self) -> f64 {
        1.0 - self.stages.iter().map(|stage| 1.0 - stage.transfer_slip()).product::<f64>()
    }

    /// See [`Stage::arrived`].
    pub fn arrived(&mut self, is_there: bool, moment: Moment) -> bool {
        self.stages.iter_mut().fold(is_there, |is_there, stage| stage.arrived(is_there, moment))
    }

    /// See [`Stage::state`].
    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        for stage in &self.stages {
            stage.state(visit);
        }
    }
}

/// All stages inside one component of a device, by their place.
#[derive(Clone, Debug, Default)]
pub struct Stages {
    /// Whether there is any; kept because it is asked for at every step of every device.
    has_any: bool,
    /// Whether [`Path::shapes_effort`] holds of the actuator.
    shapes_effort: bool,
    /// The longest stretch that all bear, s.
    longest: f64,
    /// The same of an axis that is moved together with its spring, where it has one and that is longer.
    leap: Option<f64>,
    pub actuator: Path,
    pub mechanics: Path,
    pub transmission: Path,
    pub load: Path,
    pub process: Path,
    /// What the stages were last told of parts, of parts held back, and of others on the supply.
    told: [f64; 3],
    now: Sum,
}

impl Stages {
    /// Adds a stage at `place`; gives it back where that place does not lie inside a device.
    pub fn push(&mut self, place: EffectPlace, stage: Box<dyn Stage>) -> Result<(), Box<dyn Stage>> {
        match place {
            EffectPlace::Actuator => self.actuator.push(stage),
            EffectPlace::Mechanics => self.mechanics.push(stage),
            EffectPlace::Transmission => self.transmission.push(stage),
            EffectPlace::Load => self.load.push(stage),
            EffectPlace::Process => self.process.push(stage),
            EffectPlace::CommandLink | EffectPlace::Sensor | EffectPlace::ReportLink => return Err(stage),
        }
        self.has_any = true;
        self.shapes_effort = self.actuator.shapes_effort();
        self.longest = self.paths().iter().map(|path| path.stretch()).fold(f64::INFINITY, f64::min);
        let leap = self.paths().iter().map(|path| path.leap()).fold(f64::INFINITY, f64::min);
        self.leap = (self.transmission.spring().is_some() && leap > self.longest).then_some(leap);
        Ok(())
    }

    fn paths(&self) -> [&Path; 5] {
        [&self.actuator, &self.mechanics, &self.transmission, &self.load, &self.process]
    }

    fn each(&mut self, mut act: impl FnMut(&mut dyn Stage)) {
        let paths =
            [&mut self.actuator, &mut self.mechanics, &mut self.transmission, &mut self.load, &mut self.process];
        paths.into_iter().flat_map(|path| &mut path.stages).for_each(|stage| act(stage.as_mut()));
    }

    /// Whether nothing stands anywhere: the nominal law alone holds.
    pub fn is_nominal(&self) -> bool {
        !self.has_any
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.paths().iter().map(|path| path.stages.len()).sum()
    }

    /// See [`Path::shapes_effort`], of the actuator.
    pub fn shapes_effort(&self) -> bool {
        self.shapes_effort
    }

    /// See [`Stage::loaded`]. Returns whether that is news to any stage.
    pub fn loaded(&mut self, parts: f64, queued: f64) -> bool {
        let is_news = self.has_any && self.told[..2] != [parts, queued];
        if is_news {
            self.told[..2].copy_from_slice(&[parts, queued]);
            self.each(|stage| stage.loaded(parts, queued));
        }
        is_news
    }

    /// See [`Stage::shared`]. Returns whether that is news to any stage.
    pub fn shared(&mut self, others: f64) -> bool {
        let is_news = self.has_any && self.told[2] != others;
        if is_news {
            self.told[2] = others;
            self.each(|stage| stage.shared(others));
        }
        is_news
    }

    /// For how long at least they make of a device at rest what they make of it now, if nothing is told, s: those that bear any stretch know when
    /// they change by themselves; of others nobody knows.
    pub fn unchanged_for(&self) -> f64 {
        match (self.has_any, self.longest.is_infinite()) {
            (false, _) => f64::INFINITY,
            (true, false) => 0.0,
            (true, true) => {
                self.next_change().map_or(f64::INFINITY, |at| (at - self.now.value() - 2.0 * SAME_INSTANT_S).max(0.0))
            }
        }
    }

    fn next_change(&self) -> Option<f64> {
        self.paths().iter().filter_map(|path| path.next_change()).min_by(f64::total_cmp)
    }

    /// Lets time pass where nothing moves in stages.
    pub fn pass_time(&mut self, seconds: f64) {
        self.now.add(seconds);
    }

    /// The present instant, for a value that changed at once.
    pub fn moment(&self) -> Moment {
        Moment { now: self.now.value(), span: 0.0 }
    }

    /// The next stretch of `rest`, s, which is less by it then: the moment at its end; `None` where nothing is left. One ends where a stage
    /// foresees a change, and where the law does, which goes on as it does for `steady` from now on, s: a stage that is exact for
    /// a parabola, or a straight line, never meets a kink within a stretch.
    pub fn stretch(&mut self, rest: &mut f64, steady: f64) -> Option<Moment> {
        if *rest <= 0.0 {
            return None;
        }
        let span = self.span(self.longest, *rest, steady);
        *rest -= span;
        self.now.add(span);
        Some(Moment { now: self.now.value(), span })
    }

    /// What the next stretch of `rest` would be if the axis were moved together with its spring; no time passes. `None` where that is no
    /// longer than others.
    pub fn leap(&self, rest: f64, steady: f64) -> Option<Moment> {
        let longest = self.leap.filter(|_| rest > 0.0)?;
        let span = self.span(longest, rest, steady);
        let mut now = self.now;
        now.add(span);
        Some(Moment { now: now.value(), span })
    }

    /// How long a stretch of at most `longest` is.
    fn span(&self, longest: f64, rest: f64, steady: f64) -> f64 {
        let until = self.next_change().map_or(f64::INFINITY, |at| at - self.now.value());
        // A change that is due, or so near that time would not move, does not hold time up.
        let ahead = |until: f64| if until > SAME_INSTANT_S { until } else { f64::INFINITY };
        let span = rest.min(longest).min(ahead(until)).min(ahead(steady));
        // What rounding leaves of the whole is no stretch of its own.
        if rest - span < SAME_INSTANT_S { rest } else { span }
    }

    /// See [`Stage::state`].
    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        if self.has_any {
            self.told.iter().for_each(|number| visit(*number));
        }
        for path in self.paths() {
            path.state(visit);
        }
    }
}
