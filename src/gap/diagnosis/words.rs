//! What would tell two effects apart.

use crate::plant::EffectPlace;

/// Pairs of effects, and the experiment that parts them.
const EXPERIMENTS: &[(&[&str], &[&str], &str)] = &[
    (
        &["dead-time", "stale-hold"],
        &["first-order-lag", "second-order-lag", "input-filter"],
        "the onset of a step, reported at a faster cycle, or the phase of a chirp",
    ),
    (
        &["backlash", "hysteresis", "dead-band"],
        &["backlash", "hysteresis", "dead-band"],
        "a sensor on the load's side, or reversals with another amplitude and another load",
    ),
    (
        &["coulomb-friction"],
        &["stribeck-friction", "breakaway-friction", "viscous-friction"],
        "slow motion, below the Stribeck velocity, and motion at several constant speeds",
    ),
    (&["offset"], &["constant-force", "direction-asymmetry"], "no motion can: an independent measurement at rest"),
    (
        &["added-mass", "acceleration-limit", "force-limit", "jerk-limit", "velocity-limit"],
        &["gain-error", "gain", "added-mass", "acceleration-limit", "force-limit", "jerk-limit", "velocity-limit"],
        "another payload, and targets of another distance",
    ),
    (
        &["belt-slip", "scale-error", "belt-slip-above-acceleration"],
        &["belt-slip", "scale-error", "gain", "gain-error", "belt-slip-above-acceleration", "direction-asymmetry"],
        "another load, another acceleration, and motion in both directions",
    ),
    (
        &["load-dependent-friction", "coulomb-friction", "position-dependent-friction"],
        &["load-dependent-friction", "coulomb-friction", "position-dependent-friction", "viscous-friction"],
        "another load at the same speeds",
    ),
    (
        &["on-delay", "off-delay", "dead-time"],
        &["on-delay", "off-delay", "dead-time"],
        "both edges of the signal, more of each",
    ),
    (&["drift", "clock-drift"], &["drift", "clock-drift", "offset"], "a longer recording"),
];

/// What would tell `one` from `other`.
pub(super) fn told_apart_by(one: (&str, EffectPlace), other: (&str, EffectPlace)) -> String {
    let is_link = |place: EffectPlace| matches!(place, EffectPlace::CommandLink | EffectPlace::ReportLink);
    if one.0 == other.0 && is_link(one.1) && is_link(other.1) {
        return "an input that bypasses one of the links, such as a light barrier wired to the recorder".to_owned();
    }
    let within =
        |first: &str, second: &str, (a, b, _): &&(&[&str], &[&str], &str)| a.contains(&first) && b.contains(&second);
    let pair = EXPERIMENTS.iter().find(|pair| within(one.0, other.0, pair) || within(other.0, one.0, pair));
    pair.map_or("motion over the whole range of speeds, accelerations and ways, both directions", |pair| pair.2)
        .to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn either_order_has_the_same_experiment() {
        let (a, b) = (("dead-time", EffectPlace::CommandLink), ("first-order-lag", EffectPlace::Actuator));
        assert!(told_apart_by(a, b).contains("onset"));
        assert_eq!(told_apart_by(a, b), told_apart_by(b, a));
        assert!(told_apart_by(a, ("dead-time", EffectPlace::ReportLink)).contains("bypasses"));
    }
}
