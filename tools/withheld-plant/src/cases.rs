//! Cases: machines as they are built, listened to as it happens, with something wrong or nothing.

use std::io;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::catalogue::ENTRIES;
use crate::chance::Dice;
use crate::magnitude::Magnitude;
use crate::plans::{Deck, Plan, Sort};
use crate::quirk::{Member, Quirk};
use crate::record::{self, Surroundings};
use crate::script::Part;
use crate::workbench::{Bench, Conditions, Take};

/// The truth about a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// `case-017`
    pub case: String,
    pub model: String,
    pub sort: Sort,
    pub magnitude: Magnitude,
    /// Of the whole, in the training recording.
    pub distance: f64,
    pub effects: Vec<Quirk>,
    /// All effects that nobody can tell from the one effect in this recording, itself first: of one that is clear or gross.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub class: Vec<Member>,
    /// Of two effects that are clear or gross, in their order: all that nobody can tell from each beside the other, itself first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub classes: Vec<Vec<Member>>,
    /// What the rig calls a device of the kind of the first effect's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kind: Option<String>,
    /// How the machine was listened to.
    pub surroundings: Surroundings,
}

impl Plan {
    /// Makes the case in `folder`, which it creates, and gives the truth about it.
    pub fn make(&self, folder: &Path, conditions: Conditions) -> io::Result<Answer> {
        self.make_and_keep(folder, conditions).map(|(answer, _)| answer)
    }

    /// As [`make`](Self::make); gives what both recordings were made of besides, where the plant is the rig.
    pub fn make_and_keep(&self, folder: &Path, conditions: Conditions) -> io::Result<(Answer, Vec<Take>)> {
        let (bench, quirks, distance) = self.bench(conditions);
        let model = bench.design.model(conditions.exact);
        std::fs::create_dir_all(folder)?;
        std::fs::write(folder.join("model"), format!("{model}\n"))?;
        if let Some(xml) = bench.design.xml(conditions.tolerance()) {
            std::fs::write(folder.join(model), xml)?;
        }
        let train = bench.recorded(Part::Train, &quirks);
        let held_out = bench.recorded(Part::HeldOut, &quirks);
        for (part, (script, plant, seen)) in [(Part::Train, &train), (Part::HeldOut, &held_out)] {
            let file = std::fs::File::create(folder.join(part.file()))?;
            let seed = bench.seed_of(part);
            record::write(io::BufWriter::new(file), model, script, seen, plant, &bench.around, seed)?;
        }
        let case = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let magnitude = match self.sort {
            Sort::None => Magnitude::None,
            // What is stronger than its tolerance may show more than was meant.
            _ => Magnitude::of(distance).unwrap_or(self.magnitude),
        };
        let shows = magnitude == Magnitude::Clear || magnitude == Magnitude::Gross;
        let is_classed = shows && self.sort != Sort::Outside && !conditions.classless;
        let mut classes = if is_classed { bench.classes(&quirks, (&train.0, &train.1)) } else { Vec::new() };
        let class = if quirks.len() == 1 { classes.pop().unwrap_or_default() } else { Vec::new() };
        let takes =
            [Part::Train, Part::HeldOut].into_iter().filter_map(|part| bench.take(part, &quirks, model)).collect();
        let surroundings = bench.around;
        let answer = Answer {
            case,
            model: model.to_owned(),
            sort: self.sort,
            magnitude,
            distance,
            kind: quirks.first().map(|quirk| bench.design.machine().kind(&quirk.device)),
            effects: quirks,
            class,
            classes,
            surroundings,
        };
        Ok((answer, takes))
    }

    /// The machine with what is wrong with it. A machine that can show too little of what was planned is drawn again, and so is an effect
    /// that hides the other or is hidden by it, and one from outside of the library that one of it imitates so well that nobody could tell; of
    /// two effects on a device whose few flags show nothing grossly, clear ones are enough.
    fn bench(&self, conditions: Conditions) -> (Bench, Vec<Quirk>, f64) {
        let wanted: Vec<&str> = self.first.iter().map(|(_, spot)| spot.0).collect();
        let mut seeds = Dice::new(self.seed, 6);
        let (mut seed, mut magnitude) = (self.seed, self.magnitude);
        loop {
            let bench = Bench::new(self.site.design(&wanted, seed), seed, conditions);
            let (quirks, distance) = self.wrongs(&bench, magnitude);
            if quirks.len() == self.first.len()
                && let Some(distance) = as_recorded(&bench, &quirks, magnitude, distance)
            {
                return (bench, quirks, distance);
            }
            seed = seeds.seed();
            if magnitude == Magnitude::Gross {
                magnitude = Magnitude::Clear;
            }
        }
    }

