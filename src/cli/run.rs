//! `kinetwin run`.

#[cfg(feature = "view")]
use std::net::SocketAddr;
use std::time::Duration;

use crossbeam::channel::{RecvTimeoutError, TryRecvError};

use super::arguments::{ConnectionArguments, RunArguments};
use super::credentials;
use super::log::Log;
use super::report;
use super::signals::Interruption;
use super::status::Status;
use super::terminal::{Key, Terminal};
use super::words;
use super::{Answer, Failure};
use crate::pace::WallClock;
use crate::run::{self, Gravity, Handle, Notice, Options, RecordTo, Stop, Summary};
use crate::session::Limits;

/// Runs a model to its end.
pub fn run(arguments: &RunArguments) -> Result<Answer, Failure> {
    let options = options(arguments)?;
    let log = Log::begin();
    #[cfg(feature = "view")]
    if let Some(address) = &arguments.view {
        let address = address.unwrap_or(SocketAddr::from(([127, 0, 0, 1], 0)));
        return end(arguments, &super::view::run_viewed(&options, address, arguments.json)?);
    }
    // Before anything of it is to be seen: whoever sees it may ask it to end.
    let stop = Stop::default();
    let interruption = Interruption::watch(stop.clone())?;
    let handle = run::start_until(&options, stop)?;
    let screen = if arguments.json { None } else { Terminal::take()? };
    match screen {
        Some(screen) => show(&handle, screen, &interruption, &log)?,
        None => tell(&handle),
    }
    end(arguments, &handle.finish()?)
}

fn end(arguments: &RunArguments, summary: &Summary) -> Result<Answer, Failure> {
    if arguments.json {
        words::answer_line(serde_json::to_string(summary)?)?;
    } else {
        words::answer(report::text(summary))?;
    }
    match &summary.denied {
        Some(why) => Err(Failure(format!("error: {why}"))),
        None if arguments.stop_on_collision && summary.collisions > 0 => Ok(Answer::No),
        None => Ok(answer(summary)),
    }
}

fn answer(summary: &Summary) -> Answer {
    match (&summary.refused, summary.sessions) {
        (Some(refusal), _) => {
            words::tell(format_args!("error: the server refused the session for good: {refusal}"));
            Answer::No
        }
        (None, 0) => {
            words::tell("error: the server never accepted a session; the model ran without its automation");
            Answer::No
        }
        (None, _) => Answer::Yes,
    }
}

/// How often the screen is drawn.
const REDRAW: Duration = Duration::from_millis(100);
/// How often the embedded automation is asked for its measurement.
const ASK: Duration = Duration::from_secs(1);
/// How many warnings are told again when the screen is gone.
const TOLD_AGAIN: usize = 20;

/// Shows the run on the terminal until it ends.
fn show(handle: &Handle, mut screen: Terminal, interruption: &Interruption, log: &Log) -> Result<(), Failure> {
    interruption.set_screen(true);
    log.to_screen();
    let clock = WallClock::start();
    let mut status = Status::new(handle.facts());
    let mut warnings = Vec::new();
    let mut asked = clock.now();
    loop {
        let now = clock.now();
        for line in log.take() {
            status.note(Notice { at: now, gravity: Gravity::Warning, text: line, place: None });
        }
        let ended = loop {
            match handle.notices().try_recv() {
                Ok(notice) => {
                    if notice.gravity > Gravity::Information {
                        warnings.push(notice.clone());
                    }
                    status.note(notice);
                }
                Err(TryRecvError::Empty) => break false,
                Err(TryRecvError::Disconnected) => break true,
            }
        };
        if ended {
            break;
        }
        status.simulation = handle.simulation().unwrap_or(status.simulation);
        status.exchange = handle.exchange().unwrap_or(status.exchange);
        if now.since(asked) >= ASK {
            asked = now;
            status.round_trip = handle.round_trip();
        }
        status.ending = interruption.is_asked();
        status.sample(now);
        let (columns, rows) = screen.size();
        screen.show(&status.draw(columns, rows))?;
        if let Some(Key::End) = screen.key(REDRAW)? {
            interruption.interrupt();
        }
    }
    drop(screen);
    interruption.set_screen(false);
    log.to_standard_error();
    let skipped = warnings.len().saturating_sub(TOLD_AGAIN);
    if skipped > 0 {
        words::tell(format_args!("({skipped} earlier warnings are left out)"));
    }
    warnings.iter().skip(skipped).for_each(say);
    Ok(())
}

/// How often a run that has no screen says how far it is.
const PROGRESS: Duration = Duration::from_secs(10);
/// How many notices are told within a second; a server that sends nothing but garbage must not flood a log.
const TOLD_A_SECOND: u32 = 20;

/// Tells what happens on standard error until the run ends.
fn tell(handle: &Handle) {
    let clock = WallClock::start();
    let (mut second, mut told, mut silenced) = (clock.now(), 0, 0);
    let mut progress = clock.now() + PROGRESS;
    let mut frame = None;
    loop {
        let now = clock.now();
        if now.since(second) >= Duration::from_secs(1) {
            if silenced > 0 {
                words::tell(format_args!("{:>11}  ({silenced} more)", ""));
            }
            (second, told, silenced) = (now, 0, 0);
        }
        match handle.notices().recv_timeout(Duration::from_millis(500)) {
            Ok(notice) if told < TOLD_A_SECOND => {
                told += 1;
                say(&notice);
            }
            Ok(_) => silenced += 1,
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => break,
        }
        frame = handle.simulation().or(frame);
        if let Some(frame) = frame.as_ref().filter(|_| now >= progress) {
            progress += PROGRESS;
            let (counts, timing) = (&frame.counts, (frame.overruns, frame.late_steps));
            words::tell(format_args!(
                "{:>11}  {} simulated; boxes {} in, {} out; {} overruns, {} late",
                now.to_string(),
                frame.now,
                counts.boxes_in,
                counts.boxes_out,
                timing.0,
                timing.1
            ));
        }
    }
}

pub fn say(notice: &Notice) {
    let gravity = match notice.gravity {
        Gravity::Information => "",
        Gravity::Warning => "warning: ",
        Gravity::Error => "error: ",
    };
    words::tell(format_args!("{:>11}  {gravity}{}", notice.at.to_string(), notice.text));
}

fn options(arguments: &RunArguments) -> Result<Options, Failure> {
    let RunArguments { connection, record, force, .. } = arguments;
    Ok(Options {
        duration: arguments.duration,
        step: arguments.step,
        high: arguments.hf,
        low: arguments.lf,
        speed: arguments.speed,
        realtime: arguments.realtime,
        seed: arguments.seed,
        signals: (!arguments.select.is_empty()).then(|| arguments.select.clone()),
        stop_on_collision: arguments.stop_on_collision,
        record: record.clone().map(|path| RecordTo { path, replace: *force }),
        ..connecting(&arguments.model, connection)?
    })
}

/// The options of a run of `model` that is reached as `connection` says.
pub fn connecting(model: &str, connection: &ConnectionArguments) -> Result<Options, Failure> {
    Ok(Options {
        connect: connection.connect.clone(),
        timeout: connection.timeout,
        max_message: connection.max_message,
        limits: Limits { values: connection.max_values as usize, messages_a_second: connection.max_rate },
        token: credentials::token(connection)?,
        tls: credentials::tls(connection)?,
        ..Options::new(model)
    })
}
