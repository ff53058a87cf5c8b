//! The first line of a trace.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// The word that a trace begins with: the format and its version.
pub(super) const FORMAT: &str = "kinetwin/1";

/// Who stood at the plant's end when it was recorded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Source {
    /// A real machine.
    Plant,
    /// A simulation.
    Simulation,
    /// Nobody said.
    #[default]
    Unknown,
}

/// What stands between two recorded commands of a level.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Commands {
    /// The earlier one, until the later one comes: messages.
    #[default]
    Held,
    /// A straight line from one to the other: rows of a logger that sampled references under way.
    Sampled,
}

impl Commands {
    fn are_held(&self) -> bool {
        *self == Commands::Held
    }
}

/// What a trace says about itself. All but the source may be absent.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Header {
    /// The date and time of t = 0, as ISO 8601 writes them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<String>,
    /// Who stood at the plant's end.
    #[serde(default)]
    pub source: Source,
    /// The model of the plant: `models/rig`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub model: Option<String>,
    /// Free text.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
    /// A simulation's step in nanoseconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub step_ns: Option<u64>,
    /// A simulation's seed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
    /// Tells models apart that have one name: made of the simulation's model, compared as it stands.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub model_hash: Option<String>,
    /// What stands between two commands of one level: `held` where the header says nothing, or `sampled`.
    #[serde(default, skip_serializing_if = "Commands::are_held")]
    pub commands: Commands,
    /// Reports that another clock stamped than the one of the commands, by that clock's name: a data logger beside the PLC. Names
    /// of signals, or of instances for all of their reports.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub clocks: BTreeMap<String, Vec<String>>,
}

/// The word that makes it a header.
#[derive(Deserialize)]
struct Version {
    trace: String,
}

/// Reads the first line. The error is the column (from 1) and what is wrong there.
pub(super) fn read_header(line: &str) -> Result<Header, (usize, String)> {
    // First the format alone: what another version writes beside it is its own business.
    let version: Version = serde_json::from_str(line).map_err(|error| explain(&error))?;
    if version.trace != FORMAT {
        let problem = format!("a trace of format {:?}: expected {FORMAT:?}", version.trace);
        return Err((1, problem));
    }
    let header: Header = serde_json::from_str(line).map_err(|error| explain(&error))?;
    if header.step_ns == Some(0) {
        return Err((1, "the header's \"step_ns\" is 0: expected the simulation's step in nanoseconds".to_owned()));
    }
    Ok(header)
}

fn explain(error: &serde_json::Error) -> (usize, String) {
    let text = error.to_string();
    // The place stands in the column already; a header has one line.
    let reason = text.rsplit_once(" at line ").map_or(text.as_str(), |(reason, _)| reason);
    (error.column().max(1), format!("no header of a trace, {{\"trace\":\"{FORMAT}\",\"source\":…}}: {reason}"))
}

/// Writes the first line, without its line break.
pub(super) fn write_header(header: &Header) -> String {
    #[derive(Serialize)]
    struct FirstLine<'a> {
        trace: &'static str,
        #[serde(flatten)]
        header: &'a Header,
    }
    let line = FirstLine { trace: FORMAT, header };
    serde_json::to_string(&line).expect("texts and numbers always have a JSON form")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_reads_back_as_it_is_written() {
        let header = Header {
            start: Some("2026-01-31T08:00:00Z".to_owned()),
            source: Source::Plant,
            model: Some("models/depalletizer".to_owned()),
            note: Some("free \"text\"".to_owned()),
            step_ns: Some(1_000_000),
            seed: Some(u64::MAX),
            model_hash: Some("0123456789abcdef".to_owned()),
            commands: Commands::Sampled,
            clocks: BTreeMap::from([("logger".to_owned(), vec!["Belt".to_owned()])]),
        };
        assert_eq!(read_header(&write_header(&header)), Ok(header));
        assert_eq!(write_header(&Header::default()), r#"{"trace":"kinetwin/1","source":"unknown"}"#);
        assert_eq!(read_header(r#"{"trace":"kinetwin/1","later":[1]}"#), Ok(Header::default()));
    }

    #[test]
    fn what_is_no_header_is_refused_with_what_was_expected() {
        let check = |line: &str, column: usize, part: &str| {
            let (at, problem) = read_header(line).expect_err(line);
            assert!(at == column && problem.contains(part), "{line}: {at}: {problem}");
        };
        check("", 1, "no header of a trace");
        check("{}", 2, "missing field `trace`");
        check(r#"{"trace":"kinetwin/2","source":5}"#, 1, "a trace of format \"kinetwin/2\": expected \"kinetwin/1\"");
        check(r#"{"trace":"kinetwin/1","source":"robot"}"#, 38, "unknown variant `robot`");
        check(r#"{"trace":"kinetwin/1","step_ns":0}"#, 1, "\"step_ns\" is 0");
        check(r#"{"t":0.0,"from":"plant","SendValue":[]}"#, 39, "missing field `trace`");
    }
}
