//! The connector's transport over a real WebSocket (RFC 6455), the channel of the reference's IEC 61499 Connector.
//!
//! The simulation is the client. A `wss://` endpoint is reached over TLS. Small messages must not wait for one another, so `TCP_NODELAY` is set. A turn of the
//! loop writes all it has to send before it flushes once: waking the other side is what costs (see `docs/performance.md`).

use std::collections::VecDeque;
use std::future::Future;
use std::io;
use std::pin::Pin;
use std::task::{Context, Poll};
use std::time::Duration;

use futures_util::{SinkExt, StreamExt};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;
use tokio_tungstenite::WebSocketStream;
use tokio_tungstenite::client_async_with_config;
use tokio_tungstenite::tungstenite::client::IntoClientRequest;
use tokio_tungstenite::tungstenite::http::HeaderValue;
use tokio_tungstenite::tungstenite::http::header::AUTHORIZATION;
use tokio_tungstenite::tungstenite::protocol::frame::coding::CloseCode;
use tokio_tungstenite::tungstenite::protocol::{CloseFrame, WebSocketConfig};
use tokio_tungstenite::tungstenite::{Error, Message};

use super::connector::{Connector, Received, Transport};
use super::{Endpoint, Settings};
use crate::security::{self, Stream, Token};
use crate::time::Instant;

/// The connector over a real WebSocket.
pub type WebSocketConnector = Connector<Socket>;

impl WebSocketConnector {
    /// A connector that makes its connections on the tokio runtime it is driven on.
    pub fn new() -> WebSocketConnector {
        Connector::over(Socket::default())
    }
}

impl Default for WebSocketConnector {
    fn default() -> WebSocketConnector {
        WebSocketConnector::new()
    }
}

type Web = WebSocketStream<Stream>;
type Dialling = Pin<Box<dyn Future<Output = Result<Web, Error>> + Send>>;
type Closing = Pin<Box<dyn Future<Output = ()> + Send>>;

/// Past so many bytes waiting to be sent, nothing more is taken out of the bank.
const CONGESTED: usize = 256 * 1024;

/// How much is read at once, bytes. The WebSocket fills so much with zeros before it reads, whatever comes.
const READ_BUFFER: usize = 16 * 1024;

/// How long the other side of a connection that is being closed has to read the reason. Without this pause what it is
/// still sending would make the operating system reset the connection, and throw the reason away.
const LINGER: Duration = Duration::from_secs(1);

/// A [`Transport`] over one WebSocket at a time.
#[derive(Default)]
pub struct Socket {
    settings: Option<Settings>,
    state: State,
    /// Taken from the session, not yet given to the WebSocket.
    outgoing: VecDeque<String>,
    outgoing_bytes: usize,
    /// Connections that were closed from here and whose other side has not yet hung up.
    closing: Vec<Closing>,
}

#[derive(Default)]
enum State {
    #[default]
    Idle,
    Dialling(Dialling),
    Open(Box<Web>),
    /// Writing failed; why, for people. Told at the next `poll_receive`.
    Failed(String),
}

impl Transport for Socket {
    fn configure(&mut self, settings: &Settings) {
        self.settings = Some(settings.clone());
    }

    fn dial(&mut self, _now: Instant) {
        self.forget_outgoing();
        let settings = self.settings.clone().expect("a transport is configured before it dials");
        self.state = State::Dialling(Box::pin(open(settings)));
    }

    fn poll_receive(&mut self, cx: &mut Context<'_>, _now: Instant) -> Poll<Received> {
        self.closing.retain_mut(|closing| closing.as_mut().poll(cx).is_pending());
        match &mut self.state {
            State::Idle => Poll::Pending,
            State::Failed(why) => {
                let why = std::mem::take(why);
                self.hang_up(why)
            }
            State::Dialling(dialling) => match dialling.as_mut().poll(cx) {
                Poll::Pending => Poll::Pending,
                Poll::Ready(Ok(web)) => {
                    self.state = State::Open(Box::new(web));
                    Poll::Ready(Received::Opened)
                }
                Poll::Ready(Err(error)) => {
                    let why = self.explain_dial(&error);
                    match (self.hang_up(why), is_denial(&error)) {
                        (Poll::Ready(Received::Closed(why)), true) => Poll::Ready(Received::Denied(why)),
                        (received, _) => received,
                    }
                }
            },
            State::Open(_) => self.poll_frame(cx),
        }
    }

