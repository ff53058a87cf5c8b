//! The way between run and automation, which can be made bad.

use std::io::{Read as _, Write as _};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// Carries bytes between the run and the automation.
pub struct Proxy {
    pub port: u16,
    weather: Arc<Mutex<Weather>>,
}

/// What happens on the way.
struct Weather {
    stalled_until: Instant,
    dribbling_until: Instant,
    /// The next piece is cut in the middle, and its connection with it.
    cut: bool,
}

impl Proxy {
    /// To the automation at `server`.
    pub fn start(server: u16) -> Result<Proxy, String> {
        let listener = TcpListener::bind("127.0.0.1:0").map_err(|error| error.to_string())?;
        let port = listener.local_addr().map_err(|error| error.to_string())?.port();
        let now = Instant::now();
        let weather = Arc::new(Mutex::new(Weather { stalled_until: now, dribbling_until: now, cut: false }));
        let shared = Arc::clone(&weather);
        std::thread::spawn(move || {
            for client in listener.incoming().flatten() {
                // Nobody there: the client sees its connection close.
                let Ok(server) = TcpStream::connect(("127.0.0.1", server)) else { continue };
                let _ = (client.set_nodelay(true), server.set_nodelay(true));
                for (from, to) in [(&client, &server), (&server, &client)] {
                    if let (Ok(from), Ok(to)) = (from.try_clone(), to.try_clone()) {
                        let weather = Arc::clone(&shared);
                        std::thread::spawn(move || carry(from, to, &weather));
                    }
                }
            }
        });
        Ok(Proxy { port, weather })
    }

    fn change(&self, change: impl FnOnce(&mut Weather)) {
        if let Ok(mut weather) = self.weather.lock() {
            change(&mut weather);
        }
    }

    /// Nothing passes for `span`.
    pub fn stall(&self, span: Duration) {
        self.change(|weather| weather.stalled_until = Instant::now() + span);
    }

    /// For `span` the beginning of all that passes goes byte by byte: heads and first words in pieces, and yet as fast as before.
    pub fn dribble(&self, span: Duration) {
        self.change(|weather| weather.dribbling_until = Instant::now() + span);
    }

    /// The next frame breaks off in the middle.
    pub fn cut(&self) {
        self.change(|weather| weather.cut = true);
    }
}

/// So many bytes of a piece go one at a time.
const DRIBBLED: usize = 200;

fn carry(mut from: TcpStream, mut to: TcpStream, weather: &Mutex<Weather>) {
    let mut bytes = [0; 16 * 1024];
    while let Ok(count @ 1..) = from.read(&mut bytes) {
        let (stall, dribbles, cut) = match weather.lock() {
            Ok(mut weather) => {
                let now = Instant::now();
                let cut = std::mem::take(&mut weather.cut);
                (weather.stalled_until.saturating_duration_since(now), weather.dribbling_until > now, cut)
            }
            Err(_) => return,
        };
        std::thread::sleep(stall);
        let piece = if cut { &bytes[..count / 2] } else { &bytes[..count] };
        let sent = match dribbles {
            true => {
                let (first, rest) = piece.split_at(piece.len().min(DRIBBLED));
                first.chunks(1).try_for_each(|byte| to.write_all(byte)).and_then(|()| to.write_all(rest))
            }
            false => to.write_all(piece),
        };
        if sent.is_err() || cut {
            break;
        }
    }
    let _ = (from.shutdown(Shutdown::Both), to.shutdown(Shutdown::Both));
}
