//! `kinetwin gap exam`: how often the diagnosis is right about machines whose effect it does not know.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant, SystemTime};

use clap::Args;

use super::output::write_whole;
use super::{Answer, Failure, words};
use crate::exam::{self, Exam, Floor, Judged};
use crate::gap::report::Report;
use crate::run::date_and_time;

/// Diagnoses every case of an exam, then opens the sealed answers and scores.
///
/// Each case is diagnosed by a process of its own that is told nothing but the case's model and traces. When all have answered,
/// the hashes of all reports are written down, the answers are opened against them, and exam.json and exam.html are written.
/// From then on no report can change: the same command scores the same reports again.
#[derive(Debug, Args)]
#[command(after_long_help = HELP)]
pub struct ExamArguments {
    /// The exam's folder, as withheld-plant writes it
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// The folder for the reports, exam.json and exam.html [default: DIR-reports]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// How many cases are diagnosed at a time
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub jobs: usize,
    /// Keeps the reports that an interrupted exam has written
    #[arg(long)]
    pub resume: bool,
    /// A case that takes longer has no verdict; from two thirds of it on it answers with the best that it has so far
    #[arg(long, value_name = "TIME", value_parser = crate::time::parse_duration)]
    pub timeout: Option<Duration>,
    /// The key of the answers [default: DIR.key]
    #[arg(long, value_name = "FILE")]
    pub key: Option<PathBuf>,
    /// The exam.json of another sitting, with other machines, whose cases are counted with these; may be given several times
    #[arg(long, value_name = "FILE")]
    pub with: Vec<PathBuf>,
    /// What the rates must reach, as JSON: {"single_right": {"at_least": 0.5}, "false_alarm": {"at_most": 0}}
    #[arg(long, value_name = "FILE")]
    pub floor: Option<PathBuf>,
    /// Prints the rates as one JSON object on standard output, and nothing else there
    #[arg(long)]
    pub json: bool,
}

impl ExamArguments {
    /// When a case is asked for the best answer so far: what it then brings to its end takes a while.
    fn within(&self) -> Option<Duration> {
        self.timeout.map(|timeout| timeout * 2 / 3)
    }
}

const HELP: &str = "\
Examples:
  withheld-plant cases short --exam short
  kinetwin gap exam short --jobs 2
  kinetwin gap exam short --jobs 2 --resume
  kinetwin gap exam second --jobs 2 --with first-reports/exam.json

Exit codes:
  0  every case was judged; with --floor, no rate is below its floor, whether each case was or not
  1  some cases have no verdict; each is named; with --floor, a rate is below its floor
  2  bad input or use";

/// What stands in the place of a report where there is none.
const FAILED: &str = "failed.txt";
const REPORT: &str = "report.json";
const SECONDS: &str = "seconds.txt";

/// Does what was asked.
pub fn run(arguments: &ExamArguments) -> Result<Answer, Failure> {
    let out = arguments.out.clone().unwrap_or_else(|| {
        let mut name = arguments.folder.file_name().unwrap_or_default().to_owned();
        name.push("-reports");
        arguments.folder.with_file_name(name)
    });
    let floor = arguments.floor.as_deref().map(|path| named(path, Floor::from_json)).transpose()?;
    let earlier = arguments.with.iter().map(|path| named(path, Exam::of_sitting)).collect::<Result<Vec<_>, _>>()?;
    let cases = sealed_answers::cases(&arguments.folder).map_err(|error| Failure::of(&error))?;
    if cases.is_empty() {
        let folder = arguments.folder.display();
        return Err(Failure(format!("error: {folder} holds no case: expected DIR/case-NNN/model and its traces")));
    }
    let is_closed = out.join(sealed_answers::MANIFEST).exists();
    if out.exists() && !arguments.resume {
        let out = out.display();
        return Err(Failure(format!("error: {out} exists: continue that exam with --resume, or name another --out")));
    }
    if !is_closed {
        diagnose_all(arguments, &out, &cases)?;
        let files: Vec<String> = cases.iter().map(|case| format!("{case}/{}", answered(&out.join(case)))).collect();
        let manifest = sealed_answers::Manifest::of(&out, &files).map_err(|error| Failure::of(&error))?;
        manifest.write(&out).map_err(|error| Failure::of(&error))?;
    }
    let key = arguments.key.clone().unwrap_or_else(|| sealed_answers::default_key(&arguments.folder));
    let answers = sealed_answers::open(&arguments.folder, &key, &out).map_err(|error| Failure::of(&error))?;
    let (seed, answers) = exam::read_answers(&answers).map_err(|error| Failure::of(&error))?;
    ask_oracles(arguments, &out, &answers)?;
    let (judged, failed) = score(&out, &cases, &answers);
    let exam = Exam::new(seed, opened_on(&out)?, judged, failed);
    let exam = exam.with(earlier).map_err(|error| Failure(format!("error: another sitting {error}")))?;
    tell(arguments, &out, &exam)?;
    let is_fine = match floor {
        None => exam.failed.is_empty(),
        Some(floor) => {
            let broken = floor.broken(&exam.rates);
            broken.iter().for_each(words::tell);
            broken.is_empty()
        }
    };
    Ok(if is_fine { Answer::Yes } else { Answer::No })
}

