//! What else could be wrong with a device: every effect of the catalogue at every place of it where it could act.

use crate::catalogue::{ENTRIES, Entry, Law, Spot, is_outside};
use crate::plant::Signal;
use crate::quirk::Quirk;
use crate::robot::AXES;

/// What differs from run to run: no waveform shows it, so that none of these stands for a fixed effect, nor one of them for another.
const RANDOM: [&str; 4] = ["noise", "sampling-jitter", "lost-messages", "intermittent"];
/// Effects of a link that the catalogue has at some signals and that can befall any.
const OF_LINKS: [&str; 4] = ["dead-time", "stale-hold", "clock-drift", "input-filter"];
/// What the catalogue has on the one link, and the library on the other as well; and what it has of levels, and the library of counts.
const ALSO: &[Entry] = &[
    also("input-filter", "report-link", &[], &[Law::Share("time_constant", 0.2)]),
    also("stale-hold", "command-link", &[], &[Law::Grows("time", 0.4)]),
    also("clock-drift", "command-link", &[], &[Law::Grows("rate", 0.01)]),
    also("hysteresis", "sensor", &[("Motor", "encoder", 6500.0)], &[Law::Grows("width", 0.2)]),
];

const fn also(effect: &'static str, place: &'static str, spots: &'static [Spot], laws: &'static [Law]) -> Entry {
    Entry { effect, place, spots, laws, tolerated: 0.0 }
}

/// Strengths that the search starts from, and how far beyond it goes.
const STRENGTHS: [f64; 10] = [3e-6, 2e-5, 1e-4, 5e-4, 2e-3, 8e-3, 0.03, 0.1, 0.35, 1.0];
const WEAKEST: f64 = 1e-7;
const STRONGEST: f64 = 5.0;
/// The same of a time, s: no effect of the library may last longer, and what stands for less than that never comes.
const LONGEST_S: f64 = 10.0;

/// A parameter that is to be found.
#[derive(Clone, Debug)]
pub struct Free {
    pub name: &'static str,
    /// By its logarithm, or as it is.
    pub is_log: bool,
    pub starts: Vec<f64>,
    /// On how many sides of doing nothing these are, in turn, ever stronger; 0 where they are in no such order.
    pub sides: usize,
    pub range: (f64, f64),
    /// What is a small change of it, in the search's own terms.
    pub small: f64,
}

/// An effect with what is to be found of it.
#[derive(Clone, Debug)]
pub struct Candidate {
    pub quirk: Quirk,
    pub free: Vec<Free>,
}

/// Points of a grid.
pub struct Side {
    pub points: Vec<Vec<f64>>,
    /// Whether each is weaker than the one before it.
    pub gets_weaker: bool,
}

impl Candidate {
    /// All that the search may start from, in the search's terms; of one number the strongest of each side first.
    pub fn grid(&self) -> Vec<Side> {
        if let [free] = self.free.as_slice()
            && free.sides > 0
        {
            let side = |side: usize| {
                let starts = free.starts.iter().skip(side).step_by(free.sides).rev();
                Side { points: starts.map(|start| vec![*start]).collect(), gets_weaker: true }
            };
            return (0..free.sides).map(side).collect();
        }
        let mut points = vec![Vec::new()];
        for free in &self.free {
            let with =
                |at: &Vec<f64>| free.starts.iter().map(|start| [at.as_slice(), &[*start]].concat()).collect::<Vec<_>>();
            points = points.iter().flat_map(with).collect();
        }
        vec![Side { points, gets_weaker: false }]
    }

    /// With these values of its free parameters, in the search's terms.
    pub fn at(&self, values: &[f64]) -> Quirk {
        let mut quirk = self.quirk.clone();
        for (free, value) in self.free.iter().zip(values) {
            quirk.parameters.push((free.name.to_owned(), if free.is_log { value.exp() } else { *value }));
        }
        quirk
    }
}

/// Whether an effect differs from run to run.
pub fn is_random(effect: &str) -> bool {
    RANDOM.contains(&effect)
}

/// How many numbers an effect of the catalogue leaves to be found.
pub fn freedom(truth: &Quirk) -> usize {
    laws(truth).filter(|law| is_free(law)).count()
}

fn laws(quirk: &Quirk) -> impl Iterator<Item = &'static Law> {
    let is_it = |entry: &&Entry| entry.effect == quirk.effect && entry.place == quirk.place;
    ENTRIES.iter().find(is_it).into_iter().flat_map(|entry| entry.laws)
}

