//! A signal over time, and what happens to it on its way: sensors and links.

use crate::chance::Dice;
use crate::plant::Kind;
use crate::quirk::Quirk;
use crate::switch::Delay;

/// A filter's output is known at these steps at most, s, and where it bends the most at these, in its time constants.
const FINE: f64 = 1e-4;
const FINEST: f64 = 1.0 / 64.0;

/// Of more counts between two points not each has an instant of its own.
const MOST_COUNTS: f64 = 16.0;

/// What is refreshed more often is not held, s: it would take longer to say than to run.
const SHORTEST_HOLD: f64 = 1e-6;

/// A signal as points in time. Between two points an edge holds, a level is on the line between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Stream {
    is_edge: bool,
    points: Vec<(f64, f64)>,
}

impl Stream {
    /// Nothing yet.
    pub fn new(is_edge: bool) -> Stream {
        Stream { is_edge, points: Vec::new() }
    }

    /// The next point; an edge keeps only its changes.
    pub fn push(&mut self, at: f64, value: f64) {
        let same = self.is_edge && self.points.last().is_some_and(|(_, last)| *last == value);
        if !same {
            self.points.push((at, value));
        }
    }

    /// A level that a counter tells parts of, as what stands in the counter: whole, from the instant on at which each is reached, and at every
    /// point that it had.
    pub fn counted(self) -> Stream {
        let mut out = Stream { is_edge: true, points: Vec::new() };
        for (k, &(at, value)) in self.points.iter().enumerate() {
            if let Some((then, before)) = k.checked_sub(1).map(|k| self.points[k]) {
                let (from, to) = (before.floor(), value.floor());
                let counts = (to - from).abs();
                let steps = 1..=counts.min(MOST_COUNTS) as i64;
                if counts <= MOST_COUNTS {
                    let reached = |edge: f64| then + (at - then) * (edge - before) / (value - before);
                    // Upwards a count begins at its own edge, downwards at that of the one before it.
                    let step = |k: i64| if to > from { (from + k as f64, 0.0) } else { (from - k as f64, 1.0) };
                    let each = steps.map(step);
                    out.points.extend(each.map(|(count, above)| (reached(count + above).clamp(then, at), count)));
                } else {
                    let there = |share: f64| (then + (at - then) * share, (before + (value - before) * share).floor());
                    out.points.extend(steps.map(|k| there(k as f64 / MOST_COUNTS)));
                }
            }
            out.points.push((at, value.floor()));
        }
        out
    }

    /// Its points.
    pub fn points(&self) -> &[(f64, f64)] {
        &self.points
    }

    /// What it is at `at`. Before its first point it is what that says.
    pub fn at(&self, at: f64) -> f64 {
        self.before(self.points.partition_point(|(time, _)| *time <= at), at)
    }

    /// What it is at `at`, where its first point after that is the one at `after`.
    fn before(&self, after: usize, at: f64) -> f64 {
        let before = self.points.get(after.saturating_sub(1)).copied().unwrap_or_default();
        match self.points.get(after) {
            Some(&(time, value)) if !self.is_edge && after > 0 => {
                before.1 + (value - before.1) * (at - before.0) / (time - before.0)
            }
            _ => before.1,
        }
    }

    /// What comes out of `quirk`, at a sensor of this `kind` or on a link, until `end`.
    pub fn through(self, quirk: &Quirk, kind: Kind, dice: &mut Dice, end: f64) -> Stream {
        let is_flag = kind == Kind::Flag;
        let value = |name: &str| quirk.value(name);
        match quirk.effect.as_str() {
            "dead-time" => self.later(|at| at + value("time")),
            "clock-drift" => self.later(|at| at * (1.0 + value("rate"))),
            "inverted" => self.map(|_, x| if is_flag { 1.0 - x } else { -x }),
            "wrong-unit" => self.map(|_, x| value("factor") * x),
            "offset" => self.map(|_, x| x + value("offset")),
            "gain" => self.map(|_, x| value("gain") * x),
            "drift" => self.map(|at, x| x + value("rate") * at),
            "quantisation" => self.map(|_, x| value("step") * (x / value("step")).round()),
            "blind-range" if !is_flag => self.map(|_, x| if x.abs() < value("length") { 0.0 } else { x }),
            "noise" => self.map(|_, x| x + value("sigma") * dice.normal()),
            "hysteresis" if !is_flag => self.sticky(0.5 * value("width")),
            "stuck" => self.stuck(value("value"), value("from")),
            "stale-hold" => self.held(value("time"), 0.0, end, |_| true),
            "intermittent" => self.away(value("time"), end, || dice.is_so(value("probability"))),
            "input-filter" if kind.is_edge() => self.stood(value("time_constant")),
            "input-filter" => self.filtered(value("time_constant"), end),
            "on-delay" => self.delayed(value("time"), 0.0),
            "off-delay" => self.delayed(0.0, value("time")),
            "bounce" => self.bouncing(value("time"), value("count") as usize),
            "lost-messages" => {
                let cycle = value("cycle");
                let mut loses = || !dice.is_so(value("probability"));
                if cycle > 0.0 { self.held(cycle, value("phase"), end, |_| loses()) } else { self.kept(loses) }
            }
            "sampling-jitter" => self.jittered(|| (value("sigma") * dice.normal()).abs()),
            _ => self,
        }
    }

