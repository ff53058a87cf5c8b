//! Recorded traces: what a session exchanged, in order, with times. JSON Lines, `*.cps.jsonl`, or `*.cps.jsonl.zst`.
//!
//! The first line is the [`Header`]. Every further line is one message of the CPS-Protocol, verbatim, with its time `t`
//! (seconds since the start, never going back) and its sender `from`:
//!
//! ```json
//! {"trace":"kinetwin/1","source":"simulation","model":"models/rig","step_ns":1000000,"seed":7}
//! {"t":0.02,"from":"automation","SendValue":[{"name":"Belt.velocityTarget","value":0.5}]}
//! {"t":0.041,"from":"plant","SendValue":[{"name":"Belt.velocityActual","value":0.021}]}
//! ```
//!
//! `from` is `automation` (commands) or `plant` (what sensors and drives reported; in a simulated session, the
//! simulation), or `operator` or `engine` with an `Event` object in place of a message. A signal holds its last value
//! until a line changes it; values that change together stand in one line. Lines with equal times keep their order, the
//! automation's first.
//!
//! Between two commands a signal holds the earlier one. A header with `"commands":"sampled"` says otherwise: the recorded
//! commands of levels are samples of references that moved on straight lines between them, as a logger's rows have it. A
//! diagnosis goes by that.
//!
//! In a recording of ours, `t` is the simulated time of the step that took the command or produced the report, written
//! as an exact decimal: it reads back to the same nanosecond.
//!
//! A [`Reader`] streams, compressed or not. A torn last line loses that line alone ([`Reader::torn`]); any other
//! malformed line is an error that names the file, the line and the column. A [`Recorder`] joins what the two threads
//! of a run know into one trace. Readers and writers are handed in: no file is opened here.

mod cut;
mod excitation;
pub mod export;
mod header;
pub mod import;
mod info;
mod motion;
pub mod operator;
mod reader;
mod recorder;
mod rhythm;
mod seconds;
mod writer;

#[cfg(test)]
mod tests;

pub use cut::{CutError, Span, cut};
pub use excitation::{Excitation, excitations};
pub use header::{Commands, Header, Source};
pub use info::{Info, SignalInfo, Silence, info};
pub use motion::{Motion, motions};
pub use reader::{Body, LINE_LIMIT, Line, Reader, Sender, Torn, TraceError};
pub use recorder::{Record, Recorder};
pub use writer::{Compression, Writer};
