//! A device taken up again and again where its machine was, so that what it gets wrong does not add up for ever.
//!
//! A drive with a stiff speed loop forgets within some hundredths of a second where it came from: replayed in one go, all that
//! its report is off by comes from what the model lacks just then. A loosely driven axis does not. It swings for long, it sticks
//! where friction left it, it falls to one side or the other; a small error early on decides what comes seconds later, and the
//! deviance over the parameters becomes rugged. Such a device is replayed in windows, each from the position and the speed that
//! were measured at its start.
//!
//! Source: multiple shooting, with its states measured rather than fitted (H. G. Bock, Recent advances in parameter
//! identification techniques for O.D.E., in: Numerical Treatment of Inverse Problems, Birkhäuser 1983).

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::overrides::Overrides;
use super::prediction::{Predicted, Prediction};
use super::statistics::{quantile, span};
use super::subject::Subject;
use super::track::Track;
use crate::device::path::Motion;
use crate::effect::EffectError;

/// How long a window is, s.
pub const WINDOW_S: f64 = 1.0;
/// How many samples on either side say where the machine was at a sample.
const ABOUT: usize = 3;
/// What the device is displaced by to see whether it remembers, as a share of what it travels.
const DISPLACED: f64 = 0.01;
/// What is left of that at some time of this span, as a share, where it does; s.
const REMEMBERED: f64 = 0.37;
const AFTER_S: [f64; 2] = [0.1, 0.3];

/// Where a run is taken up again.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Restarts {
    /// The ports that report where the device is and how fast it moves.
    pub position: usize,
    pub velocity: usize,
    /// In the order of time.
    pub each: Vec<Restart>,
}

/// Where the machine was at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Restart {
    /// s.
    pub at: f64,
    /// m or rad.
    pub position: f64,
    /// m/s or rad/s.
    pub velocity: f64,
}

impl Subject {
    /// Takes the device up where its machine was at the start of every window, where it remembers what it was displaced by for
    /// longer than a drive with a speed loop would. Whether it does.
    pub(super) fn take_up_again(&mut self) -> Result<bool, EffectError> {
        let Some(signal) = self.position_signal() else { return Ok(false) };
        if !self.can_be_shifted()? || !self.remembers_its_own(signal)? {
            return Ok(false);
        }
        let travels = self.restart_at(signal, None);
        let remembers = self.remembers(signal, &travels)?;
        if !remembers {
            self.leave_alone();
        }
        Ok(remembers)
    }

    /// To be measured as another of the same device: where that is taken up again, in one go from where the machine was, with
    /// what that takes a good model to be off by. Whether anything has changed.
    pub(super) fn take_up_like(&mut self, other: &Subject) -> bool {
        let was = self.is_taken_up_again();
        let Some(signal) = self.position_signal() else { return false };
        let reach = other.runs.iter().map(|run| run.floors[signal].reach).fold(0.0, f64::max);
        self.runs.iter_mut().for_each(|run| run.floors[signal].reach = reach);
        if other.is_taken_up_again() {
            *self = self.in_windows().in_one_go();
        } else {
            self.leave_alone();
        }
        was || other.is_taken_up_again()
    }

    /// The same device, taken up where its machine was at the start of every window.
    pub fn in_windows(&self) -> Subject {
        let mut windowed = self.clone();
        if let Some(signal) = self.position_signal() {
            windowed.restart_at(signal, None);
        }
        windowed
    }

    /// Whether it is replayed in windows.
    pub fn is_taken_up_again(&self) -> bool {
        self.runs.iter().any(|run| run.restarts.is_some())
    }

    /// The same device, taken up where its machine was at the start of every run alone.
    pub fn in_one_go(&self) -> Subject {
        let mut whole = self.clone();
        for run in &mut whole.runs {
            if let Some(restarts) = &mut run.restarts {
                Arc::make_mut(restarts).each.truncate(1);
            }
        }
        whole
    }

    /// How far a good model may be expected to be off at the end of its windows, from how far `prediction` is off where it is
    /// not far off: it becomes the scale of the cost, so that a window that ends on the wrong side counts, and does not decide.
    pub(super) fn find_reach(&mut self, prediction: &Prediction) {
        /// The quartile of the magnitude of a normal deviate.
        const QUARTILE: f64 = 0.3186;
        let Some(signal) = self.position_signal() else { return };
        let score = self.score(prediction);
        let levels = score.signals.iter().filter(|of| of.signal == signal).filter_map(|of| of.level.as_ref());
        let off: Vec<f64> = levels.flat_map(|level| &level.difference).map(|off| off.abs()).collect();
        let reach = quantile(&off, 0.25) / QUARTILE;
        if reach.is_finite() {
            self.runs.iter_mut().for_each(|run| run.floors[signal].reach = reach);
        }
    }

    /// Replays it in one go, as any other.
    pub(super) fn leave_alone(&mut self) {
        self.runs.iter_mut().for_each(|run| run.restarts = None);
    }

    fn position_signal(&self) -> Option<usize> {
        self.signals.iter().position(|info| info.property == "position")
    }

    fn can_be_shifted(&self) -> Result<bool, EffectError> {
        let has_speed = self.kind.port("velocity").is_some();
        Ok(has_speed && self.device(&[], &Overrides::none())?.shift(Motion::default()))
    }

