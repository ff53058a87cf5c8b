//! Between a shaft and its load: what a transmission does to a motion that it does not hold back.
//!
//! A backlash is a gap between two flanks of which each pushes like a stiff spring while the load rubs on its way, where the
//! library's is a play; a compliance is a spring and a damper integrated by Runge and Kutta; a belt that slips is dragged
//! by what its drum can exert.

use std::f64::consts::TAU;

use crate::drive::rk4;
use crate::quirk::Quirks;

/// How fast a flank pushes its load out of the way, 1/s: what rubs over what is stiff. A tooth of steel has 14 to 20 N/µm for each
/// millimetre of its width (ISO 6336-1:2019, single and mesh stiffness), and what rubs here has some 100 N·s/m at most: of a tooth of
/// 10 mm that is a microsecond. Ten are far less than anything that is recorded.
const FLANK: f64 = 1e5;

/// A transmission and what is wrong with it.
#[derive(Clone, Debug)]
pub struct Train {
    ratio: f64,
    /// Amplitude, period and phase of an eccentric wheel.
    eccentric: Option<[f64; 3]>,
    drum: Option<Drum>,
    /// The width of a gap, and where the load was pushed to.
    gap: Option<(f64, f64)>,
    spring: Option<Spring>,
    coupling: Option<Coupling>,
    /// The whole way grows by this share, with this time constant, as it warms up.
    growth: Option<(f64, f64)>,
    load: f64,
    load_speed: f64,
    clock: f64,
}

impl Train {
    /// The transmission of a device or an axis.
    pub fn new(quirks: Quirks<'_>) -> Train {
        let slip = quirks.value("belt-slip", "ratio").unwrap_or(0.0);
        let scale = quirks.value("scale-error", "ratio").unwrap_or(0.0);
        let pair = |name: &str, first: &str, second: &str| {
            quirks.get(name).map(|quirk| (quirk.value(first), quirk.value(second)))
        };
        let eccentric = quirks.get("once-per-revolution-error");
        let grip = quirks.value("belt-slip-above-acceleration", "acceleration");
        let spring = pair("compliance", "stiffness", "damping");
        let coupling = pair("x-coupling-slips-each-turn", "slip", "turn");
        Train {
            ratio: (1.0 - slip) * (1.0 + scale),
            eccentric: eccentric.map(|quirk| ["amplitude", "period", "phase"].map(|name| quirk.value(name))),
            drum: grip.map(|grip| Drum { grip, speed: 0.0, belt: 0.0, lost: 0.0 }),
            gap: quirks.value("backlash", "gap").map(|gap| (gap, 0.0)),
            spring: spring.map(|(stiffness, damping)| Spring { stiffness, damping, end: 0.0, load: 0.0, speed: 0.0 }),
            coupling: coupling.map(|(slip, turn)| Coupling { slip, turn, at: 0.0, lost: 0.0 }),
            growth: pair("x-grows-with-heat", "share", "time"),
            load: 0.0,
            load_speed: 0.0,
            clock: 0.0,
        }
    }

    /// Where the load is.
    pub fn load(&self) -> f64 {
        self.load
    }

    /// How fast the load moves.
    pub fn load_speed(&self) -> f64 {
        self.load_speed
    }

    /// Whether it holds its load where it is while its shaft stays at `shaft`: it is a fixed ratio and no more.
    pub fn rests_at(&self, shaft: f64) -> bool {
        let Train { eccentric, drum, gap, spring, coupling, growth, .. } = self;
        let has_parts = drum.is_some() || gap.is_some() || spring.is_some() || coupling.is_some();
        let is_plain = !has_parts && eccentric.is_none() && growth.is_none();
        is_plain && self.load_speed == 0.0 && self.load == self.geared(shaft)
    }

    /// After `span` the shaft has come to `shaft` and runs at `speed`. Gives the load's way.
    pub fn advance(&mut self, span: f64, shaft: f64, speed: f64) -> f64 {
        self.clock += span;
        let mut x = shaft;
        if let Some(drum) = &mut self.drum {
            x -= drum.loses(span, speed);
        }
        if let Some(coupling) = &mut self.coupling {
            x -= coupling.loses(shaft);
        }
        if let Some((gap, pushed)) = &mut self.gap {
            let apart = x - *pushed;
            let pressed = apart - apart.clamp(-0.5 * *gap, 0.5 * *gap);
            *pushed += pressed * (1.0 - (-FLANK * span).exp());
            x = *pushed;
        }
        x = self.geared(x);
        let before = self.load;
        self.load = self.spring.as_mut().map_or(x, |spring| spring.follows(span, x));
        if span > 0.0 {
            self.load_speed = (self.load - before) / span;
        }
        self.load - before
    }

    fn geared(&self, x: f64) -> f64 {
        let growth = self.growth.map_or(0.0, |(share, time)| share * (1.0 - (-self.clock / time).exp()));
        let error = self
            .eccentric
            .map_or(0.0, |[amplitude, period, phase]| amplitude * ((TAU * x / period + phase).sin() - phase.sin()));
        (self.ratio + growth) * x + error
    }
}

