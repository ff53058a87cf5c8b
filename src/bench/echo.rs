//! The floor: peers that give back the bytes they get.

use std::io::{self, Read as _, Write as _};
use std::net::{TcpListener, TcpStream};

use futures_util::{SinkExt as _, StreamExt as _};
use tokio_tungstenite::client_async;
use tokio_tungstenite::tungstenite::Utf8Bytes;

use super::row::Peer;
use super::web::{Texts, Web, listen, runtime};

/// So many bytes over TCP, and back.
pub struct Raw {
    stream: TcpStream,
    bytes: Vec<u8>,
}

impl Raw {
    pub fn new(bytes: usize) -> io::Result<Raw> {
        let listener = TcpListener::bind("127.0.0.1:0")?;
        let stream = TcpStream::connect(listener.local_addr()?)?;
        stream.set_nodelay(true)?;
        let (mut other, _) = listener.accept()?;
        other.set_nodelay(true)?;
        std::thread::spawn(move || {
            let mut bytes = vec![0; bytes];
            // Ends with the connection.
            while other.read_exact(&mut bytes).and_then(|()| other.write_all(&bytes)).is_ok() {}
        });
        Ok(Raw { stream, bytes: vec![b'x'; bytes] })
    }
}

impl Peer for Raw {
    fn call(&mut self) -> io::Result<()> {
        self.stream.write_all(&self.bytes)?;
        self.stream.read_exact(&mut self.bytes)
    }
}

/// `text` through a bare tokio-tungstenite client, and back.
pub fn web(text: &str) -> io::Result<Texts> {
    let listener = listen()?;
    let address = listener.local_addr()?;
    let responder = runtime()?;
    std::thread::Builder::new().name("echo".to_owned()).spawn(move || {
        responder.block_on(async {
            let stream = tokio::net::TcpStream::connect(address).await.ok()?;
            stream.set_nodelay(true).ok()?;
            let (mut web, _) = client_async(format!("ws://{address}"), stream).await.ok()?;
            while let Some(Ok(message)) = web.next().await {
                web.send(message).await.ok()?;
            }
            Some(())
        })
    })?;
    Ok(Texts::new(Web::accept(listener)?, vec![Utf8Bytes::from(text)]))
}
