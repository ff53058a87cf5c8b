//! Recording a run: a thread of its own joins what the simulation and the IO thread know, and writes.
//!
//! Both put what they know into one lock-free queue, and never wait: what a step took stands there before the step's cycle
//! is published, a report after its cycle was seen. That is the order that a [`Recorder`] relies on. Only the IO thread
//! wakes the recorder.
//!
//! The trace is written under a name that ends with `.partial` and takes its own when it is whole: a recording that broke
//! off never stands in the place of a good one, and can still be read.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, SyncSender};
use std::sync::{Arc, OnceLock};
use std::thread::{self, JoinHandle};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use crossbeam::queue::SegQueue;
use serde_json::json;

use super::ledger::{Ledger, partial};
use super::summary::CollisionReport;
use super::{Facts, Options, RecordTo, RunError, model};
use crate::adapter::Witness;
use crate::engine::Incident;
use crate::pace::{Journal, NoJournal};
use crate::signal_map::SignalMap;
use crate::time::Instant;
use crate::trace::{Compression, Header, Record, Recorder, Sender, Source, Writer};

/// How long the recorder sleeps until it looks for orders although nobody woke it.
const LOOK: Duration = Duration::from_millis(50);

/// A recording that goes on; nothing where none was asked for.
pub(super) struct Recording(Option<Writing>);

struct Writing {
    /// `None` where traces are begun and ended on demand.
    path: Option<PathBuf>,
    thread: JoinHandle<io::Result<Option<PathBuf>>>,
}

/// Begins and ends traces while a run goes on.
#[derive(Clone)]
pub struct RecordControl {
    orders: Arc<SegQueue<RecordOrder>>,
}

/// How a [`RecordControl`]'s order ended: the file that was begun, or ended.
pub type Recorded = Arc<OnceLock<Result<Option<PathBuf>, String>>>;

enum RecordOrder {
    Begin(PathBuf, Recorded),
    End(Recorded),
}

impl RecordControl {
    /// Begins a trace; one that is being written is ended first. A file that is there already is refused.
    pub fn begin(&self, path: PathBuf) -> Recorded {
        self.give(|recorded| RecordOrder::Begin(path, recorded))
    }

    /// Ends the trace that is being written.
    pub fn end(&self) -> Recorded {
        self.give(RecordOrder::End)
    }

    fn give(&self, order: impl FnOnce(Recorded) -> RecordOrder) -> Recorded {
        let recorded = Recorded::default();
        self.orders.push(order(Arc::clone(&recorded)));
        recorded
    }
}

/// The IO thread's end.
pub(super) struct Tap(Option<Telling>);

struct Telling {
    queue: Arc<SegQueue<Record>>,
    wake: SyncSender<()>,
}

/// The simulation thread's end.
struct Chronicle {
    records: Arc<SegQueue<Record>>,
    signal_map: Arc<SignalMap>,
}

/// Begins the recording that `options` ask for.
pub(super) fn start(options: &Options, facts: &Facts) -> Result<(Recording, Tap, Box<dyn Journal>), RunError> {
    let Some(RecordTo { path, replace }) = options.record.clone() else {
        return Ok((Recording(None), Tap(None), Box::new(NoJournal)));
    };
    if !replace && path.exists() {
        return Err(RunError::RecordingExists(path));
    }
    let fail = |error: io::Error| RunError::Recording { path: path.clone(), reason: error.to_string() };
    let partial = partial(&path);
    let file = BufWriter::with_capacity(1 << 16, File::create(&partial).map_err(fail)?);
    let writer = Writer::new(file, Compression::of(&path.to_string_lossy()), &header(facts)).map_err(fail)?;
    let queue = Arc::new(SegQueue::new());
    let (wake, woken) = mpsc::sync_channel(1);
    let records = Arc::clone(&queue);
    let whole = path.clone();
    let write = move || {
        write(Recorder::new(writer), &records, &woken, || {})?.flush()?;
        rename(&partial, &whole)?;
        Ok(Some(whole))
    };
    let thread = thread::Builder::new().name("recorder".to_owned()).spawn(write).map_err(RunError::Thread)?;
    let tap = Tap(Some(Telling { queue: Arc::clone(&queue), wake }));
    Ok((
        Recording(Some(Writing { path: Some(path), thread })),
        tap,
        Box::new(Chronicle { records: queue, signal_map: Arc::clone(&facts.plant.signal_map) }),
    ))
}

