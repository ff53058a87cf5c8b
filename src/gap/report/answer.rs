//! The three answers of a report, each in a sentence.

use super::number::{interval, percent, quantity, significant};
use super::{Cause, FittedParameter, Member, Report, Verdict};

/// Where, which, and how far.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Answer {
    pub place: String,
    pub cause: String,
    pub shrink: String,
}

impl Report {
    /// What the report says, for people.
    pub fn answer(&self) -> Answer {
        Answer { place: self.place(), cause: self.named_cause(), shrink: self.shrunk() }
    }

    fn place(&self) -> String {
        match self.verdict {
            Verdict::NotTestable => return "These recordings cannot tell where model and machine part.".to_owned(),
            Verdict::NoGap => return "Model and machine agree down to the noise.".to_owned(),
            _ => {}
        }
        let devices: Vec<String> =
            self.devices.iter().map(|gap| format!("{} ({})", gap.device, percent(gap.share))).collect();
        match &devices[..] {
            [] => "The gap is in no single device.".to_owned(),
            [one] => format!("The gap is in {one}."),
            [all @ .., last] => format!("The gap is in {} and {last}.", all.join(", ")),
        }
    }

    fn named_cause(&self) -> String {
        let named: Vec<String> = self.cause.iter().map(Cause::in_words).collect();
        let named = named.join("; and ");
        let depends = self.remainder.as_ref().filter(|rest| !rest.depends_on.is_empty());
        let depends = depends.map(|rest| rest.depends_on.join(" and "));
        let which = depends.as_ref().map(|depends| format!(", which depends on {depends}")).unwrap_or_default();
        match self.verdict {
            Verdict::NotTestable => match self.not_testable.first() {
                Some(first) => {
                    let device = first.device.as_ref().map(|device| format!("{device}: ")).unwrap_or_default();
                    format!("{}; needed: {}.", capital(&format!("{device}{}", first.reason)), first.needs)
                }
                None => "What would have to be seen is not excited.".to_owned(),
            },
            Verdict::NoGap => "Nothing is to be added.".to_owned(),
            Verdict::Unknown => {
                format!("Nothing in the library explains it{which}.")
            }
            Verdict::Partial => {
                /// Less of a gap is nothing.
                const NOTHING: f64 = 0.005;
                let share = self.remainder.as_ref().map(|rest| rest.share);
                let rest = share.map(percent).unwrap_or_default();
                match depends {
                    // The part is as large as the gap, but it is no constant.
                    Some(depends) if share.is_some_and(|share| share < NOTHING) => {
                        format!(
                            "A part of it: {named}; but what it does depends on {depends}, which nothing in the library explains."
                        )
                    }
                    _ => format!("A part of it: {named}; {rest} is left that nothing in the library explains{which}."),
                }
            }
            Verdict::Ambiguous => format!("Cause: {named}.{}", self.undecided()),
            Verdict::Effect => format!("Cause: {named}."),
        }
    }

    /// What else stands in the causes' classes.
    fn undecided(&self) -> String {
        let mut text = String::new();
        for cause in self.cause.iter().filter(|cause| cause.class.len() > 1) {
            let others: Vec<String> = cause.class[1..].iter().map(|member| member.in_words(cause)).collect();
            text.push_str(&format!(" These data cannot tell it from {}.", others.join(" or ")));
        }
        text
    }

    fn shrunk(&self) -> String {
        let shrink = &self.shrink;
        let (Some(before), Some(after), Some(ratio)) = (shrink.holdout_before, shrink.holdout_after, shrink.ratio)
        else {
            return "Nothing could be measured.".to_owned();
        };
        if self.cause.is_empty() {
            return format!("On data that no fit saw, the gap is {} times the noise floor.", significant(before, 3));
        }
        if significant(before, 3) == significant(1.0, 3) {
            return format!(
                "On data that no fit saw, the gap is hidden in the noise, {} times its floor before and {} after.",
                significant(before, 3),
                significant(after, 3)
            );
        }
        let within = shrink.ci95.map(|[low, high]| format!(" ({} to {})", percent(low), percent(high)));
        format!(
            "On data that no fit saw, the gap falls from {} to {} times the noise floor: {}{} of what lies above it is left.",
            significant(before, 3),
            significant(after, 3),
            percent(ratio),
            within.unwrap_or_default()
        )
    }
}

impl Cause {
    /// `acceleration limit on Robot.Y (actuator), limit 1.9925 m/s²`
    pub fn in_words(&self) -> String {
        let parameters = self.parameters.iter().map(|p| format!(", {} {}", words(&p.name), quantity(p.value, &p.unit)));
        let on = on(&self.device, self.component.as_deref());
        format!("{} on {on} ({}){}", words(&self.effect), words(self.place.name()), parameters.collect::<String>())
    }
}

impl Member {
    fn in_words(&self, cause: &Cause) -> String {
        let is_there = self.device == cause.device && self.component == cause.component;
        let on = if is_there { String::new() } else { format!(" on {}", on(&self.device, self.component.as_deref())) };
        format!("{}{on} ({})", words(&self.effect), words(self.place.name()))
    }
}

impl FittedParameter {
    /// `1.99254 m/s² (95 %: 1.99251 to 1.99257)`
    pub fn in_words(&self) -> String {
        interval(self.value, self.ci95, &self.unit)
    }
}

/// `Robot.Y`
pub fn on(device: &str, component: Option<&str>) -> String {
    component.map_or_else(|| device.to_owned(), |component| format!("{device}.{component}"))
}

/// An id as words: `dead-time` is `dead time`.
pub fn words(id: &str) -> String {
    id.replace(['-', '_'], " ")
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::report::{Remainder, Shrink};

    fn partial(share: f64, before: f64) -> Answer {
        let remainder = Some(Remainder { share, depends_on: vec!["time".to_owned()] });
        let shrink =
            Shrink { holdout_before: Some(before), holdout_after: Some(1.0), ratio: Some(0.25), ..Shrink::default() };
        let cause = vec![Cause {
            device: "Axis".to_owned(),
            component: None,
            effect: "coulomb-friction".to_owned(),
            place: crate::plant::EffectPlace::Mechanics,
            weight: 0.01,
            class: Vec::new(),
            parameters: Vec::new(),
            texts: Default::default(),
        }];
        Report { cause, remainder, shrink, ..Report::new(Verdict::Partial) }.answer()
    }

    /// Of a friction that warms up nothing is left that could be measured.
    #[test]
    fn where_nothing_is_left_but_that_it_changes_that_is_said() {
        let named = "A part of it: coulomb friction on Axis (mechanics)";
        let unexplained = "nothing in the library explains";
        assert_eq!(
            [partial(0.001, 1.4).cause, partial(0.2, 1.4).cause],
            [
                format!("{named}; but what it does depends on time, which {unexplained}."),
                format!("{named}; 20 % is left that {unexplained}, which depends on time.")
            ]
        );
    }

    #[test]
    fn a_gap_that_noise_hides_falls_from_nothing_to_nothing() {
        let [hidden, seen] = [1.001, 1.4].map(|before| partial(0.2, before).shrink);
        assert_eq!(
            hidden,
            "On data that no fit saw, the gap is hidden in the noise, 1 times its floor before and 1 after."
        );
        assert!(seen.contains("falls from 1.4 to 1 times the noise floor: 25 %"), "{seen}");
    }
}