    fn map(mut self, mut f: impl FnMut(f64, f64) -> f64) -> Stream {
        self.points.iter_mut().for_each(|(at, value)| *value = f(*at, *value));
        self
    }

    fn later(mut self, f: impl Fn(f64) -> f64) -> Stream {
        self.points.iter_mut().skip(1).for_each(|(at, _)| *at = f(*at));
        self
    }

    fn sticky(self, half: f64) -> Stream {
        let mut y = self.at(0.0);
        self.map(|_, x| {
            y += (x - y) - (x - y).clamp(-half, half);
            y
        })
    }

    fn stuck(mut self, value: f64, from: f64) -> Stream {
        self.points.retain(|(at, _)| *at < from);
        self.points.extend([(from, value)]);
        self.is_edge = true;
        self
    }

    /// Refreshed at multiples of `time` behind `phase`, when it is not missed; before that it is as at the start.
    fn held(self, time: f64, phase: f64, end: f64, mut is_fresh: impl FnMut(f64) -> bool) -> Stream {
        if time < SHORTEST_HOLD {
            return self;
        }
        let mut out = Stream::new(true);
        out.push(0.0, self.at(0.0));
        let mut after = 0;
        for k in 0..=(end / time) as usize {
            let at = phase + k as f64 * time;
            if at > 0.0 && is_fresh(at) {
                while self.points.get(after).is_some_and(|(time, _)| *time <= at) {
                    after += 1;
                }
                out.push(at, self.before(after, at));
            }
        }
        out
    }

    /// Single messages are lost; the first is not.
    fn kept(mut self, mut is_kept: impl FnMut() -> bool) -> Stream {
        let mut first = true;
        self.points.retain(|_| std::mem::take(&mut first) || is_kept());
        self
    }

    /// Zero for whole windows.
    fn away(self, time: f64, end: f64, mut is_away: impl FnMut() -> bool) -> Stream {
        let gone: Vec<bool> = (0..=(end / time) as usize).map(|_| is_away()).collect();
        let at_window = |k: usize| gone.get(k).copied().unwrap_or(false);
        let mut out = Stream { is_edge: self.is_edge, points: Vec::new() };
        let mut points = self.points.iter().peekable();
        for k in 0..gone.len() {
            let (from, to) = (k as f64 * time, (k + 1) as f64 * time);
            if at_window(k) {
                out.points.extend([(from, 0.0), (to - 1e-9, 0.0)]);
            } else if k == 0 || at_window(k - 1) {
                out.points.push((from, self.at(from)));
            }
            while let Some(point) = points.next_if(|(at, _)| *at < to) {
                if !at_window(k) && point.0 > from {
                    out.points.push(*point);
                }
            }
        }
        out
    }

    fn delayed(self, on: f64, off: f64) -> Stream {
        let mut delay = Delay::new(on, off);
        let mut out = Stream::new(true);
        let mut points = self.points.iter().peekable();
        while let Some(&(at, value)) = points.next() {
            if out.points.is_empty() {
                delay.set(f64::NEG_INFINITY, value != 0.0);
                out.push(at, value);
                continue;
            }
            delay.set(at, value != 0.0);
            let seen = at + if value != 0.0 { on } else { off };
            if points.peek().is_none_or(|(next, _)| *next > seen) {
                out.push(seen, value);
            }
        }
        out
    }

    /// What has stood for `time`.
    fn stood(self, time: f64) -> Stream {
        let mut out = Stream::new(true);
        for (k, &(at, value)) in self.points.iter().enumerate() {
            let next = self.points.get(k + 1).map_or(f64::INFINITY, |(at, _)| *at);
            match k {
                0 => out.push(at, value),
                _ if next > at + time => out.push(at + time, value),
                _ => {}
            }
        }
        out
    }

