//! The automation's end of a WebSocket, as bare as it can be: tokio-tungstenite on a runtime of one thread.

use std::io;
use std::net::TcpListener;
use std::sync::Arc;

use futures_util::{SinkExt as _, StreamExt as _};
use tokio::net::TcpStream;
use tokio::runtime::Runtime;
use tokio_tungstenite::tungstenite::{Message, Utf8Bytes};
use tokio_tungstenite::{WebSocketStream, accept_async};

use super::row::Peer;
use crate::session::{Input, Limits, Output, Server, ServerEvent, ServerSettings};
use crate::signal_map::SignalMap;
use crate::time::Instant;

/// A runtime of one thread.
pub fn runtime() -> io::Result<Runtime> {
    tokio::runtime::Builder::new_current_thread().enable_all().build()
}

/// A free port of this machine.
pub fn listen() -> io::Result<TcpListener> {
    let listener = TcpListener::bind("127.0.0.1:0")?;
    listener.set_nonblocking(true)?;
    Ok(listener)
}

/// Frames that are sent and answered.
pub struct Web {
    pub runtime: Runtime,
    pub socket: WebSocketStream<TcpStream>,
}

impl Web {
    /// Waits for a client at `listener`.
    pub fn accept(listener: TcpListener) -> io::Result<Web> {
        let runtime = runtime()?;
        let socket = runtime.block_on(async {
            let (stream, _) = tokio::net::TcpListener::from_std(listener)?.accept().await?;
            stream.set_nodelay(true)?;
            accept_async(stream).await.map_err(io::Error::other)
        })?;
        Ok(Web { runtime, socket })
    }

    /// Sends a text and waits for the next.
    pub fn ask(&mut self, text: Utf8Bytes) -> io::Result<Utf8Bytes> {
        let Web { runtime, socket } = self;
        runtime.block_on(async {
            socket.send(Message::Text(text)).await.map_err(io::Error::other)?;
            receive(socket).await
        })
    }
}

/// The next text.
pub async fn receive(socket: &mut WebSocketStream<TcpStream>) -> io::Result<Utf8Bytes> {
    loop {
        match socket.next().await {
            Some(Ok(Message::Text(text))) => return Ok(text),
            Some(Ok(_)) => {}
            Some(Err(error)) => return Err(io::Error::other(error)),
            None => return Err(io::ErrorKind::ConnectionAborted.into()),
        }
    }
}

/// Sends texts in turn that never change, and waits for an answer to each.
pub struct Texts {
    web: Web,
    texts: Vec<Utf8Bytes>,
    next: usize,
}

impl Texts {
    /// Over `web`.
    pub fn new(web: Web, texts: Vec<Utf8Bytes>) -> Texts {
        Texts { web, texts, next: 0 }
    }
}

impl Peer for Texts {
    fn call(&mut self) -> io::Result<()> {
        let text = self.texts[self.next].clone();
        self.next = (self.next + 1) % self.texts.len();
        self.web.ask(text).map(drop)
    }
}

/// The server's session with a simulation, over `web`, from its `Connect` to its first reports.
pub fn establish(web: &mut Web, map: &Arc<SignalMap>) -> io::Result<Server> {
    // The clock stands still for it, so that a limit on messages a second would count them all.
    let limits = Limits { messages_a_second: u32::MAX, ..Limits::default() };
    let mut server = Server::new(ServerSettings { limits, ..ServerSettings::new("bench") }, Arc::clone(map));
    let Web { runtime, socket } = web;
    runtime.block_on(async {
        loop {
            let text = receive(socket).await?;
            server.handle(Instant::ZERO, Input::Text(&text));
            let mut reported = false;
            while let Some(output) = server.poll() {
                match output {
                    Output::Transmit(text) => socket.send(Message::text(text)).await.map_err(io::Error::other)?,
                    Output::Event(ServerEvent::Values(_)) => reported = true,
                    Output::Event(_) => {}
                    Output::Close { reason, .. } => return Err(io::Error::other(reason)),
                }
            }
            if reported {
                return Ok(());
            }
        }
    })?;
    Ok(server)
}
