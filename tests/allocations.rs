//! A message of 400 values passes through the session without an allocation for each signal, both ways.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use kinetwin::session::{Client, ClientSettings, Input, Output, Server, ServerSettings};
use kinetwin::signal_map::{Direction, Kind, RateClass, Signal, SignalMap};
use kinetwin::time::Instant;
use kinetwin::value::{ElementaryType, SignalType, Unit, Value};

/// The system's allocator, counted.
struct Counting;

static COUNT: AtomicUsize = AtomicUsize::new(0);

// SAFETY: every call is the system allocator's, whose contract is the caller's.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.fetch_add(1, Ordering::Relaxed);
        // SAFETY: as above.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn allocations(work: impl FnOnce()) -> usize {
    let before = COUNT.load(Ordering::Relaxed);
    work();
    COUNT.load(Ordering::Relaxed) - before
}

const VALUES: usize = 400;

fn map() -> Arc<SignalMap> {
    let signal = |n: usize| Signal {
        name: format!("Conveyor{}.property{}", n / 8, n % 8),
        ty: SignalType::scalar([ElementaryType::Real, ElementaryType::Bool, ElementaryType::Dint][n % 3]),
        direction: Direction::Command,
        kind: Kind::Level,
        rate: RateClass::HighFrequency,
        unit: Unit::ONE,
        min: None,
        max: None,
        instance: format!("Conveyor{}", n / 8),
        task: "task".to_owned(),
        property: format!("property{}", n % 8),
    };
    Arc::new(SignalMap::new("allocations", (0..VALUES).map(signal).collect()).expect("names that differ"))
}

#[test]
fn a_message_of_400_values_is_written_and_read_without_an_allocation_for_each() {
    let map = map();
    let mut client = Client::new(ClientSettings::new("test"), Arc::clone(&map));
    let mut server = Server::new(ServerSettings::new("test"), Arc::clone(&map));
    client.handle(Instant::ZERO, Input::Opened);
    while let Some(output) = client.poll() {
        if let Output::Transmit(text) = output {
            server.handle(Instant::ZERO, Input::Text(&text));
        }
    }
    while let Some(output) = server.poll() {
        if let Output::Transmit(text) = output {
            client.handle(Instant::ZERO, Input::Text(&text));
        }
    }
    assert!(client.is_established() && server.is_established());
    let numbers = (1..).map(|n| f64::from(n) * 0.137);
    let signals = map.directed(Direction::Command).zip(numbers);
    let values: Vec<_> =
        signals.map(|((id, signal), number)| (id, Value::from_f64(signal.ty.element, number))).collect();

    let mut text = String::new();
    let written = allocations(|| {
        server.send(Instant::ZERO, &values);
        if let Some(Output::Transmit(sent)) = std::iter::from_fn(|| server.poll()).last() {
            text = sent;
        }
    });
    assert!(text.len() > 40 * VALUES, "{text}");
    let mut events = 0;
    let read = allocations(|| {
        client.handle(Instant::ZERO, Input::Text(&text));
        events = std::iter::from_fn(|| client.poll()).count();
    });
    assert!(events > 0);
    // A message's buffers may grow to their size a few times.
    assert!(written <= 20 && read <= 20, "{written} allocations to write {VALUES} values, {read} to read them");
}
