//! Drawing with plotters into a text of SVG: the page's colours, and what every chart shares.

use std::ops::Range;

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::gap::report::number::significant;

/// A sheet to draw on.
pub(crate) type Sheet<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(crate) type Drawn = Result<(), DrawingAreaErrorKind<std::io::Error>>;
pub(crate) type Chart<'a, 'b> = ChartContext<
    'a,
    SVGBackend<'b>,
    Cartesian2d<plotters::coord::types::RangedCoordf64, plotters::coord::types::RangedCoordf64>,
>;

/// Units of the drawing to a pixel of the page: plotters places everything at whole units, and lines would show steps.
pub(crate) const FINE: u32 = 4;

// Colours of Okabe and Ito, which are told apart with any colour vision, and in grey by their darkness. Lines differ by
// their dashes, too.
pub(crate) const MEASURED: RGBColor = RGBColor(0, 0, 0);
pub(crate) const NOMINAL: RGBColor = RGBColor(213, 94, 0);
pub(crate) const WITH_EFFECT: RGBColor = RGBColor(0, 114, 178);
pub(crate) const SHARE: RGBColor = RGBColor(230, 159, 0);
pub(crate) const QUIET: RGBColor = RGBColor(120, 120, 120);
pub(crate) const FAINT: RGBColor = RGBColor(225, 225, 225);

/// Draws a sheet of so many pixels.
pub(crate) fn draw(width: u32, height: u32, title: &str, paint: impl FnOnce(&Sheet<'_>) -> Drawn) -> String {
    let mut svg = String::new();
    {
        let sheet = SVGBackend::with_string(&mut svg, (width * FINE, height * FINE)).into_drawing_area();
        // A text takes all that is written to it; what is drawn outside of the sheet is cut off.
        let drawn = paint(&sheet).and_then(|()| sheet.present());
        debug_assert!(drawn.is_ok(), "{drawn:?}");
    }
    // The page says how wide it is; who cannot see it is told what it is.
    let size = format!("width=\"{}\" height=\"{}\" ", width * FINE, height * FINE);
    let label = format!("role=\"img\" aria-label=\"{}\" ", crate::xml::escape(title));
    svg.replacen(&size, &label, 1)
}

/// Pixels of the page as units of the drawing.
pub(crate) fn px(pixels: i32) -> i32 {
    pixels * FINE as i32
}

/// The page's type in so many pixels.
pub(crate) fn font(pixels: u32, colour: &RGBColor) -> TextStyle<'static> {
    ("sans-serif", pixels * FINE).into_font().color(colour)
}

/// A line of a style, so many tenths of a pixel wide.
pub(crate) fn stroke(colour: RGBColor, tenths: u32) -> ShapeStyle {
    ShapeStyle::from(colour).stroke_width((tenths * FINE).div_ceil(10))
}

/// The span of finite numbers, a little wider; 0 to 1 where there is none.
pub(crate) fn span_of(numbers: impl Iterator<Item = f64>) -> Range<f64> {
    let finite = numbers.filter(|number| number.is_finite());
    let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    if low > high {
        return 0.0..1.0;
    }
    let room = ((high - low) * 0.06).max(high.abs().max(low.abs()) * 1e-6).max(1e-12);
    low - room..high + room
}

/// A chart's axes: few lines, numbers with few digits.
pub(crate) fn axes(chart: &mut Chart<'_, '_>, x: Option<&str>, y: &str, rows: usize) -> Drawn {
    let number = |x: &f64| significant(if x.abs() < 1e-9 { 0.0 } else { *x }, 4);
    let mut mesh = chart.configure_mesh();
    mesh.disable_x_mesh()
        .x_labels(if x.is_some() { 9 } else { 0 })
        .y_labels(rows)
        .x_label_formatter(&number)
        .y_label_formatter(&number)
        .light_line_style(TRANSPARENT)
        .bold_line_style(stroke(FAINT, 8))
        .axis_style(stroke(QUIET, 8))
        .label_style(font(12, &RGBColor(60, 60, 60)))
        .axis_desc_style(font(13, &BLACK))
        .set_all_tick_mark_size(px(3))
        .y_desc(y);
    if let Some(x) = x {
        mesh.x_desc(x);
    }
    mesh.draw()
}

/// Points of a line, no more than the eye can tell apart in so many pixels: of each column of pixels the first, the least,
/// the greatest and the last. A gap in the line begins a new one.
pub(crate) fn lines(times: &[f64], values: &[f64], columns: usize) -> Vec<Vec<(f64, f64)>> {
    let mut lines: Vec<Vec<(f64, f64)>> = vec![Vec::new()];
    let points: Vec<(f64, f64)> = times.iter().copied().zip(values.iter().copied()).collect();
    let per_column = (points.len() / columns.max(1)).max(1);
    for column in points.chunks(per_column) {
        for run in column.split_inclusive(|(_, value)| !value.is_finite()) {
            let has_gap = run.last().is_some_and(|(_, value)| !value.is_finite());
            let run = if has_gap { &run[..run.len() - 1] } else { run };
            if let Some(line) = lines.last_mut() {
                line.extend(ends_and_extremes(run));
            }
            if has_gap {
                lines.push(Vec::new());
            }
        }
    }
    lines.retain(|line| !line.is_empty());
    lines
}

fn ends_and_extremes(run: &[(f64, f64)]) -> Vec<(f64, f64)> {
    if run.len() <= 4 {
        return run.to_vec();
    }
    let by_value = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
    let mut kept = vec![run[0], run[run.len() - 1]];
    kept.extend(run.iter().min_by(by_value));
    kept.extend(run.iter().max_by(by_value));
    kept.sort_by(|a, b| a.0.total_cmp(&b.0));
    kept.dedup();
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_line_keeps_its_peaks() {
        let times: Vec<f64> = (0..100_000).map(f64::from).collect();
        let mut values = vec![0.0; 100_000];
        values[54_321] = 7.0;
        let lines = lines(&times, &values, 800);
        assert!(lines.len() == 1 && lines[0].len() < 4_000, "{}", lines[0].len());
        assert!(lines[0].contains(&(54_321.0, 7.0)));
        assert!(lines[0].is_sorted_by(|a, b| a.0 <= b.0));
    }

    #[test]
    fn a_gap_parts_a_line() {
        let found = lines(&[0.0, 1.0, 2.0, 3.0], &[1.0, f64::NAN, 2.0, 3.0], 800);
        assert_eq!(found, [vec![(0.0, 1.0)], vec![(2.0, 2.0), (3.0, 3.0)]]);
    }

    #[test]
    fn a_span_is_never_empty() {
        for numbers in [vec![], vec![f64::NAN], vec![0.0], vec![5.0, 5.0], vec![-1e-300]] {
            let span = span_of(numbers.iter().copied());
            assert!(span.start < span.end && span.start.is_finite(), "{numbers:?}: {span:?}");
        }
    }
}
