//! What an exam's rates must not fall below, or rise above.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::rates::Rates;

/// The bounds of rates, by their names in `exam.json`.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(transparent)]
pub struct Floor(BTreeMap<String, Bound>);

/// What a rate must be; of a rate without a case, nothing is asked.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
struct Bound {
    at_least: Option<f64>,
    at_most: Option<f64>,
}

impl Floor {
    /// Reads the bounds from a JSON object: `{"single_right": {"at_least": 0.5}, "false_alarm": {"at_most": 0.0}}`.
    ///
    /// # Errors
    /// What is wrong, and what was expected.
    pub fn from_json(text: &str) -> Result<Floor, String> {
        let floor: Floor = serde_json::from_str(text)
            .map_err(|error| format!("{error}: expected {{\"NAME\": {{\"at_least\": NUMBER}}}} or at_most"))?;
        let rates = values(&Rates::default());
        match floor.0.keys().find(|name| !rates.contains_key(name.as_str())) {
            None => Ok(floor),
            Some(name) => {
                let known: Vec<&str> = rates.keys().copied().collect();
                Err(format!("{name:?} is no rate of an exam: expected one of {}", known.join(", ")))
            }
        }
    }

    /// A sentence for each bound that `rates` break.
    pub fn broken(&self, rates: &Rates) -> Vec<String> {
        let rates = values(rates);
        let mut broken = Vec::new();
        for (name, bound) in &self.0 {
            let Some(rate) = rates.get(name.as_str()).copied().flatten() else { continue };
            if let Some(least) = bound.at_least.filter(|least| rate < *least) {
                broken.push(format!("{name} is {rate:.3}, less than its floor of {least}"));
            }
            if let Some(most) = bound.at_most.filter(|most| rate > *most) {
                broken.push(format!("{name} is {rate:.3}, more than the {most} that it may be"));
            }
        }
        broken
    }
}

/// The value of each rate, by its name.
fn values(rates: &Rates) -> BTreeMap<&'static str, Option<f64>> {
    rates.shown().into_iter().map(|shown| (shown.id, shown.rate.value)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exam::Rate;

    fn rates() -> Rates {
        let rate = |value| Rate { value: Some(value), n: 4, ci95: None };
        Rates { single_right: rate(0.5), false_alarm: rate(0.25), ..Rates::default() }
    }

    #[track_caller]
    fn check(floor: &str, broken: &[&str]) {
        assert_eq!(Floor::from_json(floor).expect(floor).broken(&rates()), broken);
    }

    #[test]
    fn what_falls_below_or_rises_above_is_named() {
        check(r#"{"single_right": {"at_least": 0.5}, "false_alarm": {"at_most": 0.25}}"#, &[]);
        check(
            r#"{"single_right": {"at_least": 0.75}, "false_alarm": {"at_most": 0}}"#,
            &[
                "false_alarm is 0.250, more than the 0 that it may be",
                "single_right is 0.500, less than its floor of 0.75",
            ],
        );
        // No case, no rate.
        check(r#"{"both_of_two": {"at_least": 1}}"#, &[]);
    }

    #[test]
    fn a_name_that_no_rate_has_is_refused_with_those_that_there_are() {
        let error = Floor::from_json(r#"{"single_rigth": {"at_least": 0.5}}"#).expect_err("a name nobody knows");
        assert!(error.starts_with("\"single_rigth\" is no rate of an exam: expected one of "), "{error}");
        assert!(error.contains("single_right"), "{error}");
        assert!(Floor::from_json(r#"{"single_right": {"least": 0.5}}"#).is_err());
    }
}
