//! `exam.html`: an exam as one page that needs nothing else.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use super::answer::{Magnitude, Sort};
use super::curve;
use super::judge::Judged;
use super::rates::Rates;
use super::target::Reached;
use super::whole::{Exam, Groups, effect_of};
use crate::xml::escape;

const STYLE: &str = include_str!("style.css");

/// Renders the page.
pub fn page(exam: &Exam) -> String {
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<title>Exam of the diagnosis</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n<h1>Exam of the diagnosis</h1>\n\
         <p>{}.{}</p>\n",
        taken(exam),
        exam.seconds_per_case.map_or(String::new(), |seconds| format!(" A case took {seconds:.1} s on average."))
    );
    rates(exam, &mut page);
    seconds(exam, &mut page);
    calibration(exam, &mut page);
    let is_asked_for =
        |name: &str| [Magnitude::None, Magnitude::Clear, Magnitude::Gross].iter().any(|of| of.name() == name);
    groups("By magnitude", &exam.by_magnitude, is_asked_for, &mut page);
    page.push_str("<p class=\"quiet\">Beneath each rate its 95 % interval and how many were counted. From here on at magnitudes clear and gross; ");
    page.push_str("coloured where the interval does not reach the target.</p>\n");
    groups("By kind of device", &exam.by_device, |_| true, &mut page);
    groups("By plant", &exam.by_plant, |_| true, &mut page);
    groups("Effect by effect", &exam.by_effect, |_| true, &mut page);
    matrix(exam, &mut page);
    classes(exam, &mut page);
    confusion(exam, &mut page);
    cases(exam, &mut page);
    page.push_str("</body>\n</html>\n");
    page
}

/// How many cases it has, and when and of which seed they were opened.
fn taken(exam: &Exam) -> String {
    let Exam { cases, date, seed, sittings, .. } = exam;
    if sittings.is_empty() {
        return format!("{cases} cases, answers opened on {date}, seed {seed}");
    }
    let each = sittings.iter().map(|of| format!("{} on {}, seed {}", of.cases, of.date, of.seed));
    format!("{cases} cases in {} sittings, answers opened: {}", sittings.len(), each.collect::<Vec<_>>().join("; "))
}

fn rates(exam: &Exam, page: &mut String) {
    page.push_str("<h2>Rates at magnitudes clear and gross</h2>\n<table>\n<tr><th>what</th><th class=\"n\">value</th>");
    page.push_str("<th class=\"n\">95 %</th><th class=\"n\">cases</th><th>target</th><th></th></tr>\n");
    for shown in exam.rates.shown() {
        let reached = shown.target.and_then(|target| target.reached(shown.rate));
        let class = match reached {
            Some(Reached::Met) => "met",
            Some(Reached::InValue) => "near",
            Some(Reached::Missed) => "missed",
            None => "",
        };
        let _ = writeln!(
            page,
            "<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td>{}</td><td class=\"{class}\">{}</td></tr>",
            escape(shown.words),
            shown.rate.percent(),
            shown.rate.within(),
            shown.rate.n,
            shown.target.map_or(String::new(), |target| target.to_string()),
            reached.map_or("", Reached::words)
        );
    }
    page.push_str("</table>\n<p class=\"quiet\">A target is met where the whole interval lies in it. Wilson's intervals, but of the shrink, ");
    page.push_str("whose is that of a mean, and of the calibration error, by the delta method.</p>\n");
}

fn seconds(exam: &Exam, page: &mut String) {
    if exam.seconds.is_empty() {
        return;
    }
    page.push_str("<h2>How long a case takes</h2>\n<table>\n<tr><th>plant</th><th class=\"n\">seconds</th><th class=\"n\">95 %</th>");
    page.push_str("<th class=\"n\">cases</th></tr>\n");
    for (plant, rate) in &exam.seconds {
        let _ = writeln!(
            page,
            "<tr><td>{}</td><td class=\"n\">{:.1}</td><td class=\"n\">{}</td><td class=\"n\">{}</td></tr>",
            escape(plant),
            rate.value.unwrap_or_default(),
            rate.ci95.map_or(String::new(), |[low, high]| format!("{low:.1} to {high:.1}")),
            rate.n
        );
    }
    page.push_str("</table>\n<p class=\"quiet\">By the clock, with as many side by side as were asked for; oracles not counted.</p>\n");
}

