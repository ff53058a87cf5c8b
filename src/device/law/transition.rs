//! The motion of a servo's loop over a span of a length that comes again and again: found once, and then a product.
//!
//! Where nothing limits the drive, or where it is at a limit all the time, position, velocity and integrator y = (x, v, i) follow
//! y' = A·y + b with b constant, so that
//!
//! ```text
//! y(t) = y(0) + Φ(t)·y'(0),   Φ(t) = ∫₀ᵗ exp(A·s) ds = Σ Aᵏ·tᵏ⁺¹ / (k + 1)!
//! ```
//!
//! (C. F. Van Loan, Computing integrals involving the matrix exponential, IEEE Transactions on Automatic Control 23, 1978.)
//! Φ depends on the loop and on t alone, and a machine is looked at and told at spans that hardly change.

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

use super::taylor::ORDER;

/// How many spans are known at once: a command between two looks makes two, and a stage may have a loop of its own.
const KNOWN: usize = 4;

/// The share of a sum that its last term may have: less than rounding makes of it.
const NEGLIGIBLE: f64 = 1e-17;

/// A linear system that a drive moves, and a span of time: what Φ depends on. Its state has `STATES` components.
pub trait System<const STATES: usize>: Copy + PartialEq {
    /// s, no longer than a series of [`ORDER`] is good for.
    fn span(&self) -> f64;

    /// A of y' = A·y + b.
    fn matrix(&self) -> SMatrix<f64, STATES, STATES>;

    /// By how much at most the demand of the drive changes for each unit by which a component of y does, at least 0.
    fn demand(&self) -> SVector<f64, STATES>;
}

/// A servo's loop.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Linear {
    /// s.
    pub span: f64,
    /// The force that the loop takes back for each unit of position and of velocity, and what else opposes velocity.
    pub position_gain: f64,
    pub velocity_gain: f64,
    pub damping: f64,
    pub inertia: f64,
    /// 1 / the integrator's time, 1/s; 0 where there is none.
    pub reset: f64,
    /// Whether the drive exerts what its loop demands, and not a constant force.
    pub is_free: bool,
}

impl Linear {
    /// What position, velocity and integrator add to the force that moves the axis.
    pub(super) fn forces(&self) -> [f64; 3] {
        let Linear { position_gain, velocity_gain, damping, .. } = *self;
        if self.is_free { [-position_gain, -velocity_gain - damping, 1.0] } else { [0.0, -damping, 0.0] }
    }

    /// What they add to the rate of the integrator.
    pub(super) fn resets(&self) -> [f64; 3] {
        let Linear { position_gain, velocity_gain, reset, .. } = *self;
        let of_force = if self.is_free { [-position_gain, -velocity_gain, 0.0] } else { [0.0, 0.0, -1.0] };
        of_force.map(|force| force * reset)
    }
}

impl System<3> for Linear {
    fn span(&self) -> f64 {
        self.span
    }

    fn matrix(&self) -> Matrix3<f64> {
        let rows = [[0.0, 1.0, 0.0], self.forces().map(|force| force / self.inertia), self.resets()];
        Matrix3::from_fn(|row, column| rows[row][column])
    }

    fn demand(&self) -> Vector3<f64> {
        Vector3::new(self.position_gain, self.velocity_gain, 1.0)
    }
}

/// What is known of one of them.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Known<S, const STATES: usize> {
    system: S,
    /// `None` after it was met for the first time: what comes once is not worth it.
    transition: Option<Transition<STATES>>,
}

/// Φ of a system over a span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transition<const STATES: usize> {
    integral: SMatrix<f64, STATES, STATES>,
    /// How far the demand moves within the span, at most, for each unit of the magnitudes of the components of y'(0).
    reach: SVector<f64, STATES>,
}

/// The transitions of the spans that came last.
#[derive(Clone, Debug)]
pub struct Transitions<S = Linear, const STATES: usize = 3> {
    known: [Option<Known<S, STATES>>; KNOWN],
    oldest: usize,
}

