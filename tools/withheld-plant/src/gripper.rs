//! A gripper with suction cups and a vacuum switch.

use crate::plant::Device;
use crate::quirk::{Quirk, Quirks};
use crate::switch::Delay;

/// What a gripper is built to.
#[derive(Clone, Debug)]
pub struct GripperParameters {
    pub build_up: f64,
    pub release: f64,
}

/// A gripper at whose cups a part is always sealed.
#[derive(Clone, Debug)]
pub struct Gripper {
    build_up: f64,
    release: f64,
    suction: Delay,
    blow: Delay,
    leak: f64,
    /// Every grip takes this share longer than the one before, up to so many times.
    tires: Option<(f64, f64)>,
    grips: f64,
    draws: bool,
    changed: f64,
    vacuum: bool,
    built: f64,
}

impl Gripper {
    /// A gripper called `name`, without vacuum.
    pub fn new(parameters: &GripperParameters, quirks: &[Quirk], name: &str) -> Gripper {
        let all = Quirks::of(quirks, name);
        let tires = all.get("x-filter-clogs").map(|quirk| (quirk.value("share"), quirk.value("most")));
        Gripper {
            build_up: all.parameter("buildUpTime", parameters.build_up)
                + all.value("vacuum-build-up", "time").unwrap_or(0.0),
            release: all.parameter("releaseTime", parameters.release),
            suction: Delay::of(all, "switch-on-delay", "switch-off-delay"),
            blow: Delay::default(),
            leak: all.value("leak", "rate").unwrap_or(0.0),
            tires,
            grips: 0.0,
            draws: false,
            changed: f64::NEG_INFINITY,
            vacuum: false,
            built: 0.0,
        }
    }

    fn see(&mut self, now: f64) {
        let blows = self.blow.at(now);
        let draws = self.suction.at(now) && !blows;
        if draws != self.draws {
            self.draws = draws;
            self.changed = now;
        }
        if blows {
            self.vacuum = false;
            return;
        }
        let build_up = self.build_up * self.tires.map_or(1.0, |(share, most)| (1.0 + share * self.grips).min(most));
        let leaked = self.leak > 0.0 && self.vacuum && now - self.built >= 1.0 / self.leak;
        let since = now - self.changed + 1e-9;
        match (self.vacuum, draws) {
            (false, true) if since >= build_up && self.built < self.changed => {
                self.vacuum = true;
                self.built = now;
                self.grips += 1.0;
            }
            (true, true) if leaked => self.vacuum = false,
            (true, false) if since >= self.release => self.vacuum = false,
            _ => {}
        }
    }
}

impl Device for Gripper {
    fn command(&mut self, now: f64, port: &str, value: f64) {
        match port {
            "suctionOn" => self.suction.set(now, value != 0.0),
            "blowOn" => self.blow.set(now, value != 0.0),
            _ => {}
        }
        self.see(now);
    }

    fn advance(&mut self, now: f64, _span: f64, _others: usize) {
        self.see(now);
    }

    fn read(&self, _now: f64, values: &mut Vec<f64>) {
        values.push(f64::from(self.vacuum));
    }

    fn moving(&self) -> usize {
        0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The edges of the vacuum under these commands (at, port, value), in steps of 1 ms.
    fn edges(commands: &[(f64, &str, f64)]) -> Vec<f64> {
        let mut gripper = Gripper::new(&GripperParameters { build_up: 0.15, release: 0.08 }, &[], "G");
        let (mut found, mut was) = (Vec::new(), false);
        for k in 0..3000 {
            let now = f64::from(k) * 1e-3;
            gripper.advance(now, 1e-3, 0);
            for (_, port, value) in commands.iter().filter(|(at, ..)| (at - now).abs() < 1e-6) {
                gripper.command(now, port, *value);
            }
            if gripper.vacuum != was {
                was = gripper.vacuum;
                found.push((now * 1e3).round() / 1e3);
            }
        }
        found
    }

    #[test]
    fn vacuum_takes_its_times_and_blow_off_none() {
        assert_eq!(edges(&[(0.1, "suctionOn", 1.0), (1.0, "suctionOn", 0.0)]), [0.25, 1.08]);
        assert_eq!(edges(&[(0.1, "suctionOn", 1.0), (0.2, "suctionOn", 0.0)]), [0.0; 0]);
        let short = [(0.1, "suctionOn", 1.0), (1.0, "suctionOn", 0.0), (1.05, "suctionOn", 1.0)];
        assert_eq!(edges(&short), [0.25]);
        let blown = [(0.1, "suctionOn", 1.0), (1.0, "blowOn", 1.0), (1.2, "blowOn", 0.0)];
        assert_eq!(edges(&blown), [0.25, 1.0, 1.35]);
    }
}
