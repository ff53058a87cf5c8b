//! A speed that follows another no more steeply than friction lets it: what slips.

/// Something dragged along by a driver through friction that can accelerate it by so much.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Follower {
    velocity: f64,
    /// The driver's speed when it was last seen.
    driver: f64,
}

impl Follower {
    /// How far it moved while its driver moved by `way` within `span` and came to `velocity`. While it does not slip it moves
    /// exactly with its driver; while it does, its speed tends to the driver's with the slope `acceleration`.
    pub fn follow(&mut self, way: f64, velocity: f64, span: f64, acceleration: f64) -> f64 {
        if span <= 0.0 {
            return way;
        }
        let most = acceleration * span;
        let grips = self.velocity == self.driver && (velocity - self.driver).abs() <= most * (1.0 + 1e-9);
        self.driver = velocity;
        if grips {
            self.velocity = velocity;
            return way;
        }
        let before = self.velocity;
        self.velocity = before + (velocity - before).clamp(-most, most);
        0.5 * (before + self.velocity) * span
    }

    /// How fast it is.
    pub fn velocity(&self) -> f64 {
        self.velocity
    }

    pub fn state(&self, visit: &mut dyn FnMut(f64)) {
        visit(self.velocity);
        visit(self.driver);
    }
}