/// Begins to listen, so that traces can be begun and ended while the run goes on; where `options` ask for a recording, it is
/// begun at once.
pub(super) fn listen(
    options: &Options,
    facts: &Facts,
) -> Result<(Recording, Tap, Box<dyn Journal>, RecordControl), RunError> {
    let header = header(facts);
    let queue = Arc::new(SegQueue::new());
    let (wake, woken) = mpsc::sync_channel(1);
    let control = RecordControl { orders: Arc::new(SegQueue::new()) };
    let (records, orders) = (Arc::clone(&queue), Arc::clone(&control.orders));
    let first = options.record.clone();
    if let Some(RecordTo { path, replace: false }) = &first
        && path.exists()
    {
        return Err(RunError::RecordingExists(path.clone()));
    }
    let path = first.as_ref().map(|record| record.path.clone());
    let (begun, is_begun) = mpsc::sync_channel(1);
    let write = move || {
        let ledger = Ledger::new(header.clone());
        let begin = first.map_or(Ok(()), |record| ledger.begin(&record.path));
        let failed = begin.is_err();
        // Who started the run waits for this.
        let _ = begun.send(begin);
        if failed {
            return Ok(None);
        }
        let writer = Writer::new(ledger.clone(), Compression::None, &header)?;
        write(Recorder::new(writer), &records, &woken, || obey(&ledger, &orders))?;
        ledger.end()
    };
    let thread = thread::Builder::new().name("recorder".to_owned()).spawn(write).map_err(RunError::Thread)?;
    if let (Ok(Err(error)), Some(path)) = (is_begun.recv(), &path) {
        return Err(RunError::Recording { path: path.clone(), reason: error.to_string() });
    }
    let tap = Tap(Some(Telling { queue: Arc::clone(&queue), wake }));
    Ok((
        Recording(Some(Writing { path, thread })),
        tap,
        Box::new(Chronicle { records: queue, signal_map: Arc::clone(&facts.plant.signal_map) }),
        control,
    ))
}

/// Begins and ends traces as ordered.
fn obey(ledger: &Ledger, orders: &SegQueue<RecordOrder>) {
    while let Some(order) = orders.pop() {
        let (done, recorded) = match order {
            RecordOrder::Begin(path, recorded) if path.exists() => {
                (Err(io::Error::other(format!("{} is there already; choose another file", path.display()))), recorded)
            }
            RecordOrder::Begin(path, recorded) => {
                (ledger.end().and_then(|_| ledger.begin(&path)).map(|()| Some(path)), recorded)
            }
            RecordOrder::End(recorded) => (ledger.end(), recorded),
        };
        // Nobody else answers this one.
        let _ = recorded.set(done.map_err(|error| error.to_string()));
    }
}

fn header(facts: &Facts) -> Header {
    Header {
        start: SystemTime::now().duration_since(UNIX_EPOCH).ok().map(|since| date_and_time(since.as_secs())),
        source: Source::Simulation,
        model: Some(facts.model.clone()),
        note: None,
        step_ns: u64::try_from(facts.step.as_nanos()).ok(),
        seed: Some(facts.seed),
        model_hash: Some(model::hash(&facts.plant)),
        ..Header::default()
    }
}

/// Writes what comes until nothing more will; does what is left to do after each time.
fn write<W: Write>(
    mut recorder: Recorder<W>,
    records: &SegQueue<Record>,
    woken: &Receiver<()>,
    mut after: impl FnMut(),
) -> io::Result<W> {
    let mut written = Ok(());
    loop {
        // Looked at before the queue is emptied: what the tap put there before it went is taken below. Orders wake nobody.
        let is_over = matches!(woken.recv_timeout(LOOK), Err(RecvTimeoutError::Disconnected));
        while let Some(record) = records.pop() {
            // After a failure the queue must not grow: it is emptied all the same.
            if written.is_ok() {
                written = recorder.record(record);
            }
        }
        after();
        if is_over {
            break;
        }
    }
    written?;
    recorder.finish()
}

