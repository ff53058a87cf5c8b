//! The first part of what was recorded of a device: where a search may begin, at a part of what a replay of all takes.

use std::sync::Arc;

use super::grid::Grid;
use super::subject::{Run, Subject};
use super::track::Track;

impl Subject {
    /// The same device in the first `share` of each of its runs, 0 to 1.
    pub(super) fn early(&self, share: f64) -> Subject {
        Subject { runs: self.runs.iter().map(|run| until(run, share * run.ends)).collect(), ..self.clone() }
    }
}

/// A run up to an instant, s.
fn until(run: &Run, ends: f64) -> Run {
    // Tracks of one grid are looked at together: they stay so.
    let mut grids: Vec<(Arc<Grid>, Arc<Grid>)> = Vec::new();
    let mut cut = |grid: &Arc<Grid>| match grids.iter().find(|(whole, _)| Arc::ptr_eq(whole, grid)) {
        Some((_, early)) => Arc::clone(early),
        None => {
            let count = grid.instants.partition_point(|at| *at <= ends);
            let early = Arc::new(Grid { instants: grid.instants[..count].to_vec(), ..Grid::clone(grid) });
            grids.push((Arc::clone(grid), Arc::clone(&early)));
            early
        }
    };
    let tracks = run.tracks.iter().map(|track| track.as_ref().map(|track| first_of(track, cut(&track.grid)))).collect();
    let commands = run.commands.iter().filter(|(_, told)| told.at <= ends).copied().collect();
    Run { ends, commands, tracks, ..run.clone() }
}

/// A track as far as a grid goes that is the beginning of its own.
fn first_of(track: &Track, grid: Arc<Grid>) -> Track {
    let count = grid.instants.len();
    let edges = track.edges.iter().filter(|edge| edge.index < count).copied().collect::<Vec<_>>();
    let of = |values: &[f64]| values[..values.len().min(count.saturating_sub(track.first))].to_vec();
    let origins = track.origins[..track.origins.len().min(edges.len())].to_vec();
    Track { values: of(&track.values), edges, origins, grid, ..track.clone() }
}

#[cfg(test)]
mod tests {
    use crate::gap::recorded_tests::{RUBBING_AXIS, study};
    use crate::gap::{Overrides, Predicted};

    /// Every device of a recorded rig does in its first third what it does in the first third of all.
    #[test]
    fn what_a_device_does_at_first_it_does_without_the_rest() {
        let study = study(RUBBING_AXIS);
        let (mut levels, mut edges_seen) = (0, 0);
        for whole in &study.subjects {
            let early = whole.early(1.0 / 3.0);
            assert!(3.0 * early.runs[0].ends - whole.runs[0].ends < 1e-9);
            let [all, first] = [whole, &early].map(|of| of.predict(&[], &Overrides::none()).expect("it is built"));
            let tracks = whole.runs[0].tracks.iter().zip(&early.runs[0].tracks);
            for ((whole, early), (all, first)) in tracks.zip(all.runs[0].iter().zip(&first.runs[0])) {
                let (Some(whole), Some(early)) = (whole, early) else { continue };
                let count = early.grid.instants.len();
                assert!(count > 0 && 3 * count <= whole.grid.instants.len() + 3);
                match (all, first) {
                    (Predicted::Level(all), Predicted::Level(first)) => {
                        levels += 1;
                        assert_eq!(first.len(), early.values.len());
                        assert_eq!(
                            (&all[..first.len()], &whole.values[..first.len()]),
                            (&first[..], &early.values[..])
                        );
                    }
                    (Predicted::Edges { edges: all, .. }, Predicted::Edges { edges: first, .. }) => {
                        edges_seen += first.len();
                        let seen = all.iter().filter(|edge| edge.index < count).map(|edge| (edge.index, edge.to));
                        assert_eq!(seen.collect::<Vec<_>>(), first.iter().map(|e| (e.index, e.to)).collect::<Vec<_>>());
                    }
                    _ => {}
                }
            }
        }
        assert!(levels > 3 && edges_seen > 0, "{levels} {edges_seen}");
    }
}
