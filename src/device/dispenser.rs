//! `kinetwin.Dispenser`: a magazine that lets one part onto a belt each time it is told to.

use crate::device::table::{
    ANGLE, LENGTH, LONGEST_M, choice, counter, indicator, instance, integer, number, numbers, switch,
};
use crate::device::{BuildError, Device, Role, Source, Surroundings, misfit, part_kind, triple};
use crate::plant::Parameters;
use crate::prototype::kind::KindDescriptor;

/// The kind's table.
pub static KIND: KindDescriptor = KindDescriptor {
    name: "kinetwin.Dispenser",
    summary: "a magazine that lets a part onto a belt at each rise of a command, if the place is free",
    ports: &[
        switch("release", "each rise lets one part go; where the place is taken it stays in the magazine"),
        counter("released", "how many parts it has let go"),
        counter("magazine", "how many parts are left in it; -1 where it has no end"),
        indicator("empty", "no part is left in it"),
    ],
    parameters: &[
        instance("belt", "the conveyor that the parts are put on"),
        number("at", LENGTH, (0.0, LONGEST_M), "0.15", "where the part's centre is put, along the belt's centre line"),
        number("across", LENGTH, (-LONGEST_M, LONGEST_M), "0", "how far to the left of the centre line"),
        number("turn", ANGLE, (-7.0, 7.0), "0", "how far the part is turned to the left from the running direction"),
        choice("kind", &["box", "pallet"], "box", "what kind of part"),
        numbers("size", LENGTH, 3, (0.001, LONGEST_M), "0.3;0.2;0.2", "length, width and height of the part"),
        integer("capacity", (0, i64::MAX), "0", "how many parts are in the magazine at the start; 0: no end"),
    ],
};

const RELEASE: usize = 0;
const RELEASED: usize = 1;
const MAGAZINE: usize = 2;
const EMPTY: usize = 3;

/// A magazine.
#[derive(Clone, Debug)]
struct Dispenser {
    release: bool,
    /// Whether a rise has come that no time has passed since.
    is_due: bool,
    released: u32,
    source: Source,
}

/// Builds one.
pub(super) fn build(parameters: &Parameters, instance: &str) -> Result<Box<dyn Device>, BuildError> {
    if parameters.text("belt").is_empty() {
        return Err(misfit(instance, "belt", "is missing: name the conveyor that the parts are put on"));
    }
    let source = Source {
        at: [parameters.number("at"), parameters.number("across")],
        turn: parameters.number("turn"),
        kind: part_kind(parameters.text("kind")),
        size: triple(parameters, "size", instance)?,
        load: None,
        limit: Some(parameters.integer("capacity") as u64).filter(|capacity| *capacity > 0),
        due: Vec::new(),
    };
    Ok(Box::new(Dispenser { release: false, is_due: false, released: 0, source }))
}

impl Device for Dispenser {
    fn command(&mut self, port: usize, value: f64) {
        if port == RELEASE {
            self.is_due |= value != 0.0 && !self.release;
            self.release = value != 0.0;
        }
    }

    fn sense(&mut self, surroundings: &Surroundings) {
        self.released = surroundings.made;
    }

    fn advance(&mut self, seconds: f64) {
        self.source.due.clear();
        if std::mem::take(&mut self.is_due) {
            self.source.due.push(seconds);
        }
    }

    fn report(&mut self, reports: &mut [f64]) {
        let left = self.source.limit.map(|limit| limit as f64 - f64::from(self.released));
        reports[RELEASED] = f64::from(self.released);
        reports[MAGAZINE] = left.unwrap_or(-1.0);
        reports[EMPTY] = f64::from(left == Some(0.0));
    }

    fn rests(&self) -> bool {
        !self.is_due && self.source.due.is_empty()
    }

    fn state(&self, visit: &mut dyn FnMut(f64)) {
        [self.release, self.is_due].iter().for_each(|flag| visit(f64::from(*flag)));
        visit(f64::from(self.released));
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
    use crate::device::{Role, Surroundings};

    fn due(bench: &Bench) -> Vec<f64> {
        match bench.device.role() {
            Role::Makes(source) => source.due.clone(),
            other => panic!("a dispenser is {other:?}"),
        }
    }

    #[test]
    fn each_rise_lets_one_part_go() {
        let mut magazine = Bench::new("kinetwin.Dispenser", &[("belt", "Belt"), ("capacity", "3")]);
        assert!(magazine.device.rests() && due(&magazine).is_empty());
        magazine.check(&[("release", 1.0)], 0.01, &[("magazine", 3.0), ("empty", 0.0)]);
        assert_eq!(due(&magazine), [0.01], "it fell when the command came");
        magazine.check(&[("release", 1.0)], 0.01, &[]);
        assert!(due(&magazine).is_empty(), "a level is no rise");
        magazine.check(&[("release", 0.0)], 0.01, &[]);
        magazine.check(&[("release", 1.0)], 0.01, &[]);
        assert_eq!(due(&magazine).len(), 1);
    }

    #[test]
    fn it_counts_what_found_its_place() {
        let mut magazine = Bench::new("kinetwin.Dispenser", &[("belt", "Belt"), ("capacity", "3")]);
        magazine.device.sense(&Surroundings { made: 3, ..Surroundings::default() });
        magazine.check(&[], 0.0, &[("released", 3.0), ("magazine", 0.0), ("empty", 1.0)]);
        let mut endless = Bench::new("kinetwin.Dispenser", &[("belt", "Belt")]);
        endless.check(&[], 0.0, &[("released", 0.0), ("magazine", -1.0), ("empty", 0.0)]);
    }

    #[test]
    fn without_a_belt_it_is_refused() {
        let error = Bench::error("kinetwin.Dispenser", &[]);
        assert_eq!(error, "Device1: belt is missing: name the conveyor that the parts are put on");
    }
}