/// Reads a file that was named.
fn named<T, E: std::fmt::Display>(path: &Path, of: impl Fn(&str) -> Result<T, E>) -> Result<T, Failure> {
    let failed = |error: &dyn std::fmt::Display| Failure(format!("error: {}: {error}", path.display()));
    let text = std::fs::read_to_string(path).map_err(|error| failed(&error))?;
    of(&text).map_err(|error| failed(&error))
}

/// The file that a case was answered with.
fn answered(folder: &Path) -> &'static str {
    if folder.join(REPORT).exists() && !folder.join(FAILED).exists() { REPORT } else { FAILED }
}

/// A report that needs no further diagnosis: incomplete only because its time was up, and not because it was interrupted.
fn is_done(arguments: &ExamArguments, folder: &Path) -> bool {
    let had_its_time =
        || arguments.within().zip(seconds(folder)).is_some_and(|(within, took)| took >= within.as_secs_f64());
    read(folder).is_ok_and(|report| !report.incomplete || had_its_time()) && !folder.join(FAILED).exists()
}

/// How long a case took.
fn seconds(folder: &Path) -> Option<f64> {
    std::fs::read_to_string(folder.join(SECONDS)).ok()?.trim().parse().ok()
}

fn diagnose_all(arguments: &ExamArguments, out: &Path, cases: &[String]) -> Result<(), Failure> {
    let left: Vec<&String> = cases.iter().filter(|case| !is_done(arguments, &out.join(case))).collect();
    side_by_side(arguments, &left, &|case| {
        diagnose(arguments, &arguments.folder.join(case), &out.join(case), None)?;
        words::tell(format!("{case}: {}", answered(&out.join(case))));
        Ok(())
    })
}

/// Where the report of an oracle is, in the folder of its case.
const ORACLE: &str = "oracle";

/// Lets an oracle look at each case with one effect that counts: it is told the effect and its device, and only fits it. How far the
/// gap then shrinks is as far as it can.
fn ask_oracles(arguments: &ExamArguments, out: &Path, answers: &[exam::Answer]) -> Result<(), Failure> {
    let is_left = |answer: &&exam::Answer| {
        let folder = out.join(&answer.case);
        answer.has_an_oracle() && is_done(arguments, &folder) && !is_done(arguments, &folder.join(ORACLE))
    };
    let left: Vec<&exam::Answer> = answers.iter().filter(is_left).collect();
    side_by_side(arguments, &left, &|answer| {
        let (case, out) = (arguments.folder.join(&answer.case), out.join(&answer.case).join(ORACLE));
        diagnose(arguments, &case, &out, answer.effects.first())?;
        words::tell(format!("{}, told its effect: {}", answer.case, answered(&out)));
        Ok(())
    })
}

/// Does `what` with each, as many at a time as are asked for.
fn side_by_side<T: Sync>(
    arguments: &ExamArguments,
    all: &[&T],
    what: &(dyn Fn(&T) -> Result<(), Failure> + Sync),
) -> Result<(), Failure> {
    let next = Mutex::new(all.iter());
    let jobs = arguments.jobs.max(1);
    let worker = || -> Result<(), Failure> {
        loop {
            let Some(one) = next.lock().ok().and_then(|mut left| left.next().copied()) else { return Ok(()) };
            what(one)?;
        }
    };
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..jobs).map(|_| scope.spawn(worker)).collect();
        let mut ends = workers.into_iter().map(|worker| worker.join());
        ends.try_for_each(|end| end.unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
    })
}

