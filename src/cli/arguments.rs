//! The words of the command line.

#[cfg(feature = "view")]
use std::net::SocketAddr;
use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, Parser, Subcommand};

use super::apply::ApplyArguments;
use super::diagnose::DiagnoseArguments;
use super::exam::ExamArguments;
use super::experiment::ExperimentArguments;
use super::locate::LocateArguments;
use super::table::{ExportArguments, ImportArguments};
#[cfg(feature = "view")]
use super::view::{ViewArguments, parse_address};
use crate::adapter::ParseEndpointError;
use crate::run::{Connect, Speed};
use crate::time::parse_duration;
use crate::wire::SignalSelection;

/// Virtual commissioning of IEC 61499 automations: a plant's model runs in real time against its automation.
#[derive(Debug, Parser)]
#[command(version, about, long_about = LONG_ABOUT, after_long_help = AFTER_HELP, max_term_width = 100)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Option<Command>,
}

const LONG_ABOUT: &str = "\
kinetwin is the machine until the machine stands: it runs a plant's model in real time and exchanges every signal with \
an IEC 61499 automation over the CPS-Protocol, on a WebSocket. To the automation, the model is the plant.

Without a command it does its main job on what it carries with it: it starts an automation in the same process, runs the \
de-palletization line against it for 20 s over a real WebSocket, and ends with a summary \
(kinetwin run models/depalletizer --for 20s).";

const AFTER_HELP: &str = "\
Durations are written with their unit: 20s, 500ms, 1.5s, 2m.

Environment:
  KINETWIN_VIEW_TOKEN  what writing to a page beyond this machine needs; made up and printed where it is not set
  KINETWIN_LOG    what is logged on standard error: automation=info, or debug for all of it; warnings alone by default
  KINETWIN_TOKEN  a bearer token for the server, where --token-file names none
  NO_COLOR        set to anything, neither the screen nor an error is coloured

Exit codes:
  0  the command did what was asked
  1  the answer is no: a check found a mismatch, a comparison differs, a run never had a session
  2  bad input or use, and nothing was started; or server and run do not accept each other's certificate or token";

#[derive(Debug, Subcommand)]
pub enum Command {
    Run(RunArguments),
    Check(CheckArguments),
    SignalsMap(SignalsMapArguments),
    Replay(ReplayArguments),
    #[cfg(feature = "view")]
    View(ViewArguments),
    /// Looks into recorded traces, cuts them, and makes them from tables and tables from them
    Trace {
        #[command(subcommand)]
        command: TraceCommand,
    },
    /// Diagnoses the gap between a model and its machine, and closes it
    Gap {
        #[command(subcommand)]
        command: GapCommand,
    },
    /// What the channel costs, measured now beside its peers; and the load of 200 blocks held
    Bench {
        #[command(subcommand)]
        command: BenchCommand,
    },
}

#[derive(Debug, Subcommand)]
pub enum BenchCommand {
    Latency(LatencyArguments),
    Load(LoadArguments),
    /// Writes the plant's file of so many blocks, as models/r001 has it
    Plant {
        #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..=100_000))]
        blocks: u32,
        /// Writes it to a file instead of standard output
        #[arg(short, long, value_name = "FILE")]
        output: Option<PathBuf>,
    },
    /// Writes the plant's file of so many devices that stand still: 2000 have about two million triangles
    Devices {
        #[arg(long, value_name = "N", default_value_t = 2000, value_parser = clap::value_parser!(u32).range(1..=100_000))]
        devices: u32,
        /// Writes it to a file instead of standard output
        #[arg(short, long, value_name = "FILE")]
        output: Option<PathBuf>,
    },
}

/// Measures the table of docs/performance.md: round trips of kinetwin and of its peers, in turns.
///
/// Peers are a raw TCP echo, a bare tokio-tungstenite echo, the same loop with serde_json, Modbus TCP, and where they are
/// installed mosquitto (MQTT) and Python's asyncua (OPC UA; KINETWIN_PYTHON names another Python). Quantiles are corrected
/// for coordinated omission. Both ends of a round trip run on one core, where the system lets one choose; whole runs on all.
/// Takes about two minutes; leave the machine alone meanwhile.
#[derive(Debug, Args)]
#[command(after_long_help = LATENCY_HELP)]
pub struct LatencyArguments {
    /// How often the rows take turns
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub rounds: u32,
    /// Measures only the rows whose name contains this, to look at them under a profiler
    #[arg(long, value_name = "TEXT", default_value = "")]
    pub only: String,
    /// Prints the table as one JSON object on standard output, and nothing else there
    #[arg(long)]
    pub json: bool,
}

