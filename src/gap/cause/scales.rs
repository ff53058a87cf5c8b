//! How large things are on a device: what a parameter is measured against before anything is known of it.

use crate::gap::statistics::span;
use crate::gap::{Predicted, Prediction, Subject};
use crate::plant::ParameterValue;
use crate::prototype::kind::PortDescriptor;
use crate::value::Quantity;

/// Magnitudes of a device's motion, or of one of its axes, by its nominal law: m, m/s, m/s², N, or of a rotary one rad and N·m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Scales {
    /// From the least position to the greatest.
    pub travel: f64,
    pub speed: f64,
    pub acceleration: f64,
    pub effort: f64,
    pub inertia: f64,
    /// The longest cycle of its reports, s.
    pub cycle: f64,
    /// How long it was recorded, s.
    pub duration: f64,
}

impl Scales {
    /// Those of `subject`, or of its axis called `axis`.
    pub fn of(subject: &Subject, nominal: &Prediction, axis: Option<&str>) -> Scales {
        let is_meant = |port: &PortDescriptor| axis.is_none_or(|axis| port.name.ends_with(axis));
        let mut scales = Scales::default();
        for (run, predicted) in subject.runs.iter().zip(&nominal.runs) {
            scales.duration += run.ends;
            for (signal, info) in subject.signals.iter().enumerate() {
                let Some(track) = &run.tracks[signal] else { continue };
                scales.cycle = scales.cycle.max(track.grid.cycle);
                let port = info.descriptor;
                let Predicted::Level(values) = &predicted[signal] else { continue };
                if is_meant(port) {
                    let instants = &track.grid.instants[track.first..];
                    scales.take(port.quantities, instants, values);
                }
            }
        }
        let number = |ending: &str| largest_number(subject, &format!("{ending}{}", axis.unwrap_or_default()));
        scales.acceleration = scales.acceleration.max(number("cceleration"));
        scales.speed = scales.speed.max(number("Speed"));
        scales.inertia = number("M");
        scales.effort = if scales.effort > 0.0 { scales.effort } else { scales.inertia * scales.acceleration };
        scales.fill_up();
        scales
    }

    fn take(&mut self, quantities: &[Quantity], instants: &[f64], values: &[f64]) {
        let is_a = |wanted: &[Quantity]| quantities.iter().any(|quantity| wanted.contains(quantity));
        if is_a(&[Quantity::Length, Quantity::Angle]) {
            self.travel = self.travel.max(span(values));
            let speeds = slopes(instants, values);
            self.speed = self.speed.max(largest(&speeds));
            self.acceleration = self.acceleration.max(largest(&slopes(instants, &speeds)));
        } else if is_a(&[Quantity::Velocity, Quantity::AngularVelocity]) {
            self.speed = self.speed.max(largest(values));
            self.acceleration = self.acceleration.max(largest(&slopes(instants, values)));
            let way: f64 = values.iter().zip(instants.windows(2)).map(|(v, t)| v.abs() * (t[1] - t[0])).sum();
            self.travel = self.travel.max(0.1 * way);
        } else if is_a(&[Quantity::Force, Quantity::Torque]) {
            self.effort = self.effort.max(largest(values));
        }
    }

    /// What nothing is known of is taken to be 1.
    fn fill_up(&mut self) {
        for scale in [&mut self.travel, &mut self.speed, &mut self.acceleration, &mut self.effort, &mut self.inertia] {
            if !(*scale > 0.0 && scale.is_finite()) {
                *scale = 1.0;
            }
        }
    }

    /// The magnitude that a quantity has on the device; `None` of a ratio or a time.
    pub fn of_quantity(&self, quantity: Quantity) -> Option<f64> {
        Some(match quantity {
            Quantity::Length | Quantity::Angle => self.travel,
            Quantity::Velocity | Quantity::AngularVelocity => self.speed,
            Quantity::Acceleration | Quantity::AngularAcceleration => self.acceleration,
            Quantity::Force | Quantity::Torque => self.effort,
            Quantity::Mass | Quantity::Inertia => self.inertia,
            Quantity::LinearDamping | Quantity::AngularDamping => self.effort / self.speed,
            _ => return None,
        })
    }
}

/// The largest nominal parameter whose name ends so.
fn largest_number(subject: &Subject, ending: &str) -> f64 {
    let of = |(name, parameter): (&&'static str, &crate::plant::Parameter)| match &parameter.value {
        ParameterValue::Number(number) if name.ends_with(ending) => *number,
        _ => 0.0,
    };
    subject.parameters.0.iter().map(of).filter(|number| *number < 1e5).fold(0.0, f64::max)
}

/// The largest magnitude.
pub fn largest(values: &[f64]) -> f64 {
    values.iter().map(|value| value.abs()).fold(0.0, f64::max)
}

/// From each value to the next, for each second.
pub fn slopes(instants: &[f64], values: &[f64]) -> Vec<f64> {
    let spans = instants.windows(2).map(|pair| (pair[1] - pair[0]).max(1e-9));
    values.windows(2).zip(spans).map(|(pair, span)| (pair[1] - pair[0]) / span).collect()
}
