//! A trace that is begun and ended while a run goes on.
//!
//! Every line of the session passes through here on the recorder's thread. Between two recordings only the last value of
//! every signal is kept, so that a trace begun in the middle knows of every signal what the whole would have known: it
//! begins as a cut does (`trace cut`).

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::rc::Rc;

use serde_json::Value;

use crate::time::Instant;
use crate::trace::{Compression, Header, Sender, Writer};

/// The recorder's output: lines go where the ledger lies open, or are noted and forgotten.
#[derive(Clone)]
pub(super) struct Ledger(Rc<RefCell<Book>>);

struct Book {
    header: Header,
    /// The last value of every signal as JSON, by its sender.
    last: [BTreeMap<String, Value>; 2],
    /// The time of the last line.
    at: Instant,
    open: Option<Volume>,
    /// Whether the recorder has said its header, which every volume has of its own.
    has_begun: bool,
}

/// The trace that is being written.
struct Volume {
    path: PathBuf,
    partial: PathBuf,
    writer: Writer<BufWriter<File>>,
    /// Why nothing more is written.
    failed: Option<io::Error>,
}

impl Ledger {
    /// Closed; `header` is that of every trace it will write.
    pub fn new(header: Header) -> Ledger {
        let last = [BTreeMap::new(), BTreeMap::new()];
        Ledger(Rc::new(RefCell::new(Book { header, last, at: Instant::ZERO, open: None, has_begun: false })))
    }

    /// Begins a trace.
    pub fn begin(&self, path: &Path) -> io::Result<()> {
        let mut book = self.0.borrow_mut();
        let partial = partial(path);
        let file = BufWriter::with_capacity(1 << 16, File::create(&partial)?);
        let mut writer = Writer::new(file, Compression::of(&path.to_string_lossy()), &book.header)?;
        for (sender, last) in [Sender::Automation, Sender::Plant].into_iter().zip(&book.last) {
            if !last.is_empty() {
                let entry = |(name, value): (&String, &Value)| serde_json::json!({"name": name, "value": value});
                let entries: Vec<Value> = last.iter().map(entry).collect();
                writer.message(book.at, sender, &serde_json::json!({"SendValue": entries}).to_string())?;
            }
        }
        book.open = Some(Volume { path: path.to_owned(), partial, writer, failed: None });
        Ok(())
    }

    /// Ends the trace that is being written, if there is one. The file.
    pub fn end(&self) -> io::Result<Option<PathBuf>> {
        let Some(volume) = self.0.borrow_mut().open.take() else { return Ok(None) };
        if let Some(failed) = volume.failed {
            return Err(failed);
        }
        volume.writer.finish()?.flush()?;
        File::open(&volume.partial)?.sync_all()?;
        fs::rename(&volume.partial, &volume.path)?;
        Ok(Some(volume.path))
    }
}

/// Under which name a trace is written until it is whole.
pub(super) fn partial(path: &Path) -> PathBuf {
    let mut partial = path.to_owned().into_os_string();
    partial.push(".partial");
    PathBuf::from(partial)
}

impl Book {
    fn note(&mut self, line: &str) {
        let Ok(Value::Object(mut line)) = serde_json::from_str::<Value>(line) else { return };
        if let Some(seconds) = line.get("t").and_then(Value::as_f64) {
            self.at = Instant::from_nanos((seconds * 1e9).round() as i64);
        }
        let side = usize::from(line.get("from").and_then(Value::as_str) != Some("automation"));
        let Some(Value::Array(entries)) = line.get_mut("SendValue").map(Value::take) else { return };
        for mut entry in entries {
            let value = entry["value"].take();
            if let Some(name) = entry["name"].as_str() {
                self.last[side].insert(name.to_owned(), value);
            }
        }
    }
}

/// The recorder writes each line at once.
impl Write for Ledger {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut book = self.0.borrow_mut();
        let line = std::str::from_utf8(bytes).unwrap_or_default().trim_end();
        if !std::mem::replace(&mut book.has_begun, true) {
            return Ok(bytes.len());
        }
        book.note(line);
        let at = book.at;
        if let Some(volume) = book.open.as_mut().filter(|volume| volume.failed.is_none()) {
            // The recorder itself must go on: who ends this trace learns of it.
            volume.failed = volume.writer.line(at, line).err();
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn say(ledger: &mut Ledger, line: &str) {
        ledger.write_all(format!("{line}\n").as_bytes()).expect("a noted line");
    }

    #[test]
    fn a_trace_begun_in_the_middle_knows_the_last_values() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("middle.cps.jsonl");
        let mut ledger = Ledger::new(Header::default());
        say(&mut ledger, r#"{"trace":"kinetwin/1","source":"simulation"}"#);
        say(
            &mut ledger,
            r#"{"t":0.1,"from":"automation","SendValue":[{"name":"a","value":1},{"name":"b","value":true}]}"#,
        );
        say(&mut ledger, r#"{"t":0.2,"from":"automation","SendValue":[{"name":"a","value":2}]}"#);
        say(&mut ledger, r#"{"t":0.3,"from":"plant","SendValue":[{"name":"c","value":0.5}]}"#);
        ledger.begin(&path).expect("a trace");
        say(&mut ledger, r#"{"t":0.4,"from":"operator","Event":{"release":"a"}}"#);
        assert_eq!(ledger.end().expect("ended"), Some(path.clone()));
        say(&mut ledger, r#"{"t":0.5,"from":"plant","SendValue":[{"name":"c","value":0.6}]}"#);
        assert_eq!(ledger.end().expect("nothing to end"), None);
        let text = fs::read_to_string(&path).expect("the trace");
        let expected = concat!(
            "{\"trace\":\"kinetwin/1\",\"source\":\"unknown\"}\n",
            "{\"t\":0.3,\"from\":\"automation\",\"SendValue\":[{\"name\":\"a\",\"value\":2},{\"name\":\"b\",\"value\":true}]}\n",
            "{\"t\":0.3,\"from\":\"plant\",\"SendValue\":[{\"name\":\"c\",\"value\":0.5}]}\n",
            "{\"t\":0.4,\"from\":\"operator\",\"Event\":{\"release\":\"a\"}}\n",
        );
        assert_eq!(text, expected);
    }
}
