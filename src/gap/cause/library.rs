//! Every candidate that fits a device: each effect of the registry at each of its places, of each component.

use std::collections::{BTreeMap, BTreeSet};

use super::candidate::{Candidate, Free};
use super::scales::Scales;
use super::starts::{self, Clues};
use crate::effect::{Build, EFFECTS, EffectDescriptor};
use crate::gap::fit::Range;
use crate::gap::{Predicted, Prediction, Score, SignalScore, Subject, gains_with_motion};
use crate::plant::{EffectPlace, ParameterValue};
use crate::prototype::kind::{ParameterType, PortType};
use crate::signal_map::Direction;

/// Effects that no single waveform shows: what they draw differs from run to run. They are in the floor of a trace.
const RANDOM: &[&str] = &["noise", "quantisation", "sampling-jitter", "lost-messages", "intermittent", "bounce"];

/// Parameters of devices that no report depends on, or that another candidate stands for.
const UNSEEN: &[&str] = &["beamHeight", "width", "reach", "encoderBits"];

/// What could cause a gap of `subject`: `is_asked` says of an effect's id whether it is looked for. `nominal` is what the
/// model predicts, `score` what that costs.
pub fn candidates(
    subject: &Subject,
    nominal: &Prediction,
    score: &Score,
    is_asked: &dyn Fn(&str) -> bool,
) -> Vec<Candidate> {
    let library = Library { subject, nominal, score, axes: axes(subject), off: off(subject, nominal, score) };
    let asked = EFFECTS.iter().filter(|effect| is_asked(effect.id) && !RANDOM.contains(&effect.id));
    let all = asked.flat_map(|effect| match effect.build {
        Build::Swap => library.swaps(effect),
        Build::Parameters if effect.id == "parameter-error" => library.parameter_errors(effect),
        _ => library.at_places(effect),
    });
    all.filter(|candidate| library.fits(candidate)).collect()
}

struct Library<'a> {
    subject: &'a Subject,
    nominal: &'a Prediction,
    score: &'a Score,
    /// The names of its axes where it has several, each with a drive.
    axes: Vec<&'static str>,
    /// The reports that are further off than chance has it.
    off: BTreeSet<&'a str>,
}

/// A robot's axes, by the names of their targets.
fn axes(subject: &Subject) -> Vec<&'static str> {
    let targets = subject.kind.ports.iter().filter_map(|port| port.name.strip_suffix("Target"));
    if subject.kind.name.ends_with("Robot") { targets.collect() } else { Vec::new() }
}

/// The reports that are further off than chance has it: by what they cost above their floor, or by what goes with the motion.
fn off<'a>(subject: &'a Subject, nominal: &Prediction, score: &Score) -> BTreeSet<&'a str> {
    let along = gains_with_motion(subject, nominal, score);
    let is_off = |(signal, along): &(&SignalScore, f64)| {
        let (mean, variance) = signal.floor_cost;
        *along > 0.0 || signal.cost - mean > 18.0_f64.max(5.0 * variance.sqrt())
    };
    let property = |signal: &SignalScore| subject.signals[signal.signal].property.as_str();
    let off: BTreeSet<&str> =
        score.signals.iter().zip(along).filter(is_off).map(|(signal, _)| property(signal)).collect();
    // Where none is, what is looked for is less than that, and may be of any.
    match off.is_empty() {
        true => score.signals.iter().filter(|signal| signal.level.is_some()).map(property).collect(),
        false => off,
    }
}

