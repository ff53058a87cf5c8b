//! What a user would write instead: tokio-tungstenite and serde_json, a map from names to values, and a message each way.

use std::collections::HashMap;
use std::io;

use futures_util::{SinkExt as _, StreamExt as _};
use serde::{Deserialize, Serialize};
use tokio_tungstenite::client_async;
use tokio_tungstenite::tungstenite::Message;

use super::row::Peer;
use super::web::{Web, listen, runtime};

#[derive(Serialize, Deserialize)]
struct Body<'a> {
    #[serde(rename = "SendValue", borrow)]
    values: Vec<Entry<'a>>,
}

#[derive(Serialize, Deserialize)]
struct Entry<'a> {
    name: &'a str,
    value: bool,
}

/// `blocks` values out, as many back, serde_json at both ends.
pub struct SerdeLoop {
    web: Web,
    caller: Caller,
}

impl SerdeLoop {
    pub fn new(blocks: usize) -> io::Result<SerdeLoop> {
        let listener = listen()?;
        let address = listener.local_addr()?;
        let responder = runtime()?;
        std::thread::Builder::new().name("serde".to_owned()).spawn(move || {
            responder.block_on(async {
                let stream = tokio::net::TcpStream::connect(address).await.ok()?;
                stream.set_nodelay(true).ok()?;
                let (mut web, _) = client_async(format!("ws://{address}"), stream).await.ok()?;
                let mut plant = Blocks::new(blocks);
                while let Some(Ok(Message::Text(text))) = web.next().await {
                    let answer = plant.answer(&text).ok()?;
                    web.send(Message::text(answer)).await.ok()?;
                }
                Some(())
            })
        })?;
        Ok(SerdeLoop { web: Web::accept(listener)?, caller: Caller::new(blocks) })
    }
}

impl Peer for SerdeLoop {
    fn call(&mut self) -> io::Result<()> {
        let text = self.caller.ask()?;
        let answer = self.web.ask(text.into())?;
        self.caller.hear(&answer)
    }
}

/// The automation's end: switches all blocks, and keeps what they report.
pub struct Caller {
    names: Vec<String>,
    reports: HashMap<String, bool>,
    value: bool,
}

impl Caller {
    pub fn new(blocks: usize) -> Caller {
        let names = (0..blocks).map(|block| format!("Block{:03}.enable", block + 1)).collect();
        let reports = (0..blocks).map(|block| (format!("Block{:03}.ready", block + 1), false)).collect();
        Caller { names, reports, value: false }
    }

    pub fn ask(&mut self) -> io::Result<String> {
        self.value = !self.value;
        let values = self.names.iter().map(|name| Entry { name, value: self.value }).collect();
        Ok(serde_json::to_string(&Body { values })?)
    }

    pub fn hear(&mut self, text: &str) -> io::Result<()> {
        let answer: Body<'_> = serde_json::from_str(text)?;
        for entry in answer.values {
            *self.reports.get_mut(entry.name).ok_or(io::ErrorKind::InvalidData)? = entry.value;
        }
        Ok(())
    }
}

/// Blocks whose `ready` is their `enable`.
pub struct Blocks {
    commands: HashMap<String, usize>,
    reports: Vec<String>,
    state: Vec<bool>,
}

impl Blocks {
    pub fn new(blocks: usize) -> Blocks {
        let commands = (0..blocks).map(|block| (format!("Block{:03}.enable", block + 1), block)).collect();
        let reports = (0..blocks).map(|block| format!("Block{:03}.ready", block + 1)).collect();
        Blocks { commands, reports, state: vec![false; blocks] }
    }

    pub fn answer(&mut self, text: &str) -> serde_json::Result<String> {
        for entry in serde_json::from_str::<Body<'_>>(text)?.values {
            if let Some(&block) = self.commands.get(entry.name) {
                self.state[block] = entry.value;
            }
        }
        let states = self.reports.iter().zip(&self.state);
        serde_json::to_string(&Body { values: states.map(|(name, &value)| Entry { name, value }).collect() })
    }
}