    fn send(&mut self, _now: Instant, text: String) {
        if let State::Open(_) = self.state {
            self.outgoing_bytes += text.len();
            self.outgoing.push_back(text);
        }
    }

    fn flush(&mut self, cx: &mut Context<'_>) {
        let State::Open(web) = &mut self.state else { return };
        let written = loop {
            match web.poll_ready_unpin(cx) {
                Poll::Ready(Ok(())) => {}
                Poll::Ready(Err(error)) => break Err(error),
                Poll::Pending => return,
            }
            let Some(text) = self.outgoing.pop_front() else { break Ok(()) };
            self.outgoing_bytes -= text.len();
            if let Err(error) = web.start_send_unpin(Message::text(text)) {
                break Err(error);
            }
        };
        let flushed = match written {
            Ok(()) => web.poll_flush_unpin(cx),
            Err(error) => Poll::Ready(Err(error)),
        };
        if let Poll::Ready(Err(error)) = flushed {
            self.state = State::Failed(explain(&error));
            cx.waker().wake_by_ref();
        }
    }

    fn is_congested(&self) -> bool {
        self.outgoing_bytes > CONGESTED
    }

    fn close(&mut self, _now: Instant, code: u16, reason: &str) {
        if let State::Open(web) = std::mem::take(&mut self.state) {
            let last = std::mem::take(&mut self.outgoing);
            self.closing.push(Box::pin(close(web, last, CloseCode::from(code), shortened(reason))));
        }
        self.forget_outgoing();
    }

    fn is_idle(&self) -> bool {
        matches!(self.state, State::Idle) && self.closing.is_empty()
    }

    fn abort(&mut self) {
        self.state = State::Idle;
        self.closing.clear();
        self.forget_outgoing();
    }
}

impl Socket {
    fn forget_outgoing(&mut self) {
        self.outgoing.clear();
        self.outgoing_bytes = 0;
    }

    fn hang_up(&mut self, why: String) -> Poll<Received> {
        self.state = State::Idle;
        self.forget_outgoing();
        Poll::Ready(Received::Closed(why))
    }

    fn poll_frame(&mut self, cx: &mut Context<'_>) -> Poll<Received> {
        let State::Open(web) = &mut self.state else { return Poll::Pending };
        let limit = web.get_config().max_message_size.unwrap_or(usize::MAX);
        loop {
            return match web.poll_next_unpin(cx) {
                Poll::Pending => Poll::Pending,
                Poll::Ready(Some(Ok(Message::Text(text)))) => Poll::Ready(Received::Text(text.as_str().to_owned())),
                Poll::Ready(Some(Ok(Message::Binary(_)))) => Poll::Ready(Received::Binary),
                // Pings are answered by the WebSocket itself; a close frame is followed by the end of the stream.
                Poll::Ready(Some(Ok(Message::Close(frame)))) => {
                    let why = farewell(frame.as_ref());
                    if let State::Open(web) = std::mem::take(&mut self.state) {
                        self.closing.push(Box::pin(acknowledge(web)));
                        cx.waker().wake_by_ref();
                    }
                    self.hang_up(why)
                }
                Poll::Ready(Some(Ok(_))) => continue,
                Poll::Ready(Some(Err(Error::Capacity(_)))) => Poll::Ready(Received::TooLong { limit }),
                Poll::Ready(Some(Err(Error::Utf8(_)))) => Poll::Ready(Received::InvalidUtf8),
                Poll::Ready(Some(Err(error))) => self.hang_up(explain(&error)),
                Poll::Ready(None) => self.hang_up("the server closed the connection".to_owned()),
            };
        }
    }

    fn explain_dial(&self, error: &Error) -> String {
        let endpoint = self.settings.as_ref().map(|s| s.endpoint.to_string()).unwrap_or_default();
        format!("failed to connect to {endpoint}: {}", explain(error))
    }
}