impl Library<'_> {
    /// The axis that a component belongs to.
    fn axis(&self, component: Option<&str>) -> Option<&'static str> {
        let name = component?;
        self.axes.iter().copied().find(|axis| {
            name == *axis || name.strip_suffix("Target") == Some(axis) || name.strip_prefix("actualPos") == Some(axis)
        })
    }

    /// Whether a signal is further off than chance has it.
    fn is_off(&self, property: &str) -> bool {
        self.off.contains(property)
    }

    /// Whether what acts on an axis could matter: the axis's own report is off, or none of an axis is, so that what is off (that the
    /// robot has arrived) may be any axis's doing.
    fn matters(&self, component: Option<&str>) -> bool {
        let Some(axis) = self.axis(component) else { return true };
        let off = || self.off.iter().filter_map(|property| self.axis(Some(property)));
        let is_seen = self.subject.signals.iter().any(|info| self.axis(Some(&info.property)) == Some(axis));
        !is_seen || off().next().is_none() || off().any(|off| off == axis)
    }

    fn fits(&self, candidate: &Candidate) -> bool {
        let spec = candidate.spec(&candidate.starts[0]);
        self.subject.takes(&spec)
    }

    fn at_places(&self, effect: &'static EffectDescriptor) -> Vec<Candidate> {
        let places = effect.places.iter();
        places
            .flat_map(|&place| self.components(place).into_iter().map(move |component| (place, component)))
            .filter(|(_, component)| effect.id != "offset" || !self.counts_from_nothing(*component))
            // A cylinder's valve is switched, one way or the other: no speed that is asked of it is a small one.
            .filter(|_| effect.id != "dead-band" || !self.subject.parameters.0.contains_key("extendSpeed"))
            // A polarity is one signal's: nobody crosses the wires of a whole link.
            .filter(|(_, component)| effect.id != "inverted" || component.is_some())
            .flat_map(|(place, component)| self.variants(effect, place, component))
            .collect()
    }

    /// Whether a signal is a counter that began where it is predicted to: an offset would be there from the start.
    fn counts_from_nothing(&self, component: Option<&str>) -> bool {
        let is_meant =
            |info: &&(usize, &crate::gap::SignalInfo)| info.1.is_count && Some(info.1.property.as_str()) == component;
        let begins = |signal: usize| {
            let runs = self.subject.runs.iter().zip(&self.nominal.runs);
            runs.filter_map(|(run, predicted)| match (&run.tracks[signal], &predicted[signal]) {
                (Some(track), Predicted::Level(values)) => Some((*track.values.first()?, *values.first()?)),
                _ => None,
            })
            .all(|(recorded, predicted)| (recorded + 0.5 - predicted).abs() <= 1.0)
        };
        self.subject.signals.iter().enumerate().find(|info| is_meant(&info)).is_some_and(|(signal, _)| begins(signal))
    }

    /// What an effect at a place may act on.
    fn components(&self, place: EffectPlace) -> Vec<Option<&'static str>> {
        let way = match place {
            EffectPlace::CommandLink => Direction::Command,
            EffectPlace::Sensor | EffectPlace::ReportLink => Direction::Report,
            _ if self.axes.is_empty() => return vec![None],
            _ => return self.axes.iter().copied().filter(|axis| self.matters(Some(axis))).map(Some).collect(),
        };
        let ports = self.subject.kind.ports.iter().filter(|port| port.direction == way);
        let present: Vec<&'static str> = ports
            .map(|port| port.name)
            .filter(|name| match way {
                Direction::Command => self.is_commanded(name) && self.matters(Some(name)),
                Direction::Report => self.is_off(name),
            })
            .collect();
        // What delays a whole link little shows in one report alone, where the others are looked at too seldom to be off.
        let is_whole = match way {
            Direction::Command => present.len() > 1,
            Direction::Report => !present.is_empty() && self.reports_that_change() > 1,
        };
        let all = (is_whole && place != EffectPlace::Sensor).then_some(None);
        all.into_iter().chain(present.iter().copied().map(Some)).collect()
    }

    /// How many of its reports change in the recordings.
    fn reports_that_change(&self) -> usize {
        let changes = |signal: usize| {
            let mut tracks = self.subject.runs.iter().filter_map(|run| run.tracks[signal].as_ref());
            tracks.any(|track| {
                !track.edges.is_empty() || track.values.iter().any(|value| Some(value) != track.values.first())
            })
        };
        (0..self.subject.signals.len()).filter(|signal| changes(*signal)).count()
    }

    /// Whether a command port was ever written to.
    fn is_commanded(&self, name: &str) -> bool {
        let port = self.subject.kind.port(name);
        self.subject.runs.iter().any(|run| run.commands.iter().any(|(to, _)| Some(*to) == port))
    }

    /// One candidate for each combination of what can be chosen, with all else free.
    fn variants(
        &self,
        effect: &'static EffectDescriptor,
        place: EffectPlace,
        component: Option<&'static str>,
    ) -> Vec<Candidate> {
        let scales = Scales::of(self.subject, self.nominal, self.axis(component));
        let clues = Clues { subject: self.subject, nominal: self.nominal, score: self.score, scales, component };
        let base = Candidate {
            effect,
            place,
            component: component.map(str::to_owned),
            texts: BTreeMap::new(),
            fixed: Vec::new(),
            free: Vec::new(),
            starts: vec![Vec::new()],
            shown: Vec::new(),
        };
        starts::of(base, &clues)
    }

    fn swaps(&self, effect: &'static EffectDescriptor) -> Vec<Candidate> {
        let mut swaps = Vec::new();
        for (i, first) in self.subject.kind.ports.iter().enumerate() {
            for second in &self.subject.kind.ports[i + 1..] {
                let is_pair =
                    first.direction == second.direction && first.ty == second.ty && first.range == second.range;
                let (place, is_off) = match first.direction {
                    Direction::Command => (EffectPlace::CommandLink, true),
                    Direction::Report => (EffectPlace::ReportLink, self.is_off(first.name) || self.is_off(second.name)),
                };
                if is_pair && is_off && (first.ty == PortType::Boolean || first.quantities == second.quantities) {
                    swaps.push(Candidate {
                        effect,
                        place,
                        component: Some(first.name.to_owned()),
                        texts: BTreeMap::from([("with".to_owned(), second.name.to_owned())]),
                        fixed: Vec::new(),
                        free: Vec::new(),
                        starts: vec![Vec::new()],
                        shown: Vec::new(),
                    });
                }
            }
        }
        swaps
    }

    fn parameter_errors(&self, effect: &'static EffectDescriptor) -> Vec<Candidate> {
        let declared = self.subject.kind.parameters.iter().filter(|parameter| !UNSEEN.contains(&parameter.name));
        declared
            .filter_map(|parameter| {
                let ParameterType::Number { min, max } = parameter.ty else { return None };
                let ParameterValue::Number(nominal) = self.subject.parameters.0.get(parameter.name)?.value else {
                    return None;
                };
                let is_of_axis = |axis: &&&str| parameter.name.ends_with(**axis);
                let axis = self.axes.iter().find(is_of_axis).copied();
                if !self.matters(axis) {
                    return None;
                }
                let size = if nominal == 0.0 { 0.01 } else { nominal.abs() };
                let range = Range {
                    least: min.max(nominal - 20.0 * size),
                    greatest: max.min(nominal + 20.0 * size),
                    scale: 0.1 * size,
                };
                let shares: &[f64] = if nominal == 0.0 { &[1.0, 10.0] } else { &[-0.3, -0.01, 0.01, 0.3, 1.0] };
                let starts: Vec<Vec<f64>> = shares
                    .iter()
                    .map(|share| nominal + share * size)
                    .filter(|value| (range.least..=range.greatest).contains(value))
                    .map(|value| vec![value])
                    .collect();
                let is_time = parameter.quantities.contains(&crate::value::Quantity::Time);
                (!starts.is_empty()).then(|| Candidate {
                    effect,
                    place: EffectPlace::Actuator,
                    component: Some(parameter.name.to_owned()),
                    texts: BTreeMap::new(),
                    fixed: Vec::new(),
                    free: vec![Free { name: "value", range, is_time }],
                    starts,
                    shown: Vec::new(),
                })
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;
    use crate::device::KINDS;
    use crate::effect;
    use crate::gap::recorded_tests::{SLOW_PUSHER, study};
    use crate::gap::{Overrides, Recording, Study};
    use crate::plant::{self, embedded::Embedded};
    use crate::trace::Reader;

    /// An axis that is told to go to and fro at 0.1 m/s, and does.
    fn slow() -> Study {
        recorded(&["position"])
    }

    /// The same, of which these were recorded. What it says of its velocity only has to change.
    fn recorded(reports: &[&str]) -> Study {
        let plant = plant::load(&Embedded, "models/rig-toleranced", KINDS).expect("the rig");
        let place = |step: i32| 2e-3 * f64::from((step % 200 - 100).abs());
        let lines = (0..1000).map(|step| {
            let (at, place) = (0.02 * f64::from(step), place(step));
            let said = |report: &&str| format!("{{\"name\":\"Axis.{report}\",\"value\":{place:.4}}}");
            let said: Vec<String> = reports.iter().map(said).collect();
            format!(
                "{{\"t\":{at:.3},\"from\":\"automation\",\"SendValue\":[{{\"name\":\"Axis.positionTarget\",\"value\":{place:.4}}}]}}\n\
                 {{\"t\":{:.3},\"from\":\"plant\",\"SendValue\":[{}]}}\n",
                at + 0.01,
                said.join(",")
            )
        });
        let text = format!("{{\"trace\":\"kinetwin/1\",\"source\":\"plant\"}}\n{}", lines.collect::<String>());
        let reader = Reader::new("slow", Cursor::new(text.into_bytes())).expect("a trace");
        let recording = Recording::read(&plant, "slow", reader, &[]).expect("a recording");
        Study::new(&plant, &[recording]).expect("a study")
    }

    /// What switches a cylinder's valve has no small values about which nothing happens.
    #[test]
    fn a_cylinder_has_no_dead_band() {
        let study = study(SLOW_PUSHER);
        let pusher = study.subject("Pusher").expect("it moves");
        let nominal = pusher.predict(&[], &Overrides::none()).expect("a prediction");
        let of = |id: &str| candidates(pusher, &nominal, &pusher.score(&nominal), &|of| of == id).len();
        assert_eq!((of("dead-band"), of("gain-error")), (0, 1));
    }

    /// Three thousandths of what a slow axis moves at is less than the least speed that friction may fall within: the search begins there.
    #[test]
    fn friction_that_falls_with_speed_is_looked_for_on_a_slow_axis() {
        let study = slow();
        let subject = study.subject("Axis").expect("it moves");
        let nominal = subject.predict(&[], &Overrides::none()).expect("a prediction");
        let found = candidates(subject, &nominal, &subject.score(&nominal), &|id| id == "stribeck-friction");
        let [stribeck] = found.as_slice() else { panic!("{} candidates", found.len()) };
        for start in &stribeck.starts {
            let spec = stribeck.spec(start);
            let built = effect::build(subject.kind, &subject.parameters, &subject.name, &[spec], 0);
            assert!(built.is_ok(), "{start:?}");
        }
    }

    #[test]
    fn inches_and_feet_are_units_that_are_mistaken_for_metres() {
        let study = slow();
        let subject = study.subject("Axis").expect("it moves");
        let nominal = subject.predict(&[], &Overrides::none()).expect("a prediction");
        let found = candidates(subject, &nominal, &subject.score(&nominal), &|id| id == "wrong-unit");
        let of_the_target: Vec<f64> = found
            .iter()
            .filter(|candidate| candidate.component.as_deref() == Some("positionTarget"))
            .map(|candidate| candidate.fixed[0].1)
            .collect();
        for factor in [1000.0, 0.0254, 2.54, 0.3048] {
            assert!(
                of_the_target.iter().any(|found| (found / factor - 1.0).abs() < 1e-9),
                "{factor} {of_the_target:?}"
            );
        }
    }

    /// A delay of all reports shows first where they are looked at most closely.
    #[test]
    fn a_whole_link_may_be_late_where_one_report_alone_is_off() {
        let off_of = |reports: &[&str]| {
            let study = recorded(reports);
            let subject = study.subject("Axis").expect("it moves");
            let nominal = subject.predict(&[], &Overrides::none()).expect("a prediction");
            let score = subject.score(&nominal);
            let off = BTreeSet::from(["position"]);
            let library = Library { subject, nominal: &nominal, score: &score, axes: Vec::new(), off };
            library.components(EffectPlace::ReportLink)
        };
        assert_eq!(off_of(&["position", "velocity"]), [None, Some("position")]);
        // Where it reports its position alone, all of its link is that.
        assert_eq!(off_of(&["position"]), [Some("position")]);
    }
}