    fn bouncing(self, time: f64, count: usize) -> Stream {
        let mut out = Stream::new(true);
        for (k, &(at, value)) in self.points.iter().enumerate() {
            out.push(at, value);
            let next = self.points.get(k + 1).map_or(f64::INFINITY, |(at, _)| *at);
            let pulse = time / (2 * count.max(1)) as f64;
            for half in 1..=2 * count {
                let then = at + half as f64 * pulse;
                if k > 0 && then < next {
                    out.push(then, if half % 2 == 1 { 1.0 - value } else { value });
                }
            }
        }
        out
    }

    /// time·y' + y = x, x held between an edge's points and on the line between a level's: y as it is at each of its points.
    fn filtered(self, time: f64, end: f64) -> Stream {
        const SETTLED: f64 = 1e-12;
        let mut out = Stream::new(false);
        let mut y = self.at(0.0);
        for (k, &(from, held)) in self.points.iter().enumerate().filter(|(_, (from, _))| *from <= end) {
            let next = self.points.get(k + 1).filter(|_| !self.is_edge);
            let until = self.points.get(k + 1).map_or(end, |(at, _)| at.min(end));
            let slope = next.map_or(0.0, |(at, to)| if *at > from { (to - held) / (at - from) } else { 0.0 });
            // From how far it is off where it settles, which moves on with the line.
            let behind = slope * time;
            let apart = y - held + behind;
            let exit = |after: f64| held + slope * after - behind + apart * (-after / time).exp();
            let mut after = 0.0;
            while from + after < until && (after == 0.0 || (apart * (-after / time).exp()).abs() > SETTLED) {
                out.points.push((from + after, exit(after)));
                let finest = if self.is_edge { FINEST * time * (after / time).exp() } else { FINE };
                after += finest.clamp(1e-12, FINE);
            }
            y = exit(until - from);
            out.points.push((until, y));
        }
        out
    }

    /// A filtered command as a device is told it: step by step, each as high as the filter's exit is in the middle of it.
    pub fn in_steps(self) -> Stream {
        if self.is_edge {
            return self;
        }
        let next = |k: usize| self.points.get(k + 1).unwrap_or(&self.points[k]).1;
        let points = self.points.iter().enumerate().map(|(k, &(at, value))| (at, 0.5 * (value + next(k))));
        Stream { is_edge: true, points: points.collect() }
    }

