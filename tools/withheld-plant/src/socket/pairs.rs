//! Pairs of cases: one machine, once recorded in simulated time and once over a real socket.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::thread;

use super::{Lateness, SocketError, in_time, record};
use crate::arguments::Pairs;
use crate::cases::Answer;
use crate::exam::{ExamError, answers};
use crate::plans::{Plan, Sizes, plans};
use crate::record::{Said, write_said};
use crate::site::Sites;
use crate::workbench::{Conditions, Take};

/// The folder of what was recorded in simulated time, and of what was over a socket.
const FOLDERS: [&str; 2] = ["simulated", "socket"];

/// How often a recording is tried that does not keep time.
const TRIES: usize = 6;

/// Writes the pairs that were asked for, and says so.
pub fn run(asked: &Pairs) -> Result<String, ExamError> {
    write(asked, &plans(Sizes::WHOLE.scaled(asked.cases), Sites::Rig, asked.seed), patiently)
}

/// Writes a pair of each plan, all of them or none; `record` makes the recordings.
pub fn write(asked: &Pairs, plans: &[Plan], record: impl Recording) -> Result<String, ExamError> {
    let unfinished = unfinished(&asked.folder);
    for path in [&asked.folder, &unfinished] {
        if path.exists() {
            return Err(ExamError::Exists { path: path.clone() });
        }
    }
    if asked.answers.as_ref().is_some_and(|answers| answers.starts_with(&asked.folder)) {
        return Err(ExamError::AnswersInside { path: asked.answers.clone().unwrap_or_default() });
    }
    if let Some(path) = asked.answers.as_ref().filter(|path| path.parent().is_some_and(is_lacking)) {
        // Better now than when everything is recorded.
        return Err(at(path)(io::ErrorKind::NotFound.into()));
    }
    let written = write_in(&unfinished, asked, plans, record).and_then(|said| {
        fs::rename(&unfinished, &asked.folder).map_err(at(&asked.folder))?;
        Ok(said)
    });
    if written.is_err() {
        // What is half done would be taken for cases.
        let _ = fs::remove_dir_all(&unfinished);
    }
    written
}

/// Whether there is no such folder; the empty path is the one that we are in.
fn is_lacking(folder: &Path) -> bool {
    !folder.as_os_str().is_empty() && !folder.is_dir()
}

/// Where pairs are until all are there.
fn unfinished(folder: &Path) -> PathBuf {
    let mut name = folder.file_name().unwrap_or_default().to_owned();
    name.push(".unfinished");
    folder.with_file_name(name)
}

fn write_in(folder: &Path, asked: &Pairs, plans: &[Plan], record: impl Recording) -> Result<String, ExamError> {
    let jobs = asked.jobs.map_or(usize::MAX, |jobs| jobs as usize);
    let (answers, wanted) = simulated(&folder.join(FOLDERS[0]), plans)?;
    let lateness = over_socket(&folder.join(FOLDERS[1]), wanted, jobs, record)?;
    let where_answers = deliver(folder, asked, answers)?;
    let ms = |seconds: f64| 1e3 * seconds;
    let (half, most) = (ms(lateness.quantile(0.5)), ms(lateness.most()));
    let late = format!("half of all events at most {half:.2} ms late, 99 % {:.2} ms", ms(lateness.quantile(0.99)));
    let cases =
        format!("{} cases, each in simulated time and over a socket, in {}", plans.len(), asked.folder.display());
    Ok(format!("{cases}; {late}, none more than {most:.2} ms; {where_answers}"))
}

/// How a recording is made, and how late it was.
pub trait Recording: Fn(&Take) -> Result<(Vec<Said>, Lateness), SocketError> + Sync {}

impl<F: Fn(&Take) -> Result<(Vec<Said>, Lateness), SocketError> + Sync> Recording for F {}

/// A recording that is still to be made, and its case.
struct Wanted {
    take: Take,
    case: String,
}

