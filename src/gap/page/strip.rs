//! Edges: a truth value as a timing strip, and beneath it how late each edge of the whole recording is.

use plotters::prelude::*;

use super::evidence::{EdgeError, Strip, Switching};
use super::plot::{self, Drawn, MEASURED, NOMINAL, WITH_EFFECT, axes, font, px, span_of, stroke};
use crate::gap::report::number::scaled_unit;

const WIDTH: u32 = 860;
const ROW: i32 = 26;
const BENEATH: i32 = 150;
const LEFT: i32 = 86;

/// Draws a strip.
pub(super) fn svg(strip: &Strip) -> String {
    let mut rows = vec![("measured", &strip.measured, MEASURED), ("model as it is", &strip.nominal, NOMINAL)];
    rows.extend(strip.with_effect.as_ref().map(|switching| ("with effect", switching, WITH_EFFECT)));
    let above = ROW * rows.len() as i32 + 40;
    let has_errors = !strip.late.is_empty();
    let height = above + if has_errors { BENEATH } else { 0 };
    let title = format!("{}: when it changes, measured, nominal and with the effect", strip.signal);
    plot::draw(WIDTH, height.unsigned_abs(), &title, |sheet| {
        let (strips, beneath) = sheet.split_vertically(px(above));
        levels(&strips, strip, &rows)?;
        if has_errors { errors(&beneath, strip) } else { Ok(()) }
    })
}

fn levels(sheet: &plot::Sheet<'_>, strip: &Strip, rows: &[(&str, &Switching, RGBColor)]) -> Drawn {
    let [from, to] = strip.span;
    let to = if to > from { to } else { from + 1.0 };
    let mut chart = ChartBuilder::on(sheet)
        .margin_right(px(8))
        .margin_left(px(LEFT))
        .x_label_area_size(px(36))
        .build_cartesian_2d(from..to, 0.0..rows.len() as f64)?;
    let mut mesh = chart.configure_mesh();
    let number = |x: &f64| crate::gap::report::number::significant(*x, 5);
    mesh.disable_mesh().disable_y_axis().x_labels(9).x_label_formatter(&number).x_desc("time in s");
    mesh.axis_style(stroke(plot::QUIET, 8)).label_style(font(12, &RGBColor(60, 60, 60)));
    mesh.axis_desc_style(font(13, &BLACK)).set_all_tick_mark_size(px(3)).draw()?;
    for (index, (name, switching, colour)) in rows.iter().enumerate() {
        let foot = (rows.len() - 1 - index) as f64;
        for (on, off) in spans(switching, from, to) {
            let corners = [(on, foot + 0.18), (off, foot + 0.82)];
            chart.draw_series([Rectangle::new(corners, colour.mix(0.85).filled())])?;
        }
        chart.draw_series([PathElement::new(vec![(from, foot + 0.18), (to, foot + 0.18)], stroke(*colour, 8))])?;
        let y = px(index as i32 * ROW + ROW / 2 - 4);
        sheet.draw(&Text::new((*name).to_owned(), (0, y), font(13, &BLACK)))?;
    }
    Ok(())
}

/// When it is true between `from` and `to`.
fn spans(switching: &Switching, from: f64, to: f64) -> Vec<(f64, f64)> {
    let mut spans = Vec::new();
    let mut since = switching.initial.then_some(from);
    for &at in &switching.changes {
        since = match since {
            Some(on) => {
                if at > from && on < to {
                    spans.push((on.max(from), at.min(to)));
                }
                None
            }
            None => Some(at),
        };
    }
    spans.extend(since.filter(|on| *on < to).map(|on| (on.max(from), to)));
    spans
}

fn errors(sheet: &plot::Sheet<'_>, strip: &Strip) -> Drawn {
    let late = || strip.late.iter().flat_map(|error| [error.nominal, error.with_effect]).flatten();
    let largest = late().chain([strip.cycle]).fold(0.0, |largest: f64, late| largest.max(late.abs()));
    let (factor, unit) = scaled_unit(largest, "s");
    let band = strip.cycle / 2.0 * factor;
    let time = span_of(strip.late.iter().map(|error| error.at));
    let mut chart = ChartBuilder::on(sheet)
        .margin_top(px(8))
        .margin_right(px(8))
        .y_label_area_size(px(LEFT))
        .x_label_area_size(px(36))
        .build_cartesian_2d(
            time.clone(),
            span_of(late().chain([0.0]).map(|late| late * factor).chain([band, -band])),
        )?;
    chart.draw_series([Rectangle::new([(time.start, -band), (time.end, band)], BLACK.mix(0.12).filled())])?;
    axes(&mut chart, Some("time in s"), &format!("model late by, {unit}"), 5)?;
    let dots = |of: fn(&EdgeError) -> Option<f64>| {
        strip.late.iter().filter_map(move |error| Some((error.at, of(error)? * factor))).collect::<Vec<_>>()
    };
    let nominal = dots(|error| error.nominal);
    chart.draw_series(nominal.into_iter().map(|at| TriangleMarker::new(at, px(4), NOMINAL.filled())))?;
    let with_effect = dots(|error| error.with_effect);
    chart.draw_series(with_effect.into_iter().map(|at| Circle::new(at, px(3), WITH_EFFECT.filled())))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_are_cut_to_what_is_shown() {
        let check = |initial: bool, changes: &[f64], expected: &[(f64, f64)]| {
            assert_eq!(spans(&Switching { initial, changes: changes.to_vec() }, 1.0, 5.0), expected);
        };
        check(false, &[], &[]);
        check(true, &[], &[(1.0, 5.0)]);
        check(true, &[0.5, 2.0, 3.0], &[(2.0, 3.0)]);
        check(false, &[0.0, 2.0, 4.0, 9.0], &[(1.0, 2.0), (4.0, 5.0)]);
        check(false, &[6.0, 7.0], &[]);
    }
}
