//! Times as a trace writes them: seconds, as a decimal that is exact to the nanosecond.

use std::fmt::Write as _;

use crate::time::Instant;

/// Digits of a nanosecond behind the point.
const DIGITS: usize = 9;

/// Appends the seconds of `at`: `0.0`, `0.02`, `12.000000001`.
pub(super) fn write_seconds(out: &mut String, at: Instant) {
    let ns = at.nanos();
    let (whole, part) = (ns.unsigned_abs() / 1_000_000_000, ns.unsigned_abs() % 1_000_000_000);
    let sign = if ns < 0 { "-" } else { "" };
    let digits = format!("{part:09}");
    let digits = digits.trim_end_matches('0');
    let digits = if digits.is_empty() { "0" } else { digits };
    // Writing to a String cannot fail.
    let _ = write!(out, "{sign}{whole}.{digits}");
}

/// Reads a JSON number as seconds, rounded to the nearest nanosecond; `None` where the clock does not reach.
pub(super) fn read_seconds(number: &str) -> Option<Instant> {
    read_time(number, DIGITS)
}

/// The same of a number in a unit that has a nanosecond at its decimal number `decimals`: 9 for seconds, 6 for
/// milliseconds.
pub(super) fn read_time(number: &str, decimals: usize) -> Option<Instant> {
    if number.contains(['e', 'E']) {
        let nanoseconds: f64 = number.parse::<f64>().ok()? * 10f64.powi(decimals as i32);
        return (nanoseconds.abs() < i64::MAX as f64).then(|| Instant::from_nanos(nanoseconds.round() as i64));
    }
    let (negative, digits) = number.strip_prefix('-').map_or((false, number), |digits| (true, digits));
    let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
    let whole: i64 = whole.parse().ok()?;
    let kept = &part[..part.len().min(decimals)];
    let part_ns: i64 = format!("0{kept:0<decimals$}").parse().ok()?;
    let rounds_up = part.as_bytes().get(decimals).is_some_and(|digit| *digit >= b'5');
    let ns = whole.checked_mul(10_i64.pow(decimals as u32))?.checked_add(part_ns + i64::from(rounds_up))?;
    Some(Instant::from_nanos(if negative { -ns } else { ns }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn check(number: &str, ns: Option<i64>) {
        assert_eq!(read_seconds(number).map(Instant::nanos), ns, "{number}");
    }

    #[test]
    fn seconds_are_exact_decimals() {
        check("0", Some(0));
        check("0.020", Some(20_000_000));
        check("0.013069", Some(13_069_000));
        check("1e-3", Some(1_000_000));
        check("123456789.000000001", Some(123_456_789_000_000_001));
        check("0.0000000014", Some(1));
        check("0.0000000015", Some(2));
        check("-0.5", Some(-500_000_000));
        check("9223372036.854775807", Some(i64::MAX));
        check("9223372036.854775808", None);
        check("1e300", None);
        check("99999999999999999999", None);
    }

    #[test]
    fn other_units_are_exact_too() {
        let check = |number: &str, decimals: usize, ns: Option<i64>| {
            assert_eq!(read_time(number, decimals).map(Instant::nanos), ns, "{number}");
        };
        check("20.08", 6, Some(20_080_000));
        check("1", 6, Some(1_000_000));
        check("1700000000000001", 3, Some(1_700_000_000_000_001_000));
        check("17", 0, Some(17));
        check("17.5", 0, Some(18));
        check("2e3", 3, Some(2_000_000));
        check("9300000000000000", 3, None);
    }

    proptest! {
        #[test]
        fn what_is_written_reads_back(ns in -i64::MAX..i64::MAX) {
            let mut text = String::new();
            write_seconds(&mut text, Instant::from_nanos(ns));
            prop_assert_eq!(read_seconds(&text), Some(Instant::from_nanos(ns)), "{}", text);
        }

        #[test]
        fn a_reader_with_f64_seconds_finds_the_same_nanosecond_within_a_month(ns in 0..2_600_000_000_000_000i64) {
            let mut text = String::new();
            write_seconds(&mut text, Instant::from_nanos(ns));
            prop_assert_eq!(Instant::from_seconds(text.parse().expect("a number")).nanos(), ns);
        }
    }
}
