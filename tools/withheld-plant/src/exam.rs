//! Exams: cases in numbered folders, their answers apart.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use sealed_answers::{Draft, SealError};
use serde::{Deserialize, Serialize};

use crate::arguments::{Arguments, Cases, Command, Exam, Open, Practice};
use crate::cases::Answer;
use crate::plans::{Plan, Sizes, of_effect, plans};
use crate::site::Sites;
use crate::socket::{SocketError, pairs};
use crate::workbench::Conditions;

/// The seeds of the exams that may be made again. They are unlike, so that nothing learnt on one is known of the other.
const SHORT_SEED: u64 = 20_260_131;
const TRAINING_SEED: u64 = 71_828_182;

/// Why an exam could not be made or opened.
#[derive(Debug, thiserror::Error)]
pub enum ExamError {
    /// A folder or file could not be written.
    #[error("failed to write {}", path.display())]
    Write {
        path: PathBuf,
        #[source]
        source: io::Error,
    },
    /// What stands there might be an exam that somebody still needs.
    #[error("{} exists: expected a folder that is not there yet; name another, or remove it", path.display())]
    Exists { path: PathBuf },
    /// Answers in the folder of the cases would be read by whoever diagnoses them.
    #[error("{} lies in the folder of the cases: name a file outside of it", path.display())]
    AnswersInside { path: PathBuf },
    /// The answers could not be sealed or opened.
    #[error(transparent)]
    Sealed(#[from] SealError),
    /// A recording over a socket was not made.
    #[error("failed to record {} over a socket", path.display())]
    Socket {
        path: PathBuf,
        #[source]
        source: SocketError,
    },
    /// What was begun is another exam.
    #[error(
        "{} was begun with other arguments: expected the same --exam, --cases, --seed and --no-classes", path.display()
    )]
    OtherExam { path: PathBuf },
    /// The answers have no JSON form.
    #[error("failed to write the answers as JSON")]
    Json(#[from] serde_json::Error),
    /// A case that is not among them.
    #[error("--only {number}: expected a number from 1 to {cases}, the number of cases")]
    NoSuchCase { number: usize, cases: usize },
    #[error("no effect of the catalogue is called {0}: expected an id such as intermittent or x-filter-clogs")]
    NoSuchEffect(String),
}

/// All answers of an exam.
#[derive(Serialize)]
struct Answers<'a> {
    schema: &'static str,
    exam: &'a str,
    seed: u64,
    cases: Vec<Answer>,
}

/// Does what was asked, and says what was done.
pub fn run(arguments: Arguments) -> Result<String, ExamError> {
    match (arguments.command, arguments.practice) {
        (Some(Command::Cases(asked)), _) => cases(&asked),
        (Some(Command::Open(asked)), _) => open(&asked),
        (Some(Command::Socket(asked)), _) => pairs::run(&asked),
        (None, Some(asked)) => practice(&asked),
        (None, None) => Ok(String::new()),
    }
}

/// What an exam follows from: kept with what is made of it, so that its making can go on.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Begun {
    exam: String,
    seed: u64,
    cases: Option<usize>,
    classless: bool,
}

/// By what name.
const BEGUN: &str = "exam";

impl Begun {
    fn new(asked: &Cases) -> Begun {
        let seed = asked.seed.unwrap_or_else(|| match asked.exam {
            Exam::Short => SHORT_SEED,
            Exam::Training => TRAINING_SEED,
            Exam::Final => sealed_answers::random_seed(),
        });
        Begun { exam: asked.exam.name().to_owned(), seed, cases: asked.cases, classless: asked.no_classes }
    }

    /// What `draft` was begun as, which must be what is asked for: a seed that was drawn counts as asked for.
    fn again(asked: &Cases, draft: &Draft) -> Result<Begun, ExamError> {
        let other = || ExamError::OtherExam { path: asked.folder.clone() };
        let begun: Begun = serde_json::from_slice(&draft.kept(BEGUN)?.ok_or_else(other)?)?;
        let is_drawn = asked.seed.is_none() && asked.exam == Exam::Final;
        let now = Begun::new(asked);
        let now = if is_drawn { Begun { seed: begun.seed, ..now } } else { now };
        if now == begun { Ok(begun) } else { Err(other()) }
    }
}

fn cases(asked: &Cases) -> Result<String, ExamError> {
    let key = asked.key.clone().unwrap_or_else(|| sealed_answers::default_key(&asked.folder));
    let (draft, begun) = if asked.resume {
        let draft = Draft::resume(&asked.folder, &key)?;
        let begun = Begun::again(asked, &draft)?;
        (draft, begun)
    } else {
        Draft::none_of(&asked.folder)?;
        is_new(&asked.folder)?;
        let draft = Draft::begin(&asked.folder, &key)?;
        let begun = Begun::new(asked);
        draft.keep(BEGUN, &serde_json::to_vec(&begun)?)?;
        (draft, begun)
    };
    let sizes = if asked.exam == Exam::Short { Sizes::SHORT } else { Sizes::WHOLE };
    let sizes = asked.cases.map_or(sizes, |cases| Sizes::WHOLE.scaled(cases));
    let is_short = asked.exam == Exam::Short && asked.cases.is_none();
    let sites = if is_short { Sites::Rig } else { Sites::All };
    let conditions = Conditions { classless: asked.no_classes, ..Conditions::default() };
    let made = make(&asked.folder, &plans(sizes, sites, begun.seed), &[], conditions, Some(&draft))?;
    draft.seal(&answers(asked.exam.name(), begun.seed, made)?)?;
    Ok(format!("{} cases in {}, the key of their answers in {}", sizes.sum(), asked.folder.display(), key.display()))
}

