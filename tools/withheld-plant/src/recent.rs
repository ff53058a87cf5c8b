//! What was computed last, for when it is asked for again.

use std::cell::RefCell;
use std::rc::Rc;

/// The results of the last few questions: a run that is asked for again is not run again.
#[derive(Debug)]
pub struct Recent<K, V> {
    most: usize,
    /// What was asked for last is the last.
    known: RefCell<Vec<(K, Rc<V>)>>,
}

impl<K: PartialEq, V> Recent<K, V> {
    /// Of at most so many questions.
    pub fn new(most: usize) -> Recent<K, V> {
        Recent { most, known: RefCell::default() }
    }

    /// What `key` was answered with, or is by `answer`, which may ask others.
    pub fn get(&self, key: K, answer: impl FnOnce() -> V) -> Rc<V> {
        let value = self.known(&key).unwrap_or_else(|| Rc::new(answer()));
        self.keep(key, value.clone());
        value
    }

    /// The same of what may have no answer; that it has none is not kept.
    pub fn find(&self, key: K, answer: impl FnOnce() -> Option<V>) -> Option<Rc<V>> {
        let value = self.known(&key).or_else(|| answer().map(Rc::new))?;
        self.keep(key, value.clone());
        Some(value)
    }

    /// As if nothing had been asked for.
    #[cfg(test)]
    pub fn forget(&self) {
        self.known.borrow_mut().clear();
    }

    /// Takes out what is known of `key`.
    fn known(&self, key: &K) -> Option<Rc<V>> {
        let place = self.known.borrow().iter().position(|(known, _)| known == key)?;
        Some(self.known.borrow_mut().remove(place).1)
    }

    fn keep(&self, key: K, value: Rc<V>) {
        let mut known = self.known.borrow_mut();
        known.push((key, value));
        let beyond = known.len().saturating_sub(self.most);
        known.drain(..beyond);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_asked_for_lately_is_not_computed_again() {
        let (recent, asked) = (Recent::new(2), RefCell::new(Vec::new()));
        let ask = |key: u32| {
            let answer = || {
                asked.borrow_mut().push(key);
                key * key
            };
            *recent.get(key, answer)
        };
        assert_eq!([2, 3, 2, 4, 2, 3].map(ask), [4, 9, 4, 16, 4, 9]);
        assert_eq!(*asked.borrow(), [2, 3, 4, 3]);
    }
}
