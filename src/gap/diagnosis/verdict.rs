//! The verdict, and what stands in the report for it.

use super::words::told_apart_by;
use super::{Conclusion, Finding};
use crate::gap::cause::{Alternative, Bounds, Candidate};
use crate::gap::report::{Cause, FittedNominal, FittedParameter, Member, Remainder, Report, Rival, Verdict};
use crate::gap::{Overrides, Study, Subject};
use crate::plant::Plant;
use crate::prototype::kind::{PortDescriptor, PortType};
use crate::prototype::quantity::si_unit;
use crate::value::Quantity;

/// A cause stands clear from this weight on.
const CLEAR: f64 = 0.85;
/// Rivals lighter than this are not worth a line.
const LIGHTEST: f64 = 0.005;

/// Whether anything that a device reports changes.
pub(super) fn moves(subject: &Subject) -> bool {
    subject
        .runs
        .iter()
        .flat_map(|run| run.tracks.iter().flatten())
        .any(|track| !track.edges.is_empty() || track.values.windows(2).any(|pair| pair[0] != pair[1]))
}

/// The first that applies, in the order of the verdicts. One device's cause with another's that nothing explains is partial.
pub(super) fn verdict(study: &Study, findings: &[Finding]) -> Verdict {
    let some = |conclusion: Conclusion| findings.iter().any(|finding| finding.conclusion == conclusion);
    let explains = some(Conclusion::Explained) || some(Conclusion::Partial);
    match () {
        () if some(Conclusion::TooShort) && !some(Conclusion::Unknown) && !explains => Verdict::NotTestable,
        () if !some(Conclusion::Unknown) && !explains => {
            if study.subjects.iter().any(moves) {
                Verdict::NoGap
            } else {
                Verdict::NotTestable
            }
        }
        () if !explains => Verdict::Unknown,
        () if some(Conclusion::Partial) || some(Conclusion::Unknown) || some(Conclusion::TooShort) => Verdict::Partial,
        () if findings.iter().any(is_ambiguous) => Verdict::Ambiguous,
        () => Verdict::Effect,
    }
}

fn is_ambiguous(finding: &Finding) -> bool {
    let unclear = |answer: &crate::gap::cause::Answer| {
        answer.alternatives.iter().any(|other| other.is_same) || answer.weight < CLEAR
    };
    finding.answers.iter().any(unclear)
}

/// Causes, rivals and remainder.
pub(super) fn fill(report: &mut Report, plant: &Plant, study: &Study, findings: &[Finding]) {
    if matches!(report.verdict, Verdict::Partial | Verdict::Unknown) {
        report.remainder = Some(remainder(findings));
    }
    if matches!(report.verdict, Verdict::NotTestable | Verdict::NoGap) {
        return;
    }
    let explaining =
        || findings.iter().filter(|finding| matches!(finding.conclusion, Conclusion::Explained | Conclusion::Partial));
    // What is left of a part is outside, however sure it is that it goes with something.
    let certainty = findings.iter().map(|finding| match finding.conclusion {
        Conclusion::Unknown | Conclusion::TooShort | Conclusion::Partial => 1.0,
        _ if finding.remainder.is_significant => finding.remainder.certainty,
        _ => 0.0,
    });
    let outside = if report.verdict == Verdict::Unknown { 1.0 } else { certainty.fold(0.0, f64::max).min(0.99) };
    report.outside = Some(outside);
    // One set of effects over all devices: the product of what each has, and of each rival with the others as they are.
    let all: f64 = explaining().flat_map(|finding| &finding.answers).map(|answer| answer.weight.max(1e-6)).product();
    let mut set = 0;
    for finding in explaining() {
        let subject = &study.subjects[finding.subject];
        let site = Site { plant, subject };
        report.fitted.extend(site.fitted(&finding.ladder.best.overrides));
        for chance in finding.chance.iter().flat_map(|chance| chance.all()) {
            report.cause.push(site.cause(&chance.candidate, &chance.bounds, &[], all));
        }
        for answer in &finding.answers {
            let first: usize = finding.ladder.best.set[..answer.place].iter().map(|c| c.free.len()).sum();
            let candidate = &finding.ladder.best.set[answer.place];
            let bounds = &finding.bounds[first..first + candidate.free.len()];
            report.cause.push(site.cause(candidate, bounds, answer.alternatives.as_slice(), all));
            for other in &answer.alternatives {
                let weight = other.weight * all / answer.weight.max(1e-6);
                if other.is_same || weight >= LIGHTEST {
                    set += 1;
                    report.rivals.push(site.rival(candidate, other, weight, set));
                }
            }
        }
    }
    normalise(report, outside, all);
}