fn practice(asked: &Practice) -> Result<String, ExamError> {
    if asked.answers.starts_with(&asked.out) {
        return Err(ExamError::AnswersInside { path: asked.answers.clone() });
    }
    let conditions = Conditions { prompt: asked.prompt, exact: asked.exact, classless: asked.no_classes };
    let plans = match &asked.effect {
        None => plans(Sizes::WHOLE.scaled(asked.cases), asked.on, asked.seed),
        Some(effect) => of_effect(effect, asked.cases, asked.on, asked.seed)
            .ok_or_else(|| ExamError::NoSuchEffect(effect.clone()))?,
    };
    let cases = plans.len();
    if let Some(&number) = asked.only.iter().find(|&&number| number == 0 || number > cases) {
        return Err(ExamError::NoSuchCase { number, cases });
    }
    is_new(&asked.out)?;
    let made = make(&asked.out, &plans, &asked.only, conditions, None)?;
    let cases = made.len();
    write(&asked.answers, &answers("practice", asked.seed, made)?)?;
    Ok(format!("{cases} cases in {}, their answers in {}", asked.out.display(), asked.answers.display()))
}

fn open(asked: &Open) -> Result<String, ExamError> {
    let key = asked.key.clone().unwrap_or_else(|| sealed_answers::default_key(&asked.folder));
    let answers = sealed_answers::open(&asked.folder, &key, &asked.reports)?;
    write(&asked.output, &answers)?;
    Ok(format!("the answers of {} are in {}", asked.folder.display(), asked.output.display()))
}

fn is_new(folder: &Path) -> Result<(), ExamError> {
    if folder.exists() { Err(ExamError::Exists { path: folder.to_owned() }) } else { Ok(()) }
}

/// Makes the cases of `only`, counted from 1, or all where it is empty, but for those whose answers `draft` has kept; gives all answers, in
/// the order of the cases.
fn make(
    folder: &Path,
    plans: &[Plan],
    only: &[usize],
    conditions: Conditions,
    draft: Option<&Draft>,
) -> Result<Vec<Answer>, ExamError> {
    let digits = plans.len().to_string().len().max(3);
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    let asked: Vec<(usize, &Plan)> =
        (1..).zip(plans).filter(|(number, _)| only.is_empty() || only.contains(number)).collect();
    let make = |&(number, plan): &(usize, &Plan)| -> Result<Answer, ExamError> {
        let case = format!("case-{number:0digits$}");
        if let Some(kept) = draft.map(|draft| draft.kept(&case)).transpose()?.flatten() {
            return Ok(serde_json::from_slice(&kept)?);
        }
        let path = folder.join(&case);
        let answer = made_anew(plan, &path, conditions).map_err(|source| ExamError::Write { path, source })?;
        if let Some(draft) = draft {
            draft.keep(&case, &serde_json::to_vec(&answer)?)?;
        }
        Ok(answer)
    };
    // Some take a hundred times as long as others: each worker takes the next one that is left.
    let next = AtomicUsize::new(0);
    let worker = || {
        let numbers = std::iter::from_fn(|| Some(next.fetch_add(1, Ordering::Relaxed)));
        numbers.map_while(|index| asked.get(index).map(make)).collect::<Vec<_>>()
    };
    let made = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..workers).map(|_| scope.spawn(worker)).collect();
        workers.into_iter().map(|worker| worker.join()).collect::<Vec<_>>()
    });
    let mut cases = Vec::new();
    for worker in made {
        for case in worker.unwrap_or_else(|panic| std::panic::resume_unwind(panic)) {
            cases.push(case?);
        }
    }
    cases.sort_by(|one, next| one.case.cmp(&next.case));
    Ok(cases)
}

/// Makes a case in a folder, where there may be a part of it that was left when its making was interrupted.
fn made_anew(plan: &Plan, folder: &Path, conditions: Conditions) -> io::Result<Answer> {
    if folder.exists() {
        std::fs::remove_dir_all(folder)?;
    }
    plan.make(folder, conditions)
}

/// All answers of an exam as JSON.
pub fn answers(exam: &str, seed: u64, cases: Vec<Answer>) -> Result<Vec<u8>, ExamError> {
    Ok(serde_json::to_vec_pretty(&Answers { schema: "kinetwin-answers/1", exam, seed, cases })?)
}

fn write(path: &Path, content: &[u8]) -> Result<(), ExamError> {
    std::fs::write(path, content).map_err(|source| ExamError::Write { path: path.to_owned(), source })
}