    fn jittered(mut self, mut late: impl FnMut() -> f64) -> Stream {
        let mut last = 0.0_f64;
        for (at, _) in self.points.iter_mut().skip(1) {
            *at = (*at + late()).max(last);
            last = *at;
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::quirk;

    fn flag() -> Stream {
        let mut stream = Stream::new(true);
        for (at, value) in [(0.0, 0.0), (1.0, 1.0), (1.05, 0.0), (2.0, 1.0), (3.0, 0.0)] {
            stream.push(at, value);
        }
        stream
    }

    fn passed(effect: &str, parameters: &[(&str, f64)]) -> Vec<(f64, f64)> {
        let mut dice = Dice::new(1, 1);
        flag().through(&quirk("D", effect, parameters), Kind::Flag, &mut dice, 4.0).points
    }

    #[test]
    fn flags_on_their_way() {
        let check = |effect: &str, parameters: &[(&str, f64)], expected: &[(f64, f64)]| {
            let found = passed(effect, parameters);
            let is_so = found.len() == expected.len()
                && found.iter().zip(expected).all(|(f, e)| (f.0 - e.0).abs() < 1e-9 && f.1 == e.1);
            assert!(is_so, "{effect}: {found:?}");
        };
        check("dead-time", &[("time", 0.5)], &[(0.0, 0.0), (1.5, 1.0), (1.55, 0.0), (2.5, 1.0), (3.5, 0.0)]);
        check("on-delay", &[("time", 0.1)], &[(0.0, 0.0), (2.1, 1.0), (3.0, 0.0)]);
        check("input-filter", &[("time_constant", 0.1)], &[(0.0, 0.0), (2.1, 1.0), (3.1, 0.0)]);
        check("stale-hold", &[("time", 0.7)], &[(0.0, 0.0), (2.1, 1.0), (3.5, 0.0)]);
        // What is refreshed ten million times a second is not held, and ends within this life.
        check("stale-hold", &[("time", 1e-7)], flag().points());
        check("stuck", &[("value", 1.0), ("from", 1.5)], &[(0.0, 0.0), (1.0, 1.0), (1.05, 0.0), (1.5, 1.0)]);
    }

    #[test]
    fn an_off_delay_joins_what_comes_again_in_time() {
        let found = passed("off-delay", &[("time", 1.0)]);
        assert_eq!(found, [(0.0, 0.0), (1.0, 1.0), (4.0, 0.0)]);
    }

    #[test]
    fn a_level_lies_on_the_line_between_its_points() {
        let mut level = Stream::new(false);
        level.push(0.0, 0.0);
        level.push(1.0, 2.0);
        assert_eq!([level.at(-1.0), level.at(0.25), level.at(2.0)], [0.0, 0.5, 2.0]);
    }

    /// Out, back at once, held, back: what does not stand is never seen, and no code comes between two others.
    #[test]
    fn a_filtered_code_is_one_that_has_stood() {
        let mut code = Stream::new(true);
        for (at, value) in [(0.0, 0.0), (1.0, 2.0), (1.5, 1.0), (1.52, 0.0), (1.54, 2.0), (2.0, 0.0)] {
            code.push(at, value);
        }
        let mut dice = Dice::new(1, 1);
        let out = code.through(&quirk("D", "input-filter", &[("time_constant", 0.1)]), Kind::Code, &mut dice, 4.0);
        assert_eq!(out.points, [(0.0, 0.0), (1.1, 2.0), (2.1, 0.0)]);
    }

    /// Up to 2.5 and down to 0.5 within a second each: 1 and 2 are reached on the way up, 1 and 0 below 2 and 1 on the way down.
    #[test]
    fn a_counter_counts_when_it_is_reached() {
        let mut level = Stream::new(false);
        for (at, value) in [(0.0, 0.0), (1.0, 2.5), (2.0, 0.5), (3.0, -0.5)] {
            level.push(at, value);
        }
        let counted = level.counted();
        let expected = [
            (0.0, 0.0),
            (0.4, 1.0),
            (0.8, 2.0),
            (1.0, 2.0),
            (1.25, 1.0),
            (1.75, 0.0),
            (2.0, 0.0),
            (2.5, -1.0),
            (3.0, -1.0),
        ];
        let is_so = |(one, other): (&(f64, f64), &(f64, f64))| (one.0 - other.0).abs() < 1e-12 && one.1 == other.1;
        assert!(
            counted.points.len() == expected.len() && counted.points.iter().zip(&expected).all(is_so),
            "{:?}",
            counted.points
        );
        let late = counted.through(&quirk("D", "dead-time", &[("time", 0.1)]), Kind::Count, &mut Dice::new(1, 1), 4.0);
        assert_eq!([0.45, 0.55, 1.8, 1.9].map(|at| late.at(at)), [0.0, 1.0, 1.0, 0.0]);
    }

    /// However short its time is, and whenever the step comes; what it lets through on average does not depend on its steps.
    #[test]
    fn a_filter_begins_when_its_step_comes() {
        for time in [1e-5, 1e-3, 0.1] {
            let mut step = Stream::new(true);
            step.push(0.0, 0.0);
            step.push(0.500_037, 1.0);
            let mut dice = Dice::new(1, 1);
            let out =
                step.through(&quirk("D", "input-filter", &[("time_constant", time)]), Kind::Level, &mut dice, 2.0);
            let there = out.at(0.500_037 + time);
            assert!((there - (1.0 - (-1.0_f64).exp())).abs() < 2e-4, "{time}: {there}");
            let steps = out.in_steps();
            let sum: f64 = steps.points.windows(2).map(|pair| pair[0].1 * (pair[1].0 - pair[0].0)).sum();
            assert!((sum - (2.0 - 0.500_037 - time)).abs() < 1e-6 + 1e-3 * time, "{time}: {sum}");
        }
    }

    #[test]
    fn a_filter_leaves_37_per_cent_after_its_time() {
        let mut step = Stream::new(true);
        step.push(0.0, 0.0);
        step.push(0.5, 1.0);
        let mut dice = Dice::new(1, 1);
        let out = step.through(&quirk("D", "input-filter", &[("time_constant", 0.1)]), Kind::Level, &mut dice, 2.0);
        assert!((out.at(0.6) - (1.0 - (-1.0_f64).exp())).abs() < 1e-3, "{}", out.at(0.6));
    }
}
