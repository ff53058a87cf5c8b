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
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, SyncSender};
use std::thread::{self, JoinHandle};
use std::time::{SystemTime, UNIX_EPOCH};

use crossbeam::queue::SegQueue;

use super::{Facts, Options, RecordTo, RunError, model};
use crate::adapter::Witness;
use crate::pace::{Journal, NoJournal};
use crate::time::Instant;
use crate::trace::{Compression, Header, Record, Recorder, Sender, Source, Writer};

/// A recording that goes on; nothing where none was asked for.
pub(super) struct Recording(Option<Writing>);

struct Writing {
    path: PathBuf,
    partial: PathBuf,
    thread: JoinHandle<io::Result<()>>,
}

/// The IO thread's end.
pub(super) struct Tap(Option<Telling>);

struct Telling {
    queue: Arc<SegQueue<Record>>,
    wake: SyncSender<()>,
}

/// The simulation thread's end.
struct Chronicle(Arc<SegQueue<Record>>);

/// Begins the recording that `options` ask for.
pub(super) fn start(options: &Options, facts: &Facts) -> Result<(Recording, Tap, Box<dyn Journal>), RunError> {
    let Some(RecordTo { path, replace }) = options.record.clone() else {
        return Ok((Recording(None), Tap(None), Box::new(NoJournal)));
    };
    if !replace && path.exists() {
        return Err(RunError::RecordingExists(path));
    }
    let fail = |error: io::Error| RunError::Recording { path: path.clone(), reason: error.to_string() };
    let mut partial = path.clone().into_os_string();
    partial.push(".partial");
    let partial = PathBuf::from(partial);
    let file = BufWriter::with_capacity(1 << 16, File::create(&partial).map_err(fail)?);
    let writer = Writer::new(file, Compression::of(&path.to_string_lossy()), &header(facts)).map_err(fail)?;
    let queue = Arc::new(SegQueue::new());
    let (wake, woken) = mpsc::sync_channel(1);
    let records = Arc::clone(&queue);
    let write = move || write(Recorder::new(writer), &records, &woken);
    let thread = thread::Builder::new().name("recorder".to_owned()).spawn(write).map_err(RunError::Thread)?;
    let tap = Tap(Some(Telling { queue: Arc::clone(&queue), wake }));
    Ok((Recording(Some(Writing { path, partial, thread })), tap, Box::new(Chronicle(queue))))
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

/// Writes what comes until nothing more will.
fn write(mut recorder: Recorder<BufWriter<File>>, records: &SegQueue<Record>, woken: &Receiver<()>) -> io::Result<()> {
    let mut written = Ok(());
    loop {
        // Looked at before the queue is emptied: what the tap put there before it went is taken below.
        let is_over = woken.recv().is_err();
        while let Some(record) = records.pop() {
            // After a failure the queue must not grow: it is emptied all the same.
            if written.is_ok() {
                written = recorder.record(record);
            }
        }
        if is_over {
            break;
        }
    }
    written?;
    recorder.finish()?.flush()
}

impl Recording {
    /// Ends the recording, once its tap and its journal are gone. The file that was written.
    pub fn finish(self) -> Result<Option<String>, RunError> {
        let Some(Writing { path, partial, thread }) = self.0 else { return Ok(None) };
        let written = thread.join().map_err(|_| RunError::Died("recorder's"))?;
        let named = written.and_then(|()| rename(&partial, &path));
        named.map_err(|error| RunError::Recording { path: path.clone(), reason: error.to_string() })?;
        Ok(Some(path.to_string_lossy().into_owned()))
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
        self.0.push(Record::Taken { at, number });
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
