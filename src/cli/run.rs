//! `kinetwin run`.

use super::arguments::{ConnectionArguments, RunArguments};
use super::{Answer, Failure};
use crate::run::{self, Options, RecordTo};

pub fn run(arguments: &RunArguments) -> Result<Answer, Failure> {
    let handle = run::start(&options(arguments)?)?;
    while let Ok(notice) = handle.notices().recv() {
        eprintln!("{:>10} {}", notice.at, notice.text);
    }
    let summary = handle.finish()?;
    println!("{}", serde_json::to_string(&summary)?);
    Ok(if summary.sessions == 0 || summary.refused.is_some() { Answer::No } else { Answer::Yes })
}

fn options(arguments: &RunArguments) -> Result<Options, Failure> {
    let RunArguments { connection, record, force, .. } = arguments;
    Ok(Options {
        connect: connection.connect.clone(),
        timeout: connection.timeout,
        max_message: connection.max_message,
        token: token(connection)?,
        duration: arguments.duration,
        step: arguments.step,
        high: arguments.hf,
        low: arguments.lf,
        speed: arguments.speed,
        seed: arguments.seed,
        record: record.clone().map(|path| RecordTo { path, replace: *force }),
        ..Options::new(arguments.model.clone())
    })
}

/// The bearer token: from the file that is named, else from the environment.
pub fn token(connection: &ConnectionArguments) -> Result<Option<String>, Failure> {
    let text = match &connection.token_file {
        Some(path) => std::fs::read_to_string(path)
            .map_err(|error| Failure(format!("error: failed to read the token from {}: {error}", path.display())))?,
        None => match std::env::var("KINETWIN_TOKEN") {
            Ok(text) => text,
            Err(_) => return Ok(None),
        },
    };
    Ok(Some(text.trim().to_owned()))
}
