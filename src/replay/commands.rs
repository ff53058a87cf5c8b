//! What a recorded message of the automation's brings: exactly what the session took from it when it was live.

use std::sync::Arc;

use crate::session::Exchange;
use crate::signal_map::{Direction, RegisterId, SignalMap};
use crate::value::Value;
use crate::wire::Entry;

use super::report::Notices;

/// The receiving end of a session that is long over.
pub(super) struct Commands(Exchange);

impl Commands {
    pub fn new(map: Arc<SignalMap>) -> Commands {
        // The plant sets reports and takes commands.
        Commands(Exchange::new(map, Direction::Report))
    }

    /// The good values of a message; what the session refused, it refuses again.
    pub fn read(&mut self, text: &str, entries: &[Entry<'_>], notices: &mut Notices) -> Vec<(RegisterId, Value)> {
        match self.0.receive(text, entries).outcome {
            Ok(staged) => {
                for fault in staged.faults {
                    notices.add(format!("a command was left out: {fault}"));
                }
                staged.values
            }
            Err(reason) => {
                notices.add(format!("a message of commands was left out: {reason}"));
                Vec::new()
            }
        }
    }
}
