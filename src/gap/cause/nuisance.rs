//! Nominal parameters that may be off within their tolerances: fitted with every candidate, so that no effect is found where a
//! drum is a per cent too large, and none hides in one.

use crate::gap::fit::{Range, sum_of_squares};
use crate::gap::{Overrides, Prediction, Subject};
use crate::plant::ParameterValue;

/// A nominal parameter with a tolerance.
#[derive(Clone, Debug, PartialEq)]
pub struct Nuisance {
    pub name: &'static str,
    pub nominal: f64,
    /// A tolerance is taken for two standard deviations.
    pub deviation: f64,
    /// How many standard deviations off it is looked for.
    pub reach: f64,
}

/// Within its tolerance, and a twentieth of it for what the fit leaves open: further off it is a parameter that is wrong, which is an
/// effect.
const WITHIN: f64 = 2.1;
/// Of a device that is taken up again and again, whose law is not all of the truth, by which its parameters are pulled.
const BEYOND: f64 = 4.0;

impl Nuisance {
    /// How many standard deviations a value is off.
    pub fn strain(&self, value: f64) -> f64 {
        (value - self.nominal) / self.deviation
    }

    /// The value that is so many standard deviations off.
    pub fn at(&self, strain: f64) -> f64 {
        self.nominal + strain * self.deviation
    }

    /// Where it is looked for.
    pub fn range(&self) -> Range {
        let reach = self.reach * self.deviation;
        Range { least: self.nominal - reach, greatest: self.nominal + reach, scale: self.deviation }
    }
}

/// Below this whitened squared distance for a standard deviation a parameter's tolerance does not show: edges at the end of a cycle
/// show more than their scatter over it says.
const UNSEEN: f64 = 0.05;

/// The parameters of `subject` with a tolerance that its reports depend on.
pub fn nuisances(subject: &Subject, nominal: &Prediction) -> Vec<Nuisance> {
    let reach = if subject.is_taken_up_again() { BEYOND } else { WITHIN };
    let declared = subject.parameters.0.iter().filter_map(|(name, parameter)| match parameter.value {
        ParameterValue::Number(value) if parameter.tolerance > 0.0 && value != 0.0 => {
            Some(Nuisance { name, nominal: value, deviation: 0.5 * parameter.tolerance * value.abs(), reach })
        }
        _ => None,
    });
    // Some show one way only: a part that is put into a beam cuts it from then on, however deep in it.
    let is_seen = |nuisance: &Nuisance| {
        [1.0, -1.0].into_iter().any(|strain| {
            let off = Overrides::one(nuisance.name, nuisance.at(strain));
            let moved = subject.predict(&[], &off).map(|moved| sum_of_squares(&subject.apart(nominal, &moved)));
            moved.is_ok_and(|moved| moved > UNSEEN)
        })
    };
    declared.filter(is_seen).collect()
}
