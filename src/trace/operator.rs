//! What an operator does, as the `Event` of a line: `{"force":{"name":"Conveyor1.velocityTarget","value":0.2}}`.
//!
//! The same words are the bodies of the HTTP interface's requests. A replay obeys those that act on the plant; a pause or
//! another speed changes nothing about it.

use std::f64;

use serde::{Deserialize, Serialize};

use crate::engine::{Act, Fault, Insertion};
use crate::plant::PartKind;
use crate::signal_map::{RegisterId, SignalMap};
use crate::wire::{Raw, TextForm, read_value};

/// What an operator did, in the words of a trace.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Deed {
    Force(NamedValue),
    /// The signal that is forced no more.
    Release(String),
    Insert(NewPart),
    /// The number of a part.
    Remove(u64),
    Break(Broken),
    Mend(Broken),
    Pause(bool),
    /// Simulated seconds to a second; 0 for as fast as possible.
    Speed(f64),
}

/// A signal and the value that it is forced to, as it stands in a `SendValue`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NamedValue {
    pub name: String,
    pub value: serde_json::Value,
}

/// A part to put on a belt.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NewPart {
    pub kind: NewKind,
    /// Length, width, height, m.
    pub size: [f64; 3],
    /// The conveyor.
    pub on: String,
    /// Along its centre line from its start, m.
    pub station: f64,
    /// To the left of it, m.
    #[serde(default)]
    pub offset: f64,
    /// To the left from the running direction, rad.
    #[serde(default)]
    pub turn: f64,
}

/// What kind of part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum NewKind {
    Box,
    Pallet,
}

/// Something that breaks or is mended.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Broken {
    /// A report that stays what it is: a light barrier that sticks.
    Signal(String),
    /// An instance whose drives have no power.
    Drive(String),
    /// The automation's next message is lost.
    Message,
}

/// Why a deed is none.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DeedError {
    #[error("{0}")]
    Form(String),
    #[error("the plant has no signal {name:?}{}", near(.nearest.as_deref()))]
    Unknown { name: String, nearest: Option<String> },
    #[error("{name}: {problem}")]
    Value { name: String, problem: String },
}

fn near(nearest: Option<&str>) -> String {
    nearest.map(|name| format!("; did you mean {name:?}?")).unwrap_or_default()
}

impl Deed {
    /// Reads a deed.
    pub fn read(text: &str) -> Result<Deed, DeedError> {
        serde_json::from_str(text).map_err(|error| DeedError::Form(error.to_string()))
    }

    /// The deed as a trace has it, one JSON object.
    pub fn text(&self) -> String {
        serde_json::to_string(self).expect("texts and finite numbers always have a JSON form")
    }

    /// What it does to a plant with these signals; `None` where it only concerns how time goes by.
    pub fn act(&self, map: &SignalMap) -> Result<Option<Act>, DeedError> {
        Ok(Some(match self {
            Deed::Force(NamedValue { name, value }) => {
                let signal = register(map, name)?;
                let text = value.to_string();
                let unfit = |problem: String| DeedError::Value { name: name.clone(), problem };
                let raw = Raw::new(&text).map_err(|error| unfit(error.to_string()))?;
                let value = read_value(raw, map.signal(signal).ty, TextForm::Base64);
                let value = value.map_err(|error| unfit(error.message.to_string()))?;
                let number = value.to_f64().filter(|number| number.is_finite());
                if number.is_none() {
                    return Err(unfit("only numbers and switches can be forced".to_owned()));
                }
                Act::Force { signal, value }
            }
            Deed::Release(name) => Act::Release { signal: register(map, name)? },
            Deed::Insert(part) => Act::Insert(Insertion {
                kind: match part.kind {
                    NewKind::Box => PartKind::Box,
                    NewKind::Pallet => PartKind::Pallet,
                },
                size: part.size,
                belt: part.on.clone(),
                station: part.station,
                offset: part.offset,
                turn: part.turn,
            }),
            Deed::Remove(number) => Act::Remove { number: *number },
            Deed::Break(broken) => Act::Break(broken.fault(map)?),
            Deed::Mend(broken) => Act::Mend(broken.fault(map)?),
            Deed::Pause(_) | Deed::Speed(_) => return Ok(None),
        }))
    }
}

