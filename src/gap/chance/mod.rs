//! Effects that draw anew each time: a loose contact, reports that get lost, a sensor that scatters.
//!
//! No prediction repeats what was drawn, so none of them can be fitted as the others are. But each leaves a mark of its own in the
//! recording: of a loose contact every sample is as predicted or 0, of lost reports it is as predicted or what was last reported.
//! What was drawn is read off the recording sample by sample, taken out of it, and what is left is looked at as ever: with nothing
//! left, the effect is the answer; else it stands beside what explains the rest. A sensor that scatters takes nothing out: its
//! noise is in the floor already, and stands out of that of all others. Commands that jitter are put off by what each came late.
//! A sensor that reads in steps draws nothing, but no slope leads to
//! them either: they are read off in the same way, and the floor is theirs then.

mod apart;
mod itself;
mod jitter;
mod known;
mod late;
mod read;
mod scatter;
mod steps;
mod tries;

use super::cause::{Bare, Bounds, Candidate, Free, misfit};
use super::evidence;
use super::fit::Range;
use super::floor::Floor;
use super::locate::{THRESHOLD, evidence_of};
use super::overrides::Overrides;
use super::prediction::Prediction;
use super::study::Study;
use super::subject::{Subject, Timing};
use crate::effect::EFFECTS;
use crate::plant::{EffectPlace, EffectSpec};
use known::Known;
use late::{Late, MOST_S};
use read::{Law, Reading};
use steps::Steps;

/// An effect that draws, found in the training.
#[derive(Clone, Debug)]
pub struct Chance {
    pub candidate: Candidate,
    /// One for each of its parameters.
    pub bounds: Vec<Bounds>,
    /// The device without what was drawn, and its nominal parameters fitted anew.
    pub subject: Subject,
    pub bare: Bare,
    /// By how many floors squared the device is off by it, over all samples.
    pub misfit: f64,
    drawn: Drawn,
    signals: Vec<usize>,
    /// A sensor that scatters, beside what else was drawn.
    pub beside: Option<Box<Chance>>,
}

/// What is taken out of a recording.
#[derive(Clone, Copy, Debug)]
enum Drawn {
    /// What a law drew, read beside what the model predicts.
    By(Law),
    /// The same, read off the recording by itself.
    ByItself(Law),
    /// The same, read beside what the model predicts with the effects that were found without it.
    Beside(Law),
    /// What a report adds to the steps of its sensor.
    In(Steps),
    /// What commands came late by, up to so long, s.
    Late(f64),
    /// Nothing.
    Noise,
}

impl Chance {
    /// It and what stands beside it.
    pub fn all(&self) -> impl Iterator<Item = &Chance> {
        std::iter::once(self).chain(self.beside.as_deref())
    }

    /// Another recording of the device as it would be judged without the effect.
    pub fn judged_without(&self, subject: &Subject) -> Option<Subject> {
        if let Drawn::Late(most_s) = self.drawn {
            return Late::seen((subject, most_s), Known::bare(&self.bare.overrides));
        }
        let Drawn::In(steps) = self.drawn else { return None };
        let mut other = subject.clone();
        for run in &mut other.runs {
            self.signals.iter().for_each(|signal| run.floors[*signal] = steps.without(run.floors[*signal]));
        }
        Some(other)
    }

