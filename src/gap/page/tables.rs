//! The page's tables.

use super::effect_on;
use crate::effect;
use crate::gap::report::number::{percent, quantity, significant};
use crate::gap::report::{Beside, Cause, Report, SignalGap, SignalKind, on, words};
use crate::xml::escape;

/// A table: its heads, of which those that begin with `#` are over numbers, and its rows.
fn table(heads: &[&str], rows: &[Vec<String>]) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let class = |head: &str| if head.starts_with('#') { " class=\"number\"" } else { "" };
    let mut out = "<table>\n<tr>".to_owned();
    for head in heads {
        out.push_str(&format!("<th{}>{}</th>", class(head), escape(head.trim_start_matches('#'))));
    }
    out.push_str("</tr>\n");
    for row in rows {
        let cells = heads.iter().zip(row).map(|(head, cell)| format!("<td{}>{}</td>", class(head), escape(cell)));
        out.push_str(&format!("<tr>{}</tr>\n", cells.collect::<String>()));
    }
    out.push_str("</table>\n");
    out
}

/// Each device's signals, before and after.
pub(super) fn places(report: &Report) -> String {
    let mut rows = Vec::new();
    for gap in &report.devices {
        for (index, signal) in gap.signals.iter().enumerate() {
            let first = |text: String| if index == 0 { text } else { String::new() };
            rows.push(vec![
                first(gap.device.clone()),
                first(percent(gap.share)),
                signal.name.strip_prefix(&format!("{}.", gap.device)).unwrap_or(&signal.name).to_owned(),
                error(signal, signal.before, signal.missing.map(|c| c.before), signal.extra.map(|c| c.before)),
                error(signal, signal.after, signal.missing.map(|c| c.after), signal.extra.map(|c| c.after)),
                signal.floor.map_or_else(|| "–".to_owned(), |floor| quantity(floor, &signal.unit)),
            ]);
        }
    }
    let heads = ["device", "#share", "signal", "#RMS error before", "#after", "#noise floor"];
    let mut out = table(&heads, &rows);
    for gap in report.devices.iter().filter(|gap| !gap.regimes.is_empty()) {
        let regimes: Vec<String> =
            gap.regimes.iter().map(|regime| format!("{} ({})", regime.when, percent(regime.share))).collect();
        out.push_str(&format!("<p>{} shows it when {}.</p>\n", escape(&gap.device), escape(&regimes.join(", "))));
    }
    out
}

fn error(signal: &SignalGap, error: Option<f64>, missing: Option<u64>, extra: Option<u64>) -> String {
    let mut text = match (error, signal.kind) {
        (Some(error), _) => quantity(error, &signal.unit),
        (None, SignalKind::Edge) => "no edge paired".to_owned(),
        (None, SignalKind::Level) => "–".to_owned(),
    };
    for (count, word) in [(missing, "missing"), (extra, "extra")] {
        if let Some(count) = count.filter(|count| *count > 0) {
            text.push_str(&format!(", {count} {word}"));
        }
    }
    text
}

/// What each cause is, with its parameters and their intervals.
pub(super) fn parameters(report: &Report) -> String {
    let mut out = String::new();
    for cause in &report.cause {
        out.push_str(&about(cause));
        let rows: Vec<Vec<String>> = cause
            .parameters
            .iter()
            .map(|parameter| {
                let fixed = if parameter.not_identifiable { "not fixed by these data" } else { "" };
                vec![words(&parameter.name), parameter.in_words(), fixed.to_owned()]
            })
            .chain(cause.texts.iter().map(|(name, text)| vec![words(name), text.clone(), String::new()]))
            .collect();
        out.push_str(&table(&["parameter", "value", ""], &rows));
        if cause.class.len() > 1 {
            let members: Vec<String> = cause.class[1..]
                .iter()
                .map(|member| {
                    let effect = effect_on(&member.effect, &member.device, member.component.as_deref());
                    format!("{effect} ({})", words(member.place.name()))
                })
                .collect();
            let members = escape(&members.join("; "));
            out.push_str(&format!("<p>These data cannot tell it from: {members}.</p>\n"));
        }
    }
    out
}

fn about(cause: &Cause) -> String {
    let name = effect_on(&cause.effect, &cause.device, cause.component.as_deref());
    let place = words(cause.place.name());
    match effect::named(&cause.effect) {
        Some(known) => format!(
            "<p><strong>{}</strong> ({}): {}. <span class=\"quiet\">{}; {}.</span></p>\n",
            escape(&name),
            escape(&place),
            escape(known.summary),
            escape(known.equation),
            escape(known.source)
        ),
        None => format!("<p><strong>{}</strong> ({})</p>\n", escape(&name), escape(&place)),
    }
}

