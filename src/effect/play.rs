//! The play operator: an output that is dragged along by an input with a gap between them (M. A. Krasnosel'skii,
//! A. V. Pokrovskii, Systems with Hysteresis, Springer 1989, section 2).

/// An output in the middle of its gap to begin with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Play {
    /// The whole gap, from one flank to the other.
    gap: f64,
    output: Option<f64>,
}

impl Play {
    pub fn new(gap: f64) -> Play {
        Play { gap, output: None }
    }

    /// The output.
    pub fn pass(&mut self, input: f64) -> f64 {
        let half = 0.5 * self.gap;
        let before = *self.output.get_or_insert(input);
        let output = before.clamp(input - half, input + half);
        self.output = Some(output);
        output
    }

    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        self.output.into_iter().for_each(visit);
    }
}