/// A drum that holds its belt while the belt needs no more than its grip, an acceleration.
#[derive(Clone, Debug)]
struct Drum {
    grip: f64,
    speed: f64,
    belt: f64,
    lost: f64,
}

impl Drum {
    /// What the belt has fallen behind so far.
    fn loses(&mut self, span: f64, speed: f64) -> f64 {
        let (from, belt) = (self.speed, self.belt);
        let step = self.grip * span * (1.0 + 1e-9);
        self.belt += (speed - self.belt).clamp(-step, step);
        self.speed = speed;
        self.lost += 0.5 * span * (from + speed - belt - self.belt);
        self.lost
    }
}

/// A coupling that loses a fixed way, every time its shaft passes the middle of a turn.
#[derive(Clone, Debug)]
struct Coupling {
    slip: f64,
    turn: f64,
    at: f64,
    lost: f64,
}

impl Coupling {
    fn loses(&mut self, shaft: f64) -> f64 {
        let turns = |x: f64| (x / self.turn + 0.5).floor();
        self.lost += self.slip * (turns(shaft) - turns(self.at));
        self.at = shaft;
        self.lost
    }
}

/// One kilogram on a spring with a damper; both count for each kilogram.
#[derive(Clone, Debug)]
struct Spring {
    stiffness: f64,
    damping: f64,
    end: f64,
    load: f64,
    speed: f64,
}

impl Spring {
    fn follows(&mut self, span: f64, end: f64) -> f64 {
        if span > 0.0 {
            let (from, speed) = (self.end, (end - self.end) / span);
            let Spring { stiffness, damping, .. } = *self;
            let pull = |t: f64, y: f64, dy: f64| stiffness * (from + speed * t - y) + damping * (speed - dy);
            let steps = (span * stiffness.sqrt().max(damping) * 5.0).ceil().max(1.0);
            let h = span / steps;
            for step in 0..steps as usize {
                rk4(step as f64 * h, h, &mut self.load, &mut self.speed, &pull);
            }
        }
        self.end = end;
        self.load
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::quirk;
    use crate::quirk::Quirk;

    /// Where the load is after a shaft has run along `way(t)` for `seconds`.
    fn after(quirk: Quirk, seconds: f64, way: impl Fn(f64) -> f64) -> f64 {
        let all = [quirk];
        let mut train = Train::new(Quirks::of(&all, "D"));
        for k in 1..=(seconds * 1e4_f64).round() as usize {
            let t = k as f64 * 1e-4;
            train.advance(1e-4, way(t), (way(t + 1e-6) - way(t - 1e-6)) / 2e-6);
        }
        train.load()
    }

    #[test]
    fn a_load_hangs_half_a_gap_behind() {
        let play = || quirk("D", "backlash", &[("gap", 0.01)]);
        // In motion it is a flank's time constant behind.
        let behind = after(play(), 1.0, |t| 0.1 * t);
        assert!((behind - (0.1 - 0.005)).abs() < 1e-4, "{behind}");
        let turned = after(play(), 2.0, |t| 0.1 * (1.0 - (t - 1.0).abs()));
        assert!((turned - 0.005).abs() < 1e-4, "{turned}");
    }

    #[test]
    fn a_spring_without_damping_swings_about_where_it_is_pulled() {
        let spring = quirk("D", "compliance", &[("stiffness", 400.0), ("damping", 0.0)]);
        // After a jump of 1 the load is at 1 − cos(20·t), less what the jump took.
        let there = after(spring, 0.1, |_| 1.0);
        assert!((there - (1.0 - 2.0_f64.cos())).abs() < 2e-3, "{there}");
    }

    #[test]
    fn a_drum_slips_under_its_belt() {
        let grip = quirk("D", "belt-slip-above-acceleration", &[("acceleration", 0.5)]);
        // The shaft is at 1 m/s after 1 s, the belt after 2 s: it loses 1/2 m.
        let there = after(grip, 3.0, |t| if t < 1.0 { 0.5 * t * t } else { t - 0.5 });
        assert!((there - 2.0).abs() < 1e-3, "{there}");
    }

    #[test]
    fn a_coupling_slips_once_in_each_turn() {
        let loose = quirk("D", "x-coupling-slips-each-turn", &[("slip", 0.01), ("turn", 0.2)]);
        assert!((after(loose, 1.0, |t| 0.45 * t) - 0.43).abs() < 1e-9);
    }

    #[test]
    fn an_eccentric_wheel_and_a_slipping_belt() {
        let wheel = quirk("D", "once-per-revolution-error", &[("amplitude", 0.002), ("period", 0.4), ("phase", 0.0)]);
        assert!((after(wheel, 1.0, |t| 0.1 * t) - 0.102).abs() < 1e-9);
        let slip = quirk("D", "belt-slip", &[("ratio", 0.06)]);
        assert!((after(slip, 1.0, |t| t) - 0.94).abs() < 1e-9);
    }
}