/// The numbers of an effect that are to be found, each with the value at which it does nothing, where that is known; else 0, and its size
/// is taken as a whole.
pub fn numbers(quirk: &Quirk) -> impl Iterator<Item = (&'static str, f64)> {
    laws(quirk).filter(|law| is_free(law)).map(|law| match law {
        Law::About1(name, _) => (*name, 1.0),
        Law::Wrong(_) => ("value", 0.0),
        Law::Grows(name, _)
        | Law::Either(name, _)
        | Law::Below(name, _)
        | Law::Above(name, _)
        | Law::Share(name, _)
        | Law::Is(name, _)
        | Law::Within(name, ..)
        | Law::OneOf(name, _) => (*name, 0.0),
    })
}

fn is_free(law: &Law) -> bool {
    match law {
        Law::Is(..) | Law::OneOf(..) => false,
        Law::Within(_, low, high) => low < high,
        _ => true,
    }
}

/// How many numbers what stands in the place of an effect that no file describes may have at least: nobody counts that one's.
const OF_THE_UNKNOWN: usize = 2;

/// All that could stand in the place of `truth` on its device, with no more to be found than the truth has, the truth's own kind not
/// among them. `device` is the one that it acts on, with `signals`.
pub fn candidates(truth: &Quirk, device: &str, signals: &[Signal]) -> Vec<Candidate> {
    let least = if is_outside(&truth.effect) { OF_THE_UNKNOWN } else { 0 };
    let freedom = freedom(truth).max(least);
    all(truth, device, signals)
        .into_iter()
        .filter(|candidate| candidate.free.len() <= freedom && candidate.quirk.member() != truth.member())
        .collect()
}

/// The truth's own kind, to be found again.
#[cfg(test)]
pub fn own(truth: &Quirk, device: &str, signals: &[Signal]) -> Vec<Candidate> {
    let is_own = |candidate: &Candidate| candidate.quirk.member() == truth.member();
    all(truth, device, signals).into_iter().filter(is_own).collect()
}

fn all(truth: &Quirk, device: &str, signals: &[Signal]) -> Vec<Candidate> {
    let axis = axis(truth.component.as_deref().unwrap_or_default());
    let mut found = Vec::new();
    for entry in ENTRIES.iter().chain(ALSO).filter(|entry| !is_outside(entry.effect) && !is_random(entry.effect)) {
        for spot in spots(entry, truth, device, axis, signals) {
            found.extend(with(entry, &spot));
        }
    }
    found
}

/// Where an effect may act: device, component and scale.
type Place = (String, String, f64);

fn spots(entry: &Entry, truth: &Quirk, device: &str, axis: Option<&str>, signals: &[Signal]) -> Vec<Place> {
    // The bay that feeds the belt is told by the belt's barriers alone.
    let is_near = |spot: &&Spot| spot.0 == device || spot.0 == "Feed" && device == "Belt";
    let known: Vec<&Spot> = entry.spots.iter().filter(is_near).collect();
    let mut places: Vec<Place> = known
        .iter()
        .map(|(device, component, scale)| ((*device).to_owned(), (*component).to_owned(), *scale))
        .collect();
    let also = |component: &str, scale: f64| (device.to_owned(), component.to_owned(), scale);
    // The wires of one signal may be crossed; a whole link's are not.
    let is_link = OF_LINKS.contains(&entry.effect);
    if is_link || entry.effect == "inverted" {
        places.extend(is_link.then(|| also("", 1.0)));
        let reports = signals.iter().map(|signal| signal.parts().1);
        let commands = crate::rig::commands();
        let commands = commands.iter().filter_map(|(name, _)| name.split_once('.'));
        let commands = commands.filter(|(of, _)| *of == device).map(|(_, port)| port);
        match entry.place {
            "report-link" => places.extend(reports.map(|port| also(port, 1.0))),
            _ => places.extend(commands.map(|port| also(port, 1.0))),
        }
    } else if let (Some(axis), Some(first)) = (axis, known.first()) {
        // What the catalogue has at one axis befalls the others as well.
        if let Some(other) = self::axis(first.1) {
            let component = if first.1.ends_with("Target") {
                format!("{axis}Target")
            } else {
                format!("{}{axis}", first.1.strip_suffix(other).unwrap_or_default())
            };
            // R turns about twice as fast as the others go.
            let ratio = if axis == "R" { 2.0 } else { 1.0 } / if other == "R" { 2.0 } else { 1.0 };
            places.push(also(&component, ratio * first.2));
        }
    }
    places.retain(|(_, component, _)| {
        let of = self::axis(component);
        of.is_none() || of == axis
    });
    let own = (truth.device.clone(), truth.component.clone().unwrap_or_default());
    places.sort_by(|a, b| (&a.0, &a.1).cmp(&(&b.0, &b.1)));
    places.dedup_by(|a, b| (&a.0, &a.1) == (&b.0, &b.1));
    let is_single = signals.len() == 1;
    places.retain(|(of, component, _)| {
        // A link with one report has one name.
        let is_twice = entry.place == "report-link" && is_single && component.is_empty();
        !is_twice || (of, component) == (&own.0, &own.1)
    });
    places
}

