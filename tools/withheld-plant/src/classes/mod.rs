//! Which effects a recording cannot tell apart, whoever looks at it: the class of the one that the machine has.
//!
//! Another effect of the library is in the class when it can be refitted to the machine's own noise-free output, together with all that is
//! unknown of the machine, so that what is left lies within D = 4.2: a test of 1 % error finds that with less than 95 % power. D is that of
//! the magnitudes.
//!
//! What is unknown of the machine, and refitted: every measure of the device within its tolerance and the filter of its flags, each at the
//! price of the square of its standard deviations. The age of the reports and the phase of the task are the same for all devices, and
//! those that are well tell them far more closely than the one that is not: they stay as they are.
//!
//! An effect that leaves more numbers to be found than the true one is no member: whatever holds another as a special case would be in
//! its class always. Of two effects the class of each is that beside the other, whose numbers nobody knows either: they are refitted as well, at a price of
//! the square of how many times e they are off. What differs from run to run (noise, lost messages, a loose contact, jitter of a link) is alone against others of its sort:
//! no two of them have the same statistics (white, in repeats, in zeros, in time), and none repeats a fixed effect's output. But a fixed effect that comes within 4.2 of what chance did would be
//! in its class.

mod alone;
mod apart;
mod candidate;
mod refit;

#[cfg(test)]
mod tests;

use std::cell::OnceCell;

pub use alone::{Alone, MOTIONS, Number, numbers_at, with_number};
pub use refit::SMALL;

use alone::Unknowns;
use apart::Measure;
use candidate::Candidate;
use refit::{Fit, Goal};

use crate::quirk::{Member, Quirk};

/// Two effects are one class within this distance: fixed before any case was drawn. Of a normal deviate with the mean 4.2, 95 of 100 lie
/// above 2.576, the bound of a two-sided test of 1 % error.
pub const SAME: f64 = 4.2;

/// A first look at so much of the recording at least, and until the effect shows this much of D², s.
const FIRST: f64 = 8.0;
const SHOWS: f64 = 400.0;
/// The grid comes within a factor of three of the best strength, which leaves no more than this share of the D of the whole effect.
const PROMISING: f64 = 0.85;
/// D of signals that a candidate leaves alone: three times [`SAME`], as edges are known no better.
const FOREIGN: f64 = 12.6;
/// What is farther off than this after the steps is not polished: as much of the D of the whole effect, and beside it so much.
const HOPELESS: (f64, f64) = (0.05, 25.0);

/// The class of `truth` on the device that is heard until `end`, itself first.
pub fn class(device: &Alone<'_>, truth: &Quirk, end: f64) -> Vec<Member> {
    let measure = Measure::new(device, &device.signals());
    let look = Look::new(device, &measure, truth, end);
    let mut class = vec![truth.member()];
    for candidate in device.candidates(truth) {
        let member = device.here(candidate.quirk.clone()).member();
        let is_there = device.others.iter().any(|other| other.member() == member);
        if !is_there && !class.contains(&member) && look.distance(&candidate) <= SAME {
            class.push(member);
        }
    }
    once(class)
}

impl Alone<'_> {
    /// All that could stand in the place of `truth`, in the words and to the scale of the rig's device of its kind.
    fn candidates(&self, truth: &Quirk) -> Vec<Candidate> {
        let as_rigs = Quirk { device: self.built.kind(&truth.device), ..truth.clone() };
        candidate::candidates(&as_rigs, &self.built.kind(self.device), &self.signals())
    }

    /// What is said of the rig's device, of this one.
    fn here(&self, quirk: Quirk) -> Quirk {
        self.built.fitted(quirk)
    }
}

/// A link as a whole and one of its signals are one effect at one place: the truth's own name of it stays, or the whole's.
fn once(class: Vec<Member>) -> Vec<Member> {
    let is_link = |member: &Member| member.place.ends_with("-link");
    let mut kept: Vec<Member> = Vec::new();
    for member in &class {
        let same = |other: &&Member| {
            is_link(member)
                && other.device == member.device
                && other.effect == member.effect
                && other.place == member.place
        };
        let first = class.iter().find(same);
        let whole = class.iter().filter(same).find(|other| other.component.is_none());
        let name = if first == class.first() { first } else { whole };
        if name.is_none_or(|name| name == member) {
            kept.push(member.clone());
        }
    }
    kept
}

/// A truth to be imitated: on a part of the recording first, for what cannot do it there cannot do it on the whole.
struct Look<'a> {
    first: Goal<'a>,
    /// On the whole recording: made when the first candidate comes so far.
    whole: OnceCell<Goal<'a>>,
    end: f64,
    /// D² of the effect on the first part.
    shows: f64,
    ports: Vec<String>,
}

impl<'a> Look<'a> {
    fn new(device: &'a Alone<'a>, measure: &'a Measure, truth: &'a Quirk, end: f64) -> Look<'a> {
        let truth = std::slice::from_ref(truth);
        let (mut part, mut shows) = (FIRST.min(end), 0.0);
        while part < end && shows < SHOWS {
            let heard = |quirks: &[Quirk]| device.hear(quirks, &Unknowns::default(), part);
            shows = measure.squared(&heard(truth), &heard(&[]));
            part = if shows < SHOWS { (1.6 * part).min(end) } else { part };
        }
        let first = Goal::new(device, measure, truth, part);
        let shows = first.shows(&|_| true);
        let ports = device.signals().iter().map(|signal| signal.parts().1.to_owned()).collect();
        Look { first, whole: OnceCell::new(), end, shows, ports }
    }

    /// How near the candidate comes to the truth. Of what comes nowhere near [`SAME`], not all the way.
    fn distance(&self, candidate: &Candidate) -> f64 {
        let quirk = &candidate.quirk;
        if let (Some(port), "sensor" | "report-link") = (&quirk.component, quirk.place.as_str()) {
            // It leaves all other signals as they would be without any effect.
            let others = self.first.shows(&|signal| self.ports[signal] != *port);
            if others > FOREIGN * FOREIGN {
                return others.sqrt();
            }
        }
        let starts = self.first.starts(candidate, PROMISING * PROMISING * self.shows);
        let fits = starts.into_iter().map(|start| self.first.descend(candidate, start));
        let Some(best) = fits.min_by(|a, b| a.squared.total_cmp(&b.squared)) else { return f64::INFINITY };
        let distance = |fit: &Fit| fit.squared.sqrt();
        if distance(&best) > HOPELESS.1 + HOPELESS.0 * self.shows.sqrt() {
            return distance(&best);
        }
        let best = self.first.polish(candidate, best, SAME * SAME, 60);
        if distance(&best) > 2.0 * SAME {
            return distance(&best);
        }
        let Goal { device, measure, quirks, .. } = &self.first;
        let whole = self.whole.get_or_init(|| Goal::new(device, measure, quirks, self.end));
        let best = whole.polish(candidate, whole.descend(candidate, best), SAME * SAME, 150);
        distance(&best)
    }
}
