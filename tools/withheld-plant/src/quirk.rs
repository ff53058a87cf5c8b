//! What a plant has beyond its nominal law: the truth of a case.

use serde::{Deserialize, Serialize};

/// One effect on one device. Its words are those of the library where the library has it; what the library lacks begins
/// with `x-`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Quirk {
    pub device: String,
    /// The axis or signal it acts on, where the device has several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub component: Option<String>,
    pub effect: String,
    pub place: String,
    /// In SI units, by the names of the library.
    pub parameters: Vec<(String, f64)>,
    /// The other signal of a swap.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub with: Option<String>,
}

/// An effect by its names: one of those that a recording cannot tell apart.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Member {
    pub device: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub component: Option<String>,
    pub effect: String,
    pub place: String,
}

impl Quirk {
    /// Its names.
    pub fn member(&self) -> Member {
        let Quirk { device, component, effect, place, .. } = self.clone();
        Member { device, component, effect, place }
    }

    /// A parameter; 0 where it has none of that name.
    pub fn value(&self, name: &str) -> f64 {
        self.parameters.iter().find(|(own, _)| own == name).map_or(0.0, |(_, value)| *value)
    }
}

/// All that one device, or one axis of it, has.
#[derive(Clone, Copy, Debug)]
pub struct Quirks<'a> {
    all: &'a [Quirk],
    device: &'a str,
    component: Option<&'a str>,
}

impl<'a> Quirks<'a> {
    /// Those of `device`.
    pub fn of(all: &'a [Quirk], device: &'a str) -> Quirks<'a> {
        Quirks { all, device, component: None }
    }

    /// Those of one axis of it.
    pub fn on(self, component: &'a str) -> Quirks<'a> {
        Quirks { component: Some(component), ..self }
    }

    /// The effect of this name in the device itself; links and sensors are asked of by [`at`](Quirks::at).
    pub fn get(self, effect: &str) -> Option<&'a Quirk> {
        let Quirks { all, device, component } = self;
        all.iter().find(|quirk| {
            let fits = component.is_none_or(|component| quirk.component.as_deref() == Some(component));
            quirk.device == device && quirk.effect == effect && fits
        })
    }

    /// A parameter of the effect of this name, if there is one.
    pub fn value(self, effect: &str, parameter: &str) -> Option<f64> {
        self.get(effect).map(|quirk| quirk.value(parameter))
    }

    /// The nominal parameter of this name: as it is, unless it is wrong.
    pub fn parameter(self, name: &str, nominal: f64) -> f64 {
        let wrong = self.all.iter().find(|quirk| {
            quirk.device == self.device && quirk.effect == "parameter-error" && quirk.component.as_deref() == Some(name)
        });
        wrong.map_or(nominal, |quirk| quirk.value("value"))
    }

    /// What stands at `place` of this signal.
    pub fn at(self, place: &'a str, signal: &'a str) -> impl Iterator<Item = &'a Quirk> {
        let Quirks { all, device, .. } = self;
        all.iter().filter(move |quirk| {
            let fits = quirk.component.as_deref().is_none_or(|component| component == signal);
            quirk.device == device && quirk.place == place && fits
        })
    }
}
