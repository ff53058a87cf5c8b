//! The text of a JSON number as an integer, exactly: no detour over f64, which loses the last digits of a LINT.

/// Why a number is no integer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NotInteger {
    /// It has a fraction; the integer nearest to it, halves away from zero.
    Fraction { nearest: i128 },
    /// It has more digits than any type of ours.
    TooLarge,
}

/// More digits than any integer type of ours has, and few enough for an i128.
const DIGITS_LIMIT: i64 = 37;

/// The number written `text` (well-formed JSON), times ten to the power of `shift`, as an integer.
///
/// `1.0`, `1e2` and `0.5e1` are integers; so is `1.5` with a shift of 1.
pub(super) fn integer(text: &str, shift: i64) -> Result<i128, NotInteger> {
    match text.parse::<i64>() {
        // As nearly every integer is written.
        Ok(plain) if shift == 0 => Ok(i128::from(plain)),
        _ => any_integer(text, shift),
    }
}

fn any_integer(text: &str, shift: i64) -> Result<i128, NotInteger> {
    let (negative, magnitude) = match text.strip_prefix('-') {
        Some(magnitude) => (true, magnitude),
        None => (false, text),
    };
    let (mantissa, exponent) = match magnitude.find(['e', 'E']) {
        Some(at) => (&magnitude[..at], saturating_exponent(&magnitude[at + 1..])),
        None => (magnitude, 0),
    };
    let fraction_digits = mantissa.find('.').map_or(0, |point| mantissa.len() - point - 1) as i64;
    let leading = mantissa.bytes().take_while(|b| matches!(b, b'0' | b'.'));
    let significant = &mantissa[leading.count()..];
    let trimmed = significant.trim_end_matches(['0', '.']);
    if trimmed.is_empty() {
        return Ok(0);
    }
    let digits = |text: &str| text.bytes().filter(u8::is_ascii_digit).count() as i64;
    let dropped = digits(significant) - digits(trimmed);
    // The value is `trimmed` read as an integer, times ten to this power.
    let power = exponent - fraction_digits + dropped + shift;
    let whole_digits = digits(trimmed) + power;
    if whole_digits > DIGITS_LIMIT {
        return Err(NotInteger::TooLarge);
    }
    let sign = if negative { -1 } else { 1 };
    let mut figures = trimmed.bytes().filter(u8::is_ascii_digit).map(|b| i128::from(b - b'0'));
    let mut whole = 0;
    for _ in 0..whole_digits.max(0) {
        whole = whole * 10 + figures.next().unwrap_or(0);
    }
    if power >= 0 {
        return Ok(sign * whole);
    }
    // The first digit after the point decides; with no whole digit, it may itself lie further behind.
    let rounds_up = whole_digits >= 0 && figures.next().is_some_and(|figure| figure >= 5);
    Err(NotInteger::Fraction { nearest: sign * (whole + i128::from(rounds_up)) })
}

/// The exponent written `text`; beyond a billion it no longer matters by how much.
fn saturating_exponent(text: &str) -> i64 {
    const BOUND: i64 = 1_000_000_000_000;
    let (sign, digits) = match text.as_bytes().first() {
        Some(b'-') => (-1, &text[1..]),
        Some(b'+') => (1, &text[1..]),
        _ => (1, text),
    };
    sign * digits.bytes().fold(0, |sum, digit| (sum * 10 + i64::from(digit - b'0')).min(BOUND))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[track_caller]
    fn check(text: &str, shift: i64, expect: Result<i128, NotInteger>) {
        assert_eq!(integer(text, shift), expect, "{text} shifted by {shift}");
    }

    #[test]
    fn numbers_without_a_fraction_are_integers_however_they_are_written() {
        check("0", 0, Ok(0));
        check("-0.000", 0, Ok(0));
        check("0e999999999999999999999", 0, Ok(0));
        check("1.0", 0, Ok(1));
        check("-12", 0, Ok(-12));
        check("1e2", 0, Ok(100));
        check("1.50e1", 0, Ok(15));
        check("1200e-2", 0, Ok(12));
        check("10.0e-1", 0, Ok(1));
        check("0.001E+3", 0, Ok(1));
        check("18446744073709551615", 0, Ok(u64::MAX.into()));
        check("18446744073709551615.0", 0, Ok(u64::MAX.into()));
        check("-9223372036854775808", 0, Ok(i64::MIN.into()));
    }

    #[test]
    fn a_fraction_is_said_and_rounded() {
        let fraction = |nearest| Err(NotInteger::Fraction { nearest });
        check("0.5", 0, fraction(1));
        check("-0.5", 0, fraction(-1));
        check("0.49999999999999999999999", 0, fraction(0));
        check("0.05", 0, fraction(0));
        check("0.0996e1", 0, fraction(1));
        check("12.75", 0, fraction(13));
        check("1e-400", 0, fraction(0));
        check("1.5", 1, Ok(15));
        check("1.2345678", 6, fraction(1_234_568));
    }

    #[test]
    fn what_is_beyond_every_type_is_too_large() {
        check("1e400", 0, Err(NotInteger::TooLarge));
        check("-1e99999999999999999999999", 0, Err(NotInteger::TooLarge));
        check(&"9".repeat(100), 0, Err(NotInteger::TooLarge));
        check("9223372036854.775807", 6, Ok(i64::MAX.into()));
    }

    proptest! {
        #[test]
        fn an_integer_written_with_any_point_and_exponent_reads_back(n in any::<i64>(), places in 0usize..25) {
            let digits = format!("{:0>width$}", n.unsigned_abs(), width = places + 1);
            let (whole, fraction) = digits.split_at(digits.len() - places);
            let sign = if n < 0 { "-" } else { "" };
            let point = if places > 0 { "." } else { "" };
            let whole = match whole.trim_start_matches('0') { "" => "0", trimmed => trimmed };
            let text = format!("{sign}{whole}{point}{fraction}e{places}");
            prop_assert_eq!(integer(&text, 0), Ok(i128::from(n)), "{}", text);
        }
    }
}
