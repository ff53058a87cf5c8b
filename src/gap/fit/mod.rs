//! Parameters are fitted: from several starts, downhill, and with the interval in which they lie.
//!
//! What is minimised is a deviance: the sum of the squares of the residuals that the caller's model gives, each of which is a
//! signed square root of −2·ln of a likelihood ratio. So a rise of the least sum by 3.84 is the end of an interval of 95 %.

mod evolution;
mod least_squares;
mod profile;
mod rugged;
mod search;
mod simplex;
mod walkers;

pub use evolution::evolve;
pub use least_squares::{Slopes, least_squares, least_squares_from};
pub use profile::{Interval, Side, profile};
pub use rugged::rugged;
pub use search::{Effort, search};
pub use simplex::simplex;
pub use walkers::{Spread, spread};

/// The residuals of a model at its parameters: as many at every point. `None` where the model cannot be computed there, or
/// where whoever asked no longer wants to know.
pub type Residuals<'a> = dyn Fn(&[f64]) -> Option<Vec<f64>> + Sync + 'a;

/// What a parameter may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    pub least: f64,
    pub greatest: f64,
    /// A change that matters: the search begins with steps of this order. Above 0.
    pub scale: f64,
}

impl Range {
    pub fn clamp(&self, value: f64) -> f64 {
        value.clamp(self.least, self.greatest)
    }
}

/// Where a search ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    pub at: Vec<f64>,
    /// The sum of the squares of the residuals there.
    pub cost: f64,
    /// How much the cost rises with the square of each parameter's change alone, and with the products: Jᵀ·J, row by row.
    /// Empty where the search knew no derivatives.
    pub curvature: Vec<f64>,
    /// How often the model was computed.
    pub evaluations: u32,
}

impl Fitted {
    /// How far a parameter may go, the others kept, until the cost has risen by 1; infinite where it changes nothing.
    pub fn spread(&self, parameter: usize) -> f64 {
        let along = self.curvature.get(parameter * (self.at.len() + 1)).copied().unwrap_or_default();
        if along > 0.0 { along.sqrt().recip() } else { f64::INFINITY }
    }
}

/// The sum of the squares.
pub fn sum_of_squares(residuals: &[f64]) -> f64 {
    residuals.iter().map(|residual| residual * residual).sum()
}
