//! `nxt-mock`: the automation of `kinetwin::automation` as a program of its own.

mod security;

use std::fmt::Write as _;
use std::io::{self, Write as _};
use std::net::{SocketAddr, ToSocketAddrs as _};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

use clap::{ArgAction, Parser};
use kinetwin::automation::fault::Fault;
use kinetwin::automation::program::{map_of, plants};
use kinetwin::automation::server::{ListenSettings, Server};
use kinetwin::automation::{Automation, Control, Faulty, Statistics, playback};
use kinetwin::signal_map::{SignalMap, xml};
use tracing_subscriber::EnvFilter;

/// A stand-in for an IEC 61499 runtime.
///
/// Listens for simulations, speaks the automation's half of the CPS-Protocol, and controls the plant by function blocks
/// that know it by its signals alone. Any number of simulations may connect: all receive the same commands; the inputs of
/// the one connected longest control. The program starts when the first one connects.
///
/// For a plant without function blocks of its own all commands are held at 0.
#[derive(Parser)]
#[command(name = "nxt-mock", version, override_usage = USAGE, after_long_help = EXAMPLES)]
struct Arguments {
    /// The plant to control, by its name: the name of a map under `signals-maps/`, as rig or depalletizer
    #[arg(long, value_name = "NAME", required_unless_present = "signals_map")]
    plant: Option<String>,

    /// The plant's signals map, for a plant that this program does not carry
    ///
    /// As `kinetwin signals-map MODEL -o FILE` writes it. The plant's name in it chooses the function blocks.
    #[arg(long, value_name = "FILE", conflicts_with = "plant")]
    signals_map: Option<PathBuf>,

    /// Where to listen; port 0 takes a free one
    #[arg(long, value_name = "ADDR", default_value = "127.0.0.1:61499")]
    listen: String,

    /// Speaks TLS (wss://) and shows this certificate, PEM
    #[arg(long, value_name = "FILE", requires = "key")]
    cert: Option<PathBuf>,

    /// The private key of --cert, PEM, not encrypted
    #[arg(long, value_name = "FILE", requires = "cert")]
    key: Option<PathBuf>,

    /// Lets in only who shows a certificate that this authority signed, PEM
    #[arg(long, value_name = "FILE", requires = "cert")]
    client_ca: Option<PathBuf>,

    /// Lets in only who shows the bearer token in this file
    #[arg(long, value_name = "FILE")]
    token_file: Option<PathBuf>,

    /// Plays the automation's side of a recorded trace instead of controlling
    ///
    /// Its commands leave word by word at their recorded times; time 0 is the moment at which the first simulation
    /// connects. What simulations report is ignored.
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,

    /// Misbehaves; may be given several times
    ///
    /// late:MS       everything leaves MS milliseconds later
    /// slow:MS       handling a message takes MS milliseconds
    /// wrong-type    every SendValue holds one more entry, of a wrong type
    /// unknown-name  every SendValue holds one more entry, of an unknown signal
    /// drop:S        every connection breaks off S seconds after it opened
    /// refuse:CODE   every Connect is refused with CODE (400 to 599)
    /// silent        connections are taken, and nothing is ever said
    /// garbage       every SendValue is followed by something that is no message
    /// huge          the first SendValue is followed by a message of 100 MB
    #[arg(long, value_name = "KIND", action = ArgAction::Append, verbatim_doc_comment)]
    fault: Vec<Fault>,

    /// Chooses what faults leave to chance
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,

    /// Logs nothing but warnings
    #[arg(long, short, conflicts_with = "verbose")]
    quiet: bool,

    /// Also logs what each device's function block sees
    #[arg(long, short)]
    verbose: bool,
}

const USAGE: &str =
    "nxt-mock --plant NAME [--listen ADDR] [--fault KIND]… [--trace FILE]\n       nxt-mock --signals-map FILE …";

const EXAMPLES: &str = "\
Output:
  The first line on standard output names the address. The log goes to standard
  error: time, function block, event, decision. Ctrl-C stops, and prints what
  went through.

Exit codes:
  0  stopped by Ctrl-C
  2  bad use: an unknown plant, an unreadable file, an address in use

