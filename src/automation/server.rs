//! The transport: a WebSocket server (RFC 6455) on a thread of its own, around a [`Faulty`] automation.
//!
//! One task owns the automation, and one task each connection; they meet in channels. `TCP_NODELAY` is set, because a
//! small message must not wait for the next. A simulation that does not read is cut off before what waits for it fills
//! the memory.

use std::collections::BTreeMap;
use std::io;
use std::net::SocketAddr;
use std::thread::JoinHandle;
use std::time::Duration;

use tokio::net::{TcpListener, TcpStream};
use tokio::sync::mpsc;

use super::fault::{Delivery, Faulty};
use super::{ConnectionId, Statistics};
use crate::security::{ServerTls, Token};
use crate::session::Input;
use crate::time::Instant;

mod connection;
#[cfg(test)]
mod tests;

use connection::{Arrival, Event, Order};

/// How a server listens.
#[derive(Clone, Debug)]
pub struct ListenSettings {
    /// Where; port 0 takes a free one.
    pub address: SocketAddr,
    /// The longest message that is read, bytes. A longer one closes its connection with 1009.
    pub max_message: usize,
    /// Speaks TLS, as this says.
    pub tls: Option<ServerTls>,
    /// Whoever connects must show this bearer token with the WebSocket handshake.
    pub token: Option<Token>,
}

impl ListenSettings {
    /// Listens at `address`, unencrypted and for everyone, and reads messages up to 1 MiB.
    pub fn new(address: SocketAddr) -> ListenSettings {
        ListenSettings { address, max_message: 1 << 20, tls: None, token: None }
    }

    /// Listens on a free port of the loopback interface.
    pub fn loopback() -> ListenSettings {
        ListenSettings::new(SocketAddr::from(([127, 0, 0, 1], 0)))
    }
}

/// A server that cannot start.
#[derive(Debug, thiserror::Error)]
pub enum ListenError {
    #[error("failed to listen on {address}: {}", explain(source))]
    Bind { address: SocketAddr, source: io::Error },
    #[error("failed to start the server's thread")]
    Thread(#[source] io::Error),
}

fn explain(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::AddrInUse => {
            "another program listens there; choose another port, or 0 for a free one".to_owned()
        }
        io::ErrorKind::AddrNotAvailable => "this machine has no such address".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied; ports below 1024 are the administrator's".to_owned(),
        _ => error.to_string(),
    }
}

/// A server that runs. Dropping it stops it, without waiting for that.
#[derive(Debug)]
pub struct Server {
    address: SocketAddr,
    requests: mpsc::UnboundedSender<Request>,
    thread: JoinHandle<Statistics>,
}

/// What a [`Server`] asks of its thread.
enum Request {
    Statistics(std::sync::mpsc::Sender<Statistics>),
    Tempo(f64),
    Stop,
}

/// How many messages may wait for the automation before connections are left unread.
const ARRIVALS: usize = 1_024;
/// How many messages may wait for a simulation that does not read before it is cut off.
const ORDERS: usize = 65_536;
/// How long connections have to close when the server stops.
const FAREWELL: Duration = Duration::from_secs(1);
/// The WebSocket status code of an end that goes away (RFC 6455, section 7.4.1).
const GOING_AWAY: u16 = 1001;

impl Server {
    /// Starts listening, and gives back control once simulations can connect.
    pub fn start(settings: ListenSettings, automation: Faulty) -> Result<Server, ListenError> {
        let bound = |source| ListenError::Bind { address: settings.address, source };
        let listener = std::net::TcpListener::bind(settings.address).map_err(bound)?;
        listener.set_nonblocking(true).map_err(bound)?;
        let address = listener.local_addr().map_err(bound)?;
        let runtime =
            tokio::runtime::Builder::new_current_thread().enable_all().build().map_err(ListenError::Thread)?;
        let (requests, asked) = mpsc::unbounded_channel();
        let thread = std::thread::Builder::new()
            .name("automation".to_owned())
            .spawn(move || runtime.block_on(Hub::new(settings, automation).run(listener, asked)))
            .map_err(ListenError::Thread)?;
        Ok(Server { address, requests, thread })
    }

    /// Where it listens.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// What went through so far; `None` if its thread is no more.
    pub fn statistics(&self) -> Option<Statistics> {
        let (reply, replied) = std::sync::mpsc::channel();
        self.requests.send(Request::Statistics(reply)).ok()?;
        replied.recv().ok()
    }

    /// Lets the automation's clock go by at `rate` seconds a second from now on; at 0 it stands still, and messages are
    /// handled all the same.
    pub fn set_tempo(&self, rate: f64) {
        // A thread that is no more has no clock.
        let _ = self.requests.send(Request::Tempo(rate));
    }

    /// Closes every connection and stops; `None` if its thread died.
    pub fn stop(self) -> Option<Statistics> {
        // A thread that is no more needs no request.
        let _ = self.requests.send(Request::Stop);
        self.thread.join().ok()
    }
}

/// The automation's clock: so many seconds to a second of the wall clock.
struct Clock {
    from: std::time::Instant,
    /// What it showed then.
    shown: Instant,
    rate: f64,
}

impl Clock {
    fn start() -> Clock {
        Clock { from: std::time::Instant::now(), shown: Instant::ZERO, rate: 1.0 }
    }

    fn now(&self) -> Instant {
        let elapsed = self.from.elapsed();
        self.shown + if self.rate == 1.0 { elapsed } else { elapsed.mul_f64(self.rate) }
    }