const LATENCY_HELP: &str = "\
Exit codes:
  0  every goal is met
  1  some are missed; each is named
  2  something could not be measured";

/// Holds the load of requirement R001: every block is set every cycle, and every answer is counted.
///
/// A run in this process, on the wall clock, over a real WebSocket; first some seconds without a command, to compare the
/// step's computing time.
#[derive(Debug, Args)]
#[command(after_long_help = LOAD_HELP)]
pub struct LoadArguments {
    /// How many blocks, each with two commands and two reports
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..=20_000))]
    pub blocks: u32,
    /// How often every block is set
    #[arg(long, value_name = "TIME", value_parser = parse_duration, default_value = "10ms")]
    pub cycle: Duration,
    /// How long; with --limit, how long for each trial
    #[arg(long = "for", value_name = "TIME", value_parser = parse_duration, default_value = "10s")]
    pub duration: Duration,
    /// The engine's step of simulated time [default: a tenth of the cycle, at most 1ms]
    #[arg(long, value_name = "TIME", value_parser = parse_duration)]
    pub step: Option<Duration>,
    /// Asks the system to run simulation, exchange and the measuring threads before everything else (SCHED_FIFO)
    #[arg(long)]
    pub realtime: bool,
    /// Looks for the most blocks that can be held
    #[arg(long, conflicts_with = "blocks")]
    pub limit: bool,
    /// Prints the result as one JSON object on standard output, and nothing else there
    #[arg(long)]
    pub json: bool,
}

const LOAD_HELP: &str = "\
Examples:
  kinetwin bench load --for 10m
  kinetwin bench load --limit --cycle 1ms --for 3s

Exit codes:
  0  held: no cycle was missed that the operating system did not miss, and nothing was lost
  1  not held
  2  something could not be measured";

#[derive(Debug, Subcommand)]
pub enum GapCommand {
    Apply(ApplyArguments),
    Locate(LocateArguments),
    Diagnose(DiagnoseArguments),
    Plan(ExperimentArguments),
    Exam(ExamArguments),
}

#[derive(Debug, Subcommand)]
pub enum TraceCommand {
    Info(InfoArguments),
    Cut(CutArguments),
    Import(Box<ImportArguments>),
    Export(ExportArguments),
}

/// Runs a model against its automation.
///
/// The model's signals are exchanged over the CPS-Protocol with the server that --connect names, or with an automation
/// of our own in the same process. On a terminal one screen shows the plant and how the exchange goes; otherwise what
/// happens is told on standard error. The summary comes on standard output at the end. Ctrl-C ends the run in good order:
/// the session is closed, the summary is printed; a second Ctrl-C ends at once.
#[derive(Debug, Args)]
#[command(after_long_help = RUN_HELP)]
pub struct RunArguments {
    /// The plant: a folder with a plant.xml, a plant's file, or a name of the catalogue (models/rig)
    ///
    /// What is on the disk counts before what the program carries with it, whose names work from any folder.
    pub model: String,
    #[command(flatten)]
    pub connection: ConnectionArguments,
    /// How much simulated time to run, counted from the start of the process; without it, until Ctrl-C
    #[arg(long = "for", value_name = "TIME", value_parser = parse_duration)]
    pub duration: Option<Duration>,
    /// The engine's step of simulated time
    #[arg(long, value_name = "TIME", value_parser = parse_duration, default_value = "1ms")]
    pub step: Duration,
    /// Refresh interval of high-frequency levels [default: the plant's, else 20ms]
    #[arg(long, value_name = "TIME", value_parser = parse_duration)]
    pub hf: Option<Duration>,
    /// Refresh interval of low-frequency levels [default: the plant's, else 500ms]
    #[arg(long, value_name = "TIME", value_parser = parse_duration)]
    pub lf: Option<Duration>,
    /// Simulated seconds to a second of the wall clock, or max: as fast as possible
    ///
    /// With max, model and automation run in lock-step, and exactly: the automation's timers run on simulated time, and
    /// each step waits until the automation has handled what was sent. It needs the embedded automation.
    #[arg(long, value_name = "FACTOR|max", value_parser = parse_speed, default_value = "1.0")]
    pub speed: Speed,
    /// Asks the system to run simulation and exchange before everything else (SCHED_FIFO); a warning where it refuses
    ///
    /// Steps then begin on time on a machine that has other things to do. Linux permits it with the capability
    /// CAP_SYS_NICE or a limit on real-time priorities (ulimit -r).
    #[arg(long)]
    pub realtime: bool,
    /// The seed of all that is random in the plant: the same seed, the same parts
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub seed: u64,
    /// Asks the automation to send this signal, no faster than TIME where it is given, and no other; may be given several
    /// times
    ///
    /// A server that does not know this selection sends everything.
    #[arg(long, value_name = "SIGNAL[=TIME]", value_parser = parse_selection)]
    pub select: Vec<SignalSelection>,
    /// Records the session as a trace: JSON Lines, compressed where the name ends with .zst
    ///
    /// The trace is written beside FILE under a name that ends with .partial and takes its name when the run has ended.
    #[arg(long, value_name = "FILE")]
    pub record: Option<PathBuf>,
    /// Replaces the file of --record if there is one; without it, the run is refused
    #[arg(long, requires = "record")]
    pub force: bool,
    /// Shows the run in the browser: serves a page with the plant, its signals and controls, and prints its address
    ///
    /// ADDR is PORT or HOST:PORT; a free port of this machine's loopback interface where it is left out. Beyond the
    /// loopback interface, what changes something needs the token that is printed with the address, or KINETWIN_VIEW_TOKEN.
    #[cfg(feature = "view")]
    #[arg(long, value_name = "ADDR", num_args = 0..=1, require_equals = true, value_parser = parse_address)]
    pub view: Option<Option<SocketAddr>>,
    /// Ends the run with the first collision, with exit code 1
    ///
    /// Two collide that come to be more than 0.1 mm in one another: parts, and all solid bodies of the plant's shape.
    #[arg(long)]
    pub stop_on_collision: bool,
    /// Prints the summary as one JSON object on standard output, and nothing else there
    #[arg(long)]
    pub json: bool,
}

