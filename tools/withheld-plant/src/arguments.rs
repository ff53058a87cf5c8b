//! The command's arguments.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::site::Sites;

/// Plants that share nothing with the diagnosis, and cases of them whose answers are sealed.
#[derive(Debug, Parser)]
#[command(version, args_conflicts_with_subcommands = true, arg_required_else_help = true, after_long_help = HELP)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Option<Command>,
    #[command(flatten)]
    pub practice: Option<Practice>,
}

const HELP: &str = "\
Examples:
  withheld-plant cases short --exam short
  withheld-plant cases final --exam final --resume
  withheld-plant open short --reports short-reports -o answers.json
  withheld-plant --seed 7 --cases 24 --out practice --answers practice.json
  withheld-plant socket pairs --seed 7

Exit codes:
  0  done
  2  bad input or use; answers that may not be opened yet; a recording that was not made";

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Writes an exam: numbered cases, and their answers sealed
    Cases(Cases),
    /// Opens an exam's answers, when every case has been answered
    Open(Open),
    /// Writes each case twice: recorded in simulated time, and over a real socket in real time
    Socket(Pairs),
}

/// Cases with their answers in the open, to practise on.
#[derive(Debug, Args)]
pub struct Practice {
    /// What the cases are a function of
    #[arg(long, value_name = "N")]
    pub seed: u64,
    /// How many, in the shares of the whole exam
    #[arg(long, value_name = "N")]
    pub cases: usize,
    /// The folder for the cases, which must not exist yet
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// The file for their answers, outside of that folder
    #[arg(long, value_name = "FILE")]
    pub answers: PathBuf,
    /// Reports of no age, tasks that take commands at once, unfiltered flags
    #[arg(long)]
    pub prompt: bool,
    /// Machines built exactly to their figures, for models that tolerate nothing, such as models/rig
    #[arg(long)]
    pub exact: bool,
    /// Answers without the classes of effects that cannot be told apart, which take seconds a case
    #[arg(long)]
    pub no_classes: bool,
    /// Which plants the cases are of
    #[arg(long, value_enum, default_value_t = Sites::All)]
    pub on: Sites,
    /// Cases of this effect alone, by its id, clear and gross in turn: intermittent, x-filter-clogs
    #[arg(long, value_name = "ID")]
    pub effect: Option<String>,
    /// Of all these cases only those of these numbers, under the names that they have among all: to make one of an exam again
    #[arg(long, value_name = "N", value_delimiter = ',', num_args = 1..)]
    pub only: Vec<usize>,
}

#[derive(Debug, Args)]
pub struct Cases {
    /// The folder for the cases, which must not exist yet
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Which exam: its size, and which seed it has
    #[arg(long)]
    pub exam: Exam,
    /// What the cases are a function of [default: the short and the training exam's own; the final one's is drawn and sealed]
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// So many cases instead, in the shares of the whole exam
    #[arg(long, value_name = "N")]
    pub cases: Option<usize>,
    /// The file for the key [default: beside the folder, DIR.key]
    #[arg(long, value_name = "FILE")]
    pub key: Option<PathBuf>,
    /// Answers without the classes of effects that cannot be told apart, which take seconds a case
    #[arg(long)]
    pub no_classes: bool,
    /// Goes on with a folder whose making was interrupted, by the same arguments; what is made stays, and so does the seed
    #[arg(long)]
    pub resume: bool,
}

/// Which exam.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Exam {
    /// 24 cases, some of each sort
    Short,
    /// The whole exam, for calibration to look at
    Training,
    /// The whole exam that nothing may look at
    Final,
}

impl Exam {
    /// The word for it.
    pub fn name(self) -> &'static str {
        match self {
            Exam::Short => "short",
            Exam::Training => "training",
            Exam::Final => "final",
        }
    }
}

#[derive(Debug, Args)]
pub struct Open {
    /// The exam's folder
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// The folder of the reports, with the manifest of their hashes
    #[arg(long, value_name = "DIR")]
    pub reports: PathBuf,
    /// The key's file [default: beside the folder, DIR.key]
    #[arg(long, value_name = "FILE")]
    pub key: Option<PathBuf>,
    /// The file for the answers
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
}

/// Cases of one machine each, recorded in simulated time in DIR/simulated and over a socket in DIR/socket.
#[derive(Debug, Args)]
pub struct Pairs {
    /// The folder for both, which must not exist yet
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// What the cases are a function of
    #[arg(long, value_name = "N")]
    pub seed: u64,
    /// How many, in the shares of the whole exam
    #[arg(long, value_name = "N", default_value_t = 12)]
    pub cases: usize,
    /// How many recordings run side by side [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub jobs: Option<u32>,
    /// The file for the answers, in the open and outside of that folder [default: sealed, in both]
    #[arg(long, value_name = "FILE")]
    pub answers: Option<PathBuf>,
}
