//! Puts effects where they belong on a device.

use super::{Affected, EffectDescriptor, EffectError, Fit, SignalClass, resolve};
use crate::device::Device;
use crate::device::path::Path;
use crate::plant::{EffectPlace, EffectSpec};
use crate::prototype::kind::{KindDescriptor, PortDescriptor, PortType};
use crate::signal_map::Direction;

/// `device`, which is of `kind` and called `instance`, with `effects` at their places, in the order given where several
/// stand at one place. Without effects it is returned as it is.
pub fn attach(
    mut device: Box<dyn Device>,
    kind: &KindDescriptor,
    instance: &str,
    effects: &[EffectSpec],
) -> Result<Box<dyn Device>, EffectError> {
    let mut paths = vec![Path::default(); kind.ports.len()];
    for spec in effects {
        let (effect, values) = resolve(spec)?;
        let misfit = |reason: String| EffectError::Misfit {
            id: effect.id,
            device: instance.to_owned(),
            component: spec.component.clone(),
            reason,
        };
        let component = spec.component.as_deref();
        match spec.place {
            EffectPlace::CommandLink | EffectPlace::Sensor | EffectPlace::ReportLink => {
                let ports = ports(kind, effect, spec.place, component).map_err(misfit)?;
                for port in ports {
                    paths[port].push((effect.build)(&values));
                }
            }
            _ => {
                fits_inside(kind, effect).map_err(misfit)?;
                let no_component = || match component {
                    Some(name) => format!("{} has no component {name:?} with a drive", kind.name),
                    None => format!("{} has several components: name one", kind.name),
                };
                let stages = device.stages(component).ok_or_else(|| misfit(no_component()))?;
                let stage = (effect.build)(&values);
                stages.push(spec.place, stage).map_err(|_| misfit("that place lies outside".to_owned()))?;
            }
        }
    }
    if paths.iter().all(Path::is_nominal) {
        return Ok(device);
    }
    let is_command = kind.ports.iter().map(|port| port.direction == Direction::Command).collect();
    Ok(Box::new(Affected::new(device, paths, is_command)))
}

/// The last word of a kind's name: `StraightConveyor`.
fn short(kind: &KindDescriptor) -> &'static str {
    kind.name.rsplit('.').next().unwrap_or(kind.name)
}

fn fits_inside(kind: &KindDescriptor, effect: &EffectDescriptor) -> Result<(), String> {
    let fits = effect.fits.iter().any(|fit| match fit {
        Fit::Drives(kinds) | Fit::Parts(kinds) => kinds.contains(&short(kind)),
        Fit::Signals(_) => false,
    });
    if fits { Ok(()) } else { Err(format!("it is not for a {}", short(kind))) }
}

/// The ports whose signals an effect acts on.
fn ports(
    kind: &KindDescriptor,
    effect: &EffectDescriptor,
    place: EffectPlace,
    component: Option<&str>,
) -> Result<Vec<usize>, String> {
    let way = if place == EffectPlace::CommandLink { Direction::Command } else { Direction::Report };
    let takes = |port: &PortDescriptor| {
        effect.fits.iter().any(|fit| match fit {
            Fit::Signals(SignalClass::Any) => true,
            Fit::Signals(SignalClass::Boolean) => port.ty == PortType::Boolean,
            Fit::Signals(SignalClass::Number) => port.ty != PortType::Boolean,
            Fit::Drives(_) | Fit::Parts(_) => false,
        })
    };
    let named = |port: &PortDescriptor| component.is_none_or(|name| is_of(port.name, name));
    let chosen: Vec<usize> = (0..kind.ports.len())
        .filter(|&at| {
            let port = &kind.ports[at];
            port.direction == way && named(port) && takes(port)
        })
        .collect();
    if chosen.is_empty() {
        let what = component.map_or("it".to_owned(), |name| format!("{name:?}"));
        return Err(format!("{} has no signal at its {} that {what} could be", kind.name, place.name()));
    }
    Ok(chosen)
}