impl<S: Copy, const STATES: usize> Default for Transitions<S, STATES> {
    fn default() -> Self {
        Transitions { known: [None; KNOWN], oldest: 0 }
    }
}

impl<S: System<STATES>, const STATES: usize> Transitions<S, STATES> {
    /// The transition of `system`, from the second time on that it is asked for.
    pub fn of(&mut self, system: S) -> Option<&Transition<STATES>> {
        match self.known.iter().position(|known| known.as_ref().is_some_and(|known| known.system == system)) {
            Some(place) => {
                let known = self.known[place].as_mut()?;
                Some(known.transition.get_or_insert_with(|| Transition::new(&system)))
            }
            None => {
                self.known[self.oldest] = Some(Known { system, transition: None });
                self.oldest = (self.oldest + 1) % KNOWN;
                None
            }
        }
    }
}

impl<const STATES: usize> Transition<STATES> {
    fn new(system: &impl System<STATES>) -> Self {
        let (span, matrix) = (system.span(), system.matrix());
        // Of y'(s) = exp(A·s)·y'(0), no component is larger than that of exp(|A|·s)·|y'(0)|, each by its magnitude.
        let (bound, terms) = bound(&matrix.abs(), span);
        Transition { integral: integral(&matrix, span, terms), reach: bound.tr_mul(&system.demand()) }
    }

    /// Whether a demand that may move by `margin` either way stays within that all along, where y'(0) is `slopes`.
    pub fn keeps_within(&self, margin: f64, slopes: SVector<f64, STATES>) -> bool {
        self.farthest(slopes) < margin
    }

    fn farthest(&self, slopes: SVector<f64, STATES>) -> f64 {
        self.reach.dot(&slopes.abs())
    }

    /// What is added to y, where y'(0) is `slopes`.
    pub fn change(&self, slopes: SVector<f64, STATES>) -> SVector<f64, STATES> {
        self.integral * slopes
    }
}

/// Φ(t) of a matrix without negative entries, and how many terms of its series are needed. Of a matrix of these magnitudes no term is larger.
fn bound<const STATES: usize>(
    magnitudes: &SMatrix<f64, STATES, STATES>,
    span: f64,
) -> (SMatrix<f64, STATES, STATES>, usize) {
    let mut term = SMatrix::identity() * span;
    let mut sum = term;
    for k in 2..ORDER {
        term = magnitudes * term * (span / k as f64);
        sum += term;
        // What reaches a component by way of all others does so within as many terms.
        if k > STATES && term.iter().zip(&sum).all(|(term, sum)| *term <= NEGLIGIBLE * sum) {
            return (sum, k);
        }
    }
    (sum, ORDER)
}