    /// Another recording of the device without what was drawn there, its effects and its nominal parameters as `specs` and `overrides` say.
    pub fn taken_out(&self, subject: &Subject, specs: &[EffectSpec], overrides: &Overrides) -> Option<Subject> {
        if let Drawn::Late(most_s) = self.drawn {
            return Some(Late::known((subject, most_s), Known { specs, overrides }, &|| false)?.put_off(subject));
        }
        let specs = if matches!(self.drawn, Drawn::Beside(_)) { specs } else { &[] };
        let prediction = subject.predict(specs, overrides).ok()?;
        let mut other = subject.clone();
        if let Drawn::ByItself(law) = self.drawn {
            Readings::by_themselves(subject, &prediction, law).take_out_of_all(&mut other);
            return Some(other);
        }
        for signal in &self.signals {
            match self.drawn {
                Drawn::By(law) | Drawn::Beside(law) => {
                    if let Some(reading) = Reading::of(&other, &prediction, *signal, law, true) {
                        reading.take_out(&mut other, *signal, law);
                    }
                }
                Drawn::In(steps) => {
                    steps.take_out(&mut other, &prediction, *signal);
                    let trained = self.subject.runs.first()?.floors[*signal];
                    for floor in other.runs.iter_mut().map(|run| &mut run.floors[*signal]) {
                        *floor = Floor { timing: floor.timing, ..trained };
                    }
                }
                Drawn::ByItself(_) | Drawn::Late(_) | Drawn::Noise => return None,
            }
        }
        Some(other)
    }
}

/// What was drawn of a device beside what `specs` and `overrides` predict of it: of what was `found` by itself, which was seen only where the device moved on
/// and on, or, where nothing was, what those effects leave.
pub fn beside(
    (subject, bare): (&Subject, &Bare),
    (specs, overrides): (&[EffectSpec], &Overrides),
    found: Option<&Chance>,
    is_asked: &(dyn Fn(&str) -> bool + Sync),
) -> Option<Chance> {
    let prediction = subject.predict(specs, overrides).ok()?;
    let all = 0..subject.signals.len();
    let shown = |law: &Law| is_asked(law.id()) && Readings::of(subject, &prediction, all.clone(), *law, false).is_so();
    let law = match found.map(|found| found.drawn) {
        Some(Drawn::ByItself(law)) => law,
        Some(_) => return None,
        None => [Law::Away, Law::Lost].into_iter().find(shown)?,
    };
    let readings = match (law, found) {
        (Law::Away, Some(found)) => Readings::of(subject, &prediction, found.signals.iter().copied(), law, false),
        _ => Readings::of(subject, &prediction, all, law, law == Law::Lost),
    };
    if readings.each.is_empty() {
        return None;
    }
    let mut other = subject.clone();
    readings.take_out(&mut other);
    let (other, bare) = without(other, bare, Some(&prediction))?;
    let anew = readings.named((subject, other, bare), Drawn::Beside(law))?;
    Some(Chance { beside: found.and_then(|found| found.beside.clone()), ..anew })
}

/// What commands that come late by times of their own show.
const JITTER: &str = "sampling-jitter";

/// Whether an effect delays what a device is told, or what it says.
fn delays(spec: &EffectSpec) -> bool {
    const DELAYS: [&str; 4] = ["dead-time", "first-order-lag", "input-filter", "stale-hold"];
    DELAYS.contains(&spec.kind.as_str())
}

/// What commands of a device came late by beside what `specs` and `overrides` predict of it, whatever that leaves: beside those effects that are no delays, as one
/// may be what commands are late by on average, or beside all.
pub fn late_beside(
    (subject, bare): (&Subject, &Bare),
    (specs, overrides): (&[EffectSpec], &Overrides),
    is_asked: &(dyn Fn(&str) -> bool + Sync),
    is_stopped: &(dyn Fn() -> bool + Sync),
) -> Option<Chance> {
    if !is_asked(JITTER) {
        return None;
    }
    let beside = |specs: &[EffectSpec]| {
        let known = Known { specs, overrides };
        let mut late = Late::of((subject, MOST_S), known, is_stopped)?;
        let overrides = late.with_nominal(subject, known, &bare.nuisances);
        let sigma = late.sigma()?;
        jittering((subject, MOST_S), put_off(subject, &Bare { overrides, ..bare.clone() }, &late)?, sigma)
    };
    let others: Vec<EffectSpec> = specs.iter().filter(|spec| !delays(spec)).cloned().collect();
    beside(&others).or_else(|| if others.len() < specs.len() { beside(specs) } else { None })
}