impl Broken {
    fn fault(&self, map: &SignalMap) -> Result<Fault, DeedError> {
        Ok(match self {
            Broken::Signal(name) => Fault::Stuck { signal: register(map, name)? },
            Broken::Drive(instance) => Fault::Dead { instance: instance.clone() },
            Broken::Message => Fault::Lost,
        })
    }
}

fn register(map: &SignalMap, name: &str) -> Result<RegisterId, DeedError> {
    map.register(name).ok_or_else(|| {
        let names = map.signals().iter().map(|signal| signal.name.as_str());
        DeedError::Unknown { name: name.to_owned(), nearest: nearest(name, names).map(str::to_owned) }
    })
}

/// The name that was perhaps meant.
fn nearest<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let rated = names.map(|other| (strsim::jaro_winkler(name, other), other));
    rated.filter(|(likeness, _)| *likeness > 0.85).max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, other)| other)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal_map::{Direction, Kind, RateClass, Signal};
    use crate::value::{ElementaryType, SignalType, Unit, Value};

    fn map() -> SignalMap {
        let signal = |name: &str, element| Signal {
            name: name.to_owned(),
            ty: SignalType::scalar(element),
            direction: Direction::Command,
            kind: Kind::Level,
            rate: RateClass::HighFrequency,
            unit: Unit::named("m/s").expect("a unit"),
            min: None,
            max: None,
            instance: "Belt".to_owned(),
            task: "T".to_owned(),
            property: "p".to_owned(),
        };
        SignalMap::new("p", vec![signal("Belt.speed", ElementaryType::Real), signal("Belt.on", ElementaryType::Bool)])
            .expect("two names")
    }

    fn check(text: &str, expect: Act) {
        let deed = Deed::read(text).expect(text);
        assert_eq!(deed.act(&map()), Ok(Some(expect)));
        assert_eq!(Deed::read(&deed.text()), Ok(deed), "it reads back");
    }

    #[test]
    fn deeds_become_acts() {
        let speed = RegisterId(0);
        check(r#"{"force":{"name":"Belt.speed","value":0.1}}"#, Act::Force { signal: speed, value: Value::Real(0.1) });
        check(
            r#"{"force":{"name":"Belt.on","value":true}}"#,
            Act::Force { signal: RegisterId(1), value: Value::Bool(true) },
        );
        check(r#"{"release":"Belt.speed"}"#, Act::Release { signal: speed });
        check(r#"{"remove":7}"#, Act::Remove { number: 7 });
        check(r#"{"break":{"signal":"Belt.on"}}"#, Act::Break(Fault::Stuck { signal: RegisterId(1) }));
        check(r#"{"mend":{"drive":"Belt"}}"#, Act::Mend(Fault::Dead { instance: "Belt".to_owned() }));
        check(r#"{"break":"message"}"#, Act::Break(Fault::Lost));
        let part = Insertion {
            kind: PartKind::Box,
            size: [0.3, 0.2, 0.1],
            belt: "Belt".to_owned(),
            station: 0.5,
            offset: 0.0,
            turn: 0.0,
        };
        check(r#"{"insert":{"kind":"box","size":[0.3,0.2,0.1],"on":"Belt","station":0.5}}"#, Act::Insert(part));
        assert_eq!(Deed::read(r#"{"pause":true}"#).expect("a pause").act(&map()), Ok(None));
    }

    #[test]
    fn what_is_none_is_told_with_what_was_meant() {
        let check = |text: &str, part: &str| {
            let error = Deed::read(text).and_then(|deed| deed.act(&map())).expect_err(text).to_string();
            assert!(error.contains(part), "{text}: {error}");
        };
        check(r#"{"release":"Belt.sped"}"#, "no signal \"Belt.sped\"; did you mean \"Belt.speed\"?");
        check(r#"{"force":{"name":"Belt.speed","value":"fast"}}"#, "Belt.speed: ");
        check(r#"{"force":{"name":"Belt.on","value":3}}"#, "Belt.on: ");
        check(r#"{"explode":1}"#, "unknown variant `explode`");
        check("[", "expected value");
    }
}
