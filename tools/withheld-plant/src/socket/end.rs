//! One end of a connection: messages over a WebSocket on a TCP socket of this machine, and a clock.

use std::io;
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::time::{Duration, Instant};

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use tungstenite::handshake::HandshakeError;
use tungstenite::{Error, Message, WebSocket};

use super::clock::Clock;
use super::error::SocketError;
use super::stamped::Stamped;

/// How long the other end may take to answer, s.
pub const PATIENCE: f64 = 5.0;

/// One end.
pub struct End {
    socket: WebSocket<Stamped>,
    /// A message that was read before its instant came.
    early: Option<(Instant, String)>,
    /// Whom it talks to: `plant`
    peer: &'static str,
    clock: Clock,
}

impl End {
    /// Waits for `peer` to connect.
    pub fn accept(listener: &TcpListener, peer: &'static str) -> Result<End, SocketError> {
        let open = |source| SocketError::Open { peer, source };
        listener.set_nonblocking(true).map_err(open)?;
        let clock = Clock::start();
        let stream = loop {
            match listener.accept() {
                Ok((stream, _)) => break stream,
                Err(error) if error.kind() == io::ErrorKind::WouldBlock => {}
                Err(error) => return Err(open(error)),
            }
            let left = clock.until(PATIENCE).ok_or(SocketError::Silent { peer, seconds: PATIENCE })?;
            ready(&mut [PollFd::new(listener, PollFlags::IN)], left).map_err(open)?;
        };
        stream.set_nonblocking(false).and_then(|()| prepare(&stream)).map_err(open)?;
        let socket = tungstenite::accept(Stamped::new(stream).map_err(open)?).map_err(|error| refused(peer, error))?;
        End::new(socket, peer)
    }

    /// Connects to `peer`, which listens at `address`.
    pub fn connect(address: SocketAddr, peer: &'static str) -> Result<End, SocketError> {
        let open = |source| SocketError::Open { peer, source };
        let patience = Duration::from_secs_f64(PATIENCE);
        let stream = TcpStream::connect_timeout(&address, patience).map_err(open)?;
        prepare(&stream).map_err(open)?;
        let (socket, _) = tungstenite::client(format!("ws://{address}/"), Stamped::new(stream).map_err(open)?)
            .map_err(|error| refused(peer, error))?;
        End::new(socket, peer)
    }

    fn new(socket: WebSocket<Stamped>, peer: &'static str) -> Result<End, SocketError> {
        socket.get_ref().stream().set_nonblocking(true).map_err(|source| SocketError::Open { peer, source })?;
        Ok(End { socket, early: None, peer, clock: Clock::start() })
    }

    /// Lets its clock begin again, now.
    pub fn start(&mut self) {
        self.clock = Clock::start();
    }

    /// Lets its clock begin when the last message was there.
    pub fn start_with_last(&mut self) {
        self.clock = Clock::started(self.socket.get_ref().arrived());
    }

    /// What its clock says, s.
    pub fn now(&self) -> f64 {
        self.clock.now()
    }

    /// The next message and the instant at which it was there; `None` when `until` has come and nothing was there before it.
    pub fn next(&mut self, until: f64) -> Result<Option<(f64, String)>, SocketError> {
        loop {
            if let Some((arrived, text)) = self.early.take() {
                let at = self.clock.at(arrived);
                if at <= until {
                    return Ok(Some((at, text)));
                }
                self.early = Some((arrived, text));
                return Ok(None);
            }
            let left = self.clock.until(until);
            match self.socket.read() {
                Ok(Message::Text(text)) => {
                    self.early = Some((self.socket.get_ref().arrived(), text.as_str().to_owned()));
                }
                Ok(Message::Ping(_) | Message::Pong(_) | Message::Frame(_)) => {}
                Ok(Message::Binary(bytes)) => {
                    let what = format!("a binary message of {} bytes", bytes.len());
                    return Err(self.bad(&what, "the protocol speaks JSON text"));
                }
                Ok(Message::Close(_)) => return Err(self.lost(Error::ConnectionClosed)),
                Err(Error::Io(error)) if error.kind() == io::ErrorKind::WouldBlock => {
                    let Some(left) = left else { return Ok(None) };
                    let fd = PollFd::new(self.socket.get_ref().stream(), PollFlags::IN);
                    ready(&mut [fd], left).map_err(|error| self.lost(Error::Io(error)))?;
                }
                Err(error) => return Err(self.lost(error)),
            }
        }
    }

    /// The next message, which has to come.
    pub fn expect(&mut self) -> Result<(f64, String), SocketError> {
        let until = self.now() + PATIENCE;
        self.next(until)?.ok_or(SocketError::Silent { peer: self.peer, seconds: PATIENCE })
    }

    /// Sends a message. Gives the instant just before the system had it.
    pub fn send(&mut self, text: String) -> Result<f64, SocketError> {
        // The frame is made first: what is between an instant and the message it is told of must be short.
        self.socket.write(Message::text(text)).map_err(|error| self.lost(error))?;
        let before = self.now();
        let mut sent = self.socket.flush();
        let until = self.now() + PATIENCE;
        // What the socket does not take at once waits within the WebSocket.
        while matches!(&sent, Err(Error::Io(error)) if error.kind() == io::ErrorKind::WouldBlock) {
            let left = self.clock.until(until).ok_or(SocketError::Silent { peer: self.peer, seconds: PATIENCE })?;
            let fd = PollFd::new(self.socket.get_ref().stream(), PollFlags::OUT);
            ready(&mut [fd], left).map_err(|error| self.lost(Error::Io(error)))?;
            sent = self.socket.flush();
        }
        sent.map_err(|error| self.lost(error))?;
        Ok(before)
    }

    /// The error of a message that no recording can hold.
    pub fn bad(&self, text: &str, reason: &str) -> SocketError {
        const SHOWN: usize = 120;
        let shown: String = text.chars().take(SHOWN).collect();
        let text = if shown.len() < text.len() { format!("{shown}…") } else { shown };
        SocketError::Bad { peer: self.peer, at: self.now(), reason: reason.to_owned(), text }
    }

    fn lost(&self, source: Error) -> SocketError {
        SocketError::Lost { peer: self.peer, at: self.now(), source }
    }
}

/// Small messages must not wait for one another, and nobody waits for ever.
fn prepare(stream: &TcpStream) -> io::Result<()> {
    let patience = Some(Duration::from_secs_f64(PATIENCE));
    stream.set_nodelay(true)?;
    stream.set_read_timeout(patience)?;
    stream.set_write_timeout(patience)
}

/// Waits until one of these is ready, or so long. Its clock is finer than that of a socket's own timeouts.
fn ready(fds: &mut [PollFd<'_>], left: Duration) -> io::Result<()> {
    let timeout = Timespec { tv_sec: left.as_secs().min(3600) as _, tv_nsec: left.subsec_nanos() as _ };
    match poll(fds, Some(&timeout)) {
        Ok(_) | Err(rustix::io::Errno::INTR) => Ok(()),
        Err(error) => Err(error.into()),
    }
}

fn refused<R: tungstenite::handshake::HandshakeRole>(peer: &'static str, error: HandshakeError<R>) -> SocketError {
    match error {
        HandshakeError::Interrupted(_) => SocketError::Silent { peer, seconds: PATIENCE },
        HandshakeError::Failure(source) => SocketError::Lost { peer, at: 0.0, source },
    }
}
