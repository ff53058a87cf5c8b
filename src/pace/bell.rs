//! How the simulation thread wakes the IO thread without either ever waiting for the other.
//!
//! A bell is a pair of connected sockets within the process, both non-blocking. To ring is to write one byte: a system
//! call that returns at once whatever the other side does. Where the socket's buffer is full, it holds bytes not yet
//! read, and a wake-up is under way already: nothing is lost by not writing another. There is no lock and no flag of
//! ours; a waker of the runtime, which would do the same in the end, hands the task over through the runtime's own
//! queue, and that queue has a lock.
//!
//! # Why no ring is missed
//!
//! The simulation publishes, then rings. The IO thread empties the socket, then looks into the bank. A byte written after
//! it emptied the socket makes the socket readable again, and it comes back; one written before belongs to a publication
//! that the system calls themselves order before its look.

use std::io;
use std::io::{ErrorKind, Write};
use std::task::{Context, Poll};

#[cfg(unix)]
use std::os::unix::net::UnixStream as Wire;
#[cfg(unix)]
use tokio::net::UnixStream as HeardWire;

#[cfg(not(unix))]
use std::net::TcpStream as Wire;
#[cfg(not(unix))]
use tokio::net::TcpStream as HeardWire;

/// The end that rings; the simulation thread's.
#[derive(Debug)]
pub struct Bell {
    stream: Wire,
}

/// The end that hears; the IO thread's.
#[derive(Debug)]
pub struct Listener {
    stream: Wire,
}

/// A [`Listener`] on the runtime that it is heard on.
#[derive(Debug)]
pub struct Ears {
    stream: HeardWire,
}

/// Two connected sockets.
#[cfg(unix)]
fn pair() -> io::Result<(Wire, Wire)> {
    Wire::pair()
}

/// Two connected sockets, on the loopback interface where the system has no others.
#[cfg(not(unix))]
fn pair() -> io::Result<(Wire, Wire)> {
    let listener = std::net::TcpListener::bind(("127.0.0.1", 0))?;
    let near = Wire::connect(listener.local_addr()?)?;
    let own = near.local_addr()?;
    // Somebody else may have found the port in the meantime.
    let far = loop {
        let (far, peer) = listener.accept()?;
        if peer == own {
            break far;
        }
    };
    near.set_nodelay(true)?;
    Ok((near, far))
}

/// A bell and its listener. Fails where the process may open no more files.
pub fn bell() -> io::Result<(Bell, Listener)> {
    let (near, far) = pair()?;
    near.set_nonblocking(true)?;
    far.set_nonblocking(true)?;
    Ok((Bell { stream: near }, Listener { stream: far }))
}

impl Bell {
    /// Wakes the other side. Never waits; does nothing once the other side is gone.
    pub fn ring(&mut self) {
        // Full: a wake-up is under way. Broken: nobody is left to wake.
        let _ = self.stream.write(&[1]);
    }
}

impl Listener {
    /// Registers with the tokio runtime that the caller runs on.
    pub fn listen(self) -> io::Result<Ears> {
        Ok(Ears { stream: HeardWire::from_std(self.stream)? })
    }
}

impl Ears {
    /// Takes all rings so far, and leaves `cx`'s waker for the next. Whether there was one.
    ///
    /// # Errors
    /// The bell is gone, whatever it rang before: look into the bank once more, nothing will come after that.
    pub fn hear(&mut self, cx: &mut Context<'_>) -> io::Result<bool> {
        let mut heard = false;
        let mut bytes = [0; 256];
        loop {
            match self.stream.try_read(&mut bytes) {
                Ok(0) => return Err(ErrorKind::BrokenPipe.into()),
                Ok(_) => heard = true,
                Err(error) if error.kind() == ErrorKind::WouldBlock => match self.stream.poll_read_ready(cx) {
                    Poll::Pending => return Ok(heard),
                    Poll::Ready(ready) => ready?,
                },
                Err(error) => return Err(error),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::future::poll_fn;

    fn on_a_runtime<F: Future>(test: F) -> F::Output {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_io().build();
        runtime.expect("a runtime").block_on(test)
    }

    async fn next_ring(ears: &mut Ears) -> io::Result<()> {
        poll_fn(|cx| match ears.hear(cx) {
            Ok(true) => Poll::Ready(Ok(())),
            Ok(false) => Poll::Pending,
            Err(error) => Poll::Ready(Err(error)),
        })
        .await
    }

    #[test]
    fn a_ring_from_another_thread_is_heard() {
        on_a_runtime(async {
            let (mut bell, listener) = bell().expect("a bell");
            let mut ears = listener.listen().expect("ears");
            let ringer = std::thread::spawn(move || {
                bell.ring();
                bell
            });
            next_ring(&mut ears).await.expect("a ring");
            drop(ringer.join().expect("the ringer"));
            assert!(next_ring(&mut ears).await.is_err(), "the bell is gone");
        });
    }

    #[test]
    fn a_million_rings_unheard_do_not_block() {
        on_a_runtime(async {
            let (mut bell, listener) = bell().expect("a bell");
            for _ in 0..1_000_000 {
                bell.ring();
            }
            let mut ears = listener.listen().expect("ears");
            next_ring(&mut ears).await.expect("a ring");
            bell.ring();
            next_ring(&mut ears).await.expect("another");
        });
    }
}
