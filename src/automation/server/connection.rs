//! One connection of the server: the WebSocket's handshake, its frames both ways, its end.

use std::time::Duration;

use futures_util::stream::{SplitSink, SplitStream};
use futures_util::{SinkExt, StreamExt};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;
use tokio::sync::mpsc;
use tokio_tungstenite::tungstenite::handshake::server::{Callback, ErrorResponse, Request, Response};
use tokio_tungstenite::tungstenite::http::header::{AUTHORIZATION, WWW_AUTHENTICATE};
use tokio_tungstenite::tungstenite::http::{HeaderValue, StatusCode};
use tokio_tungstenite::tungstenite::protocol::frame::coding::CloseCode;
use tokio_tungstenite::tungstenite::protocol::{CloseFrame, WebSocketConfig};
use tokio_tungstenite::tungstenite::{Error, Message, Utf8Bytes};
use tokio_tungstenite::{WebSocketStream, accept_hdr_async_with_config};

use super::ListenSettings;
use crate::automation::ConnectionId;
use crate::security::{Stream, Token};

/// What a connection gives.
pub struct Event {
    pub connection: ConnectionId,
    pub arrival: Arrival,
}

/// What happened on a connection.
pub enum Arrival {
    Opened,
    Text(Utf8Bytes),
    Binary,
    InvalidUtf8,
    TooLong,
    Closed,
}

/// What a connection is told to do. It drops everything when its channel ends without [`Order::Close`].
pub enum Order {
    Text(String),
    Binary(Vec<u8>),
    Close { code: u16, reason: String },
}

/// How much is read at once, bytes. The WebSocket fills so much with zeros before it reads, whatever comes.
const READ_BUFFER: usize = 16 * 1024;

type Web = WebSocketStream<Stream>;

/// How long a client has for the handshake.
const HANDSHAKE: Duration = Duration::from_secs(10);
/// How long a client has to read the reason of a close and to hang up. Without this pause, what it is still sending would
/// make the operating system reset the connection, and throw the reason away.
const LINGER: Duration = Duration::from_secs(1);

/// How a connection ended for its reader or its writer.
enum End {
    /// The client is gone, or the connection was told to drop.
    Gone,
    /// What the client sent cannot be read any further; the session will say how to close.
    Unreadable,
    /// The session closes.
    Close(CloseFrame),
}

/// The way back to the server's main task.
struct Hub {
    connection: ConnectionId,
    arrive: mpsc::Sender<Event>,
}

impl Hub {
    /// Tells what happened; false if nobody wants to know any more.
    async fn tell(&self, arrival: Arrival) -> bool {
        self.arrive.send(Event { connection: self.connection, arrival }).await.is_ok()
    }
}

/// Serves one connection from its handshake to its end.
pub async fn serve(
    stream: TcpStream,
    settings: ListenSettings,
    connection: ConnectionId,
    orders: mpsc::Receiver<Order>,
    arrive: mpsc::Sender<Event>,
) {
    // A client that is gone already shows at the handshake.
    let _ = stream.set_nodelay(true);
    let hub = Hub { connection, arrive };
    match tokio::time::timeout(HANDSHAKE, open(stream, &settings)).await {
        Ok(Ok(web)) => {
            if hub.tell(Arrival::Opened).await {
                exchange(web, orders, &hub).await;
            }
        }
        Ok(Err(error)) => {
            tracing::warn!(target: "automation", "connection {} was not let in: {error}", connection.0);
        }
        Err(_) => tracing::warn!(target: "automation", "connection {}: no handshake came", connection.0),
    }
    hub.tell(Arrival::Closed).await;
}

/// Makes the handshakes: that of TLS, where it is spoken, then the WebSocket's, in which the token is shown.
async fn open(stream: TcpStream, settings: &ListenSettings) -> Result<Web, Error> {
    let stream = match &settings.tls {
        Some(tls) => tls.accept(stream).await?,
        None => Stream::Plain(stream),
    };
    let limit = Some(settings.max_message);
    let limits = WebSocketConfig::default().max_message_size(limit).max_frame_size(limit).read_buffer_size(READ_BUFFER);
    accept_hdr_async_with_config(stream, Admission(settings.token.as_ref()), Some(limits)).await
}

