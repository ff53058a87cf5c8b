//! The one screen that a run shows on a terminal: the plant from above on the left, how it goes on the right, and the last
//! that happened below.

use std::collections::VecDeque;
use std::time::Duration;

use crossterm::style::Color;

use super::picture::{Picture, Style};
use super::plan::{self, Plan};
use crate::adapter::Traffic;
use crate::run::live::{ExchangeFrame, SimulationFrame};
use crate::run::{Facts, Gravity, Notice, Quantiles, ServerPlace, Speed};
use crate::time::{Instant, format_duration};

const DIM: Style = Style::of(Color::DarkGrey);
const TITLE: Style = Style::of(Color::Cyan).bold();
const HEAD: Style = Style::PLAIN.bold();
const GOOD: Style = Style::of(Color::Green);
const WARN: Style = Style::of(Color::Yellow);
const BAD: Style = Style::of(Color::Red).bold();

/// Columns of the panel on the right.
const PANEL: usize = 34;
/// The least that anything can be shown in.
const LEAST_COLUMNS: usize = 60;
const LEAST_ROWS: usize = 20;
/// Rows of the log at the bottom.
const LOG_ROWS: usize = 3;

/// Everything that the screen shows.
pub struct Status {
    facts: Facts,
    plan: Plan,
    pub simulation: SimulationFrame,
    pub exchange: ExchangeFrame,
    pub round_trip: Quantiles,
    pub ending: bool,
    rates: Rates,
    log: VecDeque<Notice>,
}

impl Status {
    /// The screen of a run that begins.
    pub fn new(facts: &Facts) -> Status {
        Status {
            plan: Plan::new(&facts.plant),
            facts: facts.clone(),
            simulation: SimulationFrame::default(),
            exchange: ExchangeFrame::default(),
            round_trip: Quantiles::default(),
            ending: false,
            rates: Rates::default(),
            log: VecDeque::new(),
        }
    }

    /// Takes what happened.
    pub fn note(&mut self, notice: Notice) {
        self.log.push_back(notice);
        if self.log.len() > LOG_ROWS {
            self.log.pop_front();
        }
    }

    /// Takes the rates of what went through, `now` on any clock.
    pub fn sample(&mut self, now: Instant) {
        self.rates.sample(now, self.exchange.traffic);
    }

    /// Draws all of it into so many characters.
    pub fn draw(&self, columns: usize, rows: usize) -> Picture {
        let mut picture = Picture::new(columns, rows);
        if columns < LEAST_COLUMNS || rows < LEAST_ROWS {
            let text = format!("{}: the window is small ({LEAST_COLUMNS}×{LEAST_ROWS})", self.facts.model);
            picture.text(0, 0, &text, WARN);
            return picture;
        }
        self.header(&mut picture);
        let body = rows - 2 - LOG_ROWS;
        let left = columns - PANEL;
        let drawing = self.plan.draw(left - 2, body - 1, &self.simulation.registers, &self.simulation.parts);
        picture.draw(1, 2, &drawing);
        self.legend(&mut picture, 1, 1 + body);
        self.panel(&mut picture, left + 1, 2);
        self.log(&mut picture, rows - LOG_ROWS);
        picture
    }

    fn header(&self, picture: &mut Picture) {
        let at = picture.text(1, 0, &self.facts.model, TITLE);
        let map = &self.facts.plant.signal_map;
        let size = format!(
            "{} instances · {} signals · {} prototypes",
            self.facts.plant.instances.len(),
            map.signals().len(),
            self.facts.prototypes()
        );
        picture.text(at + 3, 0, &size, DIM);
        let keys = if self.ending { "ending …" } else { "q ends" };
        picture.text_right(picture.columns() - 1, 0, keys, DIM);
        let (dot, style, word) = match self.exchange.connected {
            true => ("●", GOOD, "session with"),
            false => ("○", WARN, "no session with"),
        };
        let at = picture.text(1, 1, dot, style);
        let at = picture.text(at + 1, 1, word, style);
        picture.text(at + 1, 1, &self.facts.server.to_string(), Style::PLAIN);
    }

