//! Puts effects where they belong on a device.

use std::borrow::Cow;

use super::affected::Signal;
use super::{
    Affected, Build, EffectDescriptor, EffectError, Fit, Needs, SignalClass, Site, dice, named, resolve, text,
};
use crate::device::path::Path;
use crate::device::{self, Device};
use crate::plant::{EffectPlace, EffectSpec, Parameter, ParameterValue, Parameters};
use crate::prototype::kind::{KindDescriptor, ParameterType, PortDescriptor, PortType};
use crate::signal_map::{Direction, Kind};
use crate::value::Quantity;

/// Builds the device of the instance called `instance`, with `effects` at their places: its parameters as
/// [`parameters_of`] has them, its stages as [`attach`] puts them. What is random about it follows from `seed`, the run's.
pub fn build(
    kind: &KindDescriptor,
    parameters: &Parameters,
    instance: &str,
    effects: &[EffectSpec],
    seed: u64,
) -> Result<Box<dyn Device>, EffectError> {
    let parameters = parameters_of(kind, parameters, instance, effects)?;
    let device = device::build(kind, &parameters, instance, seed)?;
    attach(device, kind, &parameters, instance, effects, seed)
}

/// The effects of an instance that are those of its task called `task`, one of `tasks`: an effect whose component is the
/// name of a task, alone or before a point, is that task's; one of which that is not said is every task's.
pub fn of_task(effects: &[EffectSpec], task: &str, tasks: &[&str]) -> Vec<EffectSpec> {
    let of = |spec: &EffectSpec| {
        let component = spec.component.as_deref().unwrap_or_default();
        let (first, rest) = component.split_once('.').unwrap_or((component, ""));
        match tasks.len() > 1 && tasks.contains(&first) {
            false => Some(spec.clone()),
            true if first == task => {
                Some(EffectSpec { component: Some(rest.to_owned()).filter(|rest| !rest.is_empty()), ..spec.clone() })
            }
            true => None,
        }
    };
    effects.iter().filter_map(of).collect()
}

/// The device's parameters with those that effects change: a `parameter-error` sets the one that its component (or its
/// property `parameter`) names to its `value`; a bay's errors of length and spacing add to its parameters.
pub fn parameters_of<'a>(
    kind: &KindDescriptor,
    parameters: &'a Parameters,
    instance: &str,
    effects: &[EffectSpec],
) -> Result<Cow<'a, Parameters>, EffectError> {
    let mut changed = Cow::Borrowed(parameters);
    for spec in effects {
        let (effect, values) = resolve(spec)?;
        if !matches!(effect.build, Build::Parameters) {
            continue;
        }
        let misfit = |reason| misfit(effect, instance, spec, reason);
        if effect.id != "parameter-error" {
            fits_inside(kind, effect).map_err(misfit)?;
        }
        let (name, place) = match effect.id {
            "part-length-error" => ("size", Some(0)),
            "part-spacing-error" => ("interval", None),
            _ => (spec.component.as_deref().or(text(spec, "parameter")).unwrap_or_default(), None),
        };
        let Some(declared) = kind.parameter(name) else {
            return Err(misfit(format!("{} has no parameter {name:?}", kind.name)));
        };
        let old = &parameters.0[declared.name];
        let value = match (&old.value, place) {
            (ParameterValue::Number(_), None) if effect.id == "parameter-error" => ParameterValue::Number(values[0]),
            (ParameterValue::Integer(_), None) => ParameterValue::Integer(values[0].round() as i64),
            (ParameterValue::Number(number), None) => ParameterValue::Number(number + values[0]),
            (ParameterValue::Numbers(numbers), Some(place)) => {
                let mut numbers = numbers.clone();
                numbers[place] += values[0];
                ParameterValue::Numbers(numbers)
            }
            _ => return Err(misfit(format!("{name} is no number"))),
        };
        if let Some(range) = out_of_range(&value, declared.ty) {
            return Err(misfit(format!("{name} would be {value:?}, expected {range}")));
        }
        changed.to_mut().0.insert(declared.name, Parameter { value, tolerance: old.tolerance });
    }
    Ok(changed)
}

/// The range of a parameter, in words, where a value is outside of it.
fn out_of_range(value: &ParameterValue, ty: ParameterType) -> Option<String> {
    let (numbers, min, max): (&[f64], f64, f64) = match (value, ty) {
        (ParameterValue::Number(number), ParameterType::Number { min, max }) => {
            (std::slice::from_ref(number), min, max)
        }
        (ParameterValue::Numbers(numbers), ParameterType::Numbers { min, max, .. }) => (numbers, min, max),
        (ParameterValue::Integer(number), ParameterType::Integer { min, max }) => {
            return (!(min..=max).contains(number)).then(|| format!("{min} to {max}"));
        }
        _ => return None,
    };
    let is_in = numbers.iter().all(|number| (min..=max).contains(number));
    (!is_in).then(|| format!("{min} to {max}"))
}