fn calibration(exam: &Exam, page: &mut String) {
    if exam.calibration.is_empty() {
        return;
    }
    page.push_str("<h2>Do the weights mean what they say?</h2>\n<figure>\n");
    page.push_str(&curve::svg(&exam.calibration));
    page.push_str("\n<figcaption>How many answers are right, over how much they and their class weigh, single effects, with Wilson's intervals; ");
    page.push_str(
        "a point is as large as it has answers. On the dashed line weights are shares.</figcaption>\n</figure>\n",
    );
    page.push_str("<table>\n<tr><th>weight</th><th class=\"n\">on average</th><th class=\"n\">right</th><th class=\"n\">95 %</th>");
    page.push_str("<th class=\"n\">answers</th></tr>\n");
    for bin in &exam.calibration {
        let _ = writeln!(
            page,
            "<tr><td>{:.1} to {:.1}</td><td class=\"n\">{:.3}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td></tr>",
            bin.weights[0],
            bin.weights[1],
            bin.weight,
            bin.right.percent(),
            bin.right.within(),
            bin.right.n
        );
    }
    page.push_str("</table>\n");
}

/// The rates of groups: a row for each, a column for each rate that any of them has. `is_asked_for`: whether the targets are about a group.
fn groups(head: &str, groups: &Groups, is_asked_for: impl Fn(&str) -> bool, page: &mut String) {
    let none = Rates::default();
    let is_there = |id: &str| groups.values().any(|rates| rates.contains_key(id));
    let columns: Vec<_> = none.shown().into_iter().filter(|shown| is_there(shown.id)).collect();
    if columns.is_empty() {
        return;
    }
    let _ = writeln!(page, "<h2>{head}</h2>\n<div class=\"wide\">\n<table class=\"dense\">\n<tr><th></th>");
    for column in &columns {
        let _ = write!(page, "<th class=\"n\">{}</th>", escape(column.name));
    }
    page.push_str("</tr>\n");
    for (name, rates) in groups {
        let _ = write!(page, "<tr><td>{}</td>", escape(name));
        for column in &columns {
            let Some(rate) = rates.get(column.id) else {
                page.push_str("<td></td>");
                continue;
            };
            let is_missed = is_asked_for(name) && column.target.is_some_and(|target| target.is_out_of_reach(rate));
            let within = |[low, high]: [f64; 2]| format!("{:.0} to {:.0}; ", 100.0 * low, 100.0 * high);
            let _ = write!(
                page,
                "<td class=\"n{}\">{:.0} %<br><small>{}{}</small></td>",
                if is_missed { " missed" } else { "" },
                100.0 * rate.value.unwrap_or_default(),
                rate.ci95.map_or(String::new(), within),
                rate.n
            );
        }
        page.push_str("</tr>\n");
    }
    page.push_str("</table>\n</div>\n");
}

/// In which column of the matrix an answer about one effect stands.
fn column(one: &Judged) -> Column {
    let is_named = one.truth_in_class == Some(true);
    match (one.single_right, one.answered.as_slice()) {
        (Some(true), _) => Column::Right,
        (_, [_]) if is_named => Column::OtherClass,
        (_, [answer]) if one.verdict != "partial" => Column::Effect(effect_of(answer).to_owned()),
        (_, [_, _, ..]) if one.verdict != "partial" => Column::Several,
        _ => Column::Verdict(one.verdict.clone()),
    }
}

/// The columns of the matrix, in their order.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Column {
    Right,
    OtherClass,
    Effect(String),
    Several,
    Verdict(String),
}

impl Column {
    fn head(&self) -> &str {
        match self {
            Column::Right => "right",
            Column::OtherClass => "in another class",
            Column::Several => "several effects",
            Column::Effect(name) | Column::Verdict(name) => name,
        }
    }
}