/// Diagnoses one case in a process of its own, which may be told its effect. What keeps it from a verdict is written in the place of
/// a report.
fn diagnose(
    arguments: &ExamArguments,
    case: &Path,
    out: &Path,
    told: Option<&exam::TrueEffect>,
) -> Result<(), Failure> {
    std::fs::create_dir_all(out)?;
    for old in [FAILED, REPORT] {
        if out.join(old).exists() {
            std::fs::remove_file(out.join(old))?;
        }
    }
    let started = Instant::now();
    let end = diagnosed(arguments, case, out, told);
    std::fs::write(out.join(SECONDS), format!("{:.3}\n", started.elapsed().as_secs_f64()))?;
    let why = match end.and_then(|()| read(out)) {
        Ok(_) if is_done(arguments, out) => return Ok(()),
        Ok(_) => "it was interrupted".to_owned(),
        Err(why) => why,
    };
    Ok(std::fs::write(out.join(FAILED), format!("{why}\n"))?)
}

fn diagnosed(
    arguments: &ExamArguments,
    case: &Path,
    out: &Path,
    told: Option<&exam::TrueEffect>,
) -> Result<(), String> {
    let model = std::fs::read_to_string(case.join("model")).map_err(|error| format!("its model: {error}"))?;
    let model = model.trim();
    let beside = case.join(model);
    let model = if beside.exists() { beside } else { PathBuf::from(model) };
    let trace = |name: &str| {
        let compressed = case.join(format!("{name}.cps.jsonl.zst"));
        if compressed.exists() { compressed } else { case.join(format!("{name}.cps.jsonl")) }
    };
    let program = std::env::current_exe().map_err(|error| format!("this program: {error}"))?;
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let mut child = Command::new(program)
        .args(["gap", "diagnose", "--model"])
        .arg(model)
        .arg("--train")
        .arg(trace("train"))
        .arg("--holdout")
        .arg(trace("holdout"))
        .arg("--out")
        .arg(out)
        .args(arguments.within().iter().flat_map(|within| ["--within".to_owned(), format!("{}ms", within.as_millis())]))
        .args(told.iter().flat_map(|told| ["--effects", &told.effect, "--devices", &told.device]))
        .env("RAYON_NUM_THREADS", (cores / arguments.jobs.max(1)).max(1).to_string())
        .stdout(Stdio::null())
        .stderr(std::fs::File::create(out.join("log.txt")).map_err(|error| format!("its log: {error}"))?)
        .spawn()
        .map_err(|error| format!("it did not start: {error}"))?;
    let started = Instant::now();
    loop {
        if let Some(status) = child.try_wait().map_err(|error| format!("it was lost: {error}"))? {
            let log = std::fs::read_to_string(out.join("log.txt")).unwrap_or_default();
            return if status.success() { Ok(()) } else { Err(format!("it ended with {status}: {}", log.trim())) };
        }
        if arguments.timeout.is_some_and(|timeout| started.elapsed() > timeout) {
            let _ = child.kill();
            let _ = child.wait();
            return Err(format!("it took longer than {:.0} s", started.elapsed().as_secs_f64()));
        }
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// The report of a case, if it keeps to the contract.
fn read(folder: &Path) -> Result<Report, String> {
    let path = folder.join(REPORT);
    let text = std::fs::read_to_string(&path).map_err(|error| format!("no report: {error}"))?;
    let report = Report::from_json(&path, &text).map_err(|error| error.to_string())?;
    match report.flaws().first() {
        None => Ok(report),
        Some(flaw) => Err(format!("its report misses the contract: {flaw}")),
    }
}

fn score(out: &Path, cases: &[String], answers: &[exam::Answer]) -> (Vec<Judged>, BTreeMap<String, String>) {
    let (mut judged, mut failed) = (Vec::new(), BTreeMap::new());
    for case in cases {
        let folder = out.join(case);
        let Some(answer) = answers.iter().find(|answer| answer.case == *case) else {
            failed.insert(case.clone(), "the sealed answers hold none for it".to_owned());
            continue;
        };
        let seconds = seconds(&folder);
        let report = match std::fs::read_to_string(folder.join(FAILED)) {
            Ok(why) => Err(why.trim().to_owned()),
            Err(_) => read(&folder),
        };
        match report {
            Ok(report) => {
                let oracle = read(&folder.join(ORACLE)).ok();
                judged.push(exam::judge(answer, &report, seconds.unwrap_or_default()).beside(oracle.as_ref()));
            }
            Err(why) => {
                judged.push(exam::unanswered(answer, seconds.unwrap_or_default()));
                failed.insert(case.clone(), why);
            }
        }
    }
    (judged, failed)
}

fn tell(arguments: &ExamArguments, out: &Path, exam: &Exam) -> Result<(), Failure> {
    let put = |name: &str, text: &str| {
        write_whole(&out.join(name), true, |mut file| {
            file.write_all(text.as_bytes())?;
            Ok((file, ()))
        })
    };
    put("exam.json", &serde_json::to_string_pretty(exam)?)?;
    put("exam.html", &exam::page(exam))?;
    if arguments.json {
        return words::answer_line(serde_json::to_string(exam)?);
    }
    words::answer(text(exam))
}

/// The rates in lines.
fn text(exam: &Exam) -> String {
    let mut text = format!("{:20} {:>8}  {:>15}  {:>5}  target\n", "rate", "value", "95 %", "cases");
    for shown in exam.rates.shown() {
        let exam::Shown { name, rate, .. } = shown;
        let (value, within) = (rate.percent(), rate.within());
        let line = format!("{name:20} {value:>8}  {within:>15}  {:>5}  {}", rate.n, shown.stands());
        text.push_str(line.trim_end());
        text.push('\n');
    }
    for (name, sizes) in [("true classes", &exam.true_classes), ("named classes", &exam.named_classes)] {
        if let Some(median) = sizes.median {
            let counts: Vec<String> = sizes.counts.iter().map(|(size, cases)| format!("{cases} of {size}")).collect();
            text.push_str(&format!("{name:20} {median:>8}  {:>15}  {:>5}\n", counts.join(", "), sizes.n));
        }
    }
    for (case, why) in &exam.failed {
        text.push_str(&format!("{case} has no verdict: {why}\n"));
    }
    text
}

/// The calendar's day, in UTC, on which the answers were opened: that of the reports' manifest, however often they are scored again.
fn opened_on(out: &Path) -> std::io::Result<String> {
    let written = std::fs::metadata(out.join(sealed_answers::MANIFEST))?.modified()?;
    let seconds = written.duration_since(SystemTime::UNIX_EPOCH).map_or(0, |since| since.as_secs());
    Ok(date_and_time(seconds).split('T').next().unwrap_or_default().to_owned())
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;
    use crate::gap::report::Verdict;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        arguments: ExamArguments,
    }

    /// Scored a day later, an exam has the date of when its answers were opened.
    #[test]
    fn an_exams_date_is_that_of_its_manifest() {
        let folder = tempfile::tempdir().expect("a folder");
        assert!(opened_on(folder.path()).is_err());
        let path = folder.path().join(sealed_answers::MANIFEST);
        let file = std::fs::File::create(&path).expect("a file");
        file.set_modified(SystemTime::UNIX_EPOCH + Duration::from_secs(1_769_900_000)).expect("a time");
        assert_eq!(opened_on(folder.path()).expect("a date"), "2026-01-31");
    }

    /// An incomplete report is an answer if the case had its time, and is asked for again if someone interrupted it.
    #[test]
    fn a_report_that_had_its_time_is_done() {
        let folder = tempfile::tempdir().expect("a folder");
        let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("a file");
        let of = |line: &[&str]| Line::parse_from([&["exam", "short"], line].concat()).arguments;
        let (bounded, free) = (of(&["--timeout", "60s"]), of(&[]));
        let mut report = Report::new(Verdict::NotTestable);
        assert_eq!(report.flaws(), Vec::<String>::new());
        report.incomplete = true;
        write(REPORT, &report.to_json());
        let is_done = |seconds: &str| {
            write(SECONDS, seconds);
            [&bounded, &free].map(|arguments| is_done(arguments, folder.path()))
        };
        assert_eq!(is_done("41.5\n"), [true, false]);
        assert_eq!(is_done("39.0\n"), [false, false]);
        report.incomplete = false;
        write(REPORT, &report.to_json());
        assert!(super::is_done(&free, folder.path()));
        write(FAILED, "it was interrupted\n");
        assert!(!super::is_done(&free, folder.path()));
    }
}
