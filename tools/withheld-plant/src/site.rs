//! Which plant a case is of.

use clap::ValueEnum;

use crate::catalogue::{Entry, Spot};
use crate::chance::Dice;
use crate::drawn::Drawn;
use crate::line::Line;
use crate::machine::Machine;
use crate::rig::RigParameters;

/// The plant of one case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Site {
    /// `models/rig-toleranced`
    Rig,
    /// A plant of its own, drawn at random.
    Drawn,
    /// `models/depalletizer`
    Line,
}

/// The plants of an exam's cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Sites {
    /// As the whole exam has them
    All,
    /// models/rig-toleranced alone
    Rig,
    /// Plants drawn at random alone
    Drawn,
    /// models/depalletizer alone
    Line,
}

impl Sites {
    /// The plant of the `index`th case that is planned. Of all cases one in 25 is of the line, 57 of the whole exam's 1420, and three in
    /// ten are of plants drawn at random.
    pub fn site(self, index: usize) -> Site {
        match self {
            Sites::Rig => Site::Rig,
            Sites::Drawn => Site::Drawn,
            Sites::Line => Site::Line,
            Sites::All if index % 25 == 12 => Site::Line,
            // As many even as odd ones: what is clear or gross goes by that.
            Sites::All if [1, 4, 7, 10, 13, 18].contains(&(index % 20)) => Site::Drawn,
            Sites::All => Site::Rig,
        }
    }
}

impl Site {
    /// Whether an effect of the catalogue can be there. The line has no servo axis, no motor and no bay of its own kind; its
    /// controller answers to what befalls a machine, and not to what befalls a command on its way; its boxes do not slip.
    pub fn fits(self, entry: &Entry, spot: Spot) -> bool {
        let is_of_line = matches!(spot.0, "Belt" | "Pusher" | "Robot")
            && entry.place != "command-link"
            && !["part-slip", "x-boxes-stick"].contains(&entry.effect);
        self != Site::Line || is_of_line
    }

    /// Its plant as it is designed, with something for each of the rig's devices `wanted`.
    pub fn design(self, wanted: &[&str], seed: u64) -> Design {
        match self {
            Site::Rig => Design::Rig(RigParameters::nominal()),
            Site::Drawn => Design::Drawn(Drawn::draw(wanted, &mut Dice::new(seed, 7))),
            Site::Line => Design::Line(Line::designed(&mut Dice::new(seed, 7))),
        }
    }
}

/// A plant as it is designed.
#[derive(Clone, Debug)]
pub enum Design {
    Rig(RigParameters),
    Drawn(Drawn),
    Line(Line),
}

impl Design {
    /// The designed machine.
    pub fn machine(&self) -> &dyn Machine {
        match self {
            Design::Rig(rig) => rig,
            Design::Drawn(drawn) => drawn,
            Design::Line(line) => line,
        }
    }

    /// As one is built: every measure anywhere within its `tolerance`, a share of itself.
    pub fn built(&self, tolerance: f64, dice: &mut Dice) -> Box<dyn Machine> {
        match self {
            Design::Rig(_) => Box::new(RigParameters::built(tolerance, dice)),
            Design::Drawn(drawn) => Box::new(drawn.built(tolerance, dice)),
            Design::Line(line) => Box::new(line.built(tolerance, dice)),
        }
    }

    /// Whether its devices touch each other, so that its automation has to see what they do, and what befalls one shows in others.
    pub fn is_connected(&self) -> bool {
        matches!(self, Design::Line(_))
    }

    /// The model that it is diagnosed with: by its name, or a file in the case's folder.
    pub fn model(&self, is_exact: bool) -> &'static str {
        match self {
            Design::Rig(_) if is_exact => "models/rig",
            Design::Rig(_) => "models/rig-toleranced",
            Design::Drawn(_) => "plant.xml",
            Design::Line(_) => "models/depalletizer",
        }
    }

    /// The model's file, where the case's folder is to hold it.
    pub fn xml(&self, tolerance: f64) -> Option<String> {
        match self {
            Design::Rig(_) | Design::Line(_) => None,
            Design::Drawn(drawn) => Some(drawn.xml(tolerance)),
        }
    }
}
