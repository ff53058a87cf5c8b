//! A pneumatic cylinder that pushes: no ramp, two switches at its ends.

use crate::drive::supplied;
use crate::plant::Device;
use crate::quirk::{Quirk, Quirks};
use crate::sensor::Along;
use crate::switch::Delay;
use crate::train::Train;

/// What a pusher is built to.
#[derive(Clone, Debug)]
pub struct PusherParameters {
    pub stroke: f64,
    pub extend_speed: f64,
    pub retract_speed: f64,
    pub limit_tolerance: f64,
}

/// A pusher.
#[derive(Clone, Debug)]
pub struct Pusher {
    parameters: PusherParameters,
    fastest: f64,
    supply: f64,
    cushion: Option<(f64, f64)>,
    lag: f64,
    coast: Option<f64>,
    coils: [Delay; 2],
    /// After a rest it starts so much later for each second of rest, up to so much.
    sticks: Option<(f64, f64)>,
    /// Its supply sags by this share with every stroke and recovers with this time constant.
    sags: Option<(f64, f64)>,
    sag: f64,
    rested_since: f64,
    wakes: f64,
    command: f64,
    speed: f64,
    position: f64,
    extended: Along,
    retracted: Along,
    train: Train,
}

impl Pusher {
    /// A pusher called `name`, retracted.
    pub fn new(parameters: &PusherParameters, quirks: &[Quirk], name: &str) -> Pusher {
        let all = Quirks::of(quirks, name);
        let gain = all.value("gain-error", "gain").unwrap_or(1.0);
        let backwards = 1.0 - all.value("direction-asymmetry", "asymmetry").unwrap_or(0.0);
        let pair = |name: &str, first: &str, second: &str| {
            all.get(name).map(|quirk| (quirk.value(first), quirk.value(second)))
        };
        let parameters = PusherParameters {
            stroke: all.parameter("stroke", parameters.stroke),
            extend_speed: gain * all.parameter("extendSpeed", parameters.extend_speed),
            retract_speed: gain * backwards * all.parameter("retractSpeed", parameters.retract_speed),
            limit_tolerance: parameters.limit_tolerance,
        };
        let coil = || Delay::of(all, "switch-on-delay", "switch-off-delay");
        Pusher {
            parameters,
            fastest: all.value("velocity-limit", "limit").unwrap_or(f64::INFINITY),
            supply: 1.0 - all.value("supply-drop", "fraction").unwrap_or(0.0),
            cushion: pair("end-cushioning", "length", "ratio"),
            lag: all.value("first-order-lag", "time_constant").unwrap_or(0.0),
            coast: all.value("coasting", "deceleration"),
            coils: [coil(), coil()],
            sticks: pair("x-sticks-after-a-rest", "rate", "most"),
            sags: pair("x-supply-sags-with-use", "share", "time"),
            sag: 0.0,
            rested_since: 0.0,
            wakes: 0.0,
            command: 0.0,
            speed: 0.0,
            position: 0.0,
            extended: Along::new(all, "limitExtended", false),
            retracted: Along::new(all, "limitRetracted", true),
            train: Train::new(all),
        }
    }

    /// How far its plate is out, m.
    pub fn out(&self) -> f64 {
        self.train.load()
    }

    /// What it wants to move at, not looking at its ends.
    fn wish(&self, now: f64, others: usize) -> f64 {
        let base = match (self.coils[0].at(now), self.coils[1].at(now)) {
            (true, false) => self.parameters.extend_speed,
            (false, true) => -self.parameters.retract_speed,
            _ => 0.0,
        };
        let speed = base * supplied(self.supply, others) * (1.0 - self.sag);
        let speed = speed.clamp(-self.fastest, self.fastest);
        let left = if speed > 0.0 { self.parameters.stroke - self.position } else { self.position };
        match self.cushion {
            Some((length, ratio)) if left <= length => ratio * speed,
            _ => speed,
        }
    }

    fn is_at_an_end(&self, wish: f64) -> bool {
        wish > 0.0 && self.position >= self.parameters.stroke || wish < 0.0 && self.position <= 0.0
    }

    fn switches(&mut self) {
        let load = self.train.load();
        let tolerance = self.parameters.limit_tolerance + 1e-12;
        let near_end = self.parameters.stroke - tolerance;
        self.extended.see_past(load >= near_end, load, near_end);
        self.retracted.see_past(load <= tolerance, load, tolerance);
    }
}

