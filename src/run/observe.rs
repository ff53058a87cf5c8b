//! A run that is watched for what it brings forth: see [`crate::gap::production`].

use std::sync::Arc;
use std::time::Duration;

use super::stepped::Stepper;
use super::{Options, RunError};
use crate::gap::production::Observation;
use crate::plant::Plant;
use crate::prototype::quantity::to_si;
use crate::signal_map::{Direction, RegisterId};
use crate::value::Value;

/// What `plant` does under its embedded automation in `duration` of simulated time, in lock-step. `seed` and `step` are those
/// of a run.
///
/// # Errors
/// The plant cannot be built, or its automation does not fit it.
pub fn observe(plant: Plant, duration: Duration, seed: u64, step: Duration) -> Result<Observation, RunError> {
    let options = Options { duration: Some(duration), seed, step, collisions: false, ..Options::new(&plant.name) };
    let plant = Arc::new(plant);
    let mut stepper = Stepper::of(&options, plant.clone())?;
    let mut observed = Observation::default();
    let mut last: Vec<Option<Value>> = vec![None; plant.signal_map.signals().len()];
    let mut end = stepper.engine().now();
    while end.seconds() < duration.as_secs_f64() {
        let now = end;
        stepper.step();
        end = stepper.engine().now();
        for (index, value) in stepper.engine().registers().iter().enumerate() {
            if last[index].as_ref() == Some(value) {
                continue;
            }
            let first = last[index].replace(value.clone()).is_none();
            let register = RegisterId(index as u32);
            match (plant.signal_map.signal(register).direction, value) {
                (Direction::Command, value) => {
                    let taken = observed.commands.entry(register).or_insert_with(|| vec![0.0]);
                    let si = value.to_f64().map(|it| to_si(it, plant.signal_map.signal(register).unit));
                    taken.extend(si.filter(|si| taken.last() != Some(si)));
                }
                // What a plant begins with is no change.
                (Direction::Report, Value::Bool(is)) if !first => {
                    observed.changes.entry(register).or_default().push((now.seconds(), *is));
                }
                _ => {}
            }
        }
    }
    stepper.finish()?;
    Ok(observed)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::gap::production::{Counters, consequence};
    use crate::plant::{EffectPlace, EffectSpec, ParameterValue};
    use crate::run::model;

    fn line(effects: &[(&str, EffectSpec)]) -> Plant {
        let mut plant = model::load("models/depalletizer").expect("the line");
        for (name, effect) in effects {
            let instance = plant.instances.iter_mut().find(|instance| instance.name == *name).expect("an instance");
            instance.effects.push(effect.clone());
        }
        plant
    }

    fn run(effects: &[(&str, EffectSpec)], seconds: u64) -> Observation {
        observe(line(effects), Duration::from_secs(seconds), 0, Options::STEP).expect("a run")
    }

    #[test]
    fn a_slower_robot_costs_parts_and_the_model_with_its_cause_says_how_many() {
        let slow = EffectSpec {
            place: EffectPlace::Actuator,
            kind: "velocity-limit".to_owned(),
            component: Some("Y".to_owned()),
            parameters: BTreeMap::from([("limit".to_owned(), ParameterValue::Number(0.25))]),
        };
        let counters = Counters::of(&line(&[]));
        let [nominal, slowed] = [run(&[], 120), run(&[("Robot", slow)], 120)];
        let found = consequence(&counters, &slowed, &nominal, &slowed).expect("one automation");
        let figures = [found.cycle_s.recorded, found.cycle_s.before, found.cycle_s.after].map(|it| it.expect("cycles"));
        assert_eq!(figures[0], figures[2], "the causes are all there is");
        assert!(figures[1] < 0.95 * figures[0], "the nominal robot is faster: {figures:?}");
        let robot = found.devices.iter().find(|device| device.device == "Gripper1").expect("it grips");
        assert!(robot.cycle_s.before < robot.cycle_s.recorded, "{robot:?}");
    }

    #[test]
    fn another_automation_s_recording_says_nothing_of_production() {
        let nominal = run(&[], 60);
        let mut foreign = nominal.clone();
        for values in foreign.commands.values_mut() {
            values.iter_mut().skip(1).for_each(|value| *value = 0.5 * *value + 0.1);
        }
        assert_eq!(consequence(&Counters::of(&line(&[])), &foreign, &nominal, &nominal), None);
    }
}
