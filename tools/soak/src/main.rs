//! `soak`: a run of 200 blocks, for as long as asked, while the server is killed and restarted, the socket stalls, frames
//! are cut, the run itself is stopped for a while, and the disk that it records to is full.
//!
//! Loopback only, bounded in time, memory and disk. It ends with 1 where something was lost that the docs promise to keep,
//! where memory grows, or where anything panicked; what it did hangs on a seed.

mod dice;
mod disk;
mod memory;
mod process;
mod proxy;

use std::process::ExitCode;
use std::time::{Duration, Instant};

use clap::Parser;

use dice::Dice;
use memory::Memory;
use process::{Automation, Run};
use proxy::Proxy;

/// Holds the load of 200 blocks while everything around the channel breaks.
#[derive(Parser)]
#[command(name = "soak", version)]
struct Arguments {
    /// How many seconds
    #[arg(long, value_name = "S", default_value_t = 3600)]
    seconds: u64,
    /// Chooses the faults and when they come
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// The folder with the programs kinetwin and nxt-mock [default: this program's own]
    #[arg(long, value_name = "DIR")]
    programs: Option<std::path::PathBuf>,
}

fn main() -> ExitCode {
    match soak(&Arguments::parse()) {
        Ok(faults) if faults.is_empty() => {
            println!("held");
            ExitCode::SUCCESS
        }
        Ok(faults) => {
            faults.iter().for_each(|fault| println!("FAILED: {fault}"));
            ExitCode::from(1)
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

/// The pause between two faults, seconds.
const PAUSE_S: (u64, u64) = (4, 9);

fn soak(arguments: &Arguments) -> Result<Vec<String>, String> {
    let programs = match &arguments.programs {
        Some(folder) => folder.clone(),
        None => std::env::current_exe().map_err(|error| error.to_string())?.with_file_name(""),
    };
    let mut dice = Dice::new(arguments.seed);
    let mut automation = Automation::start(&programs, 0)?;
    let proxy = Proxy::start(automation.port)?;
    let disk = disk::small();
    let record = disk.as_ref().map(|disk| disk.file("trace.cps.jsonl"));
    if record.is_none() {
        println!("left out: a disk that fills (no right to mount one)");
    }
    let mut run = Run::start(&programs, proxy.port, None)?;
    // A second simulation at the same automation records until its disk is full, and must go on.
    let recording = record.map(|path| Run::start(&programs, proxy.port, Some(&path))).transpose()?;
    let mut memory = Memory::default();
    let mut faults = Vec::new();
    let (begun, mut next) = (Instant::now(), Duration::from_secs(3));
    let span = Duration::from_secs(arguments.seconds);
    let mut counts = std::collections::BTreeMap::<&str, u32>::new();
    while begun.elapsed() < span {
        std::thread::sleep(Duration::from_millis(500));
        if let Some(bytes) = run.memory() {
            memory.sample(begun.elapsed(), bytes);
        }
        if let Some(ended) = run.has_ended() {
            faults.push(format!("the run ended by itself after {} s: {ended}", begun.elapsed().as_secs()));
            break;
        }
        // The last seconds are quiet, so that all can be well again.
        if begun.elapsed() < next || begun.elapsed() + Duration::from_secs(10) > span {
            continue;
        }
        let what = match dice.roll(5) {
            0 => {
                automation.kill();
                std::thread::sleep(Duration::from_millis(200 + dice.roll(1_500)));
                automation = Automation::start(&programs, automation.port)?;
                "server killed and restarted"
            }
            1 => {
                // At this load a second and a half is what run and automation promise to keep for each other.
                proxy.stall(Duration::from_millis(200 + dice.roll(1_000)));
                "socket stalled"
            }
            2 => {
                proxy.cut();
                "frame cut in the middle"
            }
            3 => {
                // To the run, every clock steps.
                run.freeze(Duration::from_millis(100 + dice.roll(1_000)));
                "run stopped, and its clocks stepped"
            }
            _ => {
                proxy.dribble(Duration::from_millis(500 + dice.roll(1_500)));
                "bytes one at a time"
            }
        };
        *counts.entry(what).or_default() += 1;
        next = begun.elapsed() + Duration::from_secs(PAUSE_S.0 + dice.roll(PAUSE_S.1 - PAUSE_S.0));
    }
    for (what, times) in &counts {
        println!("{times:>4} times: {what}");
    }
    let ended = run.stop()?;
    println!("{}", ended.summary);
    println!("told of {} losses past what is kept", ended.losses_told());
    faults.extend(ended.faults(arguments.seconds));
    if let Some(recording) = recording {
        faults.extend(recording.stop()?.faults_of_a_full_disk());
    }
    let said = automation.stop();
    faults.extend(said.contains("panicked").then(|| format!("nxt-mock panicked: {said}")));
    match memory.slope() {
        None => println!("memory: too short to say"),
        Some(slope) => {
            println!("memory: {slope}");
            faults.extend(slope.grows().then(|| format!("memory grows: {slope}")));
        }
    }
    Ok(faults)
}