/// The axis that a component belongs to, where it belongs to one.
pub fn axis(component: &str) -> Option<&'static str> {
    AXES.into_iter().find(|axis| {
        let stem = component.strip_suffix(axis);
        component.strip_suffix("Target") == Some(axis)
            || stem.is_some_and(|stem| ["", "actualPos", "maxVelocity", "maxAcceleration"].contains(&stem))
    })
}

/// The effect at a place, once for each choice among values that are given.
fn with(entry: &Entry, place: &Place) -> Vec<Candidate> {
    let (device, component, scale) = place;
    let quirk = Quirk {
        device: device.clone(),
        component: (!component.is_empty()).then(|| component.clone()),
        effect: entry.effect.to_owned(),
        place: entry.place.to_owned(),
        parameters: Vec::new(),
        with: None,
    };
    let mut candidates = vec![Candidate { quirk, free: Vec::new() }];
    for law in entry.laws {
        match *law {
            Law::OneOf(name, values) => {
                let each = |candidate: &Candidate| {
                    let with = |value: &f64| {
                        let mut one = candidate.clone();
                        one.quirk.parameters.push((name.to_owned(), *value));
                        one
                    };
                    values.iter().map(with).collect::<Vec<_>>()
                };
                candidates = candidates.iter().flat_map(each).collect();
            }
            Law::Is(name, value) | Law::Within(name, value, _) if !is_free(law) => {
                candidates.iter_mut().for_each(|one| one.quirk.parameters.push((name.to_owned(), scale * value)));
            }
            _ => candidates.iter_mut().for_each(|one| one.free.extend(free(law, *scale))),
        }
    }
    candidates
}

/// A parameter that is to be found, with where to begin: never where it does nothing.
fn free(law: &Law, scale: f64) -> Option<Free> {
    let log = |name, starts: Vec<f64>, low: f64, high: f64| {
        let range = (low.ln(), high.ln());
        Some(Free {
            name,
            is_log: true,
            starts: starts.into_iter().map(f64::ln).collect(),
            sides: 1,
            range,
            small: 1e-3,
        })
    };
    let line = |name, middle: f64, most: f64| {
        let starts = STRENGTHS.iter().flat_map(|s| [middle - most * s, middle + most * s]).collect();
        let range = (middle - STRONGEST * most, middle + STRONGEST * most);
        Some(Free { name, is_log: false, starts, sides: 2, range, small: 1e-5 * most })
    };
    let in_no_order = |free: Option<Free>| free.map(|free| Free { sides: 0, ..free });
    let grows = |name, most: f64| {
        let is_time = ["time", "time_constant"].contains(&name);
        let strongest = if is_time { LONGEST_S } else { most * STRONGEST };
        let starts = STRENGTHS.iter().map(|s| most * s).chain(is_time.then_some(LONGEST_S));
        log(name, starts.collect(), most * WEAKEST, strongest)
    };
    match *law {
        Law::Grows(name, most) => grows(name, scale * most),
        Law::Share(name, most) => grows(name, most),
        Law::About1(name, most) => line(name, 1.0, most),
        Law::Either(name, most) => line(name, 0.0, scale * most),
        // The machine's own value is another than the nominal one, whose neighbours do not do nothing.
        Law::Wrong(most) => in_no_order(line("value", scale, scale * most)),
        Law::Below(name, _) => {
            // What a limit is compared with may lie a little above the scale.
            let shares = [1.08, 1.0, 0.97, 0.92, 0.85, 0.75, 0.6, 0.45, 0.3, 0.2, 0.1, 0.05];
            log(name, shares.iter().map(|share| scale * share).collect(), 0.005 * scale, 1.5 * scale)
        }
        Law::Above(name, least) => {
            let starts = STRENGTHS.iter().map(|s| scale * least / s).collect();
            log(name, starts, scale * least / STRONGEST, scale * least / WEAKEST)
        }
        Law::Within(name, low, high) if low > 0.0 => {
            let (low, high) = (scale * low, scale * high);
            in_no_order(log(name, vec![low, (low * high).sqrt(), high], 0.1 * low, 10.0 * high))
        }
        Law::Within(name, low, high) => in_no_order(line(name, 0.5 * scale * (low + high), 0.5 * scale * (high - low))),
        Law::Is(..) | Law::OneOf(..) => None,
    }
}
