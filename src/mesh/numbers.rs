//! Numbers in text.

use super::Wrong;

/// A finite number of a file.
pub(super) fn number(word: &str, line: usize) -> Result<f64, Wrong> {
    match word.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        Ok(_) => Err(Wrong::at(line, format!("the coordinate {word:?}"), "expected a finite number")),
        Err(_) => Err(Wrong::at(line, format!("{word:?} is no number"), "expected a coordinate")),
    }
}

/// The next three words as coordinates.
pub(super) fn triple<'a>(words: &mut impl Iterator<Item = &'a str>, line: usize) -> Result<[f64; 3], Wrong> {
    let mut next = || match words.next() {
        Some(word) => number(word, line),
        None => Err(Wrong::at(line, "too few coordinates", "expected three")),
    };
    Ok([next()?, next()?, next()?])
}