/// How much of a device's evidence may be left for what was taken out to have been all of it; else it must have been most of it.
const MOST_LEFT: f64 = 0.05;
/// How many deviations long the longest of some dozen delays are.
const DEVIATIONS: f64 = 3.0;
/// How late commands may come to a device that reports states alone, with a switch of its that is late besides, s.
const WITH_A_SWITCH_S: f64 = 0.4;

/// How often what was drawn and the nominal parameters are found anew, each beside the other.
const ROUNDS: usize = 3;

/// Looks for effects that draw in what `bare` leaves of the device at `place` of the study. `is_asked` says of an effect's id whether it is
/// looked for, `is_stopped` whether the answer is wanted now.
pub fn find(
    place: usize,
    study: &Study,
    is_asked: &(dyn Fn(&str) -> bool + Sync),
    is_stopped: &(dyn Fn() -> bool + Sync),
) -> Option<Chance> {
    let (subject, bare) = (&study.subjects[place], &study.bare[place]);
    if subject.is_taken_up_again() {
        return lost_amid(subject, bare, is_asked);
    }
    let before = evidence(subject, &bare.prediction);
    let has_gap = before > THRESHOLD;
    // What reads 0 while it should be far from that is no noise, however little of it there is.
    let laws: &[Law] = if has_gap { &[Law::Away, Law::Lost] } else { &[Law::Away] };
    let by_reading = || laws.iter().find_map(|law| taken_out(subject, bare, before, *law, is_asked));
    let found = if is_asked("quantisation") { in_steps(place, study) } else { None };
    let late_by = |most_s: f64| late((subject, bare), (before, most_s), is_stopped);
    // A command that comes late delays all that follows from it alike, and a report that is lost each by itself.
    let found = found.or_else(|| if has_gap && is_asked(JITTER) { late_by(MOST_S) } else { None });
    let may_be_later = has_gap && is_asked(JITTER) && !subject.has_levels();
    let found = found.or_else(|| if may_be_later { late_by(WITH_A_SWITCH_S) } else { None });
    let by_itself = || laws.iter().find_map(|law| taken_out_by_itself(subject, bare, *law, is_asked));
    let found = found.or_else(by_reading).or_else(|| if has_gap { by_itself() } else { None });
    let found = found.or_else(|| lost_amid(subject, bare, is_asked));
    let scatters = |own: (&Subject, &Bare), has_gap: bool, drawn: &[usize]| {
        if is_asked("noise") { scatter::find(place, study, own, has_gap, drawn) } else { None }
    };
    match found {
        // What is read in coarse steps seems to scatter by them.
        Some(found) if matches!(found.drawn, Drawn::In(_)) => Some(found),
        Some(mut found) => {
            let is_left = evidence(&found.subject, &found.bare.prediction) > THRESHOLD;
            found.beside = scatters((&found.subject, &found.bare), is_left, &found.signals).map(Box::new);
            Some(found)
        }
        None => scatters((subject, bare), has_gap, &[]),
    }
}