/// What would part the rivals from the cause.
pub(super) fn rivals(report: &Report) -> String {
    let row = |rival: &crate::gap::report::Rival| {
        let values: Vec<String> =
            rival.parameters.iter().map(|p| format!("{} {}", words(&p.name), quantity(p.value, &p.unit))).collect();
        vec![
            effect_on(&rival.effect, &rival.device, rival.component.as_deref()),
            words(rival.place.name()),
            values.join(", "),
            percent(rival.weight),
            rival.told_apart_by.clone(),
        ]
    };
    let rows: Vec<Vec<String>> = report.rivals.iter().map(row).collect();
    table(&["rival", "place", "fitted", "#weight", "told apart by"], &rows)
}

/// What it means for production.
pub(super) fn consequence(report: &Report) -> String {
    let Some(consequence) = &report.consequence else { return String::new() };
    let number = |number: Option<f64>| number.map_or_else(|| "–".to_owned(), |number| significant(number, 4));
    let row = |who: &str, what: &str, beside: &Beside| {
        vec![who.to_owned(), what.to_owned(), number(beside.recorded), number(beside.before), number(beside.after)]
    };
    let mut rows =
        vec![row("plant", "parts per hour", &consequence.parts_per_hour), row("", "cycle in s", &consequence.cycle_s)];
    for device in &consequence.devices {
        rows.push(row(&device.device, "parts per hour", &device.parts_per_hour));
        rows.push(row("", "cycle in s", &device.cycle_s));
    }
    let heads = ["", "", "#recorded", "#model as it is", "#with the effect"];
    format!("<section>\n<h2>What it means for production</h2>\n{}</section>\n", table(&heads, &rows))
}

/// What these traces do not excite, and signals on which model and trace do not agree.
pub(super) fn not_testable(report: &Report) -> String {
    // What the same words say of several effects of a device is one row.
    let mut rows: Vec<[String; 4]> = Vec::new();
    for entry in &report.not_testable {
        let device = entry.device.as_deref().map(|device| on(device, entry.component.as_deref()));
        let effect = entry.effect.as_deref().map_or_else(|| "all effects".to_owned(), words);
        let row =
            [device.unwrap_or_else(|| "all devices".to_owned()), effect, entry.reason.clone(), entry.needs.clone()];
        let same = rows.iter_mut().find(|other| (&other[0], &other[2], &other[3]) == (&row[0], &row[2], &row[3]));
        match same {
            Some(same) => same[1] = format!("{}, {}", same[1], row[1]),
            None => rows.push(row),
        }
    }
    let rows: Vec<Vec<String>> = rows.into_iter().map(Vec::from).collect();
    let mut out = table(&["device", "effect", "why not", "needed"], &rows);
    let mut list = |what: &str, names: &[String]| {
        if !names.is_empty() {
            out.push_str(&format!("<p>{what}: {}.</p>\n", escape(&names.join(", "))));
        }
    };
    list("Signals of the model that were not recorded", &report.signals.missing);
    list("Recorded signals that the model does not have, left out", &report.signals.ignored);
    list("Left out beside that", &report.left_out);
    let clock = |clock: &crate::gap::report::FoundClock| {
        format!("{} in {}: {:+.4} s, drift {:+.1} ppm", clock.name, clock.trace, clock.offset_s, 1e6 * clock.drift)
    };
    list(
        "Clocks beside that of the commands, as they were found",
        &report.clocks.iter().map(clock).collect::<Vec<_>>(),
    );
    if out.is_empty() { out } else { format!("<section>\n<h2>What could not be tested</h2>\n{out}</section>\n") }
}

/// What it was made from.
pub(super) fn made_from(report: &Report) -> String {
    let Some(made) = &report.made_from else { return String::new() };
    let mut parts = vec![format!("model <code>{}</code>", escape(&made.model))];
    let mut list = |what: &str, paths: &[String]| {
        let codes: Vec<String> = paths.iter().map(|path| format!("<code>{}</code>", escape(path))).collect();
        if !codes.is_empty() {
            parts.push(format!("{what} {}", codes.join(", ")));
        }
    };
    list("trained on", &made.train);
    list("held out", &made.holdout);
    list("left out", made.mask.as_slice());
    format!("<footer class=\"quiet\">Made from {}.</footer>\n", parts.join("; "))
}
