//! What can be set about an instance: a parameter of `prototype.xml` or a property of `avatar.xml`.

use super::basic::BasicType;
use super::quantity::{NumberError, parse_numbers, to_si};
use super::words;
use crate::signal_map::xml::unit;
use crate::value::{Quantity, Unit};
use crate::xml::{Element, Faults, Located};

/// Something about an instance that can be set, with the value it has where nobody sets it.
#[derive(Clone, Debug)]
pub struct Setting {
    pub name: Located<String>,
    pub ty: BasicType,
    /// The value where nobody sets it, as written.
    pub default: Located<String>,
    /// The unit of numbers that stand without; SI where none is declared.
    pub unit: Option<Unit>,
    /// How far the real device may lie from the value, relative; `None` where the prototype does not say.
    pub tolerance: Option<f64>,
    /// What numbers have to fulfil.
    pub constraints: Vec<Constraint>,
}

impl Setting {
    /// Reads `<… name type unit? tolerance?>` with its default in the attribute `default`, which may be empty.
    pub(super) fn read(
        element: &Element,
        default: &str,
        constraints: Vec<Constraint>,
        faults: &mut Faults,
    ) -> Option<Setting> {
        let (name, ty) = (words::identifier(element, "name", faults), words::basic_type(element, faults));
        let (unit, tolerance) = (unit(element, faults), words::tolerance(element, faults));
        let Some(value) = element.attribute(default) else {
            let found = format!("<{}> has no attribute {default:?}", element.name.value);
            faults.push(element.name.fault(found, format!("expected {default}=\"…\" in this element")));
            return None;
        };
        if let (Some(ty), Some(unit)) = (ty, &unit)
            && !ty.is_numeric()
        {
            faults.push(unit.fault(format!("a unit for a {ty}"), "expected units at numbers only"));
        }
        let unit = unit.map(|unit| unit.value);
        Some(Setting { name: name?, ty: ty?, default: value.clone(), unit, tolerance, constraints })
    }

    /// What `value`, set for this, is not; `None` if it is all that the constraints ask.
    pub fn violated(&self, value: &str) -> Option<&Constraint> {
        let numbers = numbers_of_any_unit(value, self.unit).ok()?;
        let scale = |bound: f64| self.unit.map_or(bound, |unit| to_si(bound, unit));
        self.constraints.iter().find(|constraint| {
            let bound = scale(constraint.bound);
            !numbers.iter().all(|number| constraint.relation.holds(*number, bound))
        })
    }
}

/// The numbers of `text` in the SI units of whatever quantity they are.
fn numbers_of_any_unit(text: &str, declared: Option<Unit>) -> Result<Vec<f64>, NumberError> {
    let every: Vec<Quantity> = Unit::ALL.iter().map(|unit| unit.quantity).collect();
    parse_numbers(text, declared, &every)
}

/// How a number has to stand to a bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    Above,
    AtLeast,
    Below,
    AtMost,
}

impl Relation {
    fn holds(self, number: f64, bound: f64) -> bool {
        match self {
            Relation::Above => number > bound,
            Relation::AtLeast => number >= bound,
            Relation::Below => number < bound,
            Relation::AtMost => number <= bound,
        }
    }
}

/// A constraint of a parameter, as `>0` in the reference; in the parameter's unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Constraint {
    /// As written.
    pub text: String,
    pub relation: Relation,
    pub bound: f64,
}

impl Constraint {
    /// Reads comparisons joined by commas: `>0`, `>=0, <10`. The reference calls constraints hints for people; a text
    /// that starts with no comparison is left to them.
    pub(super) fn read(text: &Located<String>, faults: &mut Faults) -> Vec<Constraint> {
        if !text.value.trim_start().starts_with(['<', '>']) {
            return Vec::new();
        }
        let mut constraints = Vec::new();
        for part in text.value.split(',') {
            match Constraint::parse(part.trim()) {
                Some(constraint) => constraints.push(constraint),
                None => {
                    let found = format!("{part:?} is no constraint");
                    faults.push(text.fault(found, "expected comparisons with a number: >0, or >=0, <10"));
                }
            }
        }
        constraints
    }

    fn parse(part: &str) -> Option<Constraint> {
        let known =
            [(">=", Relation::AtLeast), ("<=", Relation::AtMost), (">", Relation::Above), ("<", Relation::Below)];
        let (sign, relation) = known.into_iter().find(|(sign, _)| part.starts_with(sign))?;
        let bound: f64 = part[sign.len()..].trim().parse().ok()?;
        bound.is_finite().then(|| Constraint { text: part.to_owned(), relation, bound })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constraints_are_comparisons_with_numbers() {
        let check = |text: &str, expect: Option<(Relation, f64)>| {
            assert_eq!(Constraint::parse(text).map(|read| (read.relation, read.bound)), expect, "{text}");
        };
        check(">0", Some((Relation::Above, 0.0)));
        check(">= 0.5", Some((Relation::AtLeast, 0.5)));
        check("<1e3", Some((Relation::Below, 1000.0)));
        check("<=-1", Some((Relation::AtMost, -1.0)));
        check("=1", None);
        check(">", None);
        check(">inf", None);
    }
}