/// The device without what a law drew of its signals, if that explains it. `before`: its evidence with what was drawn.
fn taken_out(
    subject: &Subject,
    bare: &Bare,
    before: f64,
    law: Law,
    is_asked: &(dyn Fn(&str) -> bool + Sync),
) -> Option<Chance> {
    if !is_asked(law.id()) {
        return None;
    }
    let read_all =
        |bare: &Bare, is_known: bool| Readings::of(subject, &bare.prediction, 0..subject.signals.len(), law, is_known);
    let beside = |bare: &Bare| {
        let shown = read_all(bare, false);
        let count = shown.each.len();
        // Several that are away are so for another reason: a drive that does not start has no speed, and does not run.
        if count == 0 || law == Law::Away && count > 1 {
            return None;
        }
        // Reports get lost of a whole link, a contact is one signal's.
        let readings = if law == Law::Lost && count > 1 { read_all(bare, true) } else { shown };
        let mut other = subject.clone();
        readings.take_out(&mut other);
        let (other, bare) = without(other, bare, None)?;
        Some((readings, other, bare))
    };
    // What was drawn may have spoilt the nominal parameters so that it cannot be read beside them.
    let nominal = || {
        let prediction = subject.predict(&[], &Overrides::none()).ok()?;
        Some(Bare { overrides: Overrides::none(), prediction, ..bare.clone() })
    };
    let (mut readings, mut other, mut bare) = beside(bare).or_else(|| beside(&nominal()?))?;
    // What was drawn had a part in the nominal parameters that it was read beside.
    for _ in 1..ROUNDS {
        if evidence(&other, &bare.prediction) <= THRESHOLD {
            break;
        }
        (readings, other, bare) = beside(&bare)?;
    }
    let are_whatever_is_read = || readings.each.iter().all(|(_, reading)| reading.is_whatever_is_read());
    if before <= THRESHOLD && !are_whatever_is_read() {
        return None;
    }
    // What is left of other signals than those with a loose contact is another effect's; reports get lost of all alike.
    let is_of_others = || {
        law == Law::Away
            && are_whatever_is_read()
            && readings.each.iter().all(|(signal, _)| evidence_of(*signal, &other, &bare.prediction) <= THRESHOLD)
    };
    if evidence(&other, &bare.prediction) > THRESHOLD.max(MOST_LEFT * before) && !is_of_others() {
        return None;
    }
    readings.named((subject, other, bare), Drawn::By(law))
}

/// What a law drew of a device, signal by signal.
struct Readings {
    law: Law,
    each: Vec<(usize, Reading)>,
}

impl Readings {
    /// Of these signals, those that show it beside a prediction; `is_known`: another signal has shown it already.
    fn of(
        subject: &Subject,
        prediction: &Prediction,
        signals: impl IntoIterator<Item = usize>,
        law: Law,
        is_known: bool,
    ) -> Readings {
        let read = |signal: usize| Some((signal, Reading::of(subject, prediction, signal, law, is_known)?));
        Readings { law, each: signals.into_iter().filter_map(read).collect() }
    }

    /// Of the levels that show it by themselves.
    fn by_themselves(subject: &Subject, bare: &Prediction, law: Law) -> Readings {
        let (itself, levels) = itself::of(subject, bare, law);
        Readings::of(subject, &itself, levels, law, false)
    }

    /// Whether it is what it was by all that is known of the law: a contact is one signal's, and is loose whatever should be read; reports are lost by chance.
    fn is_so(&self) -> bool {
        match (self.law, self.each.as_slice()) {
            (Law::Away, [(_, reading)]) => reading.is_whatever_is_read(),
            (Law::Away, _) => false,
            // The signal that shows the most of it misses the least.
            (Law::Lost, each) => {
                let most = each.iter().map(|(_, reading)| reading).max_by_key(|reading| reading.drawn());
                most.is_some_and(Reading::is_drawn_each_time)
            }
        }
    }

    /// Whether single reports were lost: some, and next to nothing else, amid motions that went as predicted before and behind each. Noise does nothing of the kind.
    fn are_amid(&self) -> bool {
        const FEWEST: usize = 3;
        const MOST: f64 = 0.7;
        let sum = |of: fn(&Reading) -> usize| self.each.iter().map(|(_, reading)| of(reading)).sum::<usize>();
        let (amid, drawn) = (sum(|reading| reading.amid), sum(Reading::drawn));
        amid >= FEWEST && amid as f64 >= MOST * drawn as f64
    }

    /// Takes it out of the recordings.
    fn take_out(&self, subject: &mut Subject) {
        self.each.iter().for_each(|(signal, reading)| reading.take_out(subject, *signal, self.law));
    }

    /// The same where only levels that move on and on have shown it: what is lost of one signal is of all that are reported with it.
    fn take_out_of_all(&self, subject: &mut Subject) {
        match self.law {
            Law::Away => self.take_out(subject),
            Law::Lost => {
                let all = 0..subject.signals.len();
                self.each
                    .iter()
                    .for_each(|(_, reading)| all.clone().for_each(|other| reading.take_out(subject, other, self.law)));
            }
        }
    }

