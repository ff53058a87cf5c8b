//! `exam.html`: an exam as one page that needs nothing else.

use std::fmt::Write as _;

use super::rates::{Exam, Rate};
use crate::xml::escape;

const STYLE: &str = "body{font:15px/1.45 system-ui,sans-serif;margin:2rem auto;max-width:70rem;padding:0 1rem;color:#222}
table{border-collapse:collapse;margin:.5rem 0 1.5rem}td,th{padding:.2rem .7rem;text-align:left;border-bottom:1px solid #ddd}
td.n{text-align:right;font-variant-numeric:tabular-nums}tr.wrong td{background:#fdecea}h2{margin-top:2rem}";

/// Renders the page.
pub fn page(exam: &Exam) -> String {
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>Exam of the diagnosis</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<h1>Exam of the diagnosis</h1>\n\
         <p>{} cases, answers opened on {}, seed {}.</p>\n",
        exam.cases, exam.date, exam.seed
    );
    rates(exam, &mut page);
    classes(exam, &mut page);
    confusion(exam, &mut page);
    cases(exam, &mut page);
    page.push_str("</body>\n</html>\n");
    page
}

fn rates(exam: &Exam, page: &mut String) {
    let r = &exam.rates;
    let targeted = [
        ("device right", &r.device_right, "at least 99 %"),
        ("single effect right", &r.single_right, "at least 95 %"),
        ("false alarms where nothing is wrong", &r.false_alarm, "at most 2 %"),
        ("outside of the library: unknown or partial", &r.outside_right, "at least 85 %"),
        ("outside of the library: a sure effect", &r.outside_sure_wrong, "at most 5 %"),
        ("both of two", &r.both_of_two, "at least 85 %"),
        ("shrink, of the oracle's", &r.shrink_of_oracle, "at least 95 %"),
        ("parameters in their interval", &r.interval_cover, "90 to 98 %"),
        ("calibration error of the weights", &r.ece, "at most 5 %"),
        ("single effect in the class that was named, whatever its size", &r.truth_in_class, ""),
        ("truth among causes, classes and rivals", &r.truth_named, ""),
        ("faint: sure and wrong", &r.faint_sure_wrong, "at most 5 %"),
    ];
    page.push_str("<h2>Rates at magnitudes clear and gross</h2>\n<table>\n");
    page.push_str("<tr><th>what</th><th>value</th><th>95 %</th><th>cases</th><th>target</th></tr>\n");
    for (what, rate, target) in targeted {
        row(page, what, rate, target);
    }
    for (head, groups) in [("by magnitude", &exam.by_magnitude), ("by device", &exam.by_device)] {
        let _ = writeln!(page, "<tr><th colspan=\"5\">single effect right, {head}</th></tr>");
        for (name, rate) in groups {
            row(page, name, rate, "");
        }
    }
    page.push_str("</table>\n");
}

fn row(page: &mut String, what: &str, rate: &Rate, target: &str) {
    let percent = |value: f64| format!("{:.1} %", 100.0 * value);
    let value = rate.value.map_or("–".to_owned(), percent);
    let within = rate.ci95.map_or(String::new(), |[low, high]| format!("{} to {}", percent(low), percent(high)));
    let _ = writeln!(
        page,
        "<tr><td>{}</td><td class=\"n\">{value}</td><td class=\"n\">{within}</td><td class=\"n\">{}</td><td>{target}</td></tr>",
        escape(what),
        rate.n
    );
}

/// How many effects a recording leaves open, to anyone, and to the diagnosis.
fn classes(exam: &Exam, page: &mut String) {
    let [known, named] = [&exam.true_classes, &exam.named_classes];
    if known.n == 0 {
        return;
    }
    page.push_str("<h2>Effects that a recording cannot tell apart</h2>\n<table>\n");
    page.push_str("<tr><th>classes of single effects</th><th>cases</th><th>median size (at most 2)</th><th>size: cases</th></tr>\n");
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
    page.push_str("<th>gone</th><th>s</th></tr>\n");
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