    fn wrongs(&self, bench: &Bench, magnitude: Magnitude) -> (Vec<Quirk>, f64) {
        if self.sort == Sort::None {
            return (Vec::new(), 0.0);
        }
        let healthy = bench.healthy();
        let mut dice = Dice::new(self.seed, 5);
        let mut quirks: Vec<Quirk> = Vec::new();
        for (entry, spot) in &self.first {
            let mut deck = Deck::new(self.sort == Sort::Outside);
            let (mut entry, mut spot) = (*entry, *spot);
            let graded = magnitude == Magnitude::Faint || magnitude == Magnitude::BelowNoise;
            for _ in 0..40 {
                let found = bench.quirk(&ENTRIES[entry], spot, magnitude, &healthy, dice.seed());
                if let Some((quirk, _)) = found {
                    quirks.push(quirk);
                    // Also where no classes are asked for: which cases there are does not depend on that.
                    let is_told = || self.sort != Sort::Outside || !bench.is_as_one_of_the_library(&quirks);
                    if bench.show_beside(&quirks, Magnitude::Clear.range().0, &healthy) && is_told() {
                        break;
                    }
                    quirks.pop();
                }
                let (device, is_single) = (spot.0, self.first.len() == 1);
                let taken: Vec<String> = quirks.iter().map(|quirk| quirk.effect.clone()).collect();
                (entry, spot) = deck.next(&mut dice, |entry, spot| {
                    let fits = is_single || spot.0 == device && !taken.iter().any(|one| one == entry.effect);
                    let is_there = bench.design.machine().has(spot.0) && self.site.fits(entry, spot);
                    fits && is_there && (entry.has_strength() || !graded && is_single)
                });
            }
        }
        let distance = bench.distance(&quirks, &healthy);
        (quirks, distance)
    }
}

/// How much these effects show in the recording that is written, which is `distance` under a healthy machine's commands: an automation that
/// answers to its machine tells it something else, and may never let it come to where it differs. Nothing where what is to be clear or gross
/// is not even clear by then.
fn as_recorded(bench: &Bench, quirks: &[Quirk], magnitude: Magnitude, distance: f64) -> Option<f64> {
    let Some(bench) = bench.told_as_recorded(quirks) else { return Some(distance) };
    let (healthy, least) = (bench.healthy(), Magnitude::Clear.range().0);
    let distance = bench.distance(quirks, &healthy);
    let shows = magnitude == Magnitude::Clear || magnitude == Magnitude::Gross;
    let is_enough = !shows || distance >= least && bench.show_beside(quirks, least, &healthy);
    is_enough.then_some(distance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::quirk;
    use crate::site::Site;

    /// Whatever a healthy line's commands show of it. A rig's automation answers to nothing.
    #[test]
    fn what_does_not_show_under_the_commands_that_are_recorded_is_not_clear() {
        let cushion = |ratio: f64| {
            let cushion = quirk("Pusher2", "end-cushioning", &[("length", 0.2), ("ratio", ratio)]);
            [Quirk { place: "actuator".to_owned(), ..cushion }]
        };
        let (slow, hardly) = (cushion(0.2), cushion(1.0 - 1e-9));
        let bench = |site: Site| Bench::new(site.design(&["Pusher"], 3), 3, Conditions::default());
        let (line, rig) = (bench(Site::Line), bench(Site::Rig));
        assert!(line.told_as_recorded(&slow).is_some() && line.told_as_recorded(&[]).is_none());
        assert!(rig.told_as_recorded(&slow).is_none());
        let shown = as_recorded(&line, &slow, Magnitude::Clear, 0.0).expect("it is late at both ends");
        assert!(shown >= Magnitude::Clear.range().0, "{shown}");
        assert_eq!(as_recorded(&line, &hardly, Magnitude::Clear, 100.0), None);
        assert_eq!(as_recorded(&line, &hardly, Magnitude::BelowNoise, 100.0), Some(0.0));
        assert_eq!(as_recorded(&rig, &hardly, Magnitude::Clear, 100.0), Some(100.0));
    }
}
