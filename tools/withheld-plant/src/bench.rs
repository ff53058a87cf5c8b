//! What several tests build.

use crate::quirk::Quirk;

/// An effect on a device.
pub fn quirk(device: &str, effect: &str, parameters: &[(&str, f64)]) -> Quirk {
    Quirk {
        device: device.to_owned(),
        component: None,
        effect: effect.to_owned(),
        place: String::new(),
        parameters: parameters.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect(),
        with: None,
    }
}

/// An effect on one of its axes or signals.
pub fn axis_quirk(device: &str, component: &str, effect: &str, parameters: &[(&str, f64)]) -> Quirk {
    Quirk { component: Some(component.to_owned()), ..quirk(device, effect, parameters) }
}