impl Device for Pusher {
    fn command(&mut self, now: f64, port: &str, value: f64) {
        if port != "command" {
            return;
        }
        if let Some((rate, most)) = self.sticks
            && self.speed == 0.0
            && value != self.command
            && value != 0.0
        {
            self.wakes = now + (rate * (now - self.rested_since)).min(most);
        }
        self.command = value;
        self.coils[0].set(now, value == 1.0);
        self.coils[1].set(now, value == 2.0);
    }

    fn advance(&mut self, now: f64, span: f64, others: usize) {
        let start = now - span;
        let wish = if start < self.wakes { 0.0 } else { self.wish(start, others) };
        let wish = if self.is_at_an_end(wish) { 0.0 } else { wish };
        if wish == 0.0
            && let Some(brake) = self.coast
        {
            self.speed -= self.speed.clamp(-brake * span, brake * span);
        } else if self.lag > 0.0 {
            self.speed = wish + (self.speed - wish) * (-span / self.lag).exp();
        } else {
            self.speed = wish;
        }
        let before = self.position;
        self.position = (self.position + self.speed * span).clamp(0.0, self.parameters.stroke);
        if self.position == before && self.is_at_an_end(self.speed) {
            self.speed = 0.0;
        }
        if self.speed != 0.0 {
            self.rested_since = now;
        }
        if let Some((share, time)) = self.sags {
            self.sag += share * (self.position - before).abs() / self.parameters.stroke - self.sag * span / time;
        }
        self.train.advance(span, self.position, self.speed);
        self.switches();
    }

    fn read(&self, _now: f64, values: &mut Vec<f64>) {
        let is_running = self.speed.abs() > 1e-3 && !self.is_at_an_end(self.speed);
        let flags = [self.extended.is_on(), self.retracted.is_on(), is_running, false, false];
        values.extend(flags.map(f64::from));
    }

    fn moving(&self) -> usize {
        usize::from(self.speed.abs() > 1e-3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{axis_quirk, quirk};

    /// When the pusher, sent out at 0, is first seen at its end.
    fn arrives(quirks: &[Quirk]) -> f64 {
        let parameters =
            PusherParameters { stroke: 0.5, extend_speed: 0.5, retract_speed: 0.5, limit_tolerance: 0.002 };
        let mut pusher = Pusher::new(&parameters, quirks, "P");
        pusher.command(0.0, "command", 1.0);
        let mut values = Vec::new();
        for k in 1.. {
            let now = f64::from(k) * 1e-4;
            pusher.advance(now, 1e-4, 0);
            values.clear();
            pusher.read(now, &mut values);
            if values[0] != 0.0 {
                return now;
            }
            assert!(now < 60.0, "it never arrives");
        }
        0.0
    }

    #[test]
    fn it_arrives_when_way_and_speed_say() {
        let check = |quirks: &[Quirk], at: f64| {
            let found = arrives(quirks);
            assert!((found - at).abs() < 1.5e-4, "{found} {at}");
        };
        check(&[], 0.996);
        check(&[quirk("P", "gain-error", &[("gain", 0.5)])], 1.992);
        check(&[quirk("P", "end-cushioning", &[("length", 0.05), ("ratio", 0.5)])], 0.9 + 0.048 / 0.25);
        check(&[quirk("P", "switch-on-delay", &[("time", 0.1)])], 1.096);
        check(&[quirk("P", "first-order-lag", &[("time_constant", 0.05)])], 1.046);
    }

    /// A switch that is blind over most of the 2 mm that it looks along comes on with every stroke, wherever the steps end; over more than
    /// them it never does.
    #[test]
    fn a_blind_switch_comes_with_every_stroke_or_never() {
        let parameters =
            PusherParameters { stroke: 0.5, extend_speed: 0.5, retract_speed: 0.5, limit_tolerance: 0.002 };
        let strokes = |length: f64| {
            let quirks = [axis_quirk("P", "limitExtended", "blind-range", &[("length", length)])];
            let comes = |phase: &u32| {
                let mut pusher = Pusher::new(&parameters, &quirks, "P");
                pusher.command(0.0, "command", 1.0);
                pusher.advance(1e-4, 2.5e-6 * f64::from(*phase), 0);
                (2..12_000).for_each(|k| pusher.advance(f64::from(k) * 1e-4, 1e-4, 0));
                let mut values = Vec::new();
                pusher.read(1.2, &mut values);
                values[0] != 0.0
            };
            (0..40).filter(comes).count()
        };
        assert_eq!([0.00199, 0.00201].map(strokes), [40, 0]);
    }
}