    /// As an effect of `subject`; beside it the device without what was drawn, and its nominal parameters.
    fn named(&self, (subject, other, bare): (&Subject, Subject, Bare), drawn: Drawn) -> Option<Chance> {
        let all = Reading::sum(self.each.iter().map(|(_, reading)| reading));
        let signals: Vec<usize> = self.each.iter().map(|(signal, _)| *signal).collect();
        // All that could show it do: it is the link's, not one signal's.
        let is_shown_by = |signal: usize| Reading::could_show(&other, &bare.prediction, signal, self.law);
        let could = (0..subject.signals.len()).filter(|signal| is_shown_by(*signal)).count();
        let is_whole = self.law == Law::Lost && signals.len() > 1 && could <= signals.len();
        let component = (!is_whole && signals.len() == 1 && (could > 1 || self.law == Law::Away))
            .then(|| subject.signals[signals[0]].property.clone());
        let (least, share, most) = all.share();
        let (name, time) = self.law.time(&all);
        let bounds = vec![
            Bounds { value: share, interval: [least, most], is_identifiable: true },
            Bounds { value: time.0, interval: time.1, is_identifiable: true },
        ];
        let candidate = candidate(self.law.id(), EffectPlace::ReportLink, component, &["probability", name], &bounds)?;
        Some(Chance { candidate, bounds, subject: other, bare, misfit: all.misfit, drawn, signals, beside: None })
    }
}

/// The device without what a law drew of its levels, whatever else is wrong with them.
fn taken_out_by_itself(
    subject: &Subject,
    bare: &Bare,
    law: Law,
    is_asked: &(dyn Fn(&str) -> bool + Sync),
) -> Option<Chance> {
    if !is_asked(law.id()) {
        return None;
    }
    let found = Readings::by_themselves(subject, &bare.prediction, law);
    if !found.is_so() {
        return None;
    }
    let mut other = subject.clone();
    found.take_out_of_all(&mut other);
    let (other, bare) = without(other, bare, None)?;
    found.named((subject, other, bare), Drawn::ByItself(law))
}

/// The device without the few reports that its link has lost, if that leaves nothing: too few of them to make a gap, or in too many levels for one of them to show it.
fn lost_amid(subject: &Subject, bare: &Bare, is_asked: &(dyn Fn(&str) -> bool + Sync)) -> Option<Chance> {
    if !is_asked(Law::Lost.id()) {
        return None;
    }
    let is_level =
        |signal: &usize| subject.runs.iter().flat_map(|run| &run.tracks[*signal]).any(|track| !track.values.is_empty());
    let levels = (0..subject.signals.len()).filter(is_level);
    let readings = Readings::of(subject, &bare.prediction, levels, Law::Lost, true);
    if !readings.are_amid() {
        return None;
    }
    let mut other = subject.clone();
    readings.take_out(&mut other);
    let (other, bare) = without(other, bare, None)?;
    if evidence(&other, &bare.prediction) > THRESHOLD {
        return None;
    }
    readings.named((subject, other, bare), Drawn::By(Law::Lost))
}

