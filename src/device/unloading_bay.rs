//! `kinetwin.UnloadingBay`: a sink that takes parts off a belt.

use crate::device::table::{LENGTH, LONGEST_M, LONGEST_S, TIME, choice, instance, number};
use crate::device::{BuildError, Device, Place, Role, Sink, misfit};
use crate::plant::{Parameters, PartKind};
use crate::prototype::kind::KindDescriptor;

/// The kind's table.
pub static KIND: KindDescriptor = KindDescriptor {
    name: "kinetwin.UnloadingBay",
    summary: "takes parts off a belt where their centre passes its place",
    ports: &[],
    parameters: &[
        instance("belt", "the conveyor that the parts are taken from"),
        choice(
            "place",
            &["end", "start", "at"],
            "end",
            "taken at the end of the belt, at its start, or where `at` says",
        ),
        number("at", LENGTH, (0.0, LONGEST_M), "0", "with place at: where on the centre line, from the belt's start"),
        choice(
            "kind",
            &["any", "box", "pallet"],
            "any",
            "what kind of part it takes; what stands on a part goes with it",
        ),
        number("delay", TIME, (0.0, LONGEST_S), "0", "time from a part reaching the place until it is gone"),
    ],
};

/// A bay.
#[derive(Clone, Debug)]
struct UnloadingBay {
    sink: Sink,
}

/// Builds one.
pub(super) fn build(parameters: &Parameters, instance: &str) -> Result<Box<dyn Device>, BuildError> {
    if parameters.text("belt").is_empty() {
        return Err(misfit(instance, "belt", "is missing: name the conveyor that the parts are taken from"));
    }
    let place = match parameters.text("place") {
        "start" => Place::Start,
        "at" => Place::At(parameters.number("at")),
        _ => Place::End,
    };
    let kind = match parameters.text("kind") {
        "box" => Some(PartKind::Box),
        "pallet" => Some(PartKind::Pallet),
        _ => None,
    };
    Ok(Box::new(UnloadingBay { sink: Sink { place, kind, delay: parameters.number("delay") } }))
}

impl Device for UnloadingBay {
    fn command(&mut self, _port: usize, _value: f64) {}

    fn advance(&mut self, _seconds: f64) {}

    fn report(&mut self, _reports: &mut [f64]) {}

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}

    fn rests(&self) -> bool {
        true
    }

    fn boxed(&self) -> Box<dyn Device> {
        Box::new(self.clone())
    }

    fn role(&self) -> Role<'_> {
        Role::Takes(&self.sink)
    }
}

#[cfg(test)]
mod tests {
    use crate::device::bench::Bench;
    use crate::device::{Place, Role, Sink};
    use crate::plant::PartKind;

    fn check(parameters: &[(&str, &str)], expected: Sink) {
        let bay = Bench::new("kinetwin.UnloadingBay", parameters);
        match bay.device.role() {
            Role::Takes(sink) => assert_eq!(*sink, expected),
            other => panic!("an unloading bay is {other:?}"),
        }
    }

    #[test]
    fn it_takes_what_it_is_told_where_it_is_told() {
        check(&[("belt", "Out")], Sink { place: Place::End, kind: None, delay: 0.0 });
        check(
            &[("belt", "Out"), ("place", "at"), ("at", "0.5"), ("kind", "pallet"), ("delay", "2")],
            Sink { place: Place::At(0.5), kind: Some(PartKind::Pallet), delay: 2.0 },
        );
        check(
            &[("belt", "Out"), ("place", "start"), ("kind", "box")],
            Sink { place: Place::Start, kind: Some(PartKind::Box), delay: 0.0 },
        );
    }

    #[test]
    fn without_a_belt_it_is_refused() {
        let error = Bench::error("kinetwin.UnloadingBay", &[]);
        assert_eq!(error, "Device1: belt is missing: name the conveyor that the parts are taken from");
    }
}
