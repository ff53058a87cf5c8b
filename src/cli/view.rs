//! `kinetwin view`, and `kinetwin run --view`: the page in the browser.

use std::net::{IpAddr, Ipv4Addr, SocketAddr, ToSocketAddrs};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use clap::Args;
use crossbeam::channel::RecvTimeoutError;

use super::replay::open;
use super::run::say;
use super::signals::Interruption;
use super::{Answer, Failure, words};
use crate::plant::Plant;
use crate::replay::{Seen, Survey};
use crate::run::{self, Handle, Options, Stop, Summary, model};
use crate::scene::Scene;
use crate::trace::{Reader, TraceError};
use crate::view::live::Live;
use crate::view::{self, Baked, Listening, Playback, ReportFiles, Stage, Told};

/// Plays a recorded trace in the browser.
///
/// The page shows the plant as the trace's commands move the model, with a time bar: at any speed, backwards too. With
/// --ghost a second trace is laid over it: measured against simulated. With --report the devices are coloured by their
/// shares of the gap that a diagnosis found, and a click opens the plots.
///
/// Of a trace whose source is a machine (`source: plant`), signals, the joints that they tell of and light barriers are shown
/// as they were measured. With --simulated that is so of any trace, and what the model does under the same commands is laid
/// over it.
#[derive(Debug, Args)]
#[command(after_long_help = VIEW_HELP)]
pub struct ViewArguments {
    /// The trace: *.cps.jsonl, or compressed *.cps.jsonl.zst
    pub trace: PathBuf,
    /// The plant: a folder with a plant.xml, a plant's file, or a name of the catalogue (models/rig)
    #[arg(long, value_name = "MODEL")]
    pub model: String,
    /// A second trace of the same plant, laid over the first
    #[arg(long, value_name = "TRACE")]
    pub ghost: Option<PathBuf>,
    /// Lay what the model does under the trace's commands over what a machine measured
    #[arg(long, conflicts_with = "ghost")]
    pub simulated: bool,
    /// A report.json of `kinetwin gap diagnose`; its report.html is opened from beside it
    #[arg(long, value_name = "FILE")]
    pub report: Option<PathBuf>,
    /// Where to listen: PORT, or HOST:PORT; port 0 takes a free one
    #[arg(long, value_name = "ADDR", value_parser = parse_address, default_value = "127.0.0.1:0")]
    pub listen: SocketAddr,
}

const VIEW_HELP: &str = "\
Examples:
  kinetwin view session.cps.jsonl.zst --model models/depalletizer
  kinetwin view machine.cps.jsonl --model models/rig --simulated
  kinetwin view one.cps.jsonl --model models/rig --ghost other.cps.jsonl
  kinetwin view machine.cps.jsonl --model models/rig --report diagnosis/report.json

The address of the page is printed on standard output. Ctrl-C ends it.

Exit codes:
  0  it was served until Ctrl-C
  2  the trace, the model or the report cannot be read, or the port is taken";

/// Reads where to listen: `8100`, `:8100`, `127.0.0.1:8100`, `[::1]:8100`, `localhost:8100`.
pub fn parse_address(text: &str) -> Result<SocketAddr, String> {
    let expected = || "expected PORT or HOST:PORT, as 8100 or 127.0.0.1:8100".to_owned();
    if let Ok(port) = text.trim_start_matches(':').parse::<u16>() {
        return Ok(SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), port));
    }
    if let Ok(ip) = text.parse::<IpAddr>() {
        return Ok(SocketAddr::new(ip, 0));
    }
    let mut found = text.to_socket_addrs().map_err(|_| expected())?;
    found.next().ok_or_else(expected)
}

/// The token for those who write from another machine: from the environment, else one is made up.
fn token() -> Option<String> {
    std::env::var("KINETWIN_VIEW_TOKEN").ok().map(|token| token.trim().to_owned()).filter(|token| !token.is_empty())
}

fn listen(address: SocketAddr) -> Result<Listening, Failure> {
    view::listen(address, token()).map_err(|error| Failure::of(&error))
}

