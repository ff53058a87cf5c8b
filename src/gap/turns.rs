//! Parts that turn in a beam, or next to it: a few millimetres decide whether a barrier shows that.

use super::cost;
use super::prediction::Turn;
use super::score::EdgeScore;

/// Weighs predicted pulses that nobody recorded by how deep they go beside how well that is known. A part that comes to a beam and turns there is
/// in it by v·T/4 at most, where it was at v at the beam and is back there after T, its speed changing evenly; where it is, is known to v·u with
/// the edges' uncertainty u. So T/(4·u) standard deviations hide such a pulse.
pub(super) fn weigh_unrecorded(edges: &mut [EdgeScore]) {
    for at in 1..edges.len() {
        let [on, off] = &mut edges[at - 1..=at] else { continue };
        let both = on.predicted.zip(off.predicted).filter(|_| on.recorded.is_none() && off.recorded.is_none());
        let Some(long) = both.map(|(from, until)| until - from).filter(|_| on.to != off.to) else { continue };
        weigh(on, off, long / (4.0 * on.uncertainty.max(off.uncertainty)));
    }
}

/// Weighs recorded pulses that nothing was predicted for by how much further a part had to be that turned next to the beam: what it was short of
/// that, and a·T²/8, by which it is past the beam at most where it is back after T, its belt's speed changing by a. `shifts` is how much further each part was than
/// its first edge said, m, which is known to `tolerance`, m.
pub(super) fn weigh_unforeseen(edges: &mut [EdgeScore], turns: &[Turn], shifts: &[f64], tolerance: f64) {
    for at in 1..edges.len() {
        let [on, off] = &mut edges[at - 1..=at] else { continue };
        let both = on.recorded.zip(off.recorded).filter(|_| on.predicted.is_none() && off.predicted.is_none());
        let Some((came, went)) = both.filter(|_| on.to != off.to) else { continue };
        let long = 0.5 * (went.0 + went.1 - came.0 - came.1);
        let is_here = |turn: &&Turn| turn.to == on.to && (came.0..=went.1).contains(&turn.at);
        let further = |turn: &Turn| {
            let shift = shifts.get(turn.part).copied().unwrap_or(0.0);
            (turn.short - turn.way * shift + 0.125 * turn.slope * long * long).max(0.0)
        };
        let least = turns.iter().filter(is_here).map(further).min_by(f64::total_cmp);
        least.into_iter().for_each(|further| weigh(on, off, further / tolerance));
    }
}

/// Lets both edges of a pulse cost no more than that so many standard deviations hid it.
fn weigh(on: &mut EdgeScore, off: &mut EdgeScore, deep: f64) {
    let cost = (0.5 * deep * deep).min(cost::unmatched());
    for edge in [on, off] {
        edge.cost = edge.cost.min(cost);
        edge.residual = edge.residual.signum() * edge.cost.sqrt();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn alone(to: f64, recorded: Option<(f64, f64)>, predicted: Option<f64>, uncertainty: f64) -> EdgeScore {
        let cost = cost::unmatched();
        EdgeScore { to, recorded, predicted, error: 0.0, uncertainty, cost, residual: -cost.sqrt() }
    }

    fn sum(edges: [EdgeScore; 2]) -> f64 {
        edges.iter().for_each(|edge| assert!((edge.residual + edge.cost.sqrt()).abs() < 1e-12));
        edges[0].cost + edges[1].cost
    }

    /// A part that should turn in a beam for 0.4 s, its place known to what takes 0.05 s: two standard deviations hide that; one that
    /// passes it is missed, and so is one that is recorded alone.
    #[test]
    fn how_deep_a_part_turns_in_a_beam_weighs_that_nobody_saw_it() {
        let edge = |at: f64, to: f64, uncertainty: f64| alone(to, None, Some(at), uncertainty);
        let cost_of = |mut edges: [EdgeScore; 2]| {
            weigh_unrecorded(&mut edges);
            sum(edges)
        };
        assert!((cost_of([edge(3.0, 1.0, 0.05), edge(3.4, 0.0, 0.05)]) - 4.0).abs() < 1e-9);
        assert_eq!(cost_of([edge(3.0, 1.0, 0.01), edge(3.4, 0.0, 0.01)]), 2.0 * cost::unmatched());
        let mut recorded = [edge(3.0, 1.0, 0.05), EdgeScore { recorded: Some((3.3, 3.4)), ..edge(3.4, 0.0, 0.05) }];
        weigh_unrecorded(&mut recorded);
        assert_eq!(recorded[0].cost, cost::unmatched());
    }

    /// Out of the beam for 0.2 s at 0.4 m/s²: 2 mm, and the model's part turned 3 mm before it would have left it. What is known to 2.5 mm is two
    /// standard deviations off; where the part was 2 mm further, 1.2, and 2 mm nearer, or with no turn there, it is missed.
    #[test]
    fn how_near_a_part_turned_weighs_that_it_was_seen_to_leave() {
        let turn = Turn { at: 3.1, part: 1, to: 0.0, short: 0.003, slope: 0.4, way: 1.0 };
        let cost_of = |turns: &[Turn], shift: f64, tolerance: f64| {
            let mut edges = [alone(0.0, Some((2.98, 3.0)), None, 1e-3), alone(1.0, Some((3.18, 3.2)), None, 1e-3)];
            weigh_unforeseen(&mut edges, turns, &[0.0, shift], tolerance);
            sum(edges)
        };
        assert!((cost_of(&[turn], 0.0, 0.0025) - 4.0).abs() < 1e-9);
        assert!((cost_of(&[turn], 0.002, 0.0025) - 1.44).abs() < 1e-9);
        assert!((cost_of(&[Turn { way: -1.0, ..turn }], -0.002, 0.0025) - 1.44).abs() < 1e-9);
        let missed = 2.0 * cost::unmatched();
        assert_eq!(cost_of(&[turn], -0.002, 0.001), missed);
        assert_eq!(cost_of(&[Turn { at: 3.3, ..turn }, Turn { to: 1.0, ..turn }], 0.0, 0.0025), missed);
    }
}
