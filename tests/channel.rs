//! R003, R004, R006 of the reference's section 5.2.1: numbered values both ways over a real socket, while the way is bad.
//! The receivers count: in order, none twice, none left out; and where the docs say that something is not kept, that.

use std::net::{TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, AtomicI64, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::Duration;

use kinetwin::adapter::{Adapter, Endpoint, NoWitness, Settings, Traffic, WebSocketConnector};
use kinetwin::bank;
use kinetwin::pace::{Exchange, Rates, WallClock, bell, drive};
use kinetwin::session::{Input, Limits, Output, Server, ServerEvent, ServerSettings};
use kinetwin::signal_map::{Direction, Kind, RateClass, Signal, SignalMap};
use kinetwin::time::Instant;
use kinetwin::value::{ElementaryType, SignalType, Unit, Value};
use tokio_tungstenite::tungstenite::{Message, WebSocket, accept};

/// A number from each side.
fn map() -> Arc<SignalMap> {
    let signal = |name: &str, direction| Signal {
        name: format!("Counter.{name}"),
        ty: SignalType::scalar(ElementaryType::Dint),
        direction,
        kind: Kind::Edge,
        rate: RateClass::HighFrequency,
        unit: Unit::ONE,
        min: None,
        max: None,
        instance: "Counter".to_owned(),
        task: "Counter".to_owned(),
        property: name.to_owned(),
    };
    let signals = vec![signal("command", Direction::Command), signal("report", Direction::Report)];
    Arc::new(SignalMap::new("counter", signals).expect("two names"))
}

/// The simulation's end: a thread that counts up when it is told to, and the IO thread of a run.
struct Simulation {
    /// How far it counts.
    target: Arc<AtomicI64>,
    reached: Arc<AtomicI64>,
    over: Arc<AtomicBool>,
    /// The commands, in the order in which steps took them.
    taken: Arc<Mutex<Vec<i32>>>,
    counting: JoinHandle<()>,
    speaking: JoinHandle<Traffic>,
}

impl Simulation {
    fn start(listener: &TcpListener) -> Simulation {
        let map = map();
        let (mut side, io) = bank::new(&map);
        let address = listener.local_addr().expect("an address");
        let (mut bell, ears) = bell().expect("a bell");
        let (target, reached) = (Arc::new(AtomicI64::new(0)), Arc::new(AtomicI64::new(0)));
        let (over, taken) = (Arc::new(AtomicBool::new(false)), Arc::new(Mutex::new(Vec::new())));
        let counting = {
            let (target, reached, over, taken) = (target.clone(), reached.clone(), over.clone(), taken.clone());
            std::thread::spawn(move || {
                let mut number = 0;
                let mut step = 0;
                let mut inputs = Vec::new();
                while !over.load(Ordering::Relaxed) {
                    side.take(&mut inputs);
                    let numbers = inputs.iter().map(|(_, value)| value.to_f64().expect("a number") as i32);
                    taken.lock().expect("a list").extend(numbers);
                    let rests = i64::from(number) >= target.load(Ordering::Relaxed);
                    number += i32::from(!rests);
                    if side.publish(Instant::from_nanos(step), &[Value::Dint(0), Value::Dint(number)]) {
                        bell.ring();
                    }
                    reached.store(i64::from(number), Ordering::Relaxed);
                    step += 1_000_000;
                    // A step takes one command; others may wait behind it.
                    if rests && inputs.is_empty() {
                        // Until it is told to go on, or the IO thread has had a turn and may have brought something.
                        std::thread::park();
                    }
                }
            })
        };
        let counter = counting.thread().clone();
        let speaking = std::thread::spawn(move || {
            let mut connector = WebSocketConnector::new();
            let endpoint = Endpoint::new(address.ip().to_string(), address.port());
            connector.configure(Settings::new(endpoint, "counter")).expect("settings that work");
            connector.init(&map);
            connector.connect();
            let rates = Rates { high: Duration::from_millis(10), low: Duration::from_millis(500) };
            let mut exchange = Exchange::new(connector, io, NoWitness, rates);
            let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().expect("a runtime");
            runtime.block_on(async {
                let ears = ears.listen().expect("ears");
                drive(&mut exchange, ears, WallClock::start(), |_, _| counter.unpark()).await;
            });
            exchange.adapter().traffic()
        });
        Simulation { target, reached, over, taken, counting, speaking }
    }

    /// Counts on to `number`, as fast as it can.
    fn count_to(&self, number: i32) {
        self.target.store(number.into(), Ordering::Relaxed);
        self.counting.thread().unpark();
    }

    /// Waits until it has counted to `number`.
    fn wait_for(&self, number: i32) {
        while self.reached.load(Ordering::Relaxed) < number.into() {
            std::thread::yield_now();
        }
    }

    /// Waits until a step took the command `number`, and gives all that were taken.
    fn taken_up_to(&self, number: i32) -> Vec<i32> {
        loop {
            let taken = self.taken.lock().expect("a list").clone();
            if taken.last() == Some(&number) {
                return taken;
            }
            std::thread::yield_now();
        }
    }

    /// Ends the run in good order, and gives what went through.
    fn end(self, automation: Automation) -> Traffic {
        self.over.store(true, Ordering::Relaxed);
        self.counting.thread().unpark();
        self.counting.join().expect("the counting thread");
        automation.hear_the_end();
        self.speaking.join().expect("the IO thread")
    }
}

/// The automation's end of one connection.
struct Automation {
    socket: WebSocket<TcpStream>,
    server: Server,
    /// The numbers in the order in which they came.
    heard: Vec<i32>,
    /// Why the other side closed.
    closed: Option<u16>,
}

impl Automation {
    /// The next connection, from its handshake to the first reports.
    fn accept(listener: &TcpListener) -> Automation {
        let (stream, _) = listener.accept().expect("a connection");
        stream.set_nodelay(true).expect("no delay");
        let socket = accept(stream).expect("a WebSocket");
        let limits = Limits { messages_a_second: u32::MAX, ..Limits::default() };
        let server = Server::new(ServerSettings { limits, ..ServerSettings::new("counter") }, map());
        let mut automation = Automation { socket, server, heard: Vec::new(), closed: None };
        while automation.heard.is_empty() {
            automation.read();
        }
        automation
    }

    /// Reads one message; false where there is none any more.
    fn read(&mut self) -> bool {
        match self.socket.read() {
            Ok(Message::Text(text)) => self.server.handle(Instant::ZERO, Input::Text(&text)),
            Ok(Message::Close(frame)) => self.closed = frame.map(|frame| frame.code.into()),
            Ok(_) => {}
            Err(_) => return false,
        }
        while let Some(output) = self.server.poll() {
            match output {
                Output::Transmit(text) => _ = self.socket.send(Message::text(text)),
                Output::Event(ServerEvent::Values(staged)) => {
                    let numbers = staged.values.iter().map(|(_, value)| value.to_f64().expect("a number") as i32);
                    self.heard.extend(numbers);
                }
                _ => {}
            }
        }
        true
    }

    fn read_up_to(&mut self, number: i32) {
        while self.heard.last() != Some(&number) {
            assert!(self.read(), "the connection ended after {:?}", self.heard.last());
        }
    }

    fn send(&mut self, number: i32) {
        let text = format!(r#"{{"SendValue":[{{"name":"Counter.command","value":{number}}}]}}"#);
        self.socket.send(Message::text(text)).expect("a message that can be sent");
    }

    fn hear_the_end(mut self) {
        while self.read() {}
    }
}

fn listen() -> TcpListener {
    TcpListener::bind("127.0.0.1:0").expect("a free port")
}

/// That `numbers` count up by one, none left out and none twice.
#[track_caller]
fn counted(numbers: &[i32], from: i32, to: i32) {
    let hole = numbers.windows(2).find(|pair| pair[1] != pair[0] + 1);
    assert_eq!((hole, numbers.first(), numbers.last()), (None, Some(&from), Some(&to)));
}

#[test]
fn under_jitter_every_number_arrives_both_ways_once_and_in_order() {
    let listener = listen();
    let simulation = Simulation::start(&listener);
    let mut automation = Automation::accept(&listener);
    let mut dice = 0x9e37_79b9_u32;
    let mut late = Vec::new();
    for number in 1..=1_000 {
        dice = dice.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        late.push(number);
        simulation.count_to(2 * number);
        // One in four goes at once, with all that was late before it.
        if dice >> 30 == 0 || number == 1_000 {
            late.drain(..).for_each(|number| automation.send(number));
        }
        // Now and then both sides come to rest.
        if dice >> 28 == 0 {
            automation.read_up_to(2 * number);
        }
    }
    automation.read_up_to(2_000);
    counted(&automation.heard, 0, 2_000);
    counted(&simulation.taken_up_to(1_000), 1, 1_000);
    assert_eq!(simulation.end(automation).messages_lost, 0);
}

#[test]
fn what_a_full_socket_cannot_take_waits_and_nothing_is_lost() {
    let listener = listen();
    let simulation = Simulation::start(&listener);
    let mut automation = Automation::accept(&listener);
    // Three megabytes of messages that nobody reads, more than socket and transport hold.
    simulation.count_to(60_000);
    simulation.wait_for(60_000);
    automation.read_up_to(60_000);
    counted(&automation.heard, 0, 60_000);
    // And the other way: the simulation takes one a step.
    (1..=20_000).for_each(|number| automation.send(number));
    counted(&simulation.taken_up_to(20_000), 1, 20_000);
    assert_eq!(simulation.end(automation).messages_lost, 0);
}

#[test]
fn past_the_bound_the_loss_is_counted_the_connection_closed_and_the_next_begins_with_the_present_value() {
    let listener = listen();
    let simulation = Simulation::start(&listener);
    let mut slow = Automation::accept(&listener);
    simulation.count_to(400_000);
    simulation.wait_for(400_000);
    while slow.read() {}
    let last = *slow.heard.last().expect("numbers");
    counted(&slow.heard, 0, last);
    // A reader that is too slow for the second that a farewell has does not hear why.
    assert!(matches!(slow.closed, None | Some(1008)), "{:?}", slow.closed);
    assert!(last < 400_000, "it cannot have been kept: {last}");
    let mut automation = Automation::accept(&listener);
    simulation.count_to(401_000);
    automation.read_up_to(401_000);
    counted(&automation.heard, 400_000, 401_000);
    let lost = simulation.end(automation).messages_lost;
    assert!(lost > 0 && lost <= 400_000 - last as u64, "{lost} counted, {last} heard");
}

#[test]
fn what_changes_while_the_line_is_down_is_not_sent_later_the_present_value_is() {
    let listener = listen();
    let simulation = Simulation::start(&listener);
    let mut first = Automation::accept(&listener);
    simulation.count_to(100);
    first.read_up_to(100);
    counted(&first.heard, 0, 100);
    drop(first);
    simulation.count_to(200);
    simulation.wait_for(200);
    let mut second = Automation::accept(&listener);
    simulation.count_to(300);
    second.read_up_to(300);
    let begins = second.heard[0];
    assert!(begins >= 200, "{begins}: it was sent late");
    counted(&second.heard, begins, 300);
    (1..=100).for_each(|number| second.send(number));
    counted(&simulation.taken_up_to(100), 1, 100);
    assert_eq!(simulation.end(second).messages_lost, 0, "what is not kept by promise is not lost");
}

#[test]
fn a_client_has_one_socket() {
    let listener = listen();
    let simulation = Simulation::start(&listener);
    let mut automation = Automation::accept(&listener);
    simulation.count_to(1_000);
    automation.read_up_to(1_000);
    (1..=1_000).for_each(|number| automation.send(number));
    simulation.taken_up_to(1_000);
    listener.set_nonblocking(true).expect("a listener that does not wait");
    let another = listener.accept().map(|_| ()).map_err(|error| error.kind());
    assert_eq!(another, Err(std::io::ErrorKind::WouldBlock), "all of it went over the first");
    simulation.end(automation);
}
