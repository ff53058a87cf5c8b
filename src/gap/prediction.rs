//! What a device alone is predicted to report.

/// What is predicted of a subject: run by run, in each signal by signal, in the orders of
/// [`Subject::runs`](super::Subject::runs) and [`Subject::signals`](super::Subject::signals).
#[derive(Clone, Debug, PartialEq)]
pub struct Prediction {
    pub runs: Vec<Vec<Predicted>>,
}

/// What is predicted of one signal in one run.
#[derive(Clone, Debug, PartialEq)]
pub enum Predicted {
    /// The trace does not hold the signal.
    Nothing,
    /// Before all rounding, SI, at each instant of its track from its first.
    Level(Vec<f64>),
    /// The state at the track's first instant, and its changes that a look at each instant of the grid would show: a pulse
    /// within a cycle is not among them.
    Edges { initial: f64, edges: Vec<PredictedEdge> },
}

/// A change of a predicted state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PredictedEdge {
    /// When, s: not rounded to the grid.
    pub at: f64,
    /// The grid's instant that shows it first.
    pub index: usize,
    /// What the signal becomes.
    pub to: f64,
    /// Whose passing makes it.
    pub part: Option<Passing>,
}

/// The part that makes an edge of a light barrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Passing {
    /// Which of the run's parts.
    pub part: usize,
    /// How fast it passes, m/s: a part that is further by δ makes the edge sooner by δ / speed.
    pub speed: f64,
    /// How far it may be from where it is taken to be, beside what all of its edges share, m: a belt that has a gap of its own
    /// carried it.
    pub astray: f64,
}