Examples:
  Control the rig, and run it in another terminal:
    nxt-mock --plant rig
    kinetwin run models/rig --connect ws://127.0.0.1:61499 --for 20s

  A runtime on a bad day:
    nxt-mock --plant depalletizer --fault late:80 --fault drop:10

  Encrypted, for those alone who know the token:
    nxt-mock --plant rig --cert server.pem --key server.key --token-file token

  The commands of yesterday's session again:
    nxt-mock --plant rig --trace yesterday.cps.jsonl";

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), String> {
    log(arguments);
    let map = map(arguments)?;
    let plant = map.plant().to_owned();
    let control = match &arguments.trace {
        Some(path) => Control::Playback(playback::of_file(path.clone())),
        None => Control::ByPlant,
    };
    let automation = Automation::new(map, control).map_err(|error| error.to_string())?;
    let faulty = Faulty::new(automation, &arguments.fault, arguments.seed);
    let settings = ListenSettings {
        tls: security::tls(arguments)?,
        token: security::token(arguments)?,
        ..ListenSettings::new(address(&arguments.listen)?)
    };
    let scheme = if settings.tls.is_some() { "wss" } else { "ws" };
    // The signals are caught before anybody is told where to connect.
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
    let runtime = runtime.map_err(|error| format!("failed to wait for Ctrl-C: {error}"))?;
    let interrupted = runtime.block_on(async { interruption() })?;
    let server = Server::start(settings, faulty).map_err(|error| error.to_string())?;
    say(&format!("nxt-mock controls {plant:?} on {scheme}://{}\n", server.address()));
    runtime.block_on(interrupted);
    if let Some(statistics) = server.stop() {
        say(&summary(&statistics));
    }
    Ok(())
}

/// Writes to standard output; a reader that went away is no reason to stop.
fn say(text: &str) {
    let mut out = io::stdout().lock();
    let _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
}

/// Waits for Ctrl-C or, where there is such a thing, a polite request to terminate.
#[cfg(unix)]
fn interruption() -> Result<impl Future<Output = ()>, String> {
    use tokio::signal::unix::{SignalKind, signal};
    let caught = |kind| signal(kind).map_err(|error| format!("failed to wait for Ctrl-C: {error}"));
    let (mut interrupt, mut terminate) = (caught(SignalKind::interrupt())?, caught(SignalKind::terminate())?);
    Ok(async move {
        std::future::poll_fn(|cx| {
            if interrupt.poll_recv(cx).is_ready() || terminate.poll_recv(cx).is_ready() {
                std::task::Poll::Ready(())
            } else {
                std::task::Poll::Pending
            }
        })
        .await;
    })
}

/// Waits for Ctrl-C.
#[cfg(not(unix))]
fn interruption() -> Result<impl Future<Output = ()>, String> {
    Ok(async {
        let _ = tokio::signal::ctrl_c().await;
    })
}

fn log(arguments: &Arguments) {
    let level = match (arguments.quiet, arguments.verbose) {
        (true, _) => "warn",
        (_, true) => "debug",
        _ => "info",
    };
    let filter = EnvFilter::new(format!("warn,automation={level}"));
    let log = tracing_subscriber::fmt().with_env_filter(filter).with_writer(io::stderr);
    log.without_time().with_target(false).with_ansi(false).init();
}

fn map(arguments: &Arguments) -> Result<Arc<SignalMap>, String> {
    if let Some(path) = &arguments.signals_map {
        let name = path.display().to_string();
        let text = std::fs::read_to_string(path).map_err(|error| format!("failed to read {name}: {error}"))?;
        return xml::read(&name, &text).map(Arc::new).map_err(|error| error.to_string());
    }
    let given = arguments.plant.as_deref().unwrap_or_default();
    let name = given.trim_end_matches('/').trim_start_matches("models/");
    map_of(name).ok_or_else(|| {
        let known: Vec<&str> = plants().collect();
        format!(
            "{given:?} is no plant that nxt-mock carries: expected one of {}; for another plant give --signals-map FILE",
            known.join(", ")
        )
    })
}

fn address(text: &str) -> Result<SocketAddr, String> {
    let plain = text.trim_start_matches("ws://").trim_end_matches('/');
    let found = plain.to_socket_addrs().ok().and_then(|mut addresses| addresses.next());
    found.ok_or_else(|| format!("{text:?} is no address to listen on: expected HOST:PORT, as 127.0.0.1:61499"))
}

fn summary(statistics: &Statistics) -> String {
    let mut text = String::new();
    let Statistics { sessions_ever, messages_in, messages_out, values_in, refused, counts, .. } = statistics;
    // Writing to a String cannot fail.
    let _ = writeln!(text, "sessions    {sessions_ever}");
    let _ = writeln!(text, "messages    {messages_in} in, {messages_out} out");
    let _ = writeln!(text, "values      {values_in} in, {refused} of ours refused");
    let _ = writeln!(text, "parts       {} in, {} out, as the barriers saw them", counts.parts_in, counts.parts_out);
    let round_trip = &statistics.round_trip_ns;
    if !round_trip.is_empty() {
        let us = |quantile| round_trip.value_at_quantile(quantile) / 1_000;
        let (p50, p99, max) = (us(0.5), us(0.99), round_trip.max() / 1_000);
        let _ =
            writeln!(text, "round trip  p50 {p50} us, p99 {p99} us, max {max} us, of {} measured", round_trip.len());
    }
    text
}