fn misfit(effect: &EffectDescriptor, instance: &str, spec: &EffectSpec, reason: String) -> EffectError {
    EffectError::Misfit { id: effect.id, device: instance.to_owned(), component: spec.component.clone(), reason }
}

/// `device`, which is of `kind` and called `instance`, with the stages of `effects` at their places, in the order given
/// where several stand at one place. Without any it is returned as it is. `parameters` are those it was built with.
pub fn attach(
    device: Box<dyn Device>,
    kind: &KindDescriptor,
    parameters: &Parameters,
    instance: &str,
    effects: &[EffectSpec],
    seed: u64,
) -> Result<Box<dyn Device>, EffectError> {
    // At its nominal parameters an effect does nothing, to the last bit: it is not even there.
    let is_there = |effect: &EffectDescriptor, values: &[f64]| {
        effect.acts_always || effect.parameters.iter().zip(values).any(|(p, value)| p.nominal != *value)
    };
    attach_where(is_there, device, kind, parameters, instance, effects, seed)
}

/// As [`attach`], with the stages of effects that do nothing.
#[cfg(test)]
pub(super) fn attach_all(
    device: Box<dyn Device>,
    kind: &KindDescriptor,
    parameters: &Parameters,
    instance: &str,
    effects: &[EffectSpec],
    seed: u64,
) -> Result<Box<dyn Device>, EffectError> {
    attach_where(|_, _| true, device, kind, parameters, instance, effects, seed)
}

fn attach_where(
    is_there: impl Fn(&EffectDescriptor, &[f64]) -> bool,
    mut device: Box<dyn Device>,
    kind: &KindDescriptor,
    parameters: &Parameters,
    instance: &str,
    effects: &[EffectSpec],
    seed: u64,
) -> Result<Box<dyn Device>, EffectError> {
    let mut signals: Vec<Signal> = kind.ports.iter().enumerate().map(|(at, port)| signal(at, port)).collect();
    let mut is_affected = false;
    for spec in effects {
        let (effect, values) = resolve(spec)?;
        let misfit = |reason: String| misfit(effect, instance, spec, reason);
        let component = spec.component.as_deref();
        let site = |port: Option<usize>| {
            let name = port.map_or(component.unwrap_or_default(), |port| kind.ports[port].name);
            let seed = dice::seed(seed, &[instance, name, spec.place.name(), effect.id]);
            Site { kind, parameters, place: spec.place, port: port.map(|port| &kind.ports[port]), seed }
        };
        let is_there = is_there(effect, &values);
        match effect.build {
            Build::Parameters => {}
            Build::Swap => {
                let pair = pair(kind, effect, spec).map_err(misfit)?;
                let [first, second] = pair.map(|port| signals[port].port);
                (signals[pair[0]].port, signals[pair[1]].port) = (second, first);
                is_affected = true;
            }
            Build::Stage(build) => match spec.place {
                EffectPlace::CommandLink | EffectPlace::Sensor | EffectPlace::ReportLink => {
                    for port in ports(kind, effect, spec.place, component).map_err(misfit)? {
                        if is_there {
                            signals[port].path.push(build(&values, &site(Some(port))));
                            is_affected = true;
                        }
                    }
                }
                _ => {
                    let site = site(None);
                    fits_inside(kind, effect).and_then(|()| has_what_it_needs(&site, effect)).map_err(misfit)?;
                    let no_component = || match component {
                        Some(name) => format!("{} has no component {name:?} with a drive", kind.name),
                        None => format!("{} has several components: name one", kind.name),
                    };
                    let stages = device.stages(component).ok_or_else(|| misfit(no_component()))?;
                    if !is_there {
                        continue;
                    }
                    let stage = build(&values, &site);
                    stages.push(spec.place, stage).map_err(|_| misfit("that place lies outside".to_owned()))?;
                }
            },
        }
    }
    Ok(if is_affected { Box::new(Affected::new(device, signals)) } else { device })
}

