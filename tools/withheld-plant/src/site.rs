//! Which plant a case is of.

use clap::ValueEnum;

use crate::chance::Dice;
use crate::drawn::Drawn;
use crate::machine::Machine;
use crate::rig::RigParameters;

/// The plant of one case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Site {
    /// `models/rig-toleranced`
    Rig,
    /// A plant of its own, drawn at random.
    Drawn,
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
}

impl Sites {
    /// The plant of the `index`th case that is planned. Of all cases three in ten are of plants drawn at random.
    pub fn site(self, index: usize) -> Site {
        match self {
            Sites::Rig => Site::Rig,
            Sites::Drawn => Site::Drawn,
            // As many even as odd ones: what is clear or gross goes by that.
            Sites::All if [1, 4, 7, 10, 13, 18].contains(&(index % 20)) => Site::Drawn,
            Sites::All => Site::Rig,
        }
    }
}

impl Site {
    /// Its plant as it is designed, with something for each of the rig's devices `wanted`.
    pub fn design(self, wanted: &[&str], seed: u64) -> Design {
        match self {
            Site::Rig => Design::Rig(RigParameters::nominal()),
            Site::Drawn => Design::Drawn(Drawn::draw(wanted, &mut Dice::new(seed, 7))),
        }
    }
}

/// A plant as it is designed.
#[derive(Clone, Debug)]
pub enum Design {
    Rig(RigParameters),
    Drawn(Drawn),
}

impl Design {
    /// The designed machine.
    pub fn machine(&self) -> &dyn Machine {
        match self {
            Design::Rig(rig) => rig,
            Design::Drawn(drawn) => drawn,
        }
    }

    /// As one is built: every measure anywhere within its `tolerance`, a share of itself.
    pub fn built(&self, tolerance: f64, dice: &mut Dice) -> Box<dyn Machine> {
        match self {
            Design::Rig(_) => Box::new(RigParameters::built(tolerance, dice)),
            Design::Drawn(drawn) => Box::new(drawn.built(tolerance, dice)),
        }
    }

    /// The model that it is diagnosed with: by its name, or a file in the case's folder.
    pub fn model(&self, is_exact: bool) -> &'static str {
        match self {
            Design::Rig(_) if is_exact => "models/rig",
            Design::Rig(_) => "models/rig-toleranced",
            Design::Drawn(_) => "plant.xml",
        }
    }

    /// The model's file, where the case's folder is to hold it.
    pub fn xml(&self, tolerance: f64) -> Option<String> {
        match self {
            Design::Rig(_) => None,
            Design::Drawn(drawn) => Some(drawn.xml(tolerance)),
        }
    }
}