/// Makes the weights of the sets and of what lies outside sum to 1.
fn normalise(report: &mut Report, outside: f64, all: f64) {
    if report.cause.is_empty() {
        return;
    }
    let sum = all + report.rivals.iter().map(|rival| rival.weight).sum::<f64>();
    let factor = (1.0 - outside) / sum;
    report.cause.iter_mut().for_each(|cause| cause.weight *= factor);
    report.rivals.iter_mut().for_each(|rival| rival.weight *= factor);
    report.rivals.sort_by(|a, b| b.weight.total_cmp(&a.weight));
}

/// What is left of the gap over all devices that have one.
fn remainder(findings: &[Finding]) -> Remainder {
    let with_gap = || findings.iter().filter(|finding| finding.has_gap());
    let all: f64 = with_gap().map(|finding| finding.misfit).sum();
    let left = |finding: &Finding| match finding.conclusion {
        Conclusion::Unknown | Conclusion::TooShort => finding.misfit,
        _ => finding.misfit * finding.remainder.share,
    };
    let mut depends_on: Vec<String> = Vec::new();
    for name in
        with_gap().filter(|finding| finding.conclusion != Conclusion::Explained).flat_map(|f| &f.remainder.depends_on)
    {
        if !depends_on.contains(name) {
            depends_on.push(name.clone());
        }
    }
    Remainder { share: with_gap().map(left).sum::<f64>() / all.max(1e-12), depends_on }
}

/// The name of a component of a task among several.
fn component(task: Option<&str>, component: Option<&str>) -> Option<String> {
    match (task, component) {
        (None, component) => component.map(str::to_owned),
        (Some(task), None) => Some(task.to_owned()),
        (Some(task), Some(component)) => Some(format!("{task}.{component}")),
    }
}

/// A device in its plant.
struct Site<'a> {
    plant: &'a Plant,
    subject: &'a Subject,
}