/// A port without stages.
fn signal(at: usize, port: &PortDescriptor) -> Signal {
    // What nobody commands is 0 or false, but for the torque of an axis, which is on.
    let commanded = f64::from(u8::from(port.name == "torqueEnabled"));
    let is_command = port.direction == Direction::Command;
    let is_smooth = port.kind == Kind::Level && port.ty != PortType::Boolean;
    let steps = !is_command && !is_smooth;
    Signal { path: Path::default(), is_command, commanded, port: at, steps }
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

fn has_what_it_needs(site: &Site, effect: &EffectDescriptor) -> Result<(), String> {
    if !site.is_servo() {
        return Ok(());
    }
    let mode = site.parameters.text("mode");
    match effect.needs {
        Needs::Nothing => Ok(()),
        Needs::Dynamics if mode != "ideal" => Ok(()),
        Needs::Dynamics => Err("an axis in mode ideal has no forces".to_owned()),
        Needs::Speed if mode == "force" => Err("an axis in mode force is asked for no speed".to_owned()),
        Needs::Speed if mode == "position" && site.parameters.text("loop") == "proportional" => {
            Err("an axis with one proportional loop is asked for no speed".to_owned())
        }
        Needs::Speed => Ok(()),
    }
}

fn way(place: EffectPlace) -> Direction {
    if place == EffectPlace::CommandLink { Direction::Command } else { Direction::Report }
}

fn takes(effect: &EffectDescriptor, port: &PortDescriptor) -> bool {
    effect.fits.iter().any(|fit| match fit {
        Fit::Signals(SignalClass::Any) => true,
        Fit::Signals(SignalClass::Boolean) => port.ty == PortType::Boolean,
        Fit::Signals(SignalClass::Number) => port.ty != PortType::Boolean,
        Fit::Signals(SignalClass::Motion) => {
            port.ty != PortType::Boolean || device::SWITCHES_ALONG_A_WAY.contains(&port.name)
        }
        Fit::Drives(_) | Fit::Parts(_) => false,
    })
}

/// The ports whose signals an effect acts on.
fn ports(
    kind: &KindDescriptor,
    effect: &EffectDescriptor,
    place: EffectPlace,
    component: Option<&str>,
) -> Result<Vec<usize>, String> {
    let named = |port: &PortDescriptor| component.is_none_or(|name| is_of(port.name, name));
    let mut chosen: Vec<usize> = (0..kind.ports.len())
        .filter(|&at| {
            let port = &kind.ports[at];
            port.direction == way(place) && named(port) && takes(effect, port)
        })
        .collect();
    // Of a sensor that is not named, the position is meant, where there is one.
    if component.is_none() && place == EffectPlace::Sensor {
        let is_position = |at: &usize| kind.ports[*at].quantities.contains(&Quantity::Length);
        if chosen.iter().any(is_position) {
            chosen.retain(is_position);
        }
    }
    if chosen.is_empty() {
        let what = component.map_or("it".to_owned(), |name| format!("{name:?}"));
        return Err(format!("{} has no signal at its {} that {what} could be", kind.name, place.name()));
    }
    Ok(chosen)
}

/// The two ports that change places.
fn pair(kind: &KindDescriptor, effect: &EffectDescriptor, spec: &EffectSpec) -> Result<[usize; 2], String> {
    let find = |name: Option<&str>, what: &str| {
        let name = name.ok_or_else(|| format!("{what} is missing: name a signal"))?;
        let port = kind.port(name).filter(|port| kind.ports[*port].direction == way(spec.place));
        port.ok_or_else(|| format!("{} has no signal {name:?} at its {}", kind.name, spec.place.name()))
    };
    let pair = [find(spec.component.as_deref(), "its component")?, find(text(spec, "with"), "the property with")?];
    let [first, second] = pair.map(|port| &kind.ports[port]);
    let is_same = first.ty == second.ty && first.range == second.range;
    if pair[0] == pair[1] || !is_same {
        return Err(format!("{} and {} are no two signals of one type", first.name, second.name));
    }
    debug_assert!(named(effect.id).is_some());
    Ok(pair)
}

/// Whether a port belongs to a component: it is the port's own name, or an axis whose name starts or ends the port's.
pub(crate) fn is_of(port: &str, component: &str) -> bool {
    port == component
        || port.strip_suffix("Target") == Some(component)
        || port.strip_prefix("actualPos") == Some(component)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effect::bench::{spec, with};

    #[test]
    fn a_late_command_moves_the_belt_later() {
        let late = spec("command-link", "dead-time", None, &[("time", 0.1)]);
        let mut belt = with("StraightConveyor", &[], &[late]);
        let run = [("velocityTarget", 0.5), ("motorDirection", 1.0)];
        belt.check(&run, 0.0, &[("velocityActual", 0.0), ("driveEnabled", 0.0)]);
        belt.check(&[], 0.0999, &[("driveEnabled", 0.0)]);
        belt.check(&[], 0.0001, &[("driveEnabled", 1.0), ("velocityActual", 0.0)]);
        belt.check(&[], 0.25, &[("velocityActual", 0.25)]);
    }

    #[test]
    fn one_signal_of_a_device_can_be_late_alone() {
        let late = spec("report-link", "dead-time", Some("actualPosX"), &[("time", 0.05)]);
        let mut robot = with("CartesianRobot", &[], &[late]);
        robot.check(&[("XTarget", 1.0), ("YTarget", 1.0)], 0.5, &[("actualPosY", 0.25)]);
        // Between its samples a late report lies on a straight line.
        let late = robot.report("actualPosX");
        assert!((late - 0.45_f64.powi(2)).abs() < 1e-6, "{late}");
    }

    #[test]
    fn a_lag_is_on_one_axis_only() {
        let lag = spec("actuator", "first-order-lag", Some("Y"), &[("time_constant", 0.02)]);
        let mut robot = with("CartesianRobot", &[], &[lag]);
        robot.check(&[("XTarget", 1.0), ("YTarget", 1.0)], 0.5, &[("actualPosX", 0.25)]);
        // x = t²: y = t² − 2T·t + 2T²·(1 − e^(−t/T)).
        let exact = 0.25 - 0.02 + 2.0 * 0.0004 * (1.0 - (-25.0_f64).exp());
        assert!((robot.report("actualPosY") - exact).abs() < 1e-9);
    }

    #[test]
    fn torque_stays_on_behind_a_link_that_nobody_uses() {
        let late = spec("command-link", "dead-time", None, &[("time", 0.01)]);
        let mut axis = with("ServoAxis", &[], &[late]);
        axis.check(&[("positionTarget", 0.001)], 2.0, &[("position", 0.001)]);
    }

    #[test]
    fn swapped_signals_change_places() {
        let mut swap = spec("report-link", "swapped", Some("lightBarrierA"), &[]);
        swap.parameters.insert("with".to_owned(), ParameterValue::Text("lightBarrierB".to_owned()));
        let mut belt = with("StraightConveyor", &[], &[swap]);
        belt.cut(true, false);
        belt.check(&[], 0.0, &[("lightBarrierA", 0.0), ("lightBarrierB", 1.0)]);
        let mut swap = spec("command-link", "swapped", Some("XTarget"), &[]);
        swap.parameters.insert("with".to_owned(), ParameterValue::Text("YTarget".to_owned()));
        with("CartesianRobot", &[], &[swap]).check(
            &[("XTarget", 0.5)],
            2.0,
            &[("actualPosX", 0.0), ("actualPosY", 0.5)],
        );
    }

    #[test]
    fn effects_of_another_task_are_left_out() {
        let specs = ["J1", "J1.position", "J2", "position"].map(|name| spec("sensor", "offset", Some(name), &[]));
        let of: Vec<_> = of_task(&specs, "J1", &["J1", "J2"]).into_iter().map(|spec| spec.component).collect();
        assert_eq!(of, [None, Some("position".to_owned()), Some("position".to_owned())]);
        assert_eq!(of_task(&specs, "J1", &["J1"]).len(), 4);
    }

    #[test]
    fn what_does_not_fit_is_refused_with_the_reason() {
        let check = |kind: &str, effect: EffectSpec, words: &str| {
            let error = crate::effect::bench::error(kind, &[], &[effect]);
            assert!(error.contains(words), "{error}");
        };
        let lag = |component| spec("actuator", "first-order-lag", component, &[("time_constant", 0.1)]);
        check("CartesianRobot", lag(None), "name one");
        check("CartesianRobot", lag(Some("Q")), "no component \"Q\"");
        check("SuctionCapGripper", lag(None), "not for a SuctionCapGripper");
        check(
            "EncoderMotor",
            spec("load", "first-order-lag", None, &[("time_constant", 0.1)]),
            "may stand at actuator",
        );
        check("EncoderMotor", spec("actuator", "first-order-lagg", None, &[]), "did you mean");
        check("EncoderMotor", spec("actuator", "first-order-lag", None, &[]), "needs its parameter");
        let wrong = spec("actuator", "first-order-lag", None, &[("time_constant", -1.0)]);
        check("EncoderMotor", wrong, "expected a number from 0 to 10");
        let error = |name, value| spec("actuator", "parameter-error", Some(name), &[("value", value)]);
        check("EncoderMotor", error("speed", 1.0), "has no parameter \"speed\"");
        check("EncoderMotor", error("acceleration", -1.0), "expected 0.000001 to 1000000");
        check("CartesianRobot", spec("report-link", "swapped", Some("actualPosX"), &[]), "needs its property with");
    }
}