/// The confusion matrix of single effects.
fn matrix(exam: &Exam, page: &mut String) {
    let mut rows: BTreeMap<&str, BTreeMap<Column, usize>> = BTreeMap::new();
    for one in exam.judged.iter().filter(|one| one.sort == Sort::Single && one.magnitude.counts()) {
        let Some(truth) = one.truth.first() else { continue };
        *rows.entry(effect_of(truth)).or_default().entry(column(one)).or_default() += 1;
    }
    if rows.is_empty() {
        return;
    }
    let columns: BTreeSet<&Column> = rows.values().flat_map(BTreeMap::keys).collect();
    let _ = writeln!(
        page,
        "<h2>Confusion matrix of single effects</h2>\n<p class=\"quiet\">A row for what was true, a column for what was answered.</p>\n<div class=\"wide\">\n<table class=\"matrix\">"
    );
    page.push_str("<tr><th></th>");
    for column in &columns {
        let _ = write!(page, "<th class=\"up\"><span>{}</span></th>", escape(column.head()));
    }
    page.push_str("</tr>\n");
    for (truth, counts) in &rows {
        let _ = write!(page, "<tr><td>{}</td>", escape(truth));
        for column in &columns {
            match counts.get(column) {
                None => page.push_str("<td></td>"),
                Some(n) if **column == Column::Right => drop(write!(page, "<td class=\"met\">{n}</td>")),
                Some(n) => drop(write!(page, "<td class=\"missed\">{n}</td>")),
            }
        }
        page.push_str("</tr>\n");
    }
    page.push_str("</table>\n</div>\n");
}

/// How many effects a recording leaves open, to anyone, and to the diagnosis.
fn classes(exam: &Exam, page: &mut String) {
    let [known, named] = [&exam.true_classes, &exam.named_classes];
    if known.n == 0 {
        return;
    }
    page.push_str("<h2>Effects that a recording cannot tell apart</h2>\n<table>\n");
    page.push_str("<tr><th>classes of single effects</th><th class=\"n\">cases</th><th class=\"n\">median size (at most 2)</th><th>size: cases</th></tr>\n");
    for (what, sizes) in [("by the plants themselves", known), ("as they were named", named)] {
        let counts: Vec<String> = sizes.counts.iter().map(|(size, cases)| format!("{size}: {cases}")).collect();
        let median = sizes.median.map_or("–".to_owned(), |median| median.to_string());
        let _ = writeln!(
            page,
            "<tr><td>{what}</td><td class=\"n\">{}</td><td class=\"n\">{median}</td><td>{}</td></tr>",
            sizes.n,
            counts.join(", ")
        );
    }
    page.push_str("</table>\n");
}

fn confusion(exam: &Exam, page: &mut String) {
    page.push_str("<h2>What was answered, by what was true</h2>\n<table>\n<tr><th>true</th><th>answered</th></tr>\n");
    for (truth, answers) in &exam.confusion {
        let answers: Vec<String> = answers.iter().map(|(answer, n)| format!("{n} × {}", escape(answer))).collect();
        let _ = writeln!(page, "<tr><td>{}</td><td>{}</td></tr>", escape(truth), answers.join("<br>"));
    }
    page.push_str("</table>\n");
}

fn cases(exam: &Exam, page: &mut String) {
    page.push_str(
        "<h2>Cases</h2>\n<table>\n<tr><th>case</th><th>shows</th><th>true</th><th>verdict</th><th>answered</th>",
    );
    page.push_str("<th class=\"n\">gone</th><th class=\"n\">s</th></tr>\n");
    for one in &exam.judged {
        let _ = writeln!(
            page,
            "<tr{}><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{:.1}</td></tr>",
            if one.is_wrong() { " class=\"wrong\"" } else { "" },
            escape(&one.case),
            one.magnitude.name(),
            escape(&in_class(&one.truth, &one.true_class)),
            one.verdict,
            escape(&one.answered.join("; ")),
            one.shrink.map_or("–".to_owned(), |shrink| format!("{:.0} %", 100.0 * shrink)),
            one.seconds
        );
    }
    page.push_str("</table>\n");
    for (case, why) in &exam.failed {
        let _ = writeln!(page, "<p>{} has no verdict: {}</p>", escape(case), escape(why));
    }
}

/// The truth, with all that nobody could tell from it.
fn in_class(truth: &[String], class: &[String]) -> String {
    let others: Vec<&str> = class.iter().filter(|member| !truth.contains(member)).map(String::as_str).collect();
    let truth = truth.join("; ");
    if others.is_empty() { truth } else { format!("{truth} (or {})", others.join(", or ")) }
}