const RUN_HELP: &str = "\
Examples:
  kinetwin run models/rig --for 5s
  kinetwin run models/depalletizer --view
  kinetwin run models/depalletizer --connect ws://192.168.0.10:8080
  kinetwin run models/depalletizer --speed max --for 10m --seed 7 --json
  kinetwin run ./my-plant --record session.cps.jsonl.zst
  kinetwin run ./my-plant --connect wss://plc.example:8443 --ca plant-ca.pem --token-file token

A server that is absent or lost is tried again until the run ends, and simulated time goes on. It hears all present values \
first whenever a session stands.

Exit codes:
  0  the run came to its end, or to Ctrl-C
  1  the server never answered, or refused for good (5xx); with --stop-on-collision, there was one
  2  bad input or use; nothing was started";

/// Checks a model and its signals map, and with --connect an automation's interface against it.
///
/// The model is read as for a run, and the signals map that its plant's file names is compared with the one that follows
/// from the plant. With --connect the server is asked for its interface (QueryAll), which opens no session, and every
/// signal that is missing, superfluous, or of another type or direction is named.
#[derive(Debug, Args)]
#[command(after_long_help = CHECK_HELP)]
pub struct CheckArguments {
    /// The plant: a folder with a plant.xml, a plant's file, or a name of the catalogue (models/rig)
    pub model: String,
    #[command(flatten)]
    pub connection: ConnectionArguments,
    /// Prints the result as one JSON object on standard output, and nothing else there
    #[arg(long)]
    pub json: bool,
}

const CHECK_HELP: &str = "\
Examples:
  kinetwin check models/rig
  kinetwin check ./my-plant --connect ws://192.168.0.10:8080

Exit codes:
  0  all fits
  1  something does not; each mismatch is named
  2  the model cannot be read, or the server cannot be asked";

/// Writes the signals map that follows from a model.
///
/// The map lists every signal that model and automation exchange, with type, direction, kind, rate class, unit and range,
/// as XML. Without options it is printed.
#[derive(Debug, Args)]
#[command(after_long_help = SIGNALS_MAP_HELP)]
pub struct SignalsMapArguments {
    /// The plant: a folder with a plant.xml, a plant's file, or a name of the catalogue (models/rig)
    pub model: String,
    /// Writes the map to a file
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Compares a file with the map, and writes nothing
    #[arg(long, value_name = "FILE", conflicts_with = "output")]
    pub check: Option<PathBuf>,
}

const SIGNALS_MAP_HELP: &str = "\
Examples:
  kinetwin signals-map models/rig
  kinetwin signals-map ./my-plant -o signals-maps/my-plant.xml
  kinetwin signals-map models/rig --check signals-maps/rig.xml

Exit codes:
  0  the map was written, or the file is the map
  1  the file differs from the map; each difference is named
  2  the model or the file cannot be read";

