//! The plant from above: each device where it stands, those with a gap in colour, a disc as large as their share.

use std::collections::BTreeMap;

use plotters::prelude::*;

use super::evidence::Site;
use super::plot::{self, Drawn, FAINT, QUIET, SHARE, font, px, stroke};
use crate::gap::report::DeviceGap;
use crate::gap::report::number::percent;

const WIDTH: u32 = 860;
/// The least and the most that the plant's shape may ask for.
const HEIGHTS: (f64, f64) = (200.0, 460.0);
const MARGIN: f64 = 60.0;
/// The disc of a device that has the whole gap.
const DISC: f64 = 30.0;
/// Plants with more devices name only those with a gap.
const NAMED: usize = 20;

/// Draws the map.
pub(super) fn svg(sites: &[Site], gaps: &[DeviceGap]) -> String {
    let view = View::of(sites);
    plot::draw(WIDTH, view.height as u32, "the plant from above, with each device's share of the gap", |sheet| {
        for site in sites.iter().filter(|site| site.outline.len() > 2) {
            let corners: Vec<(i32, i32)> = site.outline.iter().map(|corner| view.dot(*corner)).collect();
            sheet.draw(&Polygon::new(corners.clone(), FAINT.filled()))?;
            let closed = corners.iter().chain(corners.first()).copied().collect::<Vec<_>>();
            sheet.draw(&PathElement::new(closed, stroke(QUIET, 7)))?;
        }
        let shares: BTreeMap<&str, f64> = gaps.iter().map(|gap| (gap.device.as_str(), gap.share)).collect();
        for site in sites {
            let share = shares.get(site.device.as_str()).copied();
            mark(sheet, site, &view, share, sites.len() <= NAMED)?;
        }
        scale(sheet, &view)
    })
}

fn mark(sheet: &plot::Sheet<'_>, site: &Site, view: &View, share: Option<f64>, is_named: bool) -> Drawn {
    let (x, y) = view.dot(site.at);
    let Some(share) = share else {
        if site.outline.is_empty() {
            sheet.draw(&Circle::new((x, y), px(3), QUIET.filled()))?;
        }
        if is_named {
            let top = site.outline.iter().map(|corner| view.dot(*corner).1).min();
            let at = top.map_or((x + px(6), y - px(5)), |top| (x - px(3 * site.device.len() as i32), top - px(14)));
            text(sheet, &site.device, at, 11, &RGBColor(90, 90, 90))?;
        }
        return Ok(());
    };
    let radius = (DISC * share.clamp(0.0, 1.0).sqrt()).max(4.0);
    sheet.draw(&Circle::new((x, y), px(radius as i32), SHARE.mix(0.85).filled()))?;
    sheet.draw(&Circle::new((x, y), px(radius as i32), stroke(BLACK, 10)))?;
    let label = format!("{} {}", site.device, percent(share));
    text(sheet, &label, (x + px(radius as i32 + 5), y - px(8)), 15, &BLACK)
}

/// A text that can be read on whatever it stands on.
fn text(sheet: &plot::Sheet<'_>, text: &str, (x, y): (i32, i32), pixels: u32, colour: &RGBColor) -> Drawn {
    for (dx, dy) in [(-1, -1), (-1, 1), (1, -1), (1, 1)] {
        sheet.draw(&Text::new(text.to_owned(), (x + px(dx), y + px(dy)), font(pixels, &WHITE)))?;
    }
    sheet.draw(&Text::new(text.to_owned(), (x, y), font(pixels, colour)))
}

/// A bar that says how long a metre is.
fn scale(sheet: &plot::Sheet<'_>, view: &View) -> Drawn {
    let metres = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0];
    let metre = metres.into_iter().find(|metres| metres * view.scale > 50.0).unwrap_or(100.0);
    let (x, y) = (px(14), px(view.height as i32 - 14));
    let end = x + (metre * view.scale * f64::from(plot::FINE)) as i32;
    sheet.draw(&PathElement::new(vec![(x, y), (end, y)], stroke(QUIET, 20)))?;
    sheet.draw(&Text::new(format!("{metre} m"), (x, y - px(16)), font(12, &RGBColor(60, 60, 60))))
}

/// How metres become pixels.
struct View {
    low: [f64; 2],
    high: [f64; 2],
    /// Pixels to a metre.
    scale: f64,
    height: f64,
}

impl View {
    fn of(sites: &[Site]) -> View {
        let points = || sites.iter().flat_map(|site| site.outline.iter().chain([&site.at]));
        let end = |axis: usize, start: f64, pick: fn(f64, f64) -> f64| {
            points().map(|point| point[axis]).filter(|x| x.is_finite()).fold(start, pick)
        };
        let (mut low, mut high) = ([0.0; 2], [1.0; 2]);
        if points().next().is_some() {
            low = [0, 1].map(|axis| end(axis, f64::INFINITY, f64::min));
            high = [0, 1].map(|axis| end(axis, f64::NEG_INFINITY, f64::max));
        }
        let size = [0, 1].map(|axis| (high[axis] - low[axis]).max(0.5));
        // Names stand to the right of what they name.
        let across = f64::from(WIDTH) - 2.0 * MARGIN - 80.0;
        let height = (across / size[0] * size[1] + 2.0 * MARGIN).clamp(HEIGHTS.0, HEIGHTS.1);
        let scale = (across / size[0]).min((height - 2.0 * MARGIN) / size[1]);
        View { low, high, scale, height }
    }

    fn dot(&self, [x, y]: [f64; 2]) -> (i32, i32) {
        let middle = |axis: usize| (self.low[axis] + self.high[axis]) / 2.0;
        let across = f64::from(WIDTH) / 2.0 - 40.0 + (x - middle(0)) * self.scale;
        let down = self.height / 2.0 - (y - middle(1)) * self.scale;
        let fine = f64::from(plot::FINE);
        ((across * fine).round() as i32, (down * fine).round() as i32)
    }
}