/// Writes the cases in simulated time; gives their answers and what their recordings were made of.
fn simulated(folder: &Path, plans: &[Plan]) -> Result<(Vec<Answer>, Vec<Wanted>), ExamError> {
    let workers = thread::available_parallelism().map_or(1, usize::from);
    let mut made = each(plans.iter().enumerate().collect(), workers, |(number, plan)| {
        let name = format!("case-{:03}", number + 1);
        let path = folder.join(&name);
        let (answer, takes) = plan.make_and_keep(&path, Conditions::default()).map_err(at(&path))?;
        let wanted: Vec<Wanted> = takes.into_iter().map(|take| Wanted { take, case: name.clone() }).collect();
        Ok((answer, wanted))
    })?;
    made.sort_by(|(one, _), (next, _)| one.case.cmp(&next.case));
    let (answers, wanted): (Vec<_>, Vec<_>) = made.into_iter().unzip();
    Ok((answers, wanted.into_iter().flatten().collect()))
}

/// Makes the recordings over sockets, so many side by side, and gives how late they were.
fn over_socket(folder: &Path, wanted: Vec<Wanted>, jobs: usize, record: impl Recording) -> Result<Lateness, ExamError> {
    let jobs = jobs.min(wanted.len());
    let lates = each(wanted, jobs, |Wanted { take, case }| {
        let path = folder.join(case);
        let (said, lateness) = record(&take).map_err(|source| ExamError::Socket { path: path.clone(), source })?;
        fs::create_dir_all(&path).map_err(at(&path))?;
        fs::write(path.join("model"), format!("{}\n", take.model)).map_err(at(&path))?;
        let path = path.join(take.part.file());
        let file = fs::File::create(&path).map_err(at(&path))?;
        write_said(io::BufWriter::new(file), take.model, &said).map_err(at(&path))?;
        Ok(lateness)
    })?;
    Ok(lates.into_iter().fold(Lateness::default(), Lateness::and))
}

/// Records, again if that was not in time.
fn patiently(take: &Take) -> Result<(Vec<Said>, Lateness), SocketError> {
    let mut tries = 1;
    loop {
        let (said, lateness) = record(take, take.part.seconds())?;
        match in_time(&lateness, take.around.cycle) {
            Ok(()) => return Ok((said, lateness)),
            Err(_) if tries < TRIES => tries += 1,
            Err(error) => return Err(error),
        }
    }
}

/// Puts the answers where they were asked for, and says where.
fn deliver(folder: &Path, asked: &Pairs, cases: Vec<Answer>) -> Result<String, ExamError> {
    let content = answers("pairs", asked.seed, cases)?;
    if let Some(path) = &asked.answers {
        fs::write(path, content).map_err(at(path))?;
        return Ok(format!("their answers are in {}", path.display()));
    }
    for exam in FOLDERS.map(|name| folder.join(name)) {
        sealed_answers::seal(&exam, &sealed_answers::default_key(&exam), &content)?;
    }
    Ok("the keys of their answers are beside both folders".to_owned())
}

/// Does `work` with each of `all` on so many threads. Gives what came of them in any order, or an error, after which no more
/// is begun.
fn each<T: Send, R: Send>(
    all: Vec<T>,
    threads: usize,
    work: impl Fn(T) -> Result<R, ExamError> + Sync,
) -> Result<Vec<R>, ExamError> {
    let left = Mutex::new(all.into_iter());
    let failed = std::sync::atomic::AtomicBool::new(false);
    let next = || left.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).next();
    let worker = || {
        let mut done = Vec::new();
        while !failed.load(std::sync::atomic::Ordering::Relaxed)
            && let Some(one) = next()
        {
            let result = work(one);
            failed.fetch_or(result.is_err(), std::sync::atomic::Ordering::Relaxed);
            done.push(result);
        }
        done
    };
    thread::scope(|scope| {
        let workers: Vec<_> = (0..threads.max(1)).map(|_| scope.spawn(worker)).collect();
        let done = workers
            .into_iter()
            .flat_map(|worker| worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
        done.collect()
    })
}

/// What went wrong with a file, with its path.
fn at(path: &Path) -> impl Fn(io::Error) -> ExamError + '_ {
    |source| ExamError::Write { path: path.to_owned(), source }
}
