//! Over a real socket and in real time: a plant and its automation as two ends of a TCP connection of this machine.
//!
//! [`automation`] is the WebSocket server. It says the script's commands at their instants and records, by its own clock,
//! what it says and hears. [`client`] is the plant: it connects, runs as fast as time passes, takes commands when they
//! arrive, and reports in its cycle with all that its [`Surroundings`](crate::record::Surroundings) do to a report. The two
//! share nothing but the connection; each has a thread and a clock of its own.

mod automation;
mod client;
mod clock;
mod end;
mod error;
mod link;
pub mod pairs;
mod running;
mod stamped;
#[cfg(test)]
mod tests;
mod urgency;

use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::thread;

pub use clock::Lateness;
pub use error::SocketError;

use kinetwin::trace::Sender;

use crate::record::Said;
use crate::workbench::Take;

/// Which share of a reporting cycle a recording may be late: as much as the most that a report's stamp is.
const ALLOWED: f64 = 0.4;

/// By how much the way of a command may differ from that of most, s: a motor that is told to turn round 0.2 ms later than was
/// recorded has made another 6 counts of its encoder, and keeps them.
const UNSURE: f64 = 2e-4;

/// Of how many events that is asked. What a system with other things to do is now and then late is part of a recording.
const ASKED: f64 = 0.999;

/// A recording of the first `seconds` of `take`, made over a socket, and how late both ends were.
pub fn record(take: &Take, seconds: f64) -> Result<(Vec<Said>, Lateness), SocketError> {
    let Take { script, around, seed, .. } = take;
    let plant = take.plant();
    let open = |source| SocketError::Open { peer: "plant", source };
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).map_err(open)?;
    let address: SocketAddr = listener.local_addr().map_err(open)?;
    let (automation, plant) = thread::scope(|scope| {
        let plant = scope.spawn(|| {
            urgency::ask();
            client::run(address, plant, around, seconds, *seed)
        });
        let automation = scope.spawn(|| {
            urgency::ask();
            automation::run(&listener, script, seconds)
        });
        let automation = automation.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        (automation, plant.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
    });
    match (automation, plant) {
        (Ok((said, one)), Ok((arrived, two))) => {
            let commands = said.iter().filter(|said| said.from == Sender::Automation);
            let sent: Vec<f64> = commands.map(|said| said.at).collect();
            let mut lateness = one.and(two);
            lateness.note_ways(&sent, &arrived);
            Ok((said, lateness))
        }
        // The end that has a reason of its own tells more than the one that was left alone.
        (Err(error), Err(other)) if error.is_consequence() => Err(other),
        (Err(error), _) | (_, Err(error)) => Err(error),
    }
}

/// Refuses what was not in real time.
pub fn in_time(lateness: &Lateness, cycle: f64) -> Result<(), SocketError> {
    if lateness.unsure() > UNSURE {
        return Err(SocketError::Unsure { late: lateness.unsure(), allowed: UNSURE });
    }
    let (late, allowed) = (lateness.quantile(ASKED), ALLOWED * cycle);
    if late > allowed { Err(SocketError::Late { late, allowed }) } else { Ok(()) }
}
