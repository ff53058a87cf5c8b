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
    /// The state at the track's first instant, and its changes that a look at each instant of the grid would show; and the pulses
    /// within a cycle, which none shows; and where a part nearly made one more.
    Edges { initial: f64, edges: Vec<PredictedEdge>, unseen: Vec<Pulse>, turns: Vec<Turn> },
}

/// A state that came and went between two looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pulse {
    /// When it came, s.
    pub from: f64,
    /// When the state before was back, s.
    pub until: f64,
    /// What the signal was in between.
    pub to: f64,
}

/// A belt turned when an edge of a part was about to come to a beam, or to leave it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// When, s.
    pub at: f64,
    /// Which of the run's parts.
    pub part: usize,
    /// What the beam would have become.
    pub to: f64,
    /// How far the edge was from the beam, m.
    pub short: f64,
    /// How steeply the belt's speed changed, m/s².
    pub slope: f64,
    /// 1 if the part was on its way through the beam as it first came, -1 if on its way back.
    pub way: f64,
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
    /// How fast it passes, m/s, below 0 on its way back: a part that is further by δ makes the edge sooner by δ / speed.
    pub speed: f64,
    /// How far it may be from where it is taken to be, beside what all of its edges share, m: a belt that has a gap of its own
    /// carried it.
    pub astray: f64,
}

/// How far an edge has to be moved to be another one, s: instants of reports are known no better.
const SAME_EDGE_S: f64 = 1e-5;

impl Predicted {
    /// Lets what comes at an instant of its own come so much sooner, s.
    pub(super) fn come_sooner(&mut self, by: f64) {
        let Predicted::Edges { edges, unseen, turns, .. } = self else { return };
        edges.iter_mut().for_each(|edge| edge.at -= by);
        unseen.iter_mut().for_each(|pulse| (pulse.from, pulse.until) = (pulse.from - by, pulse.until - by));
        turns.iter_mut().for_each(|turn| turn.at -= by);
    }

    /// Whether another prediction of the same signal says something else: a level by more than `level`, RMS, in its unit; a state in
    /// where it begins, or in an edge's direction or instant.
    pub(super) fn differs(&self, other: &Predicted, level: f64) -> bool {
        match (self, other) {
            (Predicted::Level(one), Predicted::Level(other)) => {
                let squares: f64 = one.iter().zip(other).map(|(a, b)| (a - b).powi(2)).sum();
                (squares / one.len().max(1) as f64).sqrt() > level
            }
            (
                Predicted::Edges { initial, edges, .. },
                Predicted::Edges { initial: other_initial, edges: others, .. },
            ) => {
                let is_another =
                    |(a, b): (&PredictedEdge, &PredictedEdge)| a.to != b.to || (a.at - b.at).abs() > SAME_EDGE_S;
                initial != other_initial || edges.len() != others.len() || edges.iter().zip(others).any(is_another)
            }
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn state(initial: f64, edges: &[(f64, f64)]) -> Predicted {
        let edge = |(at, to): &(f64, f64)| PredictedEdge { at: *at, index: 0, to: *to, part: None };
        Predicted::Edges { initial, edges: edges.iter().map(edge).collect(), unseen: Vec::new(), turns: Vec::new() }
    }

    #[test]
    fn an_inverted_state_is_another_one_though_its_edges_come_when_they_did() {
        let switch = state(0.0, &[(1.0, 1.0), (2.0, 0.0)]);
        assert!(switch.differs(&state(1.0, &[(1.0, 0.0), (2.0, 1.0)]), 0.1));
        assert!(switch.differs(&state(0.0, &[(1.0, 0.0), (2.0, 1.0)]), 0.1));
        assert!(switch.differs(&state(0.0, &[(1.001, 1.0), (2.0, 0.0)]), 0.1));
        assert!(switch.differs(&state(0.0, &[(1.0, 1.0)]), 0.1));
        assert!(!switch.differs(&state(0.0, &[(1.000_001, 1.0), (2.0, 0.0)]), 0.1));
    }

    #[test]
    fn a_level_is_another_one_beyond_what_it_may_differ_by() {
        let level = Predicted::Level(vec![0.0, 1.0, 2.0]);
        assert!(level.differs(&Predicted::Level(vec![0.2, 1.2, 2.2]), 0.1));
        assert!(!level.differs(&Predicted::Level(vec![0.05, 1.05, 2.05]), 0.1));
        assert!(!level.differs(&Predicted::Nothing, 0.1));
    }
}
