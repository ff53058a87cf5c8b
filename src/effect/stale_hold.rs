//! `stale-hold`: a signal is refreshed only every `time`, and stands in between.
//!
//! Source: the sampler with a zero-order hold (K. J. Åström, B. Wittenmark, Computer-Controlled Systems, Prentice Hall 1997,
//! section 2.3). A measured quantity that is refreshed more often than it is looked at is looked up on straight lines between those looks, a
//! millisecond apart.

use super::line::History;
use super::table::{BASE, time};
use crate::device::law::SAME_INSTANT_S;
use crate::device::path::{Moment, STRETCH_S, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, SignalClass, Site};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "stale-hold",
    summary: "a signal is refreshed only now and then, and stands in between",
    equation: "y(t) = x(k·time), k·time ≤ t < (k + 1)·time",
    source: "Åström, Wittenmark, Computer-Controlled Systems, Prentice Hall 1997, 2.3",
    places: &[EffectPlace::CommandLink, EffectPlace::ReportLink],
    fits: &[Fit::Signals(SignalClass::Any)],
    parameters: &[time("time", 0.1, "from one refresh to the next")],
    excited_by: "changes of the signal",
    build: Build::Stage(|values, site| StaleHold::stage(values[0], site)),
    ..BASE
};

/// What is refreshed more often, s, is so whenever it is looked at: at 10 m/s nothing goes 0.1 mm meanwhile, and a stop at each refresh
/// would have a second take forever.
const SHORTEST_S: f64 = 1e-5;

#[derive(Clone, Debug)]
struct StaleHold {
    time: f64,
    /// Whether the signal moves all the time, and not in steps of which each is told at its instant.
    is_smooth: bool,
    /// The window that the signal was refreshed in.
    window: Option<u64>,
    /// What stands at the entry.
    entry: f64,
    held: f64,
    /// What it was before, of a signal whose refreshes nobody waits for.
    history: Option<History>,
}

impl StaleHold {
    fn stage(time: f64, site: &Site) -> Box<dyn Stage> {
        let is_smooth = site.is_smooth();
        // A stop at each refresh would have a replay take as many steps as there are.
        let is_looked_up = is_smooth && (SHORTEST_S..STRETCH_S).contains(&time);
        let history = is_looked_up.then(|| History::new(true, site.is_whole()));
        Box::new(StaleHold { time, is_smooth, window: None, entry: 0.0, held: 0.0, history })
    }
}

impl Stage for StaleHold {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        if self.history.is_some() { STRETCH_S } else { f64::INFINITY }
    }

    fn count_finely(&mut self) {
        if let Some(history) = &mut self.history {
            history.count_finely();
        }
    }

    fn next_change(&self) -> Option<f64> {
        let waits = self.history.is_none() && self.time >= SHORTEST_S && (self.is_smooth || self.entry != self.held);
        self.window.filter(|_| waits).map(|window| (window + 1) as f64 * self.time)
    }

    fn signal(&mut self, value: f64, moment: Moment) -> f64 {
        if self.time == 0.0 {
            return value;
        }
        let window = ((moment.now + SAME_INSTANT_S) / self.time) as u64;
        if let Some(history) = &mut self.history {
            let refreshed = (window as f64 * self.time).min(moment.now);
            history.note(moment.now, value);
            return history.at(refreshed, refreshed);
        }
        // However often it is looked at in the instant of a refresh, the last look is what stands.
        let is_at_refresh = moment.now <= window as f64 * self.time + SAME_INSTANT_S;
        if is_at_refresh {
            self.held = value;
        } else if self.window != Some(window) {
            // A step that nobody waited for came after the refresh of its window.
            let is_taken = self.is_smooth || self.window.is_none() || self.time < SHORTEST_S;
            self.held = if is_taken { value } else { self.entry };
        }
        self.window = Some(window);
        self.entry = value;
        self.held
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.entry);
        visit(self.held);
        if let Some(history) = &self.history {
            history.state(visit);
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn it_stands_between_refreshes() {
        let hold = spec("report-link", "stale-hold", Some("velocityActual"), &[("time", 0.1)]);
        let mut belt = with("StraightConveyor", &[], &[hold]);
        belt.check(&[("velocityTarget", 0.5), ("motorDirection", 1.0)], 0.15, &[("velocityActual", 0.1)]);
        belt.check(&[], 0.0499, &[("velocityActual", 0.1)]);
        belt.check(&[], 0.0002, &[("velocityActual", 0.2)]);
    }

    /// At 1 m/s² a belt has been refreshed last after 449 times 0.4 ms: at 0.1796 m/s; and is looked up there.
    #[test]
    fn what_is_refreshed_often_is_what_it_was_at_the_last_refresh() {
        let hold = spec("report-link", "stale-hold", Some("velocityActual"), &[("time", 4e-4)]);
        let mut belt = with("StraightConveyor", &[], &[hold]);
        belt.check(&[("velocityTarget", 0.5), ("motorDirection", 1.0)], 0.1799, &[]);
        assert!((belt.report("velocityActual") - 0.1796).abs() < 1e-9, "{}", belt.report("velocityActual"));
        belt.check(&[], 0.0002, &[]);
        assert!((belt.report("velocityActual") - 0.18).abs() < 1e-9, "{}", belt.report("velocityActual"));
    }

    /// A step after five refreshes that had nothing to show waits for the sixth, and one at a refresh for none.
    #[test]
    fn a_step_waits_for_the_next_refresh() {
        let hold = || spec("report-link", "stale-hold", Some("driveEnabled"), &[("time", 0.125)]);
        let start = [("velocityTarget", 0.5), ("motorDirection", 1.0)];
        let mut belt = with("StraightConveyor", &[], &[hold()]);
        belt.check(&[], 0.7, &[("driveEnabled", 0.0)]);
        belt.check(&start, 0.0499, &[("driveEnabled", 0.0)]);
        belt.check(&[], 0.0002, &[("driveEnabled", 1.0)]);
        let mut belt = with("StraightConveyor", &[], &[hold()]);
        belt.check(&[], 0.75, &[("driveEnabled", 0.0)]);
        belt.check(&start, 0.0, &[("driveEnabled", 1.0)]);
    }

    /// One that would be refreshed a thousand million times in this second.
    #[test]
    fn refreshes_that_nobody_sees_take_no_time() {
        let hold = spec("report-link", "stale-hold", Some("velocityActual"), &[("time", 1e-9)]);
        let mut belt = with("StraightConveyor", &[], &[hold]);
        belt.check(&[("velocityTarget", 0.5), ("motorDirection", 1.0)], 0.15, &[("velocityActual", 0.15)]);
        belt.check(&[], 0.85, &[("velocityActual", 0.5)]);
    }
}
