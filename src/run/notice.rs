//! What happens in a run, in words for people.

use std::time::Duration;

use crate::adapter::Event;
use crate::engine::{Incident, IncidentKind};
use crate::session::{ClientEvent, Ending};
use crate::time::{Instant, format_duration};
use crate::wire::Fault;

/// Something that happened.
#[derive(Clone, Debug, PartialEq)]
pub struct Notice {
    /// When, on the run's wall clock.
    pub at: Instant,
    pub gravity: Gravity,
    pub text: String,
    /// Where in the plant, m; of what befell a part.
    pub place: Option<[f64; 3]>,
}

/// How much it matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Gravity {
    /// As it should be.
    Information,
    /// Something is wrong, and the run goes on.
    Warning,
    /// It cannot go on.
    Error,
}

/// What `event`, which happened at `now`, means; `None` for what is of no interest.
pub(super) fn notice(event: &Event, now: Instant) -> Option<Notice> {
    let (gravity, text) = match event {
        Event::Session(event) => session(event, now)?,
        Event::ValuesRefused(faults) => (Gravity::Warning, format!("refused values: {}", listed(faults))),
        // Said by the loss of the connection that follows, and where the run ends for it, at its end.
        Event::Denied(_) => return None,
        Event::ReportsLost { changes } => (
            Gravity::Warning,
            format!("lost {changes} changes: the automation did not read them in time; the connection is closed"),
        ),
        Event::CommandsLost { values } => (
            Gravity::Warning,
            format!("lost {values} values: they came faster than the simulation takes them; the connection is closed"),
        ),
    };
    Some(Notice { at: now, gravity, text, place: None })
}

/// What went wrong with a part, told at `now`.
pub(super) fn incident(incident: &Incident, now: Instant) -> Notice {
    let (IncidentKind::Lost { place, .. } | IncidentKind::Collision { place, .. }) = incident.kind;
    Notice { at: now, gravity: Gravity::Warning, text: incident.to_string(), place: Some(place) }
}

fn session(event: &ClientEvent, now: Instant) -> Option<(Gravity, String)> {
    let retry = |at: Instant| format!("; trying again in {}", rounded(at.since(now)));
    Some(match event {
        ClientEvent::Dial { .. } | ClientEvent::Values(_) => return None,
        ClientEvent::Established { server_name } => {
            (Gravity::Information, format!("session with {server_name:?} stands"))
        }
        ClientEvent::Refused { result, message, retry_at } => {
            let said = message.as_deref().map(|message| format!(": {message}")).unwrap_or_default();
            let then = retry_at.map_or_else(|| "; that is final".to_owned(), retry);
            let gravity = if retry_at.is_some() { Gravity::Warning } else { Gravity::Error };
            (gravity, format!("the server refused with {result}{said}{then}"))
        }
        ClientEvent::Lost { reason, retry_at, .. } => (Gravity::Warning, format!("{reason}{}", retry(*retry_at))),
        ClientEvent::Rejected { text, reason } => {
            (Gravity::Warning, format!("a message was refused, {reason}: {}", shortened(text)))
        }
        ClientEvent::Faults(faults) => (Gravity::Warning, format!("the server refused values: {}", listed(faults))),
        ClientEvent::Unsendable { reason, .. } => (Gravity::Warning, reason.clone()),
        ClientEvent::Notice(text) => (Gravity::Warning, text.clone()),
        ClientEvent::Ended(Ending::Disconnected) => (Gravity::Information, "session ended".to_owned()),
        ClientEvent::Ended(Ending::Unanswered) => {
            (Gravity::Warning, "session ended; the server did not acknowledge it".to_owned())
        }
        // Said by the refusal before.
        ClientEvent::Ended(Ending::Refused { .. }) => return None,
    })
}

/// The first few of `faults`, and how many more there are.
fn listed(faults: &[Fault]) -> String {
    const MOST: usize = 3;
    let mut texts: Vec<String> = faults.iter().take(MOST).map(ToString::to_string).collect();
    if faults.len() > MOST {
        texts.push(format!("and {} more", faults.len() - MOST));
    }
    texts.join("; ")
}

fn rounded(span: Duration) -> String {
    format_duration(Duration::from_millis(span.as_millis() as u64))
}

/// The beginning of a message, enough to know it by.
fn shortened(text: &str) -> String {
    const LONGEST: usize = 120;
    if text.chars().count() <= LONGEST {
        return text.to_owned();
    }
    let start: String = text.chars().take(LONGEST).collect();
    format!("{start}… ({} bytes)", text.len())
}