impl Recording {
    /// Ends the recording, once its tap and its journal are gone. The file that was written.
    pub fn finish(self) -> Result<Option<String>, RunError> {
        let Some(Writing { path, thread }) = self.0 else { return Ok(None) };
        let written = thread.join().map_err(|_| RunError::Died("recorder's"))?;
        let path = path.unwrap_or_default();
        let written = written.map_err(|error| RunError::Recording { path, reason: error.to_string() })?;
        Ok(written.map(|path| path.to_string_lossy().into_owned()))
    }
}

fn rename(partial: &Path, path: &Path) -> io::Result<()> {
    File::open(partial)?.sync_all()?;
    fs::rename(partial, path)
}

impl Tap {
    fn tell(&self, record: impl FnOnce() -> Record) {
        if let Some(telling) = &self.0 {
            telling.queue.push(record());
        }
    }
}

impl Witness for Tap {
    fn staged(&mut self, number: u64, text: String) {
        self.tell(|| Record::Staged { number, text });
    }

    fn reported(&mut self, at: Instant, text: &str) {
        self.tell(|| Record::Reported { at, text: text.to_owned() });
    }

    fn exchanged(&mut self, from: Sender, text: &str) {
        self.tell(|| Record::Exchanged { from, text: text.to_owned() });
    }

    fn reached(&mut self, at: Instant) {
        self.tell(|| Record::Reached { at });
        if let Some(telling) = &self.0 {
            // Full: it has been woken and has not looked yet. Gone: its end will be told when the run ends.
            let _ = telling.wake.try_send(());
        }
    }
}

impl Journal for Chronicle {
    fn taken(&mut self, number: u64, at: Instant) {
        self.records.push(Record::Taken { at, number });
    }

    fn noted(&mut self, incident: &Incident) {
        if let Some(collision) = CollisionReport::of(incident, &self.signal_map) {
            let event = json!({ "collision": collision }).to_string();
            self.records.push(Record::Event { at: incident.at, from: Sender::Engine, event });
        }
    }

    fn operated(&mut self, at: Instant, deed: String) {
        self.records.push(Record::Event { at, from: Sender::Operator, event: deed });
    }
}

/// Seconds since 1970 as ISO 8601 writes a date and a time of day in UTC.
pub fn date_and_time(seconds: u64) -> String {
    let (days, second) = (seconds / 86_400, seconds % 86_400);
    // Days since 0000-03-01, so that a leap day is the last of its year; in eras of 400 years, which are all alike
    // (Howard Hinnant, "chrono-compatible low-level date algorithms", civil_from_days).
    let days = days + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year_of_era = (day - day / 1_460 + day / 36_524 - day / 146_096) / 365;
    let day_of_year = day - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let shifted_month = (5 * day_of_year + 2) / 153;
    let day_of_month = day_of_year - (153 * shifted_month + 2) / 5 + 1;
    let month = if shifted_month < 10 { shifted_month + 3 } else { shifted_month - 9 };
    let year = era * 400 + year_of_era + u64::from(month <= 2);
    let (hour, minute, second) = (second / 3600, second / 60 % 60, second % 60);
    format!("{year:04}-{month:02}-{day_of_month:02}T{hour:02}:{minute:02}:{second:02}Z")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_as_the_calendar_has_them() {
        let check = |seconds: u64, expect: &str| assert_eq!(date_and_time(seconds), expect);
        check(0, "1970-01-01T00:00:00Z");
        check(951_782_399, "2000-02-28T23:59:59Z");
        check(951_782_400, "2000-02-29T00:00:00Z");
        check(951_868_800, "2000-03-01T00:00:00Z");
        check(1_769_846_400, "2026-01-31T08:00:00Z");
        check(4_107_542_399, "2100-02-28T23:59:59Z");
        check(4_107_542_400, "2100-03-01T00:00:00Z");
    }
}
