//! The latest replays of a device: a search asks again and again for where it began and where it ended.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

use crate::gap::{Overrides, Prediction};
use crate::plant::EffectSpec;

/// How many are kept: as many as a search has ends and starts, and as another that runs at the same time.
const KEPT: usize = 24;

/// What a device was replayed with, and what it then predicted.
type Replay = (Vec<EffectSpec>, Overrides, Arc<Prediction>);

/// The latest replays, the latest last.
#[derive(Default)]
pub struct Latest(Mutex<VecDeque<Replay>>);

impl Latest {
    /// What the device predicts with `specs` and `overrides`: as known, or from `replay`. `None` where that gives none.
    pub fn or_replay(
        &self,
        specs: Vec<EffectSpec>,
        overrides: Overrides,
        replay: impl FnOnce(&[EffectSpec], &Overrides) -> Option<Prediction>,
    ) -> Option<Arc<Prediction>> {
        let is_this = |known: &&Replay| known.0 == specs && known.1 == overrides;
        let known = self.lock().iter().rev().find(is_this).map(|known| known.2.clone());
        if known.is_some() {
            return known;
        }
        // Not locked meanwhile: others replay at the same time.
        let prediction = Arc::new(replay(&specs, &overrides)?);
        let mut latest = self.lock();
        if latest.len() == KEPT {
            latest.pop_front();
        }
        latest.push_back((specs, overrides, prediction.clone()));
        Some(prediction)
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, VecDeque<Replay>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_known_is_not_replayed_until_it_is_forgotten() {
        let latest = Latest::default();
        let mut replays = 0;
        let mut ask = |value: f64| {
            let overrides = Overrides([("radius".to_owned(), value)].into_iter().collect());
            latest.or_replay(Vec::new(), overrides, |_, _| {
                replays += 1;
                Some(Prediction { runs: Vec::new() })
            });
            replays
        };
        assert_eq!([ask(1.0), ask(2.0), ask(1.0), ask(2.0)], [1, 2, 2, 2]);
        for value in 0..KEPT {
            ask(10.0 + value as f64);
        }
        assert_eq!(ask(1.0), 3 + KEPT);
    }
}
