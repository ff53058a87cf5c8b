//! Ctrl-C and SIGTERM: the first ends the run in good order, the second at once.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

use super::terminal;
use crate::run::Stop;

/// The exit code of a program that was ended by Ctrl-C (128 and the number of SIGINT), as shells have it.
const INTERRUPTED: i32 = 130;

/// What ends a run from outside.
#[derive(Clone)]
pub struct Interruption {
    stop: Stop,
    /// Whether the terminal is ours and must be given back before the program ends at once.
    has_screen: Arc<AtomicBool>,
}

impl Interruption {
    /// Listens for signals, on a thread of its own, for as long as the program lasts.
    pub fn watch(stop: Stop) -> io::Result<Interruption> {
        let interruption = Interruption { stop, has_screen: Arc::default() };
        let runtime = tokio::runtime::Builder::new_current_thread().enable_io().build()?;
        let mut requests = {
            let _inside = runtime.enter();
            Requests::watch()?
        };
        let told = interruption.clone();
        thread::Builder::new().name("signals".to_owned()).spawn(move || {
            runtime.block_on(async {
                loop {
                    requests.next().await;
                    told.interrupt();
                }
            })
        })?;
        Ok(interruption)
    }

    /// Says that the terminal is ours, or no more.
    pub fn set_screen(&self, has_screen: bool) {
        // A flag that stands alone: nothing else is published by it.
        self.has_screen.store(has_screen, Ordering::Relaxed);
    }

    /// Whether the run was asked to end.
    pub fn is_asked(&self) -> bool {
        self.stop.is_asked()
    }

    /// Asks the run to end; where it was asked already, ends the program.
    pub fn interrupt(&self) {
        if !self.stop.is_asked() {
            return self.stop.stop();
        }
        if self.has_screen.load(Ordering::Relaxed) {
            terminal::give_back();
        }
        std::process::exit(INTERRUPTED);
    }
}

/// Requests to end, from outside.
#[cfg(unix)]
struct Requests {
    interrupts: tokio::signal::unix::Signal,
    terminations: tokio::signal::unix::Signal,
}

#[cfg(unix)]
impl Requests {
    fn watch() -> io::Result<Requests> {
        use tokio::signal::unix::{SignalKind, signal};
        Ok(Requests { interrupts: signal(SignalKind::interrupt())?, terminations: signal(SignalKind::terminate())? })
    }

    async fn next(&mut self) {
        tokio::select! {
            _ = self.interrupts.recv() => {}
            _ = self.terminations.recv() => {}
        }
    }
}

/// Requests to end, from outside: Ctrl-C, where there are no signals.
#[cfg(not(unix))]
struct Requests(tokio::signal::windows::CtrlC);

#[cfg(not(unix))]
impl Requests {
    fn watch() -> io::Result<Requests> {
        tokio::signal::windows::ctrl_c().map(Requests)
    }

    async fn next(&mut self) {
        self.0.recv().await;
    }
}