/// The device with its commands when they came, up to `most_s` late, if that explains it. `before`: its evidence with all of them in time.
fn late(
    (subject, bare): (&Subject, &Bare),
    (before, most_s): (f64, f64),
    is_stopped: &(dyn Fn() -> bool + Sync),
) -> Option<Chance> {
    let mut late = Late::of((subject, most_s), Known::bare(&bare.overrides), is_stopped)?;
    let (mut other, mut bare) = put_off(subject, bare, &late)?;
    if evidence(&other, &bare.prediction) > THRESHOLD {
        let overrides = late.with_nominal(subject, Known::bare(&bare.overrides), &bare.nuisances);
        (other, bare) = put_off(subject, &Bare { overrides, ..bare }, &late)?;
    }
    // What commands that came late had made of the nominal parameters is undone by and by.
    for _ in 0..ROUNDS {
        if evidence(&other, &bare.prediction) <= THRESHOLD {
            break;
        }
        late.again(subject, Known::bare(&bare.overrides))?;
        (other, bare) = put_off(subject, &bare, &late)?;
    }
    if evidence(&other, &bare.prediction) > THRESHOLD.max(MOST_LEFT * before) {
        return None;
    }
    if most_s <= MOST_S
        && let Some(sigma) = late.sigma()
    {
        return jittering((subject, most_s), (other, bare), sigma);
    }
    // What a switch adds to each is a gap of its own, and looked for as such; without it none comes later than they may by themselves.
    late.leave_to_a_switch()?;
    let sigma = late.sigma().filter(|sigma| DEVIATIONS * sigma.value <= MOST_S)?;
    jittering((subject, most_s), put_off(subject, &bare, &late)?, sigma)
}

/// The device with its commands when they came, its nominal parameters found anew.
fn put_off(subject: &Subject, bare: &Bare, late: &Late<'_>) -> Option<(Subject, Bare)> {
    let mut other = late.put_off(subject);
    let nominal = other.predict(&[], &Overrides::none()).ok()?;
    let bare = fitted(&mut other, bare, &nominal);
    Some((other, bare))
}

/// A link of `subject` that jitters by `sigma`; beside it the device with its commands when they came.
fn jittering((subject, most_s): (&Subject, f64), (other, bare): (Subject, Bare), sigma: Bounds) -> Option<Chance> {
    let bounds = vec![sigma];
    let candidate = candidate(JITTER, EffectPlace::CommandLink, None, &["sigma"], &bounds)?;
    let misfit = misfit(&subject.score(&subject.predict(&[], &bare.overrides).ok()?));
    Some(Chance {
        candidate,
        bounds,
        subject: other,
        bare,
        misfit,
        drawn: Drawn::Late(most_s),
        signals: Vec::new(),
        beside: None,
    })
}

/// The device as its sensor reads it, if that has steps of its own. They are sure whatever else is wrong with the device.
fn in_steps(place: usize, study: &Study) -> Option<Chance> {
    let (subject, bare) = (&study.subjects[place], &study.bare[place]);
    let (signal, steps, misfit) = steps::find(place, study)?;
    let mut other = subject.clone();
    steps.take_out(&mut other, &bare.prediction, signal);
    other.runs.iter_mut().for_each(|run| run.floors[signal].sharpness = steps.sharpness());
    let (other, mut bare) = without(other, bare, Some(&bare.prediction))?;
    if evidence(&other, &bare.prediction) > THRESHOLD {
        // What was read in coarse steps may have led the nominal parameters to where nothing leads them back from.
        let anew = Bare::new(&other, &other.predict(&[], &Overrides::none()).ok()?);
        let is_better = evidence(&other, &anew.prediction) < evidence(&other, &bare.prediction);
        bare = if is_better { anew } else { bare };
    }
    let component = Some(subject.signals[signal].property.clone());
    let bounds = vec![steps.bounds()];
    let candidate = candidate("quantisation", EffectPlace::Sensor, component, &["step"], &bounds)?;
    Some(Chance {
        candidate,
        bounds,
        subject: other,
        bare,
        misfit,
        drawn: Drawn::In(steps),
        signals: vec![signal],
        beside: None,
    })
}

/// A device that something was taken out of with its floors, by what is predicted of it or else by its law, and its nominal parameters found anew.
fn without(mut other: Subject, bare: &Bare, prediction: Option<&Prediction>) -> Option<(Subject, Bare)> {
    let nominal = other.predict(&[], &Overrides::none()).ok()?;
    other.find_floors(prediction.unwrap_or(&nominal), Timing::AsFound);
    let bare = fitted(&mut other, bare, &nominal);
    Some((other, bare))
}

/// The nominal parameters of a device whose recording changed, and its floors under them.
fn fitted(subject: &mut Subject, bare: &Bare, nominal: &Prediction) -> Bare {
    let found = bare.again(subject, nominal);
    match subject.find_floors_again(&found.prediction) {
        true => found.again(subject, nominal),
        false => found,
    }
}

