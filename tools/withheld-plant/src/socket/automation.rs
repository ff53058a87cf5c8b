//! The automation: the server. It says its commands at their instants and records, by its own clock, what it says and hears.

use std::net::TcpListener;

use kinetwin::trace::Sender;
use kinetwin::wire::{Connect, ConnectReply, Message, ResultCode, to_base64};

use super::clock::Lateness;
use super::end::{End, PATIENCE};
use super::error::SocketError;
use crate::plant::Command;
use crate::record::{self, Said};
use crate::rig;

const PLANT: &str = "plant";

/// Waits at `listener` for the plant, says `script` to it and hears it for `seconds` and until it leaves. Gives both sides'
/// messages in the order of its clock, which starts with its first one.
pub fn run(listener: &TcpListener, script: &[Command], seconds: f64) -> Result<(Vec<Said>, Lateness), SocketError> {
    let mut end = End::accept(listener, PLANT)?;
    welcome(&mut end)?;
    let mut lateness = Lateness::default();
    let mut heard: Vec<Said> = Vec::new();
    let mut script = record::commands(script, &rig::commands()).into_iter().peekable();
    end.start();
    loop {
        let until = script.peek().map_or(seconds + PATIENCE, |next| next.at);
        match end.next(until)? {
            Some((at, text)) => match Message::decode(&text) {
                Ok(Message::SendValue(_)) => heard.push(Said { at, from: Sender::Plant, text }),
                Ok(Message::Connect(connect)) if !connect.enable && script.peek().is_none() && at >= seconds => {
                    end.send(reply(&connect))?;
                    // What arrived while it spoke is read later.
                    heard.sort_by(|one, next| one.at.total_cmp(&next.at));
                    return Ok((heard, lateness));
                }
                Ok(other) => return Err(end.bad(&text, &format!("a {} now", other.name()))),
                Err(error) => return Err(end.bad(&text, &error.to_string())),
            },
            None => {
                let Some(Said { at: due, from, text }) = script.next() else {
                    return Err(SocketError::Silent { peer: PLANT, seconds: PATIENCE });
                };
                // It is stamped as it leaves, as whoever says it would.
                let at = end.send(text.clone())?;
                lateness.note(at - due);
                heard.push(Said { at, from, text });
            }
        }
    }
}

/// Takes the plant's `Connect` and accepts it.
fn welcome(end: &mut End) -> Result<(), SocketError> {
    let (_, text) = end.expect()?;
    match Message::decode(&text) {
        Ok(Message::Connect(connect)) if connect.enable => end.send(reply(&connect)).map(|_| ()),
        Ok(other) => Err(end.bad(&text, &format!("a {} before a Connect", other.name()))),
        Err(error) => Err(end.bad(&text, &error.to_string())),
    }
}

fn reply(connect: &Connect<'_>) -> String {
    let reply = ConnectReply {
        id: connect.id.clone(),
        enable: connect.enable,
        server_name: to_base64("automation").into(),
        result: ResultCode::OK,
        message: None,
    };
    Message::ConnectReply(reply).encode()
}
