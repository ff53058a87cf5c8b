//! `inverted`: a signal has the wrong sign or sense: a BOOL is negated, a number has the other sign; a code that has no
//! other sign (0 hold, 1 extend, 2 retract) has its two ways exchanged.
//!
//! Source: crossed terminals, or a negated contact (IEC 61131-3:2013, table 75).

use super::table::BASE;
use crate::device::path::{Moment, Stage};
use crate::effect::{Build, EffectDescriptor, Fit, SignalClass};
use crate::plant::EffectPlace;

/// Its line in the registry.
pub static EFFECT: EffectDescriptor = EffectDescriptor {
    id: "inverted",
    summary: "a signal has the wrong sign or sense",
    equation: "BOOL: y = not x; number: y = −x",
    source: "a negated contact, IEC 61131-3:2013, table 75",
    places: &[EffectPlace::CommandLink, EffectPlace::ReportLink],
    fits: &[Fit::Signals(SignalClass::Any)],
    parameters: &[],
    acts_always: true,
    excited_by: "the signal being anything but 0",
    build: Build::Stage(|_, site| {
        Box::new(Inverted {
            is_boolean: site.is_boolean(),
            // Codes from 0 up: 0 stays, and the others run the other way.
            codes: site
                .port
                .and_then(|port| port.range)
                .filter(|(least, _)| *least == 0.0)
                .map(|(_, greatest)| greatest),
        })
    }),
    ..BASE
};

#[derive(Clone, Debug)]
struct Inverted {
    is_boolean: bool,
    codes: Option<f64>,
}

impl Stage for Inverted {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn signal(&mut self, value: f64, _moment: Moment) -> f64 {
        match self.codes {
            _ if self.is_boolean => f64::from(u8::from(value == 0.0)),
            Some(_) if value == 0.0 => 0.0,
            Some(greatest) => greatest + 1.0 - value,
            // No negative zero.
            None => 0.0 - value,
        }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    #[test]
    fn senses_signs_and_codes_are_turned_round() {
        let inverted = |place, component| [spec(place, "inverted", Some(component), &[])];
        let mut belt = with("StraightConveyor", &[], &inverted("report-link", "driveEnabled"));
        belt.check(&[], 0.0, &[("driveEnabled", 1.0)]);
        belt.check(&[("motorDirection", 1.0)], 0.0, &[("driveEnabled", 0.0)]);
        let run = [("velocityTarget", 0.5), ("motorDirection", 1.0)];
        let mut belt = with("StraightConveyor", &[], &inverted("command-link", "motorDirection"));
        belt.check(&run, 1.0, &[("velocityActual", -0.5)]);
        let mut pusher = with("Pusher", &[], &inverted("command-link", "command"));
        pusher.check(&[("command", 2.0)], 1.0, &[("limitExtended", 1.0)]);
        pusher.check(&[("command", 1.0)], 1.0, &[("limitRetracted", 1.0)]);
    }
}