    fn legend(&self, picture: &mut Picture, column: usize, row: usize) {
        let at = picture.text(column, row, "■", plan::BOX);
        let at = picture.text(at + 1, row, "box", DIM);
        let at = picture.text(at + 2, row, "■", plan::PALLET);
        let at = picture.text(at + 1, row, "pallet", DIM);
        let at = picture.text(at + 2, row, "─", Style::of(Color::DarkGreen));
        let at = picture.text(at + 1, row, "running", DIM);
        let at = picture.text(at + 2, row, "│", Style::of(Color::Red));
        picture.text(at + 1, row, "beam cut", DIM);
    }

    fn panel(&self, picture: &mut Picture, column: usize, row: usize) {
        let mut panel = Panel { picture, column, row };
        self.time(&mut panel);
        self.cycle(&mut panel);
        self.loop_time(&mut panel);
        self.signals(&mut panel);
        self.parts(&mut panel);
    }

    fn time(&self, panel: &mut Panel<'_>) {
        let now = self.simulation.now.seconds();
        let speed = match self.facts.speed {
            Speed::Max => "as fast as possible".to_owned(),
            Speed::Wall(1.0) => String::new(),
            Speed::Wall(factor) => format!("× {factor}"),
        };
        panel.head("time", &speed);
        match self.facts.duration {
            None => panel.line(&[("", &format!("{now:.1} s"))]),
            Some(duration) => {
                let total = duration.as_secs_f64();
                let part = if total > 0.0 { (now / total).clamp(0.0, 1.0) } else { 1.0 };
                panel.line(&[("", &format!("{now:.1} s of {}", format_duration(duration)))]);
                panel.bar(part);
            }
        }
    }

    fn cycle(&self, panel: &mut Panel<'_>) {
        let Facts { step, rates, .. } = &self.facts;
        panel.head("cycle", &format!("step {}", format_duration(*step)));
        panel.line(&[("levels ", &format!("{} / {}", format_duration(rates.high), format_duration(rates.low)))]);
        let step_us = &self.simulation.step_us;
        panel.line(&[("computing ", &micros(step_us.p50)), ("p99 ", &micros(step_us.p99))]);
        let (overruns, late) = (self.simulation.overruns, self.simulation.late_steps);
        panel.alarm(&[("overruns ", overruns)], &[("late ", late)]);
    }

    fn loop_time(&self, panel: &mut Panel<'_>) {
        panel.head("latency", "value out, answer back");
        match (&self.facts.server, self.round_trip.p50) {
            (ServerPlace::Foreign(_), _) => panel.line(&[("", "not measured: a foreign server")]),
            (ServerPlace::Memory, _) => panel.line(&[("", "not measured: lock-step")]),
            (_, None) => panel.line(&[("", "-")]),
            (_, p50) => panel.line(&[("p50 ", &micros(p50)), ("p99 ", &micros(self.round_trip.p99))]),
        }
    }

    fn signals(&self, panel: &mut Panel<'_>) {
        let per_second = |rate: f64| format!("{rate:.0}/s");
        let [values_in, values_out, messages_in, messages_out] = self.rates.present.map(per_second);
        panel.head("signals", "");
        panel.line(&[("in ", &values_in), ("out ", &values_out)]);
        panel.head("messages", "");
        panel.line(&[("in ", &messages_in), ("out ", &messages_out)]);
        let Traffic { messages_lost, .. } = self.exchange.traffic;
        panel.alarm(&[("lost ", messages_lost)], &[]);
    }

