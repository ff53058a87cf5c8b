//! Asking a server for its interface (`QueryAll`), with no session and no simulation.

use std::future::poll_fn;
use std::io;
use std::pin::pin;
use std::task::{Context, Poll};
use std::time::Duration;

use super::{Options, RunError, wall};
use crate::adapter::{Received, Socket, Transport};
use crate::pace::WallClock;
use crate::plant::Plant;
use crate::session::{Input, Output, Query, QueryEvent};
use crate::time::Instant;
use crate::wire::Interface;

/// What became of the question.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// The address that was asked.
    pub server: String,
    /// The server's interface, or why there is none, for people.
    pub answer: Result<Interface, String>,
    /// Odd things that change nothing.
    pub notices: Vec<String>,
}

/// Asks the automation that `options` name for its interface.
pub fn ask(options: &Options, plant: &Plant) -> Result<Asked, RunError> {
    // The embedded automation lives as long as this.
    let (_server, endpoint, _) = wall::reach(options.automation_of(plant), plant)?;
    let settings = options.settings(plant, endpoint);
    settings.validate()?;
    let mut socket = Socket::default();
    socket.configure(&settings);
    let mut asking = Asking {
        query: Query::new(settings.timeout),
        socket,
        asked: Asked { server: settings.endpoint.to_string(), answer: Err(String::new()), notices: Vec::new() },
        why: None,
        is_answered: false,
    };
    asking.run().map_err(RunError::Thread)?;
    Ok(asking.asked)
}

struct Asking {
    query: Query,
    socket: Socket,
    asked: Asked,
    /// What the transport last said of the connection.
    why: Option<String>,
    is_answered: bool,
}

impl Asking {
    fn run(&mut self) -> io::Result<()> {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
        runtime.block_on(async {
            let clock = WallClock::start();
            let mut alarm = pin!(tokio::time::sleep(Duration::ZERO));
            poll_fn(|cx| {
                loop {
                    self.turn(cx, clock.now());
                    if self.is_answered && self.socket.is_idle() {
                        return Poll::Ready(());
                    }
                    let due = self.query.timeout().unwrap_or(clock.now() + Duration::from_secs(1));
                    alarm.as_mut().reset(clock.to_system(due).into());
                    if alarm.as_mut().poll(cx).is_pending() {
                        return Poll::Pending;
                    }
                }
            })
            .await;
        });
        Ok(())
    }

    fn turn(&mut self, cx: &mut Context<'_>, now: Instant) {
        self.drain(now);
        loop {
            let received = match self.socket.poll_receive(cx, now) {
                Poll::Ready(received) => received,
                Poll::Pending if self.query.timeout().is_some_and(|due| due <= now) => {
                    self.query.handle(now, Input::Timeout);
                    self.drain(now);
                    continue;
                }
                Poll::Pending => break,
            };
            match &received {
                Received::Opened => self.query.handle(now, Input::Opened),
                Received::Text(text) => self.query.handle(now, Input::Text(text)),
                Received::Binary => self.query.handle(now, Input::Binary),
                Received::InvalidUtf8 => self.query.handle(now, Input::InvalidUtf8),
                Received::TooLong { limit } => self.query.handle(now, Input::TooLong { limit: *limit }),
                Received::Closed(why) | Received::Denied(why) => {
                    self.why = Some(why.clone());
                    self.query.handle(now, Input::Closed);
                }
            }
            self.drain(now);
        }
        self.socket.flush(cx);
    }

    fn drain(&mut self, now: Instant) {
        while let Some(output) = self.query.poll() {
            match output {
                Output::Transmit(text) => self.socket.send(now, text),
                Output::Close { code, reason } => self.socket.close(now, code, &reason),
                Output::Event(QueryEvent::Dial) => self.socket.dial(now),
                Output::Event(QueryEvent::Notice(text)) => self.asked.notices.push(text),
                Output::Event(QueryEvent::Answered(interface)) => {
                    self.asked.answer = Ok(interface);
                    self.is_answered = true;
                }
                Output::Event(QueryEvent::Failed { reason }) => {
                    self.asked.answer = Err(self.why.take().unwrap_or(reason));
                    self.is_answered = true;
                }
            }
        }
    }
}
