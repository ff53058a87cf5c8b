//! Numbers for people: as many digits as say something, and units with their prefixes.

/// A number with so many digits that say something: `0.0123`, `1234`, `2.5e-9`.
pub fn significant(number: f64, digits: i32) -> String {
    if number == 0.0 || !number.is_finite() {
        return if number == 0.0 { "0".to_owned() } else { "–".to_owned() };
    }
    let decimals = digits - 1 - number.abs().log10().floor() as i32;
    if decimals > 7 {
        return format!("{number:.*e}", (digits - 1).max(0) as usize);
    }
    let text = format!("{number:.*}", decimals.max(0) as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// A part of a whole: `4.2 %`, `83 %`.
pub fn percent(part: f64) -> String {
    format!("{} %", significant(part * 100.0, 2))
}

/// A unit as people write it, and the factor from `unit` to it, so that `number` is easy to read.
pub fn scaled_unit(number: f64, unit: &str) -> (f64, String) {
    let takes_prefix = matches!(unit, "m" | "s" | "rad" | "m/s" | "rad/s" | "N.m");
    let plain = match unit {
        "1" | "" => String::new(),
        unit => unit.replace("s2", "s²").replace("m2", "m²").replace('.', "·"),
    };
    match number.abs() {
        size if !takes_prefix || size == 0.0 || size >= 0.1 || !size.is_finite() => (1.0, plain),
        size if size >= 1e-4 => (1e3, format!("m{plain}")),
        _ => (1e6, format!("µ{plain}")),
    }
}

/// A number with its unit: `0.58 mm`, `1.99 m/s²`. A gain that is nearly 1 has as many digits as show what it is beside that.
pub fn quantity(number: f64, unit: &str) -> String {
    const FEWEST: i32 = 4;
    const MOST: i32 = 8;
    let (factor, unit) = scaled_unit(number, unit);
    let beside = (number - 1.0).abs();
    let is_nearly_one = unit.is_empty() && beside > 0.0 && beside < 0.1;
    let digits = if is_nearly_one { (2 - beside.log10().floor() as i32).clamp(FEWEST, MOST) } else { FEWEST };
    with_unit(significant(number * factor, digits), &unit)
}

/// A number with its interval, with as many digits as tell its ends apart.
pub fn interval(number: f64, [low, high]: [f64; 2], unit: &str) -> String {
    let (factor, unit) = scaled_unit(number, unit);
    let spread = (number.abs() / (high - low).abs()).log10();
    let digits = if spread.is_finite() { (spread.ceil() as i32 + 2).clamp(3, 8) } else { 4 };
    let text = |number: f64| significant(number * factor, digits);
    format!("{} (95 %: {} to {})", with_unit(text(number), &unit), text(low), text(high))
}

fn with_unit(number: String, unit: &str) -> String {
    if unit.is_empty() { number } else { format!("{number} {unit}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_that_say_something() {
        let check = |number: f64, text: &str| assert_eq!(significant(number, 3), text);
        check(0.0, "0");
        check(19.98, "20");
        check(-0.012_345, "-0.0123");
        check(1234.5, "1234");
        check(2.5e-9, "2.50e-9");
        check(f64::NAN, "–");
    }

    #[test]
    fn units_have_prefixes_where_that_is_easier() {
        assert_eq!(quantity(0.000_58, "m"), "0.58 mm");
        assert_eq!(quantity(3.2e-5, "m"), "32 µm");
        assert_eq!(quantity(1.992_54, "m/s2"), "1.993 m/s²");
        assert_eq!(quantity(0.06, "1"), "0.06");
        assert_eq!(quantity(0.021, "s"), "21 ms");
        assert_eq!(quantity(1.000_009_6, "1"), "1.0000096");
        assert_eq!((quantity(1.002_37, "1"), quantity(1.25, "1")), ("1.0024".to_owned(), "1.25".to_owned()));
        assert_eq!(interval(1.992_541, [1.992_51, 1.992_57], "m/s2"), "1.992541 m/s² (95 %: 1.99251 to 1.99257)");
        assert_eq!(interval(0.06, [0.055, 0.066], "1"), "0.06 (95 %: 0.055 to 0.066)");
        assert_eq!(percent(0.042), "4.2 %");
    }
}