    fn parts(&self, panel: &mut Panel<'_>) {
        let counts = &self.simulation.counts;
        panel.head("boxes", "");
        panel.line(&[
            ("in ", &counts.boxes_in.to_string()),
            ("out ", &counts.boxes_out.to_string()),
            ("present ", &counts.boxes_present.to_string()),
        ]);
        panel.alarm(&[("lost ", counts.boxes_lost), ("collisions ", counts.collisions)], &[]);
    }

    fn log(&self, picture: &mut Picture, row: usize) {
        for (index, notice) in self.log.iter().enumerate() {
            let style = match notice.gravity {
                Gravity::Information => DIM,
                Gravity::Warning => WARN,
                Gravity::Error => BAD,
            };
            let at = picture.text(1, row + index, &format!("{:>9}", notice.at.to_string()), DIM);
            picture.text(at + 2, row + index, &notice.text, style);
        }
    }
}

/// Microseconds, in the unit that keeps them short.
fn micros(us: Option<f64>) -> String {
    match us {
        None => "-".to_owned(),
        Some(us) if us < 999.5 => format!("{us:.0} µs"),
        Some(us) if us < 99_950.0 => format!("{:.1} ms", us / 1e3),
        Some(us) => format!("{:.0} ms", us / 1e3),
    }
}

/// Lines of the panel, one below the other.
struct Panel<'a> {
    picture: &'a mut Picture,
    column: usize,
    row: usize,
}

impl Panel<'_> {
    fn head(&mut self, title: &str, aside: &str) {
        let at = self.picture.text(self.column, self.row, title, HEAD);
        self.picture.text(at + 1, self.row, aside, DIM);
        self.row += 1;
    }

    /// Names and values beside each other.
    fn line(&mut self, values: &[(&str, &str)]) {
        let mut at = self.column + 1;
        for (name, value) in values {
            at = self.picture.text(at, self.row, name, DIM);
            at = self.picture.text(at, self.row, value, Style::PLAIN) + 2;
        }
        self.row += 1;
    }

    /// Counts that should be 0, and counts that may be something.
    fn alarm(&mut self, grave: &[(&str, u64)], slight: &[(&str, u64)]) {
        let mut at = self.column + 1;
        for ((name, count), loud) in grave.iter().map(|one| (one, BAD)).chain(slight.iter().map(|one| (one, WARN))) {
            at = self.picture.text(at, self.row, name, DIM);
            let style = if *count > 0 { loud } else { Style::PLAIN };
            at = self.picture.text(at, self.row, &count.to_string(), style) + 2;
        }
        self.row += 1;
    }

    fn bar(&mut self, part: f64) {
        let width = PANEL - 10;
        let full = (part * width as f64).round() as usize;
        let at = self.picture.text(self.column + 1, self.row, &"━".repeat(full), GOOD);
        let at = self.picture.text(at, self.row, &"─".repeat(width - full), DIM);
        self.picture.text(at + 1, self.row, &format!("{:.0} %", part * 100.0), Style::PLAIN);
        self.row += 1;
    }
}

/// How much goes through in a second: values in and out, messages in and out.
#[derive(Default)]
struct Rates {
    samples: VecDeque<(Instant, Traffic)>,
    present: [f64; 4],
}

impl Rates {
    /// Rates are taken over so long.
    const WINDOW: Duration = Duration::from_secs(2);

    fn sample(&mut self, now: Instant, traffic: Traffic) {
        self.samples.push_back((now, traffic));
        while self.samples.len() > 2 && now.since(self.samples[1].0) >= Rates::WINDOW {
            self.samples.pop_front();
        }
        let (then, before) = self.samples[0];
        let span = now.since(then).as_secs_f64();
        if span > 0.0 {
            let rate = |now: u64, before: u64| now.saturating_sub(before) as f64 / span;
            self.present = [
                rate(traffic.values_in, before.values_in),
                rate(traffic.values_out, before.values_out),
                rate(traffic.messages_in, before.messages_in),
                rate(traffic.messages_out, before.messages_out),
            ];
        }
    }
}
