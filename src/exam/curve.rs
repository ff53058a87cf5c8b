//! The calibration curve as a picture.

use plotters::prelude::*;

use super::calibration::Bin;
use crate::gap::page::plot::{self, FAINT, QUIET, WITH_EFFECT, axes, px, stroke};

const WIDTH: u32 = 560;
const HEIGHT: u32 = 360;
/// Radii of the points, px: of few answers, and of nearly all.
const RADII: [f64; 2] = [3.0, 9.0];

/// Draws how many answers are right over how much they weigh, each point as large as it has answers.
pub(super) fn svg(curve: &[Bin]) -> String {
    let most = curve.iter().map(|bin| bin.right.n).max().unwrap_or(1) as f64;
    plot::draw(WIDTH, HEIGHT, "share of right answers over their weight", |sheet| {
        let mut chart = ChartBuilder::on(sheet)
            .margin_top(px(10))
            .margin_right(px(14))
            .y_label_area_size(px(58))
            .x_label_area_size(px(42))
            .build_cartesian_2d(-0.02..1.02, -0.03..1.03)?;
        axes(&mut chart, Some("weight of the answer and its class"), "share that is right", 6)?;
        chart.draw_series(DashedLineSeries::new([(0.0, 0.0), (1.0, 1.0)], px(5), px(4), stroke(QUIET, 10)))?;
        for Bin { weight, right, .. } in curve {
            let (Some(value), Some([low, high])) = (right.value, right.ci95) else { continue };
            let radius = RADII[0] + (RADII[1] - RADII[0]) * (right.n as f64 / most).sqrt();
            chart.draw_series(LineSeries::new([(*weight, low), (*weight, high)], stroke(WITH_EFFECT, 15)))?;
            let place = (*weight, value);
            let size = px(radius.round() as i32);
            chart.draw_series([
                Circle::new(place, size, WITH_EFFECT.filled()),
                Circle::new(place, size, stroke(FAINT, 8)),
            ])?;
        }
        Ok(())
    })
}
