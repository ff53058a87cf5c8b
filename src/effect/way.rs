//! A boolean sensor that follows only after a way: what it looks along must move on before it sees a change.

use crate::device::law::is_there;
use crate::device::path::STRETCH_S;

/// A switch with a way of its own.
#[derive(Clone, Debug)]
pub(super) struct Way {
    length: f64,
    /// Which state it takes on only after the way; the other at once.
    late: bool,
    exit: Option<bool>,
    /// Where what it looks along stood when its input changed.
    from: Option<f64>,
    /// Where that stands now.
    travel: f64,
    /// When it was last asked, and where it stood then.
    before: Option<(f64, f64)>,
    /// When the way will be over if it goes on as it went, or when that is to be asked again; none while nothing is waited for.
    due: Option<f64>,
}

impl Way {
    pub fn new(length: f64, late: bool) -> Way {
        Way { length, late, exit: None, from: None, travel: 0.0, before: None, due: None }
    }

    /// What it looks along stands there now.
    pub fn travelled(&mut self, travel: f64) {
        self.travel = travel;
    }

    /// What it shows while `input` is so.
    pub fn pass(&mut self, input: bool, now: f64) -> bool {
        let before = self.before.replace((now, self.travel));
        self.due = None;
        let exit = *self.exit.get_or_insert(input);
        if input == exit {
            self.from = None;
            return exit;
        }
        let from = *self.from.get_or_insert(self.travel);
        let left = self.length - (self.travel - from).abs();
        // That of the time since it was asked before.
        let speed = before.filter(|(then, _)| now > *then).map_or(0.0, |(then, at)| (self.travel - at) / (now - then));
        if input == self.late && !is_there(left, speed) {
            // Its speed may change until then, and is to be asked for again.
            self.due = Some(now + STRETCH_S.min(left / speed.abs()));
            return exit;
        }
        self.exit = Some(input);
        self.from = None;
        input
    }

    /// When it will change, if what it looks along goes on as it went, or is to be asked again.
    pub fn next(&self) -> Option<f64> {
        self.due
    }

    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.exit.map_or(-1.0, |exit| f64::from(u8::from(exit))));
        self.from.into_iter().for_each(visit);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_follows_after_its_way() {
        let mut way = Way::new(0.01, false);
        let mut check = |travel: f64, input: bool, exit: bool| {
            way.travelled(travel);
            assert_eq!(way.pass(input, 0.0), exit, "at {travel}");
        };
        check(0.0, false, false);
        check(1.0, true, true);
        check(1.1, false, true);
        check(1.109, false, true);
        check(1.105, true, true);
        check(1.2, false, true);
        check(1.19, false, false);
    }
}
