//! Where the program's log goes: to standard error, or into the screen while there is one.
//!
//! What is logged is chosen with the environment variable `KINETWIN_LOG` (`KINETWIN_LOG=automation=info`); warnings alone
//! where it is not set.

use std::collections::VecDeque;
use std::io::{self, Write};
use std::sync::{Arc, Mutex, PoisonError};

use tracing_subscriber::EnvFilter;
use tracing_subscriber::fmt::MakeWriter;

use super::words;

/// The variable that chooses what is logged.
const VARIABLE: &str = "KINETWIN_LOG";

/// Libraries that would write whatever passes through them to a log of their finest level, the WebSocket handshake with its
/// token included. They never do, whatever is asked for.
const TELLTALES: &[&str] = &[
    "tungstenite",
    "tungstenite::handshake",
    "tungstenite::handshake::client",
    "tokio_tungstenite",
    "rustls",
    "tokio_rustls",
];

/// Lines that wait to be shown, at most.
const LINES: usize = 64;

/// The log's end on the screen's side.
#[derive(Clone, Default)]
pub struct Log(Arc<Mutex<Place>>);

#[derive(Default)]
enum Place {
    #[default]
    StandardError,
    Screen(VecDeque<String>),
}

impl Log {
    /// Begins to log.
    pub fn begin() -> Log {
        let log = Log::default();
        let filter = EnvFilter::try_from_env(VARIABLE).unwrap_or_else(|_| EnvFilter::new("warn"));
        let filter = TELLTALES.iter().fold(filter, |filter, telltale| {
            filter.add_directive(format!("{telltale}=info").parse().expect("a directive"))
        });
        let format = tracing_subscriber::fmt().with_env_filter(filter).with_ansi(false).without_time();
        // Somebody who embeds this library may have their own: theirs stays.
        let _ = format.with_writer(log.clone()).try_init();
        log
    }

    fn place(&self) -> std::sync::MutexGuard<'_, Place> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// From now on lines wait for the screen.
    pub fn to_screen(&self) {
        *self.place() = Place::Screen(VecDeque::new());
    }

    /// From now on lines go to standard error, those first that still waited for the screen.
    pub fn to_standard_error(&self) {
        let lines = self.take();
        *self.place() = Place::StandardError;
        lines.iter().for_each(words::tell);
    }

    /// The lines that wait for the screen.
    pub fn take(&self) -> Vec<String> {
        match &mut *self.place() {
            Place::StandardError => Vec::new(),
            Place::Screen(lines) => lines.drain(..).collect(),
        }
    }
}

impl<'a> MakeWriter<'a> for Log {
    type Writer = Log;

    fn make_writer(&'a self) -> Log {
        self.clone()
    }
}

impl Write for Log {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut *self.place() {
            Place::StandardError => io::stderr().write_all(bytes)?,
            Place::Screen(lines) => {
                lines.extend(String::from_utf8_lossy(bytes).lines().map(str::to_owned));
                lines.drain(..lines.len().saturating_sub(LINES));
            }
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
