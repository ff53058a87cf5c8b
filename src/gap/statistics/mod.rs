//! What the residuals of one trace can tell, and what they cannot: blocks drawn anew, correlation, bins, thresholds.

mod blocks;
mod correlation;
mod dependence;
mod share;
mod threshold;

pub use blocks::{Draws, quantile, span, standing_out, wins};
pub use correlation::{effective_number, inflation, lag_one};
pub use dependence::{binned_share, rank_correlation};
pub use share::wilson;
pub use threshold::{SAME_CLASS, least_gain};
