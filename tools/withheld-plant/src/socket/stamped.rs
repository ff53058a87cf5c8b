//! A TCP stream that knows when what it reads had arrived.
//!
//! A thread gets to a message some time after it is there: 0.1 ms, and now and then milliseconds, when the system has other things
//! to do. An axis that is told to turn round a millisecond late is elsewhere for ever after. Linux notes the instant at which a
//! packet arrives (`SO_TIMESTAMPNS`, socket(7)), and goes by that, as a drive on a fieldbus would.

use std::io::{self, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

/// A stream whose reads are stamped.
pub struct Stamped {
    stream: TcpStream,
    arrived: Instant,
}

impl Stamped {
    /// Of `stream`, before anything has been read from it.
    pub fn new(stream: TcpStream) -> io::Result<Stamped> {
        ask(&stream)?;
        Ok(Stamped { stream, arrived: Instant::now() })
    }

    /// The stream itself.
    pub fn stream(&self) -> &TcpStream {
        &self.stream
    }

    /// When what was read last had arrived; where the system does not say, when it was read.
    pub fn arrived(&self) -> Instant {
        self.arrived
    }
}

impl Read for Stamped {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let (bytes, waited) = receive(&mut self.stream, buffer)?;
        let now = Instant::now();
        self.arrived = now.checked_sub(waited).unwrap_or(now);
        Ok(bytes)
    }
}

impl Write for Stamped {
    fn write(&mut self, buffer: &[u8]) -> io::Result<usize> {
        self.stream.write(buffer)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.stream.flush()
    }
}

/// Asks the system to note when packets arrive.
#[cfg(target_os = "linux")]
fn ask(stream: &TcpStream) -> io::Result<()> {
    use nix::sys::socket::{setsockopt, sockopt::ReceiveTimestampns};
    Ok(setsockopt(stream, ReceiveTimestampns, &true)?)
}

/// Reads, and says how long that has been there.
#[cfg(target_os = "linux")]
fn receive(stream: &mut TcpStream, buffer: &mut [u8]) -> io::Result<(usize, Duration)> {
    use std::os::fd::AsRawFd;
    use std::time::SystemTime;

    use nix::sys::socket::{ControlMessageOwned, MsgFlags, recvmsg};
    use nix::sys::time::TimeSpec;

    let mut space = nix::cmsg_space!(TimeSpec);
    let mut parts = [io::IoSliceMut::new(buffer)];
    let received = recvmsg::<()>(stream.as_raw_fd(), &mut parts, Some(&mut space), MsgFlags::empty())?;
    let stamp = received.cmsgs()?.find_map(|message| match message {
        ControlMessageOwned::ScmTimestampns(at) => Some(Duration::from(at)),
        _ => None,
    });
    let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
    let waited = stamp.and_then(|at| now.checked_sub(at)).unwrap_or_default();
    Ok((received.bytes, waited))
}

#[cfg(not(target_os = "linux"))]
fn ask(_: &TcpStream) -> io::Result<()> {
    Ok(())
}

#[cfg(not(target_os = "linux"))]
fn receive(stream: &mut TcpStream, buffer: &mut [u8]) -> io::Result<(usize, Duration)> {
    Ok((stream.read(buffer)?, Duration::ZERO))
}
