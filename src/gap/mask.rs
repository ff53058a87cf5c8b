//! Spans that somebody declared as no evidence: manual operation, a jam, an emergency stop.

use super::recording::Span;

/// A line of a mask that is no span.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "line {line}: {found:?}: expected FROM,TO in seconds since the trace's start, FROM not after TO, and perhaps ,WHY"
)]
pub struct MaskError {
    pub line: usize,
    pub found: String,
}

/// Reads a mask: a line for each span, `FROM,TO` or `FROM,TO,WHY`, in seconds since the trace's start. Empty lines, and what
/// follows a `#`, are passed over.
///
/// # Errors
/// The first line that is no span.
pub fn read_mask(text: &str) -> Result<Vec<Span>, MaskError> {
    let lines = text.lines().enumerate().map(|(at, line)| (at + 1, line.split('#').next().unwrap_or_default().trim()));
    let spans = lines.filter(|(_, line)| !line.is_empty()).map(|(line, text)| {
        let refuse = || MaskError { line, found: text.to_owned() };
        let mut fields = text.splitn(3, ',').map(str::trim);
        let mut second = || fields.next()?.parse().ok().filter(|at: &f64| at.is_finite());
        match (second(), second()) {
            (Some(from), Some(to)) if from <= to => Ok(Span { from, to }),
            _ => Err(refuse()),
        }
    });
    spans.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mask_is_a_span_a_line() {
        let spans = read_mask("# jams\n1.5, 2.5, a box fell over\n\n10,20 # stop\n").expect("two spans");
        assert_eq!(spans, [Span { from: 1.5, to: 2.5 }, Span { from: 10.0, to: 20.0 }]);
        for (text, line) in [("1,2\n5", 2), ("2,1", 1), ("a,b", 1), ("1,inf", 1)] {
            assert_eq!(read_mask(text).expect_err(text).line, line, "{text}");
        }
    }
}
