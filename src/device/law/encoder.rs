//! An encoder that counts an angle.

use std::f64::consts::TAU;

/// An encoder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Encoder {
    /// Counts in one turn.
    pub counts_per_revolution: f64,
    /// Bits of its count, 1 to 31, which then runs from 0 up; `None`: a DINT, from -2³¹ to 2³¹ - 1.
    pub bits: Option<u32>,
}

/// How close below a whole count an angle counts as on it. Rounding of the angle is a thousandth of this after hours of
/// motion; without it a motor that returned to 0 would stand at -1 or 0 by chance.
pub const SAME_COUNT: f64 = 1e-6;

impl Encoder {
    /// How many counts, parts of one too, have passed at `angle`, rad, since angle 0.
    pub fn passed(&self, angle: f64) -> f64 {
        angle * self.counts_per_revolution / TAU
    }

    /// The count at `angle`, rad: floor(angle · counts / 2π), for negative angles too, wrapped into its range.
    pub fn count(&self, angle: f64) -> f64 {
        let whole = (self.passed(angle) + SAME_COUNT).floor();
        match self.bits {
            Some(bits) => whole.rem_euclid(f64::from(1_u32 << bits)),
            None => (whole + TWO_31).rem_euclid(2.0 * TWO_31) - TWO_31,
        }
    }

    /// Of the angles with this count, rad, the one nearest to `near`.
    pub fn angle_near(&self, count: f64, near: f64) -> f64 {
        let range = self.bits.map_or(2.0 * TWO_31, |bits| f64::from(1_u32 << bits));
        let turns = ((self.passed(near) - count) / range).round();
        (count + turns * range) * TAU / self.counts_per_revolution
    }
}

const TWO_31: f64 = 2_147_483_648.0;

#[cfg(test)]
mod tests {
    use super::*;

    fn check(bits: Option<u32>, counts: f64, expected: f64) {
        let encoder = Encoder { counts_per_revolution: 4096.0, bits };
        assert_eq!(encoder.count(counts * TAU / 4096.0), expected, "{counts} with {bits:?}");
    }

    #[test]
    fn floor_for_negatives_too() {
        check(None, 0.0, 0.0);
        check(None, 0.5, 0.0);
        check(None, 1.5, 1.0);
        check(None, -0.5, -1.0);
        check(None, -1.5, -2.0);
    }

    #[test]
    fn a_whole_count_does_not_hang_on_rounding() {
        for whole in [-4096.0, -7.0, -1.0, 0.0, 1.0, 3.0, 4096.0, 1e9] {
            check(None, whole - 1e-8, whole);
            check(None, whole + 1e-8, whole);
        }
        check(None, -1e-5, -1.0);
    }

    #[test]
    fn it_wraps_as_a_dint() {
        check(None, TWO_31 - 1.0, TWO_31 - 1.0);
        check(None, TWO_31, -TWO_31);
        check(None, TWO_31 + 5.0, -TWO_31 + 5.0);
        check(None, -TWO_31 - 1.0, TWO_31 - 1.0);
        check(None, 4.0 * TWO_31 + 3.0, 3.0);
    }

    #[test]
    fn an_angle_is_known_from_its_count_and_about_where_it_is() {
        for bits in [None, Some(8), Some(13)] {
            let encoder = Encoder { counts_per_revolution: 1000.0, bits };
            for whole in [-70_001.0, -3.0, 0.0, 127.0, 128.0, 50_000.0] {
                let angle = whole * TAU / 1000.0;
                let found = encoder.angle_near(encoder.count(angle), angle + 0.7);
                assert!((found - angle).abs() < 1e-9, "{whole} with {bits:?}: {found}");
            }
        }
    }

    #[test]
    fn fewer_bits_count_from_0_up() {
        check(Some(12), 4095.0, 4095.0);
        check(Some(12), 4096.0, 0.0);
        check(Some(12), -1.0, 4095.0);
        check(Some(31), TWO_31, 0.0);
    }
}
