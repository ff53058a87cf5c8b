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
    names: Vec<String>,
    reports: HashMap<String, bool>,
    value: bool,
}

impl SerdeLoop {
    pub fn new(blocks: usize) -> io::Result<SerdeLoop> {
        let listener = listen()?;
        let address = listener.local_addr()?;
        let responder = runtime()?;
        std::thread::spawn(move || {
            responder.block_on(async {
                let stream = tokio::net::TcpStream::connect(address).await.ok()?;
                stream.set_nodelay(true).ok()?;
                let (mut web, _) = client_async(format!("ws://{address}"), stream).await.ok()?;
                let mut plant = Plant::new(blocks);
                while let Some(Ok(Message::Text(text))) = web.next().await {
                    let answer = plant.answer(&text).ok()?;
                    web.send(Message::text(answer)).await.ok()?;
                }
                Some(())
            })
        });
        let names = (0..blocks).map(|block| format!("Block{:03}.enable", block + 1)).collect();
        let reports = (0..blocks).map(|block| (format!("Block{:03}.ready", block + 1), false)).collect();
        Ok(SerdeLoop { web: Web::accept(listener)?, names, reports, value: false })
    }
}

impl Peer for SerdeLoop {
    fn call(&mut self) -> io::Result<()> {
        self.value = !self.value;
        let values = self.names.iter().map(|name| Entry { name, value: self.value }).collect();
        let text = serde_json::to_string(&Body { values })?;
        let answer = self.web.ask(text.into())?;
        let answer: Body<'_> = serde_json::from_str(&answer)?;
        for entry in answer.values {
            *self.reports.get_mut(entry.name).ok_or(io::ErrorKind::InvalidData)? = entry.value;
        }
        Ok(())
    }
}

/// Blocks whose `ready` is their `enable`.
struct Plant {
    commands: HashMap<String, usize>,
    reports: Vec<String>,
    state: Vec<bool>,
}

impl Plant {
    fn new(blocks: usize) -> Plant {
        let commands = (0..blocks).map(|block| (format!("Block{:03}.enable", block + 1), block)).collect();
        let reports = (0..blocks).map(|block| format!("Block{:03}.ready", block + 1)).collect();
        Plant { commands, reports, state: vec![false; blocks] }
    }

    fn answer(&mut self, text: &str) -> serde_json::Result<String> {
        for entry in serde_json::from_str::<Body<'_>>(text)?.values {
            if let Some(&block) = self.commands.get(entry.name) {
                self.state[block] = entry.value;
            }
        }
        let states = self.reports.iter().zip(&self.state);
        serde_json::to_string(&Body { values: states.map(|(name, &value)| Entry { name, value }).collect() })
    }
}
