//! What is told in proportion, for a sensor that reads a multiple and a number that is sent in another unit.

use super::site::Site;
use crate::device::law::encoder::SAME_COUNT;
use crate::device::path::{Moment, Stage};

/// y = factor·x; of a count the whole number next to it.
#[derive(Clone, Debug)]
pub(super) struct Proportion {
    factor: f64,
    is_whole: bool,
    /// Whether parts of a count pass, which are no part of what is multiplied.
    is_fine: bool,
}

impl Proportion {
    pub fn stage(factor: f64, site: &Site) -> Box<dyn Stage> {
        Box::new(Proportion { factor, is_whole: site.is_whole(), is_fine: false })
    }
}

impl Stage for Proportion {
    fn boxed(&self) -> Box<dyn Stage> {
        Box::new(self.clone())
    }

    fn stretch(&self) -> f64 {
        f64::INFINITY
    }

    fn count_finely(&mut self) {
        self.is_fine = self.is_whole;
    }

    fn signal(&mut self, value: f64, _moment: Moment) -> f64 {
        let count = if self.is_fine { (value + SAME_COUNT).floor() } else { value };
        let told = self.factor * count;
        // The part of a count is told as it is, once.
        if self.is_whole { told.round() + (value - count) } else { told }
    }

    fn state(&self, _visit: &mut dyn FnMut(f64)) {}
}

#[cfg(test)]
mod tests {
    use crate::effect::bench::{spec, with};

    /// Of 31.75 counts 31 are told as 28, and as 28.75 where parts of a count pass.
    #[test]
    fn a_count_is_multiplied_and_the_part_of_one_is_not() {
        let told = |is_fine: bool| {
            let gain = spec("sensor", "gain", Some("encoder"), &[("gain", 0.9)]);
            let mut motor = with("EncoderMotor", &[("countsPerRevolution", "1000"), ("acceleration", "1000")], &[gain]);
            if is_fine {
                motor.device.count_finely();
            }
            motor.check(&[("enable", 1.0), ("speedTarget", 1.0)], 0.2, &[]);
            motor.report("encoder")
        };
        // After a ramp of a millisecond 0.1995 rad are 31.75 counts.
        let passed: f64 = 0.1995 * 1000.0 / std::f64::consts::TAU;
        let whole = (0.9 * passed.floor()).round();
        assert_eq!(told(false), whole);
        assert!((told(true) - whole - passed.fract()).abs() < 1e-9, "{}", told(true));
    }
}
