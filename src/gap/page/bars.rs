//! The ranking by weight, and the shrink with its interval.

use plotters::prelude::*;

use super::plot::{self, Drawn, MEASURED, NOMINAL, QUIET, WITH_EFFECT, font, px, stroke};
use crate::gap::report::number::{percent, significant};
use crate::gap::report::{Cause, Report, on, words};
use crate::plant::EffectPlace;

const WIDTH: u32 = 860;
const ROW: i32 = 26;
/// Where bars begin, in pixels, and how long the longest is.
const FROM: i32 = 330;
const LONGEST: f64 = 440.0;

struct Bar {
    label: String,
    length: f64,
    value: String,
    colour: RGBColor,
    is_filled: bool,
}

/// Draws the weights of the causes, of their rivals, and of nothing in the library.
pub(super) fn weights(report: &Report) -> String {
    let cause = |cause: &Cause| {
        let label = label_of(&cause.device, cause.component.as_deref(), &cause.effect, cause.place);
        bar(label, cause.weight, WITH_EFFECT, true)
    };
    let mut bars: Vec<Bar> = report.cause.iter().map(cause).collect();
    bars.extend(report.rivals.iter().map(|rival| {
        let label = label_of(&rival.device, rival.component.as_deref(), &rival.effect, rival.place);
        bar(label, rival.weight, NOMINAL, false)
    }));
    bars.extend(report.outside.map(|weight| bar("nothing in the library".to_owned(), weight, QUIET, false)));
    draw(&bars, "causes and rivals by weight")
}

fn label_of(device: &str, component: Option<&str>, effect: &str, place: EffectPlace) -> String {
    format!("{} · {} ({})", on(device, component), words(effect), words(place.name()))
}

fn bar(label: String, weight: f64, colour: RGBColor, is_filled: bool) -> Bar {
    Bar { label, length: weight, value: percent(weight), colour, is_filled }
}

/// Draws the gap before and after, with the floor; `None` where nothing was measured.
pub(super) fn shrink(report: &Report) -> Option<String> {
    let shrink = &report.shrink;
    let (before, after) = (shrink.holdout_before?, shrink.holdout_after?);
    let largest = before.max(after).max(report.gap.floor.unwrap_or(0.0)).max(f64::MIN_POSITIVE);
    let row = |label: &str, number: f64, colour: RGBColor, is_filled: bool| Bar {
        label: label.to_owned(),
        length: number / largest,
        value: significant(number, 3),
        colour,
        is_filled,
    };
    let mut bars =
        vec![row("model as it is", before, NOMINAL, false), row("with the effect", after, WITH_EFFECT, true)];
    bars.extend(report.gap.floor.map(|floor| row("noise floor", floor, MEASURED, true)));
    Some(draw(&bars, "the gap before and after, times the noise floor"))
}

/// Draws how much of the gap above the floor is left, from 0 to 1, with its interval.
pub(super) fn left(ratio: f64, interval: [f64; 2]) -> String {
    plot::draw(WIDTH, 64, "what is left of the gap, with its interval", |sheet| {
        let at = |part: f64| px(FROM) + (part.clamp(0.0, 1.0) * LONGEST * f64::from(plot::FINE)) as i32;
        let y = px(20);
        sheet.draw(&Text::new("left of what lies above the floor", (0, y - px(7)), font(13, &BLACK)))?;
        sheet.draw(&PathElement::new(vec![(at(0.0), y), (at(1.0), y)], stroke(plot::FAINT, 40)))?;
        sheet.draw(&PathElement::new(vec![(at(interval[0]), y), (at(interval[1]), y)], stroke(WITH_EFFECT, 30)))?;
        for end in interval {
            sheet.draw(&PathElement::new(vec![(at(end), y - px(6)), (at(end), y + px(6))], stroke(WITH_EFFECT, 20)))?;
        }
        sheet.draw(&Circle::new((at(ratio), y), px(5), WITH_EFFECT.filled()))?;
        for part in [0.0, 0.25, 0.5, 0.75, 1.0] {
            let text = percent(part);
            sheet.draw(&PathElement::new(vec![(at(part), y + px(12)), (at(part), y + px(17))], stroke(QUIET, 10)))?;
            let x = at(part) - px(text.chars().count() as i32 * 3);
            sheet.draw(&Text::new(text, (x, y + px(20)), font(12, &RGBColor(60, 60, 60))))?;
        }
        Ok(())
    })
}

fn draw(bars: &[Bar], title: &str) -> String {
    let height = ROW * bars.len() as i32 + 12;
    plot::draw(WIDTH, height.unsigned_abs(), title, |sheet| {
        bars.iter().enumerate().try_for_each(|(index, bar)| row(sheet, bar, px(6 + index as i32 * ROW)))
    })
}

fn row(sheet: &plot::Sheet<'_>, bar: &Bar, top: i32) -> Drawn {
    sheet.draw(&Text::new(bar.label.clone(), (0, top + px(5)), font(13, &BLACK)))?;
    let end = px(FROM) + (bar.length.clamp(0.0, 1.0) * LONGEST * f64::from(plot::FINE)) as i32;
    let corners = [(px(FROM), top + px(2)), (end.max(px(FROM) + px(1)), top + px(ROW - 6))];
    // Causes are filled, all else is an outline: to be told apart in print without colours.
    let fill = if bar.is_filled { bar.colour.mix(1.0) } else { bar.colour.mix(0.25) };
    sheet.draw(&Rectangle::new(corners, fill.filled()))?;
    sheet.draw(&Rectangle::new(corners, stroke(bar.colour, 10)))?;
    sheet.draw(&Text::new(bar.value.clone(), (end + px(8), top + px(5)), font(13, &BLACK)))
}
