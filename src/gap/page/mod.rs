//! `report.html`: a report as one page that needs nothing else, no network and no script. Its pictures are SVG, drawn here.
//!
//! First a sentence that answers the three questions, then the plant as a map with each device's share of the gap; for the
//! causes what was measured, what the model does and what it does with them, with the residual beneath, and edges as timing
//! strips; the ranking with its rivals; the shrink with its interval; and what could not be tested. The words and numbers
//! are the report's ([`Report`]), the pictures are made of [`Evidence`]; where that has nothing, there is no picture.

mod bars;
mod evidence;
mod gather;
mod map;
pub(crate) mod plot;
mod series;
mod strip;
mod tables;

pub use evidence::{EdgeError, Evidence, Series, Site, Strip, Switching, sites};
pub use gather::{Added, gather};

use crate::gap::report::{Report, Verdict, on, words};
use crate::xml::escape;

/// Renders the page.
pub fn page(report: &Report, evidence: &Evidence) -> String {
    let title = format!("Sim-to-real gap: {}", evidence.plant);
    let sections = [
        head(report, evidence),
        place(report, evidence),
        cause(report, evidence),
        ranking(report),
        shrink(report),
        tables::consequence(report),
        tables::not_testable(report),
        tables::made_from(report),
    ];
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<title>{}</title>\n<style>\n{}</style>\n</head>\n\
         <body>\n<main>\n{}</main>\n</body>\n</html>\n",
        escape(&title),
        include_str!("style.css"),
        sections.concat()
    )
}

fn head(report: &Report, evidence: &Evidence) -> String {
    let answer = report.answer();
    let incomplete = match report.incomplete {
        true => "<span class=\"badge incomplete\">incomplete: ended before all was tried</span>",
        false => "",
    };
    format!(
        "<header>\n<p class=\"quiet\">Sim-to-real gap of {}</p>\n<span class=\"badge\">{}</span>{incomplete}\n\
         <h1>{}<br>\n{}</h1>\n<p class=\"lead\">{}</p>\n</header>\n",
        escape(&evidence.plant),
        report.verdict,
        escape(&answer.place),
        escape(&answer.cause),
        escape(&answer.shrink)
    )
}

fn place(report: &Report, evidence: &Evidence) -> String {
    if report.devices.is_empty() && evidence.sites.is_empty() {
        return String::new();
    }
    let mut out = "<section>\n<h2>Where</h2>\n".to_owned();
    if !evidence.sites.is_empty() {
        let caption = match report.devices.is_empty() {
            true => "The plant from above. No device has a gap of its own.",
            false => "The plant from above. A disc is as large as its device's share of the gap.",
        };
        out.push_str(&figure(&map::svg(&evidence.sites, &report.devices), caption));
    }
    out.push_str(&tables::places(report));
    out.push_str("</section>\n");
    out
}

fn cause(report: &Report, evidence: &Evidence) -> String {
    if report.cause.is_empty() && evidence.series.is_empty() && evidence.strips.is_empty() {
        return String::new();
    }
    let mut out = "<section>\n<h2>Which effect</h2>\n".to_owned();
    out.push_str(&tables::parameters(report));
    let has_effect = !report.cause.is_empty();
    for series in &evidence.series {
        let caption = format!("{}. Beneath, model minus machine.", series.caption);
        let legend = legend(has_effect, "twice the noise floor");
        out.push_str(&headed_figure(&series.signal, &legend, &series::svg(series), &caption));
    }
    for strip in &evidence.strips {
        let (band, beneath) = match strip.late.is_empty() {
            true => ("", ""),
            false => (
                "within the cycle in which it was reported",
                " Beneath, how late the model's are: triangles as it is, dots with the effect.",
            ),
        };
        let caption = format!("{}. Measured edges stand where they were first reported.{beneath}", strip.caption);
        out.push_str(&headed_figure(&strip.signal, &legend(has_effect, band), &strip::svg(strip), &caption));
    }
    out.push_str("</section>\n");
    out
}

fn legend(has_effect: bool, band: &str) -> String {
    let effect = if has_effect { "<span class=\"effect\">with the effect</span>" } else { "" };
    let band = if band.is_empty() { String::new() } else { format!("<span class=\"floor\">{band}</span>") };
    format!(
        "<p class=\"legend\"><span class=\"measured\">measured</span><span class=\"nominal\">model as it is</span>{effect}{band}</p>\n"
    )
}

fn ranking(report: &Report) -> String {
    if report.cause.is_empty() && report.rivals.is_empty() {
        return String::new();
    }
    let caption = match report.verdict {
        Verdict::Ambiguous => "Weights: how often each wins when the data are drawn anew. No one of them stands clear.",
        _ => "Weights: how often each wins when the data are drawn anew.",
    };
    format!(
        "<section>\n<h2>What else could it be</h2>\n{}{}</section>\n",
        figure(&bars::weights(report), caption),
        tables::rivals(report)
    )
}

fn shrink(report: &Report) -> String {
    let Some(bars) = bars::shrink(report) else { return String::new() };
    let mut out = "<section>\n<h2>How far the gap shrinks</h2>\n".to_owned();
    out.push_str(&figure(&bars, "On data that no fit saw: RMS error, in noise floors."));
    let shrink = &report.shrink;
    if let (Some(ratio), Some(interval), false) = (shrink.ratio, shrink.ci95, report.cause.is_empty()) {
        out.push_str(&figure(&bars::left(ratio, interval), "With its 95 % interval, by drawing blocks of time anew."));
    }
    if let Some(rest) = &report.remainder {
        let on = match rest.depends_on.is_empty() {
            true => "on nothing that was recorded".to_owned(),
            false => format!("on {}", rest.depends_on.join(", ")),
        };
        let share = crate::gap::report::number::percent(rest.share);
        out.push_str(&format!("<p>What is left ({share}) depends {}.</p>\n", escape(&on)));
    }
    out.push_str("</section>\n");
    out
}

fn figure(svg: &str, caption: &str) -> String {
    format!("<figure>\n{svg}\n<figcaption>{}</figcaption>\n</figure>\n", escape(caption))
}

/// A figure that stays with its head and its legend, on paper too.
fn headed_figure(head: &str, legend: &str, svg: &str, caption: &str) -> String {
    let (head, caption) = (escape(head), escape(caption));
    format!("<figure>\n<h3>{head}</h3>\n{legend}{svg}\n<figcaption>{caption}</figcaption>\n</figure>\n")
}

/// `acceleration limit on Robot.Y`
fn effect_on(effect: &str, device: &str, component: Option<&str>) -> String {
    format!("{} on {}", words(effect), on(device, component))
}
