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
        let depends = depends.map(|rest| format!(", which depends on {}", rest.depends_on.join(" and ")));
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
                format!("Nothing in the library explains it{}.", depends.unwrap_or_default())
            }
            Verdict::Partial => {
                let rest = self.remainder.as_ref().map(|rest| percent(rest.share)).unwrap_or_default();
                format!(
                    "A part of it: {named}; {rest} is left that nothing in the library explains{}.",
                    depends.unwrap_or_default()
                )
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
