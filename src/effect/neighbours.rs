//! What effects say about other devices: whom they name, and who of them moves.

use super::{EffectError, named, text};
use crate::device::law::STANDSTILL;
use crate::plant::EffectSpec;
use crate::prototype::kind::KindDescriptor;

/// The effect whose device shares a supply with others.
pub const SHARES_A_SUPPLY: &str = "supply-drop";
/// The effect whose device carries parts by another's cups.
pub const CARRIES_PARTS: &str = "carried-mass";

/// The instances that an effect names, where it names any: its property `with`, separated by semicolons. `swapped`, whose
/// property of that name is a signal, names none.
pub fn neighbours(spec: &EffectSpec) -> Option<Vec<&str>> {
    let names = [SHARES_A_SUPPLY, CARRIES_PARTS].contains(&spec.kind.as_str());
    let with = names.then(|| text(spec, "with")).flatten()?;
    Some(with.split(';').map(str::trim).filter(|name| !name.is_empty()).collect())
}

/// What is wrong where an effect of `instance` names `stranger`, which is no instance of the plant.
pub fn stranger(spec: &EffectSpec, instance: &str, stranger: &str) -> EffectError {
    EffectError::Misfit {
        id: named(&spec.kind).map_or("", |effect| effect.id),
        device: instance.to_owned(),
        component: spec.component.clone(),
        reason: format!("with names {stranger:?}, which is no instance of the plant"),
    }
}

/// How many actuators of a device of `kind` move, by what it reported `before` and `now`, `seconds` later (SI units, by
/// port): what a neighbour that is replayed alone is told with [`Device::share`](crate::device::Device::share).
pub fn moving_as_reported(kind: &KindDescriptor, before: &[f64], now: &[f64], seconds: f64) -> u32 {
    let at = |name: &str| kind.port(name);
    if let Some(port) = at("driveRunning").or(at("isRunning")) {
        return u32::from(now[port] != 0.0);
    }
    if let Some(port) = at("speedActual").or(at("velocity")) {
        return u32::from(now[port].abs() > STANDSTILL);
    }
    let axes = ["actualPosX", "actualPosY", "actualPosZ", "actualPosR"];
    let moves = |port: &usize| (now[*port] - before[*port]).abs() > STANDSTILL * seconds;
    axes.iter().filter_map(|name| at(name)).filter(moves).count() as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::device::bench::Bench;

    #[test]
    fn who_moves_is_read_from_what_is_reported_as_the_devices_themselves_know_it() {
        let check = |kind: &str, commands: &[(&str, f64)]| {
            let mut bench = Bench::new(&format!("kinetwin.{kind}"), &[]);
            let mut before = vec![0.0; bench.kind.ports.len()];
            bench.device.report(&mut before);
            for (commands, moves) in [(&[][..], false), (commands, true)] {
                bench.check(commands, 0.1, &[]);
                let mut now = before.clone();
                bench.device.report(&mut now);
                assert_eq!(moving_as_reported(bench.kind, &before, &now, 0.1), bench.device.moving(), "{kind}");
                assert_eq!(bench.device.moving() > 0, moves, "{kind}");
            }
        };
        check("StraightConveyor", &[("velocityTarget", 0.5), ("motorDirection", -1.0)]);
        check("Pusher", &[("command", 1.0)]);
        check("CartesianRobot", &[("XTarget", 1.0), ("RTarget", 1.0)]);
        check("ServoAxis", &[("positionTarget", 1.0)]);
        check("EncoderMotor", &[("speedTarget", 5.0), ("enable", 1.0)]);
    }

    #[test]
    fn only_these_effects_name_instances() {
        let mut spec = crate::effect::bench::spec("actuator", SHARES_A_SUPPLY, None, &[("fraction", 0.1)]);
        assert_eq!(neighbours(&spec), None);
        spec.parameters.insert("with".to_owned(), crate::plant::ParameterValue::Text("A; B".to_owned()));
        assert_eq!(neighbours(&spec), Some(vec!["A", "B"]));
        spec.kind = "swapped".to_owned();
        assert_eq!(neighbours(&spec), None);
    }
}