impl Site<'_> {
    fn member(&self, candidate: &Candidate) -> Member {
        let instance = self.subject.id.instance(self.plant);
        let task = (instance.tasks.len() > 1).then(|| self.subject.id.task(self.plant).name.as_str());
        let maker = self.subject.maker(candidate.effect.id);
        Member {
            device: maker.unwrap_or(&instance.name).to_owned(),
            component: component(task.filter(|_| maker.is_none()), candidate.component.as_deref()),
            effect: candidate.effect.id.to_owned(),
            place: candidate.place,
        }
    }

    /// The nominal parameters that were fitted beside the causes.
    fn fitted(&self, overrides: &Overrides) -> Vec<FittedNominal> {
        let instance = self.subject.id.instance(self.plant);
        let task = (instance.tasks.len() > 1).then(|| self.subject.id.task(self.plant).name.as_str());
        let values = overrides.0.iter().filter_map(|(name, value)| {
            let nominal = self.subject.parameters.number(name);
            (nominal != *value).then(|| FittedNominal {
                device: instance.name.clone(),
                parameter: component(task, Some(name)).unwrap_or_default(),
                nominal,
                value: *value,
                unit: self.nominal_unit(Some(name)),
            })
        });
        values.collect()
    }

    fn cause(&self, candidate: &Candidate, bounds: &[Bounds], others: &[Alternative], weight: f64) -> Cause {
        let Member { device, component, effect, place } = self.member(candidate);
        let same = others.iter().filter(|other| other.is_same).map(|other| self.member(other.candidate()));
        let class = std::iter::once(self.member(candidate)).chain(same).collect();
        let parameters = self.parameters(candidate, bounds);
        Cause { device, component, effect, place, weight, class, parameters, texts: candidate.texts.clone() }
    }

    fn rival(&self, named: &Candidate, other: &Alternative, weight: f64, set: u32) -> Rival {
        let candidate = other.candidate();
        let Member { device, component, effect, place } = self.member(candidate);
        let own = other.trial.values().last().map_or(&[][..], |(_, at)| at);
        let exact = |value: &f64| Bounds { value: *value, interval: [*value; 2], is_identifiable: true };
        let bounds: Vec<Bounds> = own.iter().map(exact).collect();
        Rival {
            device,
            component,
            effect,
            place,
            weight,
            told_apart_by: told_apart_by((named.effect.id, named.place), (candidate.effect.id, candidate.place)),
            set: Some(set),
            parameters: self.parameters(candidate, &bounds),
            texts: candidate.texts.clone(),
        }
    }

    fn parameters(&self, candidate: &Candidate, bounds: &[Bounds]) -> Vec<FittedParameter> {
        let free = candidate.free.iter().zip(bounds).map(|(free, bounds)| FittedParameter {
            name: free.name.to_owned(),
            value: bounds.value,
            unit: self.unit(candidate, free.name),
            ci95: bounds.interval,
            not_identifiable: !bounds.is_identifiable,
        });
        let fixed = candidate.fixed.iter().map(|(name, value)| FittedParameter {
            name: (*name).to_owned(),
            value: *value,
            unit: self.unit(candidate, name),
            ci95: [*value; 2],
            not_identifiable: false,
        });
        free.chain(fixed).collect()
    }

    /// Whether the device turns, or this axis of it: as it is set up, else as what it is told is an angle or a speed of one.
    fn is_rotary(&self, axis: Option<&str>) -> bool {
        let Subject { kind, parameters, .. } = self.subject;
        if parameters.0.contains_key("motion") {
            return parameters.text("motion") == "rotary";
        }
        let of_axis = axis.and_then(|axis| kind.port(axis).or_else(|| kind.port(&format!("{axis}Target"))));
        let own = of_axis.map(|port| &kind.ports[port]);
        let targets = || kind.ports.iter().filter(|port| port.name.ends_with("Target"));
        let turns = |port: &PortDescriptor| matches!(port.quantities, [Quantity::Angle | Quantity::AngularVelocity]);
        own.map_or_else(|| targets().next().is_some() && targets().all(turns), turns)
    }

    /// The SI unit of a quantity that is one thing on what moves along a line and another on what turns.
    fn si_unit(&self, quantities: &[Quantity], is_rotary: bool) -> Option<String> {
        // Of a gain that is one thing on a speed's error and another on a position's, the latter stand last.
        let is_on_position = quantities.len() > 2
            && self.subject.parameters.0.contains_key("loop")
            && self.subject.parameters.text("loop") == "proportional";
        let at = usize::from(is_rotary) + if is_on_position { 2 } else { 0 };
        quantities.get(at.min(quantities.len().saturating_sub(1))).map(|quantity| si_unit(*quantity).symbol.to_owned())
    }

    /// The SI unit of a nominal parameter.
    fn nominal_unit(&self, name: Option<&str>) -> String {
        let parameter = name.and_then(|name| self.subject.kind.parameter(name));
        let is_rotary = self.is_rotary(None);
        parameter.and_then(|parameter| self.si_unit(parameter.quantities, is_rotary)).unwrap_or_else(|| "1".to_owned())
    }

    /// The SI unit of a parameter: its own, of a parameter's value the parameter's, of a sensor's the signal's.
    fn unit(&self, candidate: &Candidate, name: &str) -> String {
        let is_rotary = self.is_rotary(candidate.component.as_deref());
        let of = |quantities: &[Quantity]| self.si_unit(quantities, is_rotary);
        let declared = candidate.effect.parameters.iter().find(|parameter| parameter.name == name);
        let Some(declared) = declared else { return "1".to_owned() };
        if candidate.is_parameter_error() {
            return self.nominal_unit(candidate.component.as_deref());
        }
        match (candidate.effect.id, declared.quantities) {
            ("jerk-limit", _) => if is_rotary { "rad/s3" } else { "m/s3" }.to_owned(),
            (
                "offset" | "hysteresis" | "blind-range" | "drift" | "stuck" | "quantisation" | "noise",
                [Quantity::One],
            ) => {
                let port = candidate.component.as_deref().and_then(|name| self.subject.kind.port(name));
                let unit = port
                    .and_then(|port| of(self.subject.kind.ports[port].quantities))
                    .unwrap_or_else(|| "1".to_owned());
                let is_flag = port.is_some_and(|port| self.subject.kind.ports[port].ty == PortType::Boolean);
                match candidate.effect.id {
                    "drift" => format!("{unit}/s"),
                    // A switch looks along a way.
                    "hysteresis" | "blind-range" if is_flag => "m".to_owned(),
                    _ => unit,
                }
            }
            (_, quantities) => of(quantities).unwrap_or_else(|| "1".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::effect::EFFECTS;
    use crate::gap::recorded_tests::{SLOW_PUSHER, rig, study};
    use crate::plant::EffectPlace;

    /// An axis of a robot that turns and a motor are limited in radians, the robot's other axes and a servo axis along a line in metres.
    #[test]
    fn parameters_are_told_in_the_units_of_what_they_limit_or_hold() {
        let (plant, study) = (rig(), study(SLOW_PUSHER));
        let told = |device: &str, component: Option<&str>, effect: &str, name: &str| {
            let effect = EFFECTS.iter().find(|known| known.id == effect).expect("an effect");
            let candidate = Candidate {
                effect,
                place: EffectPlace::Actuator,
                component: component.map(str::to_owned),
                texts: BTreeMap::new(),
                fixed: Vec::new(),
                free: Vec::new(),
                starts: Vec::new(),
                shown: Vec::new(),
            };
            Site { plant: &plant, subject: study.subject(device).expect(device) }.unit(&candidate, name)
        };
        let unit = |device: &str, component: Option<&str>, effect: &str| told(device, component, effect, "limit");
        assert_eq!(unit("Robot", Some("R"), "acceleration-limit"), "rad/s2");
        assert_eq!(unit("Robot", Some("X"), "acceleration-limit"), "m/s2");
        assert_eq!(unit("Robot", Some("R"), "jerk-limit"), "rad/s3");
        assert_eq!(unit("Motor", None, "velocity-limit"), "rad/s");
        assert_eq!(unit("Axis", None, "velocity-limit"), "m/s");
        assert_eq!(unit("Belt", None, "velocity-limit"), "m/s");
        // A counter sticks by counts, a switch along a way.
        assert_eq!(told("Motor", Some("encoder"), "hysteresis", "width"), "1");
        assert_eq!(told("Pusher", Some("limitRetracted"), "hysteresis", "width"), "m");
    }

    fn cause(weight: f64) -> Cause {
        Cause {
            device: "Belt".to_owned(),
            component: None,
            effect: "belt-slip".to_owned(),
            place: EffectPlace::Transmission,
            weight,
            class: Vec::new(),
            parameters: Vec::new(),
            texts: BTreeMap::new(),
        }
    }

    #[test]
    fn weights_sum_to_one() {
        let mut report = Report::new(Verdict::Ambiguous);
        report.cause = vec![cause(0.4), cause(0.4)];
        report.rivals = vec![Rival {
            device: "Belt".to_owned(),
            component: None,
            effect: "scale-error".to_owned(),
            place: EffectPlace::Transmission,
            weight: 0.4,
            told_apart_by: String::new(),
            set: Some(1),
            parameters: Vec::new(),
            texts: BTreeMap::new(),
        }];
        normalise(&mut report, 0.2, 0.4);
        assert!((report.cause[0].weight + report.rivals[0].weight + 0.2 - 1.0).abs() < 1e-12);
    }
}