/// Replays a recorded trace through a model and compares what the model reports with what was recorded.
///
/// The automation's side of the trace acts on the model at its recorded times. Levels are compared by their largest and
/// RMS difference, edges by time. A trace that kinetwin recorded replays with no difference.
#[derive(Debug, Args)]
#[command(after_long_help = REPLAY_HELP)]
pub struct ReplayArguments {
    /// The trace: *.cps.jsonl, or compressed *.cps.jsonl.zst
    pub trace: PathBuf,
    /// The plant: a folder with a plant.xml, a plant's file, or a name of the catalogue (models/rig)
    #[arg(long, value_name = "MODEL")]
    pub model: String,
    /// The most between a recorded edge and the model's
    #[arg(long, value_name = "TIME", value_parser = parse_duration, default_value = "0s")]
    pub edge_tolerance: Duration,
    /// The most between a recorded level and the model's, in the signal's unit
    #[arg(long, value_name = "NUMBER", value_parser = parse_tolerance, default_value = "0")]
    pub level_tolerance: f64,
    /// Prints the result as one JSON object on standard output, and nothing else there
    #[arg(long)]
    pub json: bool,
}

const REPLAY_HELP: &str = "\
Examples:
  kinetwin replay session.cps.jsonl.zst --model models/rig
  kinetwin replay machine.cps.jsonl --model ./my-plant --edge-tolerance 20ms --level-tolerance 0.001

The engine's step and seed are those of the recording, where it says them; else 1ms and 0.

Exit codes:
  0  the model reports what was recorded, within the tolerances
  1  some signals differ; each is named
  2  the trace or the model cannot be read";

/// Says what stands in a trace: its header, its times, its signals, and what it excites.
///
/// Of every signal: how many values it has from which side, how often one comes, and how it moves: its range, its highest
/// speed, how often it turns back, starts and stops. Spans in which the plant says nothing are listed. With --model, what
/// each device's signals hold, and which effects they could show at all: an effect is seen only where something excites it.
#[derive(Debug, Args)]
#[command(after_long_help = INFO_HELP)]
pub struct InfoArguments {
    /// The trace: *.cps.jsonl, or compressed *.cps.jsonl.zst
    pub trace: PathBuf,
    /// The plant: a folder with a plant.xml, a plant's file, or a name of the catalogue (models/rig)
    #[arg(long, value_name = "MODEL")]
    pub model: Option<String>,
    /// Prints the result as one JSON object on standard output, and nothing else there
    #[arg(long)]
    pub json: bool,
}

const INFO_HELP: &str = "\
Examples:
  kinetwin trace info session.cps.jsonl.zst
  kinetwin trace info arm.cps.jsonl --model models/servo-arm

Exit codes:
  0  the trace was read
  2  it cannot be read, or the model cannot";

/// Copies a span of a trace to a trace of its own.
///
/// Lines keep their times. The last value that each signal had before the span stands at its start, so that the cut knows
/// of every signal what the whole knew.
#[derive(Debug, Args)]
#[command(after_long_help = CUT_HELP)]
pub struct CutArguments {
    /// The trace: *.cps.jsonl, or compressed *.cps.jsonl.zst
    pub trace: PathBuf,
    /// The first instant to keep
    #[arg(long, value_name = "TIME", value_parser = parse_duration)]
    pub from: Duration,
    /// The last instant to keep
    #[arg(long, value_name = "TIME", value_parser = parse_duration)]
    pub to: Duration,
    /// How much before the span is kept too, so that a model can settle
    #[arg(long, value_name = "TIME", value_parser = parse_duration, default_value = "0s")]
    pub warm_up: Duration,
    /// The trace to write, compressed where its name ends with .zst
    #[arg(short, long, value_name = "TRACE")]
    pub output: PathBuf,
    /// Replaces the trace to write if there is one; without it, that is refused
    #[arg(long)]
    pub force: bool,
}

const CUT_HELP: &str = "\
Examples:
  kinetwin trace cut session.cps.jsonl --from 10s --to 30s -o middle.cps.jsonl
  kinetwin trace cut session.cps.jsonl.zst --from 1m --to 2m --warm-up 10s -o minute.cps.jsonl.zst";

