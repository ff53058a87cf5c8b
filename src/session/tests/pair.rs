//! Two peers under one virtual clock, and the network between them.

use std::collections::VecDeque;

use super::dice::Dice;
use super::*;
use crate::value::Value;

/// A message under way.
#[derive(Clone, Debug)]
pub(super) enum Frame {
    Text(String),
    Binary,
    InvalidUtf8,
    TooLong,
}

impl Frame {
    fn input(&self) -> Input<'_> {
        match self {
            Frame::Text(text) => Input::Text(text),
            Frame::Binary => Input::Binary,
            Frame::InvalidUtf8 => Input::InvalidUtf8,
            Frame::TooLong => Input::TooLong { limit: 1 << 20 },
        }
    }
}

/// What one connection carried, value by value, in the order of the calls.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Log {
    pub(super) sent: Vec<(RegisterId, Value)>,
    pub(super) received: Vec<(RegisterId, Value)>,
}

/// What one connection carried each way.
#[derive(Clone, Debug, Default)]
pub(super) struct Connection {
    pub(super) commands: Log,
    pub(super) reports: Log,
}

/// A client and, while a connection stands, a server; the connection keeps order and loses nothing until it breaks, as
/// TCP does. Both owners send the present values when a session stands, as the protocol asks them to.
pub(super) struct Pair {
    pub(super) now: Instant,
    pub(super) client: Client,
    pub(super) server: Option<Server>,
    /// Frames to the server and to the client, with the instants of their arrival.
    to_server: VecDeque<(Instant, Frame)>,
    to_client: VecDeque<(Instant, Frame)>,
    /// When the dial under way will be answered.
    dialled: Option<Instant>,
    /// What the server is told to do.
    pub(super) settings: ServerSettings,
    /// Whether a server listens.
    pub(super) listening: bool,
    /// How long a frame takes.
    pub(super) latency: Duration,
    /// One for every connection that was opened.
    pub(super) connections: Vec<Connection>,
    /// The last value of the sequence each side counts up.
    sequence: i64,
    echo: i64,
    pub(super) ended: bool,
    /// Which of several things that are due happens first; without it, always in the order of [`Due`].
    pub(super) order: Option<Dice>,
}

/// What happens next.
#[derive(Clone, Copy, Debug)]
enum Due {
    Dialled,
    AtServer,
    AtClient,
    ClientTimeout,
    ServerTimeout,
}

impl Pair {
    pub(super) fn new() -> Pair {
        Pair {
            now: Instant::ZERO,
            client: client(),
            server: None,
            to_server: VecDeque::new(),
            to_client: VecDeque::new(),
            dialled: None,
            settings: ServerSettings::new("mock"),
            listening: true,
            latency: Duration::from_millis(1),
            connections: Vec::new(),
            sequence: 0,
            echo: 0,
            ended: false,
            order: None,
        }
    }

    /// Lets everything happen that happens until `end`.
    pub(super) fn run_until(&mut self, end: Instant) {
        self.settle();
        while let Some(next) = self.next_event().filter(|next| *next <= end) {
            self.now = self.now.max(next);
            self.happen();
            self.settle();
        }
        self.now = end;
    }

    /// Sends the next number each way, where a session stands; the two sides do not know of each other's sending.
    pub(super) fn count_up(&mut self) {
        self.echo += 1;
        self.send_report();
        self.sequence += 1;
        self.send_command();
        self.settle();
    }

    fn send_report(&mut self) {
        let values = [(register("Belt.echo"), Value::Lint(self.echo))];
        if self.client.send(self.now, &values)
            && let Some(connection) = self.connections.last_mut()
        {
            connection.reports.sent.extend(values);
        }
    }

    fn send_command(&mut self) {
        let values = [
            (register("Belt.sequence"), Value::Lint(self.sequence)),
            (register("Belt.run"), Value::Bool(self.sequence % 2 == 1)),
        ];
        if let (Some(server), Some(connection)) = (&mut self.server, self.connections.last_mut())
            && server.send(self.now, &values)
        {
            connection.commands.sent.extend(values);
        }
    }

    /// Breaks the connection: frames under way are lost, and both sides learn of it.
    pub(super) fn cut(&mut self) {
        if let Some(mut server) = self.server.take() {
            self.to_server.clear();
            self.to_client.clear();
            server.handle(self.now, Input::Closed);
            self.client.handle(self.now, Input::Closed);
            self.settle();
        }
    }

    /// Slips a frame in behind those under way to the client, or to the server.
    pub(super) fn inject(&mut self, frame: Frame, to_client: bool) {
        if self.server.is_some() {
            self.post(frame, to_client);
        }
    }

    fn post(&mut self, frame: Frame, to_client: bool) {
        let arrival = self.now + self.latency;
        let queue = if to_client { &mut self.to_client } else { &mut self.to_server };
        // A frame never overtakes another, however the latency changed meanwhile.
        let arrival = queue.back().map_or(arrival, |(last, _)| arrival.max(*last));
        queue.push_back((arrival, frame));
    }

    /// All that is to come, each with its instant.
    fn agenda(&self) -> [(Option<Instant>, Due); 5] {
        let arrival = |queue: &VecDeque<(Instant, Frame)>| queue.front().map(|(arrival, _)| *arrival);
        [
            (self.dialled, Due::Dialled),
            (arrival(&self.to_server), Due::AtServer),
            (arrival(&self.to_client), Due::AtClient),
            (self.client.timeout(), Due::ClientTimeout),
            (self.server.as_ref().and_then(Server::timeout), Due::ServerTimeout),
        ]
    }