    fn set_rate(&mut self, rate: f64) {
        *self = Clock { shown: self.now(), from: std::time::Instant::now(), rate: rate.clamp(0.0, 1e6) };
    }

    /// When it will show `due`; `None` while it stands still.
    fn to_system(&self, due: Instant) -> Option<std::time::Instant> {
        let left = due.since(self.shown);
        (self.rate > 0.0).then(|| self.from + if self.rate == 1.0 { left } else { left.div_f64(self.rate) })
    }
}

/// What the server's main task owns.
struct Hub {
    settings: ListenSettings,
    automation: Faulty,
    clock: Clock,
    connections: BTreeMap<ConnectionId, mpsc::Sender<Order>>,
    last: u64,
}

impl Hub {
    fn new(settings: ListenSettings, automation: Faulty) -> Hub {
        Hub { settings, automation, clock: Clock::start(), connections: BTreeMap::new(), last: 0 }
    }

    /// The automation's clock.
    fn now(&self) -> Instant {
        self.clock.now()
    }

    async fn run(mut self, listener: std::net::TcpListener, mut asked: mpsc::UnboundedReceiver<Request>) -> Statistics {
        let (arrive, mut arrivals) = mpsc::channel(ARRIVALS);
        let listener = match TcpListener::from_std(listener) {
            Ok(listener) => listener,
            Err(error) => {
                tracing::error!(target: "automation", "failed to listen: {error}");
                return self.automation.automation().statistics();
            }
        };
        loop {
            self.deliver();
            let alarm = self.automation.timeout().and_then(|due| self.clock.to_system(due));
            let congested = self.automation.is_congested();
            tokio::select! {
                Some(event) = arrivals.recv(), if !congested => self.arrived(event),
                () = until(alarm) => {
                    let now = self.now();
                    self.automation.wake(now);
                }
                accepted = listener.accept() => match accepted {
                    Ok((stream, peer)) => self.accept(stream, peer, arrive.clone()),
                    Err(error) => {
                        tracing::warn!(target: "automation", "failed to accept a connection: {error}");
                        // Out of file descriptors, most likely: trying again at once would only spin.
                        tokio::time::sleep(Duration::from_millis(100)).await;
                    }
                },
                request = asked.recv() => match request {
                    Some(Request::Statistics(reply)) => {
                        // Whoever asked may have gone.
                        let _ = reply.send(self.automation.automation().statistics());
                    }
                    Some(Request::Tempo(rate)) => self.clock.set_rate(rate),
                    Some(Request::Stop) | None => break,
                },
            }
        }
        drop((listener, arrive));
        self.say_farewell(arrivals).await
    }

    fn accept(&mut self, stream: TcpStream, peer: SocketAddr, arrive: mpsc::Sender<Event>) {
        self.last += 1;
        let id = ConnectionId(self.last);
        tracing::debug!(target: "automation", "{:>11} connection {} from {peer}", self.now(), id.0);
        let (order, orders) = mpsc::channel(ORDERS);
        self.connections.insert(id, order);
        tokio::spawn(connection::serve(stream, self.settings.clone(), id, orders, arrive));
    }

    /// Hands what came from a connection to the automation.
    fn arrived(&mut self, Event { connection, arrival }: Event) {
        let now = self.now();
        let input = match &arrival {
            Arrival::Opened => Input::Opened,
            Arrival::Text(text) => Input::Text(text.as_str()),
            Arrival::Binary => Input::Binary,
            Arrival::InvalidUtf8 => Input::InvalidUtf8,
            Arrival::TooLong => Input::TooLong { limit: self.settings.max_message },
            Arrival::Closed => {
                self.connections.remove(&connection);
                Input::Closed
            }
        };
        self.automation.handle(now, connection, input);
    }

    /// Hands what the automation wants sent to the connections.
    fn deliver(&mut self) {
        while let Some(delivery) = self.automation.poll() {
            let connection = delivery.connection();
            let order = match delivery {
                Delivery::Text { text, .. } => Order::Text(text),
                Delivery::Binary { bytes, .. } => Order::Binary(bytes),
                Delivery::Close { code, reason, .. } => Order::Close { code, reason },
                // Its task ends with its channel.
                Delivery::Abort { .. } => {
                    self.connections.remove(&connection);
                    continue;
                }
            };
            let Some(orders) = self.connections.get(&connection) else { continue };
            let last = matches!(order, Order::Close { .. });
            let full = matches!(orders.try_send(order), Err(mpsc::error::TrySendError::Full(_)));
            if full {
                let now = self.now();
                tracing::warn!(target: "automation", "{now:>11} session {} does not read: cut off", connection.0);
                self.automation.handle(now, connection, Input::Closed);
            }
            if last || full {
                self.connections.remove(&connection);
            }
        }
    }

    /// Closes every connection, and waits, not for long, until their tasks have ended.
    async fn say_farewell(mut self, mut arrivals: mpsc::Receiver<Event>) -> Statistics {
        let now = self.now();
        self.automation.close(now, GOING_AWAY, "the automation stops");
        self.deliver();
        self.connections.clear();
        let ended = async { while arrivals.recv().await.is_some() {} };
        let _ = tokio::time::timeout(FAREWELL, ended).await;
        self.automation.automation().statistics()
    }
}

/// Waits until `instant`; for ever if there is none.
async fn until(instant: Option<std::time::Instant>) {
    match instant {
        Some(instant) => tokio::time::sleep_until(instant.into()).await,
        None => std::future::pending().await,
    }
}