/// Opens a connection: TCP, then the WebSocket handshake.
async fn open(settings: Settings) -> Result<Web, Error> {
    let Settings { endpoint, max_message, token, tls, .. } = &settings;
    let stream = TcpStream::connect((endpoint.host(), endpoint.port())).await?;
    stream.set_nodelay(true)?;
    let stream = match tls.as_ref().filter(|_| endpoint.is_secure()) {
        Some(tls) => tls.connect(endpoint.host(), stream).await?,
        None => Stream::Plain(stream),
    };
    let request = handshake(endpoint, token.as_ref())?;
    let limits = WebSocketConfig::default()
        .max_message_size(Some(*max_message))
        .max_frame_size(Some(*max_message))
        .read_buffer_size(READ_BUFFER);
    let (web, _response) = client_async_with_config(request, stream, Some(limits)).await?;
    Ok(web)
}

fn handshake(
    endpoint: &Endpoint,
    token: Option<&Token>,
) -> Result<tokio_tungstenite::tungstenite::handshake::client::Request, Error> {
    let mut request = endpoint.to_string().into_client_request()?;
    if let Some(token) = token {
        let mut value = HeaderValue::from_str(&token.header())?;
        value.set_sensitive(true);
        request.headers_mut().insert(AUTHORIZATION, value);
    }
    Ok(request)
}

/// Sends what is left and the close frame, then waits, not for long, until the other side has hung up.
async fn close(mut web: Box<Web>, last: VecDeque<String>, code: CloseCode, reason: String) {
    let goodbye = async {
        for text in last {
            web.feed(Message::text(text)).await.ok()?;
        }
        web.close(Some(CloseFrame { code, reason: reason.into() })).await.ok()?;
        let mut stream = (*web).into_inner();
        stream.shutdown().await.ok()?;
        // What still comes is thrown away unread: the session has said all it had to say.
        let mut scrap = vec![0; 64 * 1024];
        while stream.read(&mut scrap).await.ok()? > 0 {}
        Some(())
    };
    let _ = tokio::time::timeout(LINGER, goodbye).await;
}

/// Lets the WebSocket answer the other side's close frame.
async fn acknowledge(mut web: Box<Web>) {
    let rest = async { while web.next().await.is_some() {} };
    let _ = tokio::time::timeout(LINGER, rest).await;
}

/// A close frame has room for 123 bytes of reason (RFC 6455, section 5.5).
fn shortened(reason: &str) -> String {
    let mut end = reason.len().min(123);
    while !reason.is_char_boundary(end) {
        end -= 1;
    }
    reason[..end].to_owned()
}

fn farewell(frame: Option<&CloseFrame>) -> String {
    match frame {
        None => "the server closed the connection".to_owned(),
        Some(frame) if frame.reason.is_empty() => format!("the server closed the connection ({})", frame.code),
        Some(frame) => format!("the server closed the connection ({}: {})", frame.code, frame.reason.as_str()),
    }
}

/// Whether a dial that failed with `error` would fail again, however often it is tried: one side does not accept what the
/// other shows of itself.
fn is_denial(error: &Error) -> bool {
    match error {
        Error::Io(error) => security::explain(error).is_some(),
        Error::Http(response) => [401, 403].contains(&response.status().as_u16()),
        _ => false,
    }
}

/// What an error of the WebSocket means to people.
fn explain(error: &Error) -> String {
    match error {
        Error::Io(error) if security::explain(error).is_some() => security::explain(error).unwrap_or_default(),
        Error::Io(error) => match error.kind() {
            io::ErrorKind::ConnectionRefused => "nobody listens there".to_owned(),
            io::ErrorKind::ConnectionReset | io::ErrorKind::BrokenPipe => "the connection broke off".to_owned(),
            _ => error.to_string(),
        },
        Error::Http(response) if response.status() == 401 => {
            "the server asks for a token, and does not accept ours or had none: give the right one with --token-file FILE \
             or in KINETWIN_TOKEN (HTTP status 401)"
                .to_owned()
        }
        Error::Http(response) if response.status() == 403 => {
            "the server knows us and does not let us in: ask for the right to connect (HTTP status 403)".to_owned()
        }
        Error::Http(response) => {
            format!("the server answered the WebSocket handshake with HTTP status {}", response.status())
        }
        Error::ConnectionClosed | Error::AlreadyClosed => "the connection is closed".to_owned(),
        Error::Protocol(error) => format!("the server does not keep to the WebSocket protocol: {error}"),
        error => error.to_string(),
    }
}
