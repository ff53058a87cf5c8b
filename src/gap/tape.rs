//! What a device did since a copy of it was kept, so that it can be brought back to any instant since: a copy before every
//! step, in case something happens in it, would cost more than all steps.

use super::alone::Alone;
use super::subject::Run;

/// How many steps a copy is kept for.
const STEPS: usize = 16;

/// A copy, and what the device did since.
pub(super) struct Tape {
    kept: Alone,
    acts: Vec<Act>,
    steps: usize,
    /// Whether the device is looked at after every act.
    looks: bool,
}

enum Act {
    Advance(f64),
    Obey(usize),
    Look,
}

impl Tape {
    /// Begins at the device as it is; `looks` says whether it is looked at after every act.
    pub fn new(alone: &Alone, looks: bool) -> Tape {
        Tape { kept: alone.clone(), acts: Vec::new(), steps: 0, looks }
    }

    /// It has moved smoothly to `at`, and is `alone` now.
    pub fn advanced(&mut self, at: f64, alone: &Alone) {
        self.steps += 1;
        if self.steps < STEPS {
            self.acts.push(Act::Advance(at));
        } else {
            self.begin(alone);
        }
    }

    /// Begins anew at the device as it is.
    pub fn begin(&mut self, alone: &Alone) {
        self.kept.clone_from(alone);
        self.acts.clear();
        self.steps = 0;
    }

    /// It has obeyed a command of the run.
    pub fn obeyed(&mut self, command: usize) {
        self.acts.push(Act::Obey(command));
    }

    /// It was looked at.
    pub fn looked(&mut self) {
        self.acts.push(Act::Look);
    }

    /// The device as it was after all that is on the tape, by the same acts: to the last bit.
    pub fn rewound(&self, run: &Run) -> Alone {
        let mut alone = self.kept.clone();
        for act in &self.acts {
            match act {
                Act::Advance(at) => {
                    alone.advance_to(*at);
                }
                Act::Obey(command) => alone.obey(run, *command),
                Act::Look => {}
            }
            if self.looks || matches!(act, Act::Look) {
                alone.look();
            }
        }
        alone
    }
}
