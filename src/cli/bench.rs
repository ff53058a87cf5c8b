//! `kinetwin bench`.

use std::path::Path;

use super::arguments::{BenchCommand, LatencyArguments, LoadArguments};
use super::words;
use super::{Answer, Failure};
use crate::bench::latency::{self, Effort, Table};
use crate::bench::load::{self, Demand, Held};
use crate::bench::{BenchError, Measured, blocks, devices};

/// Measures what is asked for.
pub fn bench(command: &BenchCommand) -> Result<Answer, Failure> {
    match command {
        BenchCommand::Latency(arguments) => latency(arguments),
        BenchCommand::Load(arguments) => load(arguments),
        BenchCommand::Plant { blocks, output } => written(blocks::plant_xml(*blocks as usize), output.as_deref()),
        BenchCommand::Devices { devices, output } => written(devices::plant_xml(*devices as usize), output.as_deref()),
    }
}

impl From<BenchError> for Failure {
    fn from(error: BenchError) -> Failure {
        Failure::of(&error)
    }
}

fn answer(yes: bool) -> Answer {
    if yes { Answer::Yes } else { Answer::No }
}

fn latency(arguments: &LatencyArguments) -> Result<Answer, Failure> {
    let effort = Effort { rounds: arguments.rounds as usize, ..Effort::FULL };
    let table = latency::measure(effort, &arguments.only, |what| words::tell(what))?;
    if arguments.json {
        words::answer_line(serde_json::to_string(&table)?)?;
    } else {
        words::answer(table_text(&table))?;
    }
    Ok(answer(table.meets_all()))
}

fn table_text(table: &Table) -> String {
    let mut text = format!("{:<52} {:>6} {:>9} {:>9} {:>9} {:>9}\n", "µs", "bytes", "p50", "p99", "p99.9", "max");
    table.rows.iter().for_each(|row| text.push_str(&row_text(row)));
    text.push('\n');
    for goal in &table.goals {
        let met = if goal.met { "met   " } else { "MISSED" };
        text.push_str(&format!("{met} {:>8} (at most {}): {}\n", goal.found, goal.at_most, goal.what));
    }
    if !table.on_one_core {
        text.push_str("the ends of round trips were not kept on one core: the system does not let one choose\n");
    }
    table.absent.iter().for_each(|peer| text.push_str(&format!("left out, not installed: {peer}\n")));
    text
}

fn row_text(row: &Measured) -> String {
    let Measured { name, bytes, p50_us, p99_us, p999_us, max_us, .. } = row;
    format!("{name:<52} {bytes:>6} {p50_us:>9.1} {p99_us:>9.1} {p999_us:>9.1} {max_us:>9.1}\n")
}

fn load(arguments: &LoadArguments) -> Result<Answer, Failure> {
    let LoadArguments { blocks, cycle, duration, step, realtime, limit, json } = arguments;
    let step = step.unwrap_or((*cycle / 10).min(crate::run::Options::STEP));
    let demand = Demand { blocks: *blocks as usize, cycle: *cycle, duration: *duration, step, realtime: *realtime };
    if *limit {
        let found = load::limit(demand, |held| words::tell(held_line(held)))?;
        if *json {
            words::answer_line(serde_json::json!({ "cycle_ms": cycle.as_secs_f64() * 1e3, "blocks": found }))?;
        } else {
            words::answer_line(format_args!("{found} blocks every {} ms", cycle.as_secs_f64() * 1e3))?;
        }
        return Ok(Answer::Yes);
    }
    let held = load::hold(demand)?;
    if *json {
        words::answer_line(serde_json::to_string(&held)?)?;
    } else {
        words::answer(held_text(&held))?;
    }
    Ok(answer(held.is_held()))
}

fn held_line(held: &Held) -> String {
    let Held { blocks, cycle_ms, cycles, missed, missed_by_system, lost, answer, .. } = held;
    let p99 = answer.p99_us;
    format!(
        "{blocks} blocks every {cycle_ms} ms: {cycles} cycles, {missed} missed ({missed_by_system} by the system), {lost} lost; \
         answer p99 {p99} us"
    )
}

fn held_text(held: &Held) -> String {
    let share = |share: Option<f64>| share.map_or("unknown".to_owned(), |share| format!("{:.1} %", share * 100.0));
    let us = |us: Option<f64>| us.map_or("-".to_owned(), |us| us.to_string());
    let step = |what: &str, step: &crate::run::Quantiles| {
        let [p50, p99, p999, max] = [step.p50, step.p99, step.p999, step.max].map(us);
        format!("  step, {what:<12} p50 {p50}, p99 {p99}, p99.9 {p999}, max {max} us\n")
    };
    let quantiles = |what: &str, row: &Measured| {
        let Measured { p50_us, p99_us, p999_us, max_us, .. } = row;
        format!("  {what:<18} p50 {p50_us}, p99 {p99_us}, p99.9 {p999_us}, max {max_us} us\n")
    };
    let mut text = format!("{}\n", held_line(held));
    text.push_str(&format!("  signals            {}\n", held.signals));
    text.push_str(&quantiles("answer", &held.answer));
    text.push_str(&quantiles("a bare thread late", &held.bare_thread));
    text.push_str(&step("no command", &held.step_idle_us));
    text.push_str(&step("under load", &held.step_load_us));
    text.push_str(&format!("  steps              {} late, {} overruns\n", held.late_steps, held.overruns));
    text.push_str(&format!(
        "  of one core        {} IO, {} simulation\n",
        share(held.io_cpu),
        share(held.simulation_cpu)
    ));
    if let (Some(memory), Some(growth)) = (held.memory, held.memory_growth) {
        let mib = |bytes: f64| bytes / f64::from(1 << 20);
        let (all, grown) = (mib(memory as f64), mib(growth as f64));
        text.push_str(&format!("  memory             {all:.1} MiB, {grown:+.1} MiB since the session stood\n"));
    }
    text
}

fn written(text: String, output: Option<&Path>) -> Result<Answer, Failure> {
    match output {
        None => words::answer(text)?,
        Some(path) => std::fs::write(path, text)
            .map_err(|error| Failure(format!("error: failed to write {}: {error}", path.display())))?,
    }
    Ok(Answer::Yes)
}