    /// Has every window begin where the machine was, or where the device is on a `way` of the model's; by run, how far that travels.
    fn restart_at(&mut self, signal: usize, way: Option<&Prediction>) -> Vec<f64> {
        let (position, velocity) = (self.signals[signal].port, self.kind.port("velocity").unwrap_or_default());
        let mut travels = Vec::with_capacity(self.runs.len());
        for (at, run) in self.runs.iter_mut().enumerate() {
            let values = match (way.map(|way| &way.runs[at][signal]), &run.tracks[signal]) {
                (Some(Predicted::Level(values)), _) => values.as_slice(),
                (None, Some(track)) => &track.values,
                _ => &[],
            };
            travels.push(span(values));
            let each = run.tracks[signal].as_ref().map(|track| restarts(track, values));
            run.restarts = each.map(|each| Arc::new(Restarts { position, velocity, each }));
        }
        travels
    }

    /// Whether it remembers displacements on the way that the model goes by itself: what is read in another unit than it was sent in, or with
    /// the other sign, is no place that a drive ever was at, and from there it would take long.
    fn remembers_its_own(&self, signal: usize) -> Result<bool, EffectError> {
        let mut own = self.clone();
        let travels = own.restart_at(signal, Some(&self.predict(&[], &Overrides::none())?));
        // What the model does not move says nothing.
        Ok(travels.iter().all(|travel| *travel <= 0.0) || own.remembers(signal, &travels)?)
    }

    /// Whether more than a share of a displacement at the start of a window is still there after a while, in most windows; by run, how
    /// far the device `travels`.
    fn remembers(&self, signal: usize, travels: &[f64]) -> Result<bool, EffectError> {
        let mut displaced = self.clone();
        let mut by = Vec::new();
        for (run, travels) in displaced.runs.iter_mut().zip(travels) {
            let step = DISPLACED * travels;
            if let Some(restarts) = &mut run.restarts {
                Arc::make_mut(restarts).each.iter_mut().for_each(|restart| restart.position += step);
            }
            by.push(step);
        }
        let (there, here) = (displaced.predict(&[], &Overrides::none())?, self.predict(&[], &Overrides::none())?);
        let mut left = Vec::new();
        for (at, run) in self.runs.iter().enumerate() {
            let (Some(track), Some(restarts)) = (&run.tracks[signal], &run.restarts) else { continue };
            let (Predicted::Level(one), Predicted::Level(other)) = (&here.runs[at][signal], &there.runs[at][signal])
            else {
                continue;
            };
            if by[at] <= 0.0 {
                continue;
            }
            let instants = &track.grid.instants[track.first..];
            for restart in &restarts.each {
                let [from, to] = AFTER_S.map(|after| instants.partition_point(|at| *at < restart.at + after));
                let apart = (from..to.min(one.len())).map(|k| (one[k] - other[k]).abs() / by[at]);
                left.extend(apart.reduce(f64::max));
            }
        }
        Ok(quantile(&left, 0.5) > REMEMBERED)
    }
}

/// Where something was at the first sample of every window, by its positions at the instants of `track`.
fn restarts(track: &Track, values: &[f64]) -> Vec<Restart> {
    let instants = &track.grid.instants[track.first..];
    let (Some(first), Some(last)) = (instants.first(), instants.last()) else { return Vec::new() };
    let windows = ((last - first) / WINDOW_S).floor() as usize;
    let starts = (0..=windows).map(|window| first + window as f64 * WINDOW_S);
    let mut restarts: Vec<Restart> = starts
        .map(|start| instants.partition_point(|at| *at < start - 1e-9))
        .filter(|k| *k < values.len().min(instants.len()))
        .map(|k| restart(instants, values, k))
        .collect();
    restarts.dedup_by(|a, b| a.at == b.at);
    restarts
}

/// Where the machine was at the `k`th sample, by a parabola through those about it.
fn restart(instants: &[f64], values: &[f64], k: usize) -> Restart {
    let at = instants[k];
    let about = k.saturating_sub(ABOUT)..(k + ABOUT + 1).min(values.len()).min(instants.len());
    let rows = DMatrix::from_fn(about.len(), 3, |row, power| (instants[about.start + row] - at).powi(power as i32));
    let right = DVector::from_column_slice(&values[about]);
    let parabola = rows.svd(true, true).solve(&right, 1e-12).ok();
    let number = |power: usize| parabola.as_ref().map(|found| found[power]).filter(|number| number.is_finite());
    Restart { at, position: number(0).unwrap_or(values[k]), velocity: number(1).unwrap_or(0.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn place_and_speed_of_a_parabola_are_found_exactly() {
        let instants: Vec<f64> = (0..20).map(|k| 0.005 * f64::from(k) + 0.0004 * f64::from(k % 3)).collect();
        let values: Vec<f64> = instants.iter().map(|t| 0.3 - 2.0 * t + 5.0 * t * t).collect();
        for k in [0, 7, 19] {
            let found = restart(&instants, &values, k);
            let (position, velocity) = (values[k], -2.0 + 10.0 * instants[k]);
            assert!((found.position - position).abs() < 1e-9 && (found.velocity - velocity).abs() < 1e-6, "{found:?}");
        }
    }

    #[test]
    fn a_single_sample_is_where_it_was_at_rest() {
        assert_eq!(restart(&[1.0], &[0.2], 0), Restart { at: 1.0, position: 0.2, velocity: 0.0 });
    }
}
