//! By how much a barrier sees every part for less of its way than it is long: that is its sensor. Other hands take parts out of a beam, or put them into it,
//! anywhere.

use super::seen::NEARLY_ALL;

/// In how many of its parts a barrier must agree with itself.
const ENOUGH: usize = 3;
/// How far from one another those that agree may be, as a share of the part's length.
const AGREE: f64 = 0.1;

/// What a beam saw of a part: how much further than its length that went meanwhile, m, and that length, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Passed {
    pub beyond: f64,
    pub length: f64,
}

impl Passed {
    /// Whether this part goes so much further, m.
    pub fn agrees(&self, beyond: f64) -> bool {
        (self.beyond - beyond).abs() <= AGREE * self.length
    }
}

/// By how much further than they are long nearly all of these parts go while they cut a beam, m: less than 0. (What is cut for longer may be the gaps between
/// parts.)
pub(super) fn of_nearly_all(passed: &[Passed]) -> Option<f64> {
    let mut beyond: Vec<f64> = passed.iter().map(|passed| passed.beyond).collect();
    beyond.sort_by(f64::total_cmp);
    let middle = *beyond.get(beyond.len() / 2)?;
    let agree = passed.iter().filter(|passed| passed.agrees(middle)).count();
    (middle < 0.0 && agree >= ENOUGH && agree as f64 >= NEARLY_ALL * passed.len() as f64).then_some(middle)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearly_all_parts_say_what_a_sensor_misses() {
        let passed = |beyond: &[f64]| {
            of_nearly_all(&beyond.iter().map(|&beyond| Passed { beyond, length: 0.25 }).collect::<Vec<_>>())
        };
        assert_eq!(passed(&[-0.12, -0.13, -0.17, -0.121, -0.119]), Some(-0.121));
        // Too few, and each somewhere else.
        assert_eq!(passed(&[-0.12, -0.13]), None);
        assert_eq!(passed(&[-0.20, -0.13, -0.05, -0.09, -0.23]), None);
        assert_eq!(passed(&[]), None);
        assert_eq!(passed(&[2.4, 2.41, 2.4]), None);
    }
}
