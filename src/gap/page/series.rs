//! A level over time: measured, nominal and with the effect; beneath it what is left.

use plotters::prelude::*;

use super::evidence::Series;
use super::plot::{self, Chart, Drawn, MEASURED, NOMINAL, WITH_EFFECT, axes, lines, px, span_of, stroke};
use crate::gap::report::number::scaled_unit;

const WIDTH: u32 = 860;
const HEIGHT: u32 = 340;
/// Of that, the residual.
const BENEATH: i32 = 140;
const LEFT: i32 = 66;

/// Draws a series.
pub(super) fn svg(series: &Series) -> String {
    let title = format!("{}: measured, nominal and with the effect, and their residuals", series.signal);
    plot::draw(WIDTH, HEIGHT, &title, |sheet| {
        let (above, beneath) = sheet.split_vertically(px(HEIGHT as i32 - BENEATH));
        let time = all_of(&series.times);
        let all = series.measured.iter().chain(&series.nominal).chain(series.with_effect.iter().flatten());
        let (factor, unit) = scaled_unit(largest(all.clone()), &series.unit);
        let mut chart = ChartBuilder::on(&above)
            .margin_top(px(6))
            .margin_right(px(8))
            .y_label_area_size(px(LEFT))
            .build_cartesian_2d(time.clone(), span_of(all.map(|value| value * factor)))?;
        axes(&mut chart, None, &unit, 5)?;
        curve(&mut chart, series, &series.measured, factor, stroke(MEASURED, 26), false)?;
        curve(&mut chart, series, &series.nominal, factor, stroke(NOMINAL, 15), true)?;
        if let Some(values) = &series.with_effect {
            curve(&mut chart, series, values, factor, stroke(WITH_EFFECT, 12), false)?;
        }
        residuals(&beneath, series, time)
    })
}

/// From the first time to the last.
fn all_of(times: &[f64]) -> std::ops::Range<f64> {
    match (times.first(), times.last()) {
        (Some(from), Some(to)) if from < to => *from..*to,
        _ => span_of(times.iter().copied()),
    }
}

fn largest<'a>(values: impl Iterator<Item = &'a f64>) -> f64 {
    values.filter(|value| value.is_finite()).fold(0.0, |largest: f64, value| largest.max(value.abs()))
}

fn curve(
    chart: &mut Chart<'_, '_>,
    series: &Series,
    values: &[f64],
    factor: f64,
    style: ShapeStyle,
    is_dashed: bool,
) -> Drawn {
    let scaled: Vec<f64> = values.iter().map(|value| value * factor).collect();
    for line in lines(&series.times, &scaled, WIDTH as usize) {
        if is_dashed {
            chart.draw_series(DashedLineSeries::new(line, px(6), px(3), style))?;
        } else {
            chart.draw_series(LineSeries::new(line, style))?;
        }
    }
    Ok(())
}

fn residuals(sheet: &plot::Sheet<'_>, series: &Series, time: std::ops::Range<f64>) -> Drawn {
    let minus = |model: &[f64]| -> Vec<f64> { model.iter().zip(&series.measured).map(|(m, y)| m - y).collect() };
    let (nominal, with_effect) = (minus(&series.nominal), series.with_effect.as_deref().map(minus));
    let band = 2.0 * series.floor;
    let all = || nominal.iter().chain(with_effect.iter().flatten()).copied();
    let (factor, unit) = scaled_unit(largest(all().collect::<Vec<_>>().iter()).max(band), &series.unit);
    let span = span_of(all().chain([band, -band]).map(|value| value * factor));
    let mut chart = ChartBuilder::on(sheet)
        .margin_top(px(10))
        .margin_right(px(8))
        .y_label_area_size(px(LEFT))
        .x_label_area_size(px(36))
        .build_cartesian_2d(time.clone(), span)?;
    let corners = [(time.start, -band * factor), (time.end, band * factor)];
    chart.draw_series([Rectangle::new(corners, BLACK.mix(0.12).filled())])?;
    axes(&mut chart, Some("time in s"), &format!("model − machine, {unit}"), 5)?;
    curve(&mut chart, series, &nominal, factor, stroke(NOMINAL, 15), true)?;
    if let Some(values) = &with_effect {
        curve(&mut chart, series, values, factor, stroke(WITH_EFFECT, 12), false)?;
    }
    Ok(())
}