/// How the automation is reached.
#[derive(Debug, Args)]
pub struct ConnectionArguments {
    /// The automation: ws://HOST:PORT, wss://HOST:PORT over TLS, or embedded for the one in this process [default: the plant's, else embedded]
    #[arg(long, value_name = "URL", value_parser = parse_connect)]
    pub connect: Option<Connect>,
    /// How long a connection may take to open, and an answer to come [default: the plant's, else 5s]
    #[arg(long, value_name = "TIME", value_parser = parse_duration)]
    pub timeout: Option<Duration>,
    /// The longest message taken in; a longer one closes the connection
    #[arg(long, value_name = "SIZE", value_parser = parse_size, default_value = "1MiB")]
    pub max_message: usize,
    /// The most values taken in one message; one with more is refused whole
    #[arg(long, value_name = "N", default_value_t = 65_536, value_parser = clap::value_parser!(u32).range(1..))]
    pub max_values: u32,
    /// The most messages taken in a second; more close the connection
    #[arg(long, value_name = "N", default_value_t = 100_000, value_parser = clap::value_parser!(u32).range(1..))]
    pub max_rate: u32,
    /// The authority that must have signed a wss:// server's certificate, PEM [default: those that the system trusts]
    #[arg(long, value_name = "FILE")]
    pub ca: Option<PathBuf>,
    /// Our own certificate, for a wss:// server that asks for one, PEM
    #[arg(long, value_name = "FILE", requires = "key")]
    pub cert: Option<PathBuf>,
    /// The private key of --cert, PEM, not encrypted
    #[arg(long, value_name = "FILE", requires = "cert")]
    pub key: Option<PathBuf>,
    /// A file with a bearer token for the server [or the environment variable KINETWIN_TOKEN]
    #[arg(long, value_name = "FILE")]
    pub token_file: Option<PathBuf>,
}

fn parse_connect(text: &str) -> Result<Connect, ParseEndpointError> {
    match text {
        "embedded" => Ok(Connect::Embedded),
        url => url.parse().map(Connect::Server),
    }
}

fn parse_selection(text: &str) -> Result<SignalSelection, String> {
    let (name, interval) = text.split_once('=').map_or((text, None), |(name, interval)| (name, Some(interval)));
    let min_interval = interval.map_or(Ok(Duration::ZERO), parse_duration).map_err(|error| error.to_string())?;
    match name {
        "" => Err("expected a signal's name, as Belt.velocityTarget or Belt.velocityTarget=100ms".to_owned()),
        name => Ok(SignalSelection { name: name.to_owned(), min_interval }),
    }
}

fn parse_speed(text: &str) -> Result<Speed, String> {
    match text {
        "max" => Ok(Speed::Max),
        number => match number.parse() {
            Ok(factor) if (0.01..=1000.0).contains(&factor) => Ok(Speed::Wall(factor)),
            _ => Err("expected a number from 0.01 to 1000, or max".to_owned()),
        },
    }
}

fn parse_tolerance(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| number.is_finite() && *number >= 0.0);
    number.ok_or_else(|| "expected a number, 0 or more".to_owned())
}

/// Reads a number of bytes: `1MiB`, `64KiB`, `2MB`, `4096`.
fn parse_size(text: &str) -> Result<usize, String> {
    let refuse = || "expected a number of bytes, as 1MiB, 64KiB, 2MB or 4096".to_owned();
    let digits = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    let (number, unit) = text.split_at(digits);
    let unit = match unit.trim_start() {
        "" | "B" => 1,
        "kB" | "KB" => 1000,
        "KiB" => 1 << 10,
        "MB" => 1_000_000,
        "MiB" => 1 << 20,
        "GB" => 1_000_000_000,
        "GiB" => 1 << 30,
        _ => return Err(refuse()),
    };
    number.parse::<usize>().ok().and_then(|number| number.checked_mul(unit)).ok_or_else(refuse)
}

impl RunArguments {
    /// The main job: what the program does without a command.
    pub fn main_job() -> RunArguments {
        match Arguments::parse_from(["kinetwin", "run", "models/depalletizer", "--for", "20s"]).command {
            Some(Command::Run(run)) => run,
            other => unreachable!("{other:?}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_arguments_fit_together() {
        Arguments::command().debug_assert();
        let job = RunArguments::main_job();
        assert_eq!((job.model.as_str(), job.duration), ("models/depalletizer", Some(Duration::from_secs(20))));
    }

    #[test]
    fn sizes_as_people_write_them() {
        let check = |text: &str, bytes: Option<usize>| assert_eq!(parse_size(text).ok(), bytes, "{text}");
        check("1MiB", Some(1 << 20));
        check("64 KiB", Some(64 << 10));
        check("2MB", Some(2_000_000));
        check("4096", Some(4096));
        for text in ["", "MiB", "-1", "1.5MiB", "1TiB", "99999999999999999999GiB"] {
            check(text, None);
        }
    }
}