/// Lets in who shows the token, where one is asked for.
struct Admission<'a>(Option<&'a Token>);

impl Callback for Admission<'_> {
    fn on_request(self, request: &Request, response: Response) -> Result<Response, ErrorResponse> {
        let shown = request.headers().get(AUTHORIZATION).map(|value| value.as_bytes());
        if self.0.is_none_or(|token| shown.is_some_and(|shown| token.is_carried_by(shown))) {
            return Ok(response);
        }
        let mut refusal = ErrorResponse::new(Some("a bearer token is needed\n".to_owned()));
        *refusal.status_mut() = StatusCode::UNAUTHORIZED;
        refusal.headers_mut().insert(WWW_AUTHENTICATE, HeaderValue::from_static("Bearer"));
        Err(refusal)
    }
}

/// Moves frames both ways until the connection ends.
async fn exchange(web: Web, mut orders: mpsc::Receiver<Order>, hub: &Hub) {
    let (mut sink, mut stream) = web.split();
    let end = tokio::select! {
        end = read(&mut stream, hub) => match end {
            // The session's verdict, which the writer brings, is a matter of microseconds; unless it is to stay silent.
            End::Unreadable => tokio::time::timeout(LINGER, write(&mut sink, &mut orders)).await.unwrap_or(End::Gone),
            end => end,
        },
        end = write(&mut sink, &mut orders) => end,
    };
    if let (End::Close(frame), Ok(web)) = (end, sink.reunite(stream)) {
        let _ = tokio::time::timeout(LINGER, close(web, frame)).await;
    }
}

async fn read(stream: &mut SplitStream<Web>, hub: &Hub) -> End {
    loop {
        let arrival = match stream.next().await {
            Some(Ok(Message::Text(text))) => Arrival::Text(text),
            Some(Ok(Message::Binary(_))) => Arrival::Binary,
            // The WebSocket answers pings, and a close frame while the stream is read to its end.
            Some(Ok(_)) => continue,
            Some(Err(Error::Utf8(_))) => Arrival::InvalidUtf8,
            Some(Err(Error::Capacity(_))) => Arrival::TooLong,
            Some(Err(_)) | None => return End::Gone,
        };
        let unreadable = matches!(arrival, Arrival::InvalidUtf8 | Arrival::TooLong);
        if !hub.tell(arrival).await {
            return End::Gone;
        }
        if unreadable {
            return End::Unreadable;
        }
    }
}

/// Writes all that waits before it flushes once: waking the other side is what costs.
async fn write(sink: &mut SplitSink<Web, Message>, orders: &mut mpsc::Receiver<Order>) -> End {
    while let Some(order) = orders.recv().await {
        let mut next = Some(order);
        while let Some(order) = next {
            let message = match order {
                Order::Text(text) => Message::text(text),
                Order::Binary(bytes) => Message::binary(bytes),
                Order::Close { code, reason } => {
                    return End::Close(CloseFrame { code: CloseCode::from(code), reason: shortened(&reason).into() });
                }
            };
            if sink.feed(message).await.is_err() {
                return End::Gone;
            }
            next = orders.try_recv().ok();
        }
        if sink.flush().await.is_err() {
            return End::Gone;
        }
    }
    End::Gone
}

/// Sends the close frame, then waits until the client has hung up.
async fn close(mut web: Web, frame: CloseFrame) -> Option<()> {
    web.close(Some(frame)).await.ok()?;
    let mut stream = web.into_inner();
    stream.shutdown().await.ok()?;
    let mut scrap = vec![0; 64 * 1024];
    while stream.read(&mut scrap).await.ok()? > 0 {}
    Some(())
}

/// A close frame has room for 123 bytes of reason (RFC 6455, section 5.5).
fn shortened(reason: &str) -> String {
    let mut end = reason.len().min(123);
    while !reason.is_char_boundary(end) {
        end -= 1;
    }
    reason[..end].to_owned()
}