/// Plays a trace until Ctrl-C.
pub fn view(arguments: &ViewArguments) -> Result<Answer, Failure> {
    let listening = listen(arguments.listen)?;
    let plant = Arc::new(model::load(&arguments.model)?);
    let report = match &arguments.report {
        Some(path) => Some(ReportFiles::read(path).map_err(|error| Failure::of(&error))?),
        None => None,
    };
    let scene = Arc::new(Scene::of(&plant));
    let trace = bake(&arguments.trace, arguments.simulated.then_some(Seen::Recorded), &plant, &scene)?;
    let ghost = match &arguments.ghost {
        Some(path) => Some(bake(path, None, &plant, &scene)?),
        None if arguments.simulated => {
            Some(bake(&arguments.trace, Some(Seen::Model), &plant, &scene)?.called("the model"))
        }
        None => None,
    };
    let url = listening.url();
    let stage = Stage::playback(&arguments.model, plant, Playback::new(scene, trace, ghost), report);
    let stop = Stop::default();
    let _interruption = Interruption::watch(stop.clone())?;
    let _server = view::serve(listening, stage).map_err(|error| Failure::of(&error))?;
    words::answer_line(format_args!("view: {url}"))?;
    while !stop.is_asked() {
        std::thread::sleep(LOOK);
    }
    Ok(Answer::Yes)
}

/// Replays a trace once, so that any instant of it can be shown; who is seen, its source decides where `seen` does not.
fn bake(path: &Path, seen: Option<Seen>, plant: &Plant, scene: &Arc<Scene>) -> Result<Baked, Failure> {
    let survey = Survey::of(&plant.signal_map, open(path)?).map_err(|error| Failure::of(&error))?;
    let header = survey.header();
    let seen = seen.unwrap_or(Seen::by_default(header.source));
    if header.model_hash.as_deref().is_some_and(|hash| hash != model::hash(plant)) {
        let recorded = header.model.as_deref().unwrap_or("another model");
        words::tell(format_args!(
            "warning: {} was recorded with {recorded} in another state than the model has now",
            path.display()
        ));
    }
    let step = header.step_ns.map_or(Options::STEP, Duration::from_nanos);
    let mut engine = model::engine(plant, step, header.seed.unwrap_or_default())?;
    engine.show(plant, Arc::clone(scene));
    let name = path.display().to_string();
    let reopen = || -> Result<_, TraceError> {
        let read = |source| TraceError::Read { file: name.clone(), source };
        let file = std::fs::File::open(path).map_err(read)?;
        Reader::new(name.clone(), std::io::BufReader::with_capacity(1 << 16, file))
    };
    Baked::of(&name, seen, &mut engine, (plant, scene), reopen).map_err(|error| Failure::of(&error))
}

/// How often it is looked whether somebody wants an end.
const LOOK: Duration = Duration::from_millis(50);

/// Runs a model with the page on it, until its end. A reset ends one run and begins another.
pub fn run_viewed(options: &Options, address: SocketAddr, json: bool) -> Result<Summary, Failure> {
    let listening = listen(address)?;
    let url = listening.url();
    let mut options = Options { controlled: true, ..options.clone() };
    let quit = Stop::default();
    let _interruption = Interruption::watch(quit.clone())?;
    let mut handle = run::start(&options)?;
    let told = Arc::new(Told::default());
    let live = Live::new(&handle, options.record.as_ref().map(|record| record.path.clone()));
    let Some(steering) = handle.steering() else { unreachable!("its options ask for control") };
    let stage = Stage::live(live.clone(), steering.scene, Arc::clone(&told));
    let _server = view::serve(listening, stage).map_err(|error| Failure::of(&error))?;
    match json {
        true => words::tell(format_args!("view: {url}")),
        false => words::answer_line(format_args!("view: {url}"))?,
    }
    loop {
        attend(&handle, &live, &told, &quit);
        let summary = handle.finish()?;
        let again = live.ended() && !quit.is_asked();
        if !again {
            return Ok(summary);
        }
        words::tell("the run begins anew");
        // What was recorded is a whole run; the next is another.
        options.record = None;
        handle = run::start(&options)?;
        live.install(&handle);
    }
}

/// Hears what a run tells until it ends, and ends it when somebody asks.
fn attend(handle: &Handle, live: &Live, told: &Told, quit: &Stop) {
    loop {
        match handle.notices().recv_timeout(LOOK) {
            Ok(notice) => {
                say(&notice);
                told.note(notice);
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return,
        }
        if let Some(exchange) = handle.exchange() {
            live.note_exchange(exchange);
        }
        if quit.is_asked() {
            handle.stopper().stop();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_as_people_write_them() {
        let check = |text: &str, address: &str| assert_eq!(parse_address(text).expect(text).to_string(), address);
        check("8100", "127.0.0.1:8100");
        check(":8100", "127.0.0.1:8100");
        check("0.0.0.0:80", "0.0.0.0:80");
        check("[::1]:8100", "[::1]:8100");
        check("192.168.0.7", "192.168.0.7:0");
        for text in ["", "x", "127.0.0.1:99999", "localhost"] {
            assert!(parse_address(text).is_err(), "{text}");
        }
    }
}