/// An effect with parameters that are known.
fn candidate(
    id: &str,
    place: EffectPlace,
    component: Option<String>,
    names: &[&'static str],
    bounds: &[Bounds],
) -> Option<Candidate> {
    let effect = EFFECTS.iter().find(|effect| effect.id == id)?;
    let free = names.iter().zip(bounds).map(|(name, bounds)| Free {
        name,
        range: Range { least: bounds.interval[0], greatest: bounds.interval[1], scale: 1.0 },
        is_time: false,
    });
    Some(Candidate {
        effect,
        place,
        component,
        texts: std::collections::BTreeMap::new(),
        fixed: Vec::new(),
        free: free.collect(),
        starts: vec![bounds.iter().map(|bounds| bounds.value).collect()],
        shown: Vec::new(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::prediction::Predicted;
    use crate::gap::recorded_tests::{RUBBING_AXIS, study};

    /// The recorded motor with its levels as `reads` has them: of a count or not, the sample's number and its instant, what the law has there, and what stands there.
    fn motor(mut reads: impl FnMut(bool, (usize, f64), f64, f64) -> f64) -> (Study, usize) {
        let mut study = study(RUBBING_AXIS);
        let place = study.subjects.iter().position(|subject| subject.name == "Motor").expect("it moves");
        let prediction = study.bare[place].prediction.clone();
        let subject = &mut study.subjects[place];
        for (signal, info) in subject.signals.iter().enumerate() {
            let (Some(track), Predicted::Level(values)) =
                (&mut subject.runs[0].tracks[signal], &prediction.runs[0][signal])
            else {
                continue;
            };
            let instants = track.grid.instants.clone();
            for (k, (value, law)) in track.values.iter_mut().zip(values).enumerate() {
                *value = reads(info.is_count, (k, instants[track.first + k]), *law, *value);
            }
        }
        assert!(subject.signals.iter().any(|info| info.is_count) && subject.signals.iter().any(|info| !info.is_count));
        subject.find_floors(&prediction, Timing::AsFound);
        (study, place)
    }

    /// With its speed away in one of `every` windows of 0.2 s, and its encoder a hundredth too fast, or not.
    fn with_a_loose_contact(every: usize, is_too_fast: bool) -> (Study, usize) {
        motor(|is_count, (_, at), law, stands| match is_count {
            true if is_too_fast => (1.01 * law).floor(),
            false if (at / 0.2) as usize % every == 1 => 0.0,
            _ => stands,
        })
    }

    /// As sensors read it that are a fifth too high; of its reports one in five brings nothing new by chance, or each third in turn.
    fn with_lost_reports(is_in_turn: bool) -> (Study, usize) {
        let (mut drawn, mut last) = (0_u64, 0.0);
        motor(|is_count, (k, _), law, _| {
            // Numbers that look drawn: those of D. H. Lehmer's generator with the factor 48271, the same for each signal.
            drawn = if k == 0 { 20_261_126 } else { drawn * 48_271 % 2_147_483_647 };
            let is_lost = k > 0 && if is_in_turn { k % 3 == 1 } else { drawn.is_multiple_of(5) };
            let fresh = if is_count { (1.2 * law).floor() } else { 1.2 * law };
            last = if is_lost { last } else { fresh };
            last
        })
    }

    fn found(study: &Study, place: usize) -> Option<(String, Option<String>)> {
        let chance = find(place, study, &|_| true, &|| false)?;
        Some((chance.candidate.effect.id.to_owned(), chance.candidate.component.clone()))
    }

    /// Whatever else is wrong with the motor.
    #[test]
    fn a_loose_contact_is_found_beside_another_effect() {
        let is_it = Some(("intermittent".to_owned(), Some("speedActual".to_owned())));
        for is_too_fast in [false, true] {
            let (study, place) = with_a_loose_contact(12, is_too_fast);
            assert_eq!(found(&study, place), is_it, "{is_too_fast}");
            let chance = find(place, &study, &|_| true, &|| false).expect("a contact");
            let is_left = evidence(&chance.subject, &chance.bare.prediction) > THRESHOLD;
            assert_eq!(is_left, is_too_fast);
        }
        let (study, place) = with_a_loose_contact(usize::MAX, true);
        assert_eq!(found(&study, place), None);
    }

    /// Every tenth of a second for a while, and every second or two at other times.
    #[test]
    fn commands_that_jitter_are_read_where_they_are_apart() {
        let (mut study, place) = motor(|_, _, _, stands| stands);
        let (subject, bare) = (&study.subjects[place], &study.bare[place]);
        let late = late::jittered(subject, 0.03).predict(&[], &bare.overrides).expect("a motion");
        let subject = &mut study.subjects[place];
        for (signal, info) in subject.signals.iter().enumerate() {
            let levels = (&mut subject.runs[0].tracks[signal], &bare.prediction.runs[0][signal], &late.runs[0][signal]);
            let (Some(track), Predicted::Level(in_time), Predicted::Level(late)) = levels else { continue };
            for (value, (in_time, late)) in track.values.iter_mut().zip(in_time.iter().zip(late)) {
                *value = if info.is_count { late.floor() } else { *value - in_time + late };
            }
        }
        let chance = find(place, &study, &|id| id == JITTER, &|| false).expect("jitter");
        let [least, most] = chance.bounds[0].interval;
        assert!(least < 0.03 && 0.03 < most, "{:?}", chance.bounds);
    }

    #[test]
    fn lost_reports_are_read_off_a_recording_that_no_prediction_fits() {
        let (study, place) = with_lost_reports(false);
        let chance = find(place, &study, &|id| id == "lost-messages", &|| false).expect("lost reports");
        let bounds = &chance.bounds[0];
        assert!(
            chance.candidate.effect.id == "lost-messages" && bounds.value > 0.1 && bounds.value < 0.25,
            "{bounds:?}"
        );
        // With what its sensors read each of them is seen.
        let (subject, bare) = (&study.subjects[place], &study.bare[place]);
        let gain = |signal: &str| EffectSpec {
            place: EffectPlace::Sensor,
            kind: "gain".to_owned(),
            component: Some(signal.to_owned()),
            parameters: [("gain".to_owned(), crate::plant::ParameterValue::Number(1.2))].into(),
        };
        let gains = ["encoder", "speedActual"].map(gain);
        let again = beside((subject, bare), (&gains, &bare.overrides), Some(&chance), &|_| true).expect("all of them");
        let [least, most] = again.bounds[0].interval;
        assert!((least..=most).contains(&0.2), "{:?}", again.bounds);
        // They show it though nothing was found before.
        let shown = beside((subject, bare), (&gains, &bare.overrides), None, &|_| true).expect("all of them");
        assert_eq!(shown.bounds[0].value, again.bounds[0].value);
        let (study, place) = with_lost_reports(true);
        assert!(find(place, &study, &|id| id == "lost-messages", &|| false).is_none());
    }

    /// Three reports of a thousand: none of its signals need make a gap of them. Two may have been anything.
    #[test]
    fn a_few_lost_reports_are_found_that_need_make_no_gap() {
        let lost = |times: &[usize]| {
            let mut last = [0.0; 2];
            let (study, place) = motor(|is_count, (k, _), _, stands| {
                let last = &mut last[usize::from(is_count)];
                *last = if is_count && times.contains(&k) { *last } else { stands };
                *last
            });
            let found = lost_amid(&study.subjects[place], &study.bare[place], &|_| true)?;
            let left = evidence(&found.subject, &found.bare.prediction);
            Some((found.candidate.effect.id, left <= THRESHOLD))
        };
        assert_eq!(lost(&[207, 638, 1000]), Some(("lost-messages", true)));
        assert_eq!(lost(&[207, 638]), None);
    }
}
