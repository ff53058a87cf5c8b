//! A message of 400 values passes through the session without an allocation for each signal, both ways.

#[path = "../benches/wire/values.rs"]
mod values;

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering};

use kinetwin::session::{Input, Output};
use kinetwin::time::Instant;

use values::VALUES;

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

#[test]
fn a_message_of_400_values_is_written_and_read_without_an_allocation_for_each() {
    let map = values::map();
    let (mut client, mut server) = values::session(&map);
    let values = values::values(&map);

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
