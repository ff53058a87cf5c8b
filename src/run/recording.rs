//! Recording a run.

use super::{Facts, Options, RunError};
use crate::adapter::Witness;
use crate::pace::{Journal, NoJournal};
use crate::session::Staged;
use crate::signal_map::RegisterId;
use crate::time::Instant;
use crate::value::Value;

pub(super) struct Tap;
impl Tap {
    pub fn finish(self) {}
}
impl Witness for Tap {
    fn command(&mut self, _number: u64, _staged: &Staged) {}
    fn refused(&mut self, _text: &str) {}
    fn report(&mut self, _at: Instant, _values: &[(RegisterId, Value)]) {}
}
pub(super) struct Recording;
impl Recording {
    pub fn finish(self) -> Result<Option<String>, RunError> {
        Ok(None)
    }
}
/// Refuses to record: traces are not written yet.
pub(super) fn start(options: &Options, _facts: &Facts) -> Result<(Recording, Tap, Box<dyn Journal>), RunError> {
    if options.record.is_some() {
        return Err(RunError::Option("--record is not there yet".to_owned()));
    }
    Ok((Recording, Tap, Box::new(NoJournal)))
}
