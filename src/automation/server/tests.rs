//! The server as a WebSocket client sees it.

use futures_util::{SinkExt, StreamExt};
use tokio::net::TcpStream;
use tokio_tungstenite::tungstenite::Message;
use tokio_tungstenite::tungstenite::protocol::frame::Frame;
use tokio_tungstenite::tungstenite::protocol::frame::coding::{Data, OpCode};
use tokio_tungstenite::{WebSocketStream, client_async};

use super::{ListenError, ListenSettings, Server};
use crate::automation::fault::{Fault, Faulty};
use crate::automation::{Automation, Control, bench};

const CONNECT: &str = r#"{"Connect":{"Id":"b25l","enable":true}}"#;

fn start(faults: &[Fault]) -> Server {
    let automation = Automation::new(bench::rig(), Control::ByPlant).expect("the rig's program is bound");
    Server::start(ListenSettings::loopback(), Faulty::new(automation, faults, 1)).expect("a free port")
}

type Web = WebSocketStream<TcpStream>;

async fn connect(server: &Server) -> Web {
    let stream = TcpStream::connect(server.address()).await.expect("it listens");
    client_async(format!("ws://{}/", server.address()), stream).await.expect("it speaks WebSocket").0
}

/// The next text; how the connection ended, if it did: the code of its close frame, or 0 for none.
async fn next(web: &mut Web) -> Result<String, u16> {
    loop {
        match web.next().await {
            Some(Ok(Message::Text(text))) => return Ok(text.as_str().to_owned()),
            Some(Ok(Message::Close(frame))) => return Err(frame.map_or(0, |frame| frame.code.into())),
            Some(Ok(_)) => {}
            Some(Err(_)) | None => return Err(0),
        }
    }
}

/// Opens a session and takes what comes of itself: the reply, and all commands.
async fn open(server: &Server) -> Web {
    let mut web = connect(server).await;
    web.send(Message::text(CONNECT)).await.expect("sent");
    let reply = next(&mut web).await.expect("a reply");
    assert!(reply.contains(r#""result":200"#), "{reply}");
    let commands = next(&mut web).await.expect("all commands");
    assert!(commands.starts_with(r#"{"SendValue":[{"name":"Belt.velocityTarget""#), "{commands}");
    web
}

async fn answers(web: &mut Web) {
    web.send(Message::text(r#"{"QueryAll":{}}"#)).await.expect("sent");
    let reply = next(web).await.expect("a reply");
    assert!(reply.starts_with(r#"{"QueryAllReply""#), "{reply}");
}

#[tokio::test]
async fn a_session_over_a_real_socket() {
    let server = start(&[]);
    let mut web = open(&server).await;
    let report = r#"{"SendValue":[{"name":"Robot.cartesianArrived","value":true}]}"#;
    web.send(Message::text(report)).await.expect("sent");
    let commands = next(&mut web).await.expect("the program starts");
    assert!(commands.contains(r#"{"name":"Belt.motorDirection","value":1}"#), "{commands}");
    let statistics = server.statistics().expect("it runs");
    assert_eq!((statistics.sessions, statistics.messages_in), (1, 1));
    let stopping = tokio::task::spawn_blocking(|| server.stop());
    assert_eq!(next(&mut web).await, Err(1001));
    drop(web);
    let statistics = stopping.await.expect("no panic").expect("it ran");
    assert_eq!((statistics.sessions, statistics.sessions_ever), (0, 1));
}

#[tokio::test]
async fn a_binary_message_changes_nothing() {
    let server = start(&[]);
    let mut web = open(&server).await;
    web.send(Message::binary(vec![1, 2, 3])).await.expect("sent");
    answers(&mut web).await;
}

#[tokio::test]
async fn a_message_over_the_limit_closes_with_1009() {
    let server = start(&[]);
    let mut web = open(&server).await;
    // Written or not: the server hangs up before it has read all of it.
    let _ = web.send(Message::text("x".repeat((1 << 20) + 1))).await;
    assert_eq!(next(&mut web).await, Err(1009));
    open(&server).await;
}

#[tokio::test]
async fn what_is_no_utf_8_closes_with_1007() {
    let server = start(&[]);
    let mut web = open(&server).await;
    let frame = Frame::message(vec![b'{', 0xFF, b'}'], OpCode::Data(Data::Text), true);
    web.send(Message::Frame(frame)).await.expect("sent");
    assert_eq!(next(&mut web).await, Err(1007));
}

#[tokio::test]
async fn a_client_that_hangs_up_leaves_its_place() {
    let server = start(&[]);
    let mut web = open(&server).await;
    web.close(None).await.expect("closed");
    assert_eq!(next(&mut web).await, Err(0));
    let mut web = open(&server).await;
    answers(&mut web).await;
    drop(web);
    assert_eq!(server.stop().map(|statistics| statistics.sessions_ever), Some(2));
}

#[tokio::test]
async fn a_broken_connection_ends_without_a_close_frame() {
    let server = start(&[Fault::Drop(std::time::Duration::from_millis(20))]);
    let mut web = connect(&server).await;
    assert_eq!(next(&mut web).await, Err(0));
}

#[tokio::test]
async fn a_foreign_greeting_disturbs_nobody() {
    use tokio::io::{AsyncReadExt, AsyncWriteExt};
    let server = start(&[]);
    let mut stream = TcpStream::connect(server.address()).await.expect("it listens");
    stream.write_all(b"HELO there\r\n\r\n").await.expect("sent");
    let mut answer = Vec::new();
    let _ = stream.read_to_end(&mut answer).await;
    answers(&mut connect(&server).await).await;
}

#[test]
fn an_address_in_use_is_told_with_what_to_do() {
    let server = start(&[]);
    let automation = Automation::new(bench::rig(), Control::ByPlant).expect("the rig's program is bound");
    let error =
        Server::start(ListenSettings::new(server.address()), Faulty::new(automation, &[], 1)).expect_err("taken");
    let ListenError::Bind { .. } = &error else { panic!("{error:?}") };
    assert_eq!(
        error.to_string(),
        format!(
            "failed to listen on {}: another program listens there; choose another port, or 0 for a free one",
            server.address()
        )
    );
}
