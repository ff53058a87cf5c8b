//! `kinetwin.LoadingBay`: a source that puts parts on a belt at its due instants.

use crate::device::law::schedule::Schedule;
use crate::device::table::{ANGLE, LENGTH, LONGEST_M, LONGEST_S, TIME, choice, instance, integer, number, numbers};
use crate::device::{BuildError, Device, Load, Role, Source, misfit, part_kind, triple};
use crate::plant::Parameters;
use crate::prototype::kind::KindDescriptor;

const SIZES: (f64, f64) = (0.001, LONGEST_M);

/// The kind's table.
pub static KIND: KindDescriptor = KindDescriptor {
    name: "kinetwin.LoadingBay",
    summary: "puts parts on a belt, one at each due instant if the place is free",
    ports: &[],
    parameters: &[
        instance("belt", "the conveyor that the parts are put on"),
        number(
            "at",
            LENGTH,
            (0.0, LONGEST_M),
            "0.15",
            "where the part's centre is put, along the belt's centre line from its start",
        ),
        number(
            "across",
            LENGTH,
            (-LONGEST_M, LONGEST_M),
            "0",
            "how far to the left of the centre line its centre is put",
        ),
        number("turn", ANGLE, (-7.0, 7.0), "0", "how far the part is turned to the left from the running direction"),
        choice("kind", &["box", "pallet"], "box", "what kind of part"),
        numbers("size", LENGTH, 3, SIZES, "0.3;0.2;0.2", "length, width and height of the part"),
        number("firstTime", TIME, (0.0, LONGEST_S), "1.0", "the first due instant"),
        number("interval", TIME, (0.001, LONGEST_S), "6.0", "time from one due instant to the next"),
        number(
            "spread",
            TIME,
            (0.0, LONGEST_S),
            "0",
            "each instant is late by up to this, evenly at random; at most the interval",
        ),
        integer(
            "limit",
            (0, i64::MAX),
            "0",
            "how many parts are put there at most, what they come loaded with apart; 0: no end",
        ),
        choice("loadKind", &["box", "pallet"], "box", "what kind of part stands on each part that is put there"),
        numbers("loadSize", LENGTH, 3, SIZES, "0.3;0.2;0.2", "length, width and height of each part of the load"),
        integer("loadRows", (0, 100), "0", "rows of the load along the part; 0: it comes empty"),
        integer("loadColumns", (0, 100), "0", "columns of the load across the part; 0: it comes empty"),
        integer("loadLayers", (0, 100), "0", "layers of the load, one on the other; 0: it comes empty"),
        number(
            "loadGap",
            LENGTH,
            (0.0, LONGEST_M),
            "0.01",
            "room between neighbours in a layer of the load, which is centred",
        ),
    ],
};

/// A bay with its schedule.
#[derive(Clone, Debug)]
struct LoadingBay {
    schedule: Schedule,
    source: Source,
}

/// Builds one; what is random about it follows from `seed` and the instance's name.
pub(super) fn build(parameters: &Parameters, instance: &str, seed: u64) -> Result<Box<dyn Device>, BuildError> {
    let [first, interval, spread] = ["firstTime", "interval", "spread"].map(|name| parameters.number(name));
    if spread > interval {
        let problem = format!("is {spread} s, more than the interval of {interval} s: parts would be due out of turn");
        return Err(misfit(instance, "spread", problem));
    }
    if parameters.text("belt").is_empty() {
        return Err(misfit(instance, "belt", "is missing: name the conveyor that the parts are put on"));
    }
    let counts = ["loadRows", "loadColumns", "loadLayers"].map(|name| parameters.integer(name) as u32);
    let load = Load {
        kind: part_kind(parameters.text("loadKind")),
        size: triple(parameters, "loadSize", instance)?,
        counts,
        gap: parameters.number("loadGap"),
    };
    let mut source = Source {
        at: [parameters.number("at"), parameters.number("across")],
        turn: parameters.number("turn"),
        kind: part_kind(parameters.text("kind")),
        size: triple(parameters, "size", instance)?,
        load: counts.iter().all(|count| *count > 0).then_some(load),
        limit: Some(parameters.integer("limit") as u64).filter(|limit| *limit > 0),
        due: Vec::new(),
    };
    let mut schedule = Schedule::new(first, interval, spread, instance, seed);
    schedule.advance(0.0, &mut source.due);
    Ok(Box::new(LoadingBay { schedule, source }))
}

impl Device for LoadingBay {
    fn command(&mut self, _port: usize, _value: f64) {}

    fn advance(&mut self, seconds: f64) {
        self.source.due.clear();
        self.schedule.advance(seconds, &mut self.source.due);
    }

    fn report(&mut self, _reports: &mut [f64]) {}

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        self.schedule.state(visit);
    }

    fn boxed(&self) -> Box<dyn Device> {
        Box::new(self.clone())
    }

    fn role(&self) -> Role<'_> {
        Role::Makes(&self.source)
    }
}

#[cfg(test)]
mod tests {
    use crate::device::bench::Bench;
    use crate::device::{Role, Source};

    fn source(bench: &Bench) -> Source {
        match bench.device.role() {
            Role::Makes(source) => source.clone(),
            other => panic!("a loading bay is {other:?}"),
        }
    }

    #[test]
    fn a_part_is_due_at_the_first_instant_and_every_interval_after() {
        let mut bay = Bench::new("kinetwin.LoadingBay", &[("belt", "Belt")]);
        let mut found = Vec::new();
        for step in 0..20_000 {
            if !source(&bay).due.is_empty() {
                found.push(step);
            }
            bay.device.advance(0.001);
        }
        assert_eq!(found, [1000, 7000, 13_000, 19_000]);
    }

    #[test]
    fn one_due_at_the_start_is_due_before_anything_moved() {
        let bay = Bench::new("kinetwin.LoadingBay", &[("belt", "Belt"), ("firstTime", "0")]);
        assert_eq!(source(&bay).due, [0.0]);
    }

    #[test]
    fn it_comes_loaded_if_rows_columns_and_layers_are_given() {
        let empty = Bench::new("kinetwin.LoadingBay", &[("belt", "Belt"), ("loadRows", "2")]);
        assert_eq!(source(&empty).load, None);
        let stack = [("belt", "Belt"), ("loadRows", "2"), ("loadColumns", "3"), ("loadLayers", "4"), ("limit", "7")];
        let source = source(&Bench::new("kinetwin.LoadingBay", &stack));
        assert_eq!((source.load.map(|load| load.counts), source.limit), (Some([2, 3, 4]), Some(7)));
    }

    #[test]
    fn what_cannot_be_is_refused() {
        let check = |parameters: &[(&str, &str)], expected: &str| {
            assert_eq!(Bench::error("kinetwin.LoadingBay", parameters), format!("Device1: {expected}"));
        };
        check(&[], "belt is missing: name the conveyor that the parts are put on");
        check(
            &[("belt", "Belt"), ("spread", "7")],
            "spread is 7 s, more than the interval of 6 s: parts would be due out of turn",
        );
    }
}