/// Whether a port belongs to a component: it is the port's own name, or an axis whose name starts or ends the port's.
fn is_of(port: &str, component: &str) -> bool {
    port == component
        || port.strip_suffix("Target") == Some(component)
        || port.strip_prefix("actualPos") == Some(component)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::device::bench::Bench;
    use crate::plant::ParameterValue;

    fn spec(place: EffectPlace, kind: &str, component: Option<&str>, parameters: &[(&str, f64)]) -> EffectSpec {
        let number = |(name, value): &(&str, f64)| ((*name).to_owned(), ParameterValue::Number(*value));
        EffectSpec {
            place,
            kind: kind.to_owned(),
            component: component.map(str::to_owned),
            parameters: parameters.iter().map(number).collect::<BTreeMap<_, _>>(),
        }
    }

    fn with(kind: &str, parameters: &[(&str, &str)], effects: &[EffectSpec]) -> Bench {
        let mut bench = Bench::new(kind, parameters);
        bench.device = attach(bench.device, bench.kind, "Device1", effects).expect("effects that fit");
        bench
    }

    #[test]
    fn a_late_command_moves_the_belt_later() {
        let late = spec(EffectPlace::CommandLink, "dead-time", None, &[("time", 0.1)]);
        let mut belt = with("kinetwin.StraightConveyor", &[], &[late]);
        let run = [("velocityTarget", 0.5), ("motorDirection", 1.0)];
        belt.check(&run, 0.0, &[("velocityActual", 0.0), ("driveEnabled", 0.0)]);
        belt.check(&[], 0.0999, &[("driveEnabled", 0.0)]);
        belt.check(&[], 0.0001, &[("driveEnabled", 1.0), ("velocityActual", 0.0)]);
        belt.check(&[], 0.25, &[("velocityActual", 0.25)]);
    }

    #[test]
    fn one_signal_of_a_device_can_be_late_alone() {
        let late = spec(EffectPlace::ReportLink, "dead-time", Some("actualPosX"), &[("time", 0.05)]);
        let mut robot = with("kinetwin.CartesianRobot", &[], &[late]);
        robot.check(&[("XTarget", 1.0), ("YTarget", 1.0)], 0.5, &[("actualPosY", 0.25)]);
        // A report passes its link at the ends of the stretches, a millisecond apart.
        let late = robot.report("actualPosX");
        assert!((late - 0.45_f64.powi(2)).abs() < 1e-3, "{late}");
    }

    #[test]
    fn a_lag_is_on_one_axis_only() {
        let lag = spec(EffectPlace::Actuator, "first-order-lag", Some("Y"), &[("time_constant", 0.02)]);
        let mut robot = with("kinetwin.CartesianRobot", &[], &[lag]);
        robot.check(&[("XTarget", 1.0), ("YTarget", 1.0)], 0.5, &[("actualPosX", 0.25)]);
        // x = t²: y = t² − 2T·t + 2T²·(1 − e^(−t/T)).
        let exact = 0.25 - 0.02 + 2.0 * 0.0004 * (1.0 - (-25.0_f64).exp());
        assert!((robot.report("actualPosY") - exact).abs() < 1e-6);
    }

    #[test]
    fn what_does_not_fit_is_refused_with_the_reason() {
        let check = |kind: &str, effect: EffectSpec, words: &str| {
            let bench = Bench::new(kind, &[]);
            let error = attach(bench.device, bench.kind, "Device1", &[effect]).err().expect(words).to_string();
            assert!(error.contains(words), "{error}");
        };
        let lag = |component| spec(EffectPlace::Actuator, "first-order-lag", component, &[("time_constant", 0.1)]);
        check("kinetwin.CartesianRobot", lag(None), "name one");
        check("kinetwin.CartesianRobot", lag(Some("Q")), "no component \"Q\"");
        check("kinetwin.SuctionCapGripper", lag(None), "not for a SuctionCapGripper");
        let place = spec(EffectPlace::Load, "first-order-lag", None, &[("time_constant", 0.1)]);
        check("kinetwin.EncoderMotor", place, "it may stand at actuator");
        check("kinetwin.EncoderMotor", spec(EffectPlace::Actuator, "first-order-lagg", None, &[]), "did you mean");
        check(
            "kinetwin.EncoderMotor",
            spec(EffectPlace::Actuator, "first-order-lag", None, &[]),
            "needs its parameter",
        );
        let wrong = spec(EffectPlace::Actuator, "first-order-lag", None, &[("time_constant", -1.0)]);
        check("kinetwin.EncoderMotor", wrong, "expected a number from 0 to 10");
    }
}