/// Φ(t) by Horner's rule from the smallest term on: t·(1 + A·t/2·(1 + A·t/3·(…))).
fn integral<const STATES: usize>(
    matrix: &SMatrix<f64, STATES, STATES>,
    span: f64,
    terms: usize,
) -> SMatrix<f64, STATES, STATES> {
    let one = SMatrix::identity();
    (2..=terms).rev().fold(one, |sum, k| one + matrix * sum * (span / k as f64)) * span
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::device::law::servo::{Loop, Mechanics, Servo};

    const LOOP: Linear = Linear {
        span: 0.002,
        position_gain: 20_000.0,
        velocity_gain: 800.0,
        damping: 50.0,
        inertia: 20.0,
        reset: 10.0,
        is_free: true,
    };

    #[test]
    fn what_comes_once_is_not_computed() {
        let mut transitions = Transitions::default();
        for span in [1.0, 2.0, 3.0, 4.0, 5.0, 1.0] {
            assert_eq!(transitions.of(Linear { span: span * 1e-4, ..LOOP }), None, "{span}");
        }
        assert!(transitions.of(Linear { span: 1e-4, ..LOOP }).is_some());
        assert_eq!(transitions.of(Linear { span: 1e-4, inertia: 21.0, ..LOOP }), None, "another loop");
    }

    #[test]
    fn an_undamped_spring_swings_as_sine_and_cosine() {
        // x'' = −ω²·x: Φ is (sin ωt / ω, (1 − cos ωt) / ω²; cos ωt − 1, sin ωt / ω).
        let omega = 30.0_f64;
        let spring =
            Linear { position_gain: omega * omega * 20.0, velocity_gain: 0.0, damping: 0.0, reset: 0.0, ..LOOP };
        let (sine, cosine) = (omega * 0.002).sin_cos();
        let [dx, dv, di] = Transition::new(&spring).change(Vector3::new(3.0, 7.0, 0.0)).into();
        assert!((dx - 3.0 * sine / omega - 7.0 * (1.0 - cosine) / (omega * omega)).abs() < 1e-17, "{dx}");
        assert!((dv - 3.0 * (cosine - 1.0) - 7.0 * sine / omega).abs() < 1e-15, "{dv}");
        assert_eq!(di, 0.0);
    }

    #[test]
    fn a_demand_stays_within_its_bound() {
        let whole = Transition::new(&LOOP);
        let mut tightest = 0.0_f64;
        for slopes in
            [[0.5, -20.0, 300.0], [-0.1, 0.0, -5000.0], [0.0, 90.0, 0.0], [1.0, 90.0, -150_000.0]].map(Vector3::from)
        {
            let greatest = whole.farthest(slopes);
            let demand = |[x, v, i]: [f64; 3]| i - LOOP.position_gain * x - LOOP.velocity_gain * v;
            let moved = (1..=64).map(|part| {
                let span = LOOP.span * f64::from(part) / 64.0;
                demand(Transition::new(&Linear { span, ..LOOP }).change(slopes).into()).abs()
            });
            let farthest = moved.fold(0.0, f64::max);
            assert!(farthest <= greatest, "{farthest} of {greatest}");
            tightest = tightest.max(farthest / greatest);
            assert!(whole.keeps_within(1.01 * greatest, slopes) && !whole.keeps_within(0.99 * greatest, slopes));
        }
        // A bound that is far off would never let anything pass.
        assert!(tightest > 0.3, "{tightest}");
    }

    #[test]
    fn no_more_terms_are_summed_than_count() {
        let terms = [1e-5, 0.002, 0.02].map(|span| {
            let matrix = Linear { span, ..LOOP }.matrix();
            let (bound, terms) = bound(&matrix.abs(), span);
            let missing = integral(&matrix, span, ORDER) - integral(&matrix, span, terms);
            assert!(missing.abs() <= bound * 1e-15, "{missing}");
            terms
        });
        assert!(terms[0] <= ORDER / 2 && terms.is_sorted_by(|few, more| few < more), "{terms:?}");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn an_axis_moves_as_its_series_has_it(
            reference in -5000.0..5000.0_f64, velocity in -1.0..1.0_f64, limit in 10.0..6000.0_f64, span in 1e-4..0.02_f64,
            integral_time in prop::option::of(0.02..1.0_f64),
        ) {
            let drive = Loop { position_gain: 20_000.0, velocity_gain: 800.0, integral_time, limit, back_emf: 0.0 };
            let mechanics = Mechanics { inertia: 20.0, viscous_friction: 50.0, load: 0.0, pendulum: 0.0 };
            let mut series = Servo::new(drive, mechanics);
            series.shift(0.0, velocity);
            let mut again = series;
            let mut transitions = Transitions::default();
            for step in 0..60 {
                let reference = if step / 10 % 2 == 0 { reference } else { -reference };
                (series.reference, again.reference) = (reference, reference);
                series.advance(span);
                again.advance_again(span, &mut transitions);
                let close = |ours: f64, theirs: f64, bound: f64| (ours - theirs).abs() < bound;
                prop_assert!(close(again.position(), series.position(), 1e-12), "{again:?} {series:?}");
                prop_assert!(close(again.velocity(), series.velocity(), 1e-10), "{again:?} {series:?}");
                prop_assert!(close(again.force(), series.force(), 1e-7), "{again:?} {series:?}");
            }
        }
    }
}