    fn next_event(&self) -> Option<Instant> {
        self.agenda().into_iter().filter_map(|(at, _)| at).min()
    }

    fn happen(&mut self) {
        let now = self.now;
        let is_due = |(at, _): &(Option<Instant>, Due)| at.is_some_and(|at| at <= now);
        let agenda = self.agenda();
        let due = agenda.iter().filter(|item| is_due(item)).count() as u64;
        let first = self.order.as_mut().map_or(0, |dice| dice.roll(due.max(1)));
        let Some((_, next)) = agenda.into_iter().filter(is_due).nth(first as usize) else { return };
        match next {
            Due::Dialled => self.answer_dial(),
            Due::AtServer => {
                if let Some((_, frame)) = self.to_server.pop_front()
                    && let Some(server) = &mut self.server
                {
                    *server.settings_mut() = self.settings.clone();
                    server.handle(now, frame.input());
                }
            }
            Due::AtClient => {
                if let Some((_, frame)) = self.to_client.pop_front() {
                    self.client.handle(now, frame.input());
                }
            }
            Due::ClientTimeout => self.client.handle(now, Input::Timeout),
            Due::ServerTimeout => {
                if let Some(server) = &mut self.server {
                    server.handle(now, Input::Timeout);
                }
            }
        }
    }

    fn answer_dial(&mut self) {
        self.dialled = None;
        if self.listening {
            self.server = Some(Server::new(self.settings.clone(), map()));
            self.connections.push(Connection::default());
            self.client.handle(self.now, Input::Opened);
        } else {
            self.client.handle(self.now, Input::Closed);
        }
    }

    /// Obeys what both sides want done.
    fn settle(&mut self) {
        loop {
            if let Some(output) = self.client.poll() {
                self.obey_client(output);
            } else if let Some(output) = self.server.as_mut().and_then(Server::poll) {
                self.obey_server(output);
            } else {
                return;
            }
        }
    }

    fn obey_client(&mut self, output: Output<ClientEvent>) {
        match output {
            Output::Transmit(text) => self.post(Frame::Text(text), false),
            Output::Close { .. } => {
                self.dialled = None;
                if let Some(mut server) = self.server.take() {
                    self.to_server.clear();
                    self.to_client.clear();
                    server.handle(self.now, Input::Closed);
                }
            }
            Output::Event(ClientEvent::Dial { .. }) => self.dialled = Some(self.now + self.latency),
            Output::Event(ClientEvent::Established { .. }) => self.send_report(),
            Output::Event(ClientEvent::Values(staged)) => {
                let connection = self.connections.last_mut().expect("values come over a connection");
                connection.commands.received.extend(staged.values);
            }
            Output::Event(ClientEvent::Ended(_)) => self.ended = true,
            Output::Event(_) => {}
        }
    }

    fn obey_server(&mut self, output: Output<ServerEvent>) {
        match output {
            Output::Transmit(text) => self.post(Frame::Text(text), true),
            Output::Close { .. } => {
                self.server = None;
                self.to_server.clear();
                self.to_client.clear();
                self.client.handle(self.now, Input::Closed);
            }
            Output::Event(ServerEvent::Connected { .. }) => self.send_command(),
            Output::Event(ServerEvent::Values(staged)) => {
                let connection = self.connections.last_mut().expect("values come over a connection");
                connection.reports.received.extend(staged.values);
            }
            Output::Event(_) => {}
        }
    }
}

#[test]
fn two_peers_connect_exchange_and_part() {
    let mut pair = Pair::new();
    pair.run_until(at(10));
    assert!(pair.client.is_established());
    for ms in 11..20 {
        pair.count_up();
        pair.run_until(at(ms));
    }
    pair.run_until(at(30));
    let connection = pair.connections[0].clone();
    assert_eq!(connection.commands.sent.len(), 2 * 10, "nine, and the present values at the start");
    assert_eq!(connection.commands.received, connection.commands.sent);
    assert_eq!(connection.reports.sent.len(), 10);
    assert_eq!(connection.reports.received, connection.reports.sent);
    let now = pair.now;
    pair.client.disconnect(now);
    pair.run_until(at(40));
    assert!(pair.ended && pair.server.is_none());
}

#[test]
fn after_a_reconnect_both_sides_have_the_present_values() {
    let mut pair = Pair::new();
    pair.run_until(at(10));
    pair.cut();
    pair.count_up();
    pair.count_up();
    pair.run_until(at(2000));
    assert_eq!(pair.connections.len(), 2);
    let connection = &pair.connections[1];
    assert_eq!(connection.reports.received, [(register("Belt.echo"), Value::Lint(2))]);
    let commands = [(register("Belt.sequence"), Value::Lint(2)), (register("Belt.run"), Value::Bool(false))];
    assert_eq!(connection.commands.received, commands);
}

#[test]
fn an_absent_server_is_found_when_it_comes() {
    let mut pair = Pair::new();
    pair.listening = false;
    pair.run_until(at(60_000));
    assert!(pair.connections.is_empty());
    pair.listening = true;
    pair.run_until(at(90_001));
    assert!(pair.client.is_established());
}
